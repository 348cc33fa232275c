//! The paper's text, taken literally where it is definite: for comparison, not for printing.
//!
//! Every stage of argil mends something in the text of Hergel, Hinz, Lefebvre and Thomaszewski (2019). The stages here
//! are what they mend, behind the same traits, so that the worth of each can be measured by putting it back:
//!
//! | stage | section | what the text leaves hanging |
//! |---|---|---|
//! | [`StrideSupport`] | 3.2, Eq. 1 | stretches of up to twice `ε_along` |
//! | [`SplicedRoute`] | 3.3 | crossings at connection points, straight through walls, and of mixed edges |
//! | [`LiteralElastic`] | 3.4, Eq. 2, 3, 5 and 6 | what retracting tips held |
//! | [`NearestStarts`] | 3.3, its last paragraph | starts over nothing, and steps as long as they come |
//!
//! Layers are cut and the safeguard is built as always ([`PlaneSlices`], [`SlopedSafeguard`]): there the text only lacks a
//! figure, the amount of the dilation. Three more things are the same in both planners, because the stages have no say
//! in them: the clearance of Eq. 5 is measured by the exact distance to the safeguard, for Eq. 4 comes without its kernel
//! and gets signs wrong with many; strands inside of the model do not feel it; and after smoothing, tips that turn by
//! more than 125° are cut blunt.
//!
//! Measured on the Stanford bunny by the prototype of both, with one wall and a bead of 1.5 mm: the literal planner leaves
//! 202 spans hanging, the longest 7.3 mm, with 51 crossings of the strand, 145 more at shared vertices, 80 through
//! walls, and 23 of 120 layers that begin over nothing; the mended one none of any of these but three at vertices of one
//! degenerate sliver.
//!
//! ```
//! use argil::{Planner, Settings, literal};
//! // One stage of the text among argil's own, to see what it alone does.
//! let own = Planner::default();
//! let mut planner = Planner {
//!     slice: own.slice,
//!     safeguard: own.safeguard,
//!     support: literal::StrideSupport,
//!     route: own.route,
//!     smooth: own.smooth,
//!     taut: own.taut,
//!     seam: own.seam,
//!     checked: false,
//! };
//! let mesh = argil::mesh::read_stl(&argil_models::by_name("columns").expect("bundled").to_stl())?;
//! let settings = Settings::for_width(4.0);
//! assert!(planner.plan(&mesh, &settings)?.strand.length() > 0.0);
//!
//! // All others of the text's stages.
//! let mut planner = Planner {
//!     slice: planner.slice,
//!     safeguard: planner.safeguard,
//!     support: planner.support,
//!     route: literal::SplicedRoute,
//!     smooth: literal::LiteralElastic,
//!     taut: argil::stages::LeftSlack,
//!     seam: literal::NearestStarts,
//!     checked: false,
//! };
//! assert_eq!(planner.plan(&mesh, &settings)?.strand, literal::planner().plan(&mesh, &settings)?.strand);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod elastic;
mod route;
mod starts;
mod support;

pub use elastic::LiteralElastic;
pub use route::SplicedRoute;
pub use starts::NearestStarts;
pub use support::StrideSupport;

use crate::Planner;
use crate::stages::{LeftSlack, PlaneSlices, SlopedSafeguard};

/// A planner whose stages follow the paper.
///
/// It is not [`checked`](Planner::checked): the text has no check, and few of its plans would pass one.
///
/// ```
/// use argil::{Settings, literal};
/// let settings = Settings::for_width(4.0);
/// let mesh = argil::mesh::read_stl(&argil_models::by_name("columns").expect("bundled").to_stl())?;
/// let plan = literal::planner().plan(&mesh, &settings)?;
/// assert_eq!(plan.strand.layers().len(), plan.layers.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn planner() -> Planner<
    PlaneSlices,
    SlopedSafeguard,
    StrideSupport,
    SplicedRoute,
    LiteralElastic,
    LeftSlack,
    NearestStarts,
> {
    Planner {
        slice: PlaneSlices,
        safeguard: SlopedSafeguard,
        support: StrideSupport,
        route: SplicedRoute,
        smooth: LiteralElastic,
        taut: LeftSlack,
        seam: NearestStarts,
        checked: false,
    }
}
