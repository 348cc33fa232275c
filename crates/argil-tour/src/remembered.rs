//! A metric that remembers what it was asked last.

use alloc::vec::Vec;
use core::cell::Cell;

use crate::Metric;

/// From this many nodes on, distances are remembered, and nothing is asked for every pair.
pub(crate) const FEWEST_REMEMBERED: usize = 2000;

/// How many distances are remembered, as a power of two: two megabytes, about what a core has to itself.
const SLOTS_LOG2: u32 = 17;

/// A key that no pair has.
const NOTHING: u64 = u64::MAX;

/// Some distances with the pairs that they are between. A pair has one place, and what comes later takes it over.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    slots: Vec<(u64, f64)>,
}

impl Memory {
    /// Forgets everything, for another metric.
    pub(crate) fn clear(&mut self) {
        self.slots.clear();
        self.slots.resize(1 << SLOTS_LOG2, (NOTHING, 0.0));
    }
}

/// A metric of many nodes, asked again and again for pairs that are near each other.
///
/// A matrix of ten thousand nodes fits no cache, and distances that are made on demand take longer still.
#[derive(Debug)]
pub(crate) struct Remembered<'a, M> {
    metric: &'a M,
    slots: &'a [Cell<(u64, f64)>],
}

impl<'a, M: Metric> Remembered<'a, M> {
    /// The memory must have been cleared since it was used for another metric.
    ///
    /// Cells are made here alone, so that a solver with its memory can be shared by threads.
    pub(crate) fn new(metric: &'a M, memory: &'a mut Memory) -> Self {
        Self { metric, slots: Cell::from_mut(memory.slots.as_mut_slice()).as_slice_of_cells() }
    }
}

impl<M: Metric> Metric for Remembered<'_, M> {
    fn nodes(&self) -> usize {
        self.metric.nodes()
    }

    #[inline]
    fn distance(&self, a: usize, b: usize) -> f64 {
        let (low, high) = (a.min(b), a.max(b));
        let key = (low as u64) << 32 | high as u64;
        // The golden ratio, by which Knuth multiplies; the high bits of the product depend on all of the key's.
        let place = key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (u64::BITS - SLOTS_LOG2);
        let Some(slot) = self.slots.get(place as usize) else {
            return self.metric.distance(low, high);
        };
        let (known, distance) = slot.get();
        if known == key {
            return distance;
        }
        let distance = self.metric.distance(low, high);
        slot.set((key, distance));
        distance
    }

    fn row(&self, a: usize) -> Option<&[f64]> {
        self.metric.row(a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Counted(Cell<usize>);

    impl Metric for Counted {
        fn nodes(&self) -> usize {
            3000
        }

        fn distance(&self, a: usize, b: usize) -> f64 {
            self.0.set(self.0.get() + 1);
            (a.abs_diff(b) * 7 + a + b) as f64
        }
    }

    #[test]
    fn what_is_remembered_is_what_the_metric_says() {
        let counted = Counted(Cell::new(0));
        let mut memory = Memory::default();
        memory.clear();
        let remembered = Remembered::new(&counted, &mut memory);
        for round in 0..2_usize {
            for a in (0..3000_usize).step_by(7) {
                for b in (0..3000_usize).step_by(11) {
                    let expected = (a.abs_diff(b) * 7 + a + b) as f64;
                    assert_eq!(remembered.distance(a, b), expected, "{round}");
                    assert_eq!(remembered.distance(b, a), expected);
                }
            }
        }
        // Half of all questions repeat the one before with the ends exchanged.
        assert!(counted.0.get() <= 2 * 429 * 273);
    }
}
