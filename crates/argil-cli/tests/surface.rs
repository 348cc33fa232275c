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

#[test]
fn what_a_program_keeps_can_go_to_another_thread() {
    let known: BTreeSet<&str> = threads::types()
        .into_iter()
        .map(|path| path.split('<').next().unwrap_or(path).rsplit("::").next().unwrap_or(path))
        .collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for file in
        ["argil", "argil-audit", "argil-curve", "argil-gcode", "argil-route", "argil-strand", "argil-tour"]
    {
        let surface = fs::read_to_string(root.join("docs/api").join(format!("{file}.txt"))).unwrap();
        for line in surface.lines().filter(|line| !line.starts_with(' ')) {
            let declared = line.split_once("pub struct ").or_else(|| line.split_once("pub enum "));
            let Some((_, rest)) = declared else { continue };
            let name = rest.split(|c: char| !c.is_alphanumeric()).next().unwrap();
            assert!(known.contains(name), "{file}: {name} is not among the types that threads share");
        }
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
