//! Invariants of curves, held spans, the index and crossings, against brute force.

use argil_curve::{
    ArcSpan, ClosedCurve, CrossingKind, DVec2, PointIndex, Segment, SegmentIndex, gaps, held_spans,
    self_crossings,
};
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::TAU;

fn point(size: f64) -> impl Strategy<Value = DVec2> {
    (-size..size, -size..size).prop_map(|(x, y)| DVec2::new(x, y))
}

/// Points that often coincide, line up and repeat.
fn lattice_point() -> impl Strategy<Value = DVec2> {
    (-4..5, -4..5).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)))
}

fn scribble() -> impl Strategy<Value = ClosedCurve> {
    let points = prop_oneof![vec(point(6.0), 2..30), vec(lattice_point(), 2..30)];
    points.prop_filter_map("one point is no curve", |points| ClosedCurve::new(points).ok())
}

/// A wavy ring.
fn ring() -> impl Strategy<Value = ClosedCurve> {
    (8_usize..120, 2.0..9.0, 0.0..1.0, 2_i32..7, 0.0..TAU).prop_filter_map(
        "flat",
        |(n, radius, wave, lobes, phase)| {
            let at = |k: usize| {
                let angle = k as f64 / n as f64 * TAU;
                DVec2::from_angle(angle)
                    * radius
                    * (1.0 + 0.4 * wave * (f64::from(lobes) * angle + phase).sin())
            };
            ClosedCurve::new((0..n).map(at).collect()).ok()
        },
    )
}

fn curve() -> impl Strategy<Value = ClosedCurve> {
    prop_oneof![scribble(), ring()]
}

fn segments() -> impl Strategy<Value = Vec<Segment>> {
    let far = (point(6.0), point(300.0)).prop_map(|(a, b)| Segment::new(a, b));
    let near = (point(6.0), point(1.0)).prop_map(|(a, step)| Segment::new(a, a + step));
    let dot = point(6.0).prop_map(|a| Segment::new(a, a));
    vec(prop_oneof![1 => far, 6 => near, 1 => dot], 0..40)
}

fn cell() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(f64::NAN), Just(1e-9), Just(1e9), 0.1..5.0]
}

