//! One layer: its walls, and the fill of its zone.

use argil_curve::DVec2;
use argil_fill::{BareDisc, Fill, FillError, FillOptions, Joint, fill};
use geo::{BooleanOps, Contains, Distance, Euclidean};
use geo_types::{MultiPolygon, Point, Polygon};

use crate::apart::is_apart;
use crate::model_loop::nest;
use crate::offset::{cleaned, grown, opened, plainer};
use crate::{ModelLoop, SkinOptions};

/// Radius of the disc that fits everywhere into what is filled, in w: narrower gaps stay open.
const SLIGHT: f64 = 0.25;

/// Where a disc of this radius does not fit, in w, no bead would.
const NARROW: f64 = 0.55;

/// What is so narrow is widened by this in under what covers it, in w, so that a loop there and back has room: that edge is hidden.
const UNDER: f64 = 0.6;

/// Between walls it is widened by this on either side, in w, where that is asked for. The beads beside it lie half as far away as they would.
const BETWEEN: f64 = 0.3;

/// Where the fill of a room touches itself, corners are left out into which discs of these radii do not fit, in w.
const LEFT_OUT: [f64; 3] = [0.3, 0.4, 0.5];

/// One layer of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section<'a> {
    /// What is solid.
    pub outline: &'a MultiPolygon<f64>,
    /// Its walls: simple, disjoint, on the output grid, no repeated last point.
    pub walls: &'a [Vec<DVec2>],
}

/// A layer's walls and fill.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Filled {
    /// The loops: the walls, bit by bit and in their order, then the fill. None crosses itself or another.
    pub loops: Vec<ModelLoop>,
    /// The middles of the joints inside the fill, for the next layer to keep its own away from.
    pub joints: Vec<DVec2>,
    /// Discs that stay bare, as [`argil_fill::Fill::bare`] lists them.
    pub bare: Vec<BareDisc>,
}

impl Section<'_> {
    /// Fills what the walls leave of a zone.
    ///
    /// The fill is joined to as few loops as [`fill`] can, and stays apart from the walls by a bead: whoever joins the walls of a
    /// layer to one strand joins the fill, too, and no wall is opened for it.
    ///
    /// `avoid` are places to keep joints away from, such as [`Filled::joints`] of the layer below.
    ///
    /// # Errors
    /// Those of [`fill`]; [`FillError::Option`] for lanes that are no distance.
    ///
    /// # Complexity
    /// That of [`fill`], and a few offsets of the zone.
    ///
    /// # Example
    /// ```
    /// use argil_skin::{DVec2, Section, SkinOptions};
    /// use geo_types::{MultiPolygon, Rect};
    /// let outline = MultiPolygon(vec![Rect::new((0.0, 0.0), (20.0, 20.0)).to_polygon()]);
    /// let corners = [(0.75, 0.75), (19.25, 0.75), (19.25, 19.25), (0.75, 19.25)];
    /// let walls = [corners.map(DVec2::from).to_vec()];
    /// let filled = Section { outline: &outline, walls: &walls }.filled(&outline, &SkinOptions::for_width(1.5), &[])?;
    /// assert_eq!(filled.loops.iter().map(|l| l.fill).collect::<Vec<_>>(), [false, true]);
    /// assert_eq!(filled.loops[1].parent, Some(0));
    /// # Ok::<(), argil_skin::FillError>(())
    /// ```
    pub fn filled(
        &self,
        zone: &MultiPolygon<f64>,
        options: &SkinOptions,
        avoid: &[DVec2],
    ) -> Result<Filled, FillError> {
        let width = options.width()?;
        let wall = |points: &Vec<DVec2>| ModelLoop { points: points.clone(), fill: false, parent: None };
        let mut filled = Filled { loops: self.walls.iter().map(wall).collect(), ..Filled::default() };
        let room = self.room(zone, options, width);
        if !room.0.is_empty() {
            let lanes = options.laid();
            let made = simple_fill(&room, &lanes, avoid)?;
            filled.joints = made.joints.iter().map(Joint::middle).collect();
            // A bead covers more than a lane that is narrower.
            let covered = width - lanes.width;
            let narrowed = |disc: BareDisc| BareDisc { diameter: disc.diameter - covered, ..disc };
            let listed = made.bare.into_iter().map(narrowed).filter(|disc| disc.diameter > 0.0);
            // Where there is no lane to measure from, the edge of the room is where the next bead or the next solid begins.
            let bounded = |disc: BareDisc| BareDisc {
                diameter: disc.diameter.min(2.0 * edge_distance(&room, disc.centre)),
                ..disc
            };
            filled.bare = listed.map(bounded).collect();
            let curves = made.curves.into_iter();
            filled.loops.extend(curves.map(|curve| ModelLoop {
                points: curve.points,
                fill: true,
                parent: None,
            }));
        }
        nest(&mut filled.loops);
        Ok(filled)
    }

    /// What the walls leave of the layer.
    pub(crate) fn inside(&self, options: &SkinOptions, width: f64) -> MultiPolygon<f64> {
        let outline = plainer(self.outline, width);
        let walls = options.walls as f64;
        if options.walls == 0 { outline } else { grown(&outline, -walls * width, width) }
    }

    /// What of a zone the walls leave to be filled.
    pub(crate) fn room(
        &self,
        zone: &MultiPolygon<f64>,
        options: &SkinOptions,
        width: f64,
    ) -> MultiPolygon<f64> {
        if zone.0.is_empty() {
            return MultiPolygon(Vec::new());
        }
        let inside = self.inside(options, width);
        let room = opened(&cleaned(inside.intersection(zone), width), SLIGHT * width, width);
        let under = grown(&narrow(&room, width), UNDER * width, width).intersection(&inside);
        let room = if under.0.is_empty() { room } else { room.union(&under) };
        let between = narrow(&room, width);
        if !options.tight || between.0.is_empty() {
            return room;
        }
        room.union(&grown(&between, BETWEEN * width, width))
    }
}

