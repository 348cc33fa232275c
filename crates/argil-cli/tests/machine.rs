//! Printers, materials, dialects, files of options: the program from outside.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A model and a bead that are planned in a moment.
const QUICK: [&str; 3] = ["sample:columns", "--width", "3"];

/// A new, empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("machine").join(name);
    drop(fs::remove_dir_all(&path));
    fs::create_dir_all(&path).unwrap();
    path
}

fn argil(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_argil")).args(arguments).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs the program, which must end with this status; what it wrote to standard output and error.
fn ends(folder: &Path, status: i32, arguments: &[&str]) -> (String, String) {
    let output = argil(folder, arguments);
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(status), "{arguments:?}\n{out}{err}");
    (out, err)
}

/// Plans the quick model with more options and gives the written file.
fn planned(folder: &Path, more: &[&str]) -> String {
    let arguments = [&["plan", "-o", "out.gcode", "--quiet", "--no-audit"], &QUICK[..], more].concat();
    ends(folder, 0, &arguments);
    fs::read_to_string(folder.join("out.gcode")).unwrap()
}

#[test]
fn what_is_listed_can_be_shown_and_given_back_as_a_file() {
    let folder = folder("listed");
    for (list, known, number) in [("printers", "eazao-zero", 16), ("materials", "stoneware", 7)] {
        let (names, _) = ends(&folder, 0, &[list]);
        assert_eq!(names.lines().count(), number, "{names}");
        assert!(names.lines().any(|line| line.starts_with(known)));
        for line in names.lines() {
            let name = line.split_whitespace().next().unwrap();
            let (shown, _) = ends(&folder, 0, &[list, name]);
            let file = format!("{name}.toml");
            fs::write(folder.join(&file), &shown).unwrap();
            assert_eq!(ends(&folder, 0, &[list, &file]).0, shown);
        }
    }
}

#[test]
fn a_printer_gives_bead_place_flow_and_code() {
    let folder = folder("printer");
    let plan = ["plan", "sample:columns", "-o", "out.gcode", "--printer", "eazao-zero"];
    let (_, said) = ends(&folder, 0, &plan);
    assert!(said.contains("audit: sound") && !said.contains("warning"), "{said}");
    let file = fs::read_to_string(folder.join("out.gcode")).unwrap();
    for line in
        ["; width = 3", "; layer height = 1", "; printer = eazao-zero", "M163 S0 P0.8", "M164 S0", "M82 ; E"]
    {
        assert!(file.lines().any(|other| other == line), "no {line}");
    }
    assert!(file.lines().last().unwrap() == "M84");
    // In the middle of the bed of 150 × 150 mm.
    let mut bounds = [f64::INFINITY, f64::NEG_INFINITY];
    for x in file.lines().filter_map(|line| line.strip_prefix("G1 X")?.split(' ').next()?.parse::<f64>().ok())
    {
        bounds = [bounds[0].min(x), bounds[1].max(x)];
    }
    assert!((bounds[0] + bounds[1] - 150.0).abs() < 1.0, "{bounds:?}");
    // The same options let the audit find the model where it stands.
    let audit = ["audit", "out.gcode", "--model", "sample:columns", "--printer", "eazao-zero"];
    assert!(ends(&folder, 0, &audit).0.ends_with("sound\n"));
}

#[test]
fn what_is_unknown_or_too_large_is_said() {
    let folder = folder("unknown");
    // Stoneware bears so little that not every such plan is sound; what is said does not depend on it.
    let options = ["--printer", "tronxy-moore-1", "--material", "stoneware", "--no-audit"];
    let (_, said) =
        ends(&folder, 0, &[&["plan", "sample:columns", "-o", "out.gcode"], &options[..]].concat());
    assert!(said.contains("mm3_per_e of tronxy-moore-1 is unknown"), "{said}");
    assert!(said.contains("the bridge that stoneware bears is unknown"), "{said}");
    let options = ["--printer", "eazao-zero", "--place", "center"];
    let plan = [&["plan", "-o", "beyond.gcode"], &QUICK[..], &options].concat();
    let (_, said) = ends(&folder, 3, &plan);
    assert!(said.contains("the model reaches from (") && said.contains("beyond eazao-zero"), "{said}");
    assert!(said.contains("--place bed") && said.contains("--beyond-volume"), "{said}");
    assert!(!folder.join("beyond.gcode").exists());
    let (_, said) = ends(&folder, 0, &[&plan[..], &["--beyond-volume"]].concat());
    assert!(
        said.contains("warning: the print reaches from (") && said.contains("beyond eazao-zero"),
        "{said}"
    );
    assert!(folder.join("beyond.gcode").exists());
}

