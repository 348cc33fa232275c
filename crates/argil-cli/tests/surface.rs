//! What each library shows is written down in `docs/api`, so that a change of it is seen where changes are read.
//!
//! `ARGIL_SURFACE=write cargo test -p argil-cli --test surface` writes it anew. What a macro makes is not in it.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a workspace that cannot be read fails the test")]

#[path = "surface/listing.rs"]
mod listing;
#[path = "surface/source.rs"]
mod source;
#[path = "surface/threads.rs"]
mod threads;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use listing::listing;

#[test]
fn the_surface_of_every_library_is_the_one_written_down() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let written = root.join("docs/api");
    let write = std::env::var_os("ARGIL_SURFACE").is_some_and(|value| value == "write");
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(root.join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        if !folder.join("src/lib.rs").is_file() {
            continue;
        }
        let file = format!("{}.txt", folder.file_name().unwrap().to_str().unwrap());
        let is = listing(&folder);
        if write {
            fs::write(written.join(&file), &is).unwrap();
        }
        let said = fs::read_to_string(written.join(&file)).unwrap_or_default();
        let (new, old): (BTreeSet<&str>, BTreeSet<&str>) = (is.lines().collect(), said.lines().collect());
        let (more, gone): (Vec<_>, Vec<_>) = (new.difference(&old).collect(), old.difference(&new).collect());
        assert!(is == said, "docs/api/{file} is not what the crate shows: new {more:#?}, gone {gone:#?}");
        names.insert(file);
    }
    let kept: BTreeSet<String> =
        fs::read_dir(written).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(kept, names, "one file a library");
}

/// The structures and enumerations that a library shows: the name, and what is written down of it.
fn shown() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let files = fs::read_dir(root.join("docs/api")).unwrap().map(|entry| entry.unwrap().path());
    let mut found = Vec::new();
    for surface in files.map(|file| fs::read_to_string(file).unwrap()) {
        let lines: Vec<&str> = surface.lines().filter(|line| !line.starts_with(' ')).collect();
        for line in &lines {
            let declared = line.split_once("pub struct ").or_else(|| line.split_once("pub enum "));
            let Some((before, rest)) = declared else { continue };
            let name: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
            // What is implemented by hand counts as what is derived.
            let by_hand = lines.iter().filter_map(|line| line.split_once("impl")?.1.split_once(" for "));
            let traits = by_hand.filter(|(_, of)| of.split('<').next() == Some(&name)).map(|(of, _)| of);
            let traits = traits.map(|of| of.rsplit("::").next().unwrap_or(of));
            let told = before.to_owned() + &traits.collect::<Vec<_>>().join(" ");
            found.push((name, told));
        }
    }
    assert!(found.len() > 100, "the surfaces were not found");
    found
}

fn named(told: &str, word: &str) -> bool {
    told.split(|c: char| !c.is_alphanumeric() && c != '_').any(|one| one == word)
}

#[test]
fn what_a_program_keeps_can_go_to_another_thread() {
    let known: BTreeSet<&str> = threads::types()
        .into_iter()
        .map(|path| path.split('<').next().unwrap_or(path).rsplit("::").next().unwrap_or(path))
        .chain(threads::BOUND)
        .collect();
    for (name, _) in shown() {
        assert!(known.contains(name.as_str()), "{name} is not among the types that threads share");
    }
}

#[test]
fn every_type_can_be_looked_at_and_copied_and_errors_may_grow() {
    // An error of the rasteriser, kept as it came.
    let uncopied = ["PreviewError"];
    for (name, told) in shown() {
        assert!(named(&told, "Debug"), "{name} cannot be printed");
        assert!(named(&told, "Clone") || uncopied.contains(&name.as_str()), "{name} cannot be cloned");
        let is_error = name.ends_with("Error") || name == "LayerFault";
        assert!(!is_error || named(&told, "non_exhaustive"), "{name} cannot grow");
        assert!(is_error || !named(&told, "Error"), "{name} is an error by another name");
    }
}

/// What holds functions, memory for searches or an index, and what borrows such a thing: no plain values.
const NO_VALUES: [&str; 20] = [
    "DistanceLabels",
    "Distances",
    "Edges",
    "ElasticCurve",
    "ElasticSolver",
    "Field",
    "Gcode",
    "LayerInput",
    "Path",
    "PathFinder",
    "PathGraph",
    "Planner",
    "PointIndex",
    "Poses",
    "Router",
    "SeenFrom",
    "SegmentIndex",
    "SlackPath",
    "SplicedRouter",
    "TourSolver",
];

/// Values that nobody keeps in a file: borrowed input, what is told in passing, what follows from other values, and
/// distances, which may be infinite.
const NOT_WRITTEN: [&str; 13] = [
    "Amount",
    "DistanceMatrix",
    "EdgeTable",
    "FreeSpace",
    "ImlsField",
    "MatrixMetric",
    "Nodes",
    "PointKind",
    "Progress",
    "Section",
    "ShortestTours",
    "TourDistances",
    "Wall",
];

#[test]
fn every_value_can_be_compared_and_kept_in_a_file() {
    for (name, told) in shown() {
        let is_error = named(&told, "Error");
        let (is_value, is_stage) =
            (!NO_VALUES.contains(&name.as_str()), told.contains("stages: ") || told.contains("literal: "));
        assert_eq!(is_value || is_error, named(&told, "PartialEq") || name == "PreviewError", "{name}");
        let is_kept = is_value && !is_error && !is_stage && !NOT_WRITTEN.contains(&name.as_str());
        assert_eq!(is_kept, named(&told, "Serialize"), "{name}");
    }
}

#[test]
fn signatures_are_found_among_comments_and_literals() {
    let code = source::bare(
        "// pub fn a()\npub fn b<'a>(x: &'a str) -> char { '\\'' ; \"}\"; 'x' }\npub struct C { pub d: [u8; 2] }\n",
    );
    let found = source::items(&code);
    let heads: Vec<&str> = found.iter().map(|item| item.head.as_str()).collect();
    assert_eq!(heads, ["pub fn b<'a>(x: &'a str) -> char", "pub struct C"]);
    assert_eq!(
        source::parts("pub a: Map<K, V>, #[x] pub b: fn(u8, u8) -> u8,"),
        ["pub a: Map<K, V>", "pub b: fn(u8, u8) -> u8"]
    );
}
