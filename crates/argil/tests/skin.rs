//! Floors, roofs and undersides: closed, and one strand with all else.

mod sample;
mod verdict;

use argil::curve::{ClosedCurve, DVec2, Segment, SegmentIndex};
use argil::strand::Role;
use argil::{Plan, PlanError, Planner, Settings};
use sample::sample;
use verdict::audited;

fn closed(width: f64, floor: usize, skin: usize) -> Settings {
    Settings { floor, skin, ..Settings::for_width(width) }
}

/// The plan of a bundled model, which the audit must find sound.
fn planned(name: &str, settings: &Settings) -> Plan {
    let mesh = sample(name);
    let plan = Planner::default().plan(&mesh, settings).unwrap_or_else(|e| panic!("{name}: {e}"));
    let report = audited(&plan, &mesh, settings);
    assert!(report.is_sound(), "{name} falls short\n{report}");
    assert!(report.figures.fill_mm > 0.0 && report.figures.model_missed_fraction < 1e-4, "{name}\n{report}");
    plan
}

#[test]
fn a_cup_gets_a_floor_that_holds_water() {
    let settings = closed(1.5, 3, 0);
    let plan = planned("cup", &settings);
    let layers = Planner::default().slices(&sample("cup"), &settings).unwrap();
    for (position, (layer, report)) in layers.iter().zip(&plan.layers).enumerate() {
        let filled = report.fill_length > 0.0;
        assert_eq!(filled, position < 3, "layer {position}");
        if !filled {
            continue;
        }
        // No place where a bead could be is farther than 0.55 beads from the middle of one.
        let path = plan.strand.polyline(position);
        let laid = path.windows(2).map(|ends| Segment::new(ends[0], ends[1])).collect();
        let laid = SegmentIndex::new(laid, settings.width);
        let wall = ClosedCurve::new(layer.walls[0].points.clone()).unwrap();
        let reach = 0.55 * settings.width;
        let steps = (-60..60).map(|k| 0.21 * f64::from(k));
        let places = steps.clone().flat_map(|x| steps.clone().map(move |y| DVec2::new(x, y)));
        let bare: Vec<_> = places.filter(|&p| wall.contains(p) && !laid.is_within(p, reach)).collect();
        assert!(bare.is_empty(), "layer {position} is open at {bare:?}");
    }
}

#[test]
fn a_floor_is_laid_with_as_much_clay_as_it_has_room_for() {
    let room_aware = closed(1.5, 3, 0);
    let even = Settings { even_flow: true, ..room_aware };
    let layers = Planner::default().slices(&sample("cup"), &room_aware).unwrap();
    let [fitting, too_much] = [room_aware, even].map(|settings| planned("cup", &settings));
    for (position, layer) in layers.iter().take(3).enumerate() {
        let wall = ClosedCurve::new(layer.walls[0].points.clone()).unwrap();
        let room = wall.signed_area().abs() - 0.5 * 1.5 * wall.length();
        let share = |plan: &Plan| {
            let own = plan.strand.steps().filter(|step| step.layer == position && step.role == Role::Fill);
            own.map(|step| step.length() * step.width).sum::<f64>() / room
        };
        let (fits, exceeds) = (share(&fitting), share(&too_much));
        assert!((0.95..1.03).contains(&fits) && exceeds > 1.15, "layer {position}: {fits:.3}, {exceeds:.3}");
    }
    assert!(too_much.strand.steps().all(|step| step.width == 1.5));
}

#[test]
fn a_table_is_closed_above_and_below() {
    let plan = planned("table", &closed(2.5, 0, 2));
    let filled: Vec<usize> = plan.layers.iter().filter(|l| l.fill_length > 0.0).map(|l| l.index).collect();
    // Its legs have no room for fill; the plate has an underside and a roof of two layers each.
    let top = plan.layers.len() - 1;
    let [low, above, below, last] = filled[..] else { panic!("{filled:?}") };
    assert_eq!((above, below, last), (low + 1, top - 1, top));
}

#[test]
fn what_hangs_free_gets_an_underside() {
    let plan = planned("hanging-island", &closed(1.5, 1, 2));
    let filled: Vec<usize> = plan.layers.iter().filter(|l| l.fill_length > 0.0).map(|l| l.index).collect();
    // Its underside is two layers thick, and begins over layers that are open.
    let begins = |k: &usize| *k > 2 && !filled.contains(&(k - 1)) && filled.contains(&(k + 1));
    assert!(filled.iter().any(begins), "{filled:?}");
}

#[test]
fn two_walls_and_a_skin_are_one_strand() {
    let settings = Settings { walls: 2, ..closed(1.5, 2, 2) };
    let plan = planned("columns", &settings);
    // Two columns of two walls each, with a floor of two layers.
    assert!(plan.layers.iter().take(50).all(|layer| layer.walls == 4));
    let filled: Vec<usize> = plan.layers.iter().filter(|l| l.fill_length > 0.0).map(|l| l.index).collect();
    assert_eq!(filled, [0, 1]);
}

#[test]
fn the_report_tells_what_is_fill() {
    let plan = planned("columns", &closed(2.0, 2, 1));
    let told: f64 = plan.layers.iter().map(|layer| layer.fill_length).sum();
    let laid = plan.strand.length_of(Role::Fill);
    assert!(told > 0.0 && (told - laid).abs() < 1e-6 * laid, "{told} mm told, {laid} mm laid");
}

#[test]
fn without_floor_and_skin_nothing_is_filled() {
    let plan = Planner::default().plan(&sample("columns"), &Settings::for_width(2.0)).unwrap();
    assert!(plan.strand.length_of(Role::Fill) == 0.0);
}

#[test]
fn more_layers_than_a_part_can_have_are_refused() {
    for settings in [closed(1.5, 1001, 0), closed(1.5, 0, 1001)] {
        let refused = Planner::default().plan(&sample("columns"), &settings);
        assert!(matches!(refused, Err(PlanError::Setting { name: "floor" | "skin", .. })));
    }
}
