//! Five fixed pieces of work, for counting instructions: `fixed CASE`; without a case it lists them.
//!
//! `.ci/instructions` runs each under valgrind and compares the count with the one that is kept beside it.

use std::error::Error;
use std::hint::black_box;
use std::io::{self, Write};
use std::process::ExitCode;

use argil::{Planner, Settings};
use argil_benches::{Excursions, MixedLayer, WIDTH};
use argil_elastic::{Carrier, ElasticOptions, ElasticSolver, Path};
use argil_mesh::{Mesh, read_stl};
use argil_slice::{SliceSettings, slice};
use argil_tour::{MatrixMetric, TourOptions, shortest_tour};

type Work = fn() -> Result<(), Box<dyn Error>>;

const CASES: [(&str, Work); 5] =
    [("distances", distances), ("tour", tour), ("elastic", elastic), ("slice", slices), ("plan", plan)];

fn main() -> ExitCode {
    let wanted = std::env::args().nth(1);
    let case = CASES.iter().find(|case| Some(case.0) == wanted.as_deref());
    let done = match case {
        Some((_, work)) => work(),
        None => CASES.iter().try_for_each(|(name, _)| Ok(writeln!(io::stdout(), "{name}")?)),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing can be done if even this fails.
            drop(writeln!(io::stderr(), "fixed: {error}"));
            ExitCode::FAILURE
        }
    }
}

/// Graph and distances of a layer with 400 support points.
fn distances() -> Result<(), Box<dyn Error>> {
    black_box(MixedLayer::new(400, 1).distances()?);
    Ok(())
}

/// The same with 100 points, and two tours, the second from the first.
fn tour() -> Result<(), Box<dyn Error>> {
    let lengths = MixedLayer::new(100, 1).distances()?;
    let metric = MatrixMetric::new(100, &lengths)?;
    let options = TourOptions { kicks_per_node: 4.0, patience_per_node: 4.0, ..TourOptions::default() };
    let cold = shortest_tour(&metric, &[], None, &options);
    black_box(shortest_tour(&metric, &[], Some(&cold.order), &options));
    Ok(())
}

/// A wall with four excursions, relaxed.
fn elastic() -> Result<(), Box<dyn Error>> {
    let made = Excursions::new(4, 1);
    let carriers: Vec<Carrier> =
        made.carriers.iter().map(|&(vertex, anchor)| Carrier { vertex, anchor }).collect();
    let path =
        Path { points: &made.points, fixed: &made.fixed, carriers: &carriers, clear_of: None, felt: &[] };
    black_box(ElasticSolver::new().relax(&path, &ElasticOptions::for_width(WIDTH))?);
    Ok(())
}

/// A bundled model in layers.
fn slices() -> Result<(), Box<dyn Error>> {
    black_box(slice(&bundled("cup")?, &SliceSettings::default())?);
    Ok(())
}

/// A bundled model planned, with a thick bead so that it takes seconds under valgrind.
fn plan() -> Result<(), Box<dyn Error>> {
    black_box(Planner::default().plan(&bundled("table")?, &Settings::for_width(3.0))?);
    Ok(())
}

fn bundled(name: &str) -> Result<Mesh, Box<dyn Error>> {
    let solid = argil_models::by_name(name).ok_or_else(|| format!("there is no model {name}"))?;
    Ok(read_stl(&solid.to_stl())?)
}
