//! The stages of a plan, each behind one narrow trait.
//!
//! A trait says what the planner needs from a stage, no more; what a stage keeps in mind between layers is its own
//! affair (methods take `&mut self` where a workspace is worth keeping). The structs are argil's own stages.
//!
//! ```
//! use argil::curve::{ClosedCurve, SegmentIndex};
//! use argil::stages::{FewestPoints, Support};
//! use argil::support::SupportPoint;
//! use argil::{Planner, Settings};
//!
//! /// Argil's own support, counted.
//! struct Counted(usize);
//!
//! impl Support for Counted {
//!     fn points(&mut self, above: &ClosedCurve, walls: &SegmentIndex, settings: &Settings) -> Vec<SupportPoint> {
//!         let points = FewestPoints.points(above, walls, settings);
//!         self.0 += points.len();
//!         points
//!     }
//! }
//!
//! let Planner { slice, safeguard, route, smooth, taut, seam, checked, .. } = Planner::default();
//! let mut planner = Planner { slice, safeguard, support: Counted(0), route, smooth, taut, seam, checked };
//! let mesh = argil::mesh::Mesh::cuboid([0.0; 3], [9.0, 9.0, 3.0])?;
//! planner.plan(&mesh, &Settings::default())?;
//! assert_eq!(planner.support.0, 0, "every wall stands on the one below");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What a planner is made of, unless told otherwise:
//! ```
//! use argil::stages::{BestChain, ElasticCurve, Excursions, FewestPoints, PlaneSlices, PulledTaut, SlopedSafeguard};
//! use argil::{Planner, Settings};
//!
//! let mut planner = Planner {
//!     slice: PlaneSlices,
//!     safeguard: SlopedSafeguard,
//!     support: FewestPoints,
//!     route: Excursions,
//!     smooth: ElasticCurve::default(),
//!     taut: PulledTaut,
//!     seam: BestChain,
//!     checked: true,
//! };
//! let mesh = argil::mesh::Mesh::cuboid([0.0; 3], [9.0, 9.0, 3.0])?;
//! let settings = Settings::default();
//! assert_eq!(planner.plan(&mesh, &settings)?.strand, Planner::default().plan(&mesh, &settings)?.strand);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
use argil_elastic::{ElasticError, ElasticSolver, Path};
use argil_mesh::Mesh;
use argil_route::{Cycle, LayerInput, RouteError, Router, Tours};
use argil_seam::{SeamError, SeamSettings};
use argil_slice::{Layer, SliceError};
use argil_support::SupportPoint;
use argil_taut::{SlackPath, pulled_taut};
use geo_types::MultiPolygon;

use crate::Settings;

/// Cuts a mesh into layers with their walls, bottom first.
pub trait Slice {
    /// The layers; every wall on the output grid, simple and disjoint.
    ///
    /// # Errors
    /// When the mesh cannot be cut.
    fn layers(&mut self, mesh: &Mesh, settings: &Settings) -> Result<Vec<Layer>, SliceError>;

    /// The same for as long as `goes_on` says so, which is to be asked often; `None` where it has ended the work.
    ///
    /// # Errors
    /// Those of [`Slice::layers`].
    fn layers_while(
        &mut self,
        mesh: &Mesh,
        settings: &Settings,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Option<Vec<Layer>>, SliceError> {
        if goes_on() { self.layers(mesh, settings).map(Some) } else { Ok(None) }
    }
}

/// Builds the envelope that support keeps clear of.
pub trait Safeguard {
    /// One region a layer, from the filled outermost walls of all layers, bottom first.
    fn regions(&mut self, outer: &[MultiPolygon<f64>], settings: &Settings) -> Vec<MultiPolygon<f64>>;

