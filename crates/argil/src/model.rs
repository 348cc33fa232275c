//! What of each layer is the model: its walls, and the fill that closes floors, roofs and undersides.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil_fill::FillOptions;
use argil_route::{Cycle, Leg, Wall};
use argil_skin::{Bumps, ModelLoop, Section, SkinOptions, bumped, zones};
use argil_slice::Layer;
use argil_support::SupportPoint;

use crate::stages::Support;
use crate::{LayerFault, PlanError, Settings};

/// Rounds in which lanes give way to what the layer above needs: a bump may leave something unheld that the straight lane held.
const ROUNDS: usize = 4;

/// The farthest that a lane gives way, in w. Half way between two lanes a need is half a bead from either.
const BUMP: f64 = 0.45;

/// The loops that a layer of the model consists of.
#[derive(Clone, Debug)]
pub(crate) struct ModelLayer {
    pub(crate) loops: Vec<ModelLoop>,
    /// Widest disc of a filled zone that stays bare, mm.
    pub(crate) widest_bare: f64,
}

/// The loops of all layers, bottom first.
///
/// # Errors
/// [`PlanError::Layer`] where a zone cannot be filled.
pub(crate) fn model(layers: &[Layer], settings: &Settings) -> Result<Vec<ModelLayer>, PlanError> {
    let walls_only = |layer: &Layer| ModelLayer {
        loops: layer
            .walls
            .iter()
            .map(|wall| ModelLoop { points: wall.points.clone(), fill: false, parent: wall.parent })
            .collect(),
        widest_bare: 0.0,
    };
    if settings.floor == 0 && settings.skin == 0 {
        return Ok(layers.iter().map(walls_only).collect());
    }
    let options = SkinOptions {
        walls: settings.walls,
        floor: settings.floor,
        skin: settings.skin,
        tight: false,
        fill: FillOptions { walls: 0, grid: settings.grid, ..FillOptions::for_width(settings.width) },
    };
    let fault = |layer: &Layer, fault: argil_skin::FillError| PlanError::Layer {
        layer: layer.index,
        near: layer.walls.first().and_then(|wall| wall.points.first()).copied().unwrap_or_default(),
        fault: LayerFault::Fill(fault),
    };
    let outlines: Vec<_> = layers.iter().map(|layer| &layer.outline).collect();
    let zones = match (zones(&outlines, &options), layers.first()) {
        (Ok(zones), _) => zones,
        (Err(error), Some(layer)) => return Err(fault(layer, error)),
        (Err(_), None) => Vec::new(),
    };
    let mut avoid = Vec::new();
    let mut filled = Vec::with_capacity(layers.len());
    for (k, (layer, zone)) in layers.iter().zip(&zones).enumerate() {
        if zone.0.is_empty() {
            avoid.clear();
            filled.push(walls_only(layer));
            continue;
        }
        let walls: Vec<Vec<DVec2>> = layer.walls.iter().map(|wall| wall.points.clone()).collect();
        let section = Section { outline: &layer.outline, walls: &walls };
        let options = SkinOptions { tight: k < settings.floor, ..options };
        let made = section.filled(zone, &options, &avoid).map_err(|error| fault(layer, error))?;
        let widest_bare = made.bare.iter().map(|disc| disc.diameter).fold(0.0, f64::max);
        filled.push(ModelLayer { loops: made.loops, widest_bare });
        avoid = made.joints;
    }
    Ok(filled)
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
