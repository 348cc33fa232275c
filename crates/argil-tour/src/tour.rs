//! The outcome of a search.

use alloc::vec::Vec;

/// A closed tour: every node once, and back from the last to the first.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tour {
    /// The nodes in the order in which they are visited. It begins with node 0, and of the two directions it
    /// takes the one whose second node has the lower number, so that equal cycles compare equal.
    pub order: Vec<usize>,
    /// The length of the cycle, in the unit of the metric.
    pub length: f64,
}

impl Tour {
    /// The tour that visits `order`, brought into its canonical rotation and direction.
    pub(crate) fn canonical(order: &[u32], distance: impl Fn(u32, u32) -> f64) -> Self {
        let n = order.len();
        let first = order.iter().position(|&node| node == 0).unwrap_or(0);
        let at = |k: usize| order[(first + k) % n] as usize;
        let forward = n < 3 || at(1) < at(n - 1);
        let order: Vec<usize> = (0..n).map(|k| if forward { at(k) } else { at((n - k) % n) }).collect();
        let length = (0..n).map(|k| distance(order[k] as u32, order[(k + 1) % n] as u32)).sum();
        Self { order, length }
    }
}
