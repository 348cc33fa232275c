//! Starts of layers that are planned give way to such as short steps lead to.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil_seam::{SeamSettings, is_clear, seam_chain_among};

use crate::descent::PlannedLayer;
use crate::foothold::{Foothold, HELD, Steps, foothold, is_open, off_wall, wall_in_sight};

/// How many layers above may begin elsewhere for short steps.
const WINDOW: usize = 10;

/// Spacing of the places that are tried for these, as a share of the seam stage's.
const FINE: f64 = 0.25;

/// What a place costs that what holds it need not lead up to, in squares of the longest step.
const SHUT: f64 = 30.0;

/// How starts are kept where no wall leads up to them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Keeping {
    /// A long step is taken, and the starts above give way, before strand is laid for one.
    Sparing,
    /// Strand is laid before they give way: it gets out of where they would be caught.
    Guided,
}

/// Which starts may give way, and for what steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Giving {
    /// Those of a few layers, for short steps.
    Few,
    /// Those of all layers, for short steps.
    All,
    /// Those of all layers, for any steps that are allowed.
    AllFar,
}

/// Where a cycle may begin that was just planned.
pub(crate) struct Settled {
    pub(crate) start: Foothold,
    /// Where those above give way to, arcs along their cycles, bottom first; the others stay.
    pub(crate) above: Vec<f64>,
}

/// The start on a cycle that was just planned. `planned` are the layers above it, top first, the lowest with the given start; their starts
/// give way where none on the cycle leads up to it. `walls` are those of this layer and of the one below.
pub(crate) fn settle(
    cycle: &ClosedCurve,
    planned: &[PlannedLayer],
    start: Option<Foothold>,
    walls: [&SegmentIndex; 2],
    seam: &SeamSettings,
    keeping: Keeping,
) -> Settled {
    let above = planned.last().map(|layer| &layer.curve).zip(start);
    let kept = |steps: Steps| foothold(cycle, above, walls, seam, steps).map(|place| (place, Vec::new()));
    let again = |giving: Giving| rechained(cycle, planned, walls, seam, giving);
    let near = match keeping {
        Keeping::Sparing => kept(Steps::Led).or_else(|| again(Giving::Few)).or_else(|| kept(Steps::Guided)),
        Keeping::Guided => kept(Steps::Short).or_else(|| kept(Steps::Guided)).or_else(|| again(Giving::Few)),
    };
    let settled =
        near.or_else(|| again(Giving::All)).or_else(|| kept(Steps::Long)).or_else(|| again(Giving::AllFar));
    let (start, above) = settled.unwrap_or_else(|| (Foothold::nearest(cycle, start), Vec::new()));
    Settled { start, above }
}

