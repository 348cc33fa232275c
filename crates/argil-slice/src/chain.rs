use crate::section::Cut;
use glam::DVec2;

const NONE: u32 = u32::MAX;

/// A chain of cuts whose ends do not meet: the mesh has a hole there.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OpenChain {
    pub(crate) points: Vec<DVec2>,
}

impl OpenChain {
    pub(crate) fn gap(&self) -> f64 {
        match (self.points.first(), self.points.last()) {
            (Some(first), Some(last)) => first.distance(*last),
            _ => 0.0,
        }
    }

    pub(crate) fn length(&self) -> f64 {
        self.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }
}

/// Links cuts at the mesh edges that they share. The tables are as long as the mesh has edges
/// and are cleaned after each layer by what was touched, so that a layer costs its cuts.
pub(crate) struct Linker {
    /// First cut that begins on each edge.
    first: Vec<u32>,
    /// Cuts that begin less cuts that end on each edge.
    balance: Vec<i32>,
    /// Next cut that begins on the same edge.
    next: Vec<u32>,
}

impl Linker {
    pub(crate) fn new(edge_count: usize) -> Self {
        Self { first: vec![NONE; edge_count], balance: vec![0; edge_count], next: Vec::new() }
    }

    /// The closed contours of a cut, and the chains that do not close.
    ///
    /// Where more than two triangles share an edge, several chains meet. They may be linked
    /// in any way: winding numbers depend only on which pieces there are.
    pub(crate) fn link(&mut self, cuts: &[Cut]) -> (Vec<Vec<DVec2>>, Vec<OpenChain>) {
        self.next.clear();
        self.next.resize(cuts.len(), NONE);
        for (index, cut) in cuts.iter().enumerate().rev() {
            self.next[index] = self.first[cut.start as usize];
            self.first[cut.start as usize] = index as u32;
            self.balance[cut.start as usize] += 1;
            self.balance[cut.end as usize] -= 1;
        }
        let mut open = Vec::new();
        for cut in cuts {
            // More cuts begin here than end: a chain has to begin here.
            while self.balance[cut.start as usize] > 0 {
                self.balance[cut.start as usize] -= 1;
                let points = self.follow(cuts, cut.start, NONE);
                open.push(OpenChain { points });
            }
        }
        let mut closed = Vec::new();
        for cut in cuts {
            while self.first[cut.start as usize] != NONE {
                let mut points = self.follow(cuts, cut.start, cut.start);
                if points.first() == points.last() {
                    points.pop();
                }
                closed.push(points);
            }
        }
        for cut in cuts {
            for edge in [cut.start, cut.end] {
                self.first[edge as usize] = NONE;
                self.balance[edge as usize] = 0;
            }
        }
        (closed, open)
    }

    /// Takes unused cuts from an edge on until the stop edge is reached or no cut goes on.
    fn follow(&mut self, cuts: &[Cut], start: u32, stop: u32) -> Vec<DVec2> {
        let mut points: Vec<DVec2> = Vec::new();
        let mut edge = start;
        while let Some(cut) = cuts.get(self.first[edge as usize] as usize) {
            self.first[edge as usize] = self.next[self.first[edge as usize] as usize];
            for point in [cut.from, cut.to] {
                // Cuts through a vertex of the mesh have no length.
                if points.last() != Some(&point) {
                    points.push(point);
                }
            }
            edge = cut.end;
            if edge == stop {
                break;
            }
        }
        points
    }
}

/// Joins the ends of open chains over gaps up to `limit`, the narrowest gap first, and returns the contours
/// that close; what stays open is left in `open`.
///
/// A chain is closed upon itself only if its gap is less than half its length: otherwise the area
/// that it would enclose is a guess.
///
/// # Complexity
/// Each end looks at the ends within the limit along x only; the few nearest are candidates.
pub(crate) fn close_gaps(open: &mut Vec<OpenChain>, limit: f64) -> Vec<Vec<DVec2>> {
    let mut closed = Vec::new();
    loop {
        let joints = joints(open, limit);
        let mut follower = vec![NONE; open.len()];
        let mut has_leader = vec![false; open.len()];
        for &(_, tail, head) in &joints {
            if follower[tail as usize] == NONE && !has_leader[head as usize] {
                follower[tail as usize] = head;
                has_leader[head as usize] = true;
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
                closed.push(points);
            } else {
                left.push(OpenChain { points });
            }
        }
        *open = left;
    }
}

/// Gaps that may be closed as (gap, chain that ends, chain that begins), narrowest first.
fn joints(open: &[OpenChain], limit: f64) -> Vec<(f64, u32, u32)> {
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
        let begin = heads.partition_point(|head| head.0 < end.x - limit);
        let mut near: Vec<(f64, u32, u32)> = heads[begin..]
            .iter()
            .take_while(|head| head.0 <= end.x + limit)
            .map(|&(x, y, head)| (end.distance(DVec2::new(x, y)), tail as u32, head))
            .filter(|&(gap, _, head)| gap <= limit && (head as usize != tail || gap <= 0.5 * chain.length()))
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        near.truncate(NEAREST);
        found.append(&mut near);
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    found
}
