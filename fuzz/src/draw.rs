//! Numbers and points from bytes.

use argil_curve::DVec2;

/// Draws values from bytes, one after the other; all are zero when the bytes are at an end.
///
/// Values stand in the order in which they are drawn, so that a changed byte changes one value: mutations of an input
/// stay near it, which is what makes coverage a guide.
#[derive(Clone, Copy, Debug)]
pub struct Draw<'a> {
    bytes: &'a [u8],
}

impl<'a> Draw<'a> {
    /// Draws from these bytes.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    /// Whether all bytes are used up: the end of every list.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.bytes.split_first() else { return 0 };
        self.bytes = rest;
        first
    }

    /// An integer below `count`, which is at most 256; 0 if `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count.max(1)
    }

    /// One of two.
    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// A number from `low` to `high`, both of which can occur, in 65,536 steps.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        let share = f64::from(u16::from_be_bytes([self.byte(), self.byte()])) / f64::from(u16::MAX);
        low + (high - low) * share
    }

    /// A point of the square with this half side, mm.
    pub fn point(&mut self, reach: f64) -> DVec2 {
        DVec2::new(self.within(-reach, reach), self.within(-reach, reach))
    }

    /// A point with whole coordinates, so that points coincide and line up.
    pub fn lattice_point(&mut self, reach: u8) -> DVec2 {
        let mut whole = || f64::from(self.byte() % (2 * reach + 1)) - f64::from(reach);
        DVec2::new(whole(), whole())
    }
}
