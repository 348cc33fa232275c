//! Invariants of support points: what they hold, where they stand, how many there are.

use argil_support::{
    ClosedCurve, Criterion, DVec2, Placement, Segment, SegmentIndex, SupportPoint, place_supports,
    stride_supports, unsupported_spans,
};
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::TAU;

const W: f64 = 1.5;

fn config() -> ProptestConfig {
    ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() }
}

fn point(size: f64) -> impl Strategy<Value = DVec2> {
    (-size..size, -size..size).prop_map(|(x, y)| DVec2::new(x, y))
}

/// A wavy ring, from one smaller than a bead to one of some hundred millimetres.
fn ring() -> impl Strategy<Value = ClosedCurve> {
    (6_usize..160, prop_oneof![0.05..2.0, 2.0..30.0], 0.0..1.0, 2_i32..9, 0.0..TAU).prop_filter_map(
        "flat",
        |(n, radius, wave, lobes, phase)| {
            let at = |k: usize| {
                let angle = k as f64 / n as f64 * TAU;
                DVec2::from_angle(angle)
                    * radius
                    * (1.0 + 0.8 * wave * (f64::from(lobes) * angle + phase).sin())
            };
            ClosedCurve::new((0..n).map(at).collect()).ok()
        },
    )
}

/// A tour back and forth in lanes, some so close that one point can hold two.
fn lanes() -> impl Strategy<Value = ClosedCurve> {
    (2_usize..9, 0.1..2.0, 3.0..25.0, 0.0..0.3).prop_filter_map("flat", |(rows, pitch, width, wave)| {
        let mut points = Vec::new();
        for row in 0..rows {
            for k in 0..=20 {
                let k = if row % 2 == 0 { k } else { 20 - k };
                let x = f64::from(k) / 20.0 * width;
                points.push(DVec2::new(x, row as f64 * pitch + wave * (x * 0.8).sin()));
            }
        }
        points.push(DVec2::new(-2.0, rows as f64 * pitch));
        points.push(DVec2::new(-2.0, 0.0));
        ClosedCurve::new(points).ok()
    })
}

fn scribble() -> impl Strategy<Value = ClosedCurve> {
    vec(point(8.0), 2..20).prop_filter_map("one point", |points| ClosedCurve::new(points).ok())
}

fn curve() -> impl Strategy<Value = ClosedCurve> {
    prop_oneof![3 => ring(), 3 => lanes(), 1 => scribble()]
}

fn walls() -> impl Strategy<Value = Vec<Segment>> {
    vec((point(25.0), point(12.0)).prop_map(|(a, step)| Segment::new(a, a + step)), 0..8)
}

fn criterion() -> impl Strategy<Value = Criterion> {
    prop_oneof![
        Just(Criterion::for_width(W)),
        (0.05..1.2, 0.5..5.0).prop_map(|(across, along)| Criterion { across, along })
    ]
}

fn index(segments: Vec<Segment>) -> SegmentIndex {
    SegmentIndex::new(segments, 1.0)
}

fn below(walls: &[Segment], at: impl Iterator<Item = DVec2>) -> SegmentIndex {
    index(walls.iter().copied().chain(at.map(|p| Segment::new(p, p))).collect())
}

