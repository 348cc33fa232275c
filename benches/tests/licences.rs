//! What argil may be built from, from where, and with which toolchain.
//!
//! The questions are put to `cargo metadata`, which knows every package of the lock files with what its author declared.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Licences that ask for nothing but their notice, and dedications to the public domain.
const ALLOWED: [&str; 14] = [
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "NCSA",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// What cargo answers: without a network where it has all packages, which is wherever argil has been built.
fn cargo(arguments: &[&str]) -> Vec<u8> {
    let run = |offline: &[&str]| {
        Command::new(env!("CARGO")).args(arguments).args(offline).output().expect("cargo runs")
    };
    let mut output = run(&["--offline"]);
    if !output.status.success() {
        output = run(&[]);
    }
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

fn read(page: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(page);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{page}: {error}"))
}

/// Every package that the lock file of a workspace names; `fuzz` has its own.
fn packages(manifest: &str) -> Vec<Value> {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(manifest);
    let path = manifest.to_str().expect("the path of the workspace is text");
    let arguments = ["metadata", "--format-version", "1", "--locked", "--manifest-path", path];
    let metadata: Value = serde_json::from_slice(&cargo(&arguments)).expect("cargo writes JSON");
    let packages = metadata["packages"].as_array().expect("metadata has packages").clone();
    assert!(packages.len() > 15, "argil alone has more than {} packages", packages.len());
    packages
}

/// Whether an SPDX expression can be met with allowed licences alone.
///
/// AND binds closer than OR, and WITH closer than both; `/` is OR as old manifests wrote it.
fn is_allowed(expression: &str) -> bool {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut rest = words.as_slice();
    let met = any_of(&mut rest);
    met && rest.is_empty()
}

fn any_of(words: &mut &[&str]) -> bool {
    let mut met = all_of(words);
    while let ["OR", rest @ ..] = *words {
        *words = rest;
        met |= all_of(words);
    }
    met
}

fn all_of(words: &mut &[&str]) -> bool {
    let mut met = one(words);
    while let ["AND", rest @ ..] = *words {
        *words = rest;
        met &= one(words);
    }
    met
}

fn one(words: &mut &[&str]) -> bool {
    match *words {
        ["(", rest @ ..] => {
            *words = rest;
            let met = any_of(words);
            let closed = words.first() == Some(&")");
            *words = words.get(1..).unwrap_or_default();
            met && closed
        }
        [licence, "WITH", exception, rest @ ..] => {
            *words = rest;
            ALLOWED.contains(&format!("{licence} WITH {exception}").as_str())
        }
        [licence, rest @ ..] => {
            *words = rest;
            ALLOWED.contains(licence)
        }
        [] => false,
    }
}

/// A version as numbers, so that 1.100 comes after 1.89, and 1.89 is 1.89.0.
fn version(text: &str) -> [u64; 3] {
    let mut parts = text.split('.').map(|part| part.parse().expect("a Rust version is made of numbers"));
    [(); 3].map(|()| parts.next().unwrap_or(0))
}

#[test]
fn every_dependency_has_an_allowed_licence() {
    for manifest in ["Cargo.toml", "fuzz/Cargo.toml"] {
        for package in packages(manifest) {
            let licence = package["license"].as_str().unwrap_or("none");
            assert!(
                is_allowed(licence),
                "{} {} has the licence {licence}",
                package["name"],
                package["version"]
            );
        }
    }
}

#[test]
fn the_policy_of_cargo_deny_is_the_same() {
    let policy = read("deny.toml");
    let list = policy
        .split("[licenses]")
        .nth(1)
        .and_then(|rest| rest.split(']').next())
        .expect("a list of licences");
    let told: Vec<&str> = list.split('"').skip(1).step_by(2).collect();
    assert_eq!(told, ALLOWED);
}

#[test]
fn every_dependency_is_from_the_registry_of_rust() {
    for manifest in ["Cargo.toml", "fuzz/Cargo.toml"] {
        for package in packages(manifest) {
            let source = package["source"].as_str().unwrap_or("here");
            let is_known =
                ["here", "registry+https://github.com/rust-lang/crates.io-index"].contains(&source);
            assert!(is_known, "{} is from {source}", package["name"]);
        }
    }
}

#[test]
fn crates_that_are_there_in_two_versions_are_told() {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.toml");
    let path = manifest.to_str().expect("the path of the workspace is text");
    let arguments =
        ["tree", "--locked", "--workspace", "--all-features", "-d", "--depth", "0", "--prefix", "none"];
    let tree = cargo(&[&arguments[..], &["-e", "normal,build", "--manifest-path", path]].concat());
    let tree = String::from_utf8(tree).expect("cargo writes text");
    let mut found: Vec<&str> =
        tree.lines().filter_map(|line| line.split(' ').next()).filter(|name| !name.is_empty()).collect();
    found.sort_unstable();
    found.dedup();
    let page = read("docs/ARCHITECTURE.md");
    let section = page.split("## Twice in the tree").nth(1).expect("a section about them");
    let section = section.split("\n## ").next().unwrap_or_default();
    let mut told: Vec<&str> = section
        .lines()
        .filter(|line| line.starts_with("| `"))
        .flat_map(|line| line.split('|').nth(1).unwrap_or_default().split('`').skip(1).step_by(2))
        .collect();
    told.sort_unstable();
    assert_eq!(found, told);
}

#[test]
fn no_dependency_wants_a_newer_rust_than_argil_says() {
    let packages = packages("Cargo.toml");
    let told = |package: &Value| package["rust_version"].as_str().map(version);
    let own = packages.iter().find(|package| package["name"] == "argil").and_then(told);
    let own = own.expect("argil says which Rust it needs");
    for package in &packages {
        let wanted = told(package).unwrap_or_default();
        assert!(wanted <= own, "{} wants Rust {wanted:?}, argil says {own:?}", package["name"]);
    }
}

#[test]
fn expressions_are_read_as_spdx_has_them() {
    for met in [
        "MIT",
        "MIT/GPL-3.0",
        "GPL-3.0 OR MIT",
        "(MIT OR GPL-3.0) AND NCSA",
        "Apache-2.0 WITH LLVM-exception",
    ] {
        assert!(is_allowed(met), "{met}");
    }
    for unmet in
        ["", "none", "GPL-3.0", "MIT AND GPL-3.0", "(MIT", "MIT)", "MIT ISC", "GPL-3.0 OR MIT AND LGPL-3.0"]
    {
        assert!(!is_allowed(unmet), "{unmet}");
    }
}
