//! The pages of the project hang together: the book has all of them, links lead somewhere, formats are told in full.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Every page of the project: its root's, the book's, the crates'.
fn pages() -> Vec<PathBuf> {
    let crates = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let mut pages: Vec<PathBuf> = crates
        .chain([root(), root().join("docs")])
        .flat_map(|folder| {
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect::<Vec<_>>()
        })
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect();
    pages.sort();
    pages
}

/// A page without its blocks of code.
fn prose(text: &str) -> String {
    let mut inside = false;
    let mut prose = String::new();
    for line in text.lines() {
        let fence = line.trim_start().starts_with("```");
        inside ^= fence;
        if !inside && !fence {
            prose.push_str(line);
            prose.push('\n');
        }
    }
    prose
}

/// Where the links and pictures of a page lead.
fn links(text: &str) -> Vec<String> {
    let prose = prose(text);
    prose
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split(')').next())
        .map(|to| to.replace('\n', ""))
        .collect()
}

/// The name by which a heading is linked to, as GitHub and mdBook make it.
fn anchor(heading: &str) -> String {
    let kept = heading
        .trim()
        .to_lowercase()
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c))
        .collect::<String>();
    kept.replace(' ', "-")
}

fn anchors(text: &str) -> BTreeSet<String> {
    prose(text)
        .lines()
        .filter(|line| line.starts_with('#'))
        .map(|line| anchor(line.trim_start_matches('#')))
        .collect()
}

#[test]
fn the_book_has_every_page_once() {
    let docs = root().join("docs");
    let listed = links(&read(&docs.join("SUMMARY.md")));
    let unique: BTreeSet<&String> = listed.iter().collect();
    assert_eq!(unique.len(), listed.len(), "a page is listed twice");
    let there: BTreeSet<String> = fs::read_dir(&docs)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".md") && name != "SUMMARY.md")
        .collect();
    assert!(there.len() > 8, "the book was not found");
    assert_eq!(unique.into_iter().cloned().collect::<BTreeSet<_>>(), there);
    let book: toml::Table = toml::from_str(&read(&docs.join("book.toml"))).unwrap();
    assert_eq!(book["book"]["src"].as_str(), Some("."));
}

#[test]
fn links_lead_to_what_is_there() {
    let mut followed = 0;
    for page in pages() {
        let text = read(&page);
        for link in links(&text).into_iter().filter(|link| !link.starts_with("http")) {
            let (file, place) = link.split_once('#').unwrap_or((&link, ""));
            let target = if file.is_empty() { page.clone() } else { page.parent().unwrap().join(file) };
            assert!(target.exists(), "{}: {link} leads nowhere", page.display());
            let leads = place.is_empty() || anchors(&read(&target)).contains(place);
            assert!(leads, "{}: {link} has no such heading", page.display());
            followed += 1;
        }
    }
    assert!(followed > 60, "{followed} links");
}

/// The keys of a JSON object.
fn keys(value: &Value) -> BTreeSet<String> {
    value.as_object().unwrap().keys().cloned().collect()
}

#[test]
fn formats_are_told_in_full() {
    let page = read(&root().join("docs/FORMATS.md"));
    let page = prose(&page);
    let told: BTreeSet<&str> = page.split('`').skip(1).step_by(2).collect();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book");
    drop(fs::remove_dir_all(&folder));
    fs::create_dir_all(&folder).unwrap();
    let words =
        "plan sample:columns --width 3 -o o.gcode --report r.json --strand s.json --poses p.csv --quiet";
    let mut command = Command::new(env!("CARGO_BIN_EXE_argil"));
    assert!(command.args(words.split(' ')).current_dir(&folder).status().unwrap().success());

    let json = |name: &str| serde_json::from_str::<Value>(&read(&folder.join(name))).unwrap();
    let (report, strand) = (json("r.json"), json("s.json"));
    let mut written: BTreeSet<String> =
        [&report, &report["audit"], &strand, &strand["layers"][1]].into_iter().flat_map(keys).collect();
    written.extend(keys(&strand["layers"][1]["moves"][0]));
    written.extend(read(&folder.join("p.csv")).lines().next().unwrap().split(',').map(str::to_owned));
    let gcode = read(&folder.join("o.gcode"));
    let comments = gcode.lines().filter(|line| line.starts_with(';') && !line.starts_with("; "));
    written.extend(comments.map(|line| line.find(':').map_or(line, |colon| &line[..=colon]).to_owned()));
    for profile in ["printers/potterbot-10-xl.toml", "materials/stoneware.toml"] {
        let text = read(&root().join("crates/argil-printers").join(profile));
        written.extend(
            toml::from_str::<toml::Table>(&text).unwrap().keys().filter(|key| *key != "sources").cloned(),
        );
    }
    let missing: Vec<&String> = written.iter().filter(|name| !told.contains(name.as_str())).collect();
    assert!(written.len() > 60 && missing.is_empty(), "not told: {missing:?}");
}
