//! Where each layer begins, and the steps from layer to layer.

use std::cell::OnceCell;

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex, on_grid, self_crossings};
use argil_route::Leg;
use argil_seam::SeamError;
use argil_slice::Layer;
use argil_strand::{Move, Role};
use geo_types::MultiPolygon;

use crate::Settings;
use crate::descent::PlannedLayer;
use crate::ends::Exposure;
use crate::passage::Walled;
use crate::skirt::Ground;
use crate::stages::Seam;

/// What a start on a wall costs against one on free strand, in w²: the seam shows on a wall, while clay that is cut
/// away hides it. A quarter of the longest step squared, so that it never outweighs a good chain.
const VISIBLE: f64 = 0.13;
/// What a start of a spiral's layer costs anywhere but on a wall, in w²: a longest step squared.
const OFF_WALL: f64 = 0.6;
/// How far from roots starts on a wall keep, in w, where there is a chain of such starts: a step that comes from the other side of the
/// wall would make the strand pass straight through it, with less than a bead along the wall between. The second is tried
/// where the first leaves no chain.
const ROOT_REACH: [f64; 2] = [1.1, 0.6];
/// Most prints have a chain of steps this part as long as they may be. A long step sags, so it is tried first at both
/// distances from roots.
const SHORT: f64 = 0.5;
/// What a start right at a root costs where neither does, in w²; less with the square of the distance.
const AT_ROOT: f64 = 4.0;

/// What a way from the skirt costs for each w of its length, in w².
const FROM_SKIRT: f64 = 0.1;

/// A start gives way along its cycle in shifts of this, in w, so many times at most before other parts of the cycle are tried.
const SHIFT: f64 = 0.02;
const SHIFTS: i32 = 60;

/// How often the chain is sought again with starts left out that no short, clear step leads to once they are on the grid.
const REPLANS: usize = 8;
/// How far round a start that is left out none lies, in w.
const LEFT_OUT: f64 = 0.3;

/// A cycle counts as closed this far from its start, in w; what of the step lies nearer may stand for the start itself.
const CLOSING: f64 = 1.0 / 30.0;
/// Vertices no farther apart than this are one place, mm.
const ON_VERTEX: f64 = 2e-4;

/// A layer opened at its start: the place, and the moves from there back to it.
pub(crate) type Opened = (DVec2, Vec<Move>);

/// The layers, each opened at a start that a short, clear and held step leads to, which goes through no wall; the lowest in sight of a skirt,
/// if there is one. `slices` are what they were planned for. Where they are not `checked`, the starts stay where the seam stage wants them.
///
/// # Errors
/// Those of the seam stage; [`SeamError::NoStep`] where a start gives way on the grid and no other place of its layer will do.
pub(crate) fn opened_layers(
    (layers, slices): (&[PlannedLayer], &[Layer]),
    seam: &mut impl Seam,
    settings: &Settings,
    checked: bool,
    skirt: Option<&Ground>,
) -> Result<Vec<Opened>, SeamError> {
    let stack = Stack::new((layers, slices), settings, skirt);
    let longest = settings.seaming().reach;
    let levels = levels(longest);
    let nothing = vec![Vec::new(); layers.len()];
    let (mut level, starts) = stack.chain(seam, &levels, &nothing)?;
    if !checked {
        let opened = |(layer, start): (_, &f64)| opened(layer, *start, settings.grid);
        return Ok(layers.iter().zip(&starts).map(opened).collect());
    }
    let (mut left_out, mut tried) = (nothing, starts.clone());
    for _ in 0..REPLANS {
        match stack.climbed(&tried, levels[level].reach, false) {
            Ok(climbed) => return Ok(climbed),
            Err(stuck) => stuck.iter().for_each(|&k| left_out[k].push(stack.cycles[k].point_at(tried[k]))),
        }
        let Ok((next, starts)) = stack.chain(seam, &levels[level..], &left_out) else { break };
        (level, tried) = (level + next, starts);
    }
    stack.climbed(&starts, longest, true).map_err(|stuck| {
        let layer = stuck.first().copied().unwrap_or_default();
        let Some(k) = layer.checked_sub(1) else { return SeamError::NoStart };
        let below = stack.cycles[k].point_at(starts[k]);
        SeamError::NoStep { layer, below, gap: stack.cycles[layer].nearest(below).distance }
    })
}

