//! Invariants of the relaxation over generated layers.

use argil_elastic::{Carrier, Clearance, DVec2, ElasticOptions, ElasticSolver, Path, Relaxed, Stop, relax};
use proptest::prelude::*;

/// Signed distance to a disc, the simplest safeguard.
#[derive(Debug)]
struct Disc {
    centre: DVec2,
    radius: f64,
}

impl Clearance for Disc {
    fn distance(&self, p: DVec2) -> (f64, DVec2) {
        let away = p - self.centre;
        (away.length() - self.radius, away.normalize_or_zero())
    }
}

/// A layer in mm: a round wall, left for one closed excursion with two lanes.
#[derive(Clone, Debug)]
struct Layer {
    points: Vec<DVec2>,
    fixed: Vec<bool>,
    felt: Vec<bool>,
    anchors: Vec<(usize, DVec2)>,
    centre: DVec2,
    radius: f64,
    width: f64,
    envelope: f64,
}

impl Layer {
    fn options(&self) -> ElasticOptions {
        ElasticOptions { envelope: self.envelope, ..ElasticOptions::for_width(self.width) }
    }

    fn carriers(&self) -> Vec<Carrier> {
        self.anchors.iter().map(|&(vertex, anchor)| Carrier { vertex, anchor }).collect()
    }

    fn relaxed(&self, options: &ElasticOptions) -> Relaxed {
        let disc = Disc { centre: self.centre, radius: self.radius };
        let carriers = self.carriers();
        let path = Path {
            points: &self.points,
            fixed: &self.fixed,
            carriers: &carriers,
            clear_of: Some(&disc),
            felt: &self.felt,
        };
        relax(&path, options).expect("generated layers are in order")
    }

    fn scaled(&self, factor: f64) -> Self {
        let grow = |p: &DVec2| *p * factor;
        Self {
            points: self.points.iter().map(grow).collect(),
            anchors: self.anchors.iter().map(|(v, a)| (*v, grow(a))).collect(),
            centre: self.centre * factor,
            radius: self.radius * factor,
            width: self.width * factor,
            envelope: self.envelope * factor,
            ..self.clone()
        }
    }
}

/// A wall of radius 6 mm and a corridor along `spine`, `gap` mm wide, that leaves the wall at angle zero.
fn layer(spine: &[DVec2], gap: f64, wobble: &[DVec2], anchor_every: usize, slack: DVec2) -> Layer {
    let width = 1.5;
    let radius = 6.0;
    let half = gap / 2.0 / radius;
    let mut points = Vec::new();
    let turn = std::f64::consts::TAU - 2.0 * half;
    for k in 0..=50 {
        points.push(DVec2::from_angle(half + turn * f64::from(k) / 50.0) * radius);
    }
    let mut fixed = vec![true; points.len()];
    // The outgoing lane is on the right of the spine, the returning one on its left.
    let mut line = vec![DVec2::new(radius, 0.0)];
    line.extend(spine.iter().scan(DVec2::new(radius, 0.0), |p, &d| {
        *p += d;
        Some(*p)
    }));
    let mut lanes = [Vec::new(), Vec::new()];
    for pair in line.windows(2) {
        let along = (pair[1] - pair[0]).normalize();
        let steps = (pair[0].distance(pair[1]) / (0.5 * width)).ceil() as usize;
        for s in 1..=steps {
            let p = pair[0].lerp(pair[1], s as f64 / steps as f64);
            lanes[0].push(p - along.perp() * gap / 2.0);
            lanes[1].push(p + along.perp() * gap / 2.0);
        }
    }
    lanes[1].reverse();
    let first = points.len();
    points.extend(lanes.concat());
    fixed.resize(points.len(), false);
    for (k, p) in points[first..].iter_mut().enumerate() {
        *p += wobble[k % wobble.len()];
    }
    let envelope = 0.3;
    let anchors =
        (first..points.len()).step_by(anchor_every).map(|v| (v, points[v] + slack * envelope)).collect();
    let felt = fixed.iter().map(|f| !f).collect();
    Layer { points, fixed, felt, anchors, centre: DVec2::ZERO, radius, width, envelope }
}

fn layers() -> impl Strategy<Value = Layer> {
    let hop = (2.0..9.0_f64, -1.2..1.2_f64).prop_map(|(length, angle)| DVec2::from_angle(angle) * length);
    let wobble = (-0.15..0.15_f64, -0.15..0.15_f64).prop_map(|(x, y)| DVec2::new(x, y));
    let slack = (0.0..0.9_f64, 0.0..6.3_f64).prop_map(|(r, a)| DVec2::from_angle(a) * r);
    (prop::collection::vec(hop, 1..5), 0.3..1.6_f64, prop::collection::vec(wobble, 7), 2..9_usize, slack)
        .prop_map(|(spine, gap, wobble, every, slack)| layer(&spine, gap, &wobble, every, slack))
}

fn side(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let c = |v: DVec2| robust::Coord { x: v.x, y: v.y };
    robust::orient2d(c(a), c(b), c(p))
}

