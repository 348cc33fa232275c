//! What becomes of a cycle when edges are exchanged.

use crate::array_tour::Piece;

/// The most edges that one exchange replaces.
///
/// At equal time four are better than three (0.09 against 0.15 % above the best known tours of 200 to 1,600
/// nodes) and as good as five, which take twice as long a kick.
pub(crate) const MOST_CUTS: usize = 4;

/// An edge of the tour that an exchange removes.
///
/// In the words of Lin and Kernighan it leads from t₂ₖ₋₁ to t₂ₖ, and the exchange adds the edges t₂ t₃, t₄ t₅, … and
/// last the one back to t₁.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cut {
    /// The edge lies between this position and the next.
    pub(crate) position: u32,
    pub(crate) from: u32,
    pub(crate) to: u32,
    /// Whether `from` comes before `to` on the tour.
    pub(crate) forward: bool,
}

/// The pieces of a tour of `nodes` nodes in the order in which the exchange of `cuts` joins them, or nothing if
/// it would leave several cycles.
///
/// The first of the returned pieces, as many as there are cuts, count.
pub(crate) fn pieces_joined(cuts: &[Cut], nodes: usize) -> Option<[Piece; MOST_CUTS]> {
    let count = cuts.len();
    let mut rank = [0_usize; MOST_CUTS];
    let mut sorted = [0_u32; MOST_CUTS];
    for (k, cut) in cuts.iter().enumerate() {
        rank[k] = cuts.iter().filter(|other| other.position < cut.position).count();
        sorted[rank[k]] = cut.position;
    }
    // The cut of rank r has two ends: 2 r is the node before it, 2 r + 1 the node after it. Piece r is what lies
    // between the cuts of ranks r − 1 and r.
    let mut partner = [0_usize; 2 * MOST_CUTS];
    for k in 0..count {
        let next = if k + 1 == count { 0 } else { k + 1 };
        let to = 2 * rank[k] + usize::from(cuts[k].forward);
        let from = 2 * rank[next] + usize::from(!cuts[next].forward);
        partner[to] = from;
        partner[from] = to;
    }
    let mut pieces = [Piece::default(); MOST_CUTS];
    let mut end = 1;
    for (k, piece) in pieces[..count].iter_mut().enumerate() {
        let cut = end / 2;
        let reversed = end % 2 == 0;
        let (r, exit) = if reversed {
            (cut, 2 * if cut == 0 { count - 1 } else { cut - 1 } + 1)
        } else {
            let r = if cut + 1 == count { 0 } else { cut + 1 };
            (r, 2 * r)
        };
        let before = sorted[if r == 0 { count - 1 } else { r - 1 }];
        let first = if before as usize + 1 == nodes { 0 } else { before + 1 };
        let length = if r == 0 { sorted[0] + nodes as u32 - before } else { sorted[r] - before };
        *piece = Piece { first, length, reversed };
        end = partner[exit];
        if end == 1 && k + 1 < count {
            return None;
        }
    }
    Some(pieces)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cuts of the tour 0 1 2 … 9, given as the pairs t₁ t₂, t₃ t₄, …
    fn joined(pairs: &[(u32, u32)]) -> Option<Vec<u32>> {
        let cuts: Vec<Cut> = pairs
            .iter()
            .map(|&(from, to)| {
                let forward = to == (from + 1) % 10;
                Cut { position: if forward { from } else { to }, from, to, forward }
            })
            .collect();
        let pieces = pieces_joined(&cuts, 10)?;
        let mut order = Vec::new();
        for piece in &pieces[..cuts.len()] {
            let nodes = (piece.first..piece.first + piece.length).map(|k| k % 10);
            if piece.reversed { order.extend(nodes.rev()) } else { order.extend(nodes) }
        }
        Some(order)
    }

    #[test]
    fn two_cuts_join_one_way_only() {
        assert_eq!(joined(&[(1, 2), (6, 5)]), Some(vec![2, 3, 4, 5, 1, 0, 9, 8, 7, 6]));
        assert_eq!(joined(&[(1, 2), (5, 6)]), None);
    }

    #[test]
    fn or_3opt_swaps_two_segments() {
        // 1 2‥4 5‥7 8 becomes 1 5‥7 2‥4 8: t₂ t₃ is 2 7, t₄ t₅ is 8 4, t₆ t₁ is 5 1.
        assert_eq!(joined(&[(1, 2), (7, 8), (4, 5)]), Some(vec![2, 3, 4, 8, 9, 0, 1, 5, 6, 7]));
    }

    #[test]
    fn the_last_edge_may_be_the_one_that_closes_the_array() {
        assert_eq!(joined(&[(9, 0), (4, 3)]), Some(vec![4, 5, 6, 7, 8, 9, 3, 2, 1, 0]));
    }
}
