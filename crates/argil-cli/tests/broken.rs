//! Models with defects: each is planned to a sound strand with a word about the repair, or refused with a word about the defect.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use argil::mesh::Soup;
use serde_json::Value;

const DONE: i32 = 0;
const BAD_INPUT: i32 = 3;

type Triangle = [[f32; 3]; 3];

/// A new, empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("broken").join(name);
    drop(fs::remove_dir_all(&path));
    fs::create_dir_all(&path).unwrap();
    path
}

/// The twelve triangles of a box; 0 to 3 lie flat, 4 to 11 stand.
fn cuboid(low: [f32; 3], high: [f32; 3]) -> Vec<Triangle> {
    let soup = Soup::cuboid(low.map(f64::from), high.map(f64::from));
    let corner = |k: u32| soup.vertices[k as usize].map(|value| value as f32);
    soup.triangles.iter().map(|side| side.map(corner)).collect()
}

fn flipped(triangles: &[Triangle]) -> Vec<Triangle> {
    triangles.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

fn stl(triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(u32::try_from(triangles.len()).unwrap().to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|value| value.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

/// Plans the triangles: exit status, what was said, and the report if there is one.
fn planned(name: &str, triangles: &[Triangle], extra: &[&str]) -> (Option<i32>, String, Option<Value>) {
    let folder = folder(name);
    fs::write(folder.join("model.stl"), stl(triangles)).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_argil"))
        .args(["plan", "model.stl", "-o", "out.gcode", "--report", "out.json", "--width", "3"])
        .args(extra)
        .current_dir(&folder)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!said.contains("panicked"), "{said}");
    let report = fs::read(folder.join("out.json")).ok().map(|bytes| serde_json::from_slice(&bytes).unwrap());
    assert_eq!(folder.join("out.gcode").exists(), report.is_some(), "{said}");
    (output.status.code(), said, report)
}

/// The triangles are planned soundly to as much wall as `like`, and the repair is told in words and in the report; with
/// `--strict` they are refused.
fn is_repaired(name: &str, triangles: &[Triangle], like: &[Triangle], says: &str) {
    let (status, said, report) = planned(name, triangles, &[]);
    assert_eq!(status, Some(DONE), "{name}: {said}");
    assert!(said.contains(says), "{name}: no `{says}` in\n{said}");
    let report = report.unwrap();
    assert_eq!(report["audit"]["sound"], true, "{name}");
    let told = report["repairs"]["defects"].as_array().unwrap();
    assert!(!told.is_empty() && told.iter().all(|defect| defect["first_at"][0].is_array()), "{report}");
    let wall = |report: &Value| report["wall_mm"].as_f64().unwrap();
    let sound = planned(&format!("{name}-sound"), like, &["--strict"]);
    assert_eq!(sound.0, Some(DONE), "{name}: {}", sound.1);
    let wanted = wall(&sound.2.unwrap());
    assert!((wall(&report) - wanted).abs() < 1e-6 * wanted, "{name}: {} of {wanted} mm", wall(&report));
    let (status, said, _) = planned(&format!("{name}-strict"), triangles, &["--strict"]);
    assert_eq!(status, Some(BAD_INPUT), "{name}: {said}");
    assert!(said.contains("model.stl") && said.contains("the first at ("), "{name}: {said}");
}

fn block() -> Vec<Triangle> {
    cuboid([0.0; 3], [20.0, 20.0, 4.0])
}

#[test]
fn a_triangle_that_is_missing() {
    let mut torn = block();
    torn.remove(4);
    is_repaired("missing", &torn, &block(), "3 open edges, the first at (");
    let (_, said, report) = planned("missing-again", &torn, &[]);
    assert!(said.contains("gap in an outline closed, the first in layer 0 at ("), "{said}");
    let losses = report.unwrap()["losses"].as_array().unwrap().clone();
    assert_eq!(losses.len(), 4);
    assert!(losses.iter().all(|loss| loss["at"][1] == 0.0), "{losses:?}");
}

#[test]
fn a_base_that_is_open() {
    is_repaired("open-base", &block()[2..], &block(), "4 open edges");
}

#[test]
fn triangles_wound_against_their_neighbours() {
    let mut mixed = block();
    for k in [1, 6, 9] {
        mixed[k].swap(0, 1);
    }
    is_repaired("turned", &mixed, &block(), "3 triangles turned over");
}

#[test]
fn a_body_that_is_inside_out() {
    is_repaired("inside-out", &flipped(&block()), &block(), "1 shells turned over");
    let other = cuboid([10.0, 10.0, 0.0], [30.0, 30.0, 4.0]);
    let sound = [block(), other.clone()].concat();
    is_repaired(
        "inside-out-overlapping",
        &[block(), flipped(&other)].concat(),
        &sound,
        "1 shells turned over",
    );
}

#[test]
fn triangles_that_are_there_twice() {
    is_repaired("twice", &[block(), block()].concat(), &block(), "12 duplicate triangles dropped");
    is_repaired(
        "both-sides",
        &[block(), flipped(&block())].concat(),
        &block(),
        "12 duplicate triangles dropped",
    );
}

#[test]
fn bodies_that_share_a_face_or_an_edge() {
    let beside = cuboid([20.0, 0.0, 0.0], [40.0, 20.0, 4.0]);
    let wide = cuboid([0.0; 3], [40.0, 20.0, 4.0]);
    is_repaired("face", &[block(), beside].concat(), &wide, "2 faces between bodies dropped");
    let diagonal = cuboid([20.0, 20.0, 0.0], [40.0, 40.0, 4.0]);
    let (status, said, _) = planned("edge", &[block(), diagonal].concat(), &[]);
    assert_eq!(status, Some(DONE), "{said}");
    assert!(
        said.contains("1 edges with more than two triangles, the first at (20.00, 20.00, 2.00)"),
        "{said}"
    );
}

#[test]
fn bodies_that_overlap_are_one_without_a_repair() {
    let other = cuboid([10.0, 10.0, 0.0], [30.0, 30.0, 4.0]);
    let (status, said, report) = planned("overlapping", &[block(), other].concat(), &["--strict"]);
    assert_eq!(status, Some(DONE), "{said}");
    let report = report.unwrap();
    assert_eq!((&report["repairs"]["shells"], report["audit"]["sound"].as_bool()), (&2.into(), Some(true)));
}

#[test]
fn what_cannot_be_closed_is_refused_with_its_place() {
    // A fin of one sheet stands out of the block.
    let fin = [
        [[15.0, 10.0, 0.0], [32.0, 10.0, 0.0], [32.0, 10.0, 4.0]],
        [[15.0, 10.0, 0.0], [32.0, 10.0, 4.0], [15.0, 10.0, 4.0]],
    ];
    let (status, said, _) = planned("fin", &[&block()[..], &fin].concat(), &[]);
    assert_eq!(status, Some(BAD_INPUT), "{said}");
    for part in [
        "model.stl",
        "layer 0, near (",
        "17.00 mm of outline cannot be closed",
        "3 more such places",
        "nothing was written",
    ] {
        assert!(said.contains(part), "no `{part}` in\n{said}");
    }
    // A sheet alone.
    let (status, said, _) = planned("sheet", &fin, &[]);
    assert_eq!(status, Some(BAD_INPUT), "{said}");
    assert!(said.contains("cannot be closed"), "{said}");
}

#[test]
fn a_wrong_count_is_told() {
    let folder = folder("count");
    let mut bytes = stl(&block());
    bytes[80..84].copy_from_slice(&7_u32.to_le_bytes());
    fs::write(folder.join("model.stl"), bytes).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_argil"))
        .args(["plan", "model.stl", "-o", "out.gcode", "--width", "3", "--quiet"])
        .current_dir(&folder)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(DONE));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        said.contains("model.stl: the header declares 7 triangles; all 12 that follow were read"),
        "{said}"
    );
}
