//! Whether loops are simple and apart, decided on the rounded coordinates that are printed.

use argil_curve::Segment;
use glam::DVec2;

/// Loops must be farther than this many grid steps from each other: paths are led between them and
/// are rounded to the same grid.
const APART: f64 = 20.0;

/// Within a loop a vertex must be this many grid steps from every side that does not end in it.
const WITHIN: f64 = 4.0;

struct Side {
    ring: u32,
    /// Number of the side in its ring: it runs from vertex `number` to the next.
    number: u32,
    at: Segment,
}

/// For each loop, whether it crosses or nearly touches itself or another, or has no area.
///
/// # Complexity
/// Sides are sorted into cells about as large as a side is long; each is compared with those in the cells
/// that it meets. Near linear for loops whose sides are of similar length.
pub(crate) fn unsound(rings: &[Vec<DVec2>], grid: f64) -> Vec<bool> {
    let mut faulty: Vec<bool> = rings.iter().map(|ring| ring.len() < 3).collect();
    let sides: Vec<Side> = rings
        .iter()
        .enumerate()
        .filter(|(_, ring)| ring.len() >= 3)
        .flat_map(|(ring, points)| {
            (0..points.len()).map(move |number| Side {
                ring: ring as u32,
                number: number as u32,
                at: Segment::new(points[number], points[(number + 1) % points.len()]),
            })
        })
        .collect();
    let apart = APART * grid;
    for_each_near(&sides, apart, |a, b| {
        let (a, b) = (&sides[a], &sides[b]);
        let is_fault = if a.ring == b.ring {
            let count = rings[a.ring as usize].len() as u32;
            too_near_within(a, b, count, WITHIN * grid)
        } else {
            a.at.distance_to(&b.at) <= apart
        };
        if is_fault {
            faulty[a.ring as usize] = true;
            faulty[b.ring as usize] = true;
        }
    });
    faulty
}

/// Sides that follow each other share a vertex, and only their far ends can be too near.
fn too_near_within(a: &Side, b: &Side, count: u32, limit: f64) -> bool {
    let follows = |before: &Side, after: &Side| (before.number + 1) % count == after.number;
    let (before, after) = match (follows(a, b), follows(b, a)) {
        (true, _) => (a, b),
        (_, true) => (b, a),
        _ => return a.at.distance_to(&b.at) < limit,
    };
    after.at.distance(before.at.start) < limit || before.at.distance(after.at.end) < limit
}

/// Calls `visit` with every pair of sides whose boxes come within `reach` of each other, each pair once.
fn for_each_near(sides: &[Side], reach: f64, mut visit: impl FnMut(usize, usize)) {
    let low = |k: usize| sides[k].at.start.min(sides[k].at.end) - reach;
    let high = |k: usize| sides[k].at.start.max(sides[k].at.end);
    // Sweep along x with the sides that the sweep line meets kept in a list; loops of a layer
    // have few sides over any one x.
    let mut order: Vec<usize> = (0..sides.len()).collect();
    order.sort_by(|&a, &b| low(a).x.total_cmp(&low(b).x).then(a.cmp(&b)));
    let mut active: Vec<usize> = Vec::new();
    for &side in &order {
        let (left, bottom, top) = (low(side).x, low(side).y, high(side).y);
        active.retain(|&other| high(other).x >= left);
        for &other in &active {
            if low(other).y <= top && bottom <= high(other).y {
                visit(other, side);
            }
        }
        active.push(side);
    }
}
