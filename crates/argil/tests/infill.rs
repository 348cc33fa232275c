//! Infill: in the same strand, sound, of the share that was asked for, and no dearer than support where that is left to the planner.

mod sample;
mod verdict;

use argil::strand::Role;
use argil::{Infill, InfillChoice, Plan, PlanError, Planner, Settings};
use sample::sample;
use verdict::audited;

/// The plan of a bundled model, which the audit must find sound.
fn planned(name: &str, settings: &Settings) -> Plan {
    let mesh = sample(name);
    let plan = Planner::default().plan(&mesh, settings).unwrap_or_else(|e| panic!("{name}: {e}"));
    let report = audited(&plan, &mesh, settings);
    assert!(report.is_sound(), "{name} falls short\n{report}");
    plan
}

fn infill_mm(plan: &Plan) -> f64 {
    plan.layers.iter().map(|layer| layer.infill_length).sum()
}

#[test]
fn every_layer_is_filled_sparsely_in_the_same_strand() {
    let settings = Settings { infill: Infill::Ratio(0.2), ..Settings::for_width(1.5) };
    let plan = planned("table", &settings);
    let told = infill_mm(&plan);
    let laid = plan.strand.length_of(Role::Fill);
    assert!(told > 0.0 && (told - laid).abs() < 0.02 * laid, "{told} mm told, {laid} mm laid");
    let twice = planned("table", &Settings { infill: Infill::Ratio(0.5), ..settings });
    assert!(
        infill_mm(&twice) > 1.4 * told,
        "{} mm for more than twice the share of {told}",
        infill_mm(&twice)
    );
}

#[test]
fn infill_goes_with_floors_skins_and_walls() {
    let settings =
        Settings { walls: 2, floor: 2, skin: 2, infill: Infill::Ratio(0.3), ..Settings::for_width(1.5) };
    let plan = planned("columns", &settings);
    assert!(
        plan.layers.iter().take(2).all(|layer| layer.infill_length == 0.0),
        "a floor has no room for more"
    );
    assert!(plan.layers.iter().all(|layer| layer.infill_length <= layer.fill_length + 1.0));
}

#[test]
fn the_shorter_of_two_plans_is_taken() {
    let settings = Settings { skin: 1, infill: Infill::Auto, ..Settings::for_width(2.5) };
    let plan = planned("table", &settings);
    let Some(InfillChoice { taken, with_mm: Some(with), without_mm: Some(without) }) = plan.infill else {
        panic!("{:?}", plan.infill)
    };
    assert_eq!(taken, with < without);
    assert!((plan.strand.length() - with.min(without)).abs() < 1e-6);
    assert_eq!(infill_mm(&plan) > 0.0, taken);
    let bare = planned("table", &Settings { infill: Infill::None, ..settings });
    assert!((bare.strand.length() - without).abs() < 1e-6 && bare.infill.is_none());
}

#[test]
fn shares_that_are_none_are_refused() {
    for share in [0.0, -0.1, 1.01, f64::NAN, f64::INFINITY] {
        let settings = Settings { infill: Infill::Ratio(share), ..Settings::for_width(1.5) };
        let refused = Planner::default().plan(&sample("cup"), &settings);
        assert!(matches!(refused, Err(PlanError::Setting { name: "infill", .. })), "{share}");
    }
}
