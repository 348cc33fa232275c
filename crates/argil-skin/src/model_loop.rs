//! The loops that a layer of the model consists of.

use argil_curve::{ClosedCurve, DVec2};

/// A closed path of the model.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ModelLoop {
    /// Its vertices in mm, without repeating the first at the end.
    pub points: Vec<DVec2>,
    /// Whether it is fill, and no wall.
    pub fill: bool,
    /// The smallest loop around it, as an index into the layer's loops.
    pub parent: Option<usize>,
}

/// Finds the parents of loops that neither cross nor touch each other.
///
/// # Complexity
/// Each loop is tested against all others.
pub(crate) fn nest(loops: &mut [ModelLoop]) {
    let curves: Vec<Option<ClosedCurve>> =
        loops.iter().map(|l| ClosedCurve::new(l.points.clone()).ok()).collect();
    let area = |k: usize| curves[k].as_ref().map_or(0.0, |curve| curve.signed_area().abs());
    for k in 0..loops.len() {
        let Some(&point) = loops[k].points.first() else { continue };
        // Loops that hold the same point lie inside each other, so the smallest is the innermost.
        loops[k].parent = (0..loops.len())
            .filter(|&other| other != k && curves[other].as_ref().is_some_and(|curve| curve.contains(point)))
            .min_by(|&a, &b| area(a).total_cmp(&area(b)).then(a.cmp(&b)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_loop_around_is_the_parent() {
        let square = |half: f64, x: f64| {
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let points = corners.map(|c| half * DVec2::from(c) + DVec2::new(x, 0.0)).to_vec();
            ModelLoop { points, fill: false, parent: None }
        };
        let mut loops = vec![square(1.0, 0.0), square(9.0, 0.0), square(3.0, 0.0), square(1.0, 20.0)];
        nest(&mut loops);
        assert_eq!(loops.iter().map(|l| l.parent).collect::<Vec<_>>(), [Some(2), None, Some(1), None]);
    }
}