proptest! {
    #![proptest_config(config())]

    /// The point of it all: whatever passes within the slack of every need holds the whole curve.
    #[test]
    fn any_path_within_the_slack_holds(
        curve in curve(), walls in walls(), criterion in criterion(), slack in 0.0..1.0,
        directions in vec(0.0..TAU, 1..40), shares in vec(prop_oneof![Just(1.0), 0.0..1.0], 1..40),
    ) {
        for placement in [Placement::for_criterion(W, &criterion), Placement::with_slack(W, &criterion, slack * criterion.across)] {
            let points = place_supports(&curve, &index(walls.clone()), &placement);
            let needs: Vec<DVec2> = points.iter().flat_map(|p| p.needs.iter().copied()).collect();
            let off = |k: usize, need: &DVec2| {
                need + DVec2::from_angle(directions[k % directions.len()]) * placement.slack * shares[k % shares.len()]
            };
            let path = below(&walls, needs.iter().enumerate().map(|(k, need)| off(k, need)));
            prop_assert_eq!(unsupported_spans(&curve, &path, &criterion), vec![]);
        }
    }

    /// The worst path passes each need at the full slack, and along the strand: away from one neighbour.
    #[test]
    fn a_path_displaced_along_the_strand_holds(curve in curve(), walls in walls(), criterion in criterion(), every in 1_usize..4) {
        let placement = Placement::for_criterion(W, &criterion);
        let points = place_supports(&curve, &index(walls.clone()), &placement);
        let needs = points.iter().flat_map(|p| p.needs.iter());
        let displaced = needs.enumerate().map(|(k, need)| {
            let segment = curve.segment(curve.nearest(*need).segment);
            let along = (segment.end - segment.start).normalize_or_zero();
            need + if (k / every) % 2 == 0 { along } else { -along } * placement.slack
        });
        let path = below(&walls, displaced);
        prop_assert_eq!(unsupported_spans(&curve, &path, &criterion), vec![]);
    }

    #[test]
    fn a_path_through_the_positions_holds(curve in curve(), walls in walls(), criterion in criterion()) {
        let placement = Placement::for_criterion(W, &criterion);
        let points = place_supports(&curve, &index(walls.clone()), &placement);
        for SupportPoint { position, needs } in &points {
            prop_assert!(needs.len() == 1 || needs.len() == 2);
            prop_assert!(needs.iter().all(|need| need.distance(*position) <= placement.slack));
            prop_assert!(needs.iter().all(|need| curve.nearest(*need).distance < 1e-9));
        }
        let path = below(&walls, points.iter().map(|p| p.position));
        prop_assert_eq!(unsupported_spans(&curve, &path, &criterion), vec![]);
    }

    #[test]
    fn no_point_stands_where_none_is_needed(curve in curve(), walls in walls()) {
        let placement = Placement::for_width(W);
        let index = index(walls);
        let points = place_supports(&curve, &index, &placement);
        let runs = unsupported_spans(&curve, &index, &Criterion { across: placement.across, along: placement.along });
        prop_assert_eq!(points.is_empty(), runs.is_empty());
        for need in points.iter().flat_map(|p| &p.needs) {
            prop_assert!(index.distance(*need) > placement.across - 1e-9, "a wall holds {}", need);
            // Strands may pass through one place, so some of the places near the need must lie on a run.
            let near = curve.segments().enumerate().map(|(k, _)| curve.on_segment(k, *need)).filter(|on| on.distance < 1e-6);
            let mut on_run = false;
            for on in near {
                on_run |= runs.iter().any(|run| run.contains(on.s + 1e-6, curve.length()) || run.contains(on.s - 1e-6, curve.length()));
            }
            prop_assert!(on_run);
        }
    }

    /// On one straight run of length l the count is the least n with 2 (along + held) + (n - 1) (along + 2
    /// held) >= l.
    #[test]
    fn a_straight_run_gets_the_fewest(length in 2.0..150.0, turn in 0.0..TAU) {
        let placement = Placement::for_width(W);
        let rotation = DVec2::from_angle(turn);
        let place = |x: f64, y: f64| rotation.rotate(DVec2::new(x, y));
        // A frame whose lower side hangs but for 5 mm at either end.
        let size = length + 10.0;
        let frame = [place(0.0, 0.0), place(size, 0.0), place(size, 9.0), place(0.0, 9.0)];
        let curve = ClosedCurve::new(frame.to_vec()).unwrap();
        let walls = [place(size - 5.0, 0.0), frame[1], frame[2], frame[3], frame[0], place(5.0, 0.0)];
        let walls = index(walls.windows(2).map(|e| Segment::new(e[0], e[1])).collect());
        let hanging = length - 2.0 * placement.across;
        let (between, at_end) = (placement.along + 2.0 * placement.held, placement.along + placement.held);
        let least = if hanging <= placement.along { 0.0 } else { 1.0 + f64::max((hanging - 2.0 * at_end) / between, 0.0).ceil() };
        prop_assert_eq!(place_supports(&curve, &walls, &placement).len() as f64, least);
    }

    #[test]
    fn a_round_run_gets_the_fewest(radius in 0.5..40.0) {
        let circle = ClosedCurve::new((0..400).map(|k| DVec2::from_angle(f64::from(k) / 400.0 * TAU) * radius).collect()).unwrap();
        let placement = Placement { tip_weight: 0.0, share_bonus: 0.0, ..Placement::for_width(W) };
        let points = place_supports(&circle, &index(Vec::new()), &placement);
        let between = placement.along + 2.0 * placement.held;
        prop_assert!(points.len() as f64 <= (circle.length() / between).ceil());
        prop_assert!(!points.is_empty());
    }

    #[test]
    fn everything_scales_with_the_bead(curve in prop_oneof![ring(), lanes()], walls in walls(), power in -3..6) {
        let scale = 2.0_f64.powi(power);
        let scaled = |s: &Segment| Segment::new(s.start * scale, s.end * scale);
        let large = ClosedCurve::new(curve.points().iter().map(|p| *p * scale).collect()).unwrap();
        let points = place_supports(&curve, &index(walls.clone()), &Placement::for_width(W));
        let scaled_walls = index(walls.iter().map(scaled).collect());
        let large_points = place_supports(&large, &scaled_walls, &Placement::for_width(W * scale));
        prop_assert_eq!(points.len(), large_points.len());
        for (point, large) in points.iter().zip(&large_points) {
            prop_assert!((point.position * scale).distance(large.position) < 1e-6 * scale);
        }
    }

    /// The letter of Eq. 1: every sample of the stride has a contact less than half a stride away.
    #[test]
    fn every_stride_finds_a_contact(curve in curve(), walls in walls(), criterion in criterion()) {
        let points = stride_supports(&curve, &index(walls.clone()), &criterion);
        let path = below(&walls, points.iter().map(|p| p.position));
        let held = argil_curve::held_spans(&curve, &path, criterion.across);
        for k in 0..(curve.length() / criterion.along).ceil() as usize {
            let s = k as f64 * criterion.along;
            let reached = held.iter().any(|span| {
                let ahead = (span.start - s).rem_euclid(curve.length());
                let behind = (s - span.end()).rem_euclid(curve.length());
                span.contains(s, curve.length()) || ahead.min(behind) < criterion.along / 2.0 + 1e-9
            });
            prop_assert!(reached, "sample {} at {}", k, s);
        }
    }

    #[test]
    fn odd_settings_are_harmless(curve in scribble(), x in any::<f64>(), field in 0..8) {
        let mut placement = Placement::for_width(W);
        match field {
            0 => placement.across = x,
            1 => placement.along = x,
            2 => placement.cover = x,
            3 => placement.held = x,
            4 => placement.share = x,
            5 => placement.tip_weight = x,
            6 => placement.apart = x,
            _ => placement.tip_reach = x,
        }
        let none = index(Vec::new());
        let points = place_supports(&curve, &none, &placement);
        prop_assert!(points.iter().all(|p| p.position.is_finite()));
        let criterion = Criterion { across: x, along: x };
        if !(x > 0.0 && x < 1e-3 * curve.length()) {
            let _ = stride_supports(&curve, &none, &criterion);
        }
        prop_assert_eq!(unsupported_spans(&curve, &none, &criterion).len(), 1);
    }
}

