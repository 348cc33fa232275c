//! Draws the pictures in the documentation of the crates, each by the crate that it explains.
//!
//! ```text
//! cargo run -p argil-benches --example pictures
//! ```
#![forbid(unsafe_code)]

mod drawing;
mod scenes;

use std::error::Error;
use std::fs;
use std::path::Path;

/// What may go wrong is told to whoever runs this, and no more.
pub(crate) type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for (place, picture) in [
        ("argil-curve/pictures/held-spans.svg", scenes::held_spans()?),
        ("argil-support/pictures/support-points.svg", scenes::support_points()?),
        ("argil-safeguard/pictures/safeguard.svg", scenes::safeguard()),
        ("argil-graph/pictures/path-graph.svg", scenes::path_graph()?),
        ("argil-tour/pictures/tour.svg", scenes::tour()?),
        ("argil-route/pictures/cycle.svg", scenes::cycle()?),
        ("argil-elastic/pictures/relaxed.svg", scenes::relaxed()?),
        ("argil-fill/pictures/fill.svg", scenes::fill()?),
    ] {
        let path = crates.join(place);
        fs::create_dir_all(path.parent().unwrap_or(&crates))?;
        fs::write(path, picture)?;
    }
    Ok(())
}
