//! The same files, measured by a program that shares no code with argil.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use argil_audit::Report;
use serde_json::Value;

use crate::Outcome;

/// Heads of the columns that [`Judge::compared`] fills.
pub(crate) const COLUMNS: [&str; 6] =
    ["model", "walls", "file of", "both say sound", "figures", "largest difference"];

/// Differences of figures less than this are none: shares of a length to the fourth decimal.
const NOTHING: f64 = 5e-5;

/// A Python program and where it finds its files.
pub(crate) struct Judge {
    python: PathBuf,
    program: PathBuf,
    work: PathBuf,
}

impl Judge {
    pub(crate) fn new(python: &Path, program: &Path, work: Option<&Path>) -> Self {
        let work = work.map_or_else(|| std::env::temp_dir().join("argil-results"), Path::to_path_buf);
        Self { python: python.to_owned(), program: program.to_owned(), work }
    }

    /// A row: how far the judge's figures are from those of the audit. Bead 1.5 mm, layer 0.5 mm.
    pub(crate) fn compared(
        &self,
        name: &str,
        slicer: &str,
        gcode: &str,
        models: &Path,
        walls: usize,
        report: &Report,
    ) -> Outcome<Vec<String>> {
        fs::create_dir_all(&self.work)?;
        let file = self.work.join(format!("{name}.{slicer}.gcode"));
        let json = self.work.join(format!("{name}.{slicer}.json"));
        fs::write(&file, gcode)?;
        // Its exit status is the verdict, and so is what it writes.
        let output = Command::new(&self.python)
            .arg(&self.program)
            .arg(&file)
            .arg(models.join(format!("{name}.stl")))
            .args(["--walls", &walls.to_string(), "--json"])
            .arg(&json)
            .output()?;
        let told: Value = match fs::read(&json) {
            Ok(bytes) => serde_json::from_slice(&bytes)?,
            Err(_) => return Err(String::from_utf8_lossy(&output.stderr).into_owned().into()),
        };
        let sound = told["falls_short"].as_array().is_some_and(Vec::is_empty);
        let agreed = match (sound, report.is_sound()) {
            (true, true) => "yes",
            (false, false) => "neither",
            _ => "they differ",
        };
        let pairs: Vec<(&str, f64, f64)> = report
            .figures
            .entries()
            .into_iter()
            .filter_map(|(figure, amount)| Some((figure, amount.value(), told[figure].as_f64()?)))
            .collect();
        let difference = |&(_, ours, theirs): &(&str, f64, f64)| {
            if (ours - theirs).abs() <= NOTHING {
                0.0
            } else {
                (ours - theirs).abs() / theirs.abs().max(NOTHING)
            }
        };
        let largest = pairs.iter().max_by(|a, b| difference(a).total_cmp(&difference(b)));
        let largest = largest.filter(|pair| difference(pair) > 0.0);
        Ok(vec![
            name.to_owned(),
            walls.to_string(),
            slicer.to_owned(),
            agreed.to_owned(),
            pairs.len().to_string(),
            largest.map_or("none".to_owned(), |pair| {
                format!("{:.2} % of {}", 100.0 * difference(pair), pair.0.replace('_', " "))
            }),
        ])
    }
}

/// Model, slicer and text of every MODEL.SLICER.gcode in a folder, in the order of their names.
pub(crate) fn foreign_files(folder: &Path) -> Outcome<Vec<(String, String, String)>> {
    let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Outcome<Vec<_>>>()?;
    paths.sort();
    let mut files = Vec::new();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if let Some((model, slicer)) = name.strip_suffix(".gcode").and_then(|name| name.rsplit_once('.')) {
            files.push((model.to_owned(), slicer.to_owned(), fs::read_to_string(&path)?));
        }
    }
    Ok(files)
}
