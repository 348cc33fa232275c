//! The circuit drawn as a polyline: doubled edges become two lanes.
//!
//! A passage through a vertex is moved into its own free sector of the rotation, so that passages of the
//! same vertex come to lie beside each other in the order that the circuit gives them. Nothing crosses as long as the
//! offsets are small against the angles and edges round the vertex; where something does, after rounding to the
//! grid, the offsets of the vertices concerned are halved and in the end dropped: strands that
//! coincide touch, but do not cross. Where a channel is narrower than the lanes all along, a vertex without offset crosses to the next one
//! with it, so that offsets are dropped along the strand, farther each time.

use argil_curve::{DVec2, on_grid, self_crossings};

use crate::circuit::{Circuit, Visit};
use crate::cycle::{Cycle, Leg};
use crate::multigraph::{EdgeEnd, Multigraph};

/// Rounds of halving before an offset is dropped.
const HALVINGS: usize = 5;

/// Rounds in which offsets are dropped along the strand, twice as far each time: enough for any strand that is held.
const WIDENINGS: usize = 32;

/// A vertex of the drawn cycle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawn {
    pub(crate) at: DVec2,
    pub(crate) vertex: Option<u32>,
    pub(crate) fixed: bool,
    pub(crate) carries: Option<usize>,
    pub(crate) leg: Leg,
}

/// Draws the circuit with lanes `lane` mm beside doubled edges, vertices at most `spacing` mm apart on
/// free stretches, on the given grid.
pub(crate) fn draw(graph: &Multigraph, circuit: &Circuit, lane: f64, spacing: f64, grid: f64) -> Cycle {
    let carrier = carriers(graph, circuit);
    let mut offsets = vec![lane; graph.positions.len()];
    let mut drawn = polyline(graph, circuit, &carrier, &offsets, grid);
    for round in 0..=2 * HALVINGS + WIDENINGS {
        let points: Vec<DVec2> = drawn.iter().map(|d| d.at).collect();
        let crossings = self_crossings(&points);
        if crossings.is_empty() {
            break;
        }
        let n = drawn.len();
        let mut shrunk = false;
        for crossing in crossings {
            let reach = round.checked_sub(2 * HALVINGS + 1).map_or(0, |further| n.min(1 << further));
            let about = |k: usize| k + n - reach..=k + n + 1 + reach;
            for k in about(crossing.first).chain(about(crossing.second)) {
                if let Some(vertex) = drawn[k % n].vertex {
                    let offset = &mut offsets[vertex as usize];
                    shrunk |= *offset > 0.0;
                    *offset = if round < HALVINGS { 0.5 * *offset } else { 0.0 };
                }
            }
        }
        if !shrunk {
            break;
        }
        drawn = polyline(graph, circuit, &carrier, &offsets, grid);
    }
    subdivided(&drawn, spacing, grid, roots(graph, circuit))
}

/// How often the strand leaves a wall for an excursion.
fn roots(graph: &Multigraph, circuit: &Circuit) -> usize {
    circuit.visits.iter().filter(|v| graph.is_wall(v.incoming) && !graph.is_wall(v.outgoing)).count()
}

/// The visit that passes exactly through each vertex with a demand: one that is hemmed in on both sides
/// if there is one, else the first.
fn carriers(graph: &Multigraph, circuit: &Circuit) -> Vec<Option<usize>> {
    let mut carrier: Vec<Option<usize>> = vec![None; graph.positions.len()];
    for (k, visit) in circuit.visits.iter().enumerate() {
        let vertex = graph.vertex_at(visit.outgoing) as usize;
        if graph.demand[vertex].is_none() {
            continue;
        }
        let hemmed = matches!(sector(&circuit.rotations[vertex], *visit), Sector::None);
        if carrier[vertex].is_none() || hemmed {
            carrier[vertex] = Some(k);
        }
    }
    carrier
}

/// The free sector beside a visit.
enum Sector {
    /// Counter-clockwise from the incoming to the outgoing end.
    Left,
    /// Counter-clockwise from the outgoing to the incoming end.
    Right,
    /// Nothing else passes the vertex.
    Whole,
    /// Other visits lie on both sides.
    None,
}

fn sector(rotation: &[EdgeEnd], visit: Visit) -> Sector {
    let n = rotation.len();
    let place = |end| rotation.iter().position(|&e| e == end).unwrap_or_default();
    let (a, b) = (place(visit.incoming), place(visit.outgoing));
    match ((b + n - a) % n, (a + n - b) % n) {
        _ if n == 2 => Sector::Whole,
        (1, _) => Sector::Left,
        (_, 1) => Sector::Right,
        _ => Sector::None,
    }
}

