//! Sparse fill: stripes whose edges are lanes, in the same places on every layer.

use argil_curve::{DVec2, Segment, SegmentIndex, rounded};
use argil_fill::FillError;
use geo::{BooleanOps, BoundingRect};
use geo_types::{Coord, MultiPolygon, Rect};

use crate::apart::is_apart;
use crate::model_loop::nest;
use crate::offset::{cleaned, grown, opened, ring_points};
use crate::section::{Filled, Section};
use crate::{ModelLoop, SkinOptions};

/// Stripes across all layers: every second one is the inside of a loop, so that lanes lie one pitch apart.
///
/// Their edges are the same straight lines on every layer, so that a lane stands on the lane below. Only its ends follow the walls.
///
/// # Example
/// ```
/// use argil_skin::{DVec2, Stripes};
/// let fifth = Stripes { pitch: 7.5, origin: DVec2::ZERO, upright: false };
/// assert_eq!(fifth.share(1.5), 0.2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Stripes {
    /// Distance of the lanes, mm: at least a bead. The share of clay is the bead width over it.
    pub pitch: f64,
    /// A point on the edge of a stripe, mm.
    pub origin: DVec2,
    /// Whether the stripes run along y, not x.
    pub upright: bool,
}

/// More stripes than this across a layer are a mistake in units.
const MOST_STRIPES: f64 = 20_000.0;

/// Radius of the disc that fits everywhere into what a loop goes round, in w: where less room is left its lanes would lie on each other.
/// No more than so much of the pitch, since a stripe is no wider.
const HALF: f64 = 0.5;
const OF_PITCH: f64 = 0.45;

/// What a loop keeps from walls and from fill, in w. It is laid a whole bead away; less is left where walls give way to each other.
const CLEAR: f64 = 0.7;

/// A shorter loop is a blob, in w.
const LEAST_LENGTH: f64 = 4.0;

/// A side shorter than this many steps of the grid has no direction left after rounding.
const LEAST_SIDE: f64 = 12.0;

impl Stripes {
    /// The share of clay in a region that is wide beside the pitch, for a bead of this width.
    #[must_use]
    pub fn share(&self, width: f64) -> f64 {
        width / self.pitch
    }

    /// The stripes that reach into the box round a region.
    fn over(&self, region: &MultiPolygon<f64>) -> Result<MultiPolygon<f64>, FillError> {
        let Some(bounds) = region.bounding_rect() else { return Ok(MultiPolygon(Vec::new())) };
        let (low, high) = if self.upright {
            (bounds.min().x - self.origin.x, bounds.max().x - self.origin.x)
        } else {
            (bounds.min().y - self.origin.y, bounds.max().y - self.origin.y)
        };
        let turn = 2.0 * self.pitch;
        let (first, last) = ((low / turn).floor(), (high / turn).ceil());
        if !(0.0..=MOST_STRIPES).contains(&(last - first)) {
            return Err(FillError::TooManyRings { limit: MOST_STRIPES as usize });
        }
        let stripe = |k: usize| {
            let from = (first + k as f64) * turn;
            let (from, to) = (from, from + self.pitch);
            let corners = if self.upright {
                [(self.origin.x + from, bounds.min().y - turn), (self.origin.x + to, bounds.max().y + turn)]
            } else {
                [(bounds.min().x - turn, self.origin.y + from), (bounds.max().x + turn, self.origin.y + to)]
            };
            Rect::new(Coord::from(corners[0]), Coord::from(corners[1])).to_polygon()
        };
        Ok(MultiPolygon((0..(last - first) as usize).map(stripe).collect()))
    }
}

