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
/// How far from roots starts on a wall keep, in w, where there is a chain of such starts: a step that comes from the other side of the
/// wall would make the strand pass straight through it, with less than a bead along the wall between. The second is tried
/// where the first leaves no chain.
const ROOT_REACH: [f64; 2] = [1.1, 0.6];
/// Most prints have a chain of steps this part as long as they may be. A long step sags, so it is tried first at both
/// distances from roots.
const SHORT: f64 = 0.5;
/// What a start right at a root costs where neither does, in w²; less with the square of the distance.
const AT_ROOT: f64 = 4.0;

/// A start gives way along its cycle in shifts of this, in w, so many times at most before other parts of the cycle are tried.
const SHIFT: f64 = 0.02;
const SHIFTS: i32 = 60;

/// Joins the cycles by a chain of starts. Where they are not `checked`, the starts stay where the seam stage wants them.
pub(crate) fn strand(
    layers: &[PlannedLayer],
    seam: &mut impl Seam,
    settings: &Settings,
    checked: bool,
) -> Result<Strand, PlanError> {
    let width = settings.width;
    let cycles: Vec<ClosedCurve> = layers.iter().map(|layer| layer.curve.clone()).collect();
    let sights: Vec<Sight> = layers.iter().map(|layer| Sight::of(layer, width)).collect();
    let footholds: Vec<f64> = layers.iter().map(|layer| layer.foothold).collect();
    let longest = settings.seaming().reach;
    let mut chain = |reach: f64, beside_root: &dyn Fn(f64) -> f64| {
        let cost = |k: usize, p: DVec2| {
            let visible = |from_root: f64| (VISIBLE + beside_root(from_root)) * width * width;
            sights[k].on_wall(p).map_or(0.0, visible)
        };
        seam.starts(&cycles, &footholds, reach, settings, &cost)
    };
    let [far, near] = ROOT_REACH;
    let beyond = |reach: f64| move |from_root: f64| if from_root < reach { f64::INFINITY } else { 0.0 };
    let graded = |from_root: f64| AT_ROOT * (1.0 - from_root / far).max(0.0).powi(2);
    let starts = chain(SHORT * longest, &beyond(far))
        .or_else(|_| chain(SHORT * longest, &beyond(near)))
        .or_else(|_| chain(longest, &beyond(far)))
        .or_else(|_| chain(longest, &beyond(near)))
        .or_else(|_| chain(longest, &graded))?;
    let mut strand_layers = Vec::with_capacity(layers.len());
    let mut first: Option<DVec2> = None;
    let mut below = None;
    for ((layer, sight), &start) in layers.iter().zip(&sights).zip(&starts) {
        let (begin, mut moves) = match below {
            Some((from, below)) if checked => clear_start((layer, sight), start, from, below, settings),
            _ => opened(layer, start, settings.grid),
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
/// rounding, and a start that had to give way on the layer below is made up for here. Where no place nearby will do, another part of the
/// cycle may.
fn clear_start(
    (layer, sight): (&PlannedLayer, &Sight),
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
    let (length, shift) = (layer.curve.length(), SHIFT * settings.width);
    let nearby = (1..=SHIFTS).flat_map(|k| [1.0, -1.0].map(|side| start + side * f64::from(k) * shift));
    let count = (length / shift).ceil().clamp(1.0, 1e6) as usize;
    let elsewhere = (0..count).map(|k| k as f64 * length / count as f64);
    let arcs = nearby.chain(elsewhere).map(|arc| arc.rem_euclid(length));
    let within_reach: Vec<f64> =
        arcs.filter(|&arc| from.distance(layer.curve.point_at(arc)) <= seam.reach).collect();
    let mut beside_root = None;
    for arc in within_reach {
        let place = opened(layer, arc, settings.grid);
        if !sound(&place) {
            continue;
        }
        if sight.on_wall(place.0).is_none_or(|from_root| from_root >= ROOT_REACH[1]) {
            return place;
        }
        beside_root = beside_root.or(Some(place));
    }
    beside_root.unwrap_or(wanted)
}

/// What of a layer matters to where it begins.
struct Sight {
    walls: SegmentIndex,
    /// Where the strand leaves and joins walls.
    roots: Vec<DVec2>,
    width: f64,
}

impl Sight {
    fn of(layer: &PlannedLayer, width: f64) -> Self {
        let sides = layer.curve.segments().zip(&layer.legs);
        let walls = sides.filter(|(_, leg)| **leg == Leg::Wall).map(|(side, _)| side);
        let n = layer.legs.len();
        let on_wall = |k: usize| layer.legs[k % n] == Leg::Wall;
        let roots = (0..n).filter(|&k| on_wall(k) != on_wall(k + n - 1)).map(|k| layer.curve.points()[k]);
        Self { walls: SegmentIndex::new(walls.collect(), width), roots: roots.collect(), width }
    }

    /// How far the nearest root is, in w, if the place is on a wall.
    fn on_wall(&self, p: DVec2) -> Option<f64> {
        self.walls.nearest_within(p, 0.1 * self.width)?;
        let distances = self.roots.iter().map(|root| root.distance(p) / self.width);
        Some(distances.fold(f64::INFINITY, f64::min))
    }
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