fn polyline(
    graph: &Multigraph,
    circuit: &Circuit,
    carrier: &[Option<usize>],
    offsets: &[f64],
    grid: f64,
) -> Vec<Drawn> {
    let mut drawn: Vec<Drawn> = Vec::new();
    let mut corner = Vec::with_capacity(3);
    for (k, &visit) in circuit.visits.iter().enumerate() {
        let vertex = graph.vertex_at(visit.outgoing);
        let outgoing = &graph.edges[visit.outgoing / 2];
        let fixed = graph.is_wall(visit.incoming) || graph.is_wall(visit.outgoing);
        let carries = carrier[vertex as usize] == Some(k);
        corner.clear();
        if fixed {
            corner.push(graph.positions[vertex as usize]);
        } else {
            let rotation = &circuit.rotations[vertex as usize];
            turn(graph, rotation, visit, carries, offsets[vertex as usize], &mut corner);
        }
        let middle = corner.len() / 2;
        for (q, &at) in corner.iter().enumerate() {
            let at = if fixed { at } else { on_grid(at, grid) };
            let carries = if carries && q == middle { graph.demand[vertex as usize] } else { None };
            push(&mut drawn, Drawn { at, vertex: Some(vertex), fixed, carries, leg: outgoing.leg });
        }
        let mut along = |at: DVec2| {
            push(&mut drawn, Drawn { at, vertex: None, fixed: true, carries: None, leg: Leg::Wall });
        };
        if visit.outgoing % 2 == 0 {
            outgoing.via.iter().for_each(|&p| along(p));
        } else {
            outgoing.via.iter().rev().for_each(|&p| along(p));
        }
    }
    // The walk is closed: the last vertex must not repeat the first.
    while drawn.len() > 1 && drawn[0].at == drawn[drawn.len() - 1].at {
        let last = drawn.remove(drawn.len() - 1);
        drawn[0].fixed |= last.fixed;
        drawn[0].carries = drawn[0].carries.or(last.carries);
    }
    drawn
}

/// Appends a vertex, or folds it into the last one where both round to the same place.
pub(crate) fn push(drawn: &mut Vec<Drawn>, next: Drawn) {
    match drawn.last_mut() {
        Some(last) if last.at == next.at && (last.carries.is_none() || next.carries.is_none()) => {
            last.fixed |= next.fixed;
            last.carries = last.carries.or(next.carries);
            last.leg = next.leg;
        }
        _ => drawn.push(next),
    }
}

/// The points by which a visit passes its vertex.
fn turn(
    graph: &Multigraph,
    rotation: &[EdgeEnd],
    visit: Visit,
    carries: bool,
    offset: f64,
    out: &mut Vec<DVec2>,
) {
    let centre = graph.positions[graph.vertex_at(visit.outgoing) as usize];
    let (to_in, to_out) = (graph.heading(visit.incoming) - centre, graph.heading(visit.outgoing) - centre);
    let room = 0.4 * to_in.length().min(to_out.length());
    let offset = offset.min(room);
    let (u_in, u_out) = (to_in.normalize_or_zero(), to_out.normalize_or_zero());
    let reversal = graph.heading(visit.incoming) == graph.heading(visit.outgoing);
    let kind = sector(rotation, visit);
    if offset <= 0.0 || (carries && !(reversal && matches!(kind, Sector::Whole))) {
        out.push(centre);
        return;
    }
    if reversal {
        // Seen from the vertex, the end that comes first counter-clockwise is the lane on the right.
        let place = |end| rotation.iter().position(|&e| e == end).unwrap_or_default();
        let first_in = match kind {
            Sector::Left => true,
            Sector::Right => false,
            _ => place(visit.incoming) < place(visit.outgoing),
        };
        let side = if first_in { -u_in.perp() } else { u_in.perp() };
        match kind {
            Sector::Whole => {
                out.extend([centre + offset * side, centre, centre - offset * side]);
            }
            Sector::None => out.push(centre),
            _ => {
                let tip = centre + 1.5 * offset.min(room / 1.5) * u_in;
                out.extend([tip + 0.5 * offset * side, tip - 0.5 * offset * side]);
            }
        }
        return;
    }
    // The sector runs counter-clockwise from `first` to `second`.
    let (first, second, forward) = match kind {
        Sector::Left => (u_in, u_out, true),
        Sector::Right => (u_out, u_in, false),
        Sector::Whole | Sector::None => {
            out.push(centre);
            return;
        }
    };
    let angle = first.perp_dot(second).atan2(first.dot(second)).rem_euclid(std::f64::consts::TAU);
    let bisector = first.rotate(DVec2::from_angle(0.5 * angle));
    if angle > 1.5 * std::f64::consts::PI {
        let round =
            [centre + offset * first.perp(), centre + offset * bisector, centre - offset * second.perp()];
        if forward {
            out.extend(round);
        } else {
            out.extend(round.iter().rev());
        }
        return;
    }
    out.push(centre + (offset / (0.5 * angle).sin().max(0.5)).min(room) * bisector);
}

/// Splits free stretches into pieces of at most `spacing` and gathers the cycle.
pub(crate) fn subdivided(drawn: &[Drawn], spacing: f64, grid: f64, roots: usize) -> Cycle {
    let mut cycle = Cycle { roots, ..Cycle::default() };
    let n = drawn.len();
    for (k, d) in drawn.iter().enumerate() {
        if let Some(demand) = d.carries {
            cycle.carriers.push((cycle.points.len(), demand));
        }
        cycle.points.push(d.at);
        cycle.fixed.push(d.fixed);
        cycle.legs.push(d.leg);
        let next = drawn[(k + 1) % n].at;
        if d.leg == Leg::Wall {
            continue;
        }
        let pieces = (d.at.distance(next) / spacing).ceil().clamp(1.0, 1e6) as usize;
        for piece in 1..pieces {
            let at = on_grid(d.at.lerp(next, piece as f64 / pieces as f64), grid);
            if cycle.points.last() != Some(&at) && at != next {
                cycle.points.push(at);
                cycle.fixed.push(false);
                cycle.legs.push(d.leg);
            }
        }
    }
    cycle
}
