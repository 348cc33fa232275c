//! The stages of a plan, each behind one narrow trait.
//!
//! A trait says what the planner needs from a stage, no more; what a stage keeps in mind between layers is its own
//! affair (methods take `&mut self` where a workspace is worth keeping). The structs are argil's own stages.

use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
use argil_elastic::{ElasticError, ElasticSolver, Path};
use argil_mesh::Mesh;
use argil_route::{Cycle, LayerInput, RouteError, Router};
use argil_seam::{SeamError, SeamSettings};
use argil_slice::{Layer, SliceError};
use argil_support::SupportPoint;
use geo_types::MultiPolygon;

use crate::Settings;

/// Cuts a mesh into layers with their walls, bottom first.
pub trait Slice {
    /// The layers; every wall on the output grid, simple and disjoint.
    ///
    /// # Errors
    /// When the mesh cannot be cut.
    fn layers(&mut self, mesh: &Mesh, settings: &Settings) -> Result<Vec<Layer>, SliceError>;
}

/// Builds the envelope that support keeps clear of.
pub trait Safeguard {
    /// One region a layer, from the filled outermost walls of all layers, bottom first.
    fn regions(&mut self, outer: &[MultiPolygon<f64>], settings: &Settings) -> Vec<MultiPolygon<f64>>;
}

/// Finds what a layer has to hold.
pub trait Support {
    /// Points that the layer must pass so that the cycle above is held, beside what its walls hold.
    fn points(&mut self, above: &ClosedCurve, walls: &SegmentIndex, settings: &Settings)
    -> Vec<SupportPoint>;
}

/// Joins walls and demands to one cycle.
pub trait Route {
    /// A closed cycle through everything.
    ///
    /// # Errors
    /// When there is none.
    fn cycle(&mut self, layer: &LayerInput<'_>, settings: &Settings) -> Result<Cycle, RouteError>;
}

/// Shortens and smooths the free part of a cycle.
pub trait Smooth {
    /// As many points as the path has, fixed ones unchanged.
    ///
    /// # Errors
    /// When the path is malformed.
    fn points(&mut self, path: &Path<'_>, settings: &Settings) -> Result<Vec<DVec2>, ElasticError>;
}

/// Chooses where each layer begins.
pub trait Seam {
    /// The arc of the start on each cycle, bottom first.
    ///
    /// # Errors
    /// When two layers cannot be joined by a short, held step.
    fn starts(
        &mut self,
        cycles: &[ClosedCurve],
        settings: &Settings,
        cost: &dyn Fn(usize, DVec2) -> f64,
    ) -> Result<Vec<f64>, SeamError>;
}

/// Cuts by planes at mid-layer ([`argil_slice`]).
#[derive(Clone, Copy, Debug, Default)]
pub struct PlaneSlices;

impl Slice for PlaneSlices {
    fn layers(&mut self, mesh: &Mesh, settings: &Settings) -> Result<Vec<Layer>, SliceError> {
        argil_slice::slice(mesh, &settings.slicing())
    }
}

/// Dilates the walls and erodes from layer to layer ([`argil_safeguard`]).
#[derive(Clone, Copy, Debug, Default)]
pub struct SlopedSafeguard;

impl Safeguard for SlopedSafeguard {
    fn regions(&mut self, outer: &[MultiPolygon<f64>], settings: &Settings) -> Vec<MultiPolygon<f64>> {
        argil_safeguard::safeguards(outer, &settings.safeguarding())
    }
}

/// The fewest points by the continuous criterion ([`argil_support`]).
#[derive(Clone, Copy, Debug, Default)]
pub struct FewestPoints;

impl Support for FewestPoints {
    fn points(
        &mut self,
        above: &ClosedCurve,
        walls: &SegmentIndex,
        settings: &Settings,
    ) -> Vec<SupportPoint> {
        argil_support::place_supports(above, walls, &settings.support())
    }
}

/// Excursions from the walls, drawn without a crossing ([`argil_route`]).
#[derive(Clone, Copy, Debug, Default)]
pub struct Excursions;

impl Route for Excursions {
    fn cycle(&mut self, layer: &LayerInput<'_>, settings: &Settings) -> Result<Cycle, RouteError> {
        Router::new(settings.routing())?.cycle(layer)
    }
}

/// The guarded elastic curve ([`argil_elastic`]).
#[derive(Debug, Default)]
pub struct ElasticCurve {
    solver: ElasticSolver,
}

impl Smooth for ElasticCurve {
    fn points(&mut self, path: &Path<'_>, settings: &Settings) -> Result<Vec<DVec2>, ElasticError> {
        Ok(self.solver.relax(path, &settings.smoothing())?.points)
    }
}

/// The best chain of starts over all layers ([`argil_seam`]).
#[derive(Clone, Copy, Debug, Default)]
pub struct BestChain;

impl Seam for BestChain {
    fn starts(
        &mut self,
        cycles: &[ClosedCurve],
        settings: &Settings,
        cost: &dyn Fn(usize, DVec2) -> f64,
    ) -> Result<Vec<f64>, SeamError> {
        let usual = settings.seaming();
        let chain = |reach: f64, fineness: f64| {
            let seam =
                SeamSettings { reach: reach * usual.reach, spacing: usual.spacing / fineness, ..usual };
            argil_seam::seam_chain(cycles, &seam, cost)
        };
        // Most prints have a chain of steps half as long as they may be, and short steps show less. Where strand dies on a wall
        // the one way up may be narrow: a chain that is not found is looked for more finely.
        chain(0.5, 1.0).or_else(|_| chain(0.5, 4.0)).or_else(|_| chain(1.0, 1.0)).or_else(|_| chain(1.0, 4.0))
    }
}