#[test]
fn dialects() {
    let folder = folder("dialects");
    let plain = planned(&folder, &[]);
    assert!(plain.contains("\nM83 ; E\n"));
    assert!(planned(&folder, &["--e", "absolute"]).contains("\nM82 ; E\n"));
    assert!(planned(&folder, &["--volumetric", "1.75"]).contains("\nM200 D1.75 "));
    assert!(planned(&folder, &["--line-numbers"]).lines().any(|line| line.starts_with("N10 ")));
    assert!(planned(&folder, &["--arcs", "0.05"]).lines().any(|line| line.starts_with("G3 ")));
    assert!(planned(&folder, &["--viewer", "cura"]).contains(";TYPE:WALL-OUTER\n"));
    let bare = planned(&folder, &["--constant-rate", "40"]);
    assert!(!bare.lines().any(|line| line.starts_with("G1 ") && line.contains('E')));
    let pictured = planned(&folder, &["--thumbnail", "32"]);
    let begins = pictured.find("; thumbnail begin ").unwrap();
    assert!(begins < pictured.find(";TYPE:").unwrap());
    let slow = planned(&folder, &["--feed", "10"]);
    assert!(slow.contains(" F600\n") && !slow.contains(" F900\n"));
}

#[test]
fn a_robot_gets_poses() {
    let folder = folder("poses");
    let (_, said) = ends(
        &folder,
        0,
        &[&["plan", "-o", "out.csv", "--poses", "too.csv", "--printer", "robot-cell"], &QUICK[..]].concat(),
    );
    assert!(said.contains("audit: sound") && !said.contains("unknown"), "{said}");
    let table = fs::read_to_string(folder.join("out.csv")).unwrap();
    assert!(table.starts_with("n,layer,role,x_mm,"));
    assert_eq!(table, fs::read_to_string(folder.join("too.csv")).unwrap());
}

#[test]
fn code_of_ones_own_has_names_in_braces() {
    let folder = folder("templates");
    fs::write(folder.join("start.g"), "G28\nG1 X{first_x} Y{first_y} Z{approach_z} F{travel_feed}").unwrap();
    fs::write(folder.join("end.g"), "G1 Z{leave_z}\nM84 ; {model}").unwrap();
    let file = planned(&folder, &["--start", "start.g", "--end", "end.g"]);
    assert!(file.contains("\nG28\nG1 X") && file.ends_with("M84 ; sample:columns\n"), "{}", &file[..400]);
    fs::write(folder.join("end.g"), "G1 Z{top}").unwrap();
    let refused = [&["plan", "-o", "out.gcode", "--end", "end.g"], &QUICK[..]].concat();
    let (_, said) = ends(&folder, 3, &refused);
    assert!(said.contains("{top}") && said.contains("{leave_z}"), "{said}");
}

#[test]
fn a_slip_in_a_name_or_a_number_is_told_before_planning() {
    let folder = folder("slips");
    let refused = |status: i32, more: &[&str], says: &[&str]| {
        let (_, said) = ends(&folder, status, &[&["plan", "-o", "out.gcode"], &QUICK[..], more].concat());
        says.iter().for_each(|word| assert!(said.contains(word), "{more:?}: no {word} in {said}"));
        assert!(!folder.join("out.gcode").exists());
    };
    refused(2, &["--printer", "eazao"], &["eazao", "argil printers", "`eazao-m500`"]);
    refused(2, &["--material", "marble"], &["marble", "argil materials"]);
    refused(3, &["--printer", "none.toml"], &["none.toml"]);
    refused(2, &["--place", "bed"], &["--place bed", "--printer"]);
    refused(3, &["--feed", "0"], &["--feed", "0"]);
    refused(3, &["--travel-feed", "nan"], &["--travel-feed"]);
    refused(3, &["--constant-rate", "0"], &["--constant-rate"]);
    refused(3, &["--volumetric", "1.75", "--flavour", "klipper"], &["Klipper", "M200"]);
    refused(2, &["--volumetric", "1.75", "--mm3-per-e", "2"], &["--volumetric", "--mm3-per-e"]);
    refused(2, &["--thumbnail", "4"], &["--thumbnail"]);
    fs::write(folder.join("odd.toml"), "name = 3").unwrap();
    refused(3, &["--printer", "odd.toml"], &["odd.toml", "name"]);
}

#[test]
fn options_from_a_file_are_those_of_the_command_line() {
    let folder = folder("config");
    let typed = planned(&folder, &["--e", "absolute", "--feed", "20"]);
    let file =
        "width = 3\nquiet = true\nno_audit = true\ne = \"absolute\"\nfeed = 20.0\noutput = \"out.gcode\"\n";
    fs::write(folder.join("print.toml"), file).unwrap();
    let (_, said) = ends(&folder, 0, &["plan", "sample:columns", "--config", "print.toml"]);
    assert!(said.is_empty(), "{said}");
    assert!(fs::read_to_string(folder.join("out.gcode")).unwrap() == typed);
    // What is typed wins, also over what it contradicts.
    fs::write(folder.join("scaled.toml"), "width = 9\nscale = 2\nno-audit = true\n").unwrap();
    let arguments =
        ["plan", "-o", "out.gcode", "sample:columns", "--height", "20", "--width=3", "--config=scaled.toml"];
    ends(&folder, 0, &arguments);
    assert!(fs::read_to_string(folder.join("out.gcode")).unwrap().contains("\n;LAYER_COUNT:20\n"));

    let refused = |text: &str, says: &[&str]| {
        fs::write(folder.join("odd.toml"), text).unwrap();
        let output = argil(&folder, &["plan", "-o", "no.gcode", "sample:columns", "--config", "odd.toml"]);
        let said = text_of(&output);
        assert!(matches!(output.status.code(), Some(2 | 3)), "{said}");
        says.iter().for_each(|word| assert!(said.contains(word), "no {word} in {said}"));
        assert!(!folder.join("no.gcode").exists());
    };
    refused("wings = 2", &["odd.toml", "wings", "--print-config"]);
    refused("width = \"wide\"", &["--width", "wide"]);
    refused("quiet = 3", &["odd.toml", "quiet", "true or false"]);
    refused("width = [1, 2]", &["odd.toml", "width", "number"]);
    refused("width = ", &["odd.toml"]);
    refused("config = \"odd.toml\"", &["odd.toml", "config"]);
}

