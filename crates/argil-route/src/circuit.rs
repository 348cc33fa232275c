//! The non-crossing Euler circuit of a plane multigraph.
//!
//! At every vertex the ends are paired: who comes in by one goes out by the other. A pairing is
//! *non-crossing* when no two pairs alternate round the vertex. Neighbours in the rotation are paired first, which
//! gives some circuits; then, wherever two circuits meet at a vertex with nothing between them, their
//! pairs are exchanged, which makes one circuit of two and keeps the pairing non-crossing. In a connected
//! multigraph with even degrees this ends with exactly one circuit: round a vertex, the pairs and the
//! gaps between them form a tree, so two different circuits always have neighbours somewhere.

use crate::RouteError;
use crate::multigraph::{EdgeEnd, Multigraph, Partition, opposite};

/// One passage of the circuit through a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Visit {
    pub(crate) incoming: EdgeEnd,
    pub(crate) outgoing: EdgeEnd,
}

/// The circuit, and the order of ends round every vertex that it is planar for.
#[derive(Debug)]
pub(crate) struct Circuit {
    /// Visits in the order of the walk; each leaves by `outgoing` and the next arrives by its opposite.
    pub(crate) visits: Vec<Visit>,
    /// Ends round every vertex, counter-clockwise.
    pub(crate) rotations: Vec<Vec<EdgeEnd>>,
}

/// Pairs all ends without a crossing into one circuit.
///
/// # Errors
/// [`RouteError::Disconnected`] if the multigraph falls into parts. Odd degrees cannot happen: tours and walls are closed.
///
/// # Complexity
/// O(edges · log edges + Σ degree³ over vertices); degrees are small.
pub(crate) fn euler_circuit(graph: &Multigraph) -> Result<Circuit, RouteError> {
    let rotations = graph.rotations();
    let mut partner: Vec<EdgeEnd> = vec![0; 2 * graph.edges.len()];
    for ends in &rotations {
        pair_neighbours(graph, ends, &mut partner);
    }
    let mut circuits = label(&partner);
    for ends in &rotations {
        merge_at(ends, &mut partner, &mut circuits);
    }
    let root = circuits.find(0);
    if let Some(cut_off) = (0..partner.len()).find(|&end| circuits.find(end) != root) {
        return Err(RouteError::Disconnected { at: graph.positions[graph.vertex_at(cut_off) as usize] });
    }
    let mut visits = Vec::with_capacity(graph.edges.len());
    let start = partner.first().copied().unwrap_or_default();
    let mut outgoing = start;
    while visits.len() < graph.edges.len() {
        let incoming = opposite(outgoing);
        outgoing = partner[incoming];
        visits.push(Visit { incoming, outgoing });
        if outgoing == start {
            break;
        }
    }
    Ok(Circuit { visits, rotations })
}

/// Pairs each end with a neighbour in the rotation. Beginning at a wall's end, the wall leaves by the first leg
/// beside it. Where no wall is met, the rotation is cut where the turns come out gentler.
fn pair_neighbours(graph: &Multigraph, ends: &[EdgeEnd], partner: &mut [EdgeEnd]) {
    let n = ends.len();
    if n < 2 {
        return;
    }
    let shift = match ends.iter().position(|&end| graph.is_wall(end)) {
        Some(at) => at,
        None => usize::from(turning(graph, ends, 1) < turning(graph, ends, 0)),
    };
    for k in (0..n - 1).step_by(2) {
        let (a, b) = (ends[(k + shift) % n], ends[(k + 1 + shift) % n]);
        partner[a] = b;
        partner[b] = a;
    }
}

/// How sharply the strand turns when neighbours are paired from `shift` on: the sum of cosines between
/// the two headings of each pair (1 for a reversal, −1 for straight on).
fn turning(graph: &Multigraph, ends: &[EdgeEnd], shift: usize) -> f64 {
    let n = ends.len();
    let way = |end: EdgeEnd| {
        (graph.heading(end) - graph.positions[graph.vertex_at(end) as usize]).normalize_or_zero()
    };
    (0..n / 2).map(|k| way(ends[(2 * k + shift) % n]).dot(way(ends[(2 * k + 1 + shift) % n]))).sum()
}