/// What is asked of a chain of starts.
struct Level {
    /// The longest step, mm.
    reach: f64,
    roots: Roots,
}

/// What it costs to start beside a root.
enum Roots {
    /// Starts on a wall keep this far from them, in w.
    Beyond(f64),
    /// The nearer, the dearer.
    Graded,
}

/// The best first. The last forbids no place.
fn levels(longest: f64) -> [Level; 6] {
    let [far, near] = ROOT_REACH;
    let short = SHORT * longest;
    let level = |reach, roots| Level { reach, roots };
    [
        level(short, Roots::Beyond(far)),
        level(short, Roots::Beyond(near)),
        level(short, Roots::Graded),
        level(longest, Roots::Beyond(far)),
        level(longest, Roots::Beyond(near)),
        level(longest, Roots::Graded),
    ]
}

impl Level {
    /// What a start on a wall costs at a distance from the nearest root, both in w.
    fn beside_root(&self, from_root: f64) -> f64 {
        match self.roots {
            Roots::Beyond(reach) if from_root < reach => f64::INFINITY,
            Roots::Beyond(_) => 0.0,
            Roots::Graded => AT_ROOT * (1.0 - from_root / ROOT_REACH[0]).max(0.0).powi(2),
        }
    }
}

/// The planned layers, bottom first, and what matters to where they begin.
struct Stack<'a> {
    layers: &'a [PlannedLayer],
    slices: &'a [Layer],
    settings: &'a Settings,
    cycles: Vec<ClosedCurve>,
    sights: Vec<Sight>,
    footholds: Vec<f64>,
    skirt: Option<&'a Ground>,
    /// How much of the lowest layer can be seen, where the strand begins on it, and of the uppermost, where it ends.
    ends: [Option<Exposure>; 2],
}

impl<'a> Stack<'a> {
    fn new(
        (layers, slices): (&'a [PlannedLayer], &'a [Layer]),
        settings: &'a Settings,
        skirt: Option<&'a Ground>,
    ) -> Self {
        let sights: Vec<Sight> = layers.iter().map(|layer| Sight::of(layer, settings.width)).collect();
        let exposure = |sight: &Sight| Exposure::of(&sight.walls, settings.width);
        Self {
            layers,
            slices,
            settings,
            cycles: layers.iter().map(|layer| layer.curve.clone()).collect(),
            ends: [sights.first().filter(|_| skirt.is_none()).map(exposure), sights.last().map(exposure)],
            sights,
            footholds: layers.iter().map(|layer| layer.foothold).collect(),
            skirt,
        }
    }

    /// What it costs on a layer to begin or end the whole strand at a place, apart from what the step there costs; infinite where no
    /// way leads there from the skirt.
    fn end_cost(&self, layer: usize, p: DVec2, on_wall: bool) -> f64 {
        let width = self.settings.width;
        let from_skirt = match self.skirt.filter(|_| layer == 0) {
            Some(skirt) => skirt.distance(p).map_or(f64::INFINITY, |way| FROM_SKIRT * way * width),
            None => 0.0,
        };
        let [first, last] = &self.ends;
        let first = first.as_ref().filter(|_| on_wall && layer == 0);
        let last = last.as_ref().filter(|_| on_wall && layer + 1 == self.layers.len());
        from_skirt + [first, last].into_iter().flatten().map(|exposure| exposure.cost(p)).sum::<f64>()
    }

    /// The first of the levels that some chain meets, and that chain; `left_out` are places, by layer, where none may start.
    fn chain(
        &self,
        seam: &mut impl Seam,
        levels: &[Level],
        left_out: &[Vec<DVec2>],
    ) -> Result<(usize, Vec<f64>), SeamError> {
        let width = self.settings.width;
        let mut fault = SeamError::NoStart;
        for (k, level) in levels.iter().enumerate() {
            let cost = |layer: usize, p: DVec2| {
                if left_out[layer].iter().any(|place| place.distance(p) < LEFT_OUT * width) {
                    return f64::INFINITY;
                }
                let from_root = self.sights[layer].on_wall(p);
                let shown = match from_root {
                    // A step that does not rise does not show, and where a lane leads away and back the last turn lies beside the first.
                    _ if self.settings.spiral => {
                        from_root.map_or(OFF_WALL, |from_root| level.beside_root(from_root))
                    }
                    Some(from_root) => VISIBLE + level.beside_root(from_root),
                    None => 0.0,
                };
                shown * width * width + self.end_cost(layer, p, from_root.is_some())
            };
            match seam.starts(&self.cycles, &self.footholds, level.reach, self.settings, &cost) {
                Ok(starts) => return Ok((k, starts)),
                Err(why) => fault = why,
            }
        }
        Err(fault)
    }

