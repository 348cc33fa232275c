//! What the model asks of a layer: its outline, the wall paths inside it, and where a point lies relative to
//! them.

use crate::AuditSettings;
use crate::bead::laid_and_swept;
use crate::region::Region;
use crate::sampling::samples;
use crate::section::with_points;
use crate::settings::Tolerance;
use argil_curve::{DVec2, Segment, SegmentIndex};
use geo::algorithm::buffer::{BufferStyle, LineJoin};
use geo::{Area, BooleanOps, Buffer, LineString, MultiPolygon, Polygon};
use std::f64::consts::PI;

/// Round joins take this many chords for a quarter of a circle: short of the arc by 0.0003 of its radius.
const CHORDS_A_QUARTER: f64 = 16.0;

/// Cosine of the angle at which two stretches of wall lie on different sides of a point.
const OPPOSITE: f64 = -0.5;

/// In w: pieces of an offset narrower than this, on average, are none. The kernel leaves some, there and back.
const SLIVER: f64 = 1e-5;

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
    /// Which of the walls each segment of that index belongs to.
    wall_of: Vec<usize>,
    /// The holes of the outline, each by itself.
    holes: Vec<Region>,
    /// The outermost wall paths by themselves; `None` when they are all there are.
    outermost_index: Option<SegmentIndex>,
    inner: Region,
    /// Where the outline is too thin for a wall path and whatever runs inside counts as its wall.
    thin: Option<Region>,
    width: f64,
}

impl Wanted {
    /// What is wanted of a layer with this outline, or of a sheet with this section and half a bead round it; `cuts` are the points in which
    /// edges of the mesh meet its plane.
    pub(crate) fn new(
        (outline, section): (&MultiPolygon<f64>, Option<&MultiPolygon<f64>>),
        cuts: &[DVec2],
        settings: &AuditSettings,
        tolerance: &Tolerance,
    ) -> Self {
        let width = settings.width;
        let inner = section.cloned().unwrap_or_else(|| wall_paths(outline, 0.5 * width, width));
        let outermost = rings(&inner);
        let inner_region = Region::new(&outermost);
        let mut walls = outermost.clone();
        let (mut laid, mut swept) = laid_and_swept(&inner, width);
        for j in 1..settings.walls {
            let inset = wall_paths(outline, (j as f64 + 0.5) * width, width);
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
        let sides = |ring: &Vec<DVec2>| ring.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let wall_of =
            walls.iter().enumerate().flat_map(|(k, ring)| std::iter::repeat_n(k, sides(ring))).collect();
        let outermost_index = (walls.len() > outermost.len()).then(|| index(&outermost));
        let mut wanted = Self {
            outlines: with_points(&rings(outline), cuts, width),
            wall_index: index(&walls),
            wall_of,
            holes: holes(outline),
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

    /// The wall that is nearest to `p`, if one is within a bead.
    pub(crate) fn wall_at(&self, p: DVec2) -> Option<usize> {
        let nearest = self.wall_index.nearest_within(p, self.width)?;
        self.wall_of.get(nearest.index).copied()
    }

    /// Whether `p` lies in a hole of the outline.
    pub(crate) fn is_in_hole(&self, p: DVec2) -> bool {
        self.holes.iter().any(|hole| hole.contains(p))
    }

    /// Whether `p` lies between stretches of wall path too near to one another for a strand that keeps a bead from
    /// both.
    pub(crate) fn is_between_walls(&self, p: DVec2) -> bool {
        let Some(nearest) = self.wall_index.nearest_within(p, self.width) else { return false };
        let towards = nearest.point - p;
        let reach = 2.0 * self.width - nearest.distance;
        let mut between = false;
        self.wall_index.for_each_near(Segment::new(p, p), reach, |_, segment| {
            let other = segment.nearest(p);
            let away = other.point - p;
            between |=
                other.distance < reach && towards.dot(away) < OPPOSITE * nearest.distance * other.distance;
        });
        between
    }

    /// Whether a bead that stays inside of the outline reaches `p`.
    pub(crate) fn is_reached(&self, p: DVec2) -> bool {
        let outermost = self.outermost_index.as_ref().unwrap_or(&self.wall_index);
        self.inner.contains(p) || outermost.nearest_within(p, 0.5 * self.width).is_some()
    }

    /// Whether a wall path lies within `reach` mm of `p`.
    pub(crate) fn has_wall_within(&self, p: DVec2, reach: f64) -> bool {
        self.wall_index.is_within(p, reach)
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
        let is_bare = |p: DVec2| !index.is_within(p, reach);
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

fn offset(shape: &MultiPolygon<f64>, distance: f64) -> MultiPolygon<f64> {
    if shape.0.is_empty() {
        return shape.clone();
    }
    shape
        .buffer_with_style(BufferStyle::new(distance).line_join(LineJoin::Round(0.5 * PI / CHORDS_A_QUARTER)))
}

/// The outline inset, without slivers.
fn wall_paths(outline: &MultiPolygon<f64>, inset: f64, width: f64) -> MultiPolygon<f64> {
    let length = |ring: &LineString<f64>| ring.lines().map(|line| line.dx().hypot(line.dy())).sum::<f64>();
    let is_sliver = |ring: &LineString<f64>| {
        let alone = Polygon::new(ring.clone(), Vec::new());
        2.0 * alone.unsigned_area() <= SLIVER * width * length(ring)
    };
    let whole = |polygon: Polygon<f64>| {
        let (exterior, holes) = polygon.into_inner();
        (!is_sliver(&exterior))
            .then(|| Polygon::new(exterior, holes.into_iter().filter(|hole| !is_sliver(hole)).collect()))
    };
    MultiPolygon::new(offset(outline, -inset).into_iter().filter_map(whole).collect())
}

fn holes(outline: &MultiPolygon<f64>) -> Vec<Region> {
    let holes = outline.iter().flat_map(Polygon::interiors);
    holes.map(|hole| Region::new(&[hole.coords().map(|c| DVec2::new(c.x, c.y)).collect()])).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernel leaves pieces without area of this one: wall that nobody could lay.
    #[test]
    fn an_outline_of_no_width_has_no_wall() {
        let corners = [
            (-12.702329099178314, -4.725191801786423),
            (-12.258627623319626, -5.431338787078857),
            (-12.252883523702621, -5.440480470657349),
            (-11.663173526525497, -6.0301899909973145),
            (-8.463963747024536, 0.5895503461360931),
        ];
        let outline = MultiPolygon::new(vec![Polygon::new(LineString::from(corners.to_vec()), Vec::new())]);
        assert!(
            offset(&outline, -0.75).0.len() > 1,
            "the kernel has been mended: no more need to look for slivers"
        );
        assert!(wall_paths(&outline, 0.75, 1.5).0.is_empty());
    }
}
