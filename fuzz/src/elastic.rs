use argil_elastic::{Carrier, Clearance, DVec2, ElasticOptions, Path, relax};

use crate::Draw;

#[derive(Debug)]
struct Disc(f64);

impl Clearance for Disc {
    fn distance(&self, p: DVec2) -> (f64, DVec2) {
        (p.length() - self.0, p.normalize_or_zero())
    }
}

/// Relaxes any closed polyline: what comes out is finite, of no higher energy, and keeps what must be kept.
pub fn elastic(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let envelope = draw.within(0.05, 1.0);
    let options =
        ElasticOptions { envelope, max_iterations: draw.below(20), ..ElasticOptions::for_width(1.5) };
    let disc = Disc(draw.within(0.0, 10.0));
    let kind = draw.below(3);
    let mut points: Vec<DVec2> = Vec::new();
    let (mut fixed, mut felt, mut carriers) = (Vec::new(), Vec::new(), Vec::new());
    while points.len() < 80 && !draw.is_empty() {
        let next = match (kind, points.last()) {
            (0, _) => draw.point(12.0),
            (1, _) => draw.lattice_point(8),
            // A wandering strand with steps about as long as the planner's.
            (_, last) => last.copied().unwrap_or(DVec2::X * 6.0) + draw.point(1.0),
        };
        let marks = draw.byte();
        fixed.push(marks & 3 == 0);
        felt.push(marks & 4 == 0);
        if marks & 24 == 0 {
            let off = DVec2::from_angle(draw.within(0.0, 6.3)) * draw.within(0.0, 0.99) * envelope;
            carriers.push(Carrier { vertex: points.len(), anchor: next + off });
        }
        points.push(next);
    }
    let clear_of: Option<&dyn Clearance> = if draw.flag() { None } else { Some(&disc) };
    let path = Path { points: &points, fixed: &fixed, carriers: &carriers, clear_of, felt: &felt };
    let relaxed = relax(&path, &options).expect("the path is one that the planner may ask for");
    assert_eq!(relaxed.points.len(), points.len());
    assert!(relaxed.iterations <= options.max_iterations);
    assert!(relaxed.points.iter().all(|p| p.is_finite()), "a point is not finite");
    let (before, after) = (relaxed.energy_before, relaxed.energy_after);
    assert!(after <= before, "the energy rises from {before} to {after}");
    for ((p, q), _) in relaxed.points.iter().zip(&points).zip(&fixed).filter(|(_, fixed)| **fixed) {
        assert_eq!(p.to_array().map(f64::to_bits), q.to_array().map(f64::to_bits), "a fixed vertex moved");
    }
    for carrier in &carriers {
        let off = relaxed.points[carrier.vertex].distance(carrier.anchor);
        assert!(off < envelope, "a carrier is {off} mm off, its envelope is {envelope} mm");
    }
}
