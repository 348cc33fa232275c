//! The same input gives the same bytes, and a print in another size is the same print.

mod sample;
mod verdict;

use argil::mesh::{Ground, Mesh, Placement, Size};
use argil::strand::Role;
use argil::{Plan, Planner, Settings};
use sample::sample;
use verdict::{audited, gcode};

fn planned(mesh: &Mesh, settings: &Settings) -> Plan {
    Planner::default().plan(mesh, settings).expect("there is a plan")
}

/// Strand beside the model by strand of the model.
fn ratio(plan: &Plan) -> f64 {
    plan.strand.length() / plan.strand.length_of(Role::Wall) - 1.0
}

#[test]
fn two_runs_give_the_same_bytes() {
    let settings = Settings::for_width(2.0);
    for name in ["columns", "hanging-island"] {
        let mesh = sample(name);
        let (first, second) = (planned(&mesh, &settings), planned(&mesh, &settings));
        assert!(gcode(&first) == gcode(&second), "{name} differs from run to run");
        assert_eq!(first.layers, second.layers);
    }
}

#[cfg(feature = "rayon")]
#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let settings = Settings::for_width(2.0);
    let mesh = sample("table");
    let by = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        gcode(&pool.install(|| planned(&mesh, &settings)))
    };
    let alone = by(1);
    assert!(alone == by(2) && alone == by(7), "the plan depends on the number of threads");
}

#[test]
fn a_planner_remembers_nothing_that_shows() {
    let settings = Settings::for_width(3.0);
    let mut planner = Planner::default();
    let fresh = gcode(&planner.plan(&sample("columns"), &settings).expect("there is a plan"));
    planner.plan(&sample("arch"), &settings).expect("there is a plan");
    let again = gcode(&planner.plan(&sample("columns"), &settings).expect("there is a plan"));
    assert!(fresh == again, "a plan depends on what the planner did before");
}

#[test]
fn a_bead_of_concrete_behaves_like_one_of_clay() {
    let clay = sample("columns");
    let placement = Placement { size: Size::Scale(20.0), ground: Ground::Keep };
    let concrete = clay.placed(&placement).expect("a mesh can be scaled");
    let (thin, thick) = (Settings::for_width(1.5), Settings::for_width(30.0));
    let (small, large) = (planned(&clay, &thin), planned(&concrete, &thick));
    assert_eq!(small.strand.layers().len(), large.strand.layers().len());
    let (a, b) = (ratio(&small), ratio(&large));
    assert!((a / b - 1.0).abs() < 0.15, "ratio {a} at 1.5 mm, {b} at 30 mm");
    let report = audited(&large, &concrete, &thick);
    assert!(report.is_sound(), "a bead of 30 mm falls short\n{report}");
}
