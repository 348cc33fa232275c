//! The settings of a search.

/// How long and how widely to search.
///
/// Work is counted, never timed: the same input gives the same tour on every machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TourOptions {
    /// Up to this many nodes the tour is the shortest there is, by dynamic programming. Every further node
    /// doubles time and memory, so that more than 16 counts as 16.
    pub exact_up_to: usize,
    /// How many nearest nodes each node counts among its candidates, besides those the caller adds. Fewer are
    /// faster; with more, a kick finds more ways back.
    pub neighbours: usize,
    /// How many kicks the iterated search spends a node. Time grows in proportion; 0 stops at the first local
    /// optimum.
    pub kicks_per_node: usize,
    /// What the kicks are drawn from. Every seed gives another tour of much the same length.
    pub seed: u64,
}

impl Default for TourOptions {
    fn default() -> Self {
        Self { exact_up_to: 10, neighbours: 6, kicks_per_node: 30, seed: 0 }
    }
}
