//! Invariants of paths that are pulled taut.

use argil_curve::{Segment, gaps, held_spans, self_crossings};
use argil_taut::{ClosedCurve, DVec2, SegmentIndex, SlackPath, TautOptions, pulled_taut};
use proptest::prelude::*;

/// A wall with fingers of strand that leave it, and the same a little longer above it.
#[derive(Clone, Debug)]
struct Comb {
    points: Vec<DVec2>,
    fixed: Vec<bool>,
    above: Vec<DVec2>,
}

/// A finger: the way along the wall to it, its length, half its width, its lean.
type Finger = (f64, f64, f64, f64);

fn comb(fingers: &[Finger], shift: f64, w: f64) -> Comb {
    let (mut points, mut fixed, mut above) = (Vec::new(), Vec::new(), Vec::new());
    let mut push = |x: f64, y: f64, free: bool, moved: f64| {
        points.push(DVec2::new(x, y) * w);
        fixed.push(!free);
        above.push(DVec2::new(x + moved, y + moved) * w);
    };
    let mut x = 0.0;
    for &(gap, length, half, lean) in fingers {
        x += gap + half;
        push(x - half, 0.0, false, 0.0);
        let steps = (length / 0.5).ceil() as i32;
        for k in 1..=steps {
            let t = f64::from(k) / f64::from(steps);
            push(x - half + lean * t, length * t, true, shift * t);
        }
        for k in (1..=steps).rev() {
            let t = f64::from(k) / f64::from(steps);
            push(x + half + lean * t, length * t, true, shift * t);
        }
        push(x + half, 0.0, false, 0.0);
        x += half;
    }
    push(x + 3.0, 0.0, false, 0.0);
    push(x + 3.0, -6.0, false, 0.0);
    push(-3.0, -6.0, false, 0.0);
    push(-3.0, 0.0, false, 0.0);
    Comb { points, fixed, above }
}

fn combs() -> impl Strategy<Value = (Comb, f64)> {
    let finger = (2.0..5.0, 0.6..8.0, 0.3..0.9, -0.8..0.8);
    (prop::collection::vec(finger, 1..5), -0.15..0.15, prop_oneof![Just(1.5), Just(0.4), Just(30.0)])
        .prop_map(|(fingers, shift, w)| (comb(&fingers, shift, w), w))
        .prop_filter("the comb crosses itself", |(comb, _)| self_crossings(&comb.points).is_empty())
}

fn walls(comb: &Comb, w: f64) -> SegmentIndex {
    let n = comb.points.len();
    let walls = (0..n).filter(|&k| comb.fixed[k] && comb.fixed[(k + 1) % n]);
    SegmentIndex::new(walls.map(|k| Segment::new(comb.points[k], comb.points[(k + 1) % n])).collect(), w)
}

/// The points as a curve; combs have more than two.
fn curve(points: &[DVec2]) -> ClosedCurve {
    ClosedCurve::new(points.to_vec()).expect("a comb is a curve")
}

fn taut(comb: &Comb, w: f64, starts: &[DVec2]) -> Vec<DVec2> {
    let above = curve(&comb.above);
    let felt = vec![false; comb.points.len()];
    let path = SlackPath {
        points: &comb.points,
        fixed: &comb.fixed,
        above: Some(&above),
        starts,
        walls: &walls(comb, w),
        clear_of: None,
        felt: &felt,
    };
    pulled_taut(&path, &TautOptions::for_width(w))
}

fn longest_gap(above: &[DVec2], below: &[DVec2], across: f64) -> f64 {
    let above = curve(above);
    let below = curve(below);
    let index = SegmentIndex::of_curves([&below], across);
    gaps(above.length(), &held_spans(&above, &index, across)).iter().map(|g| g.length).fold(0.0, f64::max)
}

