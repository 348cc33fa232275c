//! The paper's text taken literally: a whole strand, and the faults that the sound planner mends.

mod sample;
mod verdict;

use argil::slice::slice;
use argil::strand::Role;
use argil::{Plan, Planner, Settings, literal};
use argil_audit::Report;
use sample::sample;
use verdict::audited;

/// A coarse bead, so that there are few layers.
fn settings() -> Settings {
    Settings::for_width(3.0)
}

fn literally(name: &str) -> Plan {
    literal::planner().plan(&sample(name), &settings()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn soundly(name: &str) -> Plan {
    Planner::default().plan(&sample(name), &settings()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn measured(plan: &Plan, name: &str) -> Report {
    audited(plan, &sample(name), &settings())
}

/// Length of all walls of a model, mm.
fn wall_length(name: &str) -> f64 {
    let layers = slice(&sample(name), &settings().slicing()).expect("bundled models can be cut");
    let length = |p: &[argil::curve::DVec2]| -> f64 {
        (0..p.len()).map(|k| p[k].distance(p[(k + 1) % p.len()])).sum()
    };
    layers.iter().flat_map(|layer| &layer.walls).map(|wall| length(&wall.points)).sum()
}

/// Whatever else is wrong with it, the strand is one, and every wall is in it.
fn assert_whole(plan: &Plan, report: &Report, name: &str) {
    let (printed, walls) = (plan.strand.length_of(Role::Wall), wall_length(name));
    assert!((printed - walls).abs() < 1e-5 * walls, "{name}: {printed} of {walls} mm");

    let figures = &report.figures;
    assert_eq!(figures.transfer_moves + figures.retractions + figures.open_layers, 0, "{name}");
    assert_eq!(figures.paths_per_layer_max, 1, "{name}");
    assert!(figures.layers >= figures.wanted_layers, "{name}");
}

#[test]
fn every_wall_is_printed_in_one_strand() {
    for name in ["columns", "arch"] {
        let plan = literally(name);
        assert_whole(&plan, &measured(&plan, name), name);
    }
}

#[test]
fn the_same_model_gives_the_same_strand() {
    assert_eq!(literally("columns").strand, literally("columns").strand);
}

/// Known to go wrong: tips retract from what they held, walls are left and joined against their order, and
/// layers begin over nothing.
#[test]
fn the_text_leaves_faults_that_the_sound_planner_does_not() {
    let name = "hanging-island";
    let text = measured(&literally(name), name).figures;
    assert!(text.unsupported_spans > 0 && text.self_crossings > 0 && text.seam_starts_unsupported > 0);

    let sound = measured(&soundly(name), name).figures;
    let faults = (sound.unsupported_spans, sound.self_crossings, sound.seam_starts_unsupported);
    assert_eq!(faults, (0, 0, 0));
}

/// Known to go wrong: the regions between nested rings hang on one point of each ring.
#[test]
fn nested_regions_pass_through_walls() {
    let name = "nested-rings";
    let text = literally(name);
    let report = measured(&text, name);
    assert_whole(&text, &report, name);
    assert!(report.figures.wall_crossings > 0);
    assert_eq!(measured(&soundly(name), name).figures.wall_crossings, 0);
}

/// A stage of the text fits into the sound planner by itself, so that its part in the faults can be told.
#[test]
fn one_stage_at_a_time_can_be_put_back() {
    let name = "columns";
    let own = Planner::default();
    let mut spliced = Planner {
        slice: own.slice,
        safeguard: own.safeguard,
        support: own.support,
        route: literal::SplicedRoute,
        smooth: own.smooth,
        taut: own.taut,
        seam: own.seam,
        checked: false,
    };
    let plan = spliced.plan(&sample(name), &settings()).expect("columns can be planned");
    assert!(measured(&plan, name).figures.self_crossings > 0);
    assert_eq!(measured(&soundly(name), name).figures.self_crossings, 0);
}
