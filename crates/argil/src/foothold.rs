//! A place on every layer where the layer above may begin.
//!
//! The strand climbs by short steps, and each layer has to begin where the layer below holds it. Where strand ends on a
//! wall, or a body begins in mid-air over a thread of support, no such chain need exist by itself. So while the layers
//! are planned from the top down, one start a layer is chosen in sight of the walls below, and the next layer is
//! asked to hold it. On walls that stand on walls this costs nothing. The seam stage is free to find a better chain.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil_seam::{SeamSettings, is_clear, shut_directions};
use argil_support::SupportPoint;

use crate::Settings;

/// Share of the longest step that is used, so that starts on the seam stage's own spacing reach each other too.
const STEP: f64 = 0.85;

/// Share of the longest step that is tried first: a long step sags.
const SHORT: f64 = 0.475;

/// Share of `ε_across` within which a wall must pass, for the same reason.
pub(crate) const HELD: f64 = 0.65;

/// How far ahead of a start that no wall leads up to the strand is asked to go, in w: towards a wall that does, and no farther than
/// a step.
const AHEAD: f64 = 0.6;

/// Directions from which steps are tried, and how many of them may be shut: along a bend, steps graze the strand itself.
const DIRECTIONS: usize = 16;
const SHUT_AT_MOST: usize = 3;

/// Spacing of the places on walls that are looked at for one that leads up, as a share of the longest step.
const LOOK: f64 = 0.68;

/// A start, and how it stands to the walls below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Foothold {
    pub(crate) at: DVec2,
    /// Where that is along its cycle.
    pub(crate) arc: f64,
    /// Whether the walls below hold it and lead up to it.
    pub(crate) over_wall: bool,
    /// A place on the walls below to make for, where the nearest one does not lead up.
    pub(crate) toward: Option<DVec2>,
}

impl Foothold {
    /// The place on a cycle that is nearest to the start above: what there is where nothing leads up to that.
    pub(crate) fn nearest(cycle: &ClosedCurve, above: Option<Self>) -> Self {
        let arc = above.map_or(0.0, |start| cycle.nearest(start.at).s);
        Self { at: cycle.point_at(arc), arc, over_wall: false, toward: None }
    }
}

/// What steps are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Steps {
    /// Short ones, to starts that something leads up to wherever it passes.
    Short,
    /// Short ones to starts on walls, or else any that are allowed to starts that something leads up to.
    Led,
    /// Short ones, to starts that strand has to be laid for.
    Guided,
    /// Any that are allowed, to any start.
    Long,
}

impl Steps {
    pub(crate) fn reach(self, seam: &SeamSettings) -> f64 {
        let share = if matches!(self, Self::Long | Self::Led) { STEP } else { SHORT };
        share * seam.reach
    }
}

