//! One line through all outlines.

use argil::curve::DVec2;
use argil::route::{LayerInput, RouteError, RouteSettings, Router, Wall};
use argil::slice::Layer;

/// One closed line that draws every outline whole and once, and crosses itself nowhere. Its first point is not repeated.
///
/// `pen` is the width of the line, mm: where two joints leave an outline, they are at least some 1.7 of it apart.
///
/// # Errors
/// When an outline is no simple closed curve, or there is no way between two of them; with a place.
///
/// # Complexity
/// That of [`Router::cycle`].
///
/// # Example
/// ```
/// use argil_plotter::{one_line, read_drawing};
///
/// let loops = read_drawing("0,0 9,0 9,9 0,9\n20,0 29,0 29,9 20,9\n").expect("these are points");
/// let line = one_line(&loops, 0.5)?;
/// assert!(loops.iter().flatten().all(|corner| line.contains(corner)));
/// # Ok::<(), argil::route::RouteError>(())
/// ```
pub fn one_line(loops: &[Vec<DVec2>], pen: f64) -> Result<Vec<DVec2>, RouteError> {
    let settings = RouteSettings::for_width(pen);
    let layer = Layer::of_loops(0, pen, pen, loops, settings.grid);
    let walls: Vec<Wall<'_>> =
        layer.walls.iter().map(|wall| Wall { points: &wall.points, parent: wall.parent }).collect();
    let input = LayerInput { walls: &walls, demands: &[], safeguard: &[], above: None, barred: &[] };
    Ok(Router::new(settings)?.cycle(&input)?.points)
}
