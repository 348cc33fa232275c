//! The strand on a grid of integers, as a page carries it.

use argil_strand::{DVec2, Move, Rise, Role, Strand};

use crate::simplify::kept;
use crate::widths::width_share;

/// Grid steps along the longer side of the frame: coordinates fit into 16 bits.
const STEPS: f64 = 65_535.0;

/// How often the tolerance may grow before a plan is taken as it is. Each time doubles it, so that the last one is
/// 2^20 times the first, which is as large as the frame.
const COARSENINGS: u32 = 20;

/// Where a layer's points end, and what its bead is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OutlineLayer {
    /// The number in the slicing.
    pub(crate) index: usize,
    pub(crate) z: f64,
    pub(crate) height: f64,
    pub(crate) width: f64,
    /// Points on this layer, the start of the strand not counted.
    pub(crate) points: usize,
}

/// A strand whose points are integers on a grid of `step` mm from `origin`, perhaps fewer of them than it has.
pub(crate) struct Outline {
    pub(crate) origin: DVec2,
    pub(crate) step: f64,
    pub(crate) layers: Vec<OutlineLayer>,
    /// The start and then the end of every move, in grid steps.
    pub(crate) points: Vec<[u16; 2]>,
    /// The role of the move that ends at each point but the first, as a position in [`Role::ALL`].
    pub(crate) roles: Vec<u8>,
    /// Where some beads are not as wide as their layer, the class of the bead of each move, as [`width_share`] tells it.
    pub(crate) widths: Vec<u8>,
    /// Where some layer rises, for each of the points the height of its place and of the bead that ends there, in steps of `climb`.
    pub(crate) rises: Vec<[u16; 2]>,
    /// mm.
    pub(crate) climb: f64,
    /// Moves of the strand itself.
    pub(crate) moves: usize,
    /// How far a point that was left out may lie from the line that is drawn, mm; 0 when none was.
    pub(crate) off: f64,
}

impl Outline {
    /// Puts a strand on a grid. With more than `most` moves, points are left out that lie nearest to the line
    /// through their neighbours, until few enough remain or nothing more can go without losing a change of role.
    ///
    /// # Complexity
    /// O(n log n) in the number of moves, as a rule, for each time that the tolerance is doubled.
    pub(crate) fn new(strand: &Strand, most: usize) -> Self {
        let moves = strand.layers().iter().map(|layer| layer.moves.len()).sum();
        let (origin, step) = grid(strand);
        let mut tolerance = 0.0;
        let mut outline = Self::with_tolerance(strand, origin, step, tolerance);
        let thinnest = strand.layers().iter().map(|layer| layer.width).fold(f64::INFINITY, f64::min);
        for doubling in 0..COARSENINGS {
            if outline.roles.len() <= most {
                break;
            }
            // A hundredth of a bead is less than a pixel at any view of a whole print.
            tolerance = thinnest * 0.01 * f64::from(1u32 << doubling);
            outline = Self::with_tolerance(strand, origin, step, tolerance);
        }
        Self { moves, off: tolerance, ..outline }
    }

    fn with_tolerance(strand: &Strand, origin: DVec2, step: f64, tolerance: f64) -> Self {
        let on_grid = |p: DVec2| ((p - origin) / step).round().to_array().map(|value| value as u16);
        let mut points = vec![on_grid(strand.start())];
        let mut roles = Vec::new();
        let mut layers = Vec::new();
        let mut at = strand.start();
        let rising = (0..strand.layers().len()).any(|k| !strand.rises(k).is_empty());
        let climb = climb(strand);
        let lies = |rise: Rise| [rise.z, rise.height].map(|value| (value / climb).round() as u16);
        let varying = (0..strand.layers().len()).any(|k| !strand.widths(k).is_empty());
        let mut widths = Vec::new();
        let mut rises: Vec<[u16; 2]> = strand
            .layers()
            .first()
            .filter(|_| rising)
            .map(|layer| lies(Rise { z: layer.z, height: layer.height }))
            .into_iter()
            .collect();
        for (position_of, layer) in strand.layers().iter().enumerate() {
            let before = roles.len();
            let mut done = 0;
            let own = strand.widths(position_of);
            let share = |k: usize| width_share(own.get(k).copied().unwrap_or(layer.width), layer.width) as u8;
            let beads: Vec<(Move, u8)> =
                layer.moves.iter().enumerate().map(|(k, step)| (*step, share(k))).collect();
            for run in beads.chunk_by(|a, b| (a.0.role, a.1) == (b.0.role, b.1)) {
                let line: Vec<DVec2> =
                    std::iter::once(at).chain(run.iter().map(|(step, _)| step.to)).collect();
                for k in chosen(&line, tolerance).into_iter().skip(1) {
                    let ((Move { role, .. }, share), place) = (run[k - 1], on_grid(line[k]));
                    // A step of no length on the grid is drawn by nobody, but for the rise between layers.
                    if points.last() != Some(&place) || role == Role::Seam {
                        points.push(place);
                        roles.push(position(role));
                        if varying {
                            widths.push(share);
                        }
                        if rising {
                            let level = Rise { z: layer.z, height: layer.height };
                            let own = strand.rises(position_of).get(done + k - 1).copied();
                            rises.push(lies(own.unwrap_or(level)));
                        }
                    }
                }
                done += run.len();
                at = line.last().copied().unwrap_or(at);
            }
            let (index, z, height, width) = (layer.index, layer.z, layer.height, layer.width);
            layers.push(OutlineLayer { index, z, height, width, points: roles.len() - before });
        }
        Self { origin, step, layers, points, roles, widths, rises, climb, moves: 0, off: tolerance }
    }
}

