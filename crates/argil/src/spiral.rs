//! Layers that rise along their cycles, so that no step is left.
//!
//! The strand stays where it is in the plane; what changes is its height. A *run* of m layers rises evenly, each of them by
//! (m + 1) / m layer heights, on a level one; the layer after it lies level on the last one that rises. So the first bead of a run
//! tapers in from nothing and the level one above tapers out to nothing, there is as much paste as in level layers, and the top
//! is where it was. The middle of each turn lies at most half a layer height from where it would lie level, and in the mean of a run
//! not at all.
//!
//! The rule of support looks at the plane alone and holds as before; but two cycles differ in length and perhaps in the
//! order in which they pass the same places, so that the bead between them is not everywhere one turn high. Where it is not between
//! half and one and a half layer heights, the upper one lies level and a new run begins above. A run of few layers would be too
//! steep; its layers lie level. Level layers begin with a ramp where they can, and else with the short step that every layer has otherwise.

mod direction;
mod ramp;
mod slope;
mod track;
mod under;

use argil_curve::Segment;
use argil_strand::{Strand, StrandError};

use crate::Settings;
use crate::plan::{Climb, LevelCause};
pub(crate) use direction::aligned;
use slope::Slope;
use track::Track;
use under::{Under, higher};

/// The fewest layers of a run: with nine, each rises by ten ninths of a layer height, and its thickest bead, of 1.35 turns, is one
/// and a half layer heights.
const LEAST: usize = 9;

/// The thickest bead, in layer heights.
const THICKEST: f64 = 1.5;

/// The thinnest bead, in layer heights: every move pushes out so much that no place of the path is passed over.
const THINNEST: f64 = 0.01;

/// Where strand lies on the step from turn to turn, in longest steps from either end of a layer.
const SEAM: f64 = 2.0;

/// How a layer lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lie {
    pub(crate) climb: Climb,
    pub(crate) cause: Option<LevelCause>,
    /// The thinnest and the thickest bead, mm.
    pub(crate) beads: [f64; 2],
    /// The share of the step to the layer that a ramp takes.
    pub(crate) ramp: f64,
}

/// The strand with its layers rising wherever they can, and how each layer lies.
///
/// # Errors
/// Those of a strand's shape; what is built here has none.
///
/// # Complexity
/// Near linear in the number of moves.
pub(crate) fn spiral(strand: Strand, settings: &Settings) -> Result<(Strand, Vec<Lie>), StrandError> {
    let tracks: Vec<Track> = (0..strand.layers().len()).map(|k| track(&strand, k, settings)).collect();
    let turns = turns(&tracks, settings);
    let runs = runs(&turns);
    let ramps = ramp::shares(&tracks, &free(&runs), seam_reach(settings), settings);
    let (start, mut layers) = (strand.start(), strand.into_layers());
    let mut rises = vec![Vec::new(); layers.len()];
    let mut lies = Vec::with_capacity(layers.len());
    let mut below: Vec<f64> = Vec::new();
    for (k, (turn, run)) in turns.iter().zip(&runs).enumerate() {
        let (track, height) = (&tracks[k], layers[k].height);
        let Some(Run { base, count }) = *run else {
            let (cause, ramp) = (Some(turn.cause.unwrap_or(LevelCause::Few)), ramps[k]);
            let levels = ramp::levels(track, ramp, settings.width);
            let z: Vec<f64> = levels.iter().map(|level| layers[k].z + level * height).collect();
            let mut lie = Lie { climb: Climb::Step, cause, beads: [height; 2], ramp };
            if ramp > 0.0 || (k > 0 && ramps[k - 1] > 0.0) {
                let beads =
                    beads(track, &z, &Under::of(&tracks[k - 1], &below, settings.width), height, settings);
                lie.beads = apart_from_seam(track, &beads, settings);
                (layers[k].moves, rises[k]) = track.moves(&layers[k].moves, &z, &beads, height);
            }
            if ramp > 0.0 {
                lie.climb = Climb::Ramp;
            }
            lies.push(lie);
            below = z;
            continue;
        };
        let (low, top) = (layers[base].z, layers[base + count + 1].z);
        let share = |level: &f64| level / count as f64;
        let z: Vec<f64> = turn.levels.iter().map(share).map(|s| low * (1.0 - s) + top * s).collect();
        let beads = beads(track, &z, &Under::of(&tracks[k - 1], &below, settings.width), height, settings);
        let climb = if turn.cause.is_none() { Climb::Rising } else { Climb::Levelling };
        let seen = apart_from_seam(track, &beads, settings);
        lies.push(Lie { climb, cause: turn.cause, beads: seen, ramp: 0.0 });
        (layers[k].moves, rises[k]) = track.moves(&layers[k].moves, &z, &beads, height);
        below = z;
    }
    // Rounding in the last digit must not make the strand fall.
    let mut at = f64::NEG_INFINITY;
    for rise in rises.iter_mut().flatten() {
        at = at.max(rise.z);
        rise.z = at;
    }
    Ok((Strand::new(start, layers)?.risen(rises)?, lies))
}

