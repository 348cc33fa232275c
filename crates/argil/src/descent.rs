//! The pass from the top layer to the bottom: each layer holds the one above.

use std::time::{Duration, Instant};

use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
use argil_elastic::{Carrier, Clearance, Path};
use argil_route::{Cycle, Demand, LayerInput, Leg};
use argil_slice::Layer;
use argil_support::SupportPoint;
use argil_taut::SlackPath;
use geo_types::MultiPolygon;

use crate::blunt::blunted;
use crate::clearance::SafeguardField;
use crate::error::LayerFault;
use crate::foothold::{Foothold, hold_start};
use crate::hold::{Check, Fault};
use crate::model::ModelLayer;
use crate::passage::Walled;
use crate::settle::{Keeping, settle};
use crate::stages::{Route, Smooth, Support, Tauten};
use crate::{LayerReport, PlanError, Progress, Settings, StageTimes};

/// A layer that is planned.
#[derive(Clone, Debug)]
pub(crate) struct PlannedLayer {
    pub(crate) report: LayerReport,
    pub(crate) z: f64,
    pub(crate) curve: ClosedCurve,
    pub(crate) legs: Vec<Leg>,
    /// Which stretches are fill, and no wall, though they are legs of that kind.
    pub(crate) fill: Vec<bool>,
    pub(crate) supports: Vec<SupportPoint>,
    /// Arc length of a place where the layer may begin.
    pub(crate) foothold: f64,
}

/// What is wrong with a layer, and where.
type Flaw = (LayerFault, Option<DVec2>);

/// How often a layer is planned again with the places of what is wrong barred.
const RETRIES: usize = 6;

/// How often sharp turns are cut: a cut may leave two that are sharp themselves, or not hold what the turn held and be given up.
const BLUNTINGS: usize = 6;

/// What the attempts at a layer share.
struct Site<'a> {
    layer: &'a Layer,
    model: ModelLayer,
    /// The walls by themselves.
    curves: &'a [ClosedCurve],
    /// All of the model.
    walls: SegmentIndex,
    supports: Vec<SupportPoint>,
    field: SafeguardField,
    above: Option<&'a ClosedCurve>,
    start: Option<Foothold>,
    /// The index of the support that the start asks for.
    guide: Option<usize>,
}

/// A cycle that holds the layer above and crosses itself nowhere.
struct Attempt {
    report: LayerReport,
    curve: ClosedCurve,
    legs: Vec<Leg>,
    fill: Vec<bool>,
}

/// The stages that a descent uses, and what it has learnt so far.
pub(crate) struct Descent<'a, U, R, E, T> {
    pub(crate) settings: &'a Settings,
    pub(crate) support: &'a mut U,
    pub(crate) route: &'a mut R,
    pub(crate) smooth: &'a mut E,
    pub(crate) taut: &'a mut T,
    pub(crate) times: &'a mut StageTimes,
    /// Whether every layer must pass the exact check.
    pub(crate) checked: bool,
    pub(crate) keeping: Keeping,
}

