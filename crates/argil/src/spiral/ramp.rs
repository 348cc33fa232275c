//! Layers that cannot rise along their whole cycle rise along its beginning.
//!
//! A ramp takes some share of the step that a level layer would begin with. Where two ramps lie on each other the bead between them is one layer thick;
//! where one begins on level strand, or level strand lies on one, it is thinner or thicker by that share. So the shares of neighbours differ by
//! little, and grow from layer to layer until there is no step.

use super::slope::{BEAD, STEEPEST};
use super::track::Track;
use super::under::Under;
use crate::Settings;

/// Length of a ramp, in w: twice what the steepest rise takes.
const RAMP: f64 = 2.0 * STEEPEST;

/// Layers shorter than so many ramps have none.
const FEWEST: f64 = 4.0;

/// By how much the shares of neighbours may differ, so that the bead between them is neither too thin nor too thick.
const FADE: f64 = 0.3;

/// How often shares are brought down where ramps do not lie on each other, before those that still do not are left out.
const ROUNDS: usize = 12;

/// The height of each point of a layer, in layer heights above its own, whose ramp takes this share of the step.
pub(super) fn levels(track: &Track, share: f64, width: f64) -> Vec<f64> {
    let length = RAMP * width;
    track.arcs.iter().map(|arc| share * (arc / length - 1.0).min(0.0)).collect()
}

/// For each layer the share of its step that a ramp takes: 0 where it is not `free` to have one. Layers that are not free lie level, or are none of
/// those that ramps may lie on or under.
///
/// # Complexity
/// Near linear in the points, a few times over.
pub(super) fn shares(tracks: &[Track], free: &[bool], seam: f64, settings: &Settings) -> Vec<f64> {
    let width = settings.width;
    let is_long = |track: &Track| track.length() >= FEWEST * RAMP * width;
    let mut most: Vec<f64> =
        tracks.iter().zip(free).map(|(track, &free)| f64::from(u8::from(free && is_long(track)))).collect();
    let mut round = 0;
    loop {
        let shares = faded(&most);
        let mut sound = true;
        for k in 1..tracks.len() {
            let pair = [shares[k - 1], shares[k]];
            if pair == [0.0; 2] || fits(&tracks[k - 1], &tracks[k], pair, seam, settings) {
                continue;
            }
            sound = false;
            for (most, share) in most[k - 1..=k].iter_mut().zip(pair) {
                *most = if share <= FADE || round >= ROUNDS { 0.0 } else { most.min(FADE) };
            }
        }
        if sound {
            return shares;
        }
        round += 1;
    }
}

/// The largest shares that are nowhere above `most`, and differ by little.
fn faded(most: &[f64]) -> Vec<f64> {
    let mut shares = most.to_vec();
    for k in 1..shares.len() {
        shares[k] = shares[k].min(shares[k - 1] + FADE);
    }
    for k in (1..shares.len()).rev() {
        shares[k - 1] = shares[k - 1].min(shares[k] + FADE);
    }
    shares
}

/// Whether the bead between two layers with these shares is as thick as it should be, but for where they begin and end.
fn fits(below: &Track, track: &Track, [lower, upper]: [f64; 2], seam: f64, settings: &Settings) -> bool {
    let (width, across) = (settings.width, settings.criterion().across);
    let under = Under::of(below, &levels(below, lower, width), width);
    let [thin, thick] = BEAD;
    let own = levels(track, upper, width);
    (0..track.points.len()).all(|k| {
        let is_seam = track.arcs[k] < seam || track.arcs[k] > track.length() - seam;
        let top = if is_seam { None } else { under.top(track.points[k], across) };
        top.is_none_or(|(top, _)| (thin..=thick).contains(&(1.0 + own[k] - top)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_grow_and_shrink_by_little() {
        let shares = faded(&[0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0]);
        let wanted = [0.0, 0.3, 0.6, 0.9, 0.6, 0.3, 0.0, 0.3, 0.0];
        assert!(shares.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12), "{shares:?}");
    }
}
