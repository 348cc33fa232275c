//! An observer that may end a plan, and stages that then do no more work.

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;

use argil_curve::{ClosedCurve, DVec2};
use argil_elastic::{ElasticError, Path};
use argil_route::{Cycle, LayerInput, RouteError};
use argil_seam::SeamError;

use crate::stages::{Route, Seam, Smooth};
use crate::{PlanError, Progress, Settings};

/// The observer of a plan, shared by those who tell it something.
pub(crate) struct Watch<'a> {
    observe: RefCell<&'a mut dyn FnMut(Progress) -> ControlFlow<()>>,
    ended: Cell<bool>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(observe: &'a mut dyn FnMut(Progress) -> ControlFlow<()>) -> Self {
        Self { observe: RefCell::new(observe), ended: Cell::new(false) }
    }

    /// Tells the observer, and whether the plan goes on. Once it has ended, the observer is told no more.
    pub(crate) fn tell(&self, progress: Progress) -> bool {
        // The observer cannot reach the watch that it is called from, so that it is never borrowed twice.
        if let (false, Ok(mut observe)) = (self.ended.get(), self.observe.try_borrow_mut()) {
            self.ended.set(observe(progress).is_break());
        }
        !self.ended.get()
    }

    /// # Errors
    /// [`PlanError::Cancelled`] once the observer has ended the plan.
    pub(crate) fn check(&self) -> Result<(), PlanError> {
        if self.ended.get() { Err(PlanError::Cancelled) } else { Ok(()) }
    }
}

/// A stage that asks the observer before it begins. When the plan has ended it fails at once, for a reason that nobody
/// learns: the planner says that the plan was cancelled.
pub(crate) struct Watched<'a, 'w, T> {
    pub(crate) stage: &'a mut T,
    pub(crate) watch: &'a Watch<'w>,
}

impl<R: Route> Route for Watched<'_, '_, R> {
    fn cycle(&mut self, layer: &LayerInput<'_>, settings: &Settings) -> Result<Cycle, RouteError> {
        if self.watch.tell(Progress::Routing) {
            self.stage.cycle(layer, settings)
        } else {
            Err(RouteError::Empty)
        }
    }
}

impl<E: Smooth> Smooth for Watched<'_, '_, E> {
    fn points(&mut self, path: &Path<'_>, settings: &Settings) -> Result<Vec<DVec2>, ElasticError> {
        if self.watch.tell(Progress::Smoothing) {
            self.stage.points(path, settings)
        } else {
            Err(ElasticError::LengthMismatch { list: "points", found: 0, expected: path.points.len() })
        }
    }
}

impl<C: Seam> Seam for Watched<'_, '_, C> {
    fn starts(
        &mut self,
        cycles: &[ClosedCurve],
        footholds: &[f64],
        reach: f64,
        settings: &Settings,
        cost: &dyn Fn(usize, DVec2) -> f64,
    ) -> Result<Vec<f64>, SeamError> {
        let (asked_in, goes_on) = (Cell::new(usize::MAX), Cell::new(true));
        // A seam that goes from layer to layer asks what starts cost in each; where all are forbidden, it is soon at an end.
        let watched = |layer: usize, start: DVec2| {
            if asked_in.replace(layer) != layer {
                goes_on.set(self.watch.tell(Progress::Working));
            }
            if goes_on.get() { cost(layer, start) } else { f64::INFINITY }
        };
        self.stage.starts(cycles, footholds, reach, settings, &watched)
    }
}