impl<U: Support, R: Route, E: Smooth, T: Tauten> Descent<'_, U, R, E, T> {
    /// Plans all layers, the top one first; the result is bottom first. `walls` are those of the layers, `models` the loops that they
    /// are part of. Layers above the first wall from the top
    /// have nothing to print; below it, every layer has at least something to hold.
    pub(crate) fn run(
        &mut self,
        layers: &[Layer],
        (models, walls): (&[ModelLayer], &[Vec<ClosedCurve>]),
        safeguards: &[MultiPolygon<f64>],
        observe: &mut dyn FnMut(Progress),
    ) -> Result<Vec<PlannedLayer>, PlanError> {
        let mut planned: Vec<PlannedLayer> = Vec::with_capacity(layers.len());
        let walls_of = |k: usize| SegmentIndex::of_curves(&walls[k], self.settings.width);
        let mut start: Option<Foothold> = None;
        // What is below one layer are the walls of the next.
        let mut standing: Option<SegmentIndex> = None;
        for (k, (layer, safeguard)) in layers.iter().zip(safeguards).enumerate().rev() {
            let above = planned.last().map(|p| &p.curve);
            if above.is_none() && layer.walls.is_empty() {
                continue;
            }
            let near = walls[k].first().or(above).map(|curve| curve.points()[0]);
            let done = self.layer((layer, &models[k], &walls[k]), safeguard, above, start).map_err(
                |(fault, at)| PlanError::Layer {
                    layer: layer.index,
                    near: at.or(near).unwrap_or_default(),
                    fault,
                },
            )?;
            let below = k.checked_sub(1).map_or_else(|| SegmentIndex::new(Vec::new(), 1.0), walls_of);
            let (own, seam) = (standing.take().unwrap_or_else(|| walls_of(k)), self.settings.seaming());
            let settled = settle(&done.curve, &planned, start, [&own, &below], &seam, self.keeping);
            planned.iter_mut().rev().zip(settled.above).for_each(|(layer, arc)| layer.foothold = arc);
            start = Some(settled.start);
            standing = Some(below);
            planned.push(PlannedLayer { foothold: settled.start.arc, ..done });
            observe(Progress::Layer { index: layer.index });
        }
        planned.reverse();
        Ok(planned)
    }

    /// Plans a layer; again, with the places of what is wrong kept free of attachments, where a strand would go through a wall or
    /// no sound path is found. If that does not help, the plan with the fewest passages stands.
    fn layer(
        &mut self,
        (layer, model, curves): (&Layer, &ModelLayer, &[ClosedCurve]),
        safeguard: &MultiPolygon<f64>,
        above: Option<&ClosedCurve>,
        start: Option<Foothold>,
    ) -> Result<PlannedLayer, Flaw> {
        let settings = self.settings;
        let mut model = model.clone();
        let support = &mut *self.support;
        let mut supports = timed(&mut self.times.support, || {
            above.map_or_else(Vec::new, |above| model.supports(above, support, settings))
        });
        let walls = model.index(settings.width);
        let guide = start.and_then(|start| hold_start(start, &mut supports, settings));
        let field = SafeguardField::new(safeguard, 2.0 * settings.width);
        let mut barred = Vec::new();
        let mut site = Site { layer, model, curves, walls, supports, field, above, start, guide };

        let walled = Walled::new(&layer.walled, settings.width);
        let passages = |done: &Attempt| walled.passages(&done.curve);
        let mut best = self.attempt(&site, &barred);
        let mut flawed = places(&best, passages);
        let mut fewest = if best.is_ok() { flawed.len() } else { usize::MAX };
        for _ in 0..RETRIES {
            // Nothing comes of what is barred already.
            if !self.checked || flawed.iter().all(|place| barred.contains(place)) {
                break;
            }
            barred.append(&mut flawed);
            if let (Err(_), Some(guide)) = (&best, site.guide.take()) {
                // What leads on from the start may be what stands in the way.
                site.supports.truncate(guide);
            }
            let next = self.attempt(&site, &barred);
            flawed = places(&next, passages);
            if next.is_ok() && flawed.len() < fewest {
                (best, fewest) = (next, flawed.len());
            }
        }
        let Attempt { report, curve, legs, fill } = best?;
        Ok(PlannedLayer {
            report,
            z: layer.print_z,
            curve,
            legs,
            fill,
            supports: site.supports,
            foothold: 0.0,
        })
    }

    /// Plans a layer with no attachment near the barred places.
    fn attempt(&mut self, site: &Site<'_>, barred: &[DVec2]) -> Result<Attempt, Flaw> {
        let settings = self.settings;
        let Site { layer, model, curves, walls: wall_index, supports, field, above, start, guide } = site;
        let walls = model.walls();
        let demands: Vec<Demand> =
            supports.iter().map(|s| Demand { position: s.position, anchors: s.needs.clone() }).collect();
        let above_index = above.map(|c| SegmentIndex::of_curves([c], 0.5 * settings.width));
        let rings = field.polylines();
        let input = LayerInput {
            walls: &walls,
            demands: &demands,
            safeguard: &rings,
            above: above_index.as_ref(),
            barred,
        };
        let route = &mut self.route;
        let candidate = timed(&mut self.times.route, || route.cycle(&input, settings))
            .map_err(|fault| (fault.into(), None))?;

        let check = Check {
            above: *above,
            criterion: settings.criterion(),
            width: settings.width,
            grid: settings.grid,
        };
        let felt = outside(&candidate, curves);
        let (points, pulled_back) = self.smoothed(&candidate, supports, (field, &felt), &check)?;
        let mut fixed = candidate.fixed.clone();
        candidate.carriers.iter().filter(|c| Some(c.1) == *guide).for_each(|c| fixed[c.0] = true);
        let slack = SlackPath {
            points: &points,
            fixed: &fixed,
            above: *above,
            starts: &start.map(|s| s.at).into_iter().collect::<Vec<_>>(),
            walls: wall_index,
            clear_of: Some(&|p| field.distance(p).0),
            felt: &felt,
        };
        let taut = &mut self.taut;
        let mut taut = timed(&mut self.times.taut, || taut.points(&slack, settings));
        let cycle = timed(&mut self.times.check, || {
            check.rounded(&mut taut, &candidate.fixed);
            let points = if self.checked && check.fault(&taut).is_some() { points } else { taut };
            let mut cycle = Cycle { points, ..candidate };
            let mut failed: Vec<DVec2> = Vec::new();
            for _ in 0..BLUNTINGS {
                let Some(mut next) = blunted(&cycle, settings.width, &failed) else { break };
                check.rounded(&mut next.points, &next.fixed);
                match check.fault(&next.points).filter(|_| self.checked) {
                    None => cycle = next,
                    Some(Fault::Unsupported { at, .. } | Fault::Crossing { at }) => {
                        failed.extend(scattered(at, settings.width));
                    }
                }
            }
            cycle
        });
        for (vertex, demand) in &cycle.carriers {
            debug_assert!(*vertex < cycle.points.len() && *demand < supports.len());
        }
        let (cycle, fill) = without_repeats(&cycle, &model.fill_of(&cycle, settings.width));
        let n = fill.len();
        let side = |k: usize| cycle.points[k].distance(cycle.points[(k + 1) % n]);
        // The standard library's sum of nothing is −0.
        let fill_length = (0..n).filter(|&k| fill[k]).fold(0.0, |sum, k| sum + side(k));
        let report = LayerReport {
            index: layer.index,
            walls: layer.walls.len(),
            supports: supports.len(),
            roots: cycle.roots,
            wall_length: cycle.length_of(Leg::Wall) - fill_length,
            fill_length,
            infill_length: model.sparse_length(),
            widest_bare: model.widest_bare,
            free_length: cycle.length_of(Leg::Support) + cycle.length_of(Leg::Joint),
            pulled_back,
            bead_heights: [settings.layer_height; 2],
            ..LayerReport::default()
        };
        let curve = ClosedCurve::new(cycle.points).map_err(|e| (e.into(), None))?;
        Ok(Attempt { report, curve, legs: cycle.legs, fill })
    }

    /// The smoothed candidate, repaired until it holds the cycle above, and how many vertices that pulled back.
    fn smoothed(
        &mut self,
        candidate: &Cycle,
        supports: &[SupportPoint],
        (field, felt): (&SafeguardField, &[bool]),
        check: &Check<'_>,
    ) -> Result<(Vec<DVec2>, usize), Flaw> {
        let settings = self.settings;
        let envelope = settings.envelope();
        let carriers: Vec<Carrier> = candidate
            .carriers
            .iter()
            .flat_map(|&(vertex, demand)| {
                supports[demand].needs.iter().map(move |&anchor| Carrier { vertex, anchor })
            })
            .filter(|c| !candidate.fixed[c.vertex])
            // One that starts out on the rim has no room; the check after smoothing looks after it.
            .filter(|c| candidate.points[c.vertex].distance(c.anchor) < 0.98 * envelope)
            .collect();
        let clear_of: &dyn Clearance = field;
        let path = Path {
            points: &candidate.points,
            fixed: &candidate.fixed,
            carriers: &carriers,
            clear_of: Some(clear_of),
            felt,
        };
        let smooth = &mut self.smooth;
        let mut points = timed(&mut self.times.smooth, || smooth.points(&path, settings))
            .map_err(|fault| (fault.into(), None))?;
        let pulled_back = timed(&mut self.times.check, || {
            if self.checked {
                check.repair(&mut points, &candidate.points, &candidate.fixed)
            } else {
                check.rounded(&mut points, &candidate.fixed);
                Ok(0)
            }
        })
        .map_err(|fault| match fault {
            Fault::Unsupported { at, length } => (LayerFault::Unsupported { length }, at.first().copied()),
            Fault::Crossing { at } => (LayerFault::Crossing, at.first().copied()),
        })?;
        Ok((points, pulled_back))
    }
}

