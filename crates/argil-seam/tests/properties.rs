//! Invariants of the chain of starts.

use argil_curve::Segment;
use argil_seam::{ClosedCurve, DVec2, SeamError, SeamSettings, nearest_chain, seam_chain};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn config() -> ProptestConfig {
    ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() }
}

/// Layers that wobble and drift, with fingers as deep as the wobble makes them.
fn stack() -> impl Strategy<Value = Vec<ClosedCurve>> {
    (2_usize..25, 20_usize..90, 2.0..12.0, 0.0..0.9, 2_i32..12, -0.15..0.15, -0.2..0.2, -0.06..0.06)
        .prop_filter_map("flat", |(layers, n, radius, wave, lobes, turn, drift, grow)| {
            (0..layers)
                .map(|layer| {
                    let layer = layer as f64;
                    let at = |k: usize| {
                        let angle = k as f64 / n as f64 * TAU;
                        let lobe = f64::sin(f64::from(lobes) * angle + turn * layer);
                        DVec2::from_angle(angle) * radius * (1.0 + grow * layer / 10.0) * (1.0 + wave * lobe)
                            + DVec2::new(drift * layer, 0.0)
                    };
                    ClosedCurve::new((0..n).map(at).collect()).ok()
                })
                .collect()
        })
}

/// How the steps of a chain are judged.
#[derive(Clone, Copy, PartialEq)]
enum Rule {
    /// A step may touch the cycle anywhere, as long as it does not cross it.
    MayTouch,
    /// The rule of the crate: a step touches its own end, or runs along the strand that it ends on.
    Strict,
}

/// Whether the step that ends on the cycle at `s` is forbidden, once its end is a vertex.
fn is_barred(start: DVec2, cycle: &ClosedCurve, s: f64, rule: Rule) -> bool {
    let rotated = cycle.rotated_to(s);
    let end = rotated.points()[0];
    let step = Segment::new(start, end);
    let touches = |k: usize, strand: &Segment| {
        let contacts =
            [start, end].map(|p| strand.nearest(p).point).into_iter().chain([strand.start, strand.end]);
        contacts.filter(|contact| step.distance(*contact) <= 2e-4).any(|contact| {
            let arc = rotated.arc_of(k) + strand.start.distance(contact);
            rotated.arc_gap(arc, 0.0) > contact.distance(end) + 1e-3
        })
    };
    step.length() > 1e-9
        && rotated
            .segments()
            .enumerate()
            .any(|(k, strand)| step.crosses(&strand) || (rule == Rule::Strict && touches(k, &strand)))
}

/// The squared step from `start`, or infinity where the step is not allowed.
fn step_cost(
    start: DVec2,
    below: &ClosedCurve,
    cycle: &ClosedCurve,
    s: f64,
    settings: &SeamSettings,
    rule: Rule,
) -> f64 {
    let end = cycle.point_at(s);
    let length = start.distance(end);
    let allowed = length <= settings.reach
        && below.nearest(end).distance <= settings.across
        && !is_barred(start, cycle, s, rule);
    if allowed { length * length } else { f64::INFINITY }
}

fn chain_cost(
    cycles: &[ClosedCurve],
    starts: &[f64],
    settings: &SeamSettings,
    rule: Rule,
    extra: impl Fn(usize, DVec2) -> f64,
) -> f64 {
    let points: Vec<DVec2> = cycles.iter().zip(starts).map(|(cycle, &s)| cycle.point_at(s)).collect();
    let steps = (1..cycles.len())
        .map(|k| step_cost(points[k - 1], &cycles[k - 1], &cycles[k], starts[k], settings, rule));
    steps.sum::<f64>() + points.iter().enumerate().map(|(k, &p)| extra(k, p)).sum::<f64>()
}

fn arcs(cycle: &ClosedCurve, spacing: f64) -> Vec<f64> {
    let count = cycle.resampled(spacing).len();
    (0..count).map(|k| k as f64 * cycle.length() / count as f64).collect()
}

