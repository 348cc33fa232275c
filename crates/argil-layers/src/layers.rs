use glam::DVec2;

/// Layers of closed contours, bottom first.
///
/// A point is solid where it lies inside an odd number of the contours of its layer, whichever way they run. The first point of a
/// contour is not repeated.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Layers {
    /// For each layer its contours, in millimetres.
    pub layers: Vec<Vec<Vec<DVec2>>>,
    /// The height of every layer in millimetres, if the file says so.
    pub layer_height: Option<f64>,
    /// Whether the file states its unit. Without one, a unit is a millimetre.
    pub has_unit: bool,
    /// What of the file was left out, in sentences.
    pub remarks: Vec<String>,
}

impl Layers {
    /// The larger extent in x and y, in millimetres; 0 without any point.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let points = || self.layers.iter().flatten().flatten();
        let low = points().fold(DVec2::INFINITY, |low, p| low.min(*p));
        let high = points().fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
        (high - low).max_element().max(0.0)
    }
}
