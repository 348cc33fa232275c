use glam::DVec2;
use thiserror::Error;

/// Why a mesh cannot be sliced.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SliceError {
    /// A setting that must be a positive finite length is not.
    #[error("{setting} must be a positive length, not {value}")]
    Setting {
        /// The name of the field in [`SliceSettings`](crate::SliceSettings).
        setting: &'static str,
        /// Its value.
        value: f64,
    },
    /// No wall was asked for, so there would be no path.
    #[error("at least one wall is needed")]
    NoWalls,
    /// More than one wall was asked for of a sheet, which is itself the path of its only one.
    #[error("a sheet without thickness has one wall, not {walls}")]
    SheetWalls {
        /// How many were asked for.
        walls: usize,
    },
    /// The output grid is too coarse for the bead: loops could not be kept apart on it.
    #[error("an output grid of {grid} mm is too coarse for a bead of {width} mm (at most {limit} mm)")]
    CoarseGrid {
        /// The grid in millimetres.
        grid: f64,
        /// The bead width in millimetres.
        width: f64,
        /// The coarsest grid for this width.
        limit: f64,
    },
    /// The mesh does not reach the middle of the first layer.
    #[error("the mesh is {height} mm high, less than half a layer of {layer_height} mm")]
    ThinnerThanALayer {
        /// Height of the mesh in millimetres.
        height: f64,
        /// The layer height in millimetres.
        layer_height: f64,
    },
    /// More layers than anything that is printed has: the unit or the scale is wrong.
    #[error("{layers} layers are more than {limit}: is the mesh in millimetres?")]
    TooManyLayers {
        /// How many there would be.
        layers: f64,
        /// How many are allowed.
        limit: usize,
    },
    /// A contour with a coordinate that is not finite or is too large.
    #[error(
        "contour {contour} of layer {layer} has a coordinate that is not finite or is beyond {limit:e} mm"
    )]
    Contour {
        /// The layer, 0 at the bottom.
        layer: usize,
        /// The contour in it.
        contour: usize,
        /// The largest coordinate.
        limit: f64,
    },
    /// No contour encloses anything.
    #[error("no layer has a contour that encloses anything")]
    NoContours,
    /// Contours with more points than a mesh can name.
    #[error("the contours have more than {limit} points")]
    TooManyPoints {
        /// How many there may be.
        limit: usize,
    },
    /// A mesh so wide that the polygon kernel's 30-bit grid becomes coarser than the output grid.
    #[error("the mesh is {extent} mm wide, more than {limit} mm: is it in millimetres?")]
    TooWide {
        /// The larger extent in x or y, in millimetres.
        extent: f64,
        /// The largest extent for this output grid.
        limit: f64,
    },
    /// The mesh has a hole that leaves an outline open; given by [`check_closed`](crate::check_closed) alone.
    #[error(
        "layer {layer}, near ({:.2}, {:.2}): the mesh has a hole; {length:.2} mm of outline cannot be closed across {gap:.2} mm{}",
        at.x, at.y, and_others(*others)
    )]
    Open {
        /// The layer with the longest open piece.
        layer: usize,
        /// One end of that piece.
        at: DVec2,
        /// Its length in millimetres.
        length: f64,
        /// Distance in millimetres between its ends.
        gap: f64,
        /// How many more open pieces there are.
        others: usize,
    },
    /// A surface of the mesh is inside out in a way that could not be put right; given by [`check_closed`](crate::check_closed) alone.
    #[error(
        "layer {layer}, near ({:.2}, {:.2}): a surface is inside out and meets others; {area:.2} mm² of the outline may be a hole or solid{}",
        at.x, at.y, and_others(*others)
    )]
    InsideOut {
        /// The layer with the largest such area.
        layer: usize,
        /// A point of it or near it.
        at: DVec2,
        /// The area in square millimetres.
        area: f64,
        /// How many more layers have one.
        others: usize,
    },
    /// Bodies overlap; given by [`check_closed`](crate::check_closed) alone, where they are not to be made one.
    #[error(
        "layer {layer}, near ({:.2}, {:.2}): bodies overlap in {area:.2} mm² of the outline{}",
        at.x, at.y, and_others(*others)
    )]
    Overlap {
        /// The layer with the largest overlap.
        layer: usize,
        /// A point of it.
        at: DVec2,
        /// Its area in square millimetres.
        area: f64,
        /// How many more layers have one.
        others: usize,
    },
    /// The mesh has a hole that was closed; given by [`check_closed`](crate::check_closed) alone, where that is not wanted.
    #[error(
        "layer {layer}, near ({:.2}, {:.2}): the mesh has a hole; the outline is open by {gap:.2} mm{}",
        at.x, at.y, and_others(*others)
    )]
    Gap {
        /// The layer with the widest gap.
        layer: usize,
        /// The middle of the gap.
        at: DVec2,
        /// Its width in millimetres.
        gap: f64,
        /// How many more gaps there are.
        others: usize,
    },
}

fn and_others(count: usize) -> String {
    if count == 0 { String::new() } else { format!(", and {count} more such places") }
}
