//! One layer: its walls, and the fill of its zone merged with them.

use argil_curve::{DVec2, SegmentIndex};
use argil_fill::{BareDisc, Bead, FillError, FillOptions, Ring, fill};
use geo::{BooleanOps, Contains};
use geo_types::{LineString, MultiPolygon, Point, Polygon};

use crate::model_loop::nest;
use crate::offset::{cleaned, grown, opened};
use crate::{ModelLoop, SkinOptions};

/// Radius of the disc that fits everywhere into a region that is filled, in w. Narrower parts would hold no bead.
const SLIGHT: f64 = 0.3;

/// Walls at least this near to what is filled are merged with it, in w; the nearest lies half a bead from it.
const BESIDE: f64 = 0.8;

/// How far beside a joint strand must not be attached to the wall, in w.
const ROOT: f64 = 0.45;

/// One layer of the model.
#[derive(Clone, Copy, Debug)]
pub struct Section<'a> {
    /// What is solid.
    pub outline: &'a MultiPolygon<f64>,
    /// Its walls: simple, disjoint, on the output grid.
    pub walls: &'a [Ring],
}

/// A layer's walls and fill.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filled {
    /// The loops. None crosses itself or another; every stretch of a wall is there but for a tenth of a bead a joint.
    pub loops: Vec<ModelLoop>,
    /// Places on walls right beside joints with the fill: strand that came from outside and was attached here would seem to
    /// go through the wall.
    pub roots: Vec<DVec2>,
    /// The middles of all joints, for the next layer to keep its own away from.
    pub joints: Vec<DVec2>,
    /// Discs that stay bare, as [`argil_fill::Fill::bare`] lists them.
    pub bare: Vec<BareDisc>,
}

impl Section<'_> {
    /// Fills what the walls leave of a zone, and joins the fill with the walls beside it to as few loops as possible.
    ///
    /// `avoid` are places to keep joints away from, such as [`Filled::joints`] of the layer below.
    ///
    /// # Errors
    /// Those of [`fill`].
    ///
    /// # Complexity
    /// That of [`fill`], and a few offsets of the zone.
    ///
    /// # Example
    /// ```
    /// use argil_fill::Ring;
    /// use argil_skin::{DVec2, Section, SkinOptions};
    /// use geo_types::{MultiPolygon, Rect};
    /// let outline = MultiPolygon(vec![Rect::new((0.0, 0.0), (20.0, 20.0)).to_polygon()]);
    /// let corners = [(0.75, 0.75), (19.25, 0.75), (19.25, 19.25), (0.75, 19.25)];
    /// let walls = [Ring { points: corners.map(DVec2::from).to_vec(), wall: Some(0) }];
    /// let section = Section { outline: &outline, walls: &walls };
    /// let filled = section.filled(&outline, &SkinOptions::for_width(1.5), &[])?;
    /// assert_eq!(filled.loops.len(), 1); // wall and floor are one loop
    /// assert!(filled.loops[0].fill.iter().any(|&fill| fill) && !filled.loops[0].fill.iter().all(|&fill| fill));
    /// # Ok::<(), argil_skin::FillError>(())
    /// ```
    pub fn filled(
        &self,
        zone: &MultiPolygon<f64>,
        options: &SkinOptions,
        avoid: &[DVec2],
    ) -> Result<Filled, FillError> {
        let width = options.width()?;
        let mut filled = Filled::default();
        let mut rest: Vec<bool> = vec![true; self.walls.len()];
        for polygon in if zone.0.is_empty() { &[][..] } else { self.outline.0.as_slice() } {
            let room = room(polygon, zone, options.walls, width);
            if room.0.is_empty() {
                continue;
            }
            let near = edges(&room, width);
            let beside: Vec<usize> = (0..self.walls.len())
                .filter(|&k| rest[k] && is_beside(&self.walls[k], polygon, &near, width))
                .collect();
            beside.iter().for_each(|&k| rest[k] = false);
            let rings: Vec<Ring> = beside.iter().map(|&k| self.walls[k].clone()).collect();
            let made = fill(&room, &rings, &FillOptions { walls: 0, ..options.fill }, avoid)?;
            for joint in &made.joints {
                let on_wall = |side: usize| joint.rings[side] < rings.len();
                for side in [0, 1].into_iter().filter(|&side| on_wall(side)) {
                    let [one, other] = joint.legs.map(|leg| leg[side]);
                    let along = (other - one).normalize_or_zero() * ROOT * width;
                    filled.roots.extend([one - along, other + along]);
                }
                filled.joints.push(joint.middle());
            }
            filled.bare.extend(made.bare);
            filled.loops.extend(made.curves.into_iter().map(|curve| ModelLoop {
                fill: curve.beads.iter().map(|bead| !matches!(bead, Bead::Wall(_))).collect(),
                points: curve.points,
                parent: None,
            }));
        }
        let walls = self.walls.iter().zip(rest).filter(|(_, rest)| *rest);
        filled.loops.extend(walls.map(|(wall, _)| ModelLoop::of_wall(wall.points.clone(), None)));
        nest(&mut filled.loops);
        Ok(filled)
    }
}

/// What of a zone in one part of the outline its walls leave to be filled.
fn room(polygon: &Polygon<f64>, zone: &MultiPolygon<f64>, walls: usize, width: f64) -> MultiPolygon<f64> {
    let part = MultiPolygon(vec![polygon.clone()]);
    let inside = if walls == 0 { part } else { grown(&part, -(walls as f64) * width, width) };
    opened(&cleaned(inside.intersection(zone), width), SLIGHT * width, width)
}

fn edges(region: &MultiPolygon<f64>, width: f64) -> SegmentIndex {
    let rings = region.iter().flat_map(|part| std::iter::once(part.exterior()).chain(part.interiors()));
    let sides = rings.flat_map(LineString::lines).map(|side| {
        argil_curve::Segment::new(DVec2::new(side.start.x, side.start.y), DVec2::new(side.end.x, side.end.y))
    });
    SegmentIndex::new(sides.filter(|side| side.length() > 0.0).collect(), width)
}

/// Whether a wall belongs to this part of the outline and runs along what is filled.
fn is_beside(wall: &Ring, polygon: &Polygon<f64>, near: &SegmentIndex, width: f64) -> bool {
    let Some(first) = wall.points.first() else { return false };
    let closed = wall.points.iter().zip(wall.points.iter().cycle().skip(1));
    polygon.contains(&Point::new(first.x, first.y))
        && closed.map(|(a, b)| argil_curve::Segment::new(*a, *b)).any(|side| {
            let mut beside = false;
            near.for_each_near(side, BESIDE * width, |_, edge| {
                beside |= side.distance_to(&edge) < BESIDE * width;
            });
            beside
        })
}
