//! The safeguard as a signed distance field.

use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
use argil_elastic::Clearance;
use geo_types::{LineString, MultiPolygon};

/// Exact signed distance to the safeguard of a layer; the sign comes from the rings' winding, not from normals,
/// so that it is right in narrow places too, where the paper's implicit surface (Eq. 4) is not.
#[derive(Debug)]
pub(crate) struct SafeguardField {
    rings: Vec<ClosedCurve>,
    index: SegmentIndex,
}

impl SafeguardField {
    /// The field of a region; `cell` is about the distance at which it is asked for.
    pub(crate) fn new(region: &MultiPolygon<f64>, cell: f64) -> Self {
        let rings: Vec<ClosedCurve> = region
            .iter()
            .flat_map(|polygon| std::iter::once(polygon.exterior()).chain(polygon.interiors()))
            .filter_map(ring)
            .collect();
        let index = SegmentIndex::of_curves(&rings, cell);
        Self { rings, index }
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
        let inside = self.rings.iter().filter(|ring| ring.contains(p)).count() % 2 == 1;
        let sign = if inside { -1.0 } else { 1.0 };
        (sign * near.distance, sign * (p - near.point).normalize_or(DVec2::X))
    }
}
