//! Lines along the middle of what is thinner than a bead.

use crate::chordal_axis::ChordalAxis;
use crate::containment::contains;
use crate::mitre::REACH;
use crate::pruning::Pruning;
use argil_curve::{Segment, SegmentIndex};
use glam::DVec2;

/// Points of an outline that lie farther than this from the wall, in w, call for a spine, and with them their
/// neighbours beyond [`REACH`]. A right angle with a tip (0.641 w) does not; one of 80° does.
pub(crate) const BARE: f64 = 0.66;

/// Distance between points of the boundary, in w.
pub(crate) const STEP: f64 = 0.1;

/// A spine keeps this far from the boundary, in w: what is thinner than twice that is not followed.
pub(crate) const CLEARANCE: f64 = 0.04;

/// Spines without a wall to hang on are at least this long, in w: less is a blob and no path.
pub(crate) const LEAST_LENGTH: f64 = 0.4;

/// The boundary of an outline in short steps.
struct Boundary {
    rings: Vec<Vec<DVec2>>,
    sides: SegmentIndex,
}

impl Boundary {
    fn of(outline: &[Vec<DVec2>], width: f64) -> Self {
        let rings: Vec<Vec<DVec2>> = outline.iter().map(|ring| in_steps(ring, STEP * width)).collect();
        let sides = SegmentIndex::new(rings.iter().flat_map(|ring| sides(ring)).collect(), width);
        Self { rings, sides }
    }

    fn holds(&self, p: DVec2, clearance: f64) -> bool {
        let odd = self.rings.iter().filter(|ring| contains(ring, p)).count() % 2 == 1;
        odd && !self.sides.is_within(p, clearance)
    }
}

/// The sides of a closed ring.
pub(crate) fn sides(ring: &[DVec2]) -> impl Iterator<Item = Segment> + '_ {
    (0..ring.len()).map(|k| Segment::new(ring[k], ring[(k + 1) % ring.len()]))
}

/// The ring with its sides cut into steps of at most this length.
pub(crate) fn in_steps(ring: &[DVec2], step: f64) -> Vec<DVec2> {
    sides(ring)
        .flat_map(|side| {
            let parts = (side.length() / step).ceil().max(1.0);
            (0..parts as usize).map(move |k| side.point_at(k as f64 / parts))
        })
        .collect()
}

/// Whether some point of the outline is bare.
pub(crate) fn is_bare_somewhere(outline: &[Vec<DVec2>], wall: &SegmentIndex, width: f64) -> bool {
    let is_bare = |p: DVec2| !wall.is_within(p, BARE * width);
    outline.iter().any(|ring| in_steps(ring, 0.4 * width).into_iter().any(is_bare))
}

/// Lines that bring every point of the outline within a bead's reach, as far as it is not too thin for any
/// line. They begin inside the wall where there is one.
///
/// # Complexity
/// O(n log n) in the number of steps along the boundary.
pub(crate) fn spines(outline: &[Vec<DVec2>], wall: &SegmentIndex, width: f64) -> Vec<Vec<DVec2>> {
    let boundary = Boundary::of(outline, width);
    let points: Vec<DVec2> = boundary.rings.iter().flatten().copied().collect();
    let dash = if wall.is_empty() { dash(&points, &boundary, width) } else { None };
    if let Some(dash) = dash {
        return vec![dash];
    }
    let bare = bare_points(&boundary.rings, wall, width);
    match ChordalAxis::of(&boundary.rings) {
        Some(axis) => Pruning::new(axis, &points, &bare, &boundary.sides, wall, width).lines(&boundary.sides),
        None => Vec::new(),
    }
}

/// A straight line through the middle that covers a compact outline.
fn dash(points: &[DVec2], boundary: &Boundary, width: f64) -> Option<Vec<DVec2>> {
    let middle = points.iter().sum::<DVec2>() / points.len() as f64;
    let moment = |f: fn(DVec2) -> f64| points.iter().map(|&p| f(p - middle)).sum::<f64>();
    let (xx, yy, xy) = (moment(|d| d.x * d.x), moment(|d| d.y * d.y), moment(|d| d.x * d.y));
    let along = DVec2::from_angle(0.5 * (2.0 * xy).atan2(xx - yy));
    let (low, high) = points.iter().fold((f64::MAX, f64::MIN), |(low, high), &p| {
        let at = (p - middle).dot(along);
        (low.min(at), high.max(at))
    });
    let slack = 0.5 * (high - low - width).max(LEAST_LENGTH * width);
    let centre = middle + along * (0.5 * (low + high));
    let line = Segment::new(centre - along * slack, centre + along * slack);
    let covers = points.iter().all(|&p| line.distance(p) <= REACH * width);
    let parts = (line.length() / (STEP * width)).ceil();
    let fits =
        || (0..=parts as usize).all(|k| boundary.holds(line.point_at(k as f64 / parts), CLEARANCE * width));
    (covers && fits()).then(|| vec![line.point_at(0.0), line.point_at(1.0)])
}

/// For each point of the rings, whether a spine has to come within reach of it.
fn bare_points(rings: &[Vec<DVec2>], wall: &SegmentIndex, width: f64) -> Vec<bool> {
    let mut bare = Vec::new();
    for ring in rings {
        let far: Vec<u8> = ring
            .iter()
            .map(|&p| match wall.nearest_within(p, BARE * width) {
                None => 2,
                Some(nearest) => u8::from(nearest.distance > REACH * width),
            })
            .collect();
        let count = ring.len();
        let mut found: Vec<bool> = far.iter().map(|&far| far == 2).collect();
        // Twice round, so that a run over the ring's first point is seen whole.
        for k in (0..2 * count).chain((0..2 * count).rev()) {
            let (here, next) = (k % count, (k + 1) % count);
            let joined = far[here] > 0 && far[next] > 0 && (found[here] || found[next]);
            if joined {
                found[here] = true;
                found[next] = true;
            }
        }
        bare.append(&mut found);
    }
    bare
}
