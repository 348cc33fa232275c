//! Writes the tables of `docs/RESULTS.md` and the pictures beside them.
//!
//! ```text
//! cargo run --release -p argil-benches --example results -- FOLDER-OF-MODELS
//! ```
//!
//! Models are not part of the project: whoever runs this says where they lie. What is found there under a known name is
//! planned and measured; without a folder the bundled models are. The text between the tables is left as it is. With `--judge`
//! an independent program measures the same files, and a further table tells how far the two differ.
#![forbid(unsafe_code)]
#![allow(clippy::print_stderr, reason = "a program that runs for minutes tells how far it is")]

mod ablation;
mod document;
mod judge;
mod measure;
mod pictures;
mod reference;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{fs, io};

use argil::mesh::{Mesh, Placement, read_stl};
use argil_audit::Report;
use clap::Parser;

use document::{Document, Table};
use judge::Judge;
use measure::measured;

/// What may go wrong is told to whoever runs this, and no more.
pub(crate) type Outcome<T> = Result<T, Box<dyn Error>>;

/// Writes the tables of the results.
#[derive(Debug, Parser)]
struct Args {
    /// The folder of models, STL files in millimetres.
    models: Option<PathBuf>,
    /// The page to be written.
    #[arg(long, default_value = "docs/RESULTS.md")]
    page: PathBuf,
    /// Where pictures go.
    #[arg(long, default_value = "docs/pictures")]
    pictures: PathBuf,
    /// Models to be measured, by name; all that are known by default.
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
    /// Numbers of walls.
    #[arg(long, value_delimiter = ',', default_value = "1,2,3")]
    walls: Vec<usize>,
    /// An independent judge: a Python program that takes g-code, mesh and `--json FILE`.
    #[arg(long)]
    judge: Option<PathBuf>,
    /// The Python that runs it.
    #[arg(long, default_value = "python3")]
    python: PathBuf,
    /// A folder of g-code files of other slicers, MODEL.SLICER.gcode, one wall, bead 1.5 mm, layer 0.5 mm.
    #[arg(long)]
    foreign: Option<PathBuf>,
    /// Where files are kept between the plan and the judge.
    #[arg(long)]
    work: Option<PathBuf>,
    /// Tables to be written: models, peers (of models), parity (with a judge), bundled (with pictures), ablations (which
    /// plan five models a dozen times). The others stay as they are.
    #[arg(long, value_delimiter = ',', default_value = "models,peers,parity,bundled,ablations")]
    tables: Vec<String>,
}

/// A model and its mesh, standing on the bed.
pub(crate) struct Model {
    pub(crate) name: String,
    pub(crate) mesh: Mesh,
}

/// A model of the folder, if the folder has it.
fn model(folder: &Path, name: &str) -> Outcome<Option<Model>> {
    let bytes = match fs::read(folder.join(format!("{name}.stl"))) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    Ok(Some(Model { name: name.to_owned(), mesh: read_stl(&bytes)?.placed(&Placement::default())? }))
}

fn bundled() -> Outcome<Vec<Model>> {
    let named = |name: &'static str| -> Outcome<Model> {
        let solid = argil_models::by_name(name).ok_or("a bundled model has gone")?;
        let mesh = read_stl(&solid.to_stl())?.placed(&Placement::default())?;
        Ok(Model { name: name.to_owned(), mesh })
    };
    argil_models::names().map(named).collect()
}

fn main() -> Outcome<()> {
    let args = Args::parse();
    let mut page = Document::read(&args.page)?;
    let mut models = Vec::new();
    if let Some(folder) = &args.models {
        for name in reference::NAMES.into_iter().filter(|name| args.wants(name)) {
            models.extend(model(folder, name)?);
        }
    }
    if args.writes("models") || args.writes("peers") || args.writes("parity") {
        measure_models(&args, &models, &mut page)?;
    }
    if args.writes("ablations") {
        let chosen = models.iter().filter(|model| ablation::MODELS.contains(&model.name.as_str()));
        page.put("ablations", &ablation::table(&chosen.collect::<Vec<_>>())?);
    }
    if args.writes("bundled") {
        measure_bundled(&args, &mut page)?;
    }
    page.write(&args.page)
}

impl Args {
    fn wants(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|only| only == name)
    }

    fn writes(&self, table: &str) -> bool {
        self.tables.iter().any(|chosen| chosen == table)
    }
}

/// The models of the folder: by themselves, beside what others have, and as a judge measures the same files.
fn measure_models(args: &Args, models: &[Model], page: &mut Document) -> Outcome<()> {
    let judge = args.judge.as_ref().filter(|_| args.writes("parity"));
    let judge = judge.map(|program| Judge::new(&args.python, program, args.work.as_deref()));
    let judge = judge.as_ref().zip(args.models.as_deref());
    let mut table = Table::new(&measure::COLUMNS);
    let mut parity = Table::new(&judge::COLUMNS);
    let mut one_wall: Vec<(String, Report)> = Vec::new();
    for model in models {
        for &walls in &args.walls {
            eprintln!("{} with {walls} walls", model.name);
            let measured = measured(model, walls)?;
            table.row(measured.row());
            let (Some(gcode), Some(report)) = (&measured.gcode, measured.report) else { continue };
            if let Some((judge, folder)) = judge {
                parity.row(judge.compared(&model.name, "argil", gcode, folder, walls, &report)?);
            }
            if walls == 1 {
                one_wall.push((model.name.clone(), report));
            }
        }
    }
    if let Some(((judge, folder), foreign)) = judge.zip(args.foreign.as_ref()) {
        for (name, slicer, gcode) in judge::foreign_files(foreign)? {
            if let Some(model) = models.iter().find(|model| model.name == name) {
                eprintln!("{name} by {slicer}");
                let report = measure::audited(&gcode, &model.mesh, 1)?;
                parity.row(judge.compared(&name, &slicer, &gcode, folder, 1, &report)?);
            }
        }
    }
    page.put("parity", &parity);
    if args.writes("models") {
        page.put("models", &table);
    }
    if args.writes("peers") {
        page.put("peers", &reference::beside(&one_wall));
    }
    Ok(())
}

/// The bundled models, with pictures of two layers of each.
fn measure_bundled(args: &Args, page: &mut Document) -> Outcome<()> {
    let mut table = Table::new(&measure::COLUMNS);
    for model in bundled()?.iter().filter(|model| args.wants(&model.name)) {
        for &walls in &args.walls {
            eprintln!("bundled {} with {walls} walls", model.name);
            let measured = measured(model, walls)?;
            table.row(measured.row());
            if let (1, Some(plan)) = (walls, &measured.plan) {
                pictures::two_layers(&model.name, plan, &args.pictures)?;
            }
        }
    }
    page.put("bundled", &table);
    Ok(())
}
