//! The fewest support points for what the walls do not hold.

use crate::coverage::{Coverage, Run};
use crate::hairpin::Hairpins;
use crate::placement::Placement;
use crate::run::RunPlan;
use crate::sharing::{Partner, Sharing};
use argil_curve::{ArcSpan, ClosedCurve, DVec2, SegmentIndex, gaps, held_spans};

/// Points are never planned closer than this share of the curve's length: a bridge of 1e-12 mm is a mistake
/// in a setting, and must not fill the memory.
const SHORTEST_BRIDGE: f64 = 1e-6;

/// A place in the layer below through which, or close by which, the path must pass.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SupportPoint {
    /// Where the path below is best laid, mm.
    pub position: DVec2,
    /// The points of the curve above that it holds, one, or two of different strands. The path below must
    /// pass within [`Placement::slack`] of each; `position` is within that of all of them.
    pub needs: Vec<DVec2>,
}

/// The fewest points that hold what `walls` do not hold of `above`.
///
/// Every closed curve below that contains the walls and passes within [`Placement::slack`] of every need
/// satisfies the [`Criterion`](crate::Criterion) of the placement exactly, wherever within the slack it
/// passes. None is placed where walls hold, and none on a run no longer than [`Placement::along`].
///
/// The steps (in place of the samples at a fixed stride in Sec. 3.2 of the paper, which leave gaps of up to
/// twice `ε_along`):
/// 1. The stretches within `across` of the walls are held, exactly, not by samples. The rest are runs.
/// 2. For each run longer than `along`: the fewest points by dynamic programming, where a point on the tip of
///    a hairpin costs more, so that gaps are centred on tips, and one that holds two strands less.
/// 3. Each point placed holds all strand within `cover` of its needs. Runs that come later are what is then
///    left.
///
/// A curve that no wall holds gets a first point where it is least like a tip, even if it is tiny, and is
/// then one run from there round to there. A placement with a number that is negative or not finite places
/// nothing.
///
/// # Complexity
/// O(n log n) for evenly spread curves; strands that run in pairs for long stretches of one run add the
/// square of the number of shared points, times the candidates between two points.
///
/// # Example
/// ```
/// use argil_support::{ClosedCurve, Criterion, DVec2, Placement, Segment, SegmentIndex};
/// use argil_support::{place_supports, unsupported_spans};
/// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)];
/// let square = ClosedCurve::new(square.map(DVec2::from).to_vec())?;
/// let walls = vec![Segment::new(DVec2::new(0.0, 9.0), DVec2::new(0.0, 0.0))];
/// let points = place_supports(&square, &SegmentIndex::new(walls.clone(), 1.0), &Placement::for_width(1.5));
///
/// // 26 mm hang between the ends of the wall.
/// assert_eq!(points.len(), 9);
/// // Whatever passes through the points holds all of it.
/// let below = walls.into_iter().chain(points.iter().map(|p| Segment::new(p.position, p.position)));
/// let below = SegmentIndex::new(below.collect(), 1.0);
/// assert!(unsupported_spans(&square, &below, &Criterion::for_width(1.5)).is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn place_supports(above: &ClosedCurve, walls: &SegmentIndex, placement: &Placement) -> Vec<SupportPoint> {
    if !placement.is_usable() {
        return Vec::new();
    }
    let shortest = SHORTEST_BRIDGE * above.length();
    let (along, step) = (placement.along.max(shortest), placement.step.max(shortest));
    let placement = &Placement { along, step, ..*placement };
    let walled = held_spans(above, walls, placement.across);
    let is_held = |gap: &ArcSpan| gap.length <= placement.along;
    if !walled.is_empty() && gaps(above.length(), &walled).iter().all(is_held) {
        return Vec::new();
    }
    let index = SegmentIndex::of_curves([above], cell_for(above, placement));
    let mut planner = Planner {
        above,
        placement,
        hairpins: Hairpins::of(
            above,
            placement.step.max(SHORTEST_BRIDGE * above.length()),
            placement.tip_reach,
        ),
        sharing: Sharing::new(above, &index, placement),
        coverage: Coverage::new(above, &index, &walled),
        points: Vec::new(),
    };
    if planner.coverage.is_empty() {
        let start = planner.hairpins.straightest();
        planner.place(start, None);
    }
    for run in planner.coverage.runs() {
        planner.serve(run);
    }
    planner.points
}

/// Cells about as large as a segment or a query, whichever is larger.
fn cell_for(curve: &ClosedCurve, placement: &Placement) -> f64 {
    (curve.length() / curve.segment_count() as f64).max(2.0 * placement.share)
}

struct Planner<'a> {
    above: &'a ClosedCurve,
    placement: &'a Placement,
    hairpins: Hairpins,
    sharing: Sharing<'a>,
    coverage: Coverage<'a>,
    points: Vec<SupportPoint>,
}

impl Planner<'_> {
    /// Places points until nothing of `run` hangs further than allowed.
    fn serve(&mut self, run: Run) {
        let mut pending = vec![run];
        while let Some(run) = pending.pop() {
            let free = self.coverage.free_within(run);
            if free.as_slice() == [run] {
                self.serve_free(run, &mut pending);
            } else {
                pending.extend(free.into_iter().rev());
            }
        }
    }

    /// Places points on a stretch that nothing holds. Where a shared point holds something further along the
    /// same stretch too, the stretch before that is `pending` and the plan goes on behind it.
    fn serve_free(&mut self, run: Run, pending: &mut Vec<Run>) {
        if !self.is_too_long(run) {
            return;
        }
        let Self { placement, hairpins, sharing, coverage, .. } = &*self;
        let plan = RunPlan::new(run, placement, |s| {
            let shared = if sharing.has_partner(s, coverage) { placement.share_bonus } else { 0.0 };
            1.0 + placement.tip_weight * hairpins.at(s) - shared
        });
        let mut next = plan.first_from(run.start);
        while let Some(k) = next {
            let s = plan.place(k);
            let partner = self.sharing.partner(s, &self.coverage);
            self.place(s, partner);
            next = plan.next(k);
            if partner.is_some_and(|partner| self.above.wrapped(partner.s - s) < run.end - s) {
                let mut free = self.coverage.free_within(Run { start: s, end: run.end });
                let last = free.pop_if(|free| free.end == run.end);
                let last = last.filter(|&last| self.is_too_long(last));
                next = last.and_then(|last| plan.first_from(last.start));
                pending.extend(last.filter(|_| next.is_none()));
                pending.extend(free.into_iter().rev());
            }
        }
    }

    /// Whether a stretch that nothing holds is longer than a bridge may be. Between placed points stretches
    /// are as long as allowed, up to rounding.
    fn is_too_long(&self, run: Run) -> bool {
        run.length() > self.placement.along * (1.0 + 1e-9)
    }

    fn place(&mut self, s: f64, partner: Option<Partner>) {
        let need = self.above.point_at(s);
        let needs: Vec<DVec2> = std::iter::once(need).chain(partner.map(|partner| partner.point)).collect();
        // A point is counted to hold `held` along its strand; what lies within `cover` is held for sure.
        let further = (self.placement.held - self.placement.cover).max(0.0);
        for &need in &needs {
            self.coverage.hold_about(need, self.placement.cover, further);
        }
        // With a cover of nothing the discs may miss the strand by rounding; its own place is held all the
        // same.
        for s in std::iter::once(s).chain(partner.map(|partner| partner.s)) {
            self.coverage.hold(s - self.placement.held, s + self.placement.held);
        }
        let position = needs.iter().sum::<DVec2>() / needs.len() as f64;
        self.points.push(SupportPoint { position, needs });
    }
}
