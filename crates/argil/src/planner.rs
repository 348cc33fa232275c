//! The planner: the stages in their order.

use std::ops::ControlFlow;

use argil_curve::ClosedCurve;
use argil_mesh::Mesh;
use argil_slice::{Layer, outer_walls};
use geo_types::MultiPolygon;

use crate::climb::{Climbed, climbed};
use crate::descent::{Descent, PlannedLayer, timed, wall_curves};
use crate::flow::roomy;
use crate::foothold::Steps;
use crate::model::{LANES, ModelLayer, model};
use crate::settle::Keeping;
use crate::stages::{
    BestChain, ElasticCurve, Excursions, FewestPoints, PlaneSlices, PulledTaut, Route, Safeguard, Seam,
    Slice, SlopedSafeguard, Smooth, Support, Tauten,
};
use crate::watch::{Watch, Watched};
use crate::{Infill, InfillChoice, LayerReport, Plan, PlanError, Settings, StageTimes};

/// A step that rises at least one in so many is short for any bead: a longer one hangs on its way up.
const SLOPE: f64 = 2.4;

/// How far a plan has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Progress {
    /// No news: a stage that takes long asks whether it is to go on.
    Working,
    /// The mesh is cut into this many layers.
    Sliced {
        /// How many.
        layers: usize,
    },
    /// A cycle is sought for the next layer: the top one at first, then the one below that which was planned last; or for the same
    /// one again, where the cycle before was not sound.
    Routing,
    /// A cycle is found; it is smoothed, checked and pulled taut next.
    Smoothing,
    /// A layer is planned; they come from the top down.
    Layer {
        /// Its index, 0 at the bottom.
        index: usize,
    },
    /// All layers are planned; their starts are chosen next.
    Descended,
}

/// Plans prints. Every stage is a type parameter with argil's own as default.
///
/// ```
/// use argil::{Planner, Settings};
/// use argil::stages::ElasticCurve;
///
/// // The same planner with one stage given by hand.
/// let mut planner = Planner { smooth: ElasticCurve::default(), ..Planner::default() };
/// let mesh = argil::mesh::read_stl(&argil_models::by_name("columns").expect("bundled").to_stl())?;
/// let layers = planner.slices(&mesh, &Settings::for_width(2.0))?;
/// assert!(layers.len() > 10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Planner<
    S = PlaneSlices,
    G = SlopedSafeguard,
    U = FewestPoints,
    R = Excursions,
    E = ElasticCurve,
    T = PulledTaut,
    C = BestChain,
> {
    /// Mesh to layers.
    pub slice: S,
    /// Layers to the envelope that support keeps clear of.
    pub safeguard: G,
    /// A cycle to the points that it needs below.
    pub support: U,
    /// Walls and points to a cycle.
    pub route: R,
    /// A cycle to a shorter, smoother one.
    pub smooth: E,
    /// A sound cycle to one without slack.
    pub taut: T,
    /// Cycles to their starts.
    pub seam: C,
    /// Whether every layer must pass the exact check: it crosses itself nowhere and holds the layer above. Without it the
    /// planner takes what the stages give, as is wanted only to study a method that is not sound.
    pub checked: bool,
}

impl Default for Planner {
    fn default() -> Self {
        Self {
            slice: PlaneSlices,
            safeguard: SlopedSafeguard,
            support: FewestPoints,
            route: Excursions,
            smooth: ElasticCurve::default(),
            taut: PulledTaut,
            seam: BestChain,
            checked: true,
        }
    }
}

