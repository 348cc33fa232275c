//! Why there is no plan.

use argil_curve::DVec2;

/// A failure with its reason and place. A plan is whole or it is an error: nothing is left out or hopped over.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// A setting is outside its range.
    #[error("the setting `{name}` is {value}; it must be {expected}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would do.
        expected: &'static str,
    },
    /// The mesh could not be cut.
    #[error("the mesh cannot be sliced: {0}")]
    Slice(#[from] argil_slice::SliceError),
    /// No layer has anything to print.
    #[error("no layer has a wall: the model is thinner than a bead everywhere")]
    Nothing,
    /// A layer could not be planned.
    #[error("layer {layer}, near ({:.2}, {:.2}): {fault}", near.x, near.y)]
    Layer {
        /// Index of the layer, 0 at the bottom.
        layer: usize,
        /// A point of it, mm.
        near: DVec2,
        /// What went wrong.
        fault: LayerFault,
    },
    /// The cycles could not be joined to one strand.
    #[error("the layers cannot be joined: {0}")]
    Seam(#[from] argil_seam::SeamError),
    /// The joined strand is not one polyline.
    #[error("the strand is broken: {0}")]
    Strand(#[from] argil_strand::StrandError),
    /// The observer has ended the plan.
    #[error("the plan was cancelled")]
    Cancelled,
}

/// What went wrong in a layer.
///
/// # Example
/// ```
/// use argil::{LayerFault, PlanError, Planner, Settings, curve::DVec2, route::RouteError, slice::Layer};
/// // Two points are no wall.
/// let line = [(0.0, 0.0), (9.0, 0.0)].map(DVec2::from).to_vec();
/// let layer = Layer::of_loops(0, 0.5, 0.5, &[line], 1e-4);
/// let failed = Planner::default().plan_layers(&[layer], &Settings::default()).unwrap_err();
/// let PlanError::Layer { layer: 0, fault: LayerFault::Route(RouteError::Wall { wall: 0 }), .. } = failed else {
///     panic!("{failed}");
/// };
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayerFault {
    /// No cycle was found.
    #[error(transparent)]
    Route(#[from] argil_route::RouteError),
    /// A zone could not be filled.
    #[error(transparent)]
    Fill(#[from] argil_fill::FillError),
    /// The cycle could not be smoothed.
    #[error(transparent)]
    Smooth(#[from] argil_elastic::ElasticError),
    /// The cycle is no closed curve.
    #[error(transparent)]
    Curve(#[from] argil_curve::CurveError),
    /// A stretch of the layer above would hang in the air.
    #[error("a stretch of {length:.2} mm of the layer above is not held")]
    Unsupported {
        /// Length of the stretch, mm.
        length: f64,
    },
    /// The cycle crosses itself.
    #[error("the path crosses itself")]
    Crossing,
}