/// The start on a planned cycle: within a step of the start above, over the walls below where one is, else as near
/// to them as can be had, so that the starts make for the walls. `above` is the cycle above with its start; the step
/// up to it must cross nothing there. `walls` are those of this layer and of the one below.
///
/// A wall that lies near but on the far side of a strand of this cycle is no help: under a dome every wall lies outside
/// of the one above, and what stands inside can be reached from inside only. Where walls lean to one side, there are some on
/// the other side that lie inside: the starts make for these.
///
/// `None` where no place leads up to the start above by such steps.
pub(crate) fn foothold(
    cycle: &ClosedCurve,
    above: Option<(&ClosedCurve, Foothold)>,
    walls: [&SegmentIndex; 2],
    seam: &SeamSettings,
    steps: Steps,
) -> Option<Foothold> {
    let below = walls[1];
    let reach = steps.reach(seam);
    let held = HELD * seam.across;
    let rated: Vec<Place> = places_within(cycle, above, reach, seam)
        .into_iter()
        .map(|(arc, step)| {
            let at = cycle.point_at(arc);
            let wall = below.nearest(at);
            let led = wall.is_some_and(|wall| is_clear(&Segment::new(wall.point, at), arc, cycle));
            let hanging = wall.map_or(f64::INFINITY, |wall| (wall.distance - held).max(0.0));
            let over_wall = led && hanging <= 0.0;
            let lasting = over_wall || is_open(cycle, arc, seam.across);
            Place { led, lasting, hanging, step, start: Foothold { at, arc, over_wall, toward: None } }
        })
        .collect();
    let best = |fits: &dyn Fn(&Place) -> bool, far: &dyn Fn(&Place) -> f64| {
        let fitting = rated.iter().filter(|place| fits(place)).map(|place| (far(place), place));
        let nearest = fitting.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.step.total_cmp(&b.1.step)));
        nearest.map(|(_, place)| place.start)
    };
    let led = |fits: &dyn Fn(&Place) -> bool| best(&|place| place.led && fits(place), &|place| place.hanging);
    let trapped = |fits: &dyn Fn(&Place) -> bool| {
        let from = above.map_or_else(|| cycle.point_at(0.0), |(_, start)| start.at);
        let toward = wall_in_sight(from, walls, seam);
        let far = |place: &Place| toward.map_or(place.hanging, |wall| wall.distance(place.start.at));
        let start = best(&|place| !place.led && fits(place), &far)?;
        Some(Foothold { toward: toward.or_else(|| off_wall(start.at, below, seam.across)), ..start })
    };
    let lasting = || led(&|place| place.lasting);
    let guided = || trapped(&|place| place.lasting);
    match steps {
        Steps::Short => lasting(),
        Steps::Led => {
            let short = Steps::Short.reach(seam);
            led(&|place| place.start.over_wall && place.step <= short).or_else(lasting)
        }
        Steps::Guided => guided(),
        Steps::Long => lasting().or_else(guided).or_else(|| led(&|_| true)).or_else(|| trapped(&|_| true)),
    }
}

/// A place beside a start, on the side from which steps lead up to it: farther from the nearest wall below by as much as what holds it
/// may be. Strand that only came near the start could stay on the wall's side. `None` where a wall stands there.
pub(crate) fn off_wall(start: DVec2, below: &SegmentIndex, across: f64) -> Option<DVec2> {
    let wall = below.nearest(start)?;
    let away = across * (start - wall.point).normalize_or_zero();
    let beyond = below.nearest(start + 2.0 * away)?;
    (beyond.distance >= wall.distance.max(2.0 * across)).then_some(start + away)
}

/// A place on a cycle where it may begin.
struct Place {
    /// Whether nothing lies between it and the nearest wall below.
    led: bool,
    /// Whether something that holds it leads up to it, wherever that passes.
    lasting: bool,
    /// How far the nearest wall below is from holding it, mm.
    hanging: f64,
    /// The step from here to the start above, mm.
    step: f64,
    start: Foothold,
}

/// The arcs of a cycle from which a step no longer than `reach` leads up to the start above, with the lengths of the steps: places on
/// the seam stage's own spacing, and of every stretch its beginning and the nearest place.
fn places_within(
    cycle: &ClosedCurve,
    above: Option<(&ClosedCurve, Foothold)>,
    reach: f64,
    seam: &SeamSettings,
) -> Vec<(f64, f64)> {
    let count = (cycle.length() / seam.spacing).ceil().clamp(4.0, 1e6) as usize;
    let spaced = (0..count).map(|k| k as f64 * cycle.length() / count as f64);
    let Some((next, start)) = above else { return spaced.map(|arc| (arc, 0.0)).collect() };
    let near = (0..cycle.segment_count())
        .map(|k| cycle.on_segment(k, start.at))
        .filter(|on| on.distance <= reach)
        .flat_map(|on| [on.s, cycle.arc_of(on.segment)]);
    let arcs = spaced.chain(near);
    let steps = arcs.map(|arc| (arc, Segment::new(cycle.point_at(arc), start.at)));
    steps
        .filter(|(_, step)| step.length() <= reach && is_clear(step, start.arc, next))
        .map(|(arc, step)| (arc, step.length()))
        .collect()
}

