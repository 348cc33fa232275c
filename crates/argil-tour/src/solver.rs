//! The search as a whole.

use crate::array_tour::ArrayTour;
use crate::candidates::CandidateLists;
use crate::construction::{GreedyEdge, mend};
use crate::exact::{HeldKarp, MOST_NODES};
use crate::or_3opt::{LocalSearch, WorkQueue};
use crate::random::SplitMix;
use crate::{Metric, Tour, TourOptions};

/// The memory of a search, kept from layer to layer.
///
/// A solver remembers nothing that changes a tour: the same call gives the same tour from a new solver.
#[derive(Clone, Debug, Default)]
pub struct TourSolver {
    candidates: CandidateLists,
    greedy: GreedyEdge,
    held_karp: HeldKarp,
    tour: ArrayTour,
    queue: WorkQueue,
    order: Vec<u32>,
}

impl TourSolver {
    /// A solver without memory yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Finds a short closed tour through all nodes of `metric`; see [`shortest_tour`].
    pub fn solve<M: Metric>(
        &mut self,
        metric: &M,
        candidates: &[Vec<u32>],
        start: Option<&[usize]>,
        options: &TourOptions,
    ) -> Tour {
        let n = metric.nodes();
        let distance = |a: u32, b: u32| metric.distance(a as usize, b as usize);
        if n <= options.exact_up_to.clamp(3, MOST_NODES) {
            self.held_karp.solve(metric, &mut self.order);
            return Tour::canonical(&self.order, distance);
        }
        self.candidates.build(metric, options.neighbours.max(1), candidates);
        match start {
            Some(start) => mend(metric, start, &mut self.order),
            None => self.greedy.construct(metric, &self.candidates, &mut self.order),
        }
        self.tour.set(&self.order);
        self.queue.reset(n);
        let length: f64 =
            (0..n).map(|k| distance(self.order[k], self.order[(k + 1) % n])).filter(|d| d.is_finite()).sum();
        let mut search = LocalSearch {
            metric,
            candidates: &self.candidates,
            tour: &mut self.tour,
            queue: &mut self.queue,
            least_gain: 1e-12 * length,
        };
        for &node in &self.order {
            search.queue.push(node);
        }
        search.descend(100 * n);
        search.iterate(options.kicks_per_node.saturating_mul(n), &mut SplitMix::new(options.seed));
        Tour::canonical(self.tour.order(), distance)
    }
}

/// Finds a short closed tour through all nodes of `metric`.
///
/// `candidates` may name, for each node, further nodes worth to be its neighbours on the tour, besides the
/// nearest ones: those whose Voronoi cells touch its own, for instance, without which the search is caught inside
/// dense patches. It may be empty, and entries that are no nodes are passed over. `start` is where the search
/// begins, or greedy construction if there is none; the tour is never longer than a `start` that visits every
/// node once. Another `start` is mended first.
///
/// # Complexity
/// O(n²) distances to find the nearest nodes; beyond that about O(n) for each kick a node, and memory in O(n).
///
/// # Example
/// ```
/// use argil_tour::{MatrixMetric, TourOptions, shortest_tour};
///
/// // Five stations along a wall at 0, 4, 1, 3 and 2 m.
/// let stations = [0.0_f64, 4.0, 1.0, 3.0, 2.0];
/// let distances: Vec<f64> = stations.iter().flat_map(|a| stations.map(|b| (a - b).abs())).collect();
/// let metric = MatrixMetric::new(5, &distances)?;
/// let tour = shortest_tour(&metric, &[], None, &TourOptions::default());
/// assert_eq!(tour.length, 8.0);
/// assert_eq!(tour.order[0], 0);
/// # Ok::<(), argil_tour::TourError>(())
/// ```
#[must_use]
pub fn shortest_tour<M: Metric>(
    metric: &M,
    candidates: &[Vec<u32>],
    start: Option<&[usize]>,
    options: &TourOptions,
) -> Tour {
    TourSolver::new().solve(metric, candidates, start, options)
}