impl<S: Slice, G: Safeguard, U: Support, R: Route, E: Smooth, T: Tauten, C: Seam>
    Planner<S, G, U, R, E, T, C>
{
    /// The layers of a mesh.
    ///
    /// # Errors
    /// [`PlanError::Setting`] or [`PlanError::Slice`].
    pub fn slices(&mut self, mesh: &Mesh, settings: &Settings) -> Result<Vec<Layer>, PlanError> {
        settings.check()?;
        Ok(self.slice.layers(mesh, settings)?)
    }

    /// One strand for a mesh.
    ///
    /// # Errors
    /// See [`PlanError`]: with the layer and a point where it concerns a layer.
    ///
    /// # Complexity
    /// Linear in the layers; a layer costs about what its largest tour costs.
    pub fn plan(&mut self, mesh: &Mesh, settings: &Settings) -> Result<Plan, PlanError> {
        self.plan_observed(mesh, settings, &mut |_| {})
    }

    /// One strand for a mesh, telling `observe` how far it has come.
    ///
    /// # Errors
    /// See [`PlanError`].
    ///
    /// # Example
    /// ```
    /// use argil::{Planner, Progress, Settings, mesh::Mesh};
    ///
    /// let (mut all, mut done) = (0, 0);
    /// let mut bar = |progress| match progress {
    ///     Progress::Sliced { layers } => all = layers,
    ///     Progress::Layer { .. } => done += 1,
    ///     _ => {}
    /// };
    /// Planner::default().plan_observed(&Mesh::cuboid([0.0; 3], [9.0, 9.0, 3.0])?, &Settings::default(), &mut bar)?;
    /// assert!(all == 6 && done >= all, "{done} of {all}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn plan_observed(
        &mut self,
        mesh: &Mesh,
        settings: &Settings,
        observe: &mut dyn FnMut(Progress),
    ) -> Result<Plan, PlanError> {
        self.plan_controlled(mesh, settings, &mut |progress| {
            observe(progress);
            ControlFlow::Continue(())
        })
    }

    /// One strand for a mesh, for as long as `observe` wants it to go on. It is asked between stages and between layers, in
    /// each layer before a cycle is sought and before it is smoothed, and every few layers by stages that work on all of them.
    ///
    /// # Errors
    /// [`PlanError::Cancelled`] when it breaks off; else see [`PlanError`]. The planner can be used again in either case.
    ///
    /// # Example
    /// ```
    /// use std::ops::ControlFlow;
    /// use argil::{PlanError, Planner, Progress, Settings};
    ///
    /// let mesh = argil::mesh::read_stl(&argil_models::by_name("columns").expect("bundled").to_stl())?;
    /// let mut first_cycle = |progress| match progress {
    ///     Progress::Smoothing => ControlFlow::Break(()),
    ///     _ => ControlFlow::Continue(()),
    /// };
    /// let outcome = Planner::default().plan_controlled(&mesh, &Settings::for_width(2.0), &mut first_cycle);
    /// assert!(matches!(outcome, Err(PlanError::Cancelled)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn plan_controlled(
        &mut self,
        mesh: &Mesh,
        settings: &Settings,
        observe: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<Plan, PlanError> {
        let mut times = StageTimes::default();
        let watch = Watch::new(observe);
        settings.check()?;
        let goes_on = &mut || watch.tell(Progress::Working);
        let layers = timed(&mut times.slice, || self.slice.layers_while(mesh, settings, goes_on))?;
        let layers = layers.ok_or(PlanError::Cancelled)?;
        watch.tell(Progress::Sliced { layers: layers.len() });
        self.plan_from(&layers, settings, times, &watch)
    }

    /// One strand for layers that come from elsewhere, bottom first.
    ///
    /// # Errors
    /// See [`PlanError`].
    pub fn plan_layers(&mut self, layers: &[Layer], settings: &Settings) -> Result<Plan, PlanError> {
        self.plan_layers_controlled(layers, settings, &mut |_| ControlFlow::Continue(()))
    }

    /// One strand for layers that come from elsewhere, bottom first, for as long as `observe` wants it to go on; see
    /// [`plan_controlled`](Self::plan_controlled).
    ///
    /// # Errors
    /// [`PlanError::Cancelled`] when it breaks off; else see [`PlanError`].
    ///
    /// # Example
    /// ```
    /// use std::ops::ControlFlow;
    /// use argil::{PlanError, Planner, Settings, curve::DVec2, slice::Layer};
    ///
    /// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(DVec2::from).to_vec();
    /// let layer = Layer::of_loops(0, 0.5, 0.5, &[square], 1e-4);
    /// let mut never = |_| ControlFlow::Break(());
    /// let outcome = Planner::default().plan_layers_controlled(&[layer], &Settings::default(), &mut never);
    /// assert!(matches!(outcome, Err(PlanError::Cancelled)));
    /// ```
    pub fn plan_layers_controlled(
        &mut self,
        layers: &[Layer],
        settings: &Settings,
        observe: &mut dyn FnMut(Progress) -> ControlFlow<()>,
    ) -> Result<Plan, PlanError> {
        settings.check()?;
        self.plan_from(layers, settings, StageTimes::default(), &Watch::new(observe))
    }

    fn plan_from(
        &mut self,
        layers: &[Layer],
        settings: &Settings,
        times: StageTimes,
        watch: &Watch<'_>,
    ) -> Result<Plan, PlanError> {
        if settings.infill != Infill::Auto {
            return self.plan_with(layers, (settings, settings.infill), times, watch);
        }
        let without = self.plan_with(layers, (settings, Infill::None), times, watch);
        watch.check()?;
        let spent = without.as_ref().map_or(times, |plan| plan.times);
        let with = self.plan_with(layers, (settings, Infill::Auto), spent, watch);
        watch.check()?;
        shorter(with, without)
    }

    /// A plan with this infill, whose floors and skins hold water if such a plan can be had.
    fn plan_with(
        &mut self,
        layers: &[Layer],
        (settings, infill): (&Settings, Infill),
        times: StageTimes,
        watch: &Watch<'_>,
    ) -> Result<Plan, PlanError> {
        let [tight, wide] = LANES;
        let first = self.plan_filled(layers, (settings, infill, tight), times, watch);
        let is_closed = settings.floor > 0 || settings.skin > 0;
        if !is_closed || !is_fault(&first) {
            return first;
        }
        let second = self.plan_filled(layers, (settings, infill, wide), times, watch);
        if is_fault(&second) { first } else { second }
    }

    fn plan_filled(
        &mut self,
        layers: &[Layer],
        (settings, infill, lanes): (&Settings, Infill, f64),
        mut times: StageTimes,
        watch: &Watch<'_>,
    ) -> Result<Plan, PlanError> {
        watch.check()?;
        let walls = layers.iter().map(wall_curves).collect::<Result<Vec<_>, _>>()?;
        let models = timed(&mut times.fill, || model(layers, settings, infill, lanes))?;
        let outer: Vec<_> = layers.iter().map(outer_walls).collect();
        let goes_on = &mut || watch.tell(Progress::Working);
        let safeguards =
            timed(&mut times.safeguard, || self.safeguard.regions_while(&outer, settings, goes_on));
        let safeguards = safeguards.ok_or(PlanError::Cancelled)?;
        let sliced = Sliced { layers, walls: &walls, models: &models, safeguards: &safeguards };
        let (planned, climbed) = self.strung(&sliced, settings, &mut times, watch)?;
        let mut reports: Vec<LayerReport> = planned.iter().map(|layer| layer.report).collect();
        for (report, lie) in reports.iter_mut().zip(&climbed.lies) {
            (report.climb, report.level_because, report.bead_heights) = (lie.climb, lie.cause, lie.beads);
            report.ramp = lie.ramp;
        }
        for (report, ahead) in reports.iter_mut().zip(&climbed.ahead) {
            report.outer_ahead = *ahead;
        }
        let strand = if settings.even_flow { climbed.strand } else { roomy(climbed.strand, settings.width)? };
        Ok(Plan {
            strand,
            layers: reports,
            losses: layers.iter().flat_map(|layer| layer.losses.iter().cloned()).collect(),
            skirt: climbed.skirt,
            infill: None,
            times,
        })
    }

    /// All layers planned and joined. Where that takes a long step, or does not work out, they are planned once more with strand laid for
    /// their starts; the plan with the shorter longest step stands.
    fn strung(
        &mut self,
        sliced: &Sliced<'_>,
        settings: &Settings,
        times: &mut StageTimes,
        watch: &Watch<'_>,
    ) -> Result<Strung, PlanError> {
        let sparing = self.strung_by(Keeping::Sparing, sliced, settings, times, watch);
        let short = (SLOPE * settings.layer_height).max(Steps::Short.reach(&settings.seaming()));
        let longest = |strung: &Strung| strung.1.longest_step();
        let is_short = match &sparing {
            Ok(strung) => longest(strung) <= short,
            Err(PlanError::Layer { .. } | PlanError::Seam(_)) => false,
            Err(_) => true,
        };
        if is_short || !self.checked {
            return sparing;
        }
        let guided = self.strung_by(Keeping::Guided, sliced, settings, times, watch);
        watch.check()?;
        match (sparing, guided) {
            (Ok(sparing), Ok(guided)) if longest(&guided) < longest(&sparing) => Ok(guided),
            (Err(_), Ok(guided)) => Ok(guided),
            (sparing, _) => sparing,
        }
    }

    fn strung_by(
        &mut self,
        keeping: Keeping,
        sliced: &Sliced<'_>,
        settings: &Settings,
        times: &mut StageTimes,
        watch: &Watch<'_>,
    ) -> Result<Strung, PlanError> {
        let &Sliced { layers, walls, models, safeguards } = sliced;
        let descended = Descent {
            settings,
            support: &mut self.support,
            route: &mut Watched { stage: &mut self.route, watch },
            smooth: &mut Watched { stage: &mut self.smooth, watch },
            taut: &mut self.taut,
            times,
            checked: self.checked,
            keeping,
        }
        .run(layers, (models, walls), safeguards, &mut |progress| {
            // The layers are counted once.
            watch.tell(if keeping == Keeping::Sparing { progress } else { Progress::Working });
        });
        // A descent that was ended fails for want of work, not for the reason that it gives.
        watch.check()?;
        let planned = descended?;
        if keeping == Keeping::Sparing {
            watch.tell(Progress::Descended);
            watch.check()?;
        }
        if planned.is_empty() {
            return Err(PlanError::Nothing);
        }
        let seam = &mut Watched { stage: &mut self.seam, watch };
        let joined = timed(&mut times.seam, || climbed((&planned, layers), seam, settings, self.checked));
        // A chain of which the search was ended fails as well.
        watch.check()?;
        Ok((planned, joined?))
    }
}