/// Whether what holds a cycle at an arc leads up to it, wherever that passes: the steps that come from as far away as that may be
/// are clear from nearly all directions. On a straight strand they are, and at the tip of a narrow hairpin; on one of its legs they are
/// not, since what holds it may pass beyond the other leg.
pub(crate) fn is_open(cycle: &ClosedCurve, arc: f64, across: f64) -> bool {
    shut_directions(cycle, arc, across, DIRECTIONS) <= SHUT_AT_MOST
}

/// The place on the walls below that is nearest to a point and not behind a wall of its own layer.
pub(crate) fn wall_in_sight(
    from: DVec2,
    [here, below]: [&SegmentIndex; 2],
    seam: &SeamSettings,
) -> Option<DVec2> {
    let spacing = LOOK * seam.reach;
    let mut places: Vec<(f64, DVec2)> = below
        .segments()
        .iter()
        .flat_map(|wall| {
            let count = (wall.length() / spacing).ceil().clamp(1.0, 1e4) as usize;
            (0..count).map(move |k| wall.point_at(k as f64 / count as f64))
        })
        .map(|place| (place.distance(from), place))
        .collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_seen = |place: DVec2| {
        let sight = Segment::new(from, place);
        let mut seen = true;
        here.for_each_near(sight, 0.0, |_, wall| seen = seen && !wall.crosses(&sight));
        seen
    };
    places.into_iter().map(|(_, place)| place).find(|&place| is_seen(place))
}

