//! Elimination of the vertices one after the other, which leaves the searches no choice but upwards.
//!
//! Eliminating a vertex joins its remaining neighbours pairwise by shortcuts as long as the way through it
//! (or keeps what is shorter): Cholesky factorisation with (min, +) for (+, ×), or a contraction hierarchy
//! without witness searches, see Dibbelt, Strasser and Wagner, *Customizable Contraction Hierarchies*,
//! <https://doi.org/10.1145/2886843>. Afterwards every pair of vertices has a shortest path that first climbs
//! in the order of elimination and then descends. On plane graphs minimum degree keeps the climbs short.
//!
//! Attachments come first and leave no shortcuts: a shortcut is a path through, which they forbid.

use crate::PathGraph;
use crate::elimination::Elimination;

/// The graph with its shortcuts. Vertices go by their *rank*, their place in the order of elimination.
#[derive(Clone, Debug)]
pub(crate) struct Hierarchy {
    rank_of: Vec<u32>,
    vertex_of: Vec<u32>,
    /// Ranks below this one are attachments.
    attachment_count: usize,
    /// The links of rank `r` are the slots `offsets[r]..offsets[r + 1]`, in ascending order of `to`.
    offsets: Vec<u32>,
    to: Vec<u32>,
    weights: Vec<f64>,
    middles: Vec<u32>,
}

impl Hierarchy {
    /// The middle of a link that is an edge of the graph and no shortcut.
    pub(crate) const NO_MIDDLE: u32 = u32::MAX;

    /// Eliminates all vertices, those with the fewest remaining neighbours first.
    ///
    /// # Complexity
    /// O(Σ d²) for the degrees d at elimination: O(V √V) or better on plane graphs of even density.
    pub(crate) fn new(graph: &PathGraph) -> Hierarchy {
        let count = graph.vertex_count();
        let eliminated = Elimination::new(graph);
        let turns = eliminated.in_postorder(count);

        let mut rank_of = vec![0; count];
        let mut vertex_of: Vec<u32> = (0..count as u32).filter(|&v| graph.is_attachment(v)).collect();
        let attachment_count = vertex_of.len();
        for (&turn, rank) in turns.iter().zip(attachment_count as u32..) {
            rank_of[eliminated.vertex(turn) as usize] = rank;
        }
        // Attachments side by side in the plane become neighbours in rank: a sweep over a few of them then
        // climbs through few vertices.
        let lowest_neighbour = |v: u32| {
            let open = graph.neighbours(v).filter(|&(u, _)| !graph.is_attachment(u));
            open.map(|(u, _)| rank_of[u as usize]).min()
        };
        vertex_of.sort_by_cached_key(|&v| lowest_neighbour(v));
        for (&v, rank) in vertex_of.iter().zip(0..) {
            rank_of[v as usize] = rank;
        }
        vertex_of.extend(turns.iter().map(|&turn| eliminated.vertex(turn)));

        let mut offsets = Vec::with_capacity(count + 1);
        offsets.push(0);
        let mut to: Vec<u32> = Vec::with_capacity(eliminated.link_count() + 4 * attachment_count);
        let mut weights = Vec::new();
        let mut open: Vec<(u32, f64)> = Vec::new();
        for &vertex in &vertex_of[..attachment_count] {
            open.clear();
            open.extend(graph.neighbours(vertex).filter(|&(u, _)| !graph.is_attachment(u)));
            open.iter_mut().for_each(|(u, _)| *u = rank_of[*u as usize]);
            open.sort_unstable_by_key(|link| link.0);
            to.extend(open.iter().map(|link| link.0));
            weights.extend(open.iter().map(|link| link.1));
            offsets.push(to.len() as u32);
        }
        for &turn in &turns {
            to.extend(eliminated.links(turn).iter().map(|&u| rank_of[u as usize]));
            offsets.push(to.len() as u32);
        }
        weights.resize(to.len(), f64::INFINITY);
        let middles = vec![Self::NO_MIDDLE; to.len()];
        let mut hierarchy = Hierarchy { rank_of, vertex_of, attachment_count, offsets, to, weights, middles };
        let below = hierarchy.sort_links();
        hierarchy.weigh(graph, &below);
        hierarchy
    }

    /// Puts the links of the eliminated vertices in ascending order, and gives which of them link to each rank, ascending as well.
    fn sort_links(&mut self) -> Below {
        let first = self.attachment_count;
        let mut below = Below { offsets: vec![0; self.len() + 1], ranks: Vec::new() };
        let links = self.offsets[first] as usize..self.to.len();
        for &to in &self.to[links.clone()] {
            below.offsets[to as usize + 1] += 1;
        }
        for rank in 0..self.len() {
            below.offsets[rank + 1] += below.offsets[rank];
        }
        below.ranks.resize(links.len(), 0);
        let mut end = below.offsets.clone();
        for rank in first..self.len() {
            for &to in &self.to[self.offsets[rank] as usize..self.offsets[rank + 1] as usize] {
                below.ranks[end[to as usize] as usize] = rank as u32;
                end[to as usize] += 1;
            }
        }
        end.copy_from_slice(&self.offsets);
        for to in first..self.len() {
            for &rank in below.of(to) {
                self.to[end[rank as usize] as usize] = to as u32;
                end[rank as usize] += 1;
            }
        }
        below
    }