/// The path of a layer from the end of the one below; of the lowest, its cycle.
fn track(strand: &Strand, k: usize, settings: &Settings) -> Track {
    let below = k.checked_sub(1).and_then(|below| strand.seam(below));
    let (from, moves) = match below {
        Some(end) => (end, strand.layers()[k].moves.as_slice()),
        None => (strand.seam(k).unwrap_or_else(|| strand.start()), strand.cycle(k)),
    };
    Track::new(from, moves, settings.width, settings.grid)
}

/// How far from either end of a layer the step between turns reaches, mm.
fn seam_reach(settings: &Settings) -> f64 {
    SEAM * settings.seaming().reach
}

/// A layer of a run, or a level one.
struct Turn {
    /// The heights of the points, in turns of the run: 0 on the layer that it begins on.
    levels: Vec<f64>,
    /// Why it lies level, if it does.
    cause: Option<LevelCause>,
}

/// Lets every layer rise that can. Where one cannot rise on one that does, the run ends with it, level, and the next begins on it.
fn turns(tracks: &[Track], settings: &Settings) -> Vec<Turn> {
    let width = settings.width;
    let (criterion, seam) = (settings.criterion(), seam_reach(settings));
    let mut turns: Vec<Turn> = Vec::with_capacity(tracks.len());
    let mut risen = 0.0;
    for (k, track) in tracks.iter().enumerate() {
        let under =
            turns.last().filter(|_| risen > 0.0).map(|turn| Under::of(&tracks[k - 1], &turn.levels, width));
        let rise = match k {
            0 => Err(LevelCause::Bed),
            _ if k + 1 == tracks.len() => Err(LevelCause::Rim),
            _ => Slope { track, under: under.as_ref(), turn: risen + 1.0, seam, criterion, width }.risen(),
        };
        turns.push(match rise {
            Ok(levels) => {
                risen += 1.0;
                Turn { levels, cause: None }
            }
            Err(cause) => {
                let levels = vec![risen; track.points.len()];
                risen = 0.0;
                Turn { levels, cause: Some(cause) }
            }
        });
    }
    turns
}

/// A run that is long enough.
#[derive(Clone, Copy)]
struct Run {
    /// The level layer that it begins on.
    base: usize,
    /// How many layers rise.
    count: usize,
}

/// For each layer the run that it rises in or ends.
fn runs(turns: &[Turn]) -> Vec<Option<Run>> {
    let mut runs = vec![None; turns.len()];
    let mut base = 0;
    for (k, _) in turns.iter().enumerate().filter(|(_, turn)| turn.cause.is_some()) {
        let count = k.saturating_sub(base + 1);
        if count >= LEAST {
            runs[base + 1..=k].fill(Some(Run { base, count }));
        }
        base = k;
    }
    runs
}

/// Which layers may have a ramp: not those of a run nor the one that it begins on, not the lowest, and not the uppermost, whose rim is level.
fn free(runs: &[Option<Run>]) -> Vec<bool> {
    let last = runs.len().saturating_sub(1);
    let is_base = |k: usize| runs.get(k + 1).copied().flatten().is_some_and(|run| run.base == k);
    (0..runs.len()).map(|k| k > 0 && k < last && runs[k].is_none() && !is_base(k)).collect()
}

/// The height of the bead of each stretch, mm: from the strand below it to its own top. What nothing lies below is a thread in the
/// air, as thick as the layer.
fn beads(track: &Track, z: &[f64], under: &Under, height: f64, settings: &Settings) -> Vec<f64> {
    let (width, across, seam) = (settings.width, settings.criterion().across, seam_reach(settings));
    let own = Under::of_beginning(track, z, seam, width);
    let last = track.length() - seam;
    let bead = |(k, stretch): (usize, Segment)| {
        let (at, top) = (stretch.point_at(0.5), 0.5 * (z[k] + z[k + 1]));
        let below = under.top(at, across);
        // The end of a turn lies on the step that it began with.
        let begun = own.top(at, across).filter(|_| track.arcs[k] >= last);
        let found = [below, begun].into_iter().flatten().reduce(|a, b| higher(a, b, width));
        found.map_or(height, |(below, _)| (top - below).clamp(THINNEST * height, THICKEST * height))
    };
    track.stretches().enumerate().map(bead).collect()
}

/// The thinnest and the thickest of the beads that do not lie near the step from turn to turn.
fn apart_from_seam(track: &Track, beads: &[f64], settings: &Settings) -> [f64; 2] {
    let seam = seam_reach(settings);
    let apart = track.arcs.windows(2).map(|arc| arc[0] >= seam && arc[1] <= track.length() - seam);
    let kept: Vec<f64> = beads.iter().zip(apart).filter(|(_, apart)| *apart).map(|(&bead, _)| bead).collect();
    let counted = if kept.is_empty() { beads } else { &kept };
    counted.iter().fold([f64::INFINITY, 0.0], |[low, high], &bead| [low.min(bead), high.max(bead)])
}