/// A chain of starts through `cycle` and those planned above it, top first, with other starts than were kept open: where
/// none on `cycle` leads up to the start above, another start there, or further up, may have some.
/// Returns the start on `cycle`, near a wall below if that can be, and the arcs of the others, bottom first; `None` where no chain exists.
///
/// # Complexity
/// As [`seam_chain_among`], over the layers whose starts may give way.
fn rechained(
    cycle: &ClosedCurve,
    planned: &[PlannedLayer],
    walls: [&SegmentIndex; 2],
    seam: &SeamSettings,
    giving: Giving,
) -> Option<(Foothold, Vec<f64>)> {
    let below = walls[1];
    let short = Steps::Short.reach(seam);
    // The best chain of short steps may be the only one; a few layers are searched fast.
    let (free, reach, spacing) = match giving {
        Giving::Few => (WINDOW, short, FINE * seam.spacing),
        Giving::All => (planned.len(), short, seam.spacing),
        Giving::AllFar => (planned.len(), seam.reach, seam.spacing),
    };
    let above = &planned[planned.len().saturating_sub(free + 1)..];
    let fixed =
        above.first().filter(|_| above.len() > free).map(|layer| layer.curve.point_at(layer.foothold));
    let cycles: Vec<ClosedCurve> =
        std::iter::once(cycle).chain(above.iter().rev().map(|layer| &layer.curve)).cloned().collect();
    let also: Vec<f64> = std::iter::once(0.0).chain(above.iter().rev().map(|layer| layer.foothold)).collect();
    let held = HELD * seam.across;
    let hanging = |p: DVec2| below.nearest(p).map_or(0.0, |wall| (wall.distance - held).max(0.0));
    let shut = SHUT * seam.reach.powi(2);
    let is_near = |layer: usize, p: DVec2| {
        fixed.is_none_or(|fixed| p.distance(fixed) <= (above.len() - layer) as f64 * reach)
    };
    let cost = |layer: usize, p: DVec2| match layer {
        _ if !is_near(layer, p) => f64::INFINITY,
        0 => {
            let far = hanging(p);
            let is_shut = far > 0.0 && !is_open(cycle, cycle.nearest(p).s, seam.across);
            far.powi(2) + if is_shut { shut } else { 0.0 }
        }
        _ => 0.0,
    };
    let seaming = SeamSettings { reach, spacing, ..*seam };
    let mut arcs = seam_chain_among(&cycles, &also, &seaming, &cost).ok()?;
    let arc = arcs.remove(0);
    let at = cycle.point_at(arc);
    let wall = below.nearest(at);
    let led = wall.is_some_and(|wall| is_clear(&Segment::new(wall.point, at), arc, cycle));
    let over_wall = led && wall.is_some_and(|wall| wall.distance <= held);
    let toward =
        if led { None } else { wall_in_sight(at, walls, seam).or_else(|| off_wall(at, below, seam.across)) };
    Some((Foothold { at, arc, over_wall, toward }, arcs))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LayerReport;

    fn curve(points: &[(f64, f64)]) -> ClosedCurve {
        ClosedCurve::new(points.iter().map(|&p| DVec2::from(p)).collect()).unwrap()
    }

    fn planned(curve: &ClosedCurve, foothold: f64) -> PlannedLayer {
        PlannedLayer {
            report: LayerReport::default(),
            z: 0.0,
            curve: curve.clone(),
            legs: Vec::new(),
            fill: Vec::new(),
            supports: Vec::new(),
            foothold,
        }
    }

    #[test]
    fn a_start_that_nothing_leads_up_to_gives_way_to_one_that_something_does() {
        let seam = SeamSettings::for_width(1.5);
        let none = SegmentIndex::new(Vec::new(), 1.5);
        // The start lies in a pocket of its cycle whose mouth is shut; the strand below passes outside of it.
        let pocket = [
            (0.0, 0.0),
            (0.0, 0.4),
            (-0.2, 0.4),
            (-0.2, -0.2),
            (0.2, -0.2),
            (0.2, 0.4),
            (0.05, 0.4),
            (0.05, 0.0),
        ];
        let above = curve(&pocket);
        let below = curve(&[(-1.0, -0.6), (1.0, -0.6), (0.3, -0.25), (-0.3, -0.25)]);
        let hidden = above.nearest(DVec2::new(0.0, 0.2));
        let start = Foothold { at: hidden.point, arc: hidden.s, over_wall: false, toward: None };
        assert_eq!(foothold(&below, Some((&above, start)), [&none, &none], &seam, Steps::Long), None);
        let (start, arcs) =
            rechained(&below, &[planned(&above, hidden.s)], [&none, &none], &seam, Giving::AllFar).unwrap();
        let step = Segment::new(start.at, above.point_at(arcs[0]));
        assert!(step.length() <= seam.reach && is_clear(&step, arcs[0], &above));
    }
    #[test]
    fn a_start_gives_way_on_its_own_layer_where_short_steps_then_do() {
        let seam = SeamSettings { reach: 2.37, ..SeamSettings::for_width(3.0) };
        let none = SegmentIndex::new(Vec::new(), 3.0);
        // Tips of strand that fall back layer by layer. The middle one begins at the corner that the tip below it reaches through the
        // strand only; at its other corner a short step will do.
        let top = curve(&[(-2.19, -2.19), (-3.08, -0.94), (-3.13, -1.02), (-2.51, -2.24)]);
        let middle = curve(&[(-1.52, -2.53), (-2.41, -1.43), (-2.54, -1.55), (-1.5, -2.67)]);
        let below = curve(&[(-1.16, -2.1), (-1.78, -1.79), (-1.84, -1.96), (-1.4, -2.22)]);
        let arc = |curve: &ClosedCurve, x: f64, y: f64| curve.nearest(DVec2::new(x, y)).s;
        let corner = arc(&middle, -2.54, -1.55);
        let start = Foothold { at: middle.point_at(corner), arc: corner, over_wall: false, toward: None };
        let mut above = vec![planned(&top, arc(&top, -3.08, -0.94)), planned(&middle, corner)];
        let settled = settle(&below, &above, Some(start), [&none, &none], &seam, Keeping::Sparing);
        above.iter_mut().rev().zip(&settled.above).for_each(|(layer, &arc)| layer.foothold = arc);
        let starts = [top.point_at(above[0].foothold), middle.point_at(above[1].foothold), settled.start.at];
        let short = Steps::Short.reach(&seam);
        assert!(starts.windows(2).all(|step| step[0].distance(step[1]) <= short), "{starts:?}");
        assert!(starts[1].distance(start.at) > 0.1, "{starts:?}");
    }
}
