//! Lines for plotters that speak HPGL.

use std::fmt::Write;

use argil::curve::DVec2;

/// Steps of a plotter's coordinates in a millimetre.
const STEPS: f64 = 40.0;

/// A closed line as HPGL: the pen goes to the first point, down, along all others and back, and up.
///
/// # Example
/// ```
/// let line = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(argil_plotter::DVec2::from);
/// assert_eq!(argil_plotter::write_hpgl(&line), "IN;SP1;PU0,0;PD40,0,40,40,0,0;PU;\n");
/// ```
#[must_use]
pub fn write_hpgl(line: &[DVec2]) -> String {
    let step = |p: &DVec2| format!("{},{}", (STEPS * p.x).round() as i64, (STEPS * p.y).round() as i64);
    let mut text = String::from("IN;SP1;");
    if let Some(first) = line.first() {
        let rest: Vec<String> = line.iter().skip(1).chain([first]).map(step).collect();
        // Writing to a string does not fail.
        let _ = write!(text, "PU{};PD{};", step(first), rest.join(","));
    }
    text.push_str("PU;\n");
    text
}
