//! What a registry asks of a package, held for every crate from the manifests alone.
#![allow(clippy::unwrap_used, reason = "a workspace that cannot be read fails the test")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use toml::{Table, Value};

/// The registry's names of subjects that a crate of this workspace may have.
const CATEGORIES: [&str; 12] = [
    "algorithms",
    "command-line-utilities",
    "config",
    "data-structures",
    "development-tools::testing",
    "encoding",
    "graphics",
    "mathematics",
    "parser-implementations",
    "rendering",
    "science",
    "visualization",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn manifest(folder: &Path) -> Table {
    toml::from_str(&read(&folder.join("Cargo.toml"))).unwrap()
}

/// The packages that are to be published: folder and manifest by name.
fn packages() -> BTreeMap<String, (PathBuf, Table)> {
    let folders = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let packages: BTreeMap<_, _> = folders
        .filter(|folder| folder.join("Cargo.toml").is_file())
        .map(|folder| (folder.clone(), manifest(&folder)))
        .filter(|(_, manifest)| manifest["package"].get("publish").is_none())
        .map(|(folder, manifest)| {
            (manifest["package"]["name"].as_str().unwrap().to_owned(), (folder, manifest))
        })
        .collect();
    assert!(packages.len() > 10, "the workspace was not found");
    packages
}

/// The words of a list in a package's manifest, or of that which it has from the workspace.
fn words<'a>(package: &'a Value, field: &str, workspace: &'a Table) -> Vec<&'a str> {
    let shared = &workspace["workspace"]["package"];
    let owner = if package[field].get("workspace").is_some() { shared } else { package };
    owner[field].as_array().unwrap().iter().map(|word| word.as_str().unwrap()).collect()
}

/// The dependencies in the tables of these names.
fn dependencies<'a>(manifest: &'a Table, kinds: &[&str]) -> Vec<(&'a String, &'a Value)> {
    let tables = kinds.iter().filter_map(|kind| manifest.get(*kind));
    tables.flat_map(|table| table.as_table().unwrap()).collect()
}

const KINDS: [&str; 3] = ["dependencies", "dev-dependencies", "build-dependencies"];

#[test]
fn every_package_says_what_a_registry_asks() {
    let workspace = manifest(&root());
    for (name, (_, manifest)) in packages() {
        let package = &manifest["package"];
        for field in ["version", "edition", "rust-version", "license", "repository"] {
            let inherited = package.get(field).and_then(|value| value.get("workspace"));
            assert_eq!(inherited, Some(&Value::Boolean(true)), "{name}: {field}");
        }
        let description = package["description"].as_str().unwrap();
        assert!(
            (20..=160).contains(&description.len()) && description.ends_with('.'),
            "{name}: {description}"
        );

        let categories = words(package, "categories", &workspace);
        assert!((1..=5).contains(&categories.len()), "{name}: {categories:?}");
        assert!(categories.iter().all(|category| CATEGORIES.contains(category)), "{name}: {categories:?}");
        let keywords = words(package, "keywords", &workspace);
        assert!((3..=5).contains(&keywords.len()), "{name}: {keywords:?}");
        assert_eq!(keywords.iter().collect::<BTreeSet<_>>().len(), keywords.len(), "{name}: {keywords:?}");
        for word in keywords {
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            assert!(word.len() <= 20 && word.chars().all(plain) && !word.starts_with('-'), "{name}: {word}");
        }
        let documented = &package["metadata"]["docs"]["rs"]["all-features"];
        assert_eq!(documented, &Value::Boolean(true), "{name}: documentation with all features");
    }
}

#[test]
fn every_package_carries_its_page_and_the_licence() {
    let licence = read(&root().join("LICENSE"));
    assert!(licence.starts_with("MIT License"));
    for (name, (folder, _)) in packages() {
        assert_eq!(
            read(&folder.join("LICENSE")),
            licence,
            "{name}: the licence is not that of the workspace"
        );
        assert!(read(&folder.join("README.md")).starts_with("# "), "{name}: its page has no title");
    }
}

#[test]
fn every_dependency_can_be_found_outside_of_the_workspace() {
    let workspace = &manifest(&root())["workspace"];
    let shared = workspace["dependencies"].as_table().unwrap();
    let version = &workspace["package"]["version"];
    for (name, dependency) in shared {
        let Some(path) = dependency.get("path").map(|path| path.as_str().unwrap()) else {
            let named = dependency.as_str().or_else(|| dependency.get("version")?.as_str());
            assert!(named.is_some_and(|version| !version.contains('*')), "{name} has no version");
            continue;
        };
        // A registry forgets paths; without a version the package would be refused.
        assert_eq!(dependency.get("version"), Some(version), "{name}");
        assert_eq!(manifest(&root().join(path))["package"]["name"].as_str(), Some(name.as_str()), "{path}");
    }
    for (name, (_, manifest)) in packages() {
        for (dependency, origin) in dependencies(&manifest, &KINDS) {
            assert_eq!(origin.get("workspace"), Some(&Value::Boolean(true)), "{name}: {dependency}");
            assert!(shared.contains_key(dependency), "{name}: {dependency}");
        }
    }
}

/// A package can be published when all it names are: there must be an order, also with the dependencies of tests.
#[test]
fn packages_can_be_published_one_after_the_other() {
    let packages = packages();
    let mut open: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (name, (_, manifest)) in &packages {
        let all = dependencies(manifest, &KINDS).into_iter().map(|(dependency, _)| dependency.as_str());
        let siblings: Vec<&str> =
            all.filter(|dependency| *dependency == "argil" || dependency.starts_with("argil-")).collect();
        for sibling in &siblings {
            assert!(packages.contains_key(*sibling), "{name} needs {sibling}, which is not published");
        }
        open.insert(name, siblings);
    }
    while !open.is_empty() {
        let ready: Vec<&str> = open
            .iter()
            .filter(|(_, needs)| needs.iter().all(|need| !open.contains_key(need)))
            .map(|(name, _)| *name)
            .collect();
        assert!(!ready.is_empty(), "these wait for each other: {:?}", open.keys());
        open.retain(|name, _| !ready.contains(name));
    }
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let own = files.into_iter().filter(|path| path.extension().is_some_and(|end| end == "rs"));
    own.chain(folders.iter().flat_map(|folder| sources(folder))).collect()
}

/// What a package includes lies within it, but for pages whose examples are run in the workspace.
#[test]
fn no_package_builds_from_what_it_does_not_carry() {
    for (name, (folder, _)) in packages() {
        let folder = folder.canonicalize().unwrap();
        for source in sources(&folder.join("src")) {
            let text = read(&source);
            let built = text.split("#[cfg(doctest)]").next().unwrap();
            let included = ["include_str!(\"", "include_bytes!(\""]
                .into_iter()
                .flat_map(|word| built.split(word).skip(1));
            for path in included.map(|rest| rest.split('"').next().unwrap()) {
                let file = source.parent().unwrap().join(path).canonicalize().unwrap();
                assert!(file.starts_with(&folder), "{name}: {} includes {path}", source.display());
            }
        }
    }
}
