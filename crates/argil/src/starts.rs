//! Where each layer begins, and the steps from layer to layer.

use std::ops::Range;

use argil_curve::{ClosedCurve, DVec2};
use argil_seam::SeamError;
use argil_slice::Layer;

use crate::Settings;
use crate::ascent::{Ascent, ROOT_REACH, Sight};
use crate::descent::PlannedLayer;
use crate::ends::Exposure;
use crate::opening::Opened;
use crate::precedence::{Precedence, opened_in_order};
use crate::skirt::Ground;
use crate::stages::Seam;

/// What a start on a wall costs against one on free strand, in w²: the seam shows on a wall, while clay that is cut
/// away hides it. A quarter of the longest step squared, so that it never outweighs a good chain.
const VISIBLE: f64 = 0.13;
/// What a start of a spiral's layer costs anywhere but on a wall, in w²: a longest step squared.
const OFF_WALL: f64 = 0.6;
/// Most prints have a chain of steps this part as long as they may be. A long step sags, so it is tried first at both
/// distances from roots.
const SHORT: f64 = 0.5;
/// What a start right at a root costs where neither does, in w²; less with the square of the distance.
const AT_ROOT: f64 = 4.0;

/// What a way from the skirt costs for each w of its length, in w².
const FROM_SKIRT: f64 = 0.1;

/// A chain that asks too much mostly breaks off in the tips of the part: so many layers from the top are tried by themselves first.
const TIPS: usize = 12;

/// How often the chain is sought again with starts left out that no short, clear step leads to once they are on the grid.
const REPLANS: usize = 8;
/// How far round a start that is left out none lies, in w.
const LEFT_OUT: f64 = 0.3;

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
        let opened =
            |(k, start): (usize, &f64)| opened_in_order(&layers[k], *start, stack.order(k), settings.grid);
        return Ok(starts.iter().enumerate().map(opened).collect());
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
    /// In which order the walls of each layer are wanted.
    orders: Vec<Option<Precedence>>,
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
            orders: layers.iter().zip(slices).map(|(l, slice)| Precedence::of(l, slice, settings)).collect(),
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

    fn order(&self, layer: usize) -> Option<&Precedence> {
        self.orders.get(layer)?.as_ref()
    }

    /// The first of the levels that some chain meets, and that chain; `left_out` are places, by layer, where none may start.
    fn chain(
        &self,
        seam: &mut impl Seam,
        levels: &[Level],
        left_out: &[Vec<DVec2>],
    ) -> Result<(usize, Vec<f64>), SeamError> {
        let count = self.layers.len();
        let tips = count.saturating_sub(TIPS)..count;
        let mut fault = SeamError::NoStart;
        for (k, level) in levels.iter().enumerate() {
            // A chain of all layers has one of the tips in it. The last level is tried on all, so that a fault has its place.
            let is_tried = tips.start > 0 && k + 1 < levels.len();
            if is_tried && self.chain_of(tips.clone(), seam, level, left_out).is_err() {
                continue;
            }
            match self.chain_of(0..count, seam, level, left_out) {
                Ok(starts) => return Ok((k, starts)),
                Err(why) => fault = why,
            }
        }
        Err(fault)
    }

    /// A chain through some of the layers.
    fn chain_of(
        &self,
        layers: Range<usize>,
        seam: &mut impl Seam,
        level: &Level,
        left_out: &[Vec<DVec2>],
    ) -> Result<Vec<f64>, SeamError> {
        let width = self.settings.width;
        let cost = |layer: usize, p: DVec2| {
            let layer = layers.start + layer;
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
            let in_order = self.order(layer).map_or(0.0, |order| order.cost(p));
            (shown + in_order) * width * width + self.end_cost(layer, p, from_root.is_some())
        };
        let (cycles, footholds) = (&self.cycles[layers.clone()], &self.footholds[layers.clone()]);
        seam.starts(cycles, footholds, level.reach, self.settings, &cost)
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
            let ascent = Ascent::new(from, (layer, &self.sights[k], self.order(k)), walled, self.settings);
            let cleared = ascent.cleared(start, reach, anywhere);
            if cleared.is_none() {
                stuck.push(k);
            }
            climbed.push(cleared.unwrap_or_else(|| ascent.opened(start)));
        }
        if stuck.is_empty() { Ok(climbed) } else { Err(stuck) }
    }
}
