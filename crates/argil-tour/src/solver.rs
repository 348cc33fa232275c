//! The search as a whole.

use crate::array_tour::ArrayTour;
use crate::candidates::CandidateLists;
use crate::construction::{GreedyEdge, mend};
use crate::contraction::Contraction;
use crate::exact::{HeldKarp, MOST_NODES};
use crate::local_search::LocalSearch;
use crate::random::SplitMix;
use crate::remembered::{FEWEST_REMEMBERED, Memory, Remembered};
use crate::work_queue::WorkQueue;
use crate::{Metric, Tour, TourOptions};
use alloc::vec::Vec;

/// From this many nodes on, the tour through greedy paths comes first. Fewer nodes have no large features.
const FEWEST_CONTRACTED: usize = 100;

/// How many nodes there are to a path. With more, the paths decide too much; with fewer, the smaller search takes
/// as long as the large one.
const NODES_PER_PATH: usize = 10;

/// Ends of paths have at least this many nearest ends for candidates; the caller's candidates are nodes.
const NEAREST_ENDS: usize = 5;

/// The kicks that the smaller search spends a node.
const KICKS_PER_END: usize = 2;

/// Fewer nodes get the kicks of this many: whether a small tour is found depends on the number of kicks as such.
const FEWEST_BUDGETED: usize = 50;

/// The memory of a search, kept from layer to layer.
///
/// A solver remembers nothing that changes a tour: a new one would find the same.
///
/// # Example
/// ```
/// use argil_tour::{MatrixMetric, TourOptions, TourSolver};
///
/// let mut solver = TourSolver::new();
/// let options = TourOptions { exact_up_to: 3, ..TourOptions::default() };
/// // The corners of a square, numbered criss-cross; the layer below has the same.
/// let r = 2.0_f64.sqrt();
/// let distances = [0.0, r, 1.0, 1.0, r, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, r, 1.0, 1.0, r, 0.0];
/// let square = MatrixMetric::new(4, &distances)?;
/// let above = solver.solve(&square, &[], None, &options);
/// assert_eq!(above.order, [0, 2, 1, 3]);
/// let below = solver.solve(&square, &[], Some(&above.order), &options);
/// assert_eq!(below, above);
/// # Ok::<(), argil_tour::TourError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct TourSolver {
    nodes: Level,
    ends: Level,
    paths: GreedyEdge,
    contraction: Contraction,
    held_karp: HeldKarp,
    memory: Memory,
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
        if n <= options.exact_up_to.clamp(3, MOST_NODES) {
            self.held_karp.solve(metric, &mut self.nodes.order);
        } else if n < FEWEST_REMEMBERED {
            self.search(metric, candidates, start, options);
        } else {
            let mut memory = core::mem::take(&mut self.memory);
            memory.clear();
            self.search(&Remembered::new(metric, &mut memory), candidates, start, options);
            self.memory = memory;
        }
        Tour::canonical(&self.nodes.order, |a, b| metric.distance(a as usize, b as usize))
    }

    fn search<M: Metric>(
        &mut self,
        metric: &M,
        candidates: &[Vec<u32>],
        start: Option<&[usize]>,
        options: &TourOptions,
    ) {
        let n = metric.nodes();
        let mut random = SplitMix::new(options.seed);
        let neighbours = options.neighbours.max(usize::from(candidates.is_empty()));
        self.nodes.candidates.build(metric, neighbours, candidates);
        match start {
            Some(start) => mend(metric, start, &mut self.nodes.order),
            None if n < FEWEST_CONTRACTED => self.nodes.construct(metric),
            None => self.construct_by_paths(metric, neighbours, &mut random),
        }
        let [kicks, patience] =
            [options.kicks_per_node, options.patience_per_node].map(|each| kicks(each, n));
        self.nodes.search(metric, kicks, patience, &mut random);
    }

    /// Makes greedy paths, and of a short tour through them a tour of all nodes.
    fn construct_by_paths<M: Metric>(&mut self, metric: &M, neighbours: usize, random: &mut SplitMix) {
        let n = metric.nodes();
        self.paths.make_paths(n, &self.nodes.candidates, n / NODES_PER_PATH);
        self.contraction.set(&self.paths);
        let ends = self.contraction.metric(metric);
        // One of the nearest is the other end of the path, which is a neighbour already.
        let nearest = neighbours.max(NEAREST_ENDS) + 1;
        if n < FEWEST_REMEMBERED {
            self.ends.candidates.build(&ends, nearest, &[]);
        } else {
            let found = self.contraction.ends_near(&self.nodes.candidates, nearest);
            self.ends.candidates.build(&ends, 0, &found);
        }
        self.ends.construct(&ends);
        let kicks = KICKS_PER_END * ends.nodes();
        self.ends.search(&ends, kicks, kicks, random);
        self.contraction.expand(&self.ends.order, &self.paths, &mut self.nodes.order);
    }
}

/// What one local search works on.
#[derive(Clone, Debug, Default)]
struct Level {
    candidates: CandidateLists,
    greedy: GreedyEdge,
    tour: ArrayTour,
    queue: WorkQueue,
    /// The tour before and after the search.
    order: Vec<u32>,
}

impl Level {
    fn construct<M: Metric>(&mut self, metric: &M) {
        self.greedy.construct(metric, &self.candidates, &mut self.order);
    }

    fn search<M: Metric>(&mut self, metric: &M, kicks: usize, patience: usize, random: &mut SplitMix) {
        let n = metric.nodes();
        self.tour.set(&self.order, |a, b| metric.distance(a as usize, b as usize));
        self.queue.reset(n);
        let mut search = LocalSearch::new(metric, &self.candidates, &mut self.tour, &mut self.queue);
        for &node in &self.order {
            search.queue.push(node);
        }
        search.descend(100 * n);
        search.iterate(kicks, patience, random);
        self.order.clear();
        self.order.extend(self.tour.stops().iter().map(|stop| stop.node));
    }
}

/// The number of kicks for `n` nodes; a budget that is no positive number gives none.
fn kicks(per_node: f64, n: usize) -> usize {
    if per_node.is_finite() { (per_node * n.max(FEWEST_BUDGETED) as f64) as usize } else { 0 }
}

/// Finds a short closed tour through all nodes of `metric`.
///
/// `candidates` may name, for each node, further nodes worth to be its neighbours on the tour, besides the
/// nearest ones: those whose Voronoi cells touch its own, for instance, without which the search is caught inside
/// dense patches. It may be empty, and entries that are no nodes are passed over. `start` is where the search
/// begins, or greedy construction if there is none; the tour is never longer than a `start` that visits every
/// node once, but for rounding. Another `start` is mended first: what is missing is inserted.
///
/// # Complexity
/// O(n²) distances to find the nearest nodes, none if the caller names all candidates; beyond that the work is in the
/// number of kicks, each of which costs about the same at any n. From 2,000 nodes on distances are remembered, so that a
/// metric that makes them on demand is asked some hundred times a node. Memory is in O(n), and in O(2ⁿ n) for the few
/// nodes that are solved exactly.
///
/// # Example
/// ```
/// use argil_tour::{MatrixMetric, Tour, TourOptions, shortest_tour};
///
/// // Five stations along a wall at 0, 4, 1, 3 and 2 m.
/// let stations = [0.0_f64, 4.0, 1.0, 3.0, 2.0];
/// let distances: Vec<f64> = stations.iter().flat_map(|a| stations.map(|b| (a - b).abs())).collect();
/// let metric = MatrixMetric::new(5, &distances)?;
/// let tour: Tour = shortest_tour(&metric, &[], None, &TourOptions::default());
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
