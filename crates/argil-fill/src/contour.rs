//! Lines of equal distance on a grid, with their corners.

use argil_curve::{DVec2, Segment};

/// What is known at a point of the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) at: DVec2,
    /// Distance from its site, mm; not positive where there is no site.
    pub(crate) distance: f64,
    pub(crate) site: u32,
    /// The distance that its line has.
    pub(crate) level: f64,
}

/// Strips that are wider than twice this, in steps of the grid, hang together on it in any direction.
const THIN: f64 = 0.72;

/// A vertex in a cell of the grid, and the sides of the cell by which its line comes in and goes out; inside is on the left.
#[derive(Clone, Copy, Debug)]
struct Turn {
    at: DVec2,
    level: f64,
    /// The greatest distance at a corner of the cell or next to one, mm.
    deepest: f64,
    enters: u64,
    leaves: u64,
}

/// Lines round where the distance exceeds the level of a point, with the level of each.
///
/// Dual contouring (Ju et al. 2002, <https://doi.org/10.1145/566654.566586>): each cell that a line goes through has one vertex, where the
/// tangents at its sides meet, so that straight stretches and corners come out as they are. The cells are those of the line that is
/// `slight` (mm) farther in, whose tangents are then moved out by as much: no part is thinner than twice that. Parts that touch at a corner
/// of the grid only are parted. Parts that are so thin that the grid may see but pieces of them have no line.
///
/// `cells` are the low corners of the cells in some order, `corners` are asked for their corners in turn, `distance` for the
/// points about them.
///
/// # Complexity
/// O(cells + vertices · log vertices).
pub(crate) fn contours(
    cells: impl Iterator<Item = (usize, usize)>,
    sites: &[Segment],
    step: f64,
    slight: f64,
    corners: impl Fn(usize, usize) -> Option<[Spot; 4]>,
    distance: impl Fn(usize, usize) -> f64,
) -> Vec<(f64, Vec<DVec2>)> {
    let mut turns: Vec<Turn> = Vec::new();
    for (column, row) in cells {
        let Some(spots) = corners(column, row) else { continue };
        let inside = spots.map(|spot| spot.distance > spot.level + slight);
        if inside[0] == inside[1] && inside[1] == inside[2] && inside[2] == inside[3] {
            continue;
        }
        for first in (0..4).filter(|&k| inside[k] && !inside[(k + 3) % 4]) {
            let mut last = first;
            while inside[(last + 1) % 4] {
                last = (last + 1) % 4;
            }
            let before = (first + 3) % 4;
            let leaves = crossing(&spots[first], &spots[before], sites, slight);
            let enters = crossing(&spots[last], &spots[(last + 1) % 4], sites, slight);
            let is_saddle = first == last && inside[(first + 2) % 4];
            let at = if is_saddle {
                leaves.0.midpoint(enters.0)
            } else {
                corner(leaves, enters, slight, [spots[0].at, spots[2].at])
            };
            let (enters, leaves) = (side(column, row, last), side(column, row, before));
            let about = (row.saturating_sub(1)..=row + 2)
                .flat_map(|r| (column.saturating_sub(1)..=column + 2).map(move |c| (c, r)));
            let deepest = about.map(|(c, r)| distance(c, r)).fold(0.0, f64::max);
            turns.push(Turn { at, level: spots[first].level, deepest, enters, leaves });
        }
    }
    linked(&turns, slight + THIN * step)
}

/// The number of a cell's side: of the point where it begins, and whether it is upright.
fn side(column: usize, row: usize, side: usize) -> u64 {
    let (column, row, upright) = match side {
        0 => (column, row, 0),
        1 => (column + 1, row, 1),
        2 => (column, row + 1, 0),
        _ => (column, row, 1),
    };
    ((row as u64) << 32 | column as u64) << 1 | upright
}

/// Where the line that is farther in crosses between a point inside and one outside, and the direction inwards.
fn crossing(inner: &Spot, outer: &Spot, sites: &[Segment], slight: f64) -> (DVec2, DVec2) {
    let level = inner.level + slight;
    let candidates = [inner, outer].map(|spot| sites.get(spot.site as usize));
    let look = |p: DVec2| {
        let near = candidates.iter().flatten().map(|site| site.nearest(p));
        near.min_by(|a, b| a.distance.total_cmp(&b.distance))
    };
    // False position: exact at once where both have the same straight site.
    let (mut low, mut high) = ((0.0, inner.distance - level), (1.0, outer.distance - level));
    let mut found = (inner.at.midpoint(outer.at), inner.at - outer.at);
    for _ in 0..3 {
        let t = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
        let p = inner.at.lerp(outer.at, t);
        let Some(near) = look(p) else { break };
        found = (p, p - near.point);
        let excess = near.distance - level;
        if excess.abs() < 1e-6 * level {
            break;
        }
        if excess > 0.0 {
            low = (t, excess);
        } else {
            high = (t, excess);
        }
    }
    found
}

/// Tangents that turn by less than this make no corner; the sine of the angle.
const LEAST_TURN: f64 = 0.2;

