//! The safeguard as a signed distance field.

use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
use argil_elastic::Clearance;
use geo_types::{LineString, MultiPolygon};

/// A side or a turn is sure if it is more than this share of the lengths that it was computed from.
const CALLABLE: f64 = 1e-9;

/// Exact signed distance to the safeguard of a layer; the sign comes from the rings' winding, not from normals,
/// so that it is right in narrow places too, where the paper's implicit surface (Eq. 4) is not.
#[derive(Debug)]
pub(crate) struct SafeguardField {
    rings: Vec<ClosedCurve>,
    index: SegmentIndex,
    /// For each segment of the index: the segment before it on its ring, that after it, and whether the region is on the left.
    beside: Vec<(u32, u32, bool)>,
}

impl SafeguardField {
    /// The field of a region; `cell` is about the distance at which it is asked for.
    pub(crate) fn new(region: &MultiPolygon<f64>, cell: f64) -> Self {
        let mut rings: Vec<ClosedCurve> = Vec::new();
        let mut beside = Vec::new();
        for polygon in region {
            let holes = polygon.interiors().iter().map(|line| (line, true));
            for (line, is_hole) in std::iter::once((polygon.exterior(), false)).chain(holes) {
                let Some(ring) = ring(line) else { continue };
                let (first, count) = (beside.len() as u32, ring.segment_count() as u32);
                let on_left = (ring.signed_area() > 0.0) != is_hole;
                let neighbours = |k| (first + (k + count - 1) % count, first + (k + 1) % count, on_left);
                beside.extend((0..count).map(neighbours));
                rings.push(ring);
            }
        }
        let index = SegmentIndex::of_curves(&rings, cell);
        Self { rings, index, beside }
    }

    /// Whether `p` lies inside, told by the ring at the nearest place on it: by the side of the segment, or, where that
    /// place is a corner, by the way the ring turns there, for only the outer side of a corner has it for the nearest
    /// place. None where either is too near to call.
    fn is_inside_beside(&self, p: DVec2, index: usize, place: DVec2) -> Option<bool> {
        let segments = self.index.segments();
        let segment = segments[index];
        let &(before, after, on_left) = self.beside.get(index)?;
        let turn = if place == segment.start {
            let into = segments[before as usize];
            -(into.end - into.start).perp_dot(segment.end - segment.start)
        } else if place == segment.end {
            let out = segments[after as usize];
            -(segment.end - segment.start).perp_dot(out.end - out.start)
        } else {
            (segment.end - segment.start).perp_dot(p - segment.start)
        };
        let scale = segment.length() * (p.distance(segment.start) + segment.length());
        (turn.abs() > CALLABLE * scale).then_some((turn > 0.0) == on_left)
    }

    /// The rings as polylines.
    pub(crate) fn polylines(&self) -> Vec<Vec<DVec2>> {
        self.rings.iter().map(|ring| ring.points().to_vec()).collect()
    }
}

/// A ring of a polygon as a curve, if it is one.
fn ring(line: &LineString<f64>) -> Option<ClosedCurve> {
    let mut points: Vec<DVec2> = line.coords().map(|c| DVec2::new(c.x, c.y)).collect();
    if points.first() == points.last() {
        points.pop();
    }
    ClosedCurve::new(points).ok()
}

impl Clearance for SafeguardField {
    fn distance(&self, p: DVec2) -> (f64, DVec2) {
        let Some(near) = self.index.nearest(p) else {
            return (f64::INFINITY, DVec2::X);
        };
        let inside = self
            .is_inside_beside(p, near.index, near.point)
            .unwrap_or_else(|| self.rings.iter().filter(|ring| ring.contains(p)).count() % 2 == 1);
        let sign = if inside { -1.0 } else { 1.0 };
        (sign * near.distance, sign * (p - near.point).normalize_or(DVec2::X))
    }
}
