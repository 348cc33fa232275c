//! Holes of the mesh where a layer meets them: gaps in its contours.

use crate::chain::OpenChain;
use geo::Contains;
use geo_types::{Coord, MultiPolygon, Point};
use glam::DVec2;

const NONE: u32 = u32::MAX;

/// Samples of a chain that are looked for in a region.
const SAMPLES: usize = 33;

/// Contours that were closed across gaps.
#[derive(Debug, Default)]
pub(crate) struct Closed {
    pub(crate) contours: Vec<Vec<DVec2>>,
    /// The middle and the width of each gap.
    pub(crate) gaps: Vec<(DVec2, f64)>,
}

/// Which gaps may be closed.
pub(crate) struct Closing<'a> {
    /// The widest gap that is closed, but for those inside the solid.
    pub(crate) limit: f64,
    /// Gaps up to this width may join any two chains; wider ones only chains that together are twice as long as the gap.
    pub(crate) sure: f64,
    /// Where there is solid anyhow.
    pub(crate) solid: &'a MultiPolygon<f64>,
}

impl Closing<'_> {
    /// A chain is closed upon itself only if its gap is less than half its length: otherwise the area
    /// that it would enclose is a guess. Inside the solid a joint bounds nothing, so that there it is none.
    fn admits(&self, gap: f64, tail: &OpenChain, head: &OpenChain, is_same: bool) -> bool {
        if gap <= self.sure && !is_same {
            return true;
        }
        let both = if is_same { tail.length() } else { tail.length() + head.length() };
        (gap <= self.limit && gap <= 0.5 * both) || self.is_in_solid(tail, head)
    }

    fn is_in_solid(&self, tail: &OpenChain, head: &OpenChain) -> bool {
        let (Some(from), Some(to)) = (tail.points.last(), head.points.first()) else { return false };
        (1..8).all(|k| holds(self.solid, from.lerp(*to, f64::from(k) / 8.0)))
    }
}

fn holds(region: &MultiPolygon<f64>, p: DVec2) -> bool {
    region.contains(&Point(Coord { x: p.x, y: p.y }))
}

/// Whether a chain runs inside the region all along.
pub(crate) fn runs_inside(chain: &OpenChain, region: &MultiPolygon<f64>) -> bool {
    let length = chain.length();
    let mut wanted = (1..SAMPLES).map(|k| length * k as f64 / SAMPLES as f64).peekable();
    let mut done = 0.0;
    for pair in chain.points.windows(2) {
        let step = pair[0].distance(pair[1]);
        while let Some(at) = wanted.next_if(|&at| at <= done + step) {
            let t = if step > 0.0 { (at - done) / step } else { 0.0 };
            if !holds(region, pair[0].lerp(pair[1], t)) {
                return false;
            }
        }
        done += step;
    }
    true
}

/// Joins the ends of open chains over gaps, the narrowest gap first, and returns the contours
/// that close; what stays open is left in `open`.
///
/// # Complexity
/// Each end looks at the ends within the limit along x only; the few nearest are candidates.
pub(crate) fn close_gaps(open: &mut Vec<OpenChain>, closing: &Closing<'_>) -> Closed {
    let mut closed = Closed::default();
    loop {
        let joints = joints(open, closing);
        let mut follower = vec![NONE; open.len()];
        let mut has_leader = vec![false; open.len()];
        for &(gap, tail, head) in &joints {
            if follower[tail as usize] == NONE && !has_leader[head as usize] {
                follower[tail as usize] = head;
                has_leader[head as usize] = true;
                if let (Some(&from), Some(&to)) =
                    (open[tail as usize].points.last(), open[head as usize].points.first())
                {
                    closed.gaps.push((from.midpoint(to), gap));
                }
            }
        }
        if follower.iter().all(|&chain| chain == NONE) {
            return closed;
        }
        let mut left = Vec::new();
        let mut used = vec![false; open.len()];
        let rings_last =
            (0..open.len()).filter(|&k| !has_leader[k]).chain((0..open.len()).filter(|&k| has_leader[k]));
        for first in rings_last.collect::<Vec<_>>() {
            if used[first] {
                continue;
            }
            let mut points = Vec::new();
            let mut chain = first;
            while !used[chain] {
                used[chain] = true;
                points.append(&mut open[chain].points);
                if follower[chain] == NONE {
                    break;
                }
                chain = follower[chain] as usize;
            }
            if has_leader[first] {
                closed.contours.push(points);
            } else {
                left.push(OpenChain { points });
            }
        }
        *open = left;
    }
}

/// Gaps that may be closed as (gap, chain that ends, chain that begins), narrowest first.
fn joints(open: &[OpenChain], closing: &Closing<'_>) -> Vec<(f64, u32, u32)> {
    /// A tail seldom has more than one head near; a soup of loose triangles may have thousands.
    const NEAREST: usize = 8;
    let mut heads: Vec<(f64, f64, u32)> = open
        .iter()
        .enumerate()
        .filter_map(|(index, chain)| chain.points.first().map(|p| (p.x, p.y, index as u32)))
        .collect();
    heads.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let mut found = Vec::new();
    for (tail, chain) in open.iter().enumerate() {
        let Some(end) = chain.points.last() else { continue };
        let begin = heads.partition_point(|head| head.0 < end.x - closing.limit);
        let mut near: Vec<(f64, u32, u32)> = heads[begin..]
            .iter()
            .take_while(|head| head.0 <= end.x + closing.limit)
            .map(|&(x, y, head)| (end.distance(DVec2::new(x, y)), tail as u32, head))
            .filter(|&(gap, ..)| gap <= closing.limit)
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        near.truncate(NEAREST);
        if near.iter().all(|&(_, _, head)| head as usize != tail) {
            near.push((chain.gap(), tail as u32, tail as u32));
        }
        near.retain(|&(gap, _, head)| {
            closing.admits(gap, chain, &open[head as usize], head as usize == tail)
        });
        found.append(&mut near);
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    found
}