/// What layers are planned from, bottom first.
struct Sliced<'a> {
    layers: &'a [Layer],
    walls: &'a [Vec<ClosedCurve>],
    models: &'a [ModelLayer],
    safeguards: &'a [MultiPolygon<f64>],
}

/// Layers that are planned, and the strand that they are joined to.
type Strung = (Vec<PlannedLayer>, Climbed);

/// Whether there is no plan because of how the layers came out.
fn is_fault(plan: &Result<Plan, PlanError>) -> bool {
    matches!(plan, Err(PlanError::Layer { .. } | PlanError::Seam(_)))
}

/// The plan with the shorter strand, and both lengths; the one with infill only where it is shorter.
fn shorter(with: Result<Plan, PlanError>, without: Result<Plan, PlanError>) -> Result<Plan, PlanError> {
    let length = |plan: &Result<Plan, PlanError>| plan.as_ref().ok().map(|plan| plan.strand.length());
    let [with_mm, without_mm] = [&with, &without].map(length);
    let taken = match (with_mm, without_mm) {
        (Some(with), Some(without)) => with < without,
        (with, _) => with.is_some(),
    };
    // Both have taken their time.
    let times = with.as_ref().map_or(StageTimes::default(), |plan| plan.times);
    let plan = if taken { with } else { without }?;
    let times = if with_mm.is_some() { times } else { plan.times };
    Ok(Plan { infill: Some(InfillChoice { taken, with_mm, without_mm }), times, ..plan })
}
