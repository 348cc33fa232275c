//! What of each layer is the model: its walls, and the fill that closes floors, roofs and undersides.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil_fill::{FillOptions, FillPattern};
use argil_route::{Cycle, Leg, Wall};
use argil_skin::{Bumps, ModelLoop, Section, SkinOptions, Stripes, beneath, bumped, zones};
use argil_slice::{Layer, WallLoop};
use argil_support::SupportPoint;

use crate::stages::Support;
use crate::{Infill, LayerFault, PlanError, Settings};

/// Rounds in which lanes give way to what the layer above needs: a bump may leave something unheld that the straight lane held.
const ROUNDS: usize = 4;

/// The farthest that a lane gives way, in w. Half way between two lanes a need is half a bead from either.
const BUMP: f64 = 0.45;

/// Distance of the lanes of floors and skins, in w. Where a joint is cut out of a lane beside a wall stays a place 0.54 w from the middle of
/// every bead (at 0.85 it would be 0.56 w), and what is no farther than 0.55 w is closed by clay that spreads a little. Where layers so
/// filled cannot be planned or joined, lanes lie as far apart as a bead is wide.
pub(crate) const LANES: [f64; 2] = [0.8, 1.0];

/// The loops that a layer of the model consists of.
#[derive(Clone, Debug)]
pub(crate) struct ModelLayer {
    pub(crate) loops: Vec<ModelLoop>,
    /// How many of them, the last ones, are sparse fill.
    sparse: usize,
    /// Widest disc of a filled zone that stays bare, mm.
    pub(crate) widest_bare: f64,
}

/// The loops of all layers, bottom first, with this infill and lanes so many w apart.
///
/// # Errors
/// [`PlanError::Layer`] where a zone cannot be filled.
pub(crate) fn model(
    layers: &[Layer],
    settings: &Settings,
    infill: Infill,
    lanes: f64,
) -> Result<Vec<ModelLayer>, PlanError> {
    if settings.floor == 0 && settings.skin == 0 && !matches!(infill, Infill::Ratio(_)) {
        return Ok(layers.iter().map(walls_only).collect());
    }
    let options = SkinOptions {
        walls: settings.walls,
        floor: settings.floor,
        skin: settings.skin,
        lanes,
        tight: false,
        fill: FillOptions {
            walls: 0,
            grid: settings.grid,
            pattern: if settings.spirals { FillPattern::Spirals } else { FillPattern::Rings },
            ..FillOptions::for_width(settings.width)
        },
    };
    let walls: Vec<Vec<Vec<DVec2>>> =
        layers.iter().map(|layer| layer.walls.iter().map(|wall| wall.points.clone()).collect()).collect();
    let sections: Vec<Section<'_>> =
        layers.iter().zip(&walls).map(|(layer, walls)| Section { outline: &layer.outline, walls }).collect();
    let everywhere = |error| match layers.first() {
        Some(layer) => fault(layer, error),
        None => PlanError::Nothing,
    };
    let outlines: Vec<_> = layers.iter().map(|layer| &layer.outline).collect();
    let zones = zones(&outlines, &options).map_err(everywhere)?;
    let hollow = match infill {
        Infill::Auto => beneath(&sections, &zones, settings.retreat(), &options).map_err(everywhere)?,
        _ => Vec::new(),
    };
    let stripes = match infill {
        Infill::None => None,
        Infill::Ratio(share) => Some(stripes(layers, settings.width / share)),
        Infill::Auto => Some(stripes(layers, settings.bridged())),
    };
    let mut avoid = Vec::new();
    let mut filled = Vec::with_capacity(layers.len());
    for (k, ((layer, zone), section)) in layers.iter().zip(&zones).zip(&sections).enumerate() {
        let within = hollow.get(k);
        let stripes = stripes.filter(|_| within.is_none_or(|within| !within.0.is_empty()));
        if zone.0.is_empty() && stripes.is_none() {
            avoid.clear();
            filled.push(walls_only(layer));
            continue;
        }
        let options = SkinOptions { tight: k < settings.floor, ..options };
        let mut made = section.filled(zone, &options, &avoid).map_err(|error| fault(layer, error))?;
        let closed = made.loops.len();
        if let Some(stripes) = stripes {
            section
                .striped(&mut made, (zone, within), &stripes, &options)
                .map_err(|error| fault(layer, error))?;
        }
        let widest_bare = made.bare.iter().map(|disc| disc.diameter).fold(0.0, f64::max);
        filled.push(ModelLayer { sparse: made.loops.len() - closed, loops: made.loops, widest_bare });
        avoid = made.joints;
    }
    Ok(filled)
}

