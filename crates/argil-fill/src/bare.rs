//! What stays bare: discs that no bead touches, and how much there is of it.

use argil_curve::{DVec2, SegmentIndex};
use geo_types::MultiPolygon;

use crate::offset::{ring_points, rings};

/// A disc inside of the region that no bead touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BareDisc {
    /// Its middle, mm.
    pub centre: DVec2,
    /// Its diameter, mm.
    pub diameter: f64,
}

/// What a look at a grid of points has found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scan {
    /// Area that a bead could reach and none does, mm².
    pub(crate) bare: f64,
    /// Discs wider than the limit, widest first, no two of them overlapping.
    pub(crate) discs: Vec<BareDisc>,
}

/// Distance of the points that are looked at, in w, and at least so many of them.
const STEP: f64 = 0.3;
const LEAST_POINTS: f64 = 3000.0;

/// A disc's middle is looked for with steps from and down to these, in w.
const LARGEST_STEP: f64 = 0.2;
const SMALLEST_STEP: f64 = 0.01;

/// Looks for what the strand leaves bare of `core`, the places where the middle of a bead may be.
///
/// What lies farther out than the core is reached by a bead along the core's edge or by none, so nothing else can be bare.
///
/// # Complexity
/// O(area / step²) nearest-segment queries.
pub(crate) fn scan(
    core: &MultiPolygon<f64>,
    area: f64,
    strand: &SegmentIndex,
    width: f64,
    limit: f64,
) -> Scan {
    let step = (STEP * width).min((area / LEAST_POINTS).sqrt());
    let sides: Vec<(DVec2, DVec2)> = core
        .iter()
        .flat_map(rings)
        .flat_map(|ring| {
            let points = ring_points(ring);
            (0..points.len()).map(|k| (points[k], points[(k + 1) % points.len()])).collect::<Vec<_>>()
        })
        .collect();
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (from, _) in &sides {
        (low, high) = (low.min(from.y), high.max(from.y));
    }
    let mut found = Scan::default();
    if !(step > 0.0 && low <= high) {
        return found;
    }
    let least = 0.5 * (width + limit);
    // The point nearest to a disc's middle is at most half a diagonal away from it.
    let suspicious = least - std::f64::consts::FRAC_1_SQRT_2 * step;
    let mut crossings: Vec<f64> = Vec::new();
    let rows = ((high - low) / step).ceil().min(1e6) as usize;
    for row in 0..rows {
        let y = low + (row as f64 + 0.5) * step;
        crossings.clear();
        for (from, to) in &sides {
            if (from.y > y) != (to.y > y) {
                crossings.push(from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y));
            }
        }
        crossings.sort_by(f64::total_cmp);
        for span in crossings.chunks_exact(2) {
            let first = (span[0] / step).ceil() as i64;
            let last = (span[1] / step).floor() as i64;
            for column in first..=last {
                let at = DVec2::new(column as f64 * step, y);
                let distance = distance_to(strand, at, width);
                if distance > 0.5 * width {
                    found.bare += step * step;
                }
                if distance > suspicious {
                    found.discs.extend(climbed(at, distance, strand, width, least));
                }
            }
        }
    }
    found.discs.retain(|disc| holds(&sides, disc.centre));
    found.discs.sort_by(|a, b| b.diameter.total_cmp(&a.diameter));
    let mut apart: Vec<BareDisc> = Vec::new();
    for disc in found.discs {
        let clear =
            |other: &BareDisc| other.centre.distance(disc.centre) > 0.5 * (other.diameter + disc.diameter);
        if apart.iter().all(clear) {
            apart.push(disc);
        }
    }
    found.discs = apart;
    found
}

/// Distance to the strand; more than three beads are as good as three.
fn distance_to(strand: &SegmentIndex, p: DVec2, width: f64) -> f64 {
    let near = [1.0, 3.0].into_iter().find_map(|reach| strand.nearest_within(p, reach * width));
    near.map_or(3.0 * width, |near| near.distance)
}

/// The disc to which the distance from the strand rises, if it is wide enough.
fn climbed(from: DVec2, distance: f64, strand: &SegmentIndex, width: f64, least: f64) -> Option<BareDisc> {
    let (mut at, mut best, mut step) = (from, distance, LARGEST_STEP * width);
    while step >= SMALLEST_STEP * width && best + 2.0 * step > least {
        let around =
            (0..8).map(|k| at + step * DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_4));
        let highest = around.map(|p| (distance_to(strand, p, width), p)).max_by(|a, b| a.0.total_cmp(&b.0));
        match highest {
            Some((distance, p)) if distance > best + 1e-3 * step => (best, at) = (distance, p),
            _ => step *= 0.5,
        }
    }
    (best >= least).then_some(BareDisc { centre: at, diameter: 2.0 * best - width })
}

/// Whether the point lies inside by the even-odd rule.
fn holds(sides: &[(DVec2, DVec2)], p: DVec2) -> bool {
    sides.iter().fold(false, |inside, (from, to)| {
        let straddles = (from.y > p.y) != (to.y > p.y);
        inside ^ (straddles && from.x + (to.x - from.x) * (p.y - from.y) / (to.y - from.y) > p.x)
    })
}
