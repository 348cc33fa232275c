//! Strips that stay bare between rings, and the loops there and back that fill them.

use argil_curve::DVec2;
use geo::{Area, BooleanOps};
use geo_types::{MultiPolygon, Polygon};

use crate::FillOptions;
use crate::inscribed::inscribed_radius;
use crate::offset::{dilation, inset, opening};
use crate::ring::{perimeter, rings_round};

/// Parts smaller than this are not looked at, in w².
const LEAST_AREA: f64 = 0.02;

/// What is thinner than twice this is cut off from a part before it gets its loop, in w.
const TAIL: f64 = 0.12;

/// The loop runs inside of its part by this share of the part's width, and by at most so much in w: both lanes then lie as far
/// apart as they can without laying clay far outside of the strip.
const INSET: f64 = 0.3;
const MOST_INSET: f64 = 0.25;
const LEAST_INSET: f64 = 0.05;

/// Widths of parts are measured up to this, in w.
const PRECISION: f64 = 0.02;

/// Shorter loops are blobs, in w.
const LEAST_LENGTH: f64 = 0.5;

/// Loops for the parts of a bead's inner `edge` that the rings round `inner` leave bare.
pub(crate) fn strips(
    edge: &Polygon<f64>,
    inner: &MultiPolygon<f64>,
    options: &FillOptions,
) -> Vec<Vec<DVec2>> {
    let w = options.width;
    let swept = if inner.0.is_empty() { inner.clone() } else { dilation(inner, 0.5 * w, w) };
    let bare = MultiPolygon(vec![edge.clone()]).difference(&swept);
    let least = 0.5 * options.residue * w;
    let wide = |part: &Polygon<f64>| {
        part.unsigned_area() > LEAST_AREA * w * w && inscribed_radius(part, PRECISION * w, least) >= least
    };
    bare.iter()
        .filter(|part| wide(part))
        .flat_map(|part| opening(part, TAIL * w, w))
        .flat_map(|part| {
            let enough = 0.5 * MOST_INSET / INSET * w;
            let diameter = 2.0 * inscribed_radius(&part, PRECISION * w, enough);
            let distance = (INSET * diameter).clamp(LEAST_INSET * w, MOST_INSET * w);
            inset(&part, distance, w)
        })
        .flat_map(|core| rings_round(&core, w, options.grid, LEAST_LENGTH * w))
        .filter(|points| perimeter(points) > 0.0)
        .collect()
}
