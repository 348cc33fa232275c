//! Dijkstra's algorithm on the flat arrays.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::{DistanceMatrix, PathGraph};

impl PathGraph {
    /// The lengths of shortest paths between all pairs of the vertices `among`, infinite where there is no
    /// path. Paths never pass through an attachment.
    pub fn distances(&self, among: &[u32]) -> DistanceMatrix {
        let mut lengths = Vec::with_capacity(among.len() * among.len());
        for &from in among {
            let (distance, _) = self.tree(from, None);
            let of = |v: u32| distance.get(v as usize).copied().unwrap_or(f64::INFINITY);
            lengths.extend(among.iter().map(|&to| of(to)));
        }
        DistanceMatrix::from_rows(among.len(), lengths)
    }

    /// A shortest path from one vertex to another with both ends, or none if there is no path. It never
    /// passes through an attachment. Among equally short paths the choice is the same on every run.
    pub fn path(&self, from: u32, to: u32) -> Option<Vec<u32>> {
        let (distance, previous) = self.tree(from, Some(to));
        if !distance.get(to as usize)?.is_finite() {
            return None;
        }
        let mut path = vec![to];
        let mut v = to;
        while v != from {
            v = previous[v as usize];
            path.push(v);
        }
        path.reverse();
        Some(path)
    }

    fn tree(&self, from: u32, to: Option<u32>) -> (Vec<f64>, Vec<u32>) {
        let mut distance = vec![f64::INFINITY; self.vertex_count()];
        let mut previous = vec![u32::MAX; self.vertex_count()];
        if from as usize >= self.vertex_count() {
            return (distance, previous);
        }
        // Lengths are not negative, so their bit patterns are ordered as they are.
        let mut queue = BinaryHeap::from([Reverse((0.0_f64.to_bits(), from))]);
        distance[from as usize] = 0.0;
        while let Some(Reverse((bits, v))) = queue.pop() {
            let here = f64::from_bits(bits);
            if here > distance[v as usize] {
                continue;
            }
            if Some(v) == to {
                break;
            }
            if v != from && self.is_attachment(v) {
                continue;
            }
            for (u, w) in self.neighbours(v) {
                if here + w < distance[u as usize] {
                    distance[u as usize] = here + w;
                    previous[u as usize] = v;
                    queue.push(Reverse(((here + w).to_bits(), u)));
                }
            }
        }
        (distance, previous)
    }
}
