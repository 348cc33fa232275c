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

/// An edge or shortcut to a vertex that is eliminated later.
#[derive(Clone, Copy, Debug)]
struct Link {
    to: u32,
    /// The eliminated vertex that a shortcut leads through, or [`Hierarchy::NO_MIDDLE`] for an edge.
    middle: u32,
    weight: f64,
}

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
        let (order, links) = eliminate(graph);
        let order = in_postorder(&order, &links);

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

        let total = order.iter().map(|&v| links.len(v)).sum::<usize>() + graph.edge_count();
        let mut offsets = Vec::with_capacity(count + 1);
        offsets.push(0);
        let mut hierarchy = Hierarchy {
            rank_of,
            vertex_of,
            attachment_count,
            offsets,
            to: Vec::with_capacity(total),
            weights: Vec::with_capacity(total),
            middles: Vec::with_capacity(total),
        };
        let mut own = Vec::new();
        for rank in 0..attachment_count {
            let vertex = hierarchy.vertex_of[rank];
            let open = graph.neighbours(vertex).filter(|&(u, _)| !graph.is_attachment(u));
            own.clear();
            own.extend(open.map(|(to, weight)| Link { to, middle: Self::NO_MIDDLE, weight }));
            hierarchy.push(&mut own);
        }
        for v in order {
            own.clear();
            own.extend_from_slice(links.of(v));
            hierarchy.push(&mut own);
        }
        hierarchy
    }

    fn push(&mut self, links: &mut [Link]) {
        for link in &mut *links {
            link.to = self.rank_of[link.to as usize];
            if link.middle != Self::NO_MIDDLE {
                link.middle = self.rank_of[link.middle as usize];
            }
        }
        links.sort_unstable_by_key(|link| link.to);
        self.to.extend(links.iter().map(|link| link.to));
        self.weights.extend(links.iter().map(|link| link.weight));
        self.middles.extend(links.iter().map(|link| link.middle));
        self.offsets.push(self.to.len() as u32);
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

/// The links of all vertices one after the other. A list that outgrows its room moves to the end, so that
/// nothing is allocated for a single vertex.
#[derive(Clone, Debug, Default)]
struct LinkLists {
    links: Vec<Link>,
    /// Start, length and room of each list.
    spans: Vec<(u32, u32, u32)>,
}

impl LinkLists {
    fn of(&self, v: u32) -> &[Link] {
        let (start, length, _) = self.spans[v as usize];
        &self.links[start as usize..(start + length) as usize]
    }

    fn len(&self, v: u32) -> usize {
        self.spans[v as usize].1 as usize
    }

    fn of_mut(&mut self, v: u32) -> &mut [Link] {
        let (start, length, _) = self.spans[v as usize];
        &mut self.links[start as usize..(start + length) as usize]
    }

    /// Adds the list of the next vertex.
    fn append(&mut self, links: impl Iterator<Item = Link>) {
        let start = self.links.len() as u32;
        self.links.extend(links);
        let length = self.links.len() as u32 - start;
        self.spans.push((start, length, length));
    }

    fn push(&mut self, v: u32, link: Link) {
        let (start, length, room) = self.spans[v as usize];
        let place = if length < room {
            start
        } else {
            let moved = self.links.len();
            self.links.extend_from_within(start as usize..(start + length) as usize);
            let room = (2 * room).max(8);
            self.links.resize(moved + room as usize, link);
            self.spans[v as usize] = (moved as u32, length, room);
            moved as u32
        };
        self.links[(place + length) as usize] = link;
        self.spans[v as usize].1 += 1;
    }

    /// Takes the link to `to` out of the list of `v` and leaves the others in their order.
    fn remove(&mut self, v: u32, to: u32) {
        let list = self.of_mut(v);
        if let Some(place) = list.iter().position(|link| link.to == to) {
            list.copy_within(place + 1.., place);
            self.spans[v as usize].1 -= 1;
        }
    }
}

/// The vertices that are no attachments in the order of their elimination, and the links that each then has.
fn eliminate(graph: &PathGraph) -> (Vec<u32>, LinkLists) {
    let count = graph.vertex_count();
    let open = |&(u, _): &(u32, f64)| !graph.is_attachment(u);
    let edge = |(to, weight)| Link { to, middle: Hierarchy::NO_MIDDLE, weight };
    let mut remaining = LinkLists {
        links: Vec::with_capacity(6 * graph.edge_count() + 16),
        spans: Vec::with_capacity(count),
    };
    for v in 0..count as u32 {
        let own = if graph.is_attachment(v) { PathGraph::NO_VERTEX } else { v };
        remaining.append(graph.neighbours(own).filter(open).map(edge));
    }

    // The vertices by degree. An entry is stale once its vertex is gone or has another degree.
    let mut queues: Vec<Vec<u32>> = Vec::new();
    let enqueue = |queues: &mut Vec<Vec<u32>>, degree: usize, v: u32| {
        if queues.len() <= degree {
            queues.resize(degree + 1, Vec::new());
        }
        queues[degree].push(v);
    };
    let interior = (0..count as u32).rev().filter(|&v| !graph.is_attachment(v));
    for v in interior {
        enqueue(&mut queues, remaining.len(v), v);
    }

    let mut order = Vec::with_capacity(count);
    let mut is_gone = vec![false; count];
    // Where in the list under work a neighbour stands, valid while the stamp is current.
    let mut slots = vec![(0_u32, 0_u32); count];
    let mut stamp = 0_u32;
    let mut degree = 0;
    // The links of the vertex under work, which its neighbours' lists must not move away from.
    let mut links: Vec<Link> = Vec::new();
    while degree < queues.len() {
        let Some(v) = queues[degree].pop() else {
            degree += 1;
            continue;
        };
        if is_gone[v as usize] || remaining.len(v) != degree {
            continue;
        }
        is_gone[v as usize] = true;
        links.clear();
        links.extend_from_slice(remaining.of(v));
        for own in &links {
            remaining.remove(own.to, v);
            stamp = stamp.wrapping_add(1);
            for (slot, link) in remaining.of(own.to).iter().enumerate() {
                slots[link.to as usize] = (stamp, slot as u32);
            }
            for other in links.iter().filter(|other| other.to != own.to) {
                let weight = own.weight + other.weight;
                match slots[other.to as usize] {
                    (s, slot) if s == stamp => {
                        let link = &mut remaining.of_mut(own.to)[slot as usize];
                        if weight < link.weight {
                            (link.weight, link.middle) = (weight, v);
                        }
                    }
                    _ => remaining.push(own.to, Link { to: other.to, middle: v, weight }),
                }
            }
            let new_degree = remaining.len(own.to);
            enqueue(&mut queues, new_degree, own.to);
            degree = degree.min(new_degree);
        }
        order.push(v);
    }
    (order, remaining)
}

/// The same elimination in another order with the same links: every vertex right after the vertices that
/// have it as their first later neighbour. Ranks that are close then share most of their way up.
fn in_postorder(order: &[u32], links: &LinkLists) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut place = vec![NONE; links.spans.len()];
    for (&v, k) in order.iter().zip(0..) {
        place[v as usize] = k;
    }
    // The children of every vertex as a chain, the earliest eliminated first.
    let mut first_child = vec![NONE; order.len()];
    let mut next_sibling = vec![NONE; order.len()];
    let mut stack: Vec<u32> = Vec::new();
    for (k, &v) in order.iter().enumerate().rev() {
        match links.of(v).iter().map(|link| place[link.to as usize]).min() {
            Some(parent) => {
                next_sibling[k] = std::mem::replace(&mut first_child[parent as usize], k as u32);
            }
            None => stack.push(k as u32),
        }
    }
    stack.reverse();
    // Parents before their children, then reversed.
    let mut places = Vec::with_capacity(order.len());
    while let Some(k) = stack.pop() {
        places.push(k);
        let mut child = first_child[k as usize];
        while child != NONE {
            stack.push(child);
            child = next_sibling[child as usize];
        }
    }
    places.reverse();
    places.into_iter().map(|k| order[k as usize]).collect()
}
