//! Sharp turns and bends, where a bead piles up and drags.

use crate::settings::Tolerance;
use crate::wanted::Wanted;
use argil_curve::DVec2;

/// Steps shorter than this, mm, have no direction.
const NO_STEP: f64 = 1e-6;
/// A turn by more than this, in degrees, is sharp.
const SHARP: f64 = 135.0;
/// In w: turns within so much of the path add up to one bend.
const BEND: f64 = 0.5;

/// A turn of non-model strand at a vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    pub(crate) at: DVec2,
    /// Arc length from the beginning of the path, mm.
    pub(crate) arc: f64,
    /// In degrees, positive to the left.
    pub(crate) angle: f64,
}

/// The turns of a path at its vertices, apart from the model's own.
pub(crate) fn turns(points: &[DVec2], wanted: &Wanted, tolerance: &Tolerance) -> Vec<Turn> {
    let mut arc = 0.0;
    let mut steps = Vec::with_capacity(points.len());
    for pair in points.windows(2) {
        let step = pair[1] - pair[0];
        arc += step.length();
        if step.length() > NO_STEP {
            steps.push((pair[1], arc, step));
        }
    }
    steps
        .windows(2)
        .map(|pair| {
            let (at, arc, step) = pair[0];
            Turn { at, arc, angle: step.angle_to(pair[1].2).to_degrees() }
        })
        .filter(|turn| wanted.wall_distance(turn.at) > tolerance.on_wall)
        .collect()
}

/// Place and angle in degrees of every sharp turn.
pub(crate) fn sharp_turns(turns: &[Turn]) -> impl Iterator<Item = (DVec2, f64)> {
    turns.iter().map(|turn| (turn.at, turn.angle.abs())).filter(|&(_, angle)| angle > SHARP)
}

/// Place and angle in degrees of every sharp bend: turns that add up to more than 135° within half a bead of the path.
/// Bends share no turn, so there is one for a hairpin however many vertices it has.
pub(crate) fn sharp_bends(turns: &[Turn], width: f64) -> Vec<(DVec2, f64)> {
    let mut bends = Vec::new();
    let mut begin = 0;
    for last in 0..turns.len() {
        let mut angle = 0.0;
        let within = |turn: &&Turn| turns[last].arc - turn.arc <= BEND * width;
        for turn in turns[begin..=last].iter().rev().take_while(within) {
            angle += turn.angle;
            if f64::abs(angle) > SHARP {
                bends.push((turns[last].at.midpoint(turn.at), angle.abs()));
                begin = last + 1;
                break;
            }
        }
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turn(arc: f64, angle: f64) -> Turn {
        Turn { at: DVec2::new(arc, 0.0), arc, angle }
    }

    #[test]
    fn a_hairpin_is_one_bend_however_many_vertices_it_has() {
        let round = |step: f64| (0..6).map(|k| turn(step * f64::from(k), 30.0)).collect::<Vec<_>>();
        assert_eq!(sharp_bends(&round(0.14), 1.5).len(), 1);
        assert!(sharp_bends(&round(0.3), 1.5).is_empty());
        assert_eq!(sharp_bends(&[turn(0.0, 170.0), turn(9.0, -140.0)], 1.5).len(), 2);
    }

    #[test]
    fn there_and_back_is_no_bend() {
        assert!(sharp_bends(&[turn(0.0, 90.0), turn(0.1, -90.0), turn(0.2, 80.0)], 1.5).is_empty());
        assert_eq!(sharp_turns(&[turn(0.0, -136.0), turn(0.1, 134.0)]).count(), 1);
    }
}
