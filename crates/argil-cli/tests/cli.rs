//! The program from outside: its files, messages and exit statuses.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

const DONE: i32 = 0;
const USAGE: i32 = 2;
const BAD_INPUT: i32 = 3;
const FINDINGS: i32 = 4;

/// A model and a bead that are planned in a moment.
const QUICK: [&str; 3] = ["sample:columns", "--width", "3"];

/// A new, empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli").join(name);
    drop(fs::remove_dir_all(&path));
    fs::create_dir_all(&path).unwrap();
    path
}

/// Runs the program in a folder.
fn argil(folder: &Path, arguments: &[&str]) -> Output {
    let output =
        Command::new(env!("CARGO_BIN_EXE_argil")).args(arguments).current_dir(folder).output().unwrap();
    let complaint = stderr(&output);
    assert!(!complaint.contains("panicked") && !complaint.contains("RUST_BACKTRACE"), "{complaint}");
    output
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The names of what a folder holds, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Runs the program, which must end with this status.
fn ends(folder: &Path, status: i32, arguments: &[&str]) -> Output {
    let output = argil(folder, arguments);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}\n{}{}", stdout(&output), stderr(&output));
    output
}

/// Runs the program on input that will not do: its message must say what, and nothing may be written.
fn assert_fails(folder: &Path, status: i32, arguments: &[&str], says: &[&str]) {
    let before = names(folder);
    let output = ends(folder, status, arguments);
    let complaint = stderr(&output);
    for text in says {
        assert!(complaint.contains(text), "{arguments:?}: no `{text}` in\n{complaint}");
    }
    assert_eq!(names(folder), before, "{arguments:?} left something behind");
}

