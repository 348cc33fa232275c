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
        let (order, links) = in_postorder(&order, links);

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

        let mut hierarchy = Hierarchy {
            rank_of,
            vertex_of,
            attachment_count,
            offsets: vec![0],
            to: Vec::new(),
            weights: Vec::new(),
            middles: Vec::new(),
        };
        for rank in 0..attachment_count {
            let vertex = hierarchy.vertex_of[rank];
            let open = graph.neighbours(vertex).filter(|&(u, _)| !graph.is_attachment(u));
            let own = open.map(|(to, weight)| Link { to, middle: Self::NO_MIDDLE, weight }).collect();
            hierarchy.push(own);
        }
        for own in links {
            hierarchy.push(own);
        }
        hierarchy
    }

    fn push(&mut self, mut links: Vec<Link>) {
        for link in &mut links {
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
                match self.links(rank).0.first() {
                    Some(&next) => rank = next,
                    None => break,
                }
            }
        };
        if (rank as usize) < self.attachment_count {
            for &next in self.links(rank).0 {
                follow(next);
            }
            visit(rank);
        } else {
            follow(rank);
        }
    }
}

/// The vertices that are no attachments in the order of their elimination, and the links that each then has.
fn eliminate(graph: &PathGraph) -> (Vec<u32>, Vec<Vec<Link>>) {
    let count = graph.vertex_count();
    let open = |&(u, _): &(u32, f64)| !graph.is_attachment(u);
    let edge = |(to, weight)| Link { to, middle: Hierarchy::NO_MIDDLE, weight };
    let mut remaining: Vec<Vec<Link>> = (0..count as u32)
        .map(|v| {
            if graph.is_attachment(v) {
                Vec::new()
            } else {
                graph.neighbours(v).filter(open).map(edge).collect()
            }
        })
        .collect();

    // The vertices by degree. An entry is stale once its vertex is gone or has another degree.
    let mut queues: Vec<Vec<u32>> = Vec::new();
    let enqueue = |queues: &mut Vec<Vec<u32>>, degree: usize, v: u32| {
        if queues.len() <= degree {
            queues.resize(degree + 1, Vec::new());
        }
        queues[degree].push(v);
    };
    let interior: Vec<u32> = (0..count as u32).filter(|&v| !graph.is_attachment(v)).collect();
    for &v in interior.iter().rev() {
        enqueue(&mut queues, remaining[v as usize].len(), v);
    }

    let mut order = Vec::with_capacity(interior.len());
    let mut taken = Vec::with_capacity(interior.len());
    let mut is_gone = vec![false; count];
    // Where in the list under work a neighbour stands, valid while the stamp is current.
    let mut slots = vec![(0_u32, 0_u32); count];
    let mut stamp = 0_u32;
    let mut degree = 0;
    while degree < queues.len() {
        let Some(v) = queues[degree].pop() else {
            degree += 1;
            continue;
        };
        if is_gone[v as usize] || remaining[v as usize].len() != degree {
            continue;
        }
        is_gone[v as usize] = true;
        let links = std::mem::take(&mut remaining[v as usize]);
        for own in &links {
            let list = &mut remaining[own.to as usize];
            list.retain(|link| link.to != v);
            stamp = stamp.wrapping_add(1);
            for (slot, link) in list.iter().enumerate() {
                slots[link.to as usize] = (stamp, slot as u32);
            }
            for other in links.iter().filter(|other| other.to != own.to) {
                let weight = own.weight + other.weight;
                match slots[other.to as usize] {
                    (s, slot) if s == stamp => {
                        let link = &mut list[slot as usize];
                        if weight < link.weight {
                            (link.weight, link.middle) = (weight, v);
                        }
                    }
                    _ => list.push(Link { to: other.to, middle: v, weight }),
                }
            }
            let new_degree = list.len();
            enqueue(&mut queues, new_degree, own.to);
            degree = degree.min(new_degree);
        }
        order.push(v);
        taken.push(links);
    }
    (order, taken)
}

/// The same elimination in another order with the same links: every vertex right after the vertices that
/// have it as their first later neighbour. Ranks that are close then share most of their way up.
fn in_postorder(order: &[u32], mut links: Vec<Vec<Link>>) -> (Vec<u32>, Vec<Vec<Link>>) {
    let largest = order.iter().max().map_or(0, |&v| v as usize + 1);
    let mut place = vec![0; largest];
    for (k, &v) in order.iter().enumerate() {
        place[v as usize] = k;
    }
    let parent = |own: &[Link]| own.iter().map(|link| place[link.to as usize]).min();
    let parents: Vec<Option<usize>> = links.iter().map(|own| parent(own)).collect();
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); order.len()];
    for (k, parent) in parents.iter().enumerate() {
        if let Some(parent) = *parent {
            children[parent].push(k);
        }
    }
    // Parents before their children, then reversed.
    let mut stack: Vec<usize> = (0..order.len()).filter(|&k| parents[k].is_none()).collect();
    let mut places = Vec::with_capacity(order.len());
    while let Some(k) = stack.pop() {
        places.push(k);
        stack.extend(&children[k]);
    }
    places.reverse();
    let order = places.iter().map(|&k| order[k]).collect();
    let links = places.iter().map(|&k| std::mem::take(&mut links[k])).collect();
    (order, links)
}
