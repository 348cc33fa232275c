//! From rings and joints to closed curves: arcs and legs by turns.

use argil_curve::{DVec2, on_grid};

use crate::FillCurve;
use crate::curve::Bead;
use crate::joint::Candidate;
use crate::ring::Track;

/// One end of a cut: where an arc of a ring ends and a leg begins.
#[derive(Clone, Copy, Debug)]
struct Tip {
    track: usize,
    /// From 0 up to the ring's length.
    arc: f64,
    at: DVec2,
    /// The tip at the other end of its leg.
    across: usize,
    /// Whether the ring goes on beyond it in its own direction: it is the high end of its cut.
    opens: bool,
}

/// The closed curves of rings that these joints merge. Every arc that is not cut out and every leg is walked once.
pub(crate) fn traced(tracks: &[Track], joints: &[Candidate], grid: f64) -> Vec<FillCurve> {
    let mut tips: Vec<Tip> = Vec::with_capacity(4 * joints.len());
    for joint in joints {
        let base = tips.len();
        let wrap = |track: usize, arc: f64| arc.rem_euclid(tracks[track].curve.length());
        let on_grid = |p: DVec2| on_grid(p, grid);
        // Tips 0 and 1 are the first track's low and high end, 2 and 3 where their legs arrive.
        for (end, leg) in joint.legs.iter().enumerate() {
            let [track, _] = joint.tracks;
            let arc = if end == 0 { joint.cuts[0].low } else { joint.cuts[0].high };
            let tip = Tip {
                track,
                arc: wrap(track, arc),
                at: on_grid(leg.start),
                across: base + 2 + end,
                opens: end == 1,
            };
            tips.push(tip);
        }
        for (end, leg) in joint.legs.iter().enumerate() {
            let [_, track] = joint.tracks;
            let high = (end == 1) != joint.turned;
            let arc = if high { joint.cuts[1].high } else { joint.cuts[1].low };
            tips.push(Tip {
                track,
                arc: wrap(track, arc),
                at: on_grid(leg.end),
                across: base + end,
                opens: high,
            });
        }
    }
    let mut curves: Vec<FillCurve> = Vec::new();
    let mut on_track: Vec<Vec<usize>> = vec![Vec::new(); tracks.len()];
    for (tip, at) in tips.iter().enumerate() {
        on_track[at.track].push(tip);
    }
    for (track, own) in tracks.iter().zip(&mut on_track) {
        own.sort_by(|&a, &b| tips[a].arc.total_cmp(&tips[b].arc).then(a.cmp(&b)));
        if own.is_empty() {
            let points = track.curve.points().to_vec();
            let beads = vec![Bead::of_ring(track.wall); points.len()];
            curves.push(FillCurve { flow: vec![1.0; points.len()], points, beads });
        }
    }
    let mut walked = vec![false; tips.len()];
    for start in 0..tips.len() {
        if walked[start] {
            continue;
        }
        let mut curve = FillCurve::default();
        let mut tip = start;
        while !walked[tip] {
            walked[tip] = true;
            let own = &on_track[tips[tip].track];
            let place = own.iter().position(|&t| t == tip).unwrap_or_default();
            let step = if tips[tip].opens { 1 } else { own.len() - 1 };
            let end = own[(place + step) % own.len()];
            walked[end] = true;
            walk_arc(&tracks[tips[tip].track], tips[tip], tips[end], 4.0 * grid, &mut curve);
            curve.push(tips[end].at, Bead::Joint);
            tip = tips[end].across;
        }
        curve.close();
        curve.flow = vec![1.0; curve.points.len()];
        curves.push(curve);
    }
    curves
}

/// Adds the arc from a tip to the next one on its ring, without its last point. Vertices nearer than `least` to the tips
/// would leave sides without direction and are passed over.
fn walk_arc(track: &Track, from: Tip, to: Tip, least: f64, curve: &mut FillCurve) {
    let bead = Bead::of_ring(track.wall);
    let ring = &track.curve;
    let (n, length) = (ring.segment_count(), ring.length());
    curve.push(from.at, bead);
    let span = if from.opens { to.arc - from.arc } else { from.arc - to.arc }.rem_euclid(length);
    let first = ring.locate(from.arc).segment;
    for k in 0..n {
        let vertex = if from.opens { (first + 1 + k) % n } else { (first + n - k) % n };
        let arc = ring.arc_of(vertex);
        let gone = if from.opens { arc - from.arc } else { from.arc - arc }.rem_euclid(length);
        if gone + least >= span {
            break;
        }
        if gone >= least {
            curve.push(ring.points()[vertex], bead);
        }
    }
}