fn text_of(output: &Output) -> String {
    text(&output.stdout) + &text(&output.stderr)
}

#[test]
fn options_are_printed_as_the_file_that_gives_them() {
    let folder = folder("printed");
    let (bare, _) = ends(&folder, 0, &["plan", "--print-config"]);
    assert!(bare.contains("\nwipe = 0\n") && bare.contains("\n# walls =\n"), "{bare}");
    let options =
        ["--width", "3", "--feed", "20", "--e", "absolute", "--quiet", "--printer", "generic-klipper"];
    let (file, _) = ends(
        &folder,
        0,
        &[&["plan", "sample:columns", "-o", "out.gcode", "--print-config"], &options[..]].concat(),
    );
    assert!(!folder.join("out.gcode").exists());
    for line in
        ["width = 3", "feed = 20", "e = \"absolute\"", "quiet = true", "printer = \"generic-klipper\""]
    {
        assert!(file.lines().any(|other| other == line), "no {line} in {file}");
    }
    fs::write(folder.join("print.toml"), &file).unwrap();
    let (again, _) = ends(&folder, 0, &["plan", "--config", "print.toml", "--print-config"]);
    assert_eq!(again, file);
    ends(&folder, 0, &["plan", "sample:columns", "--config", "print.toml"]);
    assert!(fs::read_to_string(folder.join("out.gcode")).unwrap().contains("; printer = generic-klipper\n"));
}

#[test]
fn a_report_goes_to_standard_output_when_asked() {
    let folder = folder("standard");
    let (out, err) =
        ends(&folder, 0, &[&["plan", "-o", "out.gcode", "--quiet", "--report", "-"], &QUICK[..]].concat());
    let report: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((report["audit"]["sound"].clone(), err.as_str()), (true.into(), ""));
    let (out, _) =
        ends(&folder, 0, &["audit", "out.gcode", "--model", "sample:columns", "--width", "3", "--json", "-"]);
    assert_eq!(serde_json::from_str::<serde_json::Value>(&out).unwrap()["sound"], true);
}

#[test]
fn a_page_shows_the_plan() {
    let folder = folder("page");
    ends(&folder, 0, &[&["plan", "-o", "out.gcode", "--preview", "out.html"], &QUICK[..]].concat());
    let page = fs::read_to_string(folder.join("out.html")).unwrap();
    assert!(page.starts_with("<!doctype html>") && page.contains("<title>sample:columns – argil</title>"));
    assert!(page.contains("[\"audit\",\"sound\"]"));
}

#[test]
fn shells_and_manual_readers_are_served() {
    let folder = folder("shells");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(ends(&folder, 0, &["completions", shell]).0.contains("print-config"), "{shell}");
    }
    let (page, _) = ends(&folder, 0, &["man"]);
    assert!(page.contains(".TH argil") && page.contains("first\\-layer\\-feed"), "{page}");
}

#[test]
fn test_prints_go_the_way_of_plans() {
    let folder = folder("calibrate");
    let (out, err) = ends(&folder, 0, &["calibrate", "tests", "--printer", "eazao-zero", "--width", "3"]);
    assert!(out.is_empty() && !err.contains("warning"), "{out}{err}");
    let read = |name: &str| fs::read_to_string(folder.join("tests").join(name)).unwrap();
    for name in ["fan.gcode", "windows.gcode", "ring.gcode"] {
        let text = read(name);
        let moves: Vec<&str> =
            text.lines().filter(|line| line.starts_with("G1 ") && line.contains('X')).collect();
        let wet = |line: &&str| line.contains(" E");
        let first = moves.iter().position(wet).unwrap();
        let last = moves.iter().rposition(&wet).unwrap();
        assert!(last - first > 100 && moves[first..=last].iter().all(wet), "{name}");
        // The printer's start code, and its bed: 150 mm square.
        assert!(text.contains("G28"), "{name}");
    }
    assert!(read("legend.svg").contains("mm3_per_e = { value = 2.4050, source"));

    ends(&folder, 0, &["calibrate", "cell", "--printer", "robot-cell", "--width", "3"]);
    assert!(fs::read_to_string(folder.join("cell/fan.csv")).unwrap().lines().count() > 100);
    let (_, err) = ends(&folder, 3, &["calibrate", "high", "--width", "1", "--layer-height", "9"]);
    assert!(err.contains("layer"), "{err}");
    assert!(!folder.join("high").exists());
}
