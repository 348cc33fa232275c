//! Strands that go through the wall.

use crate::strand::Piece;
use crate::wanted::Side;
use argil_curve::DVec2;

/// Where the strand gets from outside the wall to inside, or back, with less than `along` mm along the wall
/// between. A strand that joins the wall runs along it; one that pierces it does not, and leaves a notch when
/// it is broken off.
pub(crate) fn passages(pieces: &[Piece], along: f64) -> Vec<DVec2> {
    let mut found = Vec::new();
    let mut last: Option<Side> = None;
    let mut run = 0.0;
    for piece in pieces {
        if piece.side == Side::Along {
            run += piece.length;
            continue;
        }
        if last.is_some_and(|side| side != piece.side) && run < along {
            found.push(piece.at);
        }
        last = Some(piece.side);
        run = 0.0;
    }
    found
}
