//! Widths of beads as pictures draw them: in few classes, so that strokes of one width are one path.

/// Classes from nothing to the width of a layer.
pub(crate) const SHARES: u32 = 20;

/// The class of a bead; that of its layer where the width is no number, and at most three times that.
pub(crate) fn width_share(bead: f64, layer: f64) -> u32 {
    let share = (bead / layer * f64::from(SHARES)).round();
    if share.is_finite() { share.clamp(1.0, 3.0 * f64::from(SHARES)) as u32 } else { SHARES }
}

/// The width that beads of a class are drawn with, mm.
pub(crate) fn drawn_width(share: u32, layer: f64) -> f64 {
    layer * f64::from(share) / f64::from(SHARES)
}

#[cfg(test)]
mod tests {
    use super::{SHARES, drawn_width, width_share};

    #[test]
    fn widths_are_drawn_to_a_twentieth_of_the_layers() {
        assert_eq!((width_share(1.5, 1.5), drawn_width(SHARES, 1.5)), (SHARES, 1.5));
        assert!((drawn_width(width_share(1.13, 1.5), 1.5) - 1.13).abs() < 0.04);
        assert_eq!((width_share(f64::NAN, 1.5), width_share(1e9, 1.5)), (SHARES, 3 * SHARES));
    }
}
