//! How well an outline's first wall prints it.

use crate::SliceSettings;
use crate::layer::Loss;
use crate::region::{self, ring_points};
use crate::spine::{is_bare_somewhere, sides};
use crate::thin::middle;
use argil_curve::SegmentIndex;
use geo::{Area, BooleanOps, Centroid, InteriorPoint};
use geo_types::{MultiPolygon, Polygon};
use glam::DVec2;

/// A part of an outline that no bead reaches is reported from this area on, in w²: rounded
/// corners are smaller (0.05 w² at a right angle).
const BRANCH_AREA: f64 = 0.1;

/// So is one that has a point this far from every loop, in w: a sliver that is too thin for any spine.
const BRANCH_REACH: f64 = 0.74;

/// What the bead may fall short of an outline by without it being a lost branch, in w.
const BRANCH_SLACK: f64 = 1.0 / 30.0;

/// An outline and the loops of its first wall.
pub(crate) struct Fit<'a> {
    pub(crate) layer: usize,
    /// The outline as it was cut, and its rings as they were inset.
    pub(crate) original: &'a Polygon<f64>,
    pub(crate) outline: &'a [Vec<DVec2>],
    /// What lies within the walls of full width.
    pub(crate) walled: &'a MultiPolygon<f64>,
    pub(crate) spines: &'a [Vec<DVec2>],
    pub(crate) rings: &'a [&'a Vec<DVec2>],
}

impl Fit<'_> {
    /// What is printed wider than it is, and what is not printed.
    pub(crate) fn losses(&self, settings: &SliceSettings) -> Vec<Loss> {
        let width = settings.width;
        let layer = self.layer;
        let whole = || (inner_point(self.original), self.original.unsigned_area());
        if self.rings.is_empty() {
            let (at, area) = whole();
            return vec![Loss::Vanished { layer, at, area }];
        }
        let index = SegmentIndex::new(self.rings.iter().flat_map(|ring| sides(ring)).collect(), width);
        let mut losses = Vec::new();
        if self.walled.0.is_empty() {
            let (at, area) = whole();
            losses.push(Loss::Thin { layer, at, area, inset: self.deepest(width) });
        } else {
            let printed = |spine: &&Vec<DVec2>| index.is_within(middle(spine), 0.1 * width);
            losses.extend(self.spines.iter().filter(printed).map(|spine| {
                let length = spine.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
                Loss::Narrow { layer, at: middle(spine), length }
            }));
        }
        if is_bare_somewhere(self.outline, &index, width) {
            losses.extend(self.bare_parts(&index, width));
        }
        losses
    }

    /// How far inside the outline the loops get.
    fn deepest(&self, width: f64) -> f64 {
        let outline = SegmentIndex::new(self.outline.iter().flat_map(|ring| sides(ring)).collect(), width);
        self.rings.iter().copied().flatten().map(|&p| outline.distance(p)).fold(0.0, f64::max)
    }

    /// The parts that lie farther from the loops, which `index` has, than the bead reaches.
    fn bare_parts(&self, index: &SegmentIndex, width: f64) -> Vec<Loss> {
        let reach = (0.5 + BRANCH_SLACK) * width;
        let chord = 0.5 * BRANCH_SLACK * width;
        let lines: Vec<Vec<DVec2>> =
            self.rings.iter().map(|ring| ring.iter().chain(ring.first()).copied().collect()).collect();
        let beads = region::beads(&lines, reach, chord);
        let covered = self.walled.union(&beads);
        let missed = MultiPolygon(vec![self.original.clone()]).difference(&covered);
        missed
            .iter()
            .filter_map(|part| {
                let area = part.unsigned_area();
                let bare = ring_points(part.exterior()).into_iter().map(|p| (index.distance(p), p));
                let (reach, farthest) = bare.max_by(|a, b| a.0.total_cmp(&b.0))?;
                let is_far = reach > BRANCH_REACH * width;
                let at = if is_far { farthest } else { inner_point(part) };
                let counts = is_far || area > BRANCH_AREA * width * width;
                counts.then_some(Loss::Branch { layer: self.layer, at, area })
            })
            .collect()
    }
}

/// A point inside the polygon, or at least near it where it has no inside.
pub(crate) fn inner_point(polygon: &Polygon<f64>) -> DVec2 {
    let point = polygon.interior_point().or_else(|| polygon.centroid());
    point.map_or(DVec2::ZERO, |p| DVec2::new(p.x(), p.y()))
}
