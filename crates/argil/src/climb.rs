//! From planned cycles to the strand: where each layer begins, and the steps in between.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil_route::Leg;
use argil_strand::{Move, Role, Strand, StrandLayer, SupportSource};

use crate::descent::PlannedLayer;
use crate::stages::Seam;
use crate::{PlanError, Settings};

/// What a start on a wall costs against one on free strand, in w²: the seam shows on a wall, while clay that is cut
/// away hides it. A quarter of the longest step squared, so that it never outweighs a good chain.
const VISIBLE: f64 = 0.13;
/// What a start on a wall costs beside a root, in w²: a step that comes from the other side of the wall would make the strand
/// pass straight through it.
const BESIDE_ROOT: f64 = 1.0;
/// How near to a root that is, in w.
const ROOT_REACH: f64 = 0.8;

/// A start gives way along its cycle in shifts of this, in w, so many times at most.
const SHIFT: f64 = 0.02;
const SHIFTS: i32 = 60;

/// Joins the cycles by a chain of starts.
pub(crate) fn strand(
    layers: &[PlannedLayer],
    seam: &mut impl Seam,
    settings: &Settings,
) -> Result<Strand, PlanError> {
    let width = settings.width;
    let cycles: Vec<ClosedCurve> = layers.iter().map(|layer| layer.curve.clone()).collect();
    let walls: Vec<SegmentIndex> = layers.iter().map(|layer| wall_segments(layer, width)).collect();
    let roots: Vec<Vec<DVec2>> = layers.iter().map(roots).collect();
    let cost = |k: usize, p: DVec2| {
        if walls[k].nearest_within(p, 0.1 * width).is_none() {
            return 0.0;
        }
        let beside = roots[k].iter().any(|root| root.distance(p) < ROOT_REACH * width);
        (VISIBLE + if beside { BESIDE_ROOT } else { 0.0 }) * width * width
    };
    let footholds: Vec<f64> = layers.iter().map(|layer| layer.foothold).collect();
    let starts = seam.starts(&cycles, &footholds, settings, &cost)?;
    let mut strand_layers = Vec::with_capacity(layers.len());
    let mut first: Option<DVec2> = None;
    let mut below = None;
    for (layer, &start) in layers.iter().zip(&starts) {
        let (begin, mut moves) = match below {
            None => opened(layer, start, settings.grid),
            Some((from, below)) => clear_start(layer, start, from, below, settings),
        };
        match first {
            None => first = Some(begin),
            Some(_) => moves.insert(0, Move { to: begin, role: Role::Seam }),
        }
        below = Some((begin, &layer.curve));
        let supports =
            layer.supports.iter().map(|s| SupportSource { at: s.position, needs: s.needs.clone() }).collect();
        strand_layers.push(StrandLayer {
            index: layer.report.index,
            z: layer.z,
            height: settings.layer_height,
            width,
            moves,
            supports,
        });
    }
    Ok(Strand::new(first.unwrap_or_default(), strand_layers)?)
}

/// The cycle opened at `start`, or at the nearest place along it to which the step from the layer below is clear, held
/// and short enough: a step that runs along the very strand that it ends on may cross it by one step of the grid after
/// rounding, and a start that had to give way on the layer below is made up for here.
fn clear_start(
    layer: &PlannedLayer,
    start: f64,
    from: DVec2,
    below: &ClosedCurve,
    settings: &Settings,
) -> (DVec2, Vec<Move>) {
    let seam = settings.seaming();
    let sound = |opened: &(DVec2, Vec<Move>)| {
        from.distance(opened.0) <= seam.reach
            && below.nearest(opened.0).distance <= seam.across
            && is_clear(from, opened)
    };
    let wanted = opened(layer, start, settings.grid);
    if sound(&wanted) {
        return wanted;
    }
    (1..=SHIFTS)
        .flat_map(|k| [1.0, -1.0].map(|side| start + side * f64::from(k) * SHIFT * settings.width))
        .map(|arc| opened(layer, arc.rem_euclid(layer.curve.length()), settings.grid))
        .find(sound)
        .unwrap_or(wanted)
}

/// Whether the step from `from` to an opened cycle crosses none of its stretches, and neither do the two that meet in
/// its beginning: cut in two on the grid, a stretch that touches a wall may cross it.
fn is_clear(from: DVec2, (begin, moves): &(DVec2, Vec<Move>)) -> bool {
    let ends = std::iter::once(*begin).chain(moves.iter().map(|m| m.to));
    let stretches: Vec<Segment> = ends.zip(moves).map(|(start, m)| Segment::new(start, m.to)).collect();
    let step = Segment::new(from, *begin);
    let around = [Some(&step), stretches.first(), stretches.last()];
    around.into_iter().flatten().all(|near| !stretches.iter().any(|stretch| stretch.crosses(near)))
}

/// Where the strand of a layer leaves and joins walls.
fn roots(layer: &PlannedLayer) -> Vec<DVec2> {
    let n = layer.legs.len();
    let on_wall = |k: usize| layer.legs[k % n] == Leg::Wall;
    (0..n).filter(|&k| on_wall(k) != on_wall(k + n - 1)).map(|k| layer.curve.points()[k]).collect()
}

/// The wall stretches of a layer.
fn wall_segments(layer: &PlannedLayer, width: f64) -> SegmentIndex {
    let walls = layer.curve.segments().zip(&layer.legs).filter(|(_, leg)| **leg == Leg::Wall).map(|(s, _)| s);
    SegmentIndex::new(walls.collect(), width)
}

/// The cycle as moves from its start at the given arc back to it.
fn opened(layer: &PlannedLayer, start: f64, grid: f64) -> (DVec2, Vec<Move>) {
    let curve = &layer.curve;
    let points = curve.points();
    let n = points.len();
    let on = curve.locate(start);
    let exact = curve.point_at(start);
    let role = |k: usize| match layer.legs[k % n] {
        Leg::Wall => Role::Wall,
        Leg::Support => Role::Support,
        Leg::Joint => Role::Connection,
    };
    let near = |p: DVec2| p.distance(exact) <= 10.0 * grid;
    let (begin, first) = if near(points[on.segment]) {
        (points[on.segment], on.segment)
    } else if near(points[(on.segment + 1) % n]) {
        (points[(on.segment + 1) % n], on.segment + 1)
    } else {
        ((exact / grid).round() * grid, on.segment)
    };
    let mut moves: Vec<Move> =
        (0..n).map(|k| Move { to: points[(first + k + 1) % n], role: role(first + k) }).collect();
    if begin != points[first % n] {
        moves.push(Move { to: begin, role: role(first) });
    }
    (begin, moves)
}
