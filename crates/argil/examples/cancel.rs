//! Progress, and a plan that ends when somebody has had enough of it.

use std::error::Error;
use std::ops::ControlFlow;

use argil::{PlanError, Planner, Progress, Settings};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mesh = argil::mesh::read_stl(&argil_models::by_name("columns").ok_or("no such model")?.to_stl())?;
    let settings = Settings::for_width(2.5);
    let mut planner = Planner::default();

    // A bar would show this share; a button would break off.
    let (mut layers, mut done, mut calls_after) = (0, 0, 0);
    let mut share = 0.0;
    let outcome = planner.plan_controlled(&mesh, &settings, &mut |progress| {
        calls_after += usize::from(share >= 0.5);
        match progress {
            Progress::Sliced { layers: count } => layers = count,
            Progress::Layer { .. } => done += 1,
            _ => {}
        }
        share = f64::from(done) / layers.max(1) as f64;
        if share >= 0.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(outcome, Err(PlanError::Cancelled)), "{outcome:?}");
    assert!(layers > 4 && usize::try_from(done)? == layers.div_ceil(2), "{done} of {layers} layers");
    assert_eq!(calls_after, 0, "nobody is told after the end");

    // In the middle of a layer as well.
    let mut cycles = 0;
    let outcome = planner.plan_controlled(&mesh, &settings, &mut |progress| {
        cycles += usize::from(progress == Progress::Smoothing);
        if cycles == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(outcome, Err(PlanError::Cancelled)), "{outcome:?}");

    // The planner is none the worse for it, and being watched changes nothing.
    let mut told = Vec::new();
    let mut asked = 0_usize;
    let watched = planner.plan_controlled(&mesh, &settings, &mut |progress| {
        asked += 1;
        if progress != Progress::Working {
            told.push(progress);
        }
        ControlFlow::Continue(())
    })?;
    assert_eq!(watched.strand, Planner::default().plan(&mesh, &settings)?.strand);
    assert_eq!((told.first(), told.last()), (Some(&Progress::Sliced { layers }), Some(&Progress::Descended)));
    assert!(told.iter().filter(|p| **p == Progress::Routing).count() >= layers);

    // Whenever it is asked, also while the mesh is cut and the layers are joined.
    for end in (1..=asked).rev().step_by(asked.div_ceil(10)).chain([1, 2]) {
        let mut count = 0;
        let outcome = planner.plan_controlled(&mesh, &settings, &mut |_| {
            count += 1;
            if count == end { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(
            matches!(outcome, Err(PlanError::Cancelled)) && count == end,
            "{end} of {asked}: {outcome:?}"
        );
    }
    Ok(())
}