/// Where a layer is to be planned otherwise: its passages, or where it failed.
fn places(plan: &Result<Attempt, Flaw>, passages: impl Fn(&Attempt) -> Vec<DVec2>) -> Vec<DVec2> {
    match plan {
        Ok(done) => passages(done),
        Err((_, at)) => at.iter().copied().collect(),
    }
}

/// Those of the places that lie farther than a bead from all before them.
fn scattered(places: Vec<DVec2>, width: f64) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::new();
    for place in places {
        if kept.iter().all(|p| p.distance(place) > width) {
            kept.push(place);
        }
    }
    kept
}

/// Which free vertices lie outside of all walls, where strand must clear what stands further down.
///
/// No wall parts a free vertex from the free one before it, for no strand goes through walls.
fn outside(candidate: &Cycle, curves: &[ClosedCurve]) -> Vec<bool> {
    let outer: Vec<&ClosedCurve> = curves.iter().filter(|c| c.signed_area() > 0.0).collect();
    let mut before = None;
    let free = candidate.points.iter().zip(&candidate.fixed);
    free.map(|(&p, fixed)| {
        before = (!fixed).then(|| before.unwrap_or_else(|| !outer.iter().any(|c| c.contains(p))));
        before == Some(true)
    })
    .collect()
}

/// The walls of a layer as curves.
///
/// # Errors
/// The first wall that is none, before any stage sees it.
pub(crate) fn wall_curves(layer: &Layer) -> Result<Vec<ClosedCurve>, PlanError> {
    let curve = |wall: &argil_slice::WallLoop| {
        ClosedCurve::new(wall.points.clone()).map_err(|fault| PlanError::Layer {
            layer: layer.index,
            near: wall.points.iter().copied().find(|p| p.is_finite()).unwrap_or_default(),
            fault: fault.into(),
        })
    };
    layer.walls.iter().map(curve).collect()
}

/// A cycle without vertices that rounding has put on top of their neighbour, and what is told of its stretches.
fn without_repeats(cycle: &Cycle, fill: &[bool]) -> (Cycle, Vec<bool>) {
    let n = cycle.points.len();
    // The stretch to an equal neighbour has no length and no purpose.
    let kept: Vec<usize> = (0..n).filter(|&k| cycle.points[k] != cycle.points[(k + 1) % n]).collect();
    let whole = Cycle {
        points: kept.iter().map(|&k| cycle.points[k]).collect(),
        fixed: kept.iter().map(|&k| cycle.fixed[k]).collect(),
        legs: kept.iter().map(|&k| cycle.legs[k]).collect(),
        carriers: Vec::new(),
        roots: cycle.roots,
    };
    (whole, kept.iter().map(|&k| fill[k]).collect())
}

/// Runs a piece of work and adds its time.
pub(crate) fn timed<T>(total: &mut Duration, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *total += start.elapsed();
    result
}