/// All proper crossings by brute force, at least one edge of each with a free end.
fn crossings(points: &[DVec2], fixed: &[bool]) -> Vec<(usize, usize)> {
    let n = points.len();
    let free = |k: usize| !fixed[k] || !fixed[(k + 1) % n];
    let mut found = Vec::new();
    for i in 0..n {
        for j in i + 1..n {
            let (a, b, c, d) = (points[i], points[(i + 1) % n], points[j], points[(j + 1) % n]);
            let apart = |s: f64, t: f64| (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0);
            if (free(i) || free(j))
                && apart(side(a, b, c), side(a, b, d))
                && apart(side(c, d, a), side(c, d, b))
            {
                found.push((i, j));
            }
        }
    }
    found
}

fn to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let ab = b - a;
    let t = if ab == DVec2::ZERO { 0.0 } else { ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0) };
    p.distance(a.lerp(b, t))
}

/// Pairs of a free edge and a fixed one, more than two edges apart, that are nearer than `touch`, by brute force.
fn touches(points: &[DVec2], fixed: &[bool], touch: f64) -> Vec<(usize, usize)> {
    let n = points.len();
    let wall = |k: usize| fixed[k] && fixed[(k + 1) % n];
    let mut found = Vec::new();
    for i in (0..n).filter(|&i| !wall(i)) {
        for j in (0..n).filter(|&j| wall(j)) {
            let apart = i.abs_diff(j).min(n - i.abs_diff(j));
            let (a, b, c, d) = (points[i], points[(i + 1) % n], points[j], points[(j + 1) % n]);
            let gap = to_segment(a, c, d)
                .min(to_segment(b, c, d))
                .min(to_segment(c, a, b))
                .min(to_segment(d, a, b));
            if apart > 2 && gap < touch {
                found.push((i, j));
            }
        }
    }
    found
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_energy_never_rises(layer in layers()) {
        let mut last = f64::INFINITY;
        for cap in [0, 1, 2, 3, 5, 8, 12, 30] {
            let out = layer.relaxed(&ElasticOptions { max_iterations: cap, ..layer.options() });
            prop_assert!(out.energy_after <= out.energy_before);
            prop_assert!(out.energy_after <= last, "{} after {last} at cap {cap}", out.energy_after);
            prop_assert!(out.iterations <= cap);
            last = out.energy_after;
        }
    }

    #[test]
    fn fixed_vertices_keep_every_bit(layer in layers()) {
        let out = layer.relaxed(&layer.options());
        prop_assert_eq!(out.points.len(), layer.points.len());
        for ((p, q), fixed) in out.points.iter().zip(&layer.points).zip(&layer.fixed) {
            if *fixed {
                prop_assert_eq!((p.x.to_bits(), p.y.to_bits()), (q.x.to_bits(), q.y.to_bits()));
            }
        }
    }

    #[test]
    fn nothing_crosses_or_touches_that_did_not_before(layer in layers()) {
        let options = layer.options();
        let out = layer.relaxed(&options);
        let before = crossings(&layer.points, &layer.fixed);
        for pair in crossings(&out.points, &layer.fixed) {
            prop_assert!(before.contains(&pair), "{pair:?} cross now");
        }
        let touch = options.touch * options.width;
        // A hair less, since the brute-force distance rounds differently.
        let near = touches(&layer.points, &layer.fixed, touch * (1.0 + 1e-12));
        for pair in touches(&out.points, &layer.fixed, touch * (1.0 - 1e-12)) {
            prop_assert!(near.contains(&pair) || before.contains(&pair), "{pair:?} touch now");
        }
    }

    #[test]
    fn carriers_stay_within_the_envelope(layer in layers()) {
        let out = layer.relaxed(&layer.options());
        for (vertex, anchor) in &layer.anchors {
            prop_assert!(out.points[*vertex].distance(*anchor) < layer.envelope);
        }
    }

    #[test]
    fn a_larger_bead_relaxes_to_the_larger_path(layer in layers()) {
        let small = layer.relaxed(&layer.options());
        let large_layer = layer.scaled(20.0);
        let large = large_layer.relaxed(&large_layer.options());
        prop_assert_eq!(small.stop, large.stop);
        for (p, q) in small.points.iter().zip(&large.points) {
            prop_assert!(p.distance(*q / 20.0) <= 1e-6, "{p} and {}", *q / 20.0);
        }
    }

    #[test]
    fn memory_of_earlier_paths_changes_nothing(first in layers(), second in layers()) {
        let mut solver = ElasticSolver::new();
        for layer in [&first, &second, &first] {
            let disc = Disc { centre: layer.centre, radius: layer.radius };
            let carriers = layer.carriers();
            let path = Path { points: &layer.points, fixed: &layer.fixed, carriers: &carriers,
                clear_of: Some(&disc), felt: &layer.felt };
            prop_assert_eq!(solver.relax(&path, &layer.options()).unwrap(), layer.relaxed(&layer.options()));
        }
    }
}

#[test]
fn a_relaxed_corridor_is_shorter_and_its_lanes_are_apart() {
    let layer = layer(&[DVec2::new(12.0, 0.0)], 0.4, &[DVec2::ZERO], 8, DVec2::ZERO);
    let out = layer.relaxed(&layer.options());
    assert_ne!(out.stop, Stop::NoProgress);
    assert!(out.energy_after < 0.5 * out.energy_before);
    let n = out.points.len();
    let (a, b) = (out.points[51 + 7], out.points[n - 8]);
    assert!(a.distance(b) > 0.7, "{}", a.distance(b));
}
