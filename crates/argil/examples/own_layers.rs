//! Layers that come from other code: here from a formula, in your program from your slicer.

use std::error::Error;

use argil::curve::DVec2;
use argil::slice::Layer;
use argil::strand::Role;
use argil::{Planner, Settings};

/// The wall of a vase with five lobes that twist and open as they rise, at a share of its height.
fn vase(share: f64) -> Vec<DVec2> {
    let radius = 14.0 + 4.0 * share;
    let at = |k: u32| {
        let turn = f64::from(k) / 180.0 * std::f64::consts::TAU;
        let lobes = 1.5 * (5.0 * (turn - share)).cos();
        (radius + lobes) * DVec2::from_angle(turn)
    };
    (0..180).map(at).collect()
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let settings = Settings::for_width(2.0);
    let h = settings.layer_height;
    // A knob stands inside from the twelfth layer on, on nothing: the strand below has to hold it.
    let knob = |k: usize| {
        (k >= 12).then(|| (0..24).map(|j| 5.0 * DVec2::from_angle(f64::from(j) * 0.2618)).collect())
    };
    let layers: Vec<Layer> = (0..20)
        .map(|k| {
            let loops: Vec<_> = std::iter::once(vase(k as f64 / 20.0)).chain(knob(k)).collect();
            Layer::of_loops(k, (k + 1) as f64 * h, h, &loops, settings.grid)
        })
        .collect();

    let plan = Planner::default().plan_layers(&layers, &settings)?;
    assert_eq!(plan.strand.layers().len(), 20);
    assert!(plan.layers[11].supports > 0, "the knob is held");
    assert!(plan.strand.length_of(Role::Wall) > 20.0 * 80.0);
    Ok(())
}