impl Section<'_> {
    /// Adds sparse fill to a layer that is [filled](Section::filled): loops round every second stripe of what the walls and the fill of `zone`
    /// leave; of that, only what lies in `within`, if that is given. Returns their length in mm.
    ///
    /// A loop lies a bead from walls and fill and crosses nothing. Where a stripe is narrower than a bead it has none.
    ///
    /// # Errors
    /// [`FillError::Option`] for a width that is none or a pitch below it, [`FillError::TooManyRings`] for more than 20,000 stripes.
    ///
    /// # Complexity
    /// A few offsets and one intersection of polygons, near linear in their vertices.
    ///
    /// # Example
    /// ```
    /// use argil_skin::{DVec2, Section, SkinOptions, Stripes};
    /// use geo_types::{MultiPolygon, Rect};
    /// let outline = MultiPolygon(vec![Rect::new((0.0, 0.0), (50.0, 50.0)).to_polygon()]);
    /// let corners = [(0.75, 0.75), (49.25, 0.75), (49.25, 49.25), (0.75, 49.25)];
    /// let walls = [corners.map(DVec2::from).to_vec()];
    /// let section = Section { outline: &outline, walls: &walls };
    /// let none = MultiPolygon(Vec::new());
    /// let options = SkinOptions::for_width(1.5);
    /// let mut filled = section.filled(&none, &options, &[])?;
    /// let stripes = Stripes { pitch: 7.5, origin: DVec2::new(25.0, 25.0), upright: false };
    /// let length = section.striped(&mut filled, (&none, None), &stripes, &options)?;
    /// let share = length * 1.5 / (48.5 * 48.5);
    /// assert!((share - 0.2).abs() < 0.05);
    /// # Ok::<(), argil_skin::FillError>(())
    /// ```
    pub fn striped(
        &self,
        filled: &mut Filled,
        (zone, within): (&MultiPolygon<f64>, Option<&MultiPolygon<f64>>),
        stripes: &Stripes,
        options: &SkinOptions,
    ) -> Result<f64, FillError> {
        let width = options.width()?;
        if !(stripes.pitch >= width && stripes.pitch.is_finite() && stripes.origin.is_finite()) {
            let expected = "at least a bead, about an origin that is finite";
            return Err(FillError::Option { name: "pitch", value: stripes.pitch, expected });
        }
        let solid = self.room(zone, options, width);
        let mut hollow = self.inside(options, width);
        if !solid.0.is_empty() {
            hollow = hollow.difference(&solid);
        }
        // Lanes lie half a bead inside of what they may cover.
        let mut middle = grown(&cleaned(hollow, width), -0.5 * width, width);
        if let Some(within) = within {
            middle = middle.intersection(within);
        }
        let parts = middle.intersection(&stripes.over(&middle)?);
        let radius = (HALF * width).min(OF_PITCH * stripes.pitch);
        let parts = opened(&cleaned(parts, width), radius, width);
        let taken = filled.loops.iter().flat_map(|one| sides(&one.points)).collect();
        let taken = SegmentIndex::new(taken, width);
        let grid = options.fill.grid;
        let mut length = 0.0;
        for ring in parts.iter().flat_map(|p| std::iter::once(p.exterior()).chain(p.interiors())) {
            let points = rounded(&ring_points(ring), grid, LEAST_SIDE * grid);
            let own: f64 = sides(&points).map(|side| side.length()).sum();
            let is_clear = || points.iter().all(|&p| !taken.is_within(p, CLEAR * width));
            let crosses = || {
                let mut any = false;
                sides(&points)
                    .for_each(|side| taken.for_each_near(side, 0.0, |_, other| any |= side.crosses(&other)));
                any
            };
            if points.len() < 3
                || own < LEAST_LENGTH * width
                || !is_apart(&points, grid)
                || !is_clear()
                || crosses()
            {
                continue;
            }
            length += own;
            filled.loops.push(ModelLoop { points, fill: true, parent: None });
        }
        nest(&mut filled.loops);
        Ok(length)
    }
}

fn sides(points: &[DVec2]) -> impl Iterator<Item = Segment> + '_ {
    (0..points.len()).map(|k| Segment::new(points[k], points[(k + 1) % points.len()]))
}