    /// The same for as long as `goes_on` says so, which is to be asked often; `None` where it has ended the work.
    fn regions_while(
        &mut self,
        outer: &[MultiPolygon<f64>],
        settings: &Settings,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<MultiPolygon<f64>>> {
        goes_on().then(|| self.regions(outer, settings))
    }
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

/// Takes the slack out of a cycle that is sound.
pub trait Tauten {
    /// As many points as the path has, fixed ones unchanged. What the planner cannot use, since it crosses itself or
    /// holds too little, it leaves.
    fn points(&mut self, path: &SlackPath<'_>, settings: &Settings) -> Vec<DVec2>;
}

/// Chooses where each layer begins.
pub trait Seam {
    /// The arc of the start on each cycle, bottom first, no step longer than `reach`, mm. `footholds` are the arcs of a
    /// chain that was kept open while the layers were planned, one a cycle.
    ///
    /// The uppermost layers are asked for by themselves first: where they have no chain, the whole has none.
    ///
    /// # Errors
    /// When two layers cannot be joined by a short, held step.
    fn starts(
        &mut self,
        cycles: &[ClosedCurve],
        footholds: &[f64],
        reach: f64,
        settings: &Settings,
        cost: &dyn Fn(usize, DVec2) -> f64,
    ) -> Result<Vec<f64>, SeamError>;
}

/// Cuts by planes at mid-layer ([`argil_slice`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PlaneSlices;

impl Slice for PlaneSlices {
    fn layers(&mut self, mesh: &Mesh, settings: &Settings) -> Result<Vec<Layer>, SliceError> {
        argil_slice::slice(mesh, &settings.slicing())
    }

    fn layers_while(
        &mut self,
        mesh: &Mesh,
        settings: &Settings,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Option<Vec<Layer>>, SliceError> {
        argil_slice::slice_while(mesh, &settings.slicing(), goes_on)
    }
}

/// Dilates the walls and erodes from layer to layer ([`argil_safeguard`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SlopedSafeguard;

impl Safeguard for SlopedSafeguard {
    fn regions(&mut self, outer: &[MultiPolygon<f64>], settings: &Settings) -> Vec<MultiPolygon<f64>> {
        argil_safeguard::safeguards(outer, &settings.safeguarding())
    }

    fn regions_while(
        &mut self,
        outer: &[MultiPolygon<f64>],
        settings: &Settings,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Option<Vec<MultiPolygon<f64>>> {
        argil_safeguard::safeguards_while(outer, &settings.safeguarding(), goes_on)
    }
}

/// The fewest points by the continuous criterion ([`argil_support`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Excursions;

impl Route for Excursions {
    fn cycle(&mut self, layer: &LayerInput<'_>, settings: &Settings) -> Result<Cycle, RouteError> {
        Router::new(settings.routing())?.cycle(layer)
    }
}

/// Excursions as [`Excursions`] makes them, by tours of another solver.
///
/// # Example
/// ```
/// use argil::stages::ExcursionsBy;
/// use argil::{Planner, Settings, route::ShortestTours};
/// let Planner { slice, safeguard, support, smooth, taut, seam, checked, .. } = Planner::default();
/// let route = ExcursionsBy(ShortestTours);
/// let mut planner = Planner { slice, safeguard, support, route, smooth, taut, seam, checked };
/// let mesh = argil::mesh::Mesh::cuboid([0.0; 3], [9.0, 9.0, 3.0])?;
/// let settings = Settings::default();
/// assert_eq!(planner.plan(&mesh, &settings)?.strand, Planner::default().plan(&mesh, &settings)?.strand);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExcursionsBy<T>(pub T);

impl<T: Tours> Route for ExcursionsBy<T> {
    fn cycle(&mut self, layer: &LayerInput<'_>, settings: &Settings) -> Result<Cycle, RouteError> {
        Router::new(settings.routing())?.cycle_with(layer, &self.0)
    }
}

/// The guarded elastic curve ([`argil_elastic`]).
#[derive(Clone, Debug, Default)]
pub struct ElasticCurve {
    solver: ElasticSolver,
}

impl Smooth for ElasticCurve {
    fn points(&mut self, path: &Path<'_>, settings: &Settings) -> Result<Vec<DVec2>, ElasticError> {
        Ok(self.solver.relax(path, &settings.smoothing())?.points)
    }
}

/// As short as the exact rule of support allows ([`argil_taut`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PulledTaut;

impl Tauten for PulledTaut {
    fn points(&mut self, path: &SlackPath<'_>, settings: &Settings) -> Vec<DVec2> {
        pulled_taut(path, &settings.tautening())
    }
}

/// Leaves the path as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftSlack;

impl Tauten for LeftSlack {
    fn points(&mut self, path: &SlackPath<'_>, _: &Settings) -> Vec<DVec2> {
        path.points.to_vec()
    }
}

/// The best chain of starts over all layers ([`argil_seam`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BestChain;

impl Seam for BestChain {
    fn starts(
        &mut self,
        cycles: &[ClosedCurve],
        footholds: &[f64],
        reach: f64,
        settings: &Settings,
        cost: &dyn Fn(usize, DVec2) -> f64,
    ) -> Result<Vec<f64>, SeamError> {
        let seaming = SeamSettings { reach, ..settings.seaming() };
        argil_seam::seam_chain_among(cycles, footholds, &seaming, cost)
    }
}
