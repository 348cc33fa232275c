//! Spirals, skirts and wiping from outside.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("spiral").join(name);
    drop(fs::remove_dir_all(&path));
    fs::create_dir_all(&path).unwrap();
    path
}

fn argil(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_argil"));
    command.args(arguments.split(' ')).current_dir(folder).output().unwrap()
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn options_of_a_file_make_a_spiral_with_a_skirt() {
    let folder = folder("file");
    fs::write(folder.join("o.toml"), "width = 3\nspiral = true\nskirt = 1\nskirt-distance = 2\nwipe = 4\n")
        .unwrap();
    let plan =
        "plan sample:columns -o o.gcode --config o.toml --report r.json --strand s.json --preview p.html";
    let output = argil(&folder, plan);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    assert!(told.contains("layers rise") && told.contains("skirt: 1 turns"), "{told}");
    let (report, strand) = (json(&folder.join("r.json")), json(&folder.join("s.json")));
    assert_eq!((&report["settings"]["spiral"], &report["skirt"]["turns"]), (&true.into(), &1.into()));
    assert!(report["skirt_mm"].as_f64().unwrap() > 50.0);
    let rising =
        report["per_layer"].as_array().unwrap().iter().filter(|layer| layer["climb"] == "rising").count();
    assert!(rising > 10 && told.contains(&format!("{rising} of ")), "{told}");
    assert!(report["audit"]["figures"]["steepest_rise_mm"].as_f64().unwrap() <= 1.0);
    assert_eq!(strand["rises"].as_array().unwrap().len(), strand["layers"].as_array().unwrap().len());
    assert!(fs::read_to_string(folder.join("p.html")).unwrap().contains("\"rises\":"));
    // The last move before the nozzle leaves pushes nothing out.
    let gcode = fs::read_to_string(folder.join("o.gcode")).unwrap();
    assert!(gcode.contains(";TYPE:Skirt/Brim"));
    let mut last = gcode.lines().rev().filter(|line| line.starts_with("G1 "));
    assert!(last.next().is_some_and(|line| line.starts_with("G1 Z")));
    assert!(last.next().is_some_and(|line| line.starts_with("G1 X") && !line.contains('E')));
}

#[test]
fn a_bed_that_is_too_small_is_told() {
    let folder = folder("bed");
    let bundled =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../argil-printers/printers/generic-marlin.toml");
    let text = fs::read_to_string(bundled).unwrap();
    let small: String = text
        .lines()
        .map(|line| match line.split(' ').next() {
            Some("volume") => "volume = { value = { x = 60, y = 60, z = 200 }, source = \"own\" }",
            Some("origin") => "origin = { value = \"centre\", source = \"own\" }",
            Some("[sources]") => "[sources]\nown = \"a test\"",
            _ => line,
        })
        .fold(String::new(), |text, line| text + line + "\n");
    fs::write(folder.join("small.toml"), small).unwrap();
    let output =
        argil(&folder, "plan sample:columns -o o.gcode --width 3 --printer small.toml --skirt=9 --no-audit");
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    assert!(told.contains("the bed has room for 3 turns of skirt, 4.5 mm from the part"), "{told}");
    assert!(!told.contains("beyond"), "{told}");
}

#[test]
fn what_makes_no_skirt_is_refused() {
    let folder = folder("refused");
    for option in ["--skirt=0", "--skirt=101", "--skirt --skirt-distance 1", "--skirt --skirt-distance -3"] {
        let output = argil(&folder, &format!("plan sample:columns -o o.gcode --width 3 {option}"));
        assert!(!output.status.success() && !folder.join("o.gcode").exists(), "{option}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("skirt"), "{option}");
    }
    let wiped = argil(&folder, "plan sample:columns -o o.gcode --width 3 --wipe -1");
    assert!(!wiped.status.success() && String::from_utf8_lossy(&wiped.stderr).contains("wipe"));
}