fn length(points: &[DVec2]) -> f64 {
    (0..points.len()).map(|k| points[k].distance(points[(k + 1) % points.len()])).sum()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_was_held_stays_held((comb, w) in combs()) {
        let taut = taut(&comb, w, &[]);
        let (across, along) = (0.3 * w, 1.6 * w);
        let before = longest_gap(&comb.above, &comb.points, across);
        prop_assert!(longest_gap(&comb.above, &taut, across) <= along.max(before) + 1e-9 * w);
    }

    #[test]
    fn fixed_points_keep_every_bit_and_nothing_crosses((comb, w) in combs()) {
        let taut = taut(&comb, w, &[]);
        prop_assert_eq!(taut.len(), comb.points.len());
        for ((after, before), fixed) in taut.iter().zip(&comb.points).zip(&comb.fixed) {
            prop_assert!(!fixed || after == before);
        }
        prop_assert!(self_crossings(&taut).is_empty());
    }

    #[test]
    fn scale_changes_nothing((comb, w) in combs()) {
        let scaled = |p: &[DVec2]| p.iter().map(|&p| 2.0 * p).collect::<Vec<_>>();
        let large = Comb { points: scaled(&comb.points), above: scaled(&comb.above), fixed: comb.fixed.clone() };
        prop_assert_eq!(scaled(&taut(&comb, w, &[])), taut(&large, 2.0 * w, &[]));
    }

    #[test]
    fn a_start_stays_held((comb, w) in combs(), at in 0.0..1.0) {
        let above = curve(&comb.above);
        let start = above.point_at(at * above.length());
        let below = |points: &[DVec2]| SegmentIndex::of_curves([&curve(points)], w);
        let across = 0.985 * 0.3 * w;
        prop_assume!(below(&comb.points).distance(start) <= across);
        prop_assert!(below(&taut(&comb, w, &[start])).distance(start) <= 0.3 * w);
    }
}

/// A lone finger gets shorter by more than half a bead, and not by more than the rule allows.
#[test]
fn a_tip_retracts() {
    for w in [0.4, 1.5, 30.0] {
        let comb = comb(&[(3.0, 8.0, 0.5, 0.0)], 0.0, w);
        let taut = taut(&comb, w, &[]);
        let tip = |points: &[DVec2]| points.iter().map(|p| p.y / w).fold(0.0, f64::max);
        let retracted = tip(&comb.points) - tip(&taut);
        assert!((0.4..1.1).contains(&retracted), "{retracted} w");
        assert!(length(&taut) < length(&comb.points) - 0.8 * w);
    }
}

/// Two strands that lie in each other's bead are parted where the rule lets them.
#[test]
fn crowded_strands_are_parted() {
    let w = 1.5;
    let comb = comb(&[(3.0, 8.0, 0.9, 0.0), (0.3, 8.0, 0.9, 0.0)], 0.0, w);
    // Halfway up, the strand on the right of the first finger and that on the left of the second.
    let between = |points: &[DVec2]| points[25].distance(points[42]) / w;
    let taut = taut(&comb, w, &[]);
    assert!(between(&comb.points) < 0.31);
    assert!(between(&taut) > 0.5, "{} w", between(&taut));
}

#[test]
fn what_cannot_be_pulled_is_given_back() {
    let comb = comb(&[(3.0, 4.0, 0.5, 0.0)], 0.0, 1.5);
    let walls = walls(&comb, 1.5);
    let path = SlackPath {
        points: &comb.points,
        fixed: &comb.fixed,
        above: None,
        starts: &[],
        walls: &walls,
        clear_of: None,
        felt: &[],
    };
    assert_eq!(pulled_taut(&path, &TautOptions::for_width(1.5)), comb.points, "flags of another length");
    let felt = vec![false; comb.points.len()];
    let odd = TautOptions { along: f64::NAN, ..TautOptions::for_width(1.5) };
    assert_eq!(pulled_taut(&SlackPath { felt: &felt, ..path }, &odd), comb.points);
}