/// Where the tangents at two crossings meet once they are moved out, or as far towards it from between them as the cell reaches;
/// the middle between them where they hardly turn.
fn corner(leaves: (DVec2, DVec2), enters: (DVec2, DVec2), slight: f64, [low, high]: [DVec2; 2]) -> DVec2 {
    let (a, b) = (leaves.1.normalize_or_zero(), enters.1.normalize_or_zero());
    let turn = a.perp_dot(b);
    let middle = leaves.0.midpoint(enters.0);
    if turn.abs() < LEAST_TURN {
        return middle - slight * (a + b).normalize_or_zero();
    }
    let (c, d) = (a.dot(leaves.0 - middle) - slight, b.dot(enters.0 - middle) - slight);
    let towards = DVec2::new(c * b.y - d * a.y, d * a.x - c * b.x) / turn;
    // How far the cell reaches along either axis, as a share of the way.
    let share = |from: f64, way: f64, low: f64, high: f64| match way {
        _ if way > 0.0 => (high - from) / way,
        _ if way < 0.0 => (low - from) / way,
        _ => 1.0,
    };
    let along = share(middle.x, towards.x, low.x, high.x).min(share(middle.y, towards.y, low.y, high.y));
    middle + along.clamp(0.0, 1.0) * towards
}

/// The vertices in their order along closed lines, without those round parts whose inside is no deeper than `thin`.
fn linked(turns: &[Turn], thin: f64) -> Vec<(f64, Vec<DVec2>)> {
    let mut entries: Vec<(u64, usize)> = turns.iter().enumerate().map(|(k, turn)| (turn.enters, k)).collect();
    entries.sort_unstable();
    let after = |turn: &Turn| {
        let found = entries.binary_search_by_key(&turn.leaves, |entry| entry.0);
        found.ok().map(|place| entries[place].1)
    };
    let mut used = vec![false; turns.len()];
    let mut lines = Vec::new();
    for start in 0..turns.len() {
        let mut points = Vec::new();
        let mut deepest = 0.0_f64;
        let mut next = Some(start);
        while let Some(k) = next
            && !used[k]
        {
            used[k] = true;
            points.push(turns[k].at);
            deepest = deepest.max(turns[k].deepest);
            next = after(&turns[k]);
        }
        // A line that leaves the grid is none.
        let level = turns[start].level;
        if next == Some(start) && points.len() > 2 && deepest >= level + thin {
            lines.push((level, points));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nearest::Nearest;
    use crate::plot::Plot;

    const SLIGHT: f64 = 0.02;

    /// The lines at a distance from the sides of a polygon, inside of it.
    fn lines(corners: &[DVec2], level: f64) -> Vec<(f64, Vec<DVec2>)> {
        let n = corners.len();
        let sides: Vec<Segment> = (0..n).map(|k| Segment::new(corners[k], corners[(k + 1) % n])).collect();
        let plot = Plot::new(&sides, 0.2).expect("it is small").expect("it has an inside");
        let nearest = Nearest::new(&plot, &sides);
        let cells =
            plot.runs.iter().flat_map(|&(row, first, last)| (first - 1..=last).map(move |c| (c, row)));
        let spots = |column: usize, row: usize| {
            let corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
            Some(corners.map(|(column, row)| {
                let (distance, site) = (nearest.distance(column, row), nearest.site(column, row));
                Spot { at: plot.at(column, row), distance, site, level }
            }))
        };
        contours(cells, &sides, plot.step, SLIGHT, spots, |column, row| nearest.distance(column, row))
    }

    fn turned(corners: &[(f64, f64)], angle: f64) -> Vec<DVec2> {
        corners.iter().map(|&corner| DVec2::from_angle(angle).rotate(corner.into())).collect()
    }

    #[test]
    fn straight_sides_and_corners_come_out_as_they_are() {
        for angle in [0.0, 0.3, 0.7, 1.2] {
            let found = lines(&turned(&[(0.0, 0.0), (9.0, 0.0), (9.0, 6.0), (0.0, 6.0)], angle), 1.0);
            assert_eq!(found.len(), 1, "at {angle}");
            let points = &found[0].1;
            let ring = turned(&[(1.0, 1.0), (8.0, 1.0), (8.0, 5.0), (1.0, 5.0)], angle);
            let sides: Vec<Segment> = (0..4).map(|k| Segment::new(ring[k], ring[(k + 1) % 4])).collect();
            for &p in points {
                let off = sides.iter().map(|side| side.distance(p)).fold(f64::INFINITY, f64::min);
                // A right angle that pokes through the side of a cell between two points is cut by half a step at most.
                let at_corner = ring.iter().any(|corner| corner.distance(p) < 0.3);
                assert!(
                    off < if at_corner { 0.1 * std::f64::consts::FRAC_1_SQRT_2 } else { 1e-3 },
                    "{p} lies {off} off at {angle}"
                );
            }
            for corner in ring {
                let near = points.iter().map(|p| p.distance(corner)).fold(f64::INFINITY, f64::min);
                assert!(near < 0.15, "no vertex near {corner} at {angle}: {near}");
            }
            let doubled: f64 =
                (0..points.len()).map(|k| points[k].perp_dot(points[(k + 1) % points.len()])).sum();
            assert!(doubled > 0.0 && (0.5 * doubled - 28.0).abs() < 0.1, "{doubled} at {angle}");
        }
    }

    #[test]
    fn a_neck_parts_lines_and_slivers_have_none() {
        let bell = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 1.2),
            (6.0, 1.2),
            (6.0, 0.0),
            (10.0, 0.0),
            (10.0, 4.0),
            (6.0, 4.0),
            (6.0, 2.8),
            (4.0, 2.8),
            (4.0, 4.0),
            (0.0, 4.0),
        ];
        assert_eq!(lines(&turned(&bell, 0.2), 0.5).len(), 1);
        assert_eq!(lines(&turned(&bell, 0.2), 1.0).len(), 2);
        let strip = [(0.0, 0.0), (9.0, 0.0), (9.0, 2.1), (0.0, 2.1)];
        assert_eq!(lines(&turned(&strip, 0.5), 1.0).len(), 0);
    }
}