    /// Gives every link of the eliminated vertices its weight, rank by rank: that of the edge, if there is one, or the least
    /// of the ways through what was eliminated before. Of equal ones the edge counts, or the lowest rank.
    fn weigh(&mut self, graph: &PathGraph, below: &Below) {
        let count = self.len();
        // Which of its links each rank is at: those to ranks that are done are behind it.
        let mut at = self.offsets.clone();
        // Where among the links of the rank under work the link to another one is.
        let mut slot = vec![0_u32; count];
        for rank in self.attachment_count..count {
            let (start, end) = (self.offsets[rank] as usize, self.offsets[rank + 1] as usize);
            for (&to, place) in self.to[start..end].iter().zip(0..) {
                slot[to as usize] = place;
            }
            let (done, own) = self.weights.split_at_mut(start);
            let middles = &mut self.middles[start..end];
            for (u, weight) in graph.neighbours(self.vertex_of[rank]) {
                let to = self.rank_of[u as usize];
                if to as usize > rank {
                    own[slot[to as usize] as usize] = weight;
                }
            }
            for &lower in below.of(rank) {
                let here = at[lower as usize] as usize;
                at[lower as usize] += 1;
                let last = self.offsets[lower as usize + 1] as usize;
                let up = done[here];
                for (&to, &on) in self.to[here + 1..last].iter().zip(&done[here + 1..last]) {
                    let through = up + on;
                    let place = slot[to as usize] as usize;
                    if through < own[place] {
                        (own[place], middles[place]) = (through, lower);
                    }
                }
            }
        }
    }

    /// The rank of a vertex, if it exists.
    pub(crate) fn rank(&self, vertex: u32) -> Option<u32> {
        self.rank_of.get(vertex as usize).copied()
    }

    /// The vertex of a rank.
    pub(crate) fn vertex(&self, rank: u32) -> u32 {
        self.vertex_of[rank as usize]
    }

    /// How many ranks there are.
    pub(crate) fn len(&self) -> usize {
        self.vertex_of.len()
    }

    /// The links of a rank, as ranks above it and the weights of the links.
    #[inline]
    pub(crate) fn links(&self, rank: u32) -> (&[u32], &[f64]) {
        let slots = self.offsets[rank as usize] as usize..self.offsets[rank as usize + 1] as usize;
        (&self.to[slots.clone()], &self.weights[slots])
    }

    /// Whether the vertex of a rank is an attachment.
    pub(crate) fn is_attachment(&self, rank: u32) -> bool {
        (rank as usize) < self.attachment_count
    }

    /// The lowest rank that links lead to, if any do.
    #[inline]
    pub(crate) fn parent(&self, rank: u32) -> Option<u32> {
        self.links(rank).0.first().copied()
    }

    /// The rank, which is no attachment's, and all above it, ascending.
    pub(crate) fn ancestors(&self, rank: u32) -> impl Iterator<Item = u32> + '_ {
        std::iter::successors(Some(rank), |&rank| self.parent(rank))
    }

    /// What the link between two ranks leads through; none if it is an edge.
    pub(crate) fn middle(&self, a: u32, b: u32) -> Option<u32> {
        let (low, high) = (a.min(b), a.max(b));
        let start = self.offsets[low as usize] as usize;
        let found = self.links(low).0.binary_search(&high).ok()?;
        let middle = self.middles[start + found];
        (middle != Self::NO_MIDDLE).then_some(middle)
    }

    /// Visits the rank and everything that links lead to from there, unless `visit` says that it has been
    /// there before by returning false.
    ///
    /// The later neighbours of an eliminated vertex are joined pairwise, so all lie on the path of first
    /// links: following that one path visits them all. Only an attachment, which leaves no shortcuts, may
    /// begin several paths.
    pub(crate) fn climb(&self, rank: u32, mut visit: impl FnMut(u32) -> bool) {
        let mut follow = |mut rank: u32| {
            while visit(rank) {
                match self.parent(rank) {
                    Some(next) => rank = next,
                    None => break,
                }
            }
        };
        if self.is_attachment(rank) {
            for &next in self.links(rank).0 {
                follow(next);
            }
            visit(rank);
        } else {
            follow(rank);
        }
    }
}

/// Of each rank those that have it among their links.
struct Below {
    offsets: Vec<u32>,
    ranks: Vec<u32>,
}

impl Below {
    fn of(&self, rank: usize) -> &[u32] {
        &self.ranks[self.offsets[rank] as usize..self.offsets[rank + 1] as usize]
    }
}
