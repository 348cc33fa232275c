//! One tour through all walls of a region: where each wall is best met, and what it takes along.

use argil_curve::{ClosedCurve, DVec2, Segment};
use argil_tour::{Metric, TourOptions, shortest_tour};

use crate::excursion::{Excursion, Hops, Stops};

/// Straight-line distances: a first guess of the order in which walls are met.
struct Straight<'a>(&'a [DVec2]);

impl Metric for Straight<'_> {
    fn nodes(&self) -> usize {
        self.0.len()
    }

    fn distance(&self, a: usize, b: usize) -> f64 {
        self.0[a].distance(self.0[b])
    }
}

/// Rounds of tour and adjustment; the places settle after two.
const ROUNDS: usize = 3;

/// The arc at which each wall is met by one tour through all of them and through the demands.
///
/// Begins at the place nearest to the middle of all, then alternates between a tour through the places and
/// moving each place to the point of its wall that is nearest to the line between its neighbours.
pub(crate) fn meeting_places(walls: &[&ClosedCurve], demands: &[DVec2], options: &TourOptions) -> Vec<f64> {
    let all: Vec<DVec2> =
        walls.iter().flat_map(|w| w.points().iter().copied()).chain(demands.iter().copied()).collect();
    let middle = all.iter().sum::<DVec2>() / all.len().max(1) as f64;
    let mut arcs: Vec<f64> = walls.iter().map(|w| w.nearest(middle).s).collect();
    // The order is a guess along straight lines; the search for the last per cent is for the tour that is walked.
    let rough = TourOptions { kicks_per_node: 0.0, ..*options };
    for _ in 0..ROUNDS {
        let met = walls.iter().zip(&arcs).map(|(w, &s)| w.point_at(s));
        let places: Vec<DVec2> = met.chain(demands.iter().copied()).collect();
        let order = shortest_tour(&Straight(&places), &[], None, &rough).order;
        let n = order.len();
        if n < 3 {
            break;
        }
        for (k, &node) in order.iter().enumerate().filter(|(_, node)| **node < walls.len()) {
            let line = Segment::new(places[order[(k + n - 1) % n]], places[order[(k + 1) % n]]);
            arcs[node] = nearest_to(walls[node], line);
        }
    }
    arcs
}

/// Moves excursions into a tour that has to be walked anyway, the one that saves most first, for as long as that saves; the rest
/// is given back. What is put into the tour counts `ring` times its length: a tour has no tip, so that its strand dies
/// only where a wall comes near, while an excursion gets shorter with every layer.
///
/// # Complexity
/// O(E² (E + T)) for E excursions and a tour of T stops.
pub(crate) fn taken_along<H: Hops>(
    tour: &mut Vec<usize>,
    mut excursions: Vec<Excursion>,
    stops: &Stops<'_, H>,
    ring: f64,
) -> Vec<Excursion> {
    let direct = |a: usize, b: usize| stops.hops.whole(a, b);
    let distance = |a: usize, b: usize| direct(a, b).unwrap_or(f64::INFINITY);
    let saving = |tour: &[usize], excursion: &Excursion| {
        let [first, last] = excursion.ends();
        let places = (0..tour.len()).flat_map(|k| {
            let (a, b) = (tour[k], tour[(k + 1) % tour.len()]);
            let hop = direct(a, b).unwrap_or_else(|| stops.hops.at_least(a, b));
            let detour = |first, last| distance(a, first) + distance(last, b) - hop;
            [(detour(first, last), k + 1, false), (detour(last, first), k + 1, true)]
        });
        let (detour, at, turned) = places.min_by(|p, q| p.0.total_cmp(&q.0))?;
        Some((stops.cost_of(excursion) - ring * (detour + excursion.length()), at, turned))
    };
    loop {
        let best = excursions
            .iter()
            .enumerate()
            .filter_map(|(k, excursion)| {
                saving(tour, excursion).map(|(saved, at, turned)| (saved, k, at, turned))
            })
            .filter(|best| best.0 > 0.0)
            .max_by(|p, q| p.0.total_cmp(&q.0));
        let Some((_, k, at, turned)) = best else { return excursions };
        let mut chain = excursions.remove(k).stops;
        if turned {
            chain.reverse();
        }
        tour.splice(at..at, chain);
    }
}

/// The arc of the curve's vertex or of the line's ends' projection that comes nearest to the line.
fn nearest_to(curve: &ClosedCurve, line: Segment) -> f64 {
    let detour = |p: DVec2| p.distance(line.start) + p.distance(line.end);
    let mut best = (f64::INFINITY, 0.0);
    let projections = [line.start, line.end, line.point_at(0.5)].map(|p| curve.nearest(p).s);
    let vertices = curve.points().iter().enumerate().map(|(k, &p)| (curve.arc_of(k), p));
    for (s, p) in projections.map(|s| (s, curve.point_at(s))).into_iter().chain(vertices) {
        let cost = detour(p);
        if cost < best.0 {
            best = (cost, s);
        }
    }
    best.1
}
