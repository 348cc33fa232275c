//! Elimination with the neighbours of each vertex as a list: for vertices that have few.

use crate::PathGraph;
use crate::elimination::Elimination;

/// The neighbours of all vertices one after the other. A list that outgrows its room moves to the end, so that
/// nothing is allocated for a single vertex.
#[derive(Debug)]
pub(crate) struct Lists {
    entries: Vec<u32>,
    /// Start, length and room of each list.
    spans: Vec<(u32, u32, u32)>,
    /// The vertices that have not been eliminated, by their degree. An entry is stale once its vertex is gone or has another degree.
    queues: Vec<Vec<u32>>,
    is_gone: Vec<bool>,
    left: usize,
}

impl Lists {
    /// The lists of these vertices, of so many that there are.
    pub(crate) fn new<N: Iterator<Item = u32>>(
        vertices: &[u32],
        count: usize,
        neighbours: impl Fn(u32) -> N,
    ) -> Self {
        let mut lists = Self {
            entries: Vec::with_capacity(32 * vertices.len()),
            spans: vec![(0, 0, 0); count],
            queues: Vec::new(),
            is_gone: vec![true; count],
            left: vertices.len(),
        };
        for &v in vertices {
            let start = lists.entries.len() as u32;
            lists.entries.extend(neighbours(v));
            let length = lists.entries.len() as u32 - start;
            lists.spans[v as usize] = (start, length, length);
            lists.is_gone[v as usize] = false;
        }
        for &v in vertices.iter().rev() {
            lists.enqueue(v);
        }
        lists
    }

    /// Eliminates vertices until so many are left, and gives these.
    pub(crate) fn eliminate(&mut self, done: &mut Elimination, until: usize) -> Vec<u32> {
        // The last vertex that each vertex was a neighbour of.
        let mut beside = vec![PathGraph::NO_VERTEX; self.spans.len()];
        // The neighbours of the vertex under work, which their own lists must not move away from.
        let mut neighbours: Vec<u32> = Vec::new();
        let mut degree = 0;
        while self.left > until && degree < self.queues.len() {
            let Some(v) = self.queues[degree].pop() else {
                degree += 1;
                continue;
            };
            if self.is_gone[v as usize] || self.len(v) != degree {
                continue;
            }
            self.is_gone[v as usize] = true;
            self.left -= 1;
            neighbours.clear();
            neighbours.extend_from_slice(self.of(v));
            for &own in &neighbours {
                beside[own as usize] = v;
            }
            for &own in &neighbours {
                self.remove(own, v);
                let shared = |u: &u32| usize::from(beside[*u as usize] == v);
                let known: usize = self.of(own).iter().map(shared).sum();
                // Late in the elimination most neighbours are joined already.
                if known + 1 < neighbours.len() {
                    for &other in self.of(own) {
                        if beside[other as usize] == v {
                            beside[other as usize] = PathGraph::NO_VERTEX;
                        }
                    }
                    for &other in &neighbours {
                        if other != own && beside[other as usize] == v {
                            self.push(own, other);
                        }
                    }
                    for &other in &neighbours {
                        beside[other as usize] = v;
                    }
                }
                self.enqueue(own);
                degree = degree.min(self.len(own));
            }
            done.push(v, neighbours.iter().copied());
        }
        (0..self.spans.len() as u32).filter(|&v| !self.is_gone[v as usize]).collect()
    }

    /// The neighbours that a vertex has left.
    pub(crate) fn of(&self, v: u32) -> &[u32] {
        let (start, length, _) = self.spans[v as usize];
        &self.entries[start as usize..(start + length) as usize]
    }

    fn len(&self, v: u32) -> usize {
        self.spans[v as usize].1 as usize
    }

    fn enqueue(&mut self, v: u32) {
        let degree = self.len(v);
        if self.queues.len() <= degree {
            self.queues.resize(degree + 1, Vec::new());
        }
        self.queues[degree].push(v);
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
        let (start, length, _) = self.spans[v as usize];
        let list = &mut self.entries[start as usize..(start + length) as usize];
        if let Some(place) = list.iter().position(|&entry| entry == to) {
            list.copy_within(place + 1.., place);
            self.spans[v as usize].1 -= 1;
        }
    }
}
