//! Runs of short moves as arcs.

/// Moves that an arc must stand for, at least: fewer are no shorter as an arc.
const LEAST_MOVES: usize = 3;

/// Moves that an arc stands for, at most. It bounds the work, which goes with the square of it.
const MOST_MOVES: usize = 128;

/// How far an arc may turn, radians: well below a full turn, which firmware tells from none at all by rounding.
const MOST_TURN: f64 = 5.0;

/// Radius in lengths of the arc from which on it is called straight: firmware would reckon its angle from differences
/// that have no digits left.
const STRAIGHT: f64 = 1e4;

/// An arc from a point to a later one of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FittedArc {
    /// How many moves it stands for.
    pub(crate) moves: usize,
    /// The centre from the start, in grid steps.
    pub(crate) centre: [i64; 2],
    pub(crate) clockwise: bool,
}

/// The longest arc at the beginning of a run of points on a grid, such that arc and moves are nowhere farther apart
/// than `tolerance` grid steps.
pub(crate) fn longest_arc(points: &[[i64; 2]], tolerance: f64) -> Option<FittedArc> {
    let most = points.len().saturating_sub(1).min(MOST_MOVES);
    let mut found = None;
    for moves in LEAST_MOVES..=most {
        match fit(&points[..=moves], tolerance) {
            Some(arc) => found = Some(arc),
            // Points that left the arc do not come back to it.
            None => break,
        }
    }
    found
}

fn fit(points: &[[i64; 2]], tolerance: f64) -> Option<FittedArc> {
    let start = *points.first()?;
    let local: Vec<[f64; 2]> =
        points.iter().map(|p| [(p[0] - start[0]) as f64, (p[1] - start[1]) as f64]).collect();
    let end = *local.last()?;
    let exact = centre_through(*local.get(local.len() / 2)?, end)?;
    // The centre is written on the grid, so it is reckoned with on the grid.
    let [cx, cy] = exact.map(f64::round);
    let radius = cx.hypot(cy);
    let length: f64 = local.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
    if !(radius > 0.0 && radius < STRAIGHT * length) {
        return None;
    }
    let turn = |a: [f64; 2], b: [f64; 2]| {
        let (a, b) = ([a[0] - cx, a[1] - cy], [b[0] - cx, b[1] - cy]);
        (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
    };
    let clockwise = turn(local[0], local[1]) < 0.0;
    let mut turned = 0.0;
    for pair in local.windows(2) {
        let angle = turn(pair[0], pair[1]);
        turned += angle.abs();
        let off = (distance(pair[1], [cx, cy]) - radius).abs();
        let bulge = radius * (1.0 - (angle / 2.0).cos());
        if (angle < 0.0) != clockwise || angle == 0.0 || off + bulge > tolerance || turned > MOST_TURN {
            return None;
        }
    }
    let centre = [cx as i64, cy as i64];
    Some(FittedArc { moves: points.len() - 1, centre, clockwise })
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The centre of the circle through the origin and two points.
fn centre_through([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> Option<[f64; 2]> {
    let twice = 2.0 * (ax * by - ay * bx);
    let (a, b) = (ax * ax + ay * ay, bx * bx + by * by);
    let centre = [(by * a - ay * b) / twice, (ax * b - bx * a) / twice];
    // Points in a line have no circle: the division gives no finite number, or one too large to be exact.
    centre.iter().all(|value| value.abs() < 9e15).then_some(centre)
}

#[cfg(test)]
mod tests {
    use super::longest_arc;

    fn circle(radius: f64, step: f64, count: usize) -> Vec<[i64; 2]> {
        (0..=count)
            .map(|k| {
                let (sin, cos) = (step * k as f64).sin_cos();
                [radius * cos, radius * sin].map(|value| value.round() as i64)
            })
            .collect()
    }

    #[test]
    fn a_circle_is_found_and_a_line_or_a_corner_is_not() {
        let arc = longest_arc(&circle(1e5, 0.05, 60), 200.0).unwrap();
        assert_eq!((arc.moves, arc.clockwise), (60, false));
        assert!((arc.centre[0] + 100_000).abs() < 3 && arc.centre[1].abs() < 3, "{:?}", arc.centre);
        let back: Vec<_> = circle(1e5, 0.05, 60).into_iter().rev().collect();
        assert!(longest_arc(&back, 200.0).unwrap().clockwise);
        let line: Vec<_> = (0..20).map(|k| [1000 * k, 700 * k]).collect();
        assert_eq!(longest_arc(&line, 200.0), None);
        let corner = [[0, 0], [10_000, 0], [10_000, 10_000], [0, 10_000]];
        assert_eq!(longest_arc(&corner, 200.0), None);
    }

    #[test]
    fn an_arc_ends_where_points_leave_it() {
        let mut points = circle(1e5, 0.02, 20);
        let [x, y] = points[20];
        points.extend((1..20).map(|k| [x - 3000 * k, y - 1000 * k]));
        let arc = longest_arc(&points, 10.0).unwrap();
        assert!((19..=21).contains(&arc.moves), "{}", arc.moves);
    }
}
