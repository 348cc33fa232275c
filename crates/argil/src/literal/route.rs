//! Section 3.3: one connection point a wall.

use argil_route::{Cycle, LayerInput, RouteError, SplicedRouter};

use crate::Settings;
use crate::stages::Route;

/// One tour a region through one connection point a wall, walls spliced in whole (section 3.3).
///
/// What the text leaves open, what was chosen, and what goes wrong is told at [`SplicedRouter`]. In short: the cycle
/// crosses itself at connection points and passes through the walls of nested regions, and two thirds of what it adds to
/// the bunny lie inside. [`Excursions`](crate::stages::Excursions) leave a wall wherever it is near and are drawn as one
/// circuit that cannot cross.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SplicedRoute;

impl Route for SplicedRoute {
    fn cycle(&mut self, layer: &LayerInput<'_>, settings: &Settings) -> Result<Cycle, RouteError> {
        SplicedRouter::new(settings.routing())?.cycle(layer)
    }
}
