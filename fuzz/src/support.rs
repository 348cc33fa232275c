use argil_curve::{ClosedCurve, Segment, SegmentIndex, gaps, held_spans};
use argil_support::{Criterion, Placement, place_supports, unsupported_spans};

use crate::Draw;

/// Held spans agree with samples and share out the curve with their gaps, and placed points hold what hangs.
pub fn support(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let on_lattice = draw.flag();
    let across = draw.within(0.05, 2.0);
    let cell = [1.0, 0.0, 1e9, 0.3][draw.below(4)];
    let point = |draw: &mut Draw<'_>| if on_lattice { draw.lattice_point(5) } else { draw.point(8.0) };
    let points: Vec<_> = (0..2 + draw.below(30)).map(|_| point(&mut draw)).collect();
    let Ok(curve) = ClosedCurve::new(points) else { return };
    let mut segments = Vec::new();
    while segments.len() < 30 && !draw.is_empty() {
        segments.push(Segment::new(point(&mut draw), point(&mut draw)));
    }
    let walls = SegmentIndex::new(segments.clone(), cell);
    spans_are_exact(&curve, &walls, across);

    let criterion = Criterion { across, along: draw.within(0.5, 5.0) };
    let supports = place_supports(&curve, &walls, &Placement::for_criterion(1.5, &criterion));
    segments.extend(supports.iter().map(|support| Segment::new(support.position, support.position)));
    let hanging = unsupported_spans(&curve, &SegmentIndex::new(segments, 1.0), &criterion);
    assert!(hanging.is_empty(), "{hanging:?} still hang");
}

fn spans_are_exact(curve: &ClosedCurve, walls: &SegmentIndex, across: f64) {
    let length = curve.length();
    let held = held_spans(curve, walls, across);
    let free = gaps(length, &held);
    let all: f64 = held.iter().chain(&free).map(|span| span.length).sum();
    assert!((all - length).abs() <= 1e-6 * (1.0 + length), "spans and gaps are {all} of {length} mm");
    assert!(held.windows(2).all(|pair| pair[0].end() <= pair[1].start), "{held:?} overlap");
    for k in 0..200 {
        let s = length * (f64::from(k) + 0.37) / 200.0;
        let p = curve.point_at(s);
        let distance = walls.segments().iter().map(|wall| wall.distance(p)).fold(f64::INFINITY, f64::min);
        let said = held.iter().any(|span| span.contains(s, length));
        // At the limit itself either answer is right.
        assert!(
            (distance - across).abs() <= 1e-8 || said == (distance < across),
            "{p}, {distance} mm: {said}"
        );
    }
}