#[test]
fn a_tiny_loop_in_mid_air_gets_one_point() {
    let tiny = ClosedCurve::new(vec![DVec2::ZERO, DVec2::new(0.1, 0.0), DVec2::new(0.0, 0.1)]).unwrap();
    assert_eq!(place_supports(&tiny, &index(Vec::new()), &Placement::for_width(W)).len(), 1);
}

#[test]
fn a_short_loop_that_rests_somewhere_needs_nothing() {
    let small =
        ClosedCurve::new([(0.0, 0.0), (0.6, 0.0), (0.6, 0.5), (0.0, 0.5)].map(DVec2::from).to_vec()).unwrap();
    let wall = index(vec![Segment::new(DVec2::new(-1.0, 0.0), DVec2::new(-0.4, 0.0))]);
    assert!(place_supports(&small, &wall, &Placement::for_width(W)).is_empty());
}

#[test]
fn gaps_are_centred_on_a_hairpin() {
    // A finger 2 mm wide that reaches 5.5 mm beyond the wall; its tip hangs whatever stands below it at y =
    // 0.
    let points = [(-10.0, 0.0), (5.5, 0.0), (5.5, 0.6), (-10.0, 0.6)].map(DVec2::from);
    let finger = ClosedCurve::new(points.to_vec()).unwrap();
    let walls = [(0.0, 0.6), (-10.0, 0.6), (-10.0, 0.0), (0.0, 0.0)].map(DVec2::from);
    let walls = index(walls.windows(2).map(|e| Segment::new(e[0], e[1])).collect());
    let points = place_supports(&finger, &walls, &Placement::for_width(W));
    assert!(!points.is_empty());
    let tip = DVec2::new(5.5, 0.3);
    assert!(points.iter().flat_map(|p| &p.needs).all(|need| need.distance(tip) > 0.7), "{points:?}");
}

#[test]
fn one_point_serves_two_strands() {
    let points = [(0.0, 0.0), (20.0, 0.0), (20.0, 0.4), (0.0, 0.4)].map(DVec2::from);
    let lane = ClosedCurve::new(points.to_vec()).unwrap();
    let points = place_supports(&lane, &index(Vec::new()), &Placement::for_width(W));
    let shared = points.iter().filter(|p| p.needs.len() == 2).count();
    assert!(shared >= 5, "{points:?}");
    assert!(points.len() <= 10, "{points:?}");
}
