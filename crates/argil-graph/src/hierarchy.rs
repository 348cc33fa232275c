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
use crate::elimination::{eliminate, in_postorder};

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
        let (eliminated, links) = eliminate(graph);
        let order = in_postorder(&eliminated, &links);

        let mut rank_of = vec![0; count];
        let mut vertex_of: Vec<u32> = (0..count as u32).filter(|&v| graph.is_attachment(v)).collect();
        let attachment_count = vertex_of.len();
        for (&v, rank) in order.iter().zip(attachment_count as u32..) {
            rank_of[v as usize] = rank;
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
        vertex_of.extend(&order);

        let total = order.iter().map(|&v| links.len(v)).sum::<usize>();
        let mut offsets = Vec::with_capacity(count + 1);
        offsets.push(0);
        let mut to: Vec<u32> = Vec::with_capacity(total);
        let mut weights = Vec::new();
        for &vertex in &vertex_of[..attachment_count] {
            let mut open: Vec<(u32, f64)> =
                graph.neighbours(vertex).filter(|&(u, _)| !graph.is_attachment(u)).collect();
            open.iter_mut().for_each(|(u, _)| *u = rank_of[*u as usize]);
            open.sort_unstable_by_key(|link| link.0);
            to.extend(open.iter().map(|link| link.0));
            weights.extend(open.iter().map(|link| link.1));
            offsets.push(to.len() as u32);
        }
        for &v in &order {
            let start = to.len();
            to.extend(links.of(v).iter().map(|&u| rank_of[u as usize]));
            to[start..].sort_unstable();
            offsets.push(to.len() as u32);
        }
        drop(links);
        weights.resize(to.len(), f64::INFINITY);
        let middles = vec![Self::NO_MIDDLE; to.len()];
        let mut hierarchy = Hierarchy { rank_of, vertex_of, attachment_count, offsets, to, weights, middles };
        hierarchy.weigh(graph, &eliminated);
        hierarchy
    }

    /// Gives every link of the eliminated vertices its weight, rank by rank: that of the edge, if there is one, or the least
    /// of the ways through what was eliminated before. Of equal ones the edge counts, or what was eliminated first.
    ///
    /// Every rank takes from all that link to it, which it finds in a list of its own: once it is done, each of them goes
    /// on to the list of the next rank that it links to.
    fn weigh(&mut self, graph: &PathGraph, eliminated: &[u32]) {
        let count = self.len();
        let mut turn = vec![0_u32; count];
        for (&v, place) in eliminated.iter().zip(0..) {
            turn[self.rank_of[v as usize] as usize] = place;
        }
        // Per rank the first that links to it and is waiting there; per waiting rank the next one, and which link it is at.
        let mut first = vec![Self::NO_MIDDLE; count];
        let mut next = vec![Self::NO_MIDDLE; count];
        let mut at = vec![0_u32; count];
        // Where among the links of the rank under work the link to another one is.
        let mut slot = vec![0_u32; count];
        for rank in self.attachment_count..count {
            let (start, end) = (self.offsets[rank] as usize, self.offsets[rank + 1] as usize);
            for (&to, place) in self.to[start..end].iter().zip(0..) {
                slot[to as usize] = place;
            }
            let (done, own) = self.weights.split_at_mut(start);
            let middles = &mut self.middles[start..];
            for (u, weight) in graph.neighbours(self.vertex_of[rank]) {
                let to = self.rank_of[u as usize];
                if to as usize > rank {
                    own[slot[to as usize] as usize] = weight;
                }
            }
            let mut waiting = std::mem::replace(&mut first[rank], Self::NO_MIDDLE);
            while waiting != Self::NO_MIDDLE {
                let below = waiting;
                waiting = next[below as usize];
                let here = at[below as usize] as usize;
                let last = self.offsets[below as usize + 1] as usize;
                let up = done[here];
                for (&to, &on) in self.to[here + 1..last].iter().zip(&done[here + 1..last]) {
                    let through = up + on;
                    let place = slot[to as usize] as usize;
                    let (least, middle) = (&mut own[place], &mut middles[place]);
                    let sooner =
                        || *middle != Self::NO_MIDDLE && turn[below as usize] < turn[*middle as usize];
                    if through < *least || (through == *least && sooner()) {
                        (*least, *middle) = (through, below);
                    }
                }
                if here + 1 < last {
                    at[below as usize] += 1;
                    let to = self.to[here + 1] as usize;
                    next[below as usize] = std::mem::replace(&mut first[to], below);
                }
            }
            if start < end {
                at[rank] = start as u32;
                let to = self.to[start] as usize;
                next[rank] = std::mem::replace(&mut first[to], rank as u32);
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
