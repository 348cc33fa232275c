//! The settings of a search.

/// How long and how widely to search.
///
/// Work is counted, never timed: the same input gives the same tour on every machine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct TourOptions {
    /// Up to this many nodes the tour is the shortest there is, by dynamic programming. Every further node
    /// doubles time and memory, so that more than 16 counts as 16.
    pub exact_up_to: usize,
    /// How many nearest nodes each node counts among its candidates, besides those the caller adds. With fewer the
    /// search is faster and blinder; with 0 the caller's candidates are all there are, and no search of
    /// nearest nodes takes time. Where the caller has none, 0 counts as 1.
    pub neighbours: usize,
    /// How many kicks the iterated search spends a node, 0 to stop at the first local optimum. Time grows in
    /// proportion, by some 10 to 20 µs a kick. Fewer than 50 nodes get the kicks of 50. A budget that is
    /// negative or not finite counts as 0.
    pub kicks_per_node: f64,
    /// After how many kicks in a row that shorten nothing, a node, the search ends before all are spent; what holds for few
    /// nodes and for numbers that are none holds here as well. No less than `kicks_per_node` spends them all.
    pub patience_per_node: f64,
    /// What the kicks are drawn from. Every seed gives another tour of much the same length.
    pub seed: u64,
}

impl Default for TourOptions {
    fn default() -> Self {
        Self { exact_up_to: 14, neighbours: 5, kicks_per_node: 1.5, patience_per_node: 0.4, seed: 0 }
    }
}
