//! Section 3.4: the energies as printed.

use argil_curve::DVec2;
use argil_elastic::{ElasticError, ElasticOptions, Path, relax_literally};

use crate::Settings;
use crate::stages::Smooth;

/// The energies and weights that section 3.4 prints: Eq. 2, 3, 5 and 6, with the one mend that Eq. 6 needs to be defined.
///
/// Every free vertex, whether it holds something or not, is kept within `ε_across` of its candidate along the normal of the path
/// ([`relax_literally`]). The distance of Eq. 5 is the exact one that every planner passes; Eq. 4 gives neither kernel
/// nor radius, and [`ImlsField`](argil_elastic::ImlsField) is there to try some.
///
/// Nothing keeps a vertex from sliding along the path, so the tip of a hairpin, where the normal is undefined, retracts
/// and lets go of what it held: 129 hanging spans of a bunny become 460. Nothing keeps strands apart either, so the
/// two passes of a corridor coincide. The reward is the shortest strand of all.
/// [`ElasticCurve`](crate::stages::ElasticCurve) ties down only the vertices that hold something, to what they hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LiteralElastic;

impl Smooth for LiteralElastic {
    fn points(&mut self, path: &Path<'_>, settings: &Settings) -> Result<Vec<DVec2>, ElasticError> {
        let options = ElasticOptions {
            envelope: settings.criterion().across,
            ..ElasticOptions::literal(settings.width)
        };
        Ok(relax_literally(path, &options)?.points)
    }
}