/// A binary STL file of the given triangles.
fn stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(u32::try_from(triangles.len()).unwrap().to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|value| value.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

/// The four sides of a tetrahedron of the given size.
fn tetrahedron(across: f32, high: f32) -> Vec<[[f32; 3]; 3]> {
    let (a, b, c, d) = ([0.0; 3], [across, 0.0, 0.0], [0.0, across, 0.0], [0.0, 0.0, high]);
    vec![[a, c, b], [a, b, d], [b, c, d], [c, a, d]]
}

#[test]
fn samples_are_listed_as_plan_takes_them() {
    let output = ends(&folder("samples"), DONE, &["samples"]);
    let wanted: Vec<String> = argil_models::names().map(|name| format!("sample:{name}")).collect();
    assert_eq!(stdout(&output).lines().collect::<Vec<_>>(), wanted);
}

#[test]
fn a_plan_writes_what_it_is_asked_for() {
    let folder = folder("plan");
    let output = ends(
        &folder,
        DONE,
        &[
            "plan",
            "sample:columns",
            "--width",
            "2",
            "-o",
            "out.gcode",
            "--report",
            "out.json",
            "--strand",
            "strand.json",
            "--svg",
            "layers",
            "--png",
            "out.png",
        ],
    );
    let summary = stderr(&output);
    assert!(summary.contains("0 transfers") && summary.contains("audit: sound"), "{summary}");
    assert_eq!(names(&folder), ["layers", "out.gcode", "out.json", "out.png", "strand.json"]);

    let report: Value = serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    let count = |name: &str| report[name].as_u64().unwrap_or_else(|| panic!("no {name} in {report}"));
    assert_eq!((count("schema"), count("transfers")), (1, 0));
    assert_eq!(report["program"], "argil");
    assert_eq!(report["model"], "sample:columns");
    assert_eq!(report["settings"]["width"], 2.0);
    assert_eq!(report["audit"]["sound"], true);
    assert_eq!(report["audit"]["figures"]["transfer_moves"], 0);
    let layers = count("layers") as usize;
    assert!(layers > 40 && report["per_layer"].as_array().unwrap().len() == layers);
    let parts: f64 = ["wall_mm", "support_mm", "connection_mm", "seam_mm"]
        .iter()
        .map(|name| report[name].as_f64().unwrap())
        .sum();
    assert!((parts / report["strand_mm"].as_f64().unwrap() - 1.0).abs() < 1e-9);

    let gcode = fs::read_to_string(folder.join("out.gcode")).unwrap();
    assert_eq!(gcode.lines().filter(|line| line.starts_with(";LAYER:")).count(), layers);
    let strand: Value = serde_json::from_slice(&fs::read(folder.join("strand.json")).unwrap()).unwrap();
    assert_eq!(strand["layers"].as_array().unwrap().len(), layers);
    let pictures = names(&folder.join("layers"));
    assert_eq!(pictures.len(), layers + 1);
    assert_eq!((pictures[0].as_str(), pictures[layers].as_str()), ("layer-0000.svg", "overview.svg"));
    for picture in pictures {
        assert!(
            fs::read_to_string(folder.join("layers").join(&picture)).unwrap().starts_with("<"),
            "{picture}"
        );
    }
    assert!(fs::read(folder.join("out.png")).unwrap().starts_with(b"\x89PNG\r\n"));
}

#[test]
fn the_audit_can_be_left_out() {
    let folder = folder("no-audit");
    let arguments = [&["plan", "-o", "out.gcode", "--no-audit", "--report", "out.json"], &QUICK[..]].concat();
    let output = ends(&folder, DONE, &arguments);
    assert!(!stderr(&output).contains("audit"));
    let report: Value = serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    assert!(report.get("audit").is_none());
}

#[test]
fn a_file_is_planned_like_the_sample_that_it_holds() {
    let folder = folder("file");
    fs::write(folder.join("model.stl"), argil_models::columns().to_stl()).unwrap();
    ends(&folder, DONE, &["plan", "model.stl", "--width", "3", "-o", "file.gcode"]);
    ends(&folder, DONE, &[&["plan", "-o", "sample.gcode"], &QUICK[..]].concat());
    let moves = |name: &str| {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        text.lines().filter(|line| !line.starts_with("; model")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert!(moves("file.gcode") == moves("sample.gcode"));
}

#[test]
fn a_model_is_scaled_and_centred() {
    let folder = folder("placed");
    let bead = ["--width", "3", "--height", "24", "--place", "center"];
    ends(&folder, DONE, &[&["plan", "sample:columns", "-o", "out.gcode"], &bead[..]].concat());
    ends(&folder, DONE, &[&["audit", "out.gcode", "--model", "sample:columns"], &bead[..]].concat());
    let text = fs::read_to_string(folder.join("out.gcode")).unwrap();
    assert!(text.contains(";LAYER:23\n") && !text.contains(";LAYER:24\n"));
}

#[test]
fn a_file_is_audited_by_the_bead_that_it_states() {
    let folder = folder("stated");
    let bead = ["--layer-height", "0.7", "--walls", "2"];
    ends(&folder, DONE, &[&["plan", "-o", "out.gcode"], &QUICK[..], &bead].concat());
    let audit = ["audit", "out.gcode", "--model", "sample:columns"];
    let said = |status, more: &[&str]| {
        let output = ends(&folder, status, &[&audit[..], more].concat());
        String::from_utf8_lossy(&output.stdout).into_owned() + &stderr(&output)
    };
    let stated = said(DONE, &[]);
    assert!(stated.contains("sound") && !stated.contains("limit"), "{stated}");
    let other = said(FINDINGS, &["--layer-height", "0.5"]);
    assert!(other.contains("limit"), "{other}");
}

#[test]
fn floors_and_skins_are_fill_of_the_same_strand() {
    let folder = folder("skin");
    let closed = ["--floor", "2", "--skin", "1", "--report", "out.json"];
    let output = ends(&folder, DONE, &[&["plan", "-o", "out.gcode"], &QUICK[..], &closed].concat());
    let said = stderr(&output);
    assert!(said.contains("of the model, fill") && said.contains("audit: sound"), "{said}");
    let report: Value = serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    let fill = report["fill_mm"].as_f64().unwrap();
    let audited = report["audit"]["figures"]["fill_mm"].as_f64().unwrap();
    assert!(fill > 0.0 && (fill - audited).abs() < 0.05 * fill, "{fill} mm of fill, {audited} mm audited");
    let layers = report["per_layer"].as_array().unwrap();
    let filled = layers.iter().filter(|layer| layer["fill_length"].as_f64().unwrap() > 0.0).count();
    assert!((2..layers.len()).contains(&filled), "{filled} layers");
    assert!(fs::read_to_string(folder.join("out.gcode")).unwrap().contains(";TYPE:Solid infill\n"));
    assert_fails(
        &folder,
        BAD_INPUT,
        &["plan", "sample:columns", "-o", "no.gcode", "--skin", "1001"],
        &["skin"],
    );
    assert_fails(
        &folder,
        USAGE,
        &["plan", "sample:columns", "-o", "no.gcode", "--floor", "some"],
        &["--floor"],
    );
}

#[test]
fn what_shrinks_is_planned_larger() {
    let folder = folder("shrinkage");
    let model = ["--width", "3", "--height", "20", "--shrinkage", "10,10,20"];
    let plan = ["plan", "sample:columns", "-o", "out.gcode", "--report", "out.json"];
    ends(&folder, DONE, &[&plan, &model[..]].concat());
    ends(&folder, DONE, &[&["audit", "out.gcode", "--model", "sample:columns"], &model[..]].concat());
    // 25 mm of wet clay become 20 mm.
    let text = fs::read_to_string(folder.join("out.gcode")).unwrap();
    assert!(text.contains(";LAYER:24\n") && !text.contains(";LAYER:25\n"));
    let report: Value = serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    assert_eq!(report["shrinkage"], serde_json::json!([10.0, 10.0, 20.0]));
    for wrong in ["95", "-1", "1,2", "much"] {
        assert_fails(
            &folder,
            USAGE,
            &["plan", "sample:columns", "-o", "no.gcode", "--shrinkage", wrong],
            &["--shrinkage"],
        );
    }
}

#[test]
fn the_same_bytes_every_time_and_for_any_number_of_threads() {
    let folder = folder("same");
    let run = |name: &str, threads: &str| {
        let (gcode, report, strand, png, svg) = (
            format!("{name}.gcode"),
            format!("{name}.json"),
            format!("{name}.strand.json"),
            format!("{name}.png"),
            format!("{name}-layers"),
        );
        let files = [
            "plan",
            "-o",
            &gcode,
            "--report",
            &report,
            "--strand",
            &strand,
            "--png",
            &png,
            "--svg",
            &svg,
            "--threads",
            threads,
        ];
        ends(&folder, DONE, &[&files, &QUICK[..]].concat());
        let layers = names(&folder.join(&svg)).into_iter().map(|layer| format!("{svg}/{layer}"));
        let all = [gcode, report, strand, png].into_iter().chain(layers);
        all.map(|file| fs::read(folder.join(file)).unwrap()).collect::<Vec<_>>()
    };
    let first = run("first", "1");
    assert!(first.len() > 10);
    assert!(first == run("again", "1"), "two runs differ");
    assert!(first == run("more", "2"), "two threads give another result than one");
}

#[test]
fn wrong_usage() {
    let folder = folder("usage");
    let plan = |extra: &[&str], says: &[&str]| {
        assert_fails(&folder, USAGE, &[&["plan", "-o", "out.gcode"], extra].concat(), says);
    };
    plan(&["sample:columns", "--wings", "2"], &["--wings"]);
    plan(&["sample:columns", "--scale", "2", "--height", "9"], &["--scale", "--height"]);
    plan(&["sample:columns", "--width", "wide"], &["wide", "--width"]);
    plan(&["sample:columns", "--threads", "0"], &["--threads"]);
    plan(&["sample:columns", "--place", "left"], &["left", "--place"]);
    plan(&["sample:teapot"], &["teapot", "argil samples"]);
    plan(&[], &["MODEL"]);
    assert_fails(&folder, USAGE, &["plan", "sample:columns"], &["--output"]);
    assert_fails(&folder, USAGE, &["print"], &["print"]);
    assert_fails(&folder, USAGE, &[], &["Usage"]);
    assert_fails(&folder, USAGE, &["audit", "out.gcode"], &["--model"]);
}

#[test]
fn help_and_version_are_no_failures() {
    let folder = folder("help");
    for arguments in [&["--help"][..], &["plan", "--help"], &["audit", "--help"]] {
        assert!(stdout(&ends(&folder, DONE, arguments)).contains("Exit status"), "{arguments:?}");
    }
    assert!(stdout(&ends(&folder, DONE, &["--version"])).starts_with("argil "));
}

#[test]
fn a_reader_that_leaves_early_is_no_failure() {
    let folder = folder("reader");
    for arguments in [&["man"] as &[&str], &["completions", "bash"], &["printers"], &["samples"], &["--help"]]
    {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut program = Command::new(env!("CARGO_BIN_EXE_argil"));
        let output = program.args(arguments).current_dir(&folder).stdout(writer).output().unwrap();
        assert_eq!((output.status.code(), stderr(&output)), (Some(DONE), String::new()), "{arguments:?}");
    }
}

#[test]
fn models_that_are_none() {
    let folder = folder("models");
    let nan = [[f32::NAN, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]];
    let infinite = [[0.0; 3], [f32::INFINITY, 0.0, 0.0], [0.0, 1.0, 1.0]];
    let good = stl(&tetrahedron(20.0, 20.0));
    let text = b"solid empty\nendsolid empty\n".to_vec();
    let flawed: [(&str, Vec<u8>, &str); 9] = [
        ("empty.stl", vec![], "empty"),
        ("short.stl", good[..good.len() - 30].to_vec(), "declares 4 triangles"),
        ("header.stl", good[..60].to_vec(), ""),
        ("bare.stl", stl(&[]), "no triangle"),
        ("bare-text.stl", text, "no triangle"),
        ("nan.stl", stl(&[nan]), "not finite"),
        ("infinite.stl", stl(&[infinite]), "not finite"),
        ("flat.stl", stl(&tetrahedron(20.0, 0.1)), "less than half a layer"),
        ("needle.stl", stl(&tetrahedron(0.05, 20.0)), "thinner than a bead"),
    ];
    for (name, bytes, reason) in &flawed {
        fs::write(folder.join(name), bytes).unwrap();
        assert_fails(
            &folder,
            BAD_INPUT,
            &["plan", name, "-o", "out.gcode", "--report", "out.json"],
            &[name, reason],
        );
    }
    assert_fails(&folder, BAD_INPUT, &["plan", "missing.stl", "-o", "out.gcode"], &["missing.stl"]);
    assert_fails(&folder, BAD_INPUT, &["plan", ".", "-o", "out.gcode"], &["cannot read ."]);
}

#[test]
fn options_that_cannot_be() {
    let folder = folder("options");
    let cases = [
        ("--width", "0"),
        ("--width", "-1"),
        ("--width", "nan"),
        ("--width", "inf"),
        ("--layer-height", "nan"),
        ("--layer-height", "0"),
        ("--layer-height", "-0.5"),
        ("--layer-height", "9"),
        ("--walls", "0"),
        ("--across", "0"),
        ("--across", "-0.3"),
        ("--along", "-1.6"),
    ];
    for (option, value) in cases {
        assert_fails(
            &folder,
            BAD_INPUT,
            &["plan", "sample:columns", "-o", "out.gcode", option, value],
            &[option],
        );
    }
    for (option, value) in [("--scale", "0"), ("--scale", "-1"), ("--height", "nan"), ("--height", "-5")] {
        let arguments = ["plan", "sample:columns", "-o", "out.gcode", option, value];
        assert_fails(&folder, BAD_INPUT, &arguments, &["sample:columns", "cannot scale"]);
    }
}

#[test]
fn an_old_file_survives_a_failure() {
    let folder = folder("survives");
    fs::write(folder.join("out.gcode"), "what was there").unwrap();
    assert_fails(&folder, BAD_INPUT, &["plan", "missing.stl", "-o", "out.gcode"], &["missing.stl"]);
    assert_eq!(fs::read_to_string(folder.join("out.gcode")).unwrap(), "what was there");
}

#[test]
fn a_finished_file_takes_the_place_of_an_old_one_and_nothing_else() {
    let folder = folder("replaces");
    for name in ["out.gcode", "out.gcode.part", "linked.gcode"] {
        fs::write(folder.join(name), "what was there").unwrap();
    }
    ends(&folder, DONE, &[&["plan", "-o", "out.gcode"], &QUICK[..]].concat());
    let new = fs::read_to_string(folder.join("out.gcode")).unwrap();
    assert!(new.contains(";LAYER:0\n"));
    assert_eq!(names(&folder), ["linked.gcode", "out.gcode", "out.gcode.part"]);
    assert_eq!(fs::read_to_string(folder.join("out.gcode.part")).unwrap(), "what was there");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("linked.gcode", folder.join("link.gcode")).unwrap();
        ends(&folder, DONE, &[&["plan", "-o", "link.gcode"], &QUICK[..]].concat());
        assert!(fs::symlink_metadata(folder.join("link.gcode")).unwrap().is_symlink());
        assert!(fs::read_to_string(folder.join("linked.gcode")).unwrap() == new);
        // A device stays one.
        ends(&folder, DONE, &[&["plan", "-o", "/dev/null"], &QUICK[..]].concat());
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}

#[test]
fn models_beyond_the_limits_are_refused_before_the_work_begins() {
    let folder = folder("limits");
    let plan = |extra: &[&str], status: i32, says: &[&str]| {
        assert_fails(&folder, status, &[&["plan", "-o", "out.gcode"], extra].concat(), says);
    };
    plan(&["sample:columns", "--memory", "0.001"], BAD_INPUT, &["sample:columns", "GiB", "--memory"]);
    plan(&["sample:columns", "--memory", "0.1", "--layer-height", "0.001"], BAD_INPUT, &["--memory"]);
    // A file with a hole in it takes no room on the disk.
    fs::File::create(folder.join("huge.stl")).unwrap().set_len(5 << 30).unwrap();
    plan(&["huge.stl"], BAD_INPUT, &["huge.stl", "more than 4294967296", "reduce"]);
    let far = tetrahedron(20.0, 20.0).iter().map(|t| t.map(|[x, y, z]| [x + 2e6, y, z])).collect::<Vec<_>>();
    fs::write(folder.join("far.stl"), stl(&far)).unwrap();
    plan(&["far.stl"], BAD_INPUT, &["far.stl", "beyond 1e6 mm"]);
    fs::write(folder.join("small.stl"), stl(&tetrahedron(0.1, 0.1))).unwrap();
    plan(&["small.stl"], BAD_INPUT, &["small.stl", "less than half a layer", "--unit m"]);
    plan(&["small.stl", "--width", "0.01"], BAD_INPUT, &["--grid", "thousandth of the width"]);
}

#[test]
fn places_that_cannot_be_written() {
    let folder = folder("unwritable");
    assert_fails(
        &folder,
        BAD_INPUT,
        &[&["plan", "-o", "none/out.gcode"], &QUICK[..]].concat(),
        &["none/out.gcode"],
    );
    fs::create_dir(folder.join("taken")).unwrap();
    assert_fails(
        &folder,
        BAD_INPUT,
        &[&["plan", "-o", "taken"], &QUICK[..]].concat(),
        &["cannot write taken"],
    );
}

#[test]
fn an_audit_measures_what_a_plan_wrote() {
    let folder = folder("audit");
    ends(&folder, DONE, &[&["plan", "-o", "out.gcode"], &QUICK[..]].concat());
    let audit = |file: &str, status: i32| {
        ends(
            &folder,
            status,
            &["audit", file, "--model", "sample:columns", "--width", "3", "--json", "out.json"],
        )
    };
    assert!(stdout(&audit("out.gcode", DONE)).ends_with("sound\n"));
    let report: Value = serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    assert_eq!(report["sound"], true);

    // One move in the middle loses its material: a hop.
    let text = fs::read_to_string(folder.join("out.gcode")).unwrap();
    let extrudes = |line: &str| line.starts_with("G1 X") && line.contains(" E");
    let moves: Vec<usize> =
        text.lines().enumerate().filter(|(_, line)| extrudes(line)).map(|(number, _)| number).collect();
    let damaged: Vec<String> = text
        .lines()
        .enumerate()
        .map(|(number, line)| match line.find(" E") {
            Some(at) if number == moves[moves.len() / 2] => line[..at].to_owned(),
            _ => line.to_owned(),
        })
        .collect();
    fs::write(folder.join("damaged.gcode"), damaged.join("\n")).unwrap();
    let verdict = stdout(&audit("damaged.gcode", FINDINGS));
    let short = verdict.lines().last().unwrap();
    assert!(short.starts_with("short of:") && short.contains("transfer_moves = 1"), "{verdict}");
    let report: Value = serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    assert_eq!((&report["sound"], &report["figures"]["transfer_moves"]), (&false.into(), &1.into()));
}

#[test]
fn an_audit_of_what_is_no_print() {
    let folder = folder("no-print");
    fs::write(folder.join("empty.gcode"), "").unwrap();
    fs::write(folder.join("noise.gcode"), [0, 159, 146, 150, 10, 71, 49, 32, 88]).unwrap();
    for file in ["empty.gcode", "noise.gcode", "missing.gcode"] {
        assert_fails(&folder, BAD_INPUT, &["audit", file, "--model", "sample:columns"], &[file]);
    }
    assert_fails(&folder, BAD_INPUT, &["audit", "empty.gcode", "--model", "missing.stl"], &["missing.stl"]);
    assert_fails(&folder, USAGE, &["audit", "empty.gcode", "--model", "sample:teapot"], &["teapot"]);
}
