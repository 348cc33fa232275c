//! Metrics whose shortest tours are known.

use argil_tour::{MatrixMetric, Metric, TourError, TourOptions, TourSolver, shortest_tour};

fn plane(points: &[(f64, f64)]) -> Vec<f64> {
    points.iter().flat_map(|a| points.iter().map(move |b| (a.0 - b.0).hypot(a.1 - b.1))).collect()
}

/// Numbers between 0 and 1, the same at every run.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn nothing_to_visit_and_little_to_choose() {
    for n in 0..4_usize {
        let distances = plane(&(0..n).map(|k| (k as f64, 0.0)).collect::<Vec<_>>());
        let metric = MatrixMetric::new(n, &distances).unwrap();
        let tour = shortest_tour(&metric, &[], None, &TourOptions::default());
        assert_eq!(tour.order, (0..n).collect::<Vec<_>>());
        assert_eq!(tour.length, 2.0 * n.saturating_sub(1) as f64);
    }
}

#[test]
fn nodes_on_a_circle_are_visited_in_turn() {
    for n in [20_usize, 90, 300] {
        // Numbered at random round the circle: k · 7 mod n goes through all, for 7 divides no n here.
        let angle = |k: usize| ((k * 7) % n) as f64 * std::f64::consts::TAU / n as f64;
        let distances = plane(&(0..n).map(|k| (angle(k).cos(), angle(k).sin())).collect::<Vec<_>>());
        let metric = MatrixMetric::new(n, &distances).unwrap();
        let tour = shortest_tour(&metric, &[], None, &TourOptions::default());
        let polygon = 2.0 * n as f64 * (std::f64::consts::PI / n as f64).sin();
        assert!((tour.length - polygon).abs() < 1e-9, "{n} nodes: {} instead of {polygon}", tour.length);
    }
}

#[test]
fn a_grid_is_toured_by_unit_steps() {
    let points: Vec<(f64, f64)> = (0..144).map(|k| (f64::from(k % 12), f64::from(k / 12))).collect();
    let distances = plane(&points);
    let metric = MatrixMetric::new(144, &distances).unwrap();
    let options = TourOptions { kicks_per_node: 10.0, patience_per_node: 10.0, ..TourOptions::default() };
    assert_eq!(shortest_tour(&metric, &[], None, &options).length, 144.0);
}

#[test]
fn a_search_without_success_ends_before_its_kicks_are_spent() {
    let points: Vec<(f64, f64)> = (0..100).map(|k| (f64::from(k % 10), f64::from(k / 10))).collect();
    let metric = Counting { points, asked: std::cell::Cell::new(0) };
    let asked = |patience_per_node: f64| {
        let options = TourOptions { kicks_per_node: 10.0, patience_per_node, ..TourOptions::default() };
        metric.asked.set(0);
        (shortest_tour(&metric, &[], None, &options).length, metric.asked.get())
    };
    let ((patient, all), (impatient, few), (none, least)) = (asked(10.0), asked(1.0), asked(0.0));
    assert!(patient == 100.0 && impatient == 100.0 && none >= 100.0);
    assert!(least < few && few < all / 2, "{least}, {few} and {all} distances");
}

/// Points of the plane that count how often they are asked.
struct Counting {
    points: Vec<(f64, f64)>,
    asked: std::cell::Cell<usize>,
}

impl Metric for Counting {
    fn nodes(&self) -> usize {
        self.points.len()
    }

    fn distance(&self, a: usize, b: usize) -> f64 {
        self.asked.set(self.asked.get() + 1);
        let (a, b) = (self.points[a], self.points[b]);
        (a.0 - b.0).hypot(a.1 - b.1)
    }
}

#[test]
fn a_large_tour_asks_for_few_of_all_distances() {
    // A grid in an order of its own, for 1,999 is prime to the number of nodes.
    let (columns, rows) = (64_usize, 50_usize);
    let n = columns * rows;
    let cell = |k: usize| (k * 1999) % n;
    let points = (0..n).map(|k| ((cell(k) % columns) as f64, (cell(k) / columns) as f64)).collect();
    let metric = Counting { points, asked: std::cell::Cell::new(0) };
    let mut node_at = vec![0; n];
    (0..n).for_each(|k| node_at[cell(k)] = k as u32);
    let beside = |k: usize| {
        let (x, y) = (cell(k) % columns, cell(k) / columns);
        let places = (y.max(1) - 1..(y + 2).min(rows))
            .flat_map(|v| (x.max(1) - 1..(x + 2).min(columns)).map(move |u| (u, v)));
        places
            .map(|(u, v)| node_at[v * columns + u])
            .filter(|&other| other as usize != k)
            .collect::<Vec<u32>>()
    };
    let candidates: Vec<Vec<u32>> = (0..n).map(beside).collect();
    let options = TourOptions { neighbours: 0, ..TourOptions::default() };
    let mut solver = TourSolver::new();
    let tour = solver.solve(&metric, &candidates, None, &options);
    let mut seen = vec![false; n];
    tour.order.iter().for_each(|&node| seen[node] = true);
    assert!(tour.order.len() == n && seen.into_iter().all(|seen| seen));
    assert!(tour.length >= n as f64 && tour.length < 1.03 * n as f64, "{} for {n} nodes", tour.length);
    assert!(metric.asked.get() < n * n / 4, "{} of {} distances", metric.asked.get(), n * n);
    // A solver that remembers another metric finds what a new one does.
    let moved =
        Counting { points: metric.points.iter().map(|p| (p.1, 3.0 * p.0)).collect(), asked: 0.into() };
    let again = solver.solve(&moved, &candidates, None, &options);
    assert_eq!(again, TourSolver::new().solve(&moved, &candidates, None, &options));
}

