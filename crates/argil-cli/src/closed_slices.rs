//! Slicing that goes no further where the mesh has holes: a print of half an outline is of no use to anybody.

use argil::Settings;
use argil::mesh::Mesh;
use argil::slice::{Layer, SliceError, check_closed};
use argil::stages::Slice;

/// Another way of slicing, whose layers must have closed outlines.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClosedSlices<S> {
    pub(crate) slice: S,
    /// Whether outlines that could be closed are refused, too.
    pub(crate) strict: bool,
}

impl<S: Slice> Slice for ClosedSlices<S> {
    fn layers(&mut self, mesh: &Mesh, settings: &Settings) -> Result<Vec<Layer>, SliceError> {
        let layers = self.slice.layers(mesh, settings)?;
        check_closed(&layers, self.strict)?;
        Ok(layers)
    }
}
