//! An axis cut back to what is needed of it.

use crate::centring::centred;
use crate::chordal_axis::{AxisNode, ChordalAxis};
use crate::mitre::REACH;
use crate::spine::{CLEARANCE, LEAST_LENGTH, STEP};
use crate::thin::HALF_LANE;
use argil_curve::{Segment, SegmentIndex};
use glam::DVec2;
use std::collections::VecDeque;

/// Points farther than this from the boundary, in w, lie inside the wall, which was opened by 0.01 w.
const INSIDE_WALL: f64 = 0.511;

/// The wall may be farther than its distance from the boundary tells by this, in w. Slivers that were opened away are no wall: the spine runs
/// through them.
const BESIDE_WALL: f64 = 0.06;

/// Where a spine would close a ring round a hole together with the wall, it is left open by this, in w: the bead's
/// round ends meet, and there is one loop in place of two side by side.
const GAP: f64 = 0.3;

/// How far a spine runs on inside the wall, in w, so that the two are one region.
const OVERLAP: f64 = 0.06;

/// Rounds of smoothing, and how far they may move a node in all, in w.
const SMOOTHING: usize = 10;
const ASIDE: f64 = 0.05;

/// So near to where a spine ends in a wall, in w, it keeps its way: what it is to meet lies aside.
const MOUTH: f64 = 0.5;

/// What is left between a spine and the boundary, in w: half a lane, and what simplification and rounding take.
const LANE_CLEARANCE: f64 = HALF_LANE + 0.004;

/// An axis that is cut back from its ends as long as everything stays covered.
pub(crate) struct Pruning {
    axis: ChordalAxis,
    /// Whether the node is part of what is left.
    kept: Vec<bool>,
    /// Nodes inside the wall, where a spine ends.
    anchored: Vec<bool>,
    /// How far each node may be moved aside, mm, with both its lanes still in the outline.
    room: Vec<f64>,
    /// The bare points, as segments without length, and how many kept nodes reach each.
    bare: SegmentIndex,
    reached_by: Vec<u32>,
    width: f64,
}

impl Pruning {
    pub(crate) fn new(
        axis: ChordalAxis,
        points: &[DVec2],
        is_bare: &[bool],
        sides: &SegmentIndex,
        wall: &SegmentIndex,
        width: f64,
    ) -> Self {
        let count = axis.nodes.len();
        let depth: Vec<f64> = axis
            .nodes
            .iter()
            .map(|node| sides.nearest_within(node.at, width).map_or(width, |nearest| nearest.distance))
            .collect();
        let is_inside = |(node, &depth): (&AxisNode, &f64)| {
            let is_wall = || wall.is_within(node.at, depth - (0.5 - BESIDE_WALL) * width);
            !wall.is_empty() && (depth >= width || depth >= INSIDE_WALL * width && is_wall())
        };
        let anchored: Vec<bool> = axis.nodes.iter().zip(&depth).map(is_inside).collect();
        let mut kept = vec![false; count];
        let mut open: Vec<usize> = (0..count)
            .filter(|&k| {
                let beside = axis.nodes[k].chord.is_some_and(|chord| chord.iter().any(|&end| is_bare[end]));
                beside && !anchored[k]
            })
            .collect();
        while let Some(node) = open.pop() {
            if kept[node] || depth[node] < CLEARANCE * width {
                continue;
            }
            kept[node] = true;
            if !anchored[node] {
                open.extend(&axis.links[node]);
            }
        }
        let room =
            depth.iter().map(|depth| (depth - LANE_CLEARANCE * width).clamp(0.0, ASIDE * width)).collect();
        let bare = points.iter().zip(is_bare).filter(|(_, bare)| **bare).map(|(&p, _)| Segment::new(p, p));
        let bare = SegmentIndex::new(bare.collect(), width);
        let reached_by = vec![0; bare.segments().len()];
        let mut pruning = Self { axis, kept, anchored, room, bare, reached_by, width };
        for node in 0..count {
            if pruning.kept[node] {
                pruning.for_each_reached(node, |reached_by| *reached_by += 1);
            }
        }
        pruning.meet(wall, &depth);
        pruning
    }

    /// Moves the ends inside the wall to where the wall is nearest to the last node before it: chords across a
    /// wide part of the outline have their middles far from where the narrow part opens into it.
    fn meet(&mut self, wall: &SegmentIndex, depth: &[f64]) {
        for end in (0..self.axis.nodes.len()).filter(|&node| self.kept[node] && self.anchored[node]) {
            let Some(before) = self.neighbours(end).next() else { continue };
            let from = self.axis.nodes[before].at;
            let at = match wall.nearest_within(from, self.width) {
                Some(nearest) if depth[before] < 0.5 * self.width => {
                    let inwards = (nearest.point - from).normalize_or_zero();
                    nearest.point + inwards * (OVERLAP * self.width)
                }
                // It lies inside the wall itself, or within what the wall was opened by.
                _ => {
                    let onwards = self.axis.nodes[end].at - from;
                    from + onwards.clamp_length_max(3.0 * OVERLAP * self.width)
                }
            };
            self.axis.nodes[end].at = at;
        }
    }

