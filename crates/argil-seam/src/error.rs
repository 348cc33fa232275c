//! Why there is no chain of start points.

use argil_curve::DVec2;

/// What keeps a stack of cycles from being one strand.
///
/// # Example
/// ```
/// use argil_seam::{ClosedCurve, DVec2, SeamError, SeamSettings, seam_chain};
/// // A ring, and above it one that is nowhere within reach.
/// let square = |x: f64| ClosedCurve::new([(x, 0.0), (x + 9.0, 0.0), (x + 9.0, 9.0), (x, 9.0)].map(DVec2::from).to_vec());
/// let apart = [square(0.0)?, square(20.0)?];
/// let refused = seam_chain(&apart, &SeamSettings::for_width(1.5), &|_, _| 0.0).unwrap_err();
/// assert!(matches!(refused, SeamError::NoStep { layer: 1, gap, .. } if gap > 10.0), "{refused}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SeamError {
    /// A setting is not finite, or not positive where it must be.
    #[error("seam setting `{name}` cannot be {value}")]
    Setting {
        /// Name of the field of [`SeamSettings`](crate::SeamSettings).
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The extra cost forbids every start of the lowest layer.
    #[error("the lowest layer can begin nowhere: every start of it is forbidden")]
    NoStart,
    /// No start of a layer is held and within reach of a possible start of the layer below by a step that
    /// crosses nothing.
    #[error(
        "no start of layer {layer} can be reached from layer {}: its path passes ({:.3}, {:.3}) at {gap:.3} mm",
        layer - 1, below.x, below.y
    )]
    NoStep {
        /// Index of the layer, from 0 at the bottom, that cannot be reached.
        layer: usize,
        /// The possible start of the layer below that is nearest to the layer's cycle, mm.
        below: DVec2,
        /// Its distance from the cycle, mm. When this is within reach, the starts near it are not held,
        /// forbidden by the cost, or only to be had by crossing the cycle.
        gap: f64,
    },
}
