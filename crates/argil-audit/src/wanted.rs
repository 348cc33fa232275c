//! What the model asks of a layer: its outline, the wall paths inside it, and where a point lies relative to
//! them.

use crate::AuditSettings;
use crate::bead::laid_and_swept;
use crate::region::Region;
use crate::sampling::samples;
use crate::settings::Tolerance;
use argil_curve::{DVec2, Segment, SegmentIndex};
use geo::algorithm::buffer::{BufferStyle, LineJoin};
use geo::{BooleanOps, Buffer, LineString, MultiPolygon};
use std::f64::consts::PI;

/// Round joins take this many chords for a quarter of a circle: short of the arc by 0.0003 of its radius.
const CHORDS_A_QUARTER: f64 = 16.0;

/// On which side of the outermost wall path a strand runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Inside,
    /// Nearer to the wall path than a strand beside it could be.
    Along,
    Outside,
}

/// One layer of the model.
#[derive(Clone, Debug)]
pub(crate) struct Wanted {
    /// Outlines; every ring repeats its first point.
    pub(crate) outlines: Vec<Vec<DVec2>>,
    /// Wall paths: the outline inset by (j + ½) w for every wall j. Every ring repeats its first point.
    pub(crate) walls: Vec<Vec<DVec2>>,
    /// Beads along all wall paths: length times width, and the area that they sweep, mm².
    pub(crate) wall_clay: (f64, f64),
    wall_index: SegmentIndex,
    /// The outermost wall paths by themselves; `None` when they are all there are.
    outermost_index: Option<SegmentIndex>,
    inner: Region,
    /// Where the outline is too thin for a wall path and whatever runs inside counts as its wall.
    thin: Option<Region>,
    width: f64,
}

impl Wanted {
    pub(crate) fn new(outline: &MultiPolygon<f64>, settings: &AuditSettings, tolerance: &Tolerance) -> Self {
        let width = settings.width;
        let outlines = rings(outline);
        let outline_index = segment_index(outlines.iter().map(Vec::as_slice), width);
        let inner = inset(outline, &outline_index, 0.5 * width);
        let outermost = rings(&inner);
        let inner_region = Region::new(&outermost);
        let mut walls = outermost.clone();
        let (mut laid, mut swept) = laid_and_swept(&inner, width);
        for j in 1..settings.walls {
            let inset = inset(outline, &outline_index, (j as f64 + 0.5) * width);
            if inset.0.is_empty() {
                break;
            }
            walls.extend(rings(&inset));
            // The beads of two walls side by side share no area, so the areas add up.
            let further = laid_and_swept(&inset, width);
            laid += further.0;
            swept += further.1;
        }
        let index = |rings: &[Vec<DVec2>]| segment_index(rings.iter().map(Vec::as_slice), width);
        let outermost_index = (walls.len() > outermost.len()).then(|| index(&outermost));
        let mut wanted = Self {
            outlines,
            wall_index: index(&walls),
            walls,
            wall_clay: (laid, swept),
            outermost_index,
            inner: inner_region,
            thin: None,
            width,
        };
        wanted.thin = wanted.thin_part(outline, &inner, tolerance);
        wanted
    }

    /// Distance from `p` to the nearest wall path, mm; 0 in thin parts and infinity beyond one bead.
    pub(crate) fn wall_distance(&self, p: DVec2) -> f64 {
        if self.is_thin(p) { 0.0 } else { self.path_distance(p) }
    }

    /// The distance that [`wall_distance`](Self::wall_distance) gives, and the side of the wall that `p` lies
    /// on.
    pub(crate) fn place(&self, p: DVec2, tolerance: &Tolerance) -> (f64, Side) {
        let distance = self.path_distance(p);
        let from_outermost = match &self.outermost_index {
            Some(index) => within(index, p, tolerance.beside),
            None => distance,
        };
        let side = match (from_outermost > tolerance.beside, self.inner.contains(p)) {
            (false, _) => Side::Along,
            (true, true) => Side::Inside,
            (true, false) => Side::Outside,
        };
        (if self.is_thin(p) { 0.0 } else { distance }, side)
    }

    fn is_thin(&self, p: DVec2) -> bool {
        self.thin.as_ref().is_some_and(|thin| thin.contains(p))
    }

    fn path_distance(&self, p: DVec2) -> f64 {
        within(&self.wall_index, p, self.width)
    }

    /// The parts of the outline that no wall path of full width reaches, widened a little.
    ///
    /// Most layers have none, and the four offsets that find the parts are dear, so first a look at the
    /// outline itself: what is thin shows there, at its corners above all.
    fn thin_part(
        &self,
        outline: &MultiPolygon<f64>,
        inner: &MultiPolygon<f64>,
        t: &Tolerance,
    ) -> Option<Region> {
        let reach = 0.5 * self.width + t.thin_beyond;
        let index = self.outermost_index.as_ref().unwrap_or(&self.wall_index);
        let is_bare = |p: DVec2| index.nearest_within(p, reach).is_none();
        let shows = self.outlines.iter().any(|ring| {
            ring.iter().any(|&p| is_bare(p)) || samples(ring, t.outline_step).iter().any(|s| is_bare(s.at))
        });
        if !shows {
            return None;
        }
        let bare = outline.difference(&offset(inner, reach));
        let widened = offset(&offset(&bare, -t.thin_opening), t.thin_reach);
        let thin = rings(&widened.intersection(outline));
        (!thin.is_empty()).then(|| Region::new(&thin))
    }
}

/// An index over the segments of polylines, with cells that suit queries up to one bead.
pub(crate) fn segment_index<'a>(lines: impl IntoIterator<Item = &'a [DVec2]>, width: f64) -> SegmentIndex {
    let segments = lines
        .into_iter()
        .flat_map(|line| line.windows(2))
        .filter(|pair| pair[0] != pair[1])
        .map(|pair| Segment::new(pair[0], pair[1]))
        .collect();
    SegmentIndex::new(segments, 0.75 * width)
}

/// Distance from `p` to the nearest segment, mm; infinity when that is more than `limit`.
pub(crate) fn within(index: &SegmentIndex, p: DVec2, limit: f64) -> f64 {
    index.nearest_within(p, limit).map_or(f64::INFINITY, |nearest| nearest.distance)
}

/// What lies at least `distance` inside of the outline.
///
/// The polygon kernel may leave a triangle just inside of the outline, where offset sides meet in one point of its integer
/// grid; such pieces are left out.
fn inset(outline: &MultiPolygon<f64>, outline_index: &SegmentIndex, distance: f64) -> MultiPolygon<f64> {
    let mut inside = offset(outline, -distance);
    let deep = |c: &geo::Coord| outline_index.nearest_within(DVec2::new(c.x, c.y), 0.95 * distance).is_none();
    inside.0.retain(|polygon| polygon.exterior().coords().all(deep));
    inside
}

fn offset(shape: &MultiPolygon<f64>, distance: f64) -> MultiPolygon<f64> {
    if shape.0.is_empty() {
        return shape.clone();
    }
    shape
        .buffer_with_style(BufferStyle::new(distance).line_join(LineJoin::Round(0.5 * PI / CHORDS_A_QUARTER)))
}

fn rings(shape: &MultiPolygon<f64>) -> Vec<Vec<DVec2>> {
    let points = |ring: &LineString<f64>| ring.coords().map(|c| DVec2::new(c.x, c.y)).collect::<Vec<_>>();
    shape
        .iter()
        .flat_map(|polygon| std::iter::once(polygon.exterior()).chain(polygon.interiors()))
        .map(points)
        .filter(|ring| ring.len() > 2)
        .collect()
}
