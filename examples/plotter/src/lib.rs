//! Draws closed outlines in one line: the pen goes down once, and up again where it began.
#![forbid(unsafe_code)]

mod drawing;
mod hpgl;
mod one_line;

pub use argil::curve::DVec2;
pub use drawing::{DrawingError, read_drawing};
pub use hpgl::write_hpgl;
pub use one_line::one_line;
