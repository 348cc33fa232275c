//! In which order the vertices are eliminated, and what each is then linked to.
//!
//! This looks at no lengths: the same order serves a graph whatever its edges weigh. While there are many vertices each has
//! few neighbours, which are kept as [lists](crate::lists); the last thousand have many, which are kept as [bits](crate::bits).

use crate::PathGraph;
use crate::bits::Bits;
use crate::lists::Lists;

/// With this many vertices left, their neighbours become bits: 128 kB of them.
const MOST_BITS: usize = 1024;

/// The vertices that are no attachments in the order of their elimination, those with the fewest remaining neighbours
/// first, and the later neighbours that each then has. A vertex's place in the order is its *turn*.
#[derive(Debug)]
pub(crate) struct Elimination {
    order: Vec<u32>,
    /// The later neighbours of a turn are `links[offsets[turn]..offsets[turn + 1]]`.
    offsets: Vec<u32>,
    links: Vec<u32>,
}

impl Elimination {
    /// # Complexity
    /// O(Σ d²) for the degrees d at elimination: O(V √V) or better on plane graphs of even density.
    pub(crate) fn new(graph: &PathGraph) -> Elimination {
        let count = graph.vertex_count();
        let is_open = |v: &u32| !graph.is_attachment(*v);
        let open = |v: u32| graph.neighbours(v).map(|(u, _)| u).filter(is_open);
        let vertices: Vec<u32> = (0..count as u32).filter(is_open).collect();
        let mut done = Elimination {
            order: Vec::with_capacity(vertices.len()),
            offsets: Vec::with_capacity(vertices.len() + 1),
            links: Vec::with_capacity(8 * vertices.len()),
        };
        done.offsets.push(0);
        if vertices.len() <= MOST_BITS {
            Bits::new(&vertices, count, open).eliminate(&mut done);
        } else {
            let mut lists = Lists::new(&vertices, count, open);
            let left = lists.eliminate(&mut done, MOST_BITS);
            Bits::new(&left, count, |v| lists.of(v).iter().copied()).eliminate(&mut done);
        }
        done
    }

    /// The vertex goes next, with these neighbours left.
    #[inline(always)]
    pub(crate) fn push(&mut self, vertex: u32, neighbours: impl Iterator<Item = u32>) {
        self.order.push(vertex);
        self.links.extend(neighbours);
        self.offsets.push(self.links.len() as u32);
    }

    /// How many vertices there are.
    pub(crate) fn len(&self) -> usize {
        self.order.len()
    }

    /// How many links they have together.
    pub(crate) fn link_count(&self) -> usize {
        self.links.len()
    }

    /// The vertex of a turn.
    pub(crate) fn vertex(&self, turn: u32) -> u32 {
        self.order[turn as usize]
    }

    /// The later neighbours of the vertex of a turn.
    pub(crate) fn links(&self, turn: u32) -> &[u32] {
        &self.links[self.offsets[turn as usize] as usize..self.offsets[turn as usize + 1] as usize]
    }

    /// The turns of the same elimination in another order with the same links: every vertex right after the vertices that
    /// have it as their first later neighbour. Ranks that are close then share most of their way up.
    pub(crate) fn in_postorder(&self, vertex_count: usize) -> Vec<u32> {
        const NONE: u32 = u32::MAX;
        let mut turn_of = vec![NONE; vertex_count];
        for (&v, turn) in self.order.iter().zip(0..) {
            turn_of[v as usize] = turn;
        }
        // The children of every turn as a chain, the earliest first.
        let mut first_child = vec![NONE; self.len()];
        let mut next_sibling = vec![NONE; self.len()];
        let mut stack: Vec<u32> = Vec::new();
        for turn in (0..self.len() as u32).rev() {
            match self.links(turn).iter().map(|&to| turn_of[to as usize]).min() {
                Some(parent) => {
                    next_sibling[turn as usize] = std::mem::replace(&mut first_child[parent as usize], turn);
                }
                None => stack.push(turn),
            }
        }
        stack.reverse();
        // Parents before their children, then reversed.
        let mut turns = Vec::with_capacity(self.len());
        while let Some(turn) = stack.pop() {
            turns.push(turn);
            let mut child = first_child[turn as usize];
            while child != NONE {
                stack.push(child);
                child = next_sibling[child as usize];
            }
        }
        turns.reverse();
        turns
    }
}