/// Which ends lie on the same circuit.
fn label(partner: &[EdgeEnd]) -> Partition {
    let mut circuits = Partition::new(partner.len());
    for (end, &mate) in partner.iter().enumerate() {
        circuits.join(end, opposite(end));
        circuits.join(end, mate);
    }
    circuits
}

/// Exchanges pairs at one vertex until all its ends lie on one circuit.
fn merge_at(ends: &[EdgeEnd], partner: &mut [EdgeEnd], circuits: &mut Partition) {
    let n = ends.len();
    if n < 4 {
        return;
    }
    'again: loop {
        for x in 0..n {
            // The end after x in the rotation, skipping whole pairs: between them nothing lies.
            for gap in 0..n {
                let y = (x + 1 + gap) % n;
                let (a, b) = (ends[x], ends[y]);
                if y == x || !visible(ends, partner, x, y) {
                    continue;
                }
                if circuits.find(a) == circuits.find(b) {
                    continue;
                }
                let (pa, pb) = (partner[a], partner[b]);
                partner[a] = b;
                partner[b] = a;
                partner[pa] = pb;
                partner[pb] = pa;
                circuits.join(a, b);
                continue 'again;
            }
        }
        return;
    }
}

/// Whether no pair separates the ends at places x and y of the rotation.
fn visible(ends: &[EdgeEnd], partner: &[EdgeEnd], x: usize, y: usize) -> bool {
    let n = ends.len();
    let mut k = (x + 1) % n;
    while k != y {
        let mate = partner[ends[k]];
        // The partner must lie between x and y too.
        let mut inside = false;
        let mut j = (x + 1) % n;
        while j != y {
            inside |= ends[j] == mate;
            j = (j + 1) % n;
        }
        if !inside {
            return false;
        }
        k = (k + 1) % n;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cycle::Leg;
    use argil_curve::DVec2;

    fn alternate(rotation: &[EdgeEnd], first: (EdgeEnd, EdgeEnd), second: (EdgeEnd, EdgeEnd)) -> bool {
        let place = |end| rotation.iter().position(|&e| e == end).unwrap();
        let (a, b) = (place(first.0).min(place(first.1)), place(first.0).max(place(first.1)));
        let within = |end| (a < place(end)) && (place(end) < b);
        within(second.0) != within(second.1)
    }

    /// A grid of squares, each walked round: all inner vertices have four or eight ends.
    #[test]
    fn a_grid_of_squares_is_one_circuit_without_a_crossing() {
        let mut graph = Multigraph::default();
        let size = 5_u32;
        for y in 0..size {
            for x in 0..size {
                graph.vertex(DVec2::new(f64::from(x), f64::from(y)), None);
            }
        }
        for y in 0..size - 1 {
            for x in 0..size - 1 {
                let at = |dx, dy| (y + dy) * size + x + dx;
                let ring = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                for k in 0..4 {
                    graph.walk(ring[k], ring[(k + 1) % 4], Leg::Support);
                }
            }
        }
        graph.settle();
        let circuit = euler_circuit(&graph).unwrap();
        assert_eq!(circuit.visits.len(), graph.edges.len(), "every edge copy once");
        let mut walked = vec![0; graph.edges.len()];
        for visit in &circuit.visits {
            walked[visit.outgoing / 2] += 1;
        }
        assert!(walked.iter().all(|&times| times == 1));
        for a in &circuit.visits {
            for b in &circuit.visits {
                let v = graph.vertex_at(a.outgoing);
                if a != b && v == graph.vertex_at(b.outgoing) {
                    let round = &circuit.rotations[v as usize];
                    assert!(!alternate(round, (a.incoming, a.outgoing), (b.incoming, b.outgoing)));
                }
            }
        }
    }

    #[test]
    fn two_parts_are_an_error_with_a_place() {
        let mut graph = Multigraph::default();
        for x in [0.0, 1.0, 10.0, 11.0] {
            graph.vertex(DVec2::new(x, 0.0), None);
        }
        for (a, b) in [(0, 1), (2, 3)] {
            graph.walk(a, b, Leg::Joint);
            graph.walk(a, b, Leg::Joint);
        }
        // Doubled edges that nothing else connects are kept.
        graph.settle();
        assert!(matches!(euler_circuit(&graph), Err(RouteError::Disconnected { .. })));
    }
}
