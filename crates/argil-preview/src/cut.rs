//! Where a blade goes between the strand beside the model and the model's wall.

use argil_strand::{DVec2, Role};

/// How far from the middle of the wall's bead the blade goes, in bead widths: along the bead's edge.
const EDGE: f64 = 0.5;

/// The longest cut that is drawn to either side of its place, in bead widths.
const LONGEST: f64 = 6.0;

/// Runs whose ends are no farther apart than this are one wall that strand leaves on its way, in bead widths.
const ONE_WALL: f64 = 1.5;

/// How far along the strand from where it leaves the wall its side of the wall is told, in bead widths.
const BESIDE: f64 = 1.0;

/// The walls of one layer.
pub(crate) struct Walls {
    walls: Vec<Wall>,
    /// A point of strand for every place where it leaves or joins a wall, about a bead from there.
    roots: Vec<DVec2>,
    width: f64,
}

/// A run of moves that stay in the part.
struct Wall {
    points: Vec<DVec2>,
    closed: bool,
}

impl Walls {
    /// From the stretches of a layer, as the role of each and its points.
    pub(crate) fn new(stretches: &[(Role, Vec<DVec2>)], width: f64) -> Self {
        let near = |a: Option<&DVec2>, b: Option<&DVec2>| {
            a.zip(b).is_some_and(|(a, b)| a.distance(*b) <= ONE_WALL * width)
        };
        let mut runs: Vec<Vec<DVec2>> = Vec::new();
        for (_, points) in stretches.iter().filter(|(role, _)| role.is_model()) {
            match runs.last_mut() {
                Some(run) if near(run.last(), points.first()) => run.extend(points),
                _ => runs.push(points.clone()),
            }
        }
        // The strand is closed, so its last run may go on as its first.
        let first = runs.first().and_then(|run| run.first()).copied();
        if runs.len() > 1
            && let Some(last) = runs.pop_if(|run| near(run.last(), first.as_ref()))
        {
            runs[0].splice(0..0, last);
        }
        let wall = |points: Vec<DVec2>| Wall { closed: near(points.first(), points.last()), points };
        Self { walls: runs.into_iter().map(wall).collect(), roots: roots(stretches, BESIDE * width), width }
    }

    /// Where the blade goes at a place: at each root that what touches there reaches, if it is one of roots, and otherwise along the
    /// nearest wall.
    pub(crate) fn cuts(&self, at: DVec2, length: f64, at_roots: bool) -> Vec<Vec<DVec2>> {
        let reach = length / 2.0 + 1.5 * self.width;
        let near = |root: &&DVec2| at_roots && root.distance(at) <= reach;
        let sites: Vec<DVec2> = self.roots.iter().filter(near).copied().collect();
        if sites.is_empty() {
            return self.cut(at, length).into_iter().collect();
        }
        sites.iter().filter_map(|&site| self.cut(site, 0.0)).collect()
    }

    /// The line along the edge of the nearest wall, on the side of a place, as long as what touches there and at least one and a
    /// half bead. `None` where the layer has no wall.
    ///
    /// # Complexity
    /// O(n) in the moves of the layer.
    fn cut(&self, at: DVec2, length: f64) -> Option<Vec<DVec2>> {
        let (wall, edge, foot) = self.nearest(at)?;
        let (before, after) = wall.points.split_at(edge + 1);
        let round = |rest| if wall.closed { rest } else { &[][..] };
        let along = (after[0] - before[edge]).normalize_or_zero();
        let side = if along.perp_dot(at - foot) < 0.0 { -1.0 } else { 1.0 };
        let half = (length / 2.0).clamp(0.75 * self.width, LONGEST * self.width);
        let mut line = walked(before.iter().rev().chain(round(after).iter().rev()), foot, half);
        line.reverse();
        line.push(foot);
        line.extend(walked(after.iter().chain(round(before)), foot, half));
        line.dedup();
        if line.len() < 2 {
            return None;
        }
        let normal = |k: usize| (line[k + 1] - line[k]).normalize_or(along).perp();
        // The corner of both edges' offsets, unless the wall turns back there.
        let across = |k: usize| {
            let (before, after) = (normal(k.max(1) - 1), normal(k.min(line.len() - 2)));
            (before + after) / (1.0 + before.dot(after)).max(0.5)
        };
        let offset = side * EDGE * self.width;
        Some((0..line.len()).map(|k| line[k] + offset * across(k)).collect())
    }

    /// The wall that comes nearest to a place, which of its moves does, and where.
    fn nearest(&self, at: DVec2) -> Option<(&Wall, usize, DVec2)> {
        let moves =
            self.walls.iter().flat_map(|wall| wall.points.windows(2).enumerate().map(move |m| (wall, m)));
        let feet = moves.filter(|(_, (_, ends))| ends[0] != ends[1]);
        let feet = feet.map(|(wall, (k, ends))| (wall, k, foot(at, ends[0], ends[1])));
        feet.min_by(|a, b| at.distance_squared(a.2).total_cmp(&at.distance_squared(b.2)))
    }
}