    fn for_each_reached(&mut self, node: usize, mut visit: impl FnMut(&mut u32)) {
        let at = self.axis.nodes[node].at;
        let reach = REACH * self.width;
        let reached_by = &mut self.reached_by;
        self.bare.for_each_near(Segment::new(at, at), reach, |index, point| {
            if point.start.distance(at) <= reach {
                visit(&mut reached_by[index]);
            }
        });
    }

    /// The neighbours that are left; two nodes inside the wall need no line between them.
    fn neighbours(&self, node: usize) -> impl Iterator<Item = usize> + '_ {
        let open = move |&other: &usize| self.kept[other] && !(self.anchored[node] && self.anchored[other]);
        self.axis.links[node].iter().copied().filter(open)
    }

    /// What is left, as lines along the middle between the sides of the boundary.
    pub(crate) fn lines(mut self, sides: &SegmentIndex) -> Vec<Vec<DVec2>> {
        self.cut_back();
        self.smooth(sides);
        let mut chains = self.chains();
        let mut groups = self.walled_groups();
        // Short ones first: where a ring is cut, it is in the longest of its spines.
        let length = |chain: &Vec<usize>| -> f64 {
            chain
                .windows(2)
                .map(|link| self.axis.nodes[link[0]].at.distance(self.axis.nodes[link[1]].at))
                .sum()
        };
        chains.sort_by(|a, b| length(a).total_cmp(&length(b)));
        let mut lines = Vec::with_capacity(chains.len());
        for chain in chains {
            let line: Vec<DVec2> = chain.iter().map(|&node| self.axis.nodes[node].at).collect();
            let line = spaced(&line, STEP * self.width);
            let (Some(&first), Some(&last)) = (chain.first(), chain.last()) else { continue };
            if first == last || groups.join(first, last) {
                lines.push(line);
            } else {
                lines.extend(without_middle(&line, GAP * self.width));
            }
        }
        lines
    }

    /// Nodes in groups that are joined by the wall.
    fn walled_groups(&self) -> Groups {
        let mut groups = Groups { above: (0..self.axis.nodes.len()).collect() };
        for (node, links) in self.axis.links.iter().enumerate().filter(|(node, _)| self.anchored[*node]) {
            for &other in links.iter().filter(|&&other| self.anchored[other]) {
                groups.join(node, other);
            }
        }
        groups
    }

    /// Takes leaves away, oldest first, unless a bare point needs them or a piece without a wall would get
    /// too short.
    fn cut_back(&mut self) {
        let count = self.axis.nodes.len();
        let (piece_of, mut length, floats) = self.pieces();
        let mut leaves: VecDeque<usize> = (0..count).collect();
        while let Some(leaf) = leaves.pop_front() {
            if !self.kept[leaf] || self.anchored[leaf] {
                continue;
            }
            let mut around = self.neighbours(leaf);
            let (Some(next), None) = (around.next(), around.next()) else { continue };
            drop(around);
            let side = self.axis.nodes[leaf].at.distance(self.axis.nodes[next].at);
            let piece = piece_of[leaf];
            if floats[piece] && length[piece] - side < LEAST_LENGTH * self.width {
                continue;
            }
            let mut needed = false;
            self.for_each_reached(leaf, |reached_by| needed |= *reached_by == 1);
            if !needed {
                self.for_each_reached(leaf, |reached_by| *reached_by -= 1);
                self.kept[leaf] = false;
                length[piece] -= side;
                leaves.push_back(next);
            }
        }
        // A piece that has no length to begin with is no path.
        for (node, &piece) in piece_of.iter().enumerate() {
            if self.kept[node] && floats[piece] && length[piece] < LEAST_LENGTH * self.width {
                self.kept[node] = false;
            }
        }
    }

    /// For each node its connected piece, and for each piece its length and whether it touches no wall.
    fn pieces(&self) -> (Vec<usize>, Vec<f64>, Vec<bool>) {
        let mut piece_of = vec![usize::MAX; self.axis.nodes.len()];
        let (mut lengths, mut floats) = (Vec::new(), Vec::new());
        for first in 0..piece_of.len() {
            if !self.kept[first] || self.anchored[first] || piece_of[first] != usize::MAX {
                continue;
            }
            let piece = lengths.len();
            let (mut length, mut is_free) = (0.0, true);
            let mut open = vec![first];
            piece_of[first] = piece;
            while let Some(node) = open.pop() {
                for other in self.neighbours(node) {
                    let side = self.axis.nodes[node].at.distance(self.axis.nodes[other].at);
                    if self.anchored[other] {
                        is_free = false;
                        length += side;
                        continue;
                    }
                    length += 0.5 * side;
                    if piece_of[other] == usize::MAX {
                        piece_of[other] = piece;
                        open.push(other);
                    }
                }
            }
            lengths.push(length);
            floats.push(is_free);
        }
        // Nodes inside the wall belong to none of the pieces.
        lengths.push(0.0);
        floats.push(false);
        let none = lengths.len() - 1;
        piece_of.iter_mut().filter(|piece| **piece == usize::MAX).for_each(|piece| *piece = none);
        (piece_of, lengths, floats)
    }

    /// Takes out the zigzag of the chords by steps from the middle of the strip towards the neighbours' middle. Nodes stay near that place, so
    /// that bends are not cut.
    fn smooth(&mut self, sides: &SegmentIndex) {
        let is_end = |&node: &usize| self.kept[node] && self.anchored[node];
        let ends = (0..self.axis.nodes.len()).filter(is_end).map(|node| self.axis.nodes[node].at);
        let ends = SegmentIndex::new(ends.map(|at| Segment::new(at, at)).collect(), self.width);
        let inner: Vec<(usize, [usize; 2], DVec2)> = (0..self.axis.nodes.len())
            .filter(|&node| self.kept[node] && !self.anchored[node])
            .filter_map(|node| {
                let mut around = self.neighbours(node);
                match (around.next(), around.next(), around.next()) {
                    (Some(a), Some(b), None) => {
                        let at = self.axis.nodes[node].at;
                        let is_mouth = ends.is_within(at, MOUTH * self.width);
                        Some((node, [a, b], if is_mouth { at } else { centred(at, sides, self.width) }))
                    }
                    _ => None,
                }
            })
            .collect();
        for &(node, _, middle) in &inner {
            self.axis.nodes[node].at = middle;
        }
        let mut moved = Vec::with_capacity(inner.len());
        for _ in 0..SMOOTHING {
            moved.clear();
            moved.extend(inner.iter().map(|&(node, [a, b], place)| {
                let [here, a, b] = [node, a, b].map(|node| self.axis.nodes[node].at);
                let wanted = here.midpoint(a.midpoint(b));
                place + (wanted - place).clamp_length_max(self.room[node])
            }));
            for (&(node, ..), &at) in inner.iter().zip(&moved) {
                self.axis.nodes[node].at = at;
            }
        }
    }

    /// The links that are left, as lines from branching to branching; closed ones end where they begin.
    fn chains(&self) -> Vec<Vec<usize>> {
        let count = self.axis.nodes.len();
        let degree: Vec<usize> =
            (0..count).map(|k| if self.kept[k] { self.neighbours(k).count() } else { 0 }).collect();
        let is_end = |node: usize| degree[node] != 2 || self.anchored[node];
        let mut passed = vec![false; count];
        let mut lines = Vec::new();
        let ends = (0..count).filter(|&k| degree[k] > 0 && is_end(k));
        let rest = (0..count).filter(|&k| degree[k] > 0 && !is_end(k));
        for first in ends.chain(rest) {
            if passed[first] {
                continue;
            }
            for second in self.neighbours(first) {
                // Links between two ends are taken from the lower one.
                if passed[second] || (is_end(second) && second < first) {
                    continue;
                }
                let mut line = vec![first];
                let (mut before, mut here) = (first, second);
                while !is_end(here) && here != first {
                    passed[here] = true;
                    line.push(here);
                    let onwards = self.neighbours(here).find(|&node| node != before);
                    (before, here) = (here, onwards.unwrap_or(first));
                }
                line.push(here);
                lines.push(line);
                if !is_end(first) {
                    passed[first] = true;
                    break;
                }
            }
        }
        lines
    }
}

