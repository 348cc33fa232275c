//! The rings of a region: its boundary inset by (k + ½) w, level by level, and what stays bare between them.

use argil_curve::SegmentIndex;
use geo::Area;
use geo_types::{MultiPolygon, Polygon};

use crate::offset::{inset, opened_inset, rings};
use crate::options::MOST_RINGS;
use crate::residue::strips;
use crate::ring::{Ring, plainer, rings_round};
use crate::{FillError, FillOptions};

/// Radius of the disc that fits everywhere into what a ring goes round, in w: what is thinner would cross itself once it is simplified.
const SLIGHT: f64 = 0.02;

/// Rings shorter than this are blobs, in w.
const LEAST_LENGTH: f64 = 0.5;

/// What an edge may be moved by between two levels, in w.
const PLAINER: f64 = 0.005;

/// Where an inner edge of a bead is this near to the next ring everywhere, in w, nothing wider than the corner of a square stays bare.
const NEAR: f64 = 0.75;

/// The rings of a region, outermost first.
#[derive(Debug)]
pub(crate) struct Rings {
    pub(crate) rings: Vec<Ring>,
    /// What the outermost rings go round: where the middle of a bead may be.
    pub(crate) core: MultiPolygon<f64>,
}

/// All rings of a region: insets of its boundary, and loops there and back in the strips between them.
///
/// # Complexity
/// Two to four offsets a level, near linear in the vertices of the level.
pub(crate) fn rings_of(region: &MultiPolygon<f64>, options: &FillOptions) -> Result<Rings, FillError> {
    let w = options.width;
    let slight = SLIGHT * w;
    let mut found: Vec<Ring> = Vec::new();
    let core = opened_inset(region, 0.5 * w, slight, w);
    // Levels are walked component by component: an inner component knows nothing of its neighbours.
    let mut level: Vec<Polygon<f64>> = core.0.clone();
    let mut number = 0;
    while !level.is_empty() {
        let wall = (number < options.walls).then_some(number);
        let mut next = Vec::new();
        for polygon in &level {
            // A wall's rings are wanted however short; they too are dropped below three points.
            let least = if wall.is_some() { 0.0 } else { LEAST_LENGTH * w };
            let round = rings_round(polygon, w, options.grid, least);
            found.extend(round.into_iter().map(|points| Ring { points, wall }));
            if found.len() > MOST_RINGS {
                return Err(FillError::TooManyRings { limit: MOST_RINGS });
            }
            for edge in inset(&plainer(polygon, PLAINER * w), 0.5 * w, w) {
                let inner = opened_inset(&edge, 0.5 * w, slight, w);
                // A residue loop beside a wall is fill, too.
                if !stays_near(&edge, &inner, w) {
                    found.extend(
                        strips(&edge, &inner, options).into_iter().map(|points| Ring { points, wall: None }),
                    );
                }
                next.extend(inner);
            }
        }
        level = next;
        number += 1;
    }
    Ok(Rings { rings: found, core })
}

/// Whether every corner of a bead's inner edge has the next ring near.
fn stays_near(edge: &Polygon<f64>, inner: &MultiPolygon<f64>, width: f64) -> bool {
    if inner.0.is_empty() {
        return edge.unsigned_area() <= 0.0;
    }
    let segments = inner
        .iter()
        .flat_map(rings)
        .flat_map(|ring| ring.lines())
        .map(|line| argil_curve::Segment::new(point(line.start), point(line.end)))
        .collect();
    let index = SegmentIndex::new(segments, width);
    rings(edge).flat_map(|ring| ring.lines()).all(|line| {
        let (from, to) = (point(line.start), point(line.end));
        let parts = (from.distance(to) / (0.5 * width)).ceil().clamp(1.0, 1e6);
        (0..parts as usize)
            .all(|k| index.nearest_within(from.lerp(to, k as f64 / parts), NEAR * width).is_some())
    })
}

fn point(c: geo_types::Coord<f64>) -> argil_curve::DVec2 {
    argil_curve::DVec2::new(c.x, c.y)
}