/// Sees to it that the start above is held: by a wall, by a point that is asked for anyway, or by one more; and, where no wall
/// leads up to it, that strand goes on from it towards one that does. Returns the index of the point that asks for that.
pub(crate) fn hold_start(
    start: Foothold,
    supports: &mut Vec<SupportPoint>,
    settings: &Settings,
) -> Option<usize> {
    let placement = settings.support();
    let held_by_point =
        |s: &SupportPoint| s.needs.iter().any(|need| need.distance(start.at) <= placement.cover);
    if start.over_wall {
        return None;
    }
    if !supports.iter().any(held_by_point) {
        supports.push(SupportPoint { position: start.at, needs: vec![start.at] });
    }
    let ahead = (start.toward? - start.at).clamp_length_max(AHEAD * settings.width);
    supports.push(SupportPoint { position: start.at + ahead, needs: vec![start.at + ahead] });
    Some(supports.len() - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(radius: f64) -> ClosedCurve {
        let points = (0..48).map(|k| radius * DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 48.0));
        ClosedCurve::new(points.collect()).unwrap()
    }

    #[test]
    fn starts_make_for_the_wall_below() {
        let seam = SeamSettings::for_width(1.5);
        let walls = SegmentIndex::of_curves([&ring(10.0)], 1.5);
        let none = SegmentIndex::new(Vec::new(), 1.5);
        // A strand that runs out to the wall on the right, now a little higher, now a little lower.
        let strand = |layer: i32| {
            let lift = 0.07 * f64::from(layer % 2);
            let points = [(4.0, lift - 0.7), (4.0, lift + 0.7), (10.0, lift + 0.7), (10.0, lift - 0.7)];
            ClosedCurve::new(points.map(|(x, y)| DVec2::new(x, y)).to_vec()).unwrap()
        };
        let on = |curve: &ClosedCurve, p: DVec2| {
            let near = curve.nearest(p);
            Foothold { at: near.point, arc: near.s, over_wall: false, toward: None }
        };
        let mut start = on(&strand(0), DVec2::new(4.0, 0.0));
        for layer in 1..20 {
            let next = foothold(
                &strand(layer),
                Some((&strand(layer - 1), start)),
                [&none, &walls],
                &seam,
                Steps::Long,
            )
            .unwrap();
            assert!(next.at.distance(start.at) <= seam.reach);
            start = next;
        }
        assert!(walls.distance(start.at) <= seam.across, "{start:?} has reached the wall");
    }

    #[test]
    fn starts_on_a_narrow_hairpin_stay_at_its_tip() {
        let seam = SeamSettings::for_width(1.5);
        let hairpin = [(0.0, 0.0), (8.0, 0.05), (0.0, 0.1)].map(|(x, y)| DVec2::new(x, y));
        let cycle = ClosedCurve::new(hairpin.to_vec()).unwrap();
        let on = |x: f64| cycle.nearest(DVec2::new(x, 0.0)).s;
        assert!(is_open(&cycle, on(9.0), seam.across), "from wherever the strand below may pass");
        assert!(!is_open(&cycle, on(6.0), seam.across), "not from beyond the other leg");
        let walls = SegmentIndex::of_curves([&ring(12.0)], 1.5);
        let none = SegmentIndex::new(Vec::new(), 1.5);
        let above = Foothold { at: DVec2::new(7.8, 0.1), arc: 0.0, over_wall: false, toward: None };
        let start = foothold(&cycle, Some((&ring(7.8), above)), [&none, &walls], &seam, Steps::Long).unwrap();
        assert_eq!(start.at, DVec2::new(8.0, 0.05));
    }

    #[test]
    fn a_start_that_walls_do_not_lead_up_to_asks_for_strand_on_its_own_side() {
        let walls = SegmentIndex::of_curves([&ring(10.0)], 1.5);
        let beside = off_wall(DVec2::new(9.8, 0.0), &walls, 0.45).unwrap();
        assert!(beside.distance(DVec2::new(9.35, 0.0)) < 0.05, "{beside:?}");
        let close = SegmentIndex::of_curves([&ring(10.0), &ring(9.2)], 1.5);
        assert_eq!(off_wall(DVec2::new(9.8, 0.0), &close, 0.45), None, "another wall stands there");
    }

    #[test]
    fn a_start_over_nothing_is_asked_for_once() {
        let settings = Settings::for_width(1.5);
        let mut supports = Vec::new();
        hold_start(
            Foothold { at: DVec2::ONE, arc: 0.0, over_wall: true, toward: None },
            &mut supports,
            &settings,
        );
        assert!(supports.is_empty(), "the wall holds it");
        hold_start(
            Foothold { at: DVec2::ZERO, arc: 0.0, over_wall: false, toward: None },
            &mut supports,
            &settings,
        );
        hold_start(
            Foothold { at: DVec2::new(0.1, 0.0), arc: 0.1, over_wall: false, toward: None },
            &mut supports,
            &settings,
        );
        assert_eq!(supports.len(), 1);
    }

    #[test]
    fn a_wall_behind_a_strand_does_not_lead_up() {
        let seam = SeamSettings::for_width(1.5);
        // A ring with an excursion inwards, over a wall that is a little wider than the ring.
        let mut points: Vec<DVec2> = ring(10.0).points().to_vec();
        points
            .splice(0..1, [(10.0, 0.0), (8.0, 0.3), (8.0, -0.3), (10.0, 0.0)].map(|(x, y)| DVec2::new(x, y)));
        let cycle = ClosedCurve::new(points).unwrap();
        let walls = SegmentIndex::of_curves([&ring(10.2)], 1.5);
        let none = SegmentIndex::new(Vec::new(), 1.5);
        let inside = DVec2::new(7.2, 0.0);
        let inside = Foothold { at: inside, arc: 0.0, over_wall: false, toward: None };
        let tip = foothold(&cycle, Some((&ring(7.2), inside)), [&none, &walls], &seam, Steps::Long).unwrap();
        assert!(tip.at.length() < 9.9 && !tip.over_wall, "{tip:?}");
    }
}
