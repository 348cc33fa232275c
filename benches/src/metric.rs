//! Distances of a graph as a search for a tour asks for them.

use argil_graph::{DistanceMatrix, Distances};
use argil_tour::Metric;

/// A matrix of distances as the search asks for it.
#[derive(Debug)]
pub struct Rows<'a>(pub &'a DistanceMatrix);

impl Metric for Rows<'_> {
    fn nodes(&self) -> usize {
        self.0.len()
    }

    #[inline]
    fn distance(&self, a: usize, b: usize) -> f64 {
        self.0.row(a)[b]
    }

    fn row(&self, a: usize) -> Option<&[f64]> {
        Some(self.0.row(a))
    }
}

/// Distances of any kind as the search asks for them.
#[derive(Debug)]
pub struct Lengths<'a>(pub &'a Distances<'a>);

impl Metric for Lengths<'_> {
    fn nodes(&self) -> usize {
        self.0.len()
    }

    #[inline]
    fn distance(&self, a: usize, b: usize) -> f64 {
        self.0.get(a, b)
    }
}
