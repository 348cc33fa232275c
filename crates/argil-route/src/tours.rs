//! The solver of tours, behind a narrow trait.

use argil_curve::DVec2;
use argil_graph::DistanceMatrix;
use argil_tour::{Metric, TourOptions, shortest_tour};

use crate::RouteError;

/// Distances along shortest paths among the stops of one tour.
#[derive(Clone, Debug, PartialEq)]
pub struct TourDistances {
    count: usize,
    lengths: Vec<f64>,
}

impl TourDistances {
    /// Those of some of the rows and columns of a matrix.
    pub(crate) fn new(distances: &DistanceMatrix, stops: &[usize]) -> Self {
        let lengths = stops.iter().flat_map(|&a| stops.iter().map(move |&b| distances.get(a, b))).collect();
        Self { count: stops.len(), lengths }
    }

    /// Those as the crow flies.
    pub(crate) fn straight(places: &[DVec2]) -> Self {
        let lengths = places.iter().flat_map(|a| places.iter().map(|b| a.distance(*b))).collect();
        Self { count: places.len(), lengths }
    }

    /// The order that a solver gives and the length of that tour.
    ///
    /// # Errors
    /// [`RouteError::Tour`] where the order is none.
    pub(crate) fn toured(
        &self,
        tours: &dyn Tours,
        start: Option<&[usize]>,
        options: &TourOptions,
    ) -> Result<(Vec<usize>, f64), RouteError> {
        let order = tours.order(self, start, options);
        let mut met = vec![false; self.count];
        let fresh = |&stop: &usize| met.get_mut(stop).is_some_and(|met| !std::mem::replace(met, true));
        if order.len() != self.count || !order.iter().all(fresh) {
            return Err(RouteError::Tour { stops: self.count, order });
        }
        let n = order.len();
        let length = (0..n).map(|k| self.distance(order[k], order[(k + 1) % n])).sum();
        Ok((order, length))
    }
}

impl Metric for TourDistances {
    fn nodes(&self) -> usize {
        self.count
    }

    #[inline]
    fn distance(&self, a: usize, b: usize) -> f64 {
        self.lengths[a * self.count + b]
    }

    fn row(&self, a: usize) -> Option<&[f64]> {
        Some(&self.lengths[a * self.count..(a + 1) * self.count])
    }
}

/// Finds short closed tours for a [`Router`](crate::Router).
///
/// Only the guess along straight lines, which says near which points walls are first met, is always argil's own.
///
/// # Example
/// ```
/// use argil_route::{Metric, TourDistances, TourOptions, Tours};
///
/// /// Always on to the nearest stop that is left.
/// struct NearestNext;
///
/// impl Tours for NearestNext {
///     fn order(&self, distances: &TourDistances, _: Option<&[usize]>, _: &TourOptions) -> Vec<usize> {
///         let mut left: Vec<usize> = (1..distances.nodes()).collect();
///         let mut order: Vec<usize> = (0..distances.nodes().min(1)).collect();
///         while let Some(&here) = order.last() {
///             let far = |stop: usize| distances.distance(here, stop);
///             let Some(k) = (0..left.len()).min_by(|&a, &b| far(left[a]).total_cmp(&far(left[b]))) else { break };
///             order.push(left.remove(k));
///         }
///         order
///     }
/// }
///
/// use argil_route::{DVec2, Demand, LayerInput, RouteSettings, Router, Wall};
/// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(DVec2::from);
/// let demands = [(14.0, 2.0), (14.0, 8.0)].map(|p| Demand { position: p.into(), anchors: Vec::new() });
/// let walls = [Wall { points: &square, parent: None }];
/// let layer = LayerInput { walls: &walls, demands: &demands, safeguard: &[], above: None, barred: &[] };
/// let router = Router::new(RouteSettings::default())?;
/// // So few stops leave no choice.
/// assert_eq!(router.cycle_with(&layer, &NearestNext)?, router.cycle(&layer)?);
/// # Ok::<(), argil_route::RouteError>(())
/// ```
pub trait Tours: Sync {
    /// All stops `0 .. distances.nodes()` in the order in which a short closed tour visits them, each once. `start` is such an
    /// order to begin from, where there is one.
    ///
    /// It may be asked from several threads at once, and must give the same for the same input if plans are to be the same.
    fn order(&self, distances: &TourDistances, start: Option<&[usize]>, options: &TourOptions) -> Vec<usize>;
}

/// Argil's own solver ([`argil_tour`]).
///
/// # Example
/// ```
/// use argil_route::{DVec2, LayerInput, RouteSettings, Router, ShortestTours, Wall};
/// let squares = [0.0, 20.0].map(|x| [(x, 0.0), (x + 9.0, 0.0), (x + 9.0, 9.0), (x, 9.0)].map(DVec2::from));
/// let walls = squares.each_ref().map(|points| Wall { points, parent: None });
/// let layer = LayerInput { walls: &walls, demands: &[], safeguard: &[], above: None, barred: &[] };
/// let router = Router::new(RouteSettings::for_width(1.5))?;
/// assert_eq!(router.cycle_with(&layer, &ShortestTours)?, router.cycle(&layer)?);
/// # Ok::<(), argil_route::RouteError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShortestTours;

impl Tours for ShortestTours {
    fn order(&self, distances: &TourDistances, start: Option<&[usize]>, options: &TourOptions) -> Vec<usize> {
        shortest_tour(distances, &[], start, options).order
    }
}
