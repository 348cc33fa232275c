//! Whoever looks for how something is used finds it: what a library offers stands in an example of that library, which needs no
//! sibling to run. That the examples end well is for the tests of documentation to say.
#![allow(clippy::unwrap_used, reason = "a workspace that cannot be read fails the test")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Models of which one is called like the other, and stages, which the programs in `crates/argil/examples` replace.
const WITHOUT: [&str; 11] = [
    "Route",
    "Safeguard",
    "Seam",
    "Slice",
    "Smooth",
    "Tauten",
    "cactus",
    "columns",
    "hanging_island",
    "nested_rings",
    "spire",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    files.into_iter().chain(folders.iter().flat_map(|folder| sources(folder))).collect()
}

/// The lines between fences.
fn fenced<'t>(lines: impl Iterator<Item = &'t str>) -> String {
    let (mut inside, mut code) = (false, String::new());
    for line in lines {
        if line.starts_with("```") {
            inside = !inside;
        } else if inside {
            code.push_str(line);
            code.push('\n');
        }
    }
    code
}

/// All examples of a crate: those of its page, and those of its documentation.
fn examples(folder: &Path) -> String {
    let page = fs::read_to_string(folder.join("README.md")).unwrap();
    let mut code = fenced(page.lines());
    for source in
        sources(&folder.join("src")).iter().filter(|path| path.extension().is_some_and(|e| e == "rs"))
    {
        let text = fs::read_to_string(source).unwrap();
        let told = text.lines().map(str::trim_start).filter_map(|line| {
            let line = line.strip_prefix("///").or_else(|| line.strip_prefix("//!"))?;
            Some(line.strip_prefix(' ').unwrap_or(line))
        });
        code.push_str(&fenced(told));
    }
    code
}

fn words(code: &str) -> BTreeSet<&str> {
    code.split(|c: char| !c.is_alphanumeric() && c != '_').collect()
}

/// What a line of `docs/api` offers: a type, a trait, a function or a constant; for what belongs to a type, both names. Fields and variants
/// stand with their type, errors with what returns them.
fn offered(line: &str) -> Vec<&str> {
    let word = |text: &'static str| {
        let (before, rest) = line.split_once(text)?;
        let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()?;
        Some((before, name))
    };
    let free = ["pub fn ", "pub trait ", "pub struct ", "pub enum ", "pub const "];
    if let Some((_, name)) = free.into_iter().find_map(word) {
        return if name.ends_with("Error") { Vec::new() } else { vec![name] };
    }
    let owned = [": const fn ", ": fn ", ": const "].into_iter().find_map(word);
    let names = owned.map(|(before, name)| [before.rsplit([' ', ':']).next().unwrap_or(before), name]);
    names.into_iter().flatten().collect()
}

#[test]
fn what_a_library_offers_is_shown_by_an_example() {
    let mut shown = 0;
    for entry in fs::read_dir(root().join("docs/api")).unwrap() {
        let path = entry.unwrap().path();
        let library = path.file_stem().unwrap().to_str().unwrap();
        let code = examples(&root().join("crates").join(library));
        let used = words(&code);
        let surface = fs::read_to_string(&path).unwrap();
        let names: Vec<&str> =
            surface.lines().filter(|line| !line.starts_with(' ')).flat_map(offered).collect();
        let missing: Vec<&&str> =
            names.iter().filter(|name| !used.contains(**name) && !WITHOUT.contains(name)).collect();
        assert!(missing.is_empty(), "{library}: no example has {missing:?}");
        shown += names.len();
    }
    assert!(shown > 600, "{shown} names");
}

/// What a crate needs of its siblings it exports, so that a program may depend on it alone.
#[test]
fn examples_of_libraries_need_no_sibling() {
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        let name = folder.file_name().unwrap().to_str().unwrap().replace('-', "_");
        // The facade's examples are made with the bundled models; the program has none.
        if ["argil", "argil_cli"].contains(&name.as_str()) || !folder.join("README.md").is_file() {
            continue;
        }
        let code = examples(&folder);
        let siblings: Vec<_> =
            words(&code).into_iter().filter(|word| word.starts_with("argil_") && *word != name).collect();
        assert!(siblings.is_empty(), "{name}: an example needs {siblings:?}");
    }
}

#[test]
fn eight_libraries_are_drawn() {
    for (library, picture) in [
        ("argil-curve", "held-spans"),
        ("argil-support", "support-points"),
        ("argil-safeguard", "safeguard"),
        ("argil-graph", "path-graph"),
        ("argil-tour", "tour"),
        ("argil-route", "cycle"),
        ("argil-elastic", "relaxed"),
        ("argil-fill", "fill"),
    ] {
        let folder = root().join("crates").join(library);
        let path = format!("../pictures/{picture}.svg");
        let svg = fs::read_to_string(folder.join("src").join(&path)).unwrap();
        // A page of documentation takes it for one block: a line that is one tag, and none that is blank.
        assert!(svg.lines().next().is_some_and(|line| line.starts_with("<svg ") && line.ends_with('>')));
        assert!(svg.ends_with("</svg>\n") && svg.lines().all(|line| !line.trim().is_empty()), "{library}");
        assert!(
            svg.matches("<path").count() + svg.matches("<circle").count() > 3,
            "{library}: nothing drawn"
        );
        let page = fs::read_to_string(folder.join("src/lib.rs")).unwrap();
        assert!(page.contains(&format!("include_str!(\"{path}\")")), "{library} does not show {picture}");
    }
}
