//! The step from the end of one layer to the start of the next, once both are on the output grid.

use std::cell::OnceCell;

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil_route::Leg;
use geo_types::MultiPolygon;

use crate::Settings;
use crate::descent::PlannedLayer;
use crate::opening::{Opened, is_clear, is_simple, stretches};
use crate::passage::Walled;
use crate::precedence::{Precedence, opened_in_order};

/// How far from roots starts on a wall keep, in w, where there is a chain of such starts: a step that comes from the other side of the
/// wall would make the strand pass straight through it, with less than a bead along the wall between. The second is tried
/// where the first leaves no chain.
pub(crate) const ROOT_REACH: [f64; 2] = [1.1, 0.6];

/// A start gives way along its cycle in shifts of this, in w, so many times at most before other parts of the cycle are tried.
const SHIFT: f64 = 0.02;
const SHIFTS: i32 = 60;

/// A cycle counts as closed this far from its start, in w; what of the step lies nearer may stand for the start itself.
const CLOSING: f64 = 1.0 / 30.0;

/// The way from the end of one layer on to the next.
pub(crate) struct Ascent<'a> {
    /// Where the layer below ends, and its cycle; the lowest has none.
    from: Option<(DVec2, &'a ClosedCurve)>,
    layer: &'a PlannedLayer,
    sight: &'a Sight,
    order: Option<&'a Precedence>,
    walled: Option<&'a MultiPolygon<f64>>,
    settings: &'a Settings,
    /// The walls of `walled`, once they are asked for.
    walls: OnceCell<Walled>,
}

impl<'a> Ascent<'a> {
    /// From where the layer below ends on its cycle, to a layer whose walls are those of `walled`.
    pub(crate) fn new(
        from: Option<(DVec2, &'a ClosedCurve)>,
        (layer, sight, order): (&'a PlannedLayer, &'a Sight, Option<&'a Precedence>),
        walled: Option<&'a MultiPolygon<f64>>,
        settings: &'a Settings,
    ) -> Self {
        Self { from, layer, sight, order, walled, settings, walls: OnceCell::new() }
    }

    /// The layer opened at a start, the way round that brings its walls into their order.
    pub(crate) fn opened(&self, start: f64) -> Opened {
        opened_in_order(self.layer, start, self.order, self.settings.grid)
    }

    /// The cycle opened at `start`, or at the nearest place along it to which the step is clear, held and no longer than `reach`: a step
    /// that runs along the very strand that it ends on may cross it by one step of the grid after rounding, and a start that
    /// had to give way on the layer below is made up for here. `anywhere` on the cycle, where no place nearby will do.
    pub(crate) fn cleared(&self, start: f64, reach: f64, anywhere: bool) -> Option<Opened> {
        let wanted = self.opened(start);
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
            let place = self.opened(arc);
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
pub(crate) struct Sight {
    pub(crate) walls: SegmentIndex,
    /// Where the strand leaves and joins walls.
    roots: Vec<DVec2>,
    width: f64,
}

impl Sight {
    pub(crate) fn of(layer: &PlannedLayer, width: f64) -> Self {
        let n = layer.legs.len();
        let on_wall = |k: usize| layer.legs[k % n] == Leg::Wall && !layer.fill[k % n];
        let walls = layer.curve.segments().enumerate().filter(|(k, _)| on_wall(*k)).map(|(_, side)| side);
        let roots = (0..n).filter(|&k| on_wall(k) != on_wall(k + n - 1)).map(|k| layer.curve.points()[k]);
        Self { walls: SegmentIndex::new(walls.collect(), width), roots: roots.collect(), width }
    }

    /// How far the nearest root is, in w, if the place is on a wall.
    pub(crate) fn on_wall(&self, p: DVec2) -> Option<f64> {
        let from_roots = || {
            let squares = self.roots.iter().map(|root| root.distance_squared(p));
            squares.fold(f64::INFINITY, f64::min).sqrt() / self.width
        };
        self.walls.is_within(p, 0.1 * self.width).then(from_roots)
    }
}