    /// The layers opened at their starts, or near them, by steps no longer than `reach`; `anywhere`, where no place nearby will do.
    ///
    /// # Errors
    /// The layers that no step leads to.
    fn climbed(&self, starts: &[f64], reach: f64, anywhere: bool) -> Result<Vec<Opened>, Vec<usize>> {
        let mut climbed: Vec<Opened> = Vec::with_capacity(starts.len());
        let mut stuck = Vec::new();
        for (k, (layer, &start)) in self.layers.iter().zip(starts).enumerate() {
            let from = climbed.last().zip(k.checked_sub(1)).map(|((from, _), k)| (*from, &self.cycles[k]));
            let walled = self.slices.get(k).map(|slice| &slice.walled);
            let ascent = Ascent {
                from,
                layer,
                sight: &self.sights[k],
                walled,
                settings: self.settings,
                walls: OnceCell::new(),
            };
            let cleared = ascent.cleared(start, reach, anywhere);
            if cleared.is_none() {
                stuck.push(k);
            }
            climbed.push(cleared.unwrap_or_else(|| opened(layer, start, self.settings.grid)));
        }
        if stuck.is_empty() { Ok(climbed) } else { Err(stuck) }
    }
}

/// The way from the end of one layer on to the next.
struct Ascent<'a> {
    /// Where the layer below ends, and its cycle; the lowest has none.
    from: Option<(DVec2, &'a ClosedCurve)>,
    layer: &'a PlannedLayer,
    sight: &'a Sight,
    walled: Option<&'a MultiPolygon<f64>>,
    settings: &'a Settings,
    /// The walls of `walled`, once they are asked for.
    walls: OnceCell<Walled>,
}

