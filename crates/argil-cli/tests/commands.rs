//! Every command of this program on the pages of the project does what the page says: it ends well.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// How the program is called on the pages.
const CALLS: [&str; 3] = ["argil ", "target/release/argil ", "cargo run --release -p argil-cli -- "];

/// What else stands in blocks of commands: it builds, tests or measures the program, which the gate does.
const ELSEWHERE: [&str; 6] = [
    "cargo install --path crates/argil-cli",
    "cargo test",
    "cargo clippy",
    "cargo bench -p argil-benches",
    "cargo run --release -p argil-benches ",
    "mdbook ",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The pages of a folder, by name.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect();
    found.sort();
    found
}

/// The arguments of every call of the program in a page's blocks of code, one call a line, without a comment after it.
fn commands(page: &Path) -> Vec<String> {
    let text = fs::read_to_string(page).unwrap();
    let mut found = Vec::new();
    for block in text.split("\n```").skip(1).step_by(2) {
        let (language, lines) = block.split_once('\n').unwrap();
        if !["", "sh", "text"].contains(&language) {
            continue;
        }
        for line in lines.lines().map(|line| line.split(" #").next().unwrap_or(line).trim_end()) {
            let known = ELSEWHERE.iter().any(|other| line.starts_with(other));
            match CALLS.iter().find_map(|call| line.strip_prefix(call)) {
                Some(arguments) => found.push(arguments.to_owned()),
                None => assert!(
                    known || line.is_empty() || language != "sh" && !line.starts_with("cargo "),
                    "{}: nobody runs `{line}`",
                    page.display()
                ),
            }
        }
    }
    found
}

/// A vase of 20 mm across and 24 mm high that leans out a little, as binary STL: the file that a reader has.
fn vase() -> Vec<u8> {
    const SIDES: u32 = 24;
    let at = |k: u32, radius: f32, z: f32| {
        let angle = std::f32::consts::TAU * (k % SIDES) as f32 / SIDES as f32;
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    let mut triangles = Vec::new();
    for k in 0..SIDES {
        let [a, b] = [k, k + 1].map(|k| at(k, 9.0, 0.0));
        let [c, d] = [k, k + 1].map(|k| at(k, 10.0, 24.0));
        triangles.extend([[a, b, d], [a, d, c], [[0.0, 0.0, 0.0], b, a], [[0.0, 0.0, 24.0], c, d]]);
    }
    let mut bytes = vec![0; 80];
    bytes.extend(u32::try_from(triangles.len()).unwrap().to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|value: &f32| value.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

/// One call, perhaps with its output into a file: no shell is needed, and none is assumed.
fn run(folder: &Path, line: &str) {
    let (words, file) = line.split_once(" > ").map_or((line, None), |(words, file)| (words, Some(file)));
    let out = file.map_or_else(Stdio::null, |file| fs::File::create(folder.join(file)).unwrap().into());
    let mut command = Command::new(env!("CARGO_BIN_EXE_argil"));
    let command = command.args(words.split_whitespace()).current_dir(folder).stdout(out);
    let output = command.stderr(Stdio::piped()).output().unwrap();
    assert!(
        output.status.success(),
        "{line}: {}\n{}",
        output.status,
        String::from_utf8_lossy(&output.stderr)
    );
}

/// Runs the commands of a page one after the other in a folder that has only what a reader brings.
fn follow(page: &Path) -> usize {
    let commands = commands(page);
    let name: PathBuf = page.strip_prefix(root()).unwrap().components().collect();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("commands").join(name);
    drop(fs::remove_dir_all(&folder));
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("vase.stl"), vase()).unwrap();
    if commands.iter().any(|line| line.contains("other-slicer.gcode")) {
        run(&folder, "plan vase.stl -o other-slicer.gcode");
    }
    commands.iter().for_each(|line| run(&folder, line));
    commands.len()
}

#[test]
fn those_of_the_first_page() {
    assert!(follow(&root().join("README.md")) > 4);
}

#[test]
fn those_of_the_book() {
    let pages = pages(&root().join("docs"));
    assert!(pages.iter().map(|page| follow(page)).sum::<usize>() > 16);
}

#[test]
fn those_of_the_crates() {
    let mut folders: Vec<PathBuf> =
        fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    assert!(folders.iter().flat_map(|folder| pages(folder)).map(|page| follow(&page)).sum::<usize>() > 6);
}

#[test]
fn other_pages_have_none_that_nobody_runs() {
    let others = pages(&root());
    let followed = others.iter().filter(|page| !page.ends_with("README.md")).map(|page| follow(page));
    assert_eq!(followed.count(), others.len() - 1);
}
