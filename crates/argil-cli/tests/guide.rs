//! Every command of the guide does what the guide says: it ends well.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// The lines of the guide's blocks of shell commands.
fn commands(guide: &str) -> Vec<&str> {
    guide
        .split("```sh\n")
        .skip(1)
        .filter_map(|rest| rest.split("```").next())
        .flat_map(str::lines)
        .filter(|line| !line.is_empty())
        .collect()
}

#[test]
fn the_guides_commands_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let guide = fs::read_to_string(root.join("docs/GUIDE.md")).unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("guide");
    drop(fs::remove_dir_all(&folder));
    fs::create_dir_all(&folder).unwrap();
    let commands = commands(&guide);
    assert!(commands.len() > 12, "the guide's commands were not found");
    for line in commands {
        // One command a line, perhaps with its output into a file: no shell is needed, and none is assumed.
        let (words, file) = line.split_once(" > ").map_or((line, None), |(words, file)| (words, Some(file)));
        let mut words = words.split_whitespace();
        assert_eq!(words.next(), Some("argil"), "{line}");
        let out = file.map_or_else(Stdio::null, |file| fs::File::create(folder.join(file)).unwrap().into());
        let mut command = Command::new(env!("CARGO_BIN_EXE_argil"));
        let status =
            command.args(words).current_dir(&folder).stdout(out).stderr(Stdio::null()).status().unwrap();
        assert!(status.success(), "{line}: {status}");
    }
    for picture in guide.split("](pictures/").skip(1).filter_map(|rest| rest.split(')').next()) {
        assert!(root.join("docs/pictures").join(picture).is_file(), "{picture}");
    }
}
