//! What must hold of every strand that the planner returns.

mod invariants;
mod sample;

use argil::strand::Role;
use argil::{Planner, Settings};
use invariants::departures;
use sample::sample;

fn assert_holds(name: &str, settings: &Settings) {
    let mut planner = Planner::default();
    let mesh = sample(name);
    let layers = planner.slices(&mesh, settings).expect("the mesh can be sliced");
    let plan = planner.plan(&mesh, settings).unwrap_or_else(|e| panic!("{name}: {e}"));
    let found = departures(&plan, &layers, settings);
    assert!(found.is_empty(), "{name}:\n{}", found.join("\n"));
    let walls: f64 = plan.layers.iter().map(|layer| layer.wall_length).sum();
    assert!((walls / plan.strand.length_of(Role::Wall) - 1.0).abs() < 1e-9, "the reports tell other walls");
}

#[test]
fn islands_that_lean() {
    assert_holds("columns", &Settings::for_width(1.5));
}

#[test]
fn islands_that_merge() {
    assert_holds("spire", &Settings::for_width(2.0));
}

#[test]
fn a_crown_over_nothing() {
    assert_holds("arch", &Settings::for_width(2.0));
}

#[test]
fn a_body_that_begins_in_mid_air() {
    assert_holds("hanging-island", &Settings::for_width(1.5));
}

#[test]
fn islands_in_holes_in_islands() {
    assert_holds("nested-rings", &Settings::for_width(2.5));
}

#[test]
fn beads_that_are_as_high_as_they_are_wide() {
    assert_holds("table", &Settings { layer_height: 2.0, ..Settings::for_width(2.0) });
}

#[test]
fn a_paste_that_bears_little() {
    let mut settings = Settings::for_width(2.5);
    settings.material.across = 0.2;
    settings.material.along = 1.2;
    assert_holds("columns", &settings);
}