fn walls_only(layer: &Layer) -> ModelLayer {
    let wall = |wall: &WallLoop| ModelLoop { points: wall.points.clone(), fill: false, parent: wall.parent };
    ModelLayer { loops: layer.walls.iter().map(wall).collect(), sparse: 0, widest_bare: 0.0 }
}

fn fault(layer: &Layer, fault: argil_skin::FillError) -> PlanError {
    PlanError::Layer {
        layer: layer.index,
        near: layer.walls.first().and_then(|wall| wall.points.first()).copied().unwrap_or_default(),
        fault: LayerFault::Fill(fault),
    }
}

/// Stripes through the middle of all layers, along their longer side: they are fewer then.
fn stripes(layers: &[Layer], pitch: f64) -> Stripes {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for point in layers.iter().flat_map(|layer| &layer.walls).flat_map(|wall| &wall.points) {
        (low, high) = (low.min(*point), high.max(*point));
    }
    let size = high - low;
    let origin = if size.is_finite() { low.midpoint(high) } else { DVec2::ZERO };
    Stripes { pitch, origin: origin - 0.5 * pitch, upright: size.y > size.x }
}

impl ModelLayer {
    /// The loops as the route stage takes them.
    pub(crate) fn walls(&self) -> Vec<Wall<'_>> {
        self.loops.iter().map(|one| Wall { points: &one.points, parent: one.parent }).collect()
    }

    /// All stretches of the loops.
    pub(crate) fn index(&self, width: f64) -> SegmentIndex {
        SegmentIndex::new(sides(&self.loops).map(|(side, _)| side).collect(), width)
    }

    /// What the layer must hold beside what its loops hold, after their fill has given way where it can.
    pub(crate) fn supports(
        &mut self,
        above: &ClosedCurve,
        support: &mut impl Support,
        settings: &Settings,
    ) -> Vec<SupportPoint> {
        let mut found = support.points(above, &self.index(settings.width), settings);
        if !self.loops.iter().any(|one| one.fill) {
            return found;
        }
        let bumps = Bumps {
            width: settings.width,
            within: settings.envelope(),
            most: BUMP * settings.width,
            grid: settings.grid,
        };
        for _ in 0..ROUNDS {
            let needs: Vec<DVec2> = found.iter().flat_map(|point| point.needs.iter().copied()).collect();
            if bumped(&mut self.loops, &needs, &bumps) == 0 {
                break;
            }
            found = support.points(above, &self.index(settings.width), settings);
        }
        found
    }

    /// Length of the sparse fill, mm.
    pub(crate) fn sparse_length(&self) -> f64 {
        let sparse = &self.loops[self.loops.len() - self.sparse.min(self.loops.len())..];
        // The standard library's sum of nothing is −0.
        sides(sparse).fold(0.0, |sum, (side, _)| sum + side.length())
    }

    /// Which stretches of a cycle through these loops are fill.
    pub(crate) fn fill_of(&self, cycle: &Cycle, width: f64) -> Vec<bool> {
        let n = cycle.points.len();
        if !self.loops.iter().any(|one| one.fill) {
            return vec![false; n];
        }
        let (sides, fill): (Vec<Segment>, Vec<bool>) = sides(&self.loops).unzip();
        let index = SegmentIndex::new(sides, width);
        let is_fill = |k: usize| {
            let middle = cycle.points[k].midpoint(cycle.points[(k + 1) % n]);
            cycle.legs[k] == Leg::Wall && index.nearest(middle).is_some_and(|near| fill[near.index])
        };
        (0..n).map(is_fill).collect()
    }
}

/// All stretches of loops, and whether they are fill.
fn sides(loops: &[ModelLoop]) -> impl Iterator<Item = (Segment, bool)> + '_ {
    loops.iter().flat_map(|one| {
        let points = &one.points;
        (0..points.len()).map(move |k| (Segment::new(points[k], points[(k + 1) % points.len()]), one.fill))
    })
}
