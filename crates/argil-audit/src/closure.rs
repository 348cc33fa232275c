//! What is to be closed, and what of it lies open: floors, and faces that look up or down.

use crate::region::Region;
use crate::wanted::Wanted;
use argil_curve::{DVec2, SegmentIndex};
use geo::algorithm::buffer::{BufferStyle, LineJoin};
use geo::{BooleanOps, BoundingRect, Buffer, LineString, MultiPolygon};
use std::f64::consts::PI;

/// Spacing of the places that are looked at, in w.
const STEP: f64 = 0.1;

/// More places than this in a layer are not looked at: they lie farther apart instead.
const MOST_PLACES: f64 = 4e6;

/// From a place a nearby one that is farther from every bead is looked for with steps down to this, in w.
const LEAST_STEP: f64 = 0.005;

/// A place farther from the middle of every bead is a finding, in w: half a bead, and a tenth for what corners and joints leave.
pub(crate) const OPEN: f64 = 0.55;

/// Findings are no nearer to each other, in w.
const APART: f64 = 1.0;

/// Most places have a bead within the first of these, in w; distances beyond the second are as good as it.
const NEAR: f64 = 0.75;
const FARTHEST: f64 = 5.0;

/// Round joins have so many chords a quarter of a circle.
const CHORDS_A_QUARTER: f64 = 8.0;

/// Areas in mm², lengths in mm.
#[derive(Clone, Debug, Default)]
pub(crate) struct Closure {
    /// What is to be closed and can be reached by a bead inside of the model.
    pub(crate) wanted: f64,
    /// What of it is farther than half a bead from the middle of every bead.
    pub(crate) bare: f64,
    /// The greatest distance of a place of it from the middle of a bead.
    pub(crate) farthest: f64,
    /// The places that lie open, and how far from a bead.
    pub(crate) open: Vec<(DVec2, f64)>,
}

/// What of an outline lies open above or below a neighbour, where that is wider than a bead.
pub(crate) fn face(
    outline: &MultiPolygon<f64>,
    neighbour: &MultiPolygon<f64>,
    width: f64,
) -> MultiPolygon<f64> {
    let open = if neighbour.0.is_empty() { outline.clone() } else { outline.difference(neighbour) };
    let half = offset(&open, -0.5 * width);
    if half.0.is_empty() { half } else { offset(&half, 0.5 * width) }
}

fn offset(shape: &MultiPolygon<f64>, by: f64) -> MultiPolygon<f64> {
    shape.buffer_with_style(BufferStyle::new(by).line_join(LineJoin::Round(0.5 * PI / CHORDS_A_QUARTER)))
}

/// Looks at a region of a layer that is to be closed.
///
/// # Complexity
/// O(places · log beads), a hundred places for each w² of the region's box.
pub(crate) fn measure(
    region: &MultiPolygon<f64>,
    wanted: &Wanted,
    laid: &SegmentIndex,
    width: f64,
) -> Closure {
    let mut closure = Closure::default();
    let Some(bounds) = region.bounding_rect() else { return closure };
    let (low, high) =
        (DVec2::new(bounds.min().x, bounds.min().y), DVec2::new(bounds.max().x, bounds.max().y));
    let size = high - low;
    let step = (STEP * width).max((size.x * size.y / MOST_PLACES).sqrt());
    let points = |ring: &LineString<f64>| ring.coords().map(|c| DVec2::new(c.x, c.y)).collect::<Vec<_>>();
    let rings: Vec<Vec<DVec2>> =
        region.iter().flat_map(|p| std::iter::once(p.exterior()).chain(p.interiors())).map(points).collect();
    let inside = Region::new(&rings);
    let is_wanted = |p: DVec2| inside.contains(p) && wanted.is_reached(p);
    let near = |p: DVec2, reach: f64| laid.nearest_within(p, reach * width).map(|near| near.distance);
    let distance = |p: DVec2| near(p, NEAR).or_else(|| near(p, FARTHEST)).unwrap_or(FARTHEST * width);
    let mut suspects: Vec<(f64, DVec2)> = Vec::new();
    // The casts saturate, and the counts are those of at most so many places.
    let [columns, rows] = [size.x, size.y].map(|extent| (extent / step).ceil() as usize);
    for row in 0..rows {
        for column in 0..columns {
            let p = low + step * DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            if !is_wanted(p) {
                continue;
            }
            closure.wanted += step * step;
            let away = distance(p);
            if away > 0.5 * width {
                closure.bare += step * step;
            }
            closure.farthest = closure.farthest.max(away);
            if away > (OPEN - STEP) * width {
                suspects.push((away, p));
            }
        }
    }
    suspects.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (away, p) in suspects {
        if closure.open.iter().any(|(known, _)| known.distance(p) < APART * width) {
            continue;
        }
        let (at, away) =
            summit(p, away, (0.5 * step, LEAST_STEP * width), |p| is_wanted(p).then(|| distance(p)));
        closure.farthest = closure.farthest.max(away);
        if away > OPEN * width && closure.open.iter().all(|(known, _)| known.distance(at) >= APART * width) {
            closure.open.push((at, away));
        }
    }
    closure
}

/// The place not far away up to which a distance rises, and that distance.
fn summit(
    mut at: DVec2,
    mut best: f64,
    (mut step, least): (f64, f64),
    distance: impl Fn(DVec2) -> Option<f64>,
) -> (DVec2, f64) {
    while step > least {
        let around = (0..8).map(|k| at + step * DVec2::from_angle(0.25 * PI * f64::from(k)));
        let highest = around.filter_map(|p| Some((distance(p)?, p))).max_by(|a, b| a.0.total_cmp(&b.0));
        match highest {
            Some((found, p)) if found > best + 1e-3 * step => (best, at) = (found, p),
            _ => step *= 0.5,
        }
    }
    (at, best)
}
