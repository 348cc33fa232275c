//! Slicing that goes no further where the mesh has holes: a print of half an outline is of no use to anybody.

use argil::Settings;
use argil::mesh::{Mesh, Soup};
use argil::slice::{Layer, SliceError, check_closed, prisms};
use argil::stages::Slice;

/// Another way of slicing, whose layers must have closed outlines.
#[derive(Clone, Debug)]
pub(crate) struct ClosedSlices<S> {
    pub(crate) slice: S,
    /// Whether outlines that could be closed are refused, too.
    pub(crate) strict: bool,
    /// Whether the outlines are to be kept.
    pub(crate) keeps: bool,
    /// The outlines that were kept.
    pub(crate) kept: Option<Soup>,
}

impl<S: Slice> Slice for ClosedSlices<S> {
    fn layers(&mut self, mesh: &Mesh, settings: &Settings) -> Result<Vec<Layer>, SliceError> {
        self.layers_while(mesh, settings, &mut || true).map(Option::unwrap_or_default)
    }

    fn layers_while(
        &mut self,
        mesh: &Mesh,
        settings: &Settings,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Option<Vec<Layer>>, SliceError> {
        let Some(layers) = self.slice.layers_while(mesh, settings, goes_on)? else { return Ok(None) };
        check_closed(&layers, self.strict)?;
        self.kept = self.keeps.then(|| prisms(&layers));
        Ok(Some(layers))
    }
}
