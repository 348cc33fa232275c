//! What must hold of argil's crates whatever bytes they are made to work on.
//!
//! Each target is a plain function of some bytes: it makes an input of them, runs the code and panics where an
//! invariant is broken. `targets/` has a libFuzzer program for each, `tests/seeds.rs` replays the kept inputs without
//! libFuzzer, and `.ci/fuzz TARGET SECONDS` searches for new ones. `seeds/TARGET` holds what is kept: inputs written by
//! `examples/seeds.rs`, and those that once broke something, under the name of what they broke.
#![forbid(unsafe_code)]

mod draw;
mod elastic;
mod graph;
mod model;
mod offsets;
mod pipeline;
mod read_gcode;
mod read_layers;
mod read_obj;
mod read_ply;
mod read_stl;
mod read_three_mf;
mod route;
mod slice;
mod support;
mod tour;
mod write_gcode;

pub use draw::Draw;
pub use elastic::elastic;
pub use graph::graph;
pub use offsets::offsets;
pub use pipeline::pipeline;
pub use read_gcode::read_gcode;
pub use read_layers::read_layers;
pub use read_obj::read_obj;
pub use read_ply::read_ply;
pub use read_stl::read_stl;
pub use read_three_mf::read_three_mf;
pub use route::route;
pub use slice::slice;
pub use support::support;
pub use tour::tour;
pub use write_gcode::write_gcode;

/// A target: panics where the bytes break something.
pub type Target = fn(&[u8]);

/// Every target with its name, which is that of its folder in `seeds/` too.
pub const TARGETS: [(&str, Target); 15] = [
    ("elastic", elastic),
    ("graph", graph),
    ("offsets", offsets),
    ("pipeline", pipeline),
    ("read_gcode", read_gcode),
    ("read_layers", read_layers),
    ("read_obj", read_obj),
    ("read_ply", read_ply),
    ("read_stl", read_stl),
    ("read_three_mf", read_three_mf),
    ("route", route),
    ("slice", slice),
    ("support", support),
    ("tour", tour),
    ("write_gcode", write_gcode),
];
