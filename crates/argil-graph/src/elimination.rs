//! In which order the vertices are eliminated, and what each is then linked to.
//!
//! This looks at no lengths: the same order serves a graph whatever its edges weigh.

use crate::PathGraph;

/// The vertices that are no attachments in the order of their elimination, those with the fewest remaining neighbours
/// first, and the later neighbours that each then has.
///
/// # Complexity
/// O(Σ d²) for the degrees d at elimination: O(V √V) or better on plane graphs of even density.
pub(crate) fn eliminate(graph: &PathGraph) -> (Vec<u32>, Lists) {
    let count = graph.vertex_count();
    let mut remaining =
        Lists { entries: Vec::with_capacity(6 * graph.edge_count() + 16), spans: Vec::with_capacity(count) };
    for v in 0..count as u32 {
        let own = if graph.is_attachment(v) { PathGraph::NO_VERTEX } else { v };
        remaining.append(graph.neighbours(own).map(|(u, _)| u).filter(|&u| !graph.is_attachment(u)));
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
    // The last vertex that each vertex was a neighbour of.
    let mut beside = vec![PathGraph::NO_VERTEX; count];
    let mut degree = 0;
    // The neighbours of the vertex under work, which their own lists must not move away from.
    let mut neighbours: Vec<u32> = Vec::new();
    while degree < queues.len() {
        let Some(v) = queues[degree].pop() else {
            degree += 1;
            continue;
        };
        if is_gone[v as usize] || remaining.len(v) != degree {
            continue;
        }
        is_gone[v as usize] = true;
        neighbours.clear();
        neighbours.extend_from_slice(remaining.of(v));
        for &own in &neighbours {
            beside[own as usize] = v;
        }
        for &own in &neighbours {
            remaining.remove(own, v);
            let shared = |u: &u32| usize::from(beside[*u as usize] == v);
            let known: usize = remaining.of(own).iter().map(shared).sum();
            // Late in the elimination most neighbours are joined already.
            if known + 1 < neighbours.len() {
                for &other in remaining.of(own) {
                    if beside[other as usize] == v {
                        beside[other as usize] = PathGraph::NO_VERTEX;
                    }
                }
                for &other in &neighbours {
                    if other != own && beside[other as usize] == v {
                        remaining.push(own, other);
                    }
                }
                for &other in &neighbours {
                    beside[other as usize] = v;
                }
            }
            let new_degree = remaining.len(own);
            enqueue(&mut queues, new_degree, own);
            degree = degree.min(new_degree);
        }
        order.push(v);
    }
    (order, remaining)
}

/// The same elimination in another order with the same links: every vertex right after the vertices that
/// have it as their first later neighbour. Ranks that are close then share most of their way up.
pub(crate) fn in_postorder(order: &[u32], links: &Lists) -> Vec<u32> {
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
        match links.of(v).iter().map(|&to| place[to as usize]).min() {
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

/// The neighbours of all vertices one after the other. A list that outgrows its room moves to the end, so that
/// nothing is allocated for a single vertex.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lists {
    entries: Vec<u32>,
    /// Start, length and room of each list.
    spans: Vec<(u32, u32, u32)>,
}

impl Lists {
    pub(crate) fn of(&self, v: u32) -> &[u32] {
        let (start, length, _) = self.spans[v as usize];
        &self.entries[start as usize..(start + length) as usize]
    }

    pub(crate) fn len(&self, v: u32) -> usize {
        self.spans[v as usize].1 as usize
    }

    fn of_mut(&mut self, v: u32) -> &mut [u32] {
        let (start, length, _) = self.spans[v as usize];
        &mut self.entries[start as usize..(start + length) as usize]
    }

    /// Adds the list of the next vertex.
    fn append(&mut self, entries: impl Iterator<Item = u32>) {
        let start = self.entries.len() as u32;
        self.entries.extend(entries);
        let length = self.entries.len() as u32 - start;
        self.spans.push((start, length, length));
    }

    fn push(&mut self, v: u32, entry: u32) {
        let (start, length, room) = self.spans[v as usize];
        let place = if length < room {
            start
        } else {
            let moved = self.entries.len();
            self.entries.extend_from_within(start as usize..(start + length) as usize);
            let room = (2 * room).max(8);
            self.entries.resize(moved + room as usize, entry);
            self.spans[v as usize] = (moved as u32, length, room);
            moved as u32
        };
        self.entries[(place + length) as usize] = entry;
        self.spans[v as usize].1 += 1;
    }

    /// Takes `to` out of the list of `v` and leaves the others in their order.
    fn remove(&mut self, v: u32, to: u32) {
        let list = self.of_mut(v);
        if let Some(place) = list.iter().position(|&entry| entry == to) {
            list.copy_within(place + 1.., place);
            self.spans[v as usize].1 -= 1;
        }
    }
}