/// How far the edge of a room is.
fn edge_distance(room: &MultiPolygon<f64>, p: DVec2) -> f64 {
    let rings = room.iter().flat_map(|part| std::iter::once(part.exterior()).chain(part.interiors()));
    let distances = rings.map(|ring| Euclidean.distance(&Point::new(p.x, p.y), ring));
    distances.fold(f64::INFINITY, f64::min)
}

/// A fill of which no curve touches itself, if need be of a room whose narrow corners are left out. What is not simple then is left to
/// whoever joins the loops, and checks them.
fn simple_fill(room: &MultiPolygon<f64>, options: &FillOptions, avoid: &[DVec2]) -> Result<Fill, FillError> {
    let is_simple = |made: &Fill| made.curves.iter().all(|curve| is_apart(&curve.points, options.grid));
    let first = whole_fill(room, options, avoid)?;
    if is_simple(&first) {
        return Ok(first);
    }
    for radius in LEFT_OUT {
        let next = whole_fill(&opened(room, radius * options.width, options.width), options, avoid)?;
        if is_simple(&next) {
            return Ok(next);
        }
    }
    Ok(first)
}

/// The fill of a room, of which each part has a lane if one fits: a short ring without a neighbour to join is left out of a fill, but kept
/// where it is called a wall.
fn whole_fill(room: &MultiPolygon<f64>, options: &FillOptions, avoid: &[DVec2]) -> Result<Fill, FillError> {
    let mut made = fill(room, &[], &FillOptions { walls: 0, ..*options }, avoid)?;
    let has_lane = |part: &Polygon<f64>| {
        let on_lane = |p: &DVec2| part.contains(&Point::new(p.x, p.y));
        made.curves.iter().any(|curve| curve.points.iter().any(on_lane))
    };
    let without = MultiPolygon(room.iter().filter(|part| !has_lane(part)).cloned().collect());
    if !without.0.is_empty() {
        let more = fill(&without, &[], &FillOptions { walls: 1, ..*options }, avoid)?;
        made.bare.retain(|disc| !without.contains(&Point::new(disc.centre.x, disc.centre.y)));
        made.bare.extend(more.bare);
        made.curves.extend(more.curves);
        made.joints.extend(more.joints);
    }
    Ok(made)
}

/// The parts of a room that are too narrow for a bead, but for slivers.
fn narrow(room: &MultiPolygon<f64>, width: f64) -> MultiPolygon<f64> {
    let narrow = room.difference(&opened(room, NARROW * width, width));
    opened(&cleaned(narrow, width), SLIGHT * width, width)
}
