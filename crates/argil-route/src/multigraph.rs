//! The plane multigraph of a layer: walls as cycles, tour edges drawn as graph paths.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use argil_curve::DVec2;

use crate::cycle::Leg;

/// An edge between two vertices, drawn straight or (a wall's arc) through the points of `via`.
#[derive(Clone, Debug)]
pub(crate) struct Edge {
    pub(crate) ends: [u32; 2],
    pub(crate) via: Vec<DVec2>,
    pub(crate) leg: Leg,
    /// 0 or 1: which of two parallel copies this is. Copies lie side by side, copy 0 first when one turns
    /// counter-clockwise at `ends[0]`.
    copy: u8,
}

/// An end of an edge. Edge e has the ends 2e (at `ends[0]`) and 2e + 1 (at `ends[1]`).
pub(crate) type EdgeEnd = usize;

/// The other end of the same edge.
pub(crate) fn opposite(end: EdgeEnd) -> EdgeEnd {
    end ^ 1
}

/// Vertices and edges of everything that the strand of a layer walks.
#[derive(Debug, Default)]
pub(crate) struct Multigraph {
    pub(crate) positions: Vec<DVec2>,
    /// The demand that a vertex carries, if any.
    pub(crate) demand: Vec<Option<usize>>,
    pub(crate) edges: Vec<Edge>,
    /// Uses of each straight edge so far, by its ends in rising order.
    uses: BTreeMap<(u32, u32), (usize, Leg)>,
}

impl Multigraph {
    /// A new vertex.
    pub(crate) fn vertex(&mut self, at: DVec2, demand: Option<usize>) -> u32 {
        self.positions.push(at);
        self.demand.push(demand);
        (self.positions.len() - 1) as u32
    }

    /// Walks the straight edge a–b once more.
    pub(crate) fn walk(&mut self, a: u32, b: u32, leg: Leg) {
        let entry = self.uses.entry((a.min(b), a.max(b))).or_insert((0, leg));
        entry.0 += 1;
        if leg == Leg::Support {
            entry.1 = leg;
        }
    }

    /// Adds a piece of wall from a to b.
    pub(crate) fn wall(&mut self, a: u32, b: u32, via: Vec<DVec2>) {
        self.edges.push(Edge { ends: [a, b], via, leg: Leg::Wall, copy: 0 });
    }

    /// Turns the walks into edges: once where the number of uses is odd, twice where it is even. The parity at every
    /// vertex and what hangs together stay as they were.
    pub(crate) fn settle(&mut self) {
        for (&(a, b), &(uses, leg)) in &self.uses {
            for copy in 0..(2 - uses % 2) as u8 {
                self.edges.push(Edge { ends: [a, b], via: Vec::new(), leg, copy });
            }
        }
        self.uses.clear();
        self.drop_needless_doubles();
    }

    /// Takes doubled edges out, longest first, wherever all still hangs together without them: two passes
    /// that lead nowhere new.
    fn drop_needless_doubles(&mut self) {
        let mut doubled: Vec<usize> = (1..self.edges.len()).filter(|&e| self.edges[e].copy == 1).collect();
        let length = |e: usize| {
            let [a, b] = self.edges[e].ends;
            self.positions[a as usize].distance(self.positions[b as usize])
        };
        doubled.sort_by(|&p, &q| length(q).total_cmp(&length(p)).then(p.cmp(&q)));
        let mut dropped = vec![false; self.edges.len()];
        for e in doubled {
            dropped[e] = true;
            dropped[e - 1] = true;
            let [a, b] = self.edges[e].ends;
            let mut parts = Partition::new(self.positions.len());
            for (k, edge) in self.edges.iter().enumerate() {
                if !dropped[k] {
                    parts.join(edge.ends[0] as usize, edge.ends[1] as usize);
                }
            }
            if parts.find(a as usize) != parts.find(b as usize) {
                dropped[e] = false;
                dropped[e - 1] = false;
            }
        }
        let mut keep = dropped.iter().map(|d| !d);
        self.edges.retain(|_| keep.next().unwrap_or(true));
    }

    /// The vertex at an end.
    pub(crate) fn vertex_at(&self, end: EdgeEnd) -> u32 {
        self.edges[end / 2].ends[end % 2]
    }

    /// The point towards which an edge leaves at one of its ends.
    pub(crate) fn heading(&self, end: EdgeEnd) -> DVec2 {
        let edge = &self.edges[end / 2];
        let via = if end.is_multiple_of(2) { edge.via.first() } else { edge.via.last() };
        via.copied().unwrap_or(self.positions[edge.ends[1 - end % 2] as usize])
    }

    /// Whether the end belongs to a wall.
    pub(crate) fn is_wall(&self, end: EdgeEnd) -> bool {
        self.edges[end / 2].leg == Leg::Wall
    }

    /// The ends at every vertex in counter-clockwise order.
    pub(crate) fn rotations(&self) -> Vec<Vec<EdgeEnd>> {
        let mut round = vec![Vec::new(); self.positions.len()];
        for end in 0..2 * self.edges.len() {
            round[self.vertex_at(end) as usize].push(end);
        }
        for (vertex, ends) in round.iter_mut().enumerate() {
            let centre = self.positions[vertex];
            ends.sort_by(|&a, &b| {
                by_angle(centre, self.heading(a), self.heading(b))
                    .then_with(|| self.rank(a).cmp(&self.rank(b)))
            });
        }
        round
    }

    /// Order of parallel copies round a vertex.
    fn rank(&self, end: EdgeEnd) -> (i32, usize) {
        let copy = i32::from(self.edges[end / 2].copy);
        (if end.is_multiple_of(2) { copy } else { -copy }, end)
    }
}

/// Compares two directions from `centre` by their angle from the positive x axis, exactly.
fn by_angle(centre: DVec2, a: DVec2, b: DVec2) -> Ordering {
    let lower = |p: DVec2| p.y < centre.y || (p.y == centre.y && p.x < centre.x);
    lower(a).cmp(&lower(b)).then_with(|| {
        let turn = robust::orient2d(coord(centre), coord(a), coord(b));
        0.0_f64.partial_cmp(&turn).unwrap_or(Ordering::Equal)
    })
}

fn coord(p: DVec2) -> robust::Coord<f64> {
    robust::Coord { x: p.x, y: p.y }
}

/// A partition of 0..n that only ever grows coarser.
#[derive(Debug)]
pub(crate) struct Partition {
    parent: Vec<u32>,
}

impl Partition {
    pub(crate) fn new(n: usize) -> Self {
        Self { parent: (0..n as u32).collect() }
    }

    pub(crate) fn find(&mut self, mut x: usize) -> usize {
        while self.parent[x] as usize != x {
            self.parent[x] = self.parent[self.parent[x] as usize];
            x = self.parent[x] as usize;
        }
        x
    }

    /// Joins the parts of a and b; false if they were one part already.
    pub(crate) fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b)] = a.min(b) as u32;
        a != b
    }
}