impl Ascent<'_> {
    /// The cycle opened at `start`, or at the nearest place along it to which the step is clear, held and no longer than `reach`: a step
    /// that runs along the very strand that it ends on may cross it by one step of the grid after rounding, and a start that
    /// had to give way on the layer below is made up for here. `anywhere` on the cycle, where no place nearby will do.
    fn cleared(&self, start: f64, reach: f64, anywhere: bool) -> Option<Opened> {
        let wanted = opened(self.layer, start, self.settings.grid);
        if self.is_sound(&wanted, reach) {
            return Some(wanted);
        }
        let (length, shift) = (self.layer.curve.length(), SHIFT * self.settings.width);
        let nearby = (1..=SHIFTS).flat_map(|k| [1.0, -1.0].map(|side| start + side * f64::from(k) * shift));
        let count = if anywhere { (length / shift).ceil().clamp(1.0, 1e6) as usize } else { 0 };
        let elsewhere = (0..count).map(|k| k as f64 * length / count as f64);
        let mut beside_root = None;
        for arc in nearby.chain(elsewhere).map(|arc| arc.rem_euclid(length)) {
            if !self.is_within(self.layer.curve.point_at(arc), reach) {
                continue;
            }
            let place = opened(self.layer, arc, self.settings.grid);
            if !self.is_sound(&place, reach) {
                continue;
            }
            if self.sight.on_wall(place.0).is_none_or(|from_root| from_root >= ROOT_REACH[1]) {
                return Some(place);
            }
            beside_root = beside_root.or(Some(place));
        }
        beside_root
    }

    fn is_within(&self, place: DVec2, reach: f64) -> bool {
        self.from.is_none_or(|(from, _)| from.distance(place) <= reach)
    }

    fn is_sound(&self, opened: &Opened, reach: f64) -> bool {
        let (begin, _) = *opened;
        let across = self.settings.seaming().across;
        let stretches = stretches(opened);
        self.is_within(begin, reach)
            && self.from.is_none_or(|(_, below)| below.nearest(begin).distance <= across)
            && (self.is_vertex(begin) || is_simple(begin, &stretches))
            && self.from.is_none_or(|(from, _)| {
                let step = Segment::new(from, begin);
                let closing = step.point_at(1.0 - (CLOSING * self.settings.width / step.length()).min(1.0));
                is_clear(&step, &stretches)
                    && is_simple(closing, &stretches)
                    && !self.is_pierced(step, &stretches)
            })
    }

    fn is_pierced(&self, step: Segment, stretches: &[Segment]) -> bool {
        let walls =
            || self.walled.map(|walled| self.walls.get_or_init(|| Walled::new(walled, self.settings.width)));
        step.length() > 0.0 && walls().is_some_and(|walls| walls.is_pierced(step, stretches.iter().copied()))
    }

    /// Whether the cycle has a vertex there already, so that it is none the worse for beginning there.
    fn is_vertex(&self, place: DVec2) -> bool {
        self.layer.curve.points().contains(&place)
    }
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
        let n = layer.legs.len();
        let on_wall = |k: usize| layer.legs[k % n] == Leg::Wall && !layer.fill[k % n];
        let walls = layer.curve.segments().enumerate().filter(|(k, _)| on_wall(*k)).map(|(_, side)| side);
        let roots = (0..n).filter(|&k| on_wall(k) != on_wall(k + n - 1)).map(|k| layer.curve.points()[k]);
        Self { walls: SegmentIndex::new(walls.collect(), width), roots: roots.collect(), width }
    }

    /// How far the nearest root is, in w, if the place is on a wall.
    fn on_wall(&self, p: DVec2) -> Option<f64> {
        let from_roots = || {
            let squares = self.roots.iter().map(|root| root.distance_squared(p));
            squares.fold(f64::INFINITY, f64::min).sqrt() / self.width
        };
        self.walls.is_within(p, 0.1 * self.width).then(from_roots)
    }
}

/// The stretches of an opened cycle, from its start back to it.
fn stretches((begin, moves): &Opened) -> Vec<Segment> {
    let ends = std::iter::once(*begin).chain(moves.iter().map(|m| m.to));
    ends.zip(moves).map(|(start, m)| Segment::new(start, m.to)).collect()
}

/// Whether a step crosses none of the stretches that it leads to.
fn is_clear(step: &Segment, stretches: &[Segment]) -> bool {
    !stretches.iter().any(|stretch| stretch.crosses(step))
}

/// Whether a cycle crosses itself nowhere if it begins at a place that is not quite its own: one that is cut in two on the grid may, where
/// another stretch touches it. All the rest of it is known to be sound.
fn is_simple(begin: DVec2, stretches: &[Segment]) -> bool {
    let [first, .., last] = stretches else { return true };
    let (first, last) = (Segment::new(begin, first.end), Segment::new(last.start, begin));
    let between = &stretches[1..stretches.len() - 1];
    let others = |p: DVec2| between.iter().filter(|s| s.start.distance(p) <= ON_VERTEX).count();
    if !is_clear(&first, between) || !is_clear(&last, between) {
        return false;
    }
    // The first vertex behind the start is one of those between.
    if others(first.end) <= 1 && others(begin) == 0 && others(last.start) == 0 {
        return true;
    }
    let points: Vec<DVec2> = stretches.iter().skip(1).map(|s| s.start).chain([begin]).collect();
    self_crossings(&points).is_empty()
}

/// The cycle as moves from its start at the given arc back to it.
fn opened(layer: &PlannedLayer, start: f64, grid: f64) -> Opened {
    let curve = &layer.curve;
    let points = curve.points();
    let n = points.len();
    let on = curve.locate(start);
    let exact = curve.point_at(start);
    let role = |k: usize| match layer.legs[k % n] {
        Leg::Wall if layer.fill[k % n] => Role::Fill,
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
        (on_grid(exact, grid), on.segment)
    };
    let mut moves: Vec<Move> =
        (0..n).map(|k| Move { to: points[(first + k + 1) % n], role: role(first + k) }).collect();
    if begin != points[first % n] {
        moves.push(Move { to: begin, role: role(first) });
    }
    (begin, moves)
}
