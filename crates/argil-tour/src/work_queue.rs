//! The nodes whose surroundings changed.

use alloc::vec::Vec;

/// Nodes to be looked at, first come first served, none twice at a time.
///
/// This is the complement of Bentley's don't-look bits (1992, DOI 10.1287/ijoc.4.4.387): a kick queues the ends of
/// the edges it cut, and costs nothing but the search round them.
#[derive(Clone, Debug, Default)]
pub(crate) struct WorkQueue {
    ring: Vec<u32>,
    waiting: Vec<bool>,
    head: usize,
    count: usize,
}

impl WorkQueue {
    /// Empties the queue and makes room for the nodes below `n`.
    pub(crate) fn reset(&mut self, n: usize) {
        self.ring.clear();
        self.ring.resize(n, 0);
        self.waiting.clear();
        self.waiting.resize(n, false);
        (self.head, self.count) = (0, 0);
    }

    pub(crate) fn push(&mut self, node: u32) {
        if !self.waiting[node as usize] {
            self.waiting[node as usize] = true;
            let tail = self.head + self.count;
            let n = self.ring.len();
            self.ring[if tail >= n { tail - n } else { tail }] = node;
            self.count += 1;
        }
    }

    pub(crate) fn pop(&mut self) -> Option<u32> {
        if self.count == 0 {
            return None;
        }
        let node = self.ring[self.head];
        self.head = if self.head + 1 == self.ring.len() { 0 } else { self.head + 1 };
        self.count -= 1;
        self.waiting[node as usize] = false;
        Some(node)
    }
}