/// Disjoint sets of nodes.
struct Groups {
    above: Vec<usize>,
}

impl Groups {
    fn root(&mut self, mut node: usize) -> usize {
        while self.above[node] != node {
            self.above[node] = self.above[self.above[node]];
            node = self.above[node];
        }
        node
    }

    /// Whether they were apart.
    fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.above[a.max(b)] = a.min(b);
        a != b
    }
}

/// The two ends of a line whose middle is taken out.
fn without_middle(line: &[DVec2], gap: f64) -> Vec<Vec<DVec2>> {
    let half = 0.5 * (line.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>() - gap);
    let beginning = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut kept: Vec<DVec2> = points.next().into_iter().collect();
        let mut left = half;
        for (k, to) in points.enumerate() {
            let from = kept[k];
            let side = from.distance(to);
            if side >= left {
                kept.push(from.lerp(to, left / side.max(f64::MIN_POSITIVE)));
                break;
            }
            left -= side;
            kept.push(to);
        }
        kept
    };
    if half <= 0.0 {
        return Vec::new();
    }
    vec![beginning(&mut line.iter().copied()), beginning(&mut line.iter().rev().copied())]
}

/// The line without the points that are nearer than `step` to the last; both ends stay.
fn spaced(line: &[DVec2], step: f64) -> Vec<DVec2> {
    let Some((&last, rest)) = line.split_last() else { return Vec::new() };
    let mut kept: Vec<DVec2> = Vec::with_capacity(line.len());
    for &p in rest {
        if kept.last().is_none_or(|before| before.distance(p) >= step) {
            kept.push(p);
        }
    }
    while kept.len() > 1 && kept[kept.len() - 1].distance(last) < 0.5 * step {
        kept.pop();
    }
    kept.push(last);
    kept
}