/// The least cost of all chains over the candidates, by trying every pair.
fn least_cost(
    cycles: &[ClosedCurve],
    settings: &SeamSettings,
    rule: Rule,
    extra: impl Fn(usize, DVec2) -> f64,
) -> f64 {
    let mut below: Vec<(DVec2, f64)> = Vec::new();
    for (layer, cycle) in cycles.iter().enumerate() {
        let reached = arcs(cycle, settings.spacing).into_iter().map(|s| {
            let p = cycle.point_at(s);
            let chain = match layer {
                0 => 0.0,
                _ => below
                    .iter()
                    .filter(|(q, cost)| cost.is_finite() && q.distance(p) <= settings.reach)
                    .map(|(q, cost)| cost + step_cost(*q, &cycles[layer - 1], cycle, s, settings, rule))
                    .fold(f64::INFINITY, f64::min),
            };
            (p, chain + extra(layer, p))
        });
        below = reached.collect();
    }
    below.iter().map(|(_, cost)| *cost).fold(f64::INFINITY, f64::min)
}

/// Each layer's candidate nearest to the start below, from one candidate of the lowest layer.
fn greedy(cycles: &[ClosedCurve], settings: &SeamSettings, first: usize) -> Vec<f64> {
    let mut starts: Vec<f64> = Vec::new();
    for (layer, cycle) in cycles.iter().enumerate() {
        let arcs = arcs(cycle, settings.spacing);
        let next = match layer {
            0 => arcs[first % arcs.len()],
            _ => {
                let below = cycles[layer - 1].point_at(starts[layer - 1]);
                let distance = |s: &f64| cycle.point_at(*s).distance(below);
                arcs.into_iter()
                    .min_by(|a, b| distance(a).total_cmp(&distance(b)))
                    .expect("cycles have candidates")
            }
        };
        starts.push(next);
    }
    starts
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn every_chain_is_sound_and_no_greedy_one_is_cheaper(cycles in stack(), firsts in proptest::array::uniform8(0_usize..1000), side in 0.0..TAU, weight in prop_oneof![Just(0.0), 0.0..0.2]) {
        let settings = SeamSettings { sharp: 0.0, ..SeamSettings::for_width(1.5) };
        let extra = |_: usize, p: DVec2| weight * (1.0 - (p.to_angle() - side).cos());
        let found = seam_chain(&cycles, &settings, &extra);
        let greedy_costs: Vec<f64> = firsts.iter().map(|&first| chain_cost(&cycles, &greedy(&cycles, &settings, first), &settings, Rule::Strict, extra)).collect();
        match found {
            Ok(starts) => {
                prop_assert_eq!(starts.len(), cycles.len());
                let cost = chain_cost(&cycles, &starts, &settings, Rule::MayTouch, extra);
                prop_assert!(cost.is_finite(), "a start that is not held, a step too long or a crossing");
                let best = greedy_costs.into_iter().fold(f64::INFINITY, f64::min);
                prop_assert!(cost <= best + 1e-9, "{} against {}", cost, best);
            }
            Err(SeamError::NoStep { layer, below, gap }) => {
                prop_assert!((cycles[layer].nearest(below).distance - gap).abs() < 1e-9);
                prop_assert!(greedy_costs.iter().all(|cost| cost.is_infinite()));
            }
            Err(other) => prop_assert!(false, "{}", other),
        }
    }

    #[test]
    fn no_chain_is_cheaper(cycles in stack(), spacing in 0.3..0.8, reach in 0.4..1.5, weight in prop_oneof![Just(0.0), 0.0..0.2]) {
        let settings = SeamSettings { spacing, reach, sharp: 0.0, ..SeamSettings::for_width(1.5) };
        let cycles = &cycles[..cycles.len().min(6)];
        let extra = |layer: usize, p: DVec2| weight * (p.x + 0.3 * layer as f64).sin().abs();
        let least = least_cost(cycles, &settings, Rule::MayTouch, extra);
        let strict = least_cost(cycles, &settings, Rule::Strict, extra);
        match seam_chain(cycles, &settings, &extra) {
            Ok(starts) => {
                let cost = chain_cost(cycles, &starts, &settings, Rule::MayTouch, extra);
                prop_assert!(cost > least - 1e-9 && cost < strict + 1e-9, "{} against {} to {}", cost, least, strict);
            }
            Err(_) => prop_assert_eq!(strict, f64::INFINITY),
        }
    }

    #[test]
    fn a_price_on_sharp_turns_never_brings_more_of_them(cycles in stack()) {
        let free = SeamSettings { sharp: 0.0, ..SeamSettings::for_width(1.5) };
        let plain = seam_chain(&cycles, &free, &|_, _| 0.0);
        let smooth = seam_chain(&cycles, &SeamSettings { sharp: 1.0, ..free }, &|_, _| 0.0);
        prop_assert_eq!(plain.is_ok(), smooth.is_ok());
        if let (Ok(plain), Ok(smooth)) = (plain, smooth) {
            prop_assert!(sharp_turns(&cycles, &smooth) <= sharp_turns(&cycles, &plain));
        }
    }

    #[test]
    fn the_greedy_rule_takes_nearest_points(cycles in stack()) {
        let starts = nearest_chain(&cycles);
        prop_assert_eq!(starts[starts.len() - 1], 0.0);
        for k in 1..cycles.len() {
            let above = cycles[k].point_at(starts[k]);
            let step = above.distance(cycles[k - 1].point_at(starts[k - 1]));
            prop_assert!((step - cycles[k - 1].nearest(above).distance).abs() < 1e-9);
        }
    }
}

