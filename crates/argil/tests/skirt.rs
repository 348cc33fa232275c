//! What must hold of the turns on the bed that come before the part, and of the strand's ends.

mod sample;
mod verdict;

use argil::curve::{ClosedCurve, DVec2, Segment};
use argil::slice::Layer;
use argil::strand::{Role, Strand};
use argil::{Bed, Plan, Planner, Settings, Skirt};
use sample::sample;
use verdict::audited;

fn with(skirt: Skirt, width: f64) -> Settings {
    Settings { skirt: Some(skirt), ..Settings::for_width(width) }
}

fn skirt_of(strand: &Strand) -> Vec<DVec2> {
    let moves = strand.layers()[0].moves.iter().take_while(|step| step.role == Role::Skirt);
    std::iter::once(strand.start()).chain(moves.map(|step| step.to)).collect()
}

fn sides(points: &[DVec2]) -> Vec<Segment> {
    points.windows(2).map(|pair| Segment::new(pair[0], pair[1])).collect()
}

/// It goes round, crosses neither itself nor the part, keeps its distances, and ends where the part begins.
fn assert_skirt(plan: &Plan, skirt: &Skirt, width: f64) {
    let strand = &plan.strand;
    let points = skirt_of(strand);
    let laid = plan.skirt.expect("a skirt is laid");
    assert!(laid.turns >= 1 && laid.turns <= skirt.turns && laid.distance <= skirt.distance * width + 1e-9);
    assert!((laid.length - strand.length_of(Role::Skirt)).abs() < 1e-6);
    assert_eq!(points.last().copied(), strand.seam(0));
    let cycle = strand.polyline(0);
    let (own, part) = (sides(&points), sides(&cycle));
    let (way, turns) = own.split_last().expect("a skirt has sides");
    for (k, side) in own.iter().enumerate() {
        assert!(own[..k].iter().chain(&part).all(|other| !side.crosses(other)), "side {k} crosses");
    }
    for p in &cycle {
        let nearest = turns.iter().map(|side| side.distance(*p)).fold(f64::INFINITY, f64::min);
        assert!(nearest > laid.distance - 0.02 * width, "{nearest} mm at {p}");
    }
    let round = way.start - points[0];
    assert!(round.length() > (laid.turns as f64 - 0.01) * width, "turns lie on one another");
    // Each turn is a curve with all of the part inside.
    let each = turns.len() / laid.turns;
    for turn in points[..turns.len()].chunks_exact(each) {
        let curve = ClosedCurve::new(turn.to_vec()).expect("a turn is a curve");
        assert!(cycle.iter().all(|&p| curve.contains(p)));
        assert!(curve.signed_area() > 0.0);
    }
    assert!(
        strand.layers().iter().skip(1).all(|layer| layer.moves.iter().all(|step| step.role != Role::Skirt))
    );
}

#[test]
fn a_skirt_goes_round_and_leads_to_the_part() {
    for (name, width, turns) in [("columns", 3.0, 1), ("cup", 4.0, 2), ("spire", 3.0, 3)] {
        let skirt = Skirt { turns, ..Skirt::default() };
        let settings = with(skirt, width);
        let mesh = sample(name);
        let plan = Planner::default().plan(&mesh, &settings).expect("the model can be planned");
        assert_skirt(&plan, &skirt, width);
        assert_eq!(plan.skirt.map(|laid| laid.turns), Some(turns));
        let report = audited(&plan, &mesh, &settings);
        assert!(report.is_sound(), "{name}: {report}");
    }
}

#[test]
fn a_skirt_stays_on_the_bed() {
    let mesh = sample("columns");
    let plain = Planner::default().plan(&mesh, &Settings::for_width(3.0)).expect("it can be planned");
    let reach = plain.strand.polyline(0).iter().map(|p| p.length()).fold(0.0, f64::max);
    let on = |radius: f64, turns: usize| {
        let bed = Some(Bed::Disc { middle: [0.0, 0.0], radius });
        let skirt = Skirt { turns, bed, ..Skirt::default() };
        let plan = Planner::default().plan(&mesh, &with(skirt, 3.0)).expect("it can be planned");
        if plan.skirt.is_some() {
            assert_skirt(&plan, &skirt, 3.0);
            let points = skirt_of(&plan.strand);
            assert!(points.iter().all(|p| p.length() + 1.5 <= radius + 1e-3));
        }
        plan
    };
    let wide = on(reach + 100.0, 2).skirt.expect("there is room");
    assert_eq!((wide.turns, wide.distance), (2, 9.0));
    let near = on(reach + 1.5 * 3.0 + 2.0 * 3.0 + 2.0, 2).skirt.expect("there is room nearer by");
    assert!(near.turns == 2 && near.distance < 9.0 && near.distance >= 4.5, "{near:?}");
    assert_eq!(on(reach + 1.5 * 3.0 + 3.0 + 2.0, 2).skirt.map(|laid| laid.turns), Some(1));
    let none = on(reach + 3.0, 2);
    assert!(none.skirt.is_none() && none.strand.length_of(Role::Skirt) == 0.0);
}

#[test]
fn settings_that_make_no_skirt_are_refused() {
    for (turns, distance) in [(0, 3.0), (101, 3.0), (2, 1.0), (2, f64::NAN), (2, -1.0), (2, 1e5)] {
        let settings = with(Skirt { turns, distance, bed: None }, 3.0);
        assert!(settings.check().is_err(), "{turns} {distance}");
    }
}

#[test]
fn a_part_that_no_way_leads_to_is_planned_without_a_skirt() {
    let settings = with(Skirt::default(), 4.0);
    let plan = Planner::default().plan(&sample("nested-rings"), &settings).expect("the model can be planned");
    let plain = Planner::default().plan(&sample("nested-rings"), &Settings { skirt: None, ..settings });
    assert!(plan.skirt.is_none() && plan.strand.length_of(Role::Skirt) == 0.0);
    assert_eq!(plan.strand, plain.expect("the model can be planned").strand);
}

/// A prism over a plus sign.
fn plus(settings: &Settings, count: usize) -> Vec<Layer> {
    let (a, b) = (8.0, 24.0);
    let corners = [
        (-a, -b),
        (a, -b),
        (a, -a),
        (b, -a),
        (b, a),
        (a, a),
        (a, b),
        (-a, b),
        (-a, a),
        (-b, a),
        (-b, -a),
        (-a, -a),
    ];
    let outline: Vec<DVec2> = corners.map(DVec2::from).to_vec();
    let h = settings.layer_height;
    (0..count)
        .map(|k| Layer::of_loops(k, (k + 1) as f64 * h, h, std::slice::from_ref(&outline), settings.grid))
        .collect()
}

#[test]
fn the_strand_begins_and_ends_where_the_wall_turns_inward() {
    let settings = Settings::for_width(2.0);
    let plan = Planner::default().plan_layers(&plus(&settings, 20), &settings).expect("a prism");
    for end in [plan.strand.start(), plan.strand.end()] {
        assert!((end.abs() - 8.0).length() < 2.0 * settings.width, "the strand ends at {end}");
    }
}