#[test]
fn the_search_finds_nearly_every_small_shortest_tour() {
    let mut solver = TourSolver::new();
    let mut next = noise(1);
    let mut missed = 0;
    for case in 0..100 {
        let n = 8 + case % 5;
        let points: Vec<(f64, f64)> = (0..n).map(|_| (next(), next())).collect();
        let distances = plane(&points);
        let metric = MatrixMetric::new(n, &distances).unwrap();
        let exact = solver.solve(&metric, &[], None, &TourOptions::default());
        let searched =
            solver.solve(&metric, &[], None, &TourOptions { exact_up_to: 0, ..TourOptions::default() });
        missed += usize::from(searched.length > exact.length + 1e-9);
    }
    assert!(missed <= 1, "{missed} of 100 tours are longer than the shortest");
}

#[test]
fn equal_points_cost_nothing() {
    let distances = vec![0.0; 300 * 300];
    let metric = MatrixMetric::new(300, &distances).unwrap();
    let tour = shortest_tour(&metric, &[], None, &TourOptions::default());
    assert_eq!(tour.length, 0.0);
    assert_eq!(tour.order.len(), 300);
}

/// Every path between two nodes leads through one junction, as at the mouth of a corridor.
struct Star(Vec<f64>);

impl Metric for Star {
    fn nodes(&self) -> usize {
        self.0.len()
    }

    fn distance(&self, a: usize, b: usize) -> f64 {
        if a == b { 0.0 } else { self.0[a] + self.0[b] }
    }
}

#[test]
fn all_tours_through_one_junction_are_equally_long() {
    let mut next = noise(2);
    let star = Star((0..400).map(|_| next()).collect());
    let tour = shortest_tour(&star, &[], None, &TourOptions::default());
    assert!((tour.length - 2.0 * star.0.iter().sum::<f64>()).abs() < 1e-9);
}

#[test]
fn the_layer_below_starts_from_the_tour_above() {
    let mut next = noise(3);
    let points: Vec<(f64, f64)> = (0..150).map(|_| (100.0 * next(), 100.0 * next())).collect();
    let distances = plane(&points);
    let metric = MatrixMetric::new(150, &distances).unwrap();
    let above = shortest_tour(&metric, &[], None, &TourOptions::default());
    // Below, ten supports are new; the numbers of the others stay.
    let more: Vec<(f64, f64)> =
        points.iter().copied().chain((0..10).map(|_| (100.0 * next(), 100.0 * next()))).collect();
    let distances = plane(&more);
    let metric = MatrixMetric::new(160, &distances).unwrap();
    let no_kicks = TourOptions { kicks_per_node: 0.0, ..TourOptions::default() };
    let below = shortest_tour(&metric, &[], Some(&above.order), &no_kicks);
    assert_eq!(below.order.len(), 160);
    let edges = |order: &[usize]| -> Vec<(usize, usize)> {
        let next = |k: usize| order[(k + 1) % order.len()];
        (0..order.len()).map(|k| (order[k].min(next(k)), order[k].max(next(k)))).collect()
    };
    let old = edges(&above.order);
    let kept = edges(&below.order).iter().filter(|edge| old.contains(edge)).count();
    assert!(kept >= 120, "only {kept} of 150 edges are kept");
}

/// What distances may not be: some are less than nothing. Entry `a * n + b` is that between `a` and `b` > `a`.
struct Debts {
    nodes: usize,
    entries: Vec<f64>,
}

impl Metric for Debts {
    fn nodes(&self) -> usize {
        self.nodes
    }

    fn distance(&self, a: usize, b: usize) -> f64 {
        self.entries[a.min(b) * self.nodes + a.max(b)]
    }
}

#[test]
fn distances_below_zero_do_not_keep_the_search_going() {
    // The tour as a whole is less than nothing, so that a loss may look like a gain above rounding.
    let options = TourOptions { exact_up_to: 0, ..TourOptions::default() };
    for seed in 0..40 {
        let mut next = noise(seed);
        let entries = (0..14 * 14).map(|_| if next() < 0.3 { -1e300 } else { 1e300 * next() }).collect();
        let tour = shortest_tour(&Debts { nodes: 14, entries }, &[], None, &options);
        assert_eq!(tour.order.len(), 14);
    }
}

#[test]
fn a_matrix_that_is_no_metric_is_refused() {
    assert_eq!(MatrixMetric::new(3, &[0.0; 8]).unwrap_err(), TourError::NotSquare { nodes: 3, entries: 8 });
    assert!(MatrixMetric::new(usize::MAX, &[]).is_err());
    for value in [-1.0, f64::INFINITY, f64::NAN] {
        let refused = MatrixMetric::new(2, &[0.0, 1.0, value, 0.0]).unwrap_err();
        assert!(matches!(refused, TourError::NotADistance { row: 1, column: 0, .. }), "{value}: {refused}");
    }
    let refused = MatrixMetric::new(2, &[0.0, 1.0, 2.0, 0.0]).unwrap_err();
    assert_eq!(refused.to_string(), "node 0 is 1 from node 1, but 2 the other way round");
}