/// For both ends of every run of strand beside the model the point that lies this far along it.
fn roots(stretches: &[(Role, Vec<DVec2>)], along: f64) -> Vec<DVec2> {
    let mut found = Vec::new();
    for run in stretches.chunk_by(|a, b| a.0.is_model() == b.0.is_model()) {
        if run.iter().any(|(role, _)| role.is_model()) {
            continue;
        }
        let points: Vec<DVec2> = run.iter().flat_map(|(_, points)| points).copied().collect();
        let (Some(&first), Some(&last)) = (points.first(), points.last()) else { continue };
        found.extend(walked(points.iter(), first, along).last());
        found.extend(walked(points.iter().rev(), last, along).last());
    }
    found
}

/// The point of a segment that is nearest to a place.
fn foot(at: DVec2, from: DVec2, to: DVec2) -> DVec2 {
    let along = to - from;
    let square = along.length_squared();
    let share = if square > 0.0 { ((at - from).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    from + along * share
}

/// The points that a walk of some length passes and ends at.
fn walked<'p>(points: impl Iterator<Item = &'p DVec2>, from: DVec2, length: f64) -> Vec<DVec2> {
    let (mut at, mut left) = (from, length);
    let mut line = Vec::new();
    for &next in points {
        let step = at.distance(next);
        if step >= left {
            line.push(at + (next - at) * (left / step.max(f64::MIN_POSITIVE)));
            break;
        }
        line.push(next);
        (at, left) = (next, left - step);
    }
    line
}

#[cfg(test)]
mod tests {
    use super::Walls;
    use argil_strand::{DVec2, Role};

    fn corner() -> Walls {
        let points = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)].map(DVec2::from);
        Walls::new(&[(Role::Wall, points[..2].to_vec()), (Role::Fill, points[1..].to_vec())], 2.0)
    }

    #[test]
    fn the_blade_goes_along_the_edge_on_the_side_of_the_place() {
        for (at, edge) in [(DVec2::new(4.0, 1.7), 1.0), (DVec2::new(4.0, -1.7), -1.0)] {
            let cut = corner().cut(at, 6.0).unwrap();
            assert!(cut.iter().all(|p| (p.y - edge).abs() < 1e-12), "{cut:?}");
            assert!((cut[0].x - 1.0).abs() < 1e-12 && (cut[cut.len() - 1].x - 7.0).abs() < 1e-12, "{cut:?}");
        }
    }

    #[test]
    fn a_cut_follows_the_wall_round_its_corner_and_ends_with_it() {
        let cut = corner().cut(DVec2::new(9.0, 1.5), 12.0).unwrap();
        let corners = [(5.5, 1.0), (9.0, 1.0), (9.0, 1.5), (9.0, 7.5)].map(DVec2::from);
        assert!(cut.len() == 4 && cut.iter().zip(corners).all(|(p, q)| p.distance(q) < 1e-12), "{cut:?}");
        let whole = corner().cut(DVec2::new(9.0, 1.5), 1e9).unwrap();
        assert!(whole[whole.len() - 1].y <= 10.0 && whole[0].x >= 0.0);
    }

    #[test]
    fn a_cut_goes_on_where_strand_leaves_the_wall() {
        let [a, b, c] = [(0.0, 0.0), (4.0, 0.0), (5.0, 0.0)].map(DVec2::from);
        let [d, e] = [(9.0, 0.0), (4.5, 9.0)].map(DVec2::from);
        let stretches = [
            (Role::Wall, vec![a, b]),
            (Role::Support, vec![b, e, c]),
            (Role::Wall, vec![c, d]),
            (Role::Connection, vec![d, e, a]),
        ];
        let cut = Walls::new(&stretches, 2.0).cut(DVec2::new(4.5, 1.0), 6.0).unwrap();
        assert!(cut.iter().all(|p| p.y == 1.0) && cut[0].x == 1.5 && cut[cut.len() - 1].x == 7.5, "{cut:?}");
    }

    #[test]
    fn roots_are_cut_at_both_walls_of_a_joint() {
        let [a, b, c, d] = [(0.0, -9.0), (0.0, 0.0), (7.0, 0.0), (7.0, 9.0)].map(DVec2::from);
        let stretches = [
            (Role::Wall, vec![a, b]),
            (Role::Support, vec![b, c]),
            (Role::Wall, vec![c, d]),
            (Role::Connection, vec![d, a]),
        ];
        let walls = Walls::new(&stretches, 2.0);
        let cuts = walls.cuts(DVec2::new(3.5, 0.0), 6.0, true);
        let edges: Vec<f64> = cuts.iter().map(|cut| cut[0].x).collect();
        assert_eq!(edges, [1.0, 6.0]);
        assert_eq!(walls.cuts(DVec2::new(3.0, 0.0), 6.0, false).len(), 1);
    }

    #[test]
    fn short_touches_have_a_cut_that_can_be_seen_and_bare_layers_have_none() {
        let cut = corner().cut(DVec2::new(4.0, 1.5), 0.0).unwrap();
        assert!((cut[cut.len() - 1].x - cut[0].x - 3.0).abs() < 1e-12, "{cut:?}");
        let only = [(Role::Support, vec![DVec2::ZERO, DVec2::X])];
        assert!(Walls::new(&only, 2.0).cut(DVec2::ZERO, 1.0).is_none());
    }
}