/// Turns by more than 130° where layers end and begin.
fn sharp_turns(cycles: &[ClosedCurve], starts: &[f64]) -> usize {
    let mut walk: Vec<(DVec2, DVec2, DVec2)> = Vec::new();
    for (cycle, &start) in cycles.iter().zip(starts) {
        let loop_ = cycle.rotated_to(start);
        let points = loop_.points();
        walk.push((points[points.len() - 1], points[0], points[1]));
    }
    let is_sharp = |a: DVec2, b: DVec2| a.length() > 1e-6 && a.angle_to(b).abs().to_degrees() > 130.0;
    walk.windows(2)
        .map(|pair| {
            let ((before, end, _), (_, begin, after)) = (pair[0], pair[1]);
            let step = begin - end;
            if step.length() < 1e-4 {
                return usize::from(is_sharp(end - before, after - begin));
            }
            usize::from(is_sharp(end - before, step)) + usize::from(is_sharp(step, after - begin))
        })
        .sum()
}

/// Along a hairpin that retracts, the chain walks out on the lane that leads out.
#[test]
fn a_chain_takes_the_lane_that_leads_its_way() {
    let hairpin = |tip: f64| {
        ClosedCurve::new([(0.0, 0.0), (tip, 0.0), (tip, 1.0), (0.0, 1.0)].map(DVec2::from).to_vec()).unwrap()
    };
    for mirrored in [false, true] {
        let layers: Vec<ClosedCurve> = (0..12)
            .map(|k| {
                let curve = hairpin(2.0 + 0.9 * f64::from(k));
                if !mirrored {
                    return curve;
                }
                ClosedCurve::new(curve.points().iter().rev().copied().collect()).unwrap()
            })
            .collect();
        let top = layers.len() - 1;
        // The lowest layer begins at the foot, the highest at its tip.
        let cost = |layer: usize, p: DVec2| match layer {
            0 => p.x,
            k if k == top => 20.0 - p.x,
            _ => 0.0,
        };
        let settings = SeamSettings { reach: 1.5, ..SeamSettings::for_width(1.5) };
        let starts = seam_chain(&layers, &settings, &cost).unwrap();
        assert_eq!(sharp_turns(&layers, &starts), 0);
        let free = seam_chain(&layers, &SeamSettings { sharp: 0.0, ..settings }, &cost).unwrap();
        assert!(layers[top].point_at(free[top]).x > 5.0 && layers[top].point_at(starts[top]).x > 5.0);
    }
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> ClosedCurve {
    let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
    ClosedCurve::new(corners.map(DVec2::from).to_vec()).expect("four distinct corners")
}

#[test]
fn a_layer_out_of_reach_is_an_error_with_its_place() {
    let cycles =
        [rectangle(0.0, 0.0, 4.0, 4.0), rectangle(0.0, 0.0, 4.0, 4.0), rectangle(9.0, 0.0, 4.0, 4.0)];
    match seam_chain(&cycles, &SeamSettings::default(), &|_, _| 0.0) {
        Err(SeamError::NoStep { layer, below, gap }) => {
            assert_eq!((layer, gap), (2, 5.0));
            assert_eq!(below.x, 4.0);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_forbidden_layer_is_an_error() {
    let cycles = [rectangle(0.0, 0.0, 4.0, 4.0), rectangle(0.0, 0.0, 4.0, 4.0)];
    let settings = SeamSettings::default();
    assert_eq!(seam_chain(&cycles, &settings, &|_, _| f64::NAN), Err(SeamError::NoStart));
    let above = seam_chain(&cycles, &settings, &|layer, _| if layer == 1 { f64::INFINITY } else { 0.0 });
    assert!(matches!(above, Err(SeamError::NoStep { layer: 1, .. })));
}

#[test]
fn odd_settings_are_errors() {
    let settings = SeamSettings { reach: f64::NAN, ..SeamSettings::default() };
    assert!(matches!(seam_chain(&[], &settings, &|_, _| 0.0), Err(SeamError::Setting { name: "reach", .. })));
    assert_eq!(seam_chain(&[], &SeamSettings::default(), &|_, _| 0.0), Ok(vec![]));
}

#[test]
fn the_cost_moves_the_seam_to_the_cheap_side() {
    let tower: Vec<ClosedCurve> = (0..30).map(|_| rectangle(0.0, 0.0, 8.0, 8.0)).collect();
    let front = |_: usize, p: DVec2| if p.y < 4.0 { 1.0 } else { 0.0 };
    let starts = seam_chain(&tower, &SeamSettings::default(), &front).unwrap();
    assert!(tower.iter().zip(&starts).all(|(cycle, &s)| cycle.point_at(s).y >= 4.0));
}

/// Greedy from the top walks down the drifting finger; the only chain that is held all the way runs
/// elsewhere.
#[test]
fn the_chain_keeps_out_of_dead_ends() {
    // A wall that stands still, and a finger at its side that reaches 2 mm further with each layer.
    let layer = |reach: f64| {
        let points = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 2.0),
            (6.0 + reach, 2.0),
            (6.0 + reach, 4.0),
            (6.0, 4.0),
            (6.0, 6.0),
            (0.0, 6.0),
        ];
        ClosedCurve::new(points.map(DVec2::from).to_vec()).unwrap()
    };
    let cycles: Vec<ClosedCurve> =
        (1..10).map(|k| layer(2.0 * f64::from(k)).rotated_to(9.5 + 2.0 * f64::from(k))).collect();
    let settings = SeamSettings::default();
    assert!(
        chain_cost(&cycles, &nearest_chain(&cycles), &settings, Rule::MayTouch, |_, _| 0.0).is_infinite()
    );
    let starts = seam_chain(&cycles, &settings, &|_, _| 0.0).unwrap();
    assert!(chain_cost(&cycles, &starts, &settings, Rule::MayTouch, |_, _| 0.0) < 0.2);
}
