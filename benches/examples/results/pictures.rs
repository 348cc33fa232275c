//! Pictures of two layers of a model.

use std::fs;
use std::path::Path;

use argil::Plan;
use argil_preview::{SvgStyle, layer_svg, png};

use crate::Outcome;

/// Longest side, pixels: 20 to 50 kB a picture.
const SIDE: u32 = 480;

/// Draws the layers at a third and at two thirds of the height.
pub(crate) fn two_layers(name: &str, plan: &Plan, folder: &Path) -> Outcome<()> {
    fs::create_dir_all(folder)?;
    let layers = plan.strand.layers().len();
    for (part, position) in [("lower", layers / 3), ("upper", 2 * layers / 3)] {
        if position < layers {
            let svg = layer_svg(&plan.strand, position, &SvgStyle::default());
            fs::write(folder.join(format!("{name}-{part}.png")), png(&svg, SIDE)?)?;
        }
    }
    Ok(())
}
