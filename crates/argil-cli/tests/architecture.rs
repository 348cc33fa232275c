//! What `docs/ARCHITECTURE.md` says of the workspace, held against the workspace.
#![allow(clippy::unwrap_used, reason = "a workspace that cannot be read fails the test")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

type Names = BTreeSet<String>;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The folders under `crates/` that hold a crate, by name.
fn crates() -> BTreeMap<String, PathBuf> {
    fs::read_dir(root().join("crates"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.join("Cargo.toml").is_file())
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), path))
        .collect()
}

/// The keys of the `[dependencies]` section of a manifest.
fn dependencies(manifest: &Path) -> Names {
    read(manifest)
        .lines()
        .map(str::trim)
        .skip_while(|line| *line != "[dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter(|line| !line.starts_with('#'))
        .filter_map(|line| line.split_once('='))
        .map(|(key, _)| key.trim().trim_end_matches(".workspace").to_owned())
        .collect()
}

fn is_sibling(name: &str) -> bool {
    name == "argil" || name.starts_with("argil-")
}

/// What the manifests say: each crate's siblings, and what it takes from elsewhere.
fn manifests() -> BTreeMap<String, (Names, Names)> {
    crates()
        .into_iter()
        .map(|(name, path)| {
            let all = dependencies(&path.join("Cargo.toml"));
            (name, all.into_iter().partition(|dependency| is_sibling(dependency)))
        })
        .collect()
}

/// The words in backticks of a table cell.
fn quoted(cell: &str) -> Names {
    cell.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// What the page says, from the table under "Who depends on whom".
fn table() -> BTreeMap<String, (Names, Names)> {
    read(&root().join("docs/ARCHITECTURE.md"))
        .lines()
        .skip_while(|line| *line != "## Who depends on whom")
        .skip(1)
        .take_while(|line| !line.starts_with("## "))
        .filter(|line| line.starts_with("| `"))
        .map(|row| {
            let cells: Vec<Names> = row.trim_matches('|').split('|').map(quoted).collect();
            let [name, siblings, outside] = &cells[..] else { panic!("three columns: {row}") };
            (name.first().unwrap().clone(), (siblings.clone(), outside.clone()))
        })
        .collect()
}

/// Everything that a crate reaches among its siblings.
fn reach(name: &str, manifests: &BTreeMap<String, (Names, Names)>) -> Names {
    let mut found = Names::new();
    let mut open = vec![name.to_owned()];
    while let Some(at) = open.pop() {
        for next in &manifests[&at].0 {
            if found.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    found
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
    found
}

#[test]
fn the_table_of_dependencies_is_that_of_the_manifests() {
    let (said, is) = (table(), manifests());
    assert!(is.len() > 10, "the workspace was not found");
    for (name, dependencies) in &is {
        assert_eq!(said.get(name), Some(dependencies), "{name}");
    }
    assert_eq!(said.keys().collect::<Vec<_>>(), is.keys().collect::<Vec<_>>());
}

#[test]
fn algorithms_know_nothing_of_the_planner_and_the_audit_nothing_of_planning() {
    let manifests = manifests();
    for name in manifests.keys().filter(|name| !["argil", "argil-cli"].contains(&name.as_str())) {
        let known = reach(name, &manifests);
        assert!(!known.contains("argil") && !known.contains("argil-cli"), "{name}");
    }
    let measured_with = reach("argil-audit", &manifests);
    for planning in ["support", "safeguard", "graph", "tour", "route", "elastic", "taut", "fill", "seam"] {
        assert!(!measured_with.contains(&format!("argil-{planning}")), "the audit reaches {planning}");
    }
}

#[test]
fn every_crate_has_a_page_and_forbids_unsafe_code() {
    for (name, path) in crates() {
        assert!(path.join("README.md").is_file(), "{name} has no README.md");
        let library = path.join("src/lib.rs");
        let top = if library.is_file() { library } else { path.join("src/main.rs") };
        assert!(read(&top).lines().any(|line| line == "#![forbid(unsafe_code)]"), "{}", top.display());
    }
}

#[test]
fn only_the_program_opens_files_or_prints() {
    let outward = ["std::fs", "fs::", "File::", "std::env", "println!", "eprintln!", "print!("];
    for (name, path) in crates().into_iter().filter(|(name, _)| name != "argil-cli") {
        for source in sources(&path.join("src")) {
            for line in read(&source).lines().filter(|line| !line.trim_start().starts_with("//")) {
                let met = outward.iter().find(|word| line.contains(**word));
                assert!(met.is_none(), "{name}: {} has {}", source.display(), line.trim());
            }
        }
    }
}