/// All points, or fewer within a tolerance.
fn chosen(line: &[DVec2], tolerance: f64) -> Vec<usize> {
    if tolerance > 0.0 { kept(line, tolerance) } else { (0..line.len()).collect() }
}

/// The lowest corner of the strand's frame, and the step that divides its longer side.
fn grid(strand: &Strand) -> (DVec2, f64) {
    let start = strand.start();
    let points = strand.layers().iter().flat_map(|layer| layer.moves.iter().map(|step| step.to));
    let (low, high) = points.fold((start, start), |(low, high), p| (low.min(p), high.max(p)));
    let step = (high - low).max_element() / STEPS;
    // A strand of no extent, or of one that is not representable, still has a grid.
    (low, if step > 0.0 && step.is_finite() { step } else { 1.0 })
}

/// The step by which the heights of a strand that rises are told, mm.
fn climb(strand: &Strand) -> f64 {
    let tops = strand.layers().iter().map(|layer| layer.z.max(layer.height));
    let highest = strand.steps().map(|step| step.to.z.max(step.height)).chain(tops).fold(0.0, f64::max);
    let step = highest / STEPS;
    if step > 0.0 && step.is_finite() { step } else { 1.0 }
}

/// Position of a role in [`Role::ALL`].
fn position(role: Role) -> u8 {
    Role::ALL.iter().position(|&other| other == role).map_or(0, |position| position as u8)
}

#[cfg(test)]
mod tests {
    use argil_strand::{DVec2, Move, Role, Strand, StrandLayer};

    use super::Outline;

    fn ring(points: usize, layers: usize) -> Strand {
        let at = |k: usize| DVec2::from_angle(std::f64::consts::TAU * k as f64 / points as f64) * 20.0;
        let turn: Vec<Move> = (1..=points).map(|k| Move { to: at(k % points), role: Role::Wall }).collect();
        let seam = Move { to: at(0), role: Role::Seam };
        let layer = |k: usize| StrandLayer {
            index: k,
            z: 0.5 * (k as f64 + 1.0),
            height: 0.5,
            width: 1.5,
            moves: (k > 0).then_some(seam).into_iter().chain(turn.clone()).collect(),
            supports: vec![],
        };
        Strand::new(at(0), (0..layers).map(layer).collect()).unwrap()
    }

    #[test]
    fn small_plans_keep_every_point_to_half_a_step() {
        let strand = ring(360, 3);
        let outline = Outline::new(&strand, 100_000);
        assert_eq!((outline.off, outline.moves, outline.roles.len()), (0.0, 3 * 360 + 2, 3 * 360 + 2));
        assert_eq!(outline.layers.iter().map(|layer| layer.points).collect::<Vec<_>>(), [360, 361, 361]);
        for (step, point) in strand.steps().zip(&outline.points[1..]) {
            let place = outline.origin + DVec2::from(point.map(f64::from)) * outline.step;
            assert!((place - step.to.truncate()).abs().max_element() <= 0.5001 * outline.step);
        }
    }

    #[test]
    fn large_plans_lose_points_and_say_how_far_they_are_off() {
        let strand = ring(2000, 5);
        let outline = Outline::new(&strand, 3000);
        assert!(outline.roles.len() <= 3000 && outline.off > 0.0, "{}", outline.roles.len());
        assert_eq!(outline.layers.len(), 5);
        assert_eq!(outline.layers.iter().map(|layer| layer.points).sum::<usize>(), outline.roles.len());
        let radius =
            |point: &[u16; 2]| (outline.origin + DVec2::from(point.map(f64::from)) * outline.step).length();
        assert!(outline.points.iter().all(|point| (radius(point) - 20.0).abs() < 2.0 * outline.step));
    }

    #[test]
    fn beads_of_another_width_than_their_layer_are_told_and_no_others() {
        let strand = ring(40, 2);
        assert!(Outline::new(&strand, 10).widths.is_empty());
        let slender = |k: usize| if k < 20 { 1.5 } else { 1.2 };
        let strand = strand.of_widths(vec![vec![], (0..41).map(slender).collect()]).unwrap();
        let outline = Outline::new(&strand, 10);
        let second = &outline.widths[outline.layers[0].points..];
        assert!(outline.widths.len() == outline.roles.len() && outline.roles.len() < 81);
        assert!(
            second.contains(&20)
                && second.contains(&16)
                && second.iter().all(|share| [20, 16].contains(share))
        );
    }

    #[test]
    fn a_strand_without_extent_has_an_outline() {
        let moves = vec![Move { to: DVec2::ONE, role: Role::Wall }];
        let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves, supports: vec![] };
        let outline = Outline::new(&Strand::new(DVec2::ONE, vec![layer]).unwrap(), 10);
        assert_eq!((outline.points, outline.roles.len()), (vec![[0, 0]], 0));
    }
}