fn config() -> ProptestConfig {
    ProptestConfig { cases: 192, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn nearest_is_that_of_brute_force(segments in segments(), cell in cell(), p in point(9.0), scale in prop_oneof![Just(1.0), Just(1e5)]) {
        let p = p * scale;
        let least = segments.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
        let index = SegmentIndex::new(segments, cell);
        prop_assert_eq!(index.distance(p), least);
        if let Some(nearest) = index.nearest(p) {
            prop_assert_eq!(index.segments()[nearest.index].distance(p), least);
            prop_assert!((nearest.point.distance(p) - least).abs() <= 1e-9 * scale);
        }
    }

    #[test]
    fn nearest_within_keeps_to_the_radius(segments in segments(), cell in cell(), p in point(9.0), radius in 0.0..6.0) {
        let least = segments.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
        let index = SegmentIndex::new(segments, cell);
        let found = index.nearest_within(p, radius);
        prop_assert_eq!(found.map(|n| n.distance), Some(least).filter(|&least| least <= radius));
        prop_assert_eq!(index.is_within(p, radius), found.is_some());
        prop_assert_eq!(index.is_within(p, least), !index.is_empty());
    }

    #[test]
    fn each_near_segment_is_visited_once(segments in segments(), cell in cell(), ask in segments(), radius in 0.0..4.0) {
        let index = SegmentIndex::new(segments, cell);
        for query in ask {
            let mut seen = Vec::new();
            index.for_each_near(query, radius, |k, segment| {
                assert_eq!(index.segments()[k], segment);
                seen.push(k);
            });
            seen.sort_unstable();
            prop_assert!(seen.windows(2).all(|pair| pair[0] < pair[1]), "visited twice: {:?}", seen);
            for (k, segment) in index.segments().iter().enumerate() {
                if segment.distance_to(&query) <= radius {
                    prop_assert!(seen.binary_search(&k).is_ok(), "segment {} is near and was not visited", k);
                }
            }
        }
    }

    #[test]
    fn held_spans_agree_with_samples(curve in curve(), segments in segments(), across in 0.05..2.0) {
        let index = SegmentIndex::new(segments, 1.0);
        let held = held_spans(&curve, &index, across);
        let length = curve.length();
        for k in 0..1000 {
            let s = length * (f64::from(k) + 0.37) / 1000.0;
            let p = curve.point_at(s);
            let distance = index.segments().iter().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min);
            let said = held.iter().any(|span| span.contains(s, length));
            // At the limit itself either answer is right: an error of 1e-9 in arc length moves the distance
            // by less.
            if (distance - across).abs() > 2e-9 {
                prop_assert_eq!(said, distance < across, "at {} of {}: {} mm", s, length, distance);
            }
        }
    }

    #[test]
    fn held_spans_and_gaps_share_out_the_curve(curve in curve(), segments in segments(), across in 0.0..2.0) {
        let held = held_spans(&curve, &SegmentIndex::new(segments, 1.0), across);
        let free = gaps(curve.length(), &held);
        let sum = |spans: &[ArcSpan]| spans.iter().map(|span| span.length).sum::<f64>();
        prop_assert!((sum(&held) + sum(&free) - curve.length()).abs() < 1e-9 * (1.0 + curve.length()));
        for spans in [&held, &free] {
            prop_assert!(spans.windows(2).all(|pair| pair[0].end() < pair[1].start));
            prop_assert!(spans.iter().all(|span| span.start >= 0.0 && span.start < curve.length() && span.length >= 0.0));
            if let (Some(first), Some(last)) = (spans.first(), spans.last()) {
                prop_assert!(last.end() <= curve.length() + first.start + 1e-9);
            }
        }
    }

    #[test]
    fn arc_length_and_place_belong_together(curve in curve(), share in -2.0..3.0) {
        let length = curve.length();
        let s = share * length;
        let p = curve.point_at(s);
        let place = curve.locate(s);
        let arc = curve.arc_of(place.segment) + place.t * curve.segment(place.segment).length();
        prop_assert!(curve.arc_gap(arc, s) < 1e-9);
        prop_assert!(curve.nearest(p).distance < 1e-9);
        prop_assert!(curve.arc_gap(s, s + 0.25 * length) < 0.25 * length + 1e-9);
        prop_assert!(curve.point_at(s + 0.1).distance(p) < 0.1 + 1e-9);
    }

    #[test]
    fn no_sample_is_nearer_than_the_nearest_point(curve in curve(), p in point(9.0)) {
        let nearest = curve.nearest(p);
        prop_assert!((nearest.point.distance(p) - nearest.distance).abs() < 1e-9);
        prop_assert!(curve.point_at(nearest.s).distance(nearest.point) < 1e-9);
        let step = curve.length() / 500.0;
        let samples = curve.resampled(step);
        let least = samples.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
        prop_assert!(nearest.distance <= least + 1e-12 && least <= nearest.distance + step);
    }

    #[test]
    fn resampling_is_even(curve in curve(), step in 0.05..3.0) {
        let samples = curve.resampled(step);
        let spacing = curve.length() / samples.len() as f64;
        prop_assert!(spacing <= step * (1.0 + 1e-12) && samples.len() >= 6);
        prop_assert!(samples.len() == 6 || curve.length() / (samples.len() - 1) as f64 > step);
        for (k, sample) in samples.iter().enumerate() {
            prop_assert!(sample.distance(curve.point_at(k as f64 * spacing)) < 1e-9);
        }
    }

    #[test]
    fn rotation_changes_only_the_beginning(curve in curve(), share in 0.0..1.0) {
        let s = share * curve.length();
        let rotated = curve.rotated_to(s);
        prop_assert!((rotated.length() - curve.length()).abs() < 1e-9);
        prop_assert!(rotated.points()[0].distance(curve.point_at(s)) < 2e-9);
        prop_assert!((rotated.signed_area() - curve.signed_area()).abs() < 1e-6);
        prop_assert!(curve.points().iter().all(|p| rotated.points().contains(p)));
        for k in 0..20 {
            let further = f64::from(k) / 20.0 * curve.length();
            prop_assert!(rotated.point_at(further).distance(curve.point_at(s + further)) < 1e-8);
        }
    }

    #[test]
    fn reversal_turns_the_area_and_keeps_the_inside(curve in curve(), p in point(6.0)) {
        let back = ClosedCurve::new(curve.points().iter().rev().copied().collect()).unwrap();
        prop_assert!((back.signed_area() + curve.signed_area()).abs() < 1e-9);
        if curve.nearest(p).distance > 1e-9 {
            prop_assert_eq!(back.contains(p), curve.contains(p));
        }
    }

    #[test]
    fn crossings_are_those_of_all_pairs(curve in scribble()) {
        let points = curve.points();
        let found = self_crossings(points);
        let mut expected = Vec::new();
        for i in 0..points.len() {
            for j in i + 1..points.len() {
                if curve.segment(i).crosses(&curve.segment(j)) {
                    expected.push((i, j));
                }
            }
        }
        let proper: Vec<_> = found.iter().filter(|c| c.kind == CrossingKind::Proper).collect();
        prop_assert_eq!(proper.iter().map(|c| (c.first, c.second)).collect::<Vec<_>>(), expected);
        for c in &proper {
            prop_assert!(curve.segment(c.first).distance(c.point) < 1e-6 && curve.segment(c.second).distance(c.point) < 1e-6);
        }
        for c in found.iter().filter(|c| c.kind == CrossingKind::AtVertex) {
            prop_assert!(points[c.first].distance(points[c.second]) <= 1e-4);
        }
    }

    #[test]
    fn points_near_a_segment_are_those_within_the_radius(points in vec(point(20.0), 0..60), ends in [point(25.0), point(25.0)], cell in 0.01..9.0, radius in 0.0..8.0) {
        let segment = Segment::new(ends[0], ends[1]);
        let mut found = Vec::new();
        PointIndex::new(&points, cell).for_each_within(segment, radius, |k| found.push(k));
        found.sort_unstable();
        // What lies on the rim to the last bit may be either.
        let within = |margin: f64| (0..points.len()).filter(|&k| segment.distance(points[k]) <= radius + margin).collect::<Vec<_>>();
        prop_assert!(within(-1e-9).iter().all(|k| found.contains(k)));
        prop_assert!(found.iter().all(|k| within(1e-9).contains(k)));
        found.dedup();
        prop_assert!(found.len() <= within(1e-9).len());
    }

    #[test]
    fn boxes_tell_nothing_that_is_not_so(a in [point(9.0), point(9.0)], b in [point(9.0), point(9.0)], distance in 0.0..9.0) {
        let (a, b) = (Segment::new(a[0], a[1]), Segment::new(b[0], b[1]));
        prop_assert!(!a.is_boxed_beyond(&b, distance) || a.distance_to(&b) > distance);
        prop_assert_eq!(a.is_boxed_beyond(&b, distance), b.is_boxed_beyond(&a, distance));
    }

    /// Pulling the vertices of one strand a little to either side of a crossing at a shared vertex cannot
    /// undo it: a proper crossing appears near by on one side at least.
    #[test]
    fn a_crossing_at_a_vertex_survives_a_shift(angles in [0.0..TAU, 0.0..TAU, 0.0..TAU, 0.0..TAU], shift in 0.0..TAU) {
        let mut turned = angles;
        turned.sort_by(f64::total_cmp);
        let apart = (0..4).all(|k| (turned[(k + 1) % 4] - turned[k]).rem_euclid(TAU) > 0.2);
        prop_assume!(apart);
        let at = DVec2::from_angle;
        let first = [at(angles[0]), DVec2::ZERO, at(angles[1])];
        let second = [at(angles[2]), DVec2::ZERO, at(angles[3])];
        let strands: Vec<DVec2> = first.into_iter().chain(second).collect();
        // How the strands are joined far away adds other crossings, at other places.
        let at_vertex = self_crossings(&strands).iter().any(|c| c.kind == CrossingKind::AtVertex);
        let between = |a: f64| (a - angles[0]).rem_euclid(TAU) < (angles[1] - angles[0]).rem_euclid(TAU);
        prop_assert_eq!(at_vertex, between(angles[2]) != between(angles[3]));
        if at_vertex {
            let moved = DVec2::from_angle(shift) * 1e-3;
            let shifted = [second[0] + moved, moved, second[2] + moved];
            let pieces = |s: &[DVec2; 3]| [Segment::new(s[0], s[1]), Segment::new(s[1], s[2])];
            let crossed = pieces(&first).iter().any(|a| pieces(&shifted).iter().any(|b| a.distance_to(b) < 1e-12));
            prop_assert!(crossed);
        }
    }

    #[test]
    fn nothing_panics_on_odd_numbers(points in vec(prop_oneof![point(1.0), point(1e200), Just(DVec2::NAN), Just(DVec2::INFINITY)], 0..8), x in any::<f64>()) {
        let _ = self_crossings(&points);
        let segments: Vec<Segment> = points.windows(2).map(|p| Segment::new(p[0], p[1])).collect();
        let index = SegmentIndex::new(segments, x);
        let _ = index.nearest(DVec2::new(x, 0.0));
        let _ = index.nearest_within(DVec2::new(0.0, x), x);
        for segment in index.segments() {
            index.for_each_near(*segment, x, |_, other| { let _ = segment.part_within(&other, x); });
        }
        if let Ok(curve) = ClosedCurve::new(points) {
            let _ = (curve.point_at(x), curve.nearest(DVec2::splat(x)), curve.rotated_to(x), curve.contains(DVec2::splat(x)));
            let _ = held_spans(&curve, &index, x);
            if x > 1e-3 * curve.length() {
                let _ = curve.resampled(x);
            }
        }
    }
}
