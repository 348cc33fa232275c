//! Smaller bodies that fail as well.

use super::{Body, Piece};

/// A body from which no piece can be left out, and whose numbers cannot be made whole, without it passing.
///
/// # Complexity
/// At most `pieces² + 8 · pieces` tries.
pub(crate) fn shrunk(body: &Body, fails: impl Fn(&Body) -> bool) -> Body {
    let mut body = body.clone();
    let mut at = 0;
    while at < body.0.len() && body.0.len() > 1 {
        let mut fewer = body.clone();
        fewer.0.remove(at);
        if fails(&fewer) {
            body = fewer;
            at = 0;
        } else {
            at += 1;
        }
    }
    for at in 0..body.0.len() {
        let mut rounder = body.clone();
        rounder.0[at].1 = whole(rounder.0[at].1);
        if rounder != body && fails(&rounder) {
            body = rounder;
        }
    }
    body
}

/// The piece with its places at whole millimetres.
fn whole(piece: Piece) -> Piece {
    let point = |p: [f64; 3]| p.map(f64::round);
    match piece {
        Piece::Rod(from, thick, to, thin) => Piece::Rod(point(from), thick, point(to), thin),
        Piece::Block(low, high) => Piece::Block(point(low), point(high)),
        Piece::Ring(centre, axis, ring, section) => Piece::Ring(point(centre), axis, ring, section),
    }
}
