//! Models with defects: each is planned to a sound strand with a word about the repair, or refused with a word about the defect.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use argil::mesh::Soup;
use serde_json::Value;

const DONE: i32 = 0;
const BAD_INPUT: i32 = 3;
const FINDINGS: i32 = 4;

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
fn assert_repaired(name: &str, triangles: &[Triangle], like: &[Triangle], says: &str) {
    let (status, said, report) = planned(name, triangles, &[]);
    assert_eq!(status, Some(DONE), "{name}: {said}");
    assert!(said.contains(says), "{name}: no `{says}` in\n{said}");
    let report = report.unwrap();
    assert_eq!(report["audit"]["sound"], true, "{name}");
    let told = report["repairs"]["defects"].as_array().unwrap();
    assert!(!told.is_empty() && told.iter().all(|defect| defect["first_at"][0].is_array()), "{report}");
    let wall = |report: &Value| report["wall_mm"].as_f64().unwrap();
    let sound = planned(&format!("{name}-sound"), like, &[]);
    assert_eq!(sound.0, Some(DONE), "{name}: {}", sound.1);
    let sound = sound.2.unwrap();
    assert!(sound["repairs"]["defects"].as_array().unwrap().is_empty(), "{name}: {sound}");
    let wanted = wall(&sound);
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
    assert_repaired("missing", &torn, &block(), "3 open edges, the first at (");
    let (_, said, report) = planned("missing-again", &torn, &[]);
    assert!(said.contains("gap in an outline closed, the first in layer 0 at ("), "{said}");
    let losses = report.unwrap()["losses"].as_array().unwrap().clone();
    assert_eq!(losses.len(), 4);
    assert!(losses.iter().all(|loss| loss["at"][1] == 0.0), "{losses:?}");
}

#[test]
fn a_base_that_is_open() {
    assert_repaired("open-base", &block()[2..], &block(), "4 open edges");
}

#[test]
fn triangles_wound_against_their_neighbours() {
    let mut mixed = block();
    for k in [1, 6, 9] {
        mixed[k].swap(0, 1);
    }
    assert_repaired("turned", &mixed, &block(), "3 triangles turned over");
}

#[test]
fn a_body_that_is_inside_out() {
    assert_repaired("inside-out", &flipped(&block()), &block(), "1 shells turned over");
    let other = cuboid([10.0, 10.0, 0.0], [30.0, 30.0, 4.0]);
    let sound = [block(), other.clone()].concat();
    assert_repaired(
        "inside-out-overlapping",
        &[block(), flipped(&other)].concat(),
        &sound,
        "1 shells turned over",
    );
}

#[test]
fn triangles_that_are_there_twice() {
    assert_repaired("twice", &[block(), block()].concat(), &block(), "12 duplicate triangles dropped");
    assert_repaired(
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
    assert_repaired("face", &[block(), beside].concat(), &wide, "2 faces between bodies dropped");
    let diagonal = cuboid([20.0, 20.0, 0.0], [40.0, 40.0, 4.0]);
    let (status, said, _) = planned("edge", &[block(), diagonal].concat(), &[]);
    assert_eq!(status, Some(DONE), "{said}");
    assert!(
        said.contains("1 edges with more than two triangles, the first at (20.00, 20.00, 2.00)"),
        "{said}"
    );
}

/// Losses of one kind, in the report.
fn losses(report: &Value, kind: &str) -> Vec<Value> {
    let all = report["losses"].as_array().unwrap();
    all.iter().filter(|loss| loss["kind"].as_str().unwrap().starts_with(kind)).cloned().collect()
}

#[test]
fn bodies_that_overlap_are_one() {
    let other = cuboid([10.0, 10.0, 0.0], [30.0, 30.0, 4.0]);
    // One inside the other, both facing outwards: no cavity, and told.
    let inner = cuboid([6.0, 6.0, 0.0], [14.0, 14.0, 4.0]);
    for (name, other, common) in [("overlapping", other, 100.0), ("nested", inner, 64.0)] {
        let both = [block(), other].concat();
        let (status, said, report) = planned(name, &both, &[]);
        assert_eq!(status, Some(DONE), "{said}");
        assert!(said.contains("4 places: bodies that overlap made one, the first in layer 0 at ("), "{said}");
        let report = report.unwrap();
        assert_eq!(
            (&report["repairs"]["shells"], report["audit"]["sound"].as_bool()),
            (&2.into(), Some(true))
        );
        let told = losses(&report, "bodies that overlap made one");
        assert!(
            told.iter().all(|loss| (loss["measure"].as_f64().unwrap() - common).abs() < 0.01),
            "{told:?}"
        );
        let (status, said, _) = planned(name, &both, &["--strict"]);
        assert_eq!(status, Some(BAD_INPUT), "{said}");
        assert!(said.contains("layer 0, near (") && said.contains("bodies overlap in"), "{said}");
    }
    // The same turned inside out is a cavity.
    let hollow = [block(), flipped(&cuboid([6.0, 6.0, 0.0], [14.0, 14.0, 4.0]))].concat();
    let (status, said, report) = planned("hollow", &hollow, &["--strict"]);
    assert_eq!(status, Some(DONE), "{said}");
    let wall = report.unwrap()["wall_mm"].as_f64().unwrap();
    // The outer wall, and round the cavity one that turns about its corners.
    assert!((4.0 * (68.0 + 32.0)..4.0 * (68.0 + 44.0)).contains(&wall), "{wall}");
}

/// A box whose sides are cut into strips of this width along x, so that it has many triangles.
fn ribbed(low: [f32; 3], high: [f32; 3], strips: u16) -> Vec<Triangle> {
    let at = |k: u16| low[0] + (high[0] - low[0]) * f32::from(k) / f32::from(strips);
    let mut all = Vec::new();
    for k in 0..strips {
        let strip = cuboid([at(k), low[1], low[2]], [at(k + 1), high[1], high[2]]);
        // The faces between the strips are left out.
        let ends = |x: f32| move |side: &&Triangle| !side.iter().all(|corner| corner[0] == x);
        let (first, last) =
            (if k == 0 { f32::NAN } else { at(k) }, if k + 1 == strips { f32::NAN } else { at(k + 1) });
        all.extend(strip.iter().filter(ends(first)).filter(ends(last)));
    }
    all
}

#[test]
fn a_cavity_that_sticks_out_of_its_body_is_none() {
    // Only the last of its 200 strips is outside of the block.
    let inner = ribbed([1.0, 6.0, 0.0], [20.0, 14.0, 4.0], 199);
    let out = cuboid([20.0, 6.0, 0.0], [27.0, 14.0, 4.0]);
    let long = [&inner[..], &out].concat();
    let long: Vec<Triangle> =
        long.into_iter().filter(|side| !side.iter().all(|corner| corner[0] == 20.0)).collect();
    let sound = [block(), long.clone()].concat();
    assert_repaired("sticks-out", &[block(), flipped(&long)].concat(), &sound, "1 shells turned over");
}

#[test]
fn a_surface_that_crosses_itself() {
    // The upright walls of an hourglass: one of its halves runs the wrong way round.
    let (a, b, c, d) = ([0.0, 0.0], [20.0, 16.0], [20.0, 0.0], [0.0, 16.0]);
    let at = |[x, y]: [f32; 2], z: f32| [x, y, z];
    let walls = [(a, b), (b, c), (c, d), (d, a)].into_iter().flat_map(|(from, to)| {
        [[at(from, 0.0), at(to, 0.0), at(to, 4.0)], [at(from, 0.0), at(to, 4.0), at(from, 4.0)]]
    });
    let walls: Vec<Triangle> = walls.collect();
    // By itself it is solid in both halves, which touch in a point.
    let (status, said, _) = planned("hourglass", &walls, &[]);
    assert!(status == Some(BAD_INPUT) && said.contains("a surface is inside out"), "{status:?} {said}");
    // A ring that winds twice: bodies that overlap, of one surface.
    let twice = [&block()[4..], &cuboid([4.0, 4.0, 0.0], [16.0, 16.0, 4.0])[4..]].concat();
    let (status, said, report) = planned("twice-round", &twice, &[]);
    assert_eq!(status, Some(DONE), "{said}");
    assert!(said.contains("open edges") && said.contains("bodies that overlap made one"), "{said}");
    assert_eq!(report.unwrap()["audit"]["sound"], true);
}

#[test]
fn junctions_without_a_vertex() {
    // One of the two triangles at an edge is cut at its middle, its neighbour is not.
    let mut split = block();
    let [a, b, c] = split.remove(4);
    let middle = [0, 1, 2].map(|k| (a[k] + b[k]) / 2.0);
    split.extend([[a, middle, c], [middle, b, c]]);
    assert_repaired("junction", &split, &block(), "open edges");
    // The same along an upright edge, which every layer meets.
    let mut split = block();
    let side =
        split.iter().position(|t| t.iter().filter(|p| p[0] == 20.0 && p[1] == 20.0).count() == 2).unwrap();
    let corners = split.remove(side);
    let edge = (0..3)
        .find(|&k| [k, (k + 1) % 3].iter().all(|&k| corners[k][0] == 20.0 && corners[k][1] == 20.0))
        .unwrap();
    let [a, b, c] = [0, 1, 2].map(|k| corners[(edge + k) % 3]);
    let middle = [0, 1, 2].map(|k| (a[k] + b[k]) / 2.0);
    split.extend([[a, middle, c], [middle, b, c]]);
    assert_repaired("upright-junction", &split, &block(), "open edges");
}

#[test]
fn parts_without_volume() {
    // A sheet with two sides, a needle and a point beside the block.
    let sheet = [
        [[30.0, 0.0, 0.0], [40.0, 0.0, 0.0], [40.0, 0.0, 4.0]],
        [[30.0, 0.0, 0.0], [40.0, 0.0, 4.0], [40.0, 0.0, 0.0]],
    ];
    let needle = [[50.0, 0.0, 0.0], [50.0, 0.0, 2.0], [50.0, 0.0, 4.0]];
    let point = [[60.0, 0.0, 1.0]; 3];
    let (status, said, _) = planned("sheet-beside", &[&block()[..], &sheet].concat(), &[]);
    let is_told = said.contains("duplicate triangles dropped") || said.contains("cannot be closed");
    assert!(is_told && status != Some(1), "{status:?} {said}");
    let (status, said, report) = planned("point-beside", &[&block()[..], &[point]].concat(), &[]);
    assert_eq!(status, Some(DONE), "{said}");
    assert!(said.contains("1 triangles without area dropped, the first at (60.00, 0.00, 1.00)"), "{said}");
    assert_eq!(report.unwrap()["audit"]["sound"], true);
    let (status, said, _) = planned("needle-beside", &[&block()[..], &[needle]].concat(), &[]);
    assert!(
        said.contains("open edges") && [Some(DONE), Some(BAD_INPUT)].contains(&status),
        "{status:?} {said}"
    );
    for (name, triangles) in [("only-point", vec![point]), ("nothing", vec![])] {
        let (status, said, _) = planned(name, &triangles, &[]);
        assert_eq!(status, Some(BAD_INPUT), "{said}");
        assert!(said.contains("model.stl") && said.contains("no triangle"), "{said}");
    }
}

#[test]
fn a_part_too_thin_for_any_wall() {
    // A fin beside the block. In one layer less than w² of it is missing either way.
    let with_fin = |length: f32| [block(), cuboid([30.0, 5.0, 0.0], [30.1, 5.0 + length, 4.0])].concat();
    let (status, said, report) = planned("long-fin", &with_fin(30.0), &[]);
    assert_eq!(status, Some(FINDINGS), "{said}");
    assert!(said.contains("missing: 4 places: too small to print, most of it 3.0 mm² in layer "), "{said}");
    let report = report.unwrap();
    assert_eq!(report["audit"]["sound"], true);
    let lost = losses(&report, "too small to print");
    let is_fin =
        |loss: &Value| loss["finding"] == true && (loss["at"][0].as_f64().unwrap() - 30.05).abs() < 0.06;
    assert!(lost.len() == 4 && lost.iter().all(is_fin), "{lost:?}");

    let (status, said, report) = planned("short-fin", &with_fin(10.0), &[]);
    assert_eq!(status, Some(DONE), "{said}");
    assert!(said.contains("note: 4 places: too small to print, the first in layer 0 at (30.0"), "{said}");
    let lost = losses(&report.unwrap(), "too small to print");
    assert!(lost.len() == 4 && lost.iter().all(|loss| loss["finding"] == false), "{lost:?}");
}

#[test]
fn numbers_that_are_no_lengths() {
    let with = |value: f32| {
        let mut triangles = block();
        triangles[7][1][0] = value;
        triangles
    };
    for (name, value) in [("nan", f32::NAN), ("infinite", f32::INFINITY), ("huge", 3e7)] {
        let (status, said, _) = planned(name, &with(value), &[]);
        assert_eq!(status, Some(BAD_INPUT), "{said}");
        assert!(said.contains("triangle 7 has a coordinate"), "{said}");
    }
    let scaled = |factor: f32| -> Vec<Triangle> {
        block().iter().map(|t| t.map(|p| p.map(|value| value * factor))).collect()
    };
    let (status, said, _) = planned("tiny", &scaled(1e-3), &[]);
    assert_eq!(status, Some(BAD_INPUT), "{said}");
    assert!(said.contains("--unit") && said.contains("less than half a layer"), "{said}");
    let (status, said, _) = planned("wide", &scaled(2e4), &[]);
    assert_eq!(status, Some(BAD_INPUT), "{said}");
    assert!(said.contains("model.stl: ") && said.contains("more than"), "{said}");
    // A thousand metres away, where single precision has steps of 0.06 mm.
    let far: Vec<Triangle> = block().iter().map(|t| t.map(|[x, y, z]| [x + 5e5, y - 5e5, z])).collect();
    let (status, said, report) = planned("far", &far, &[]);
    assert_eq!(status, Some(DONE), "{said}");
    assert_eq!(report.unwrap()["audit"]["sound"], true);
}

#[test]
fn files_that_are_cut_short_or_of_the_other_byte_order() {
    let whole = stl(&block());
    let mut swapped = whole.clone();
    for word in swapped[80..84].chunks_exact_mut(4) {
        word.reverse();
    }
    for record in swapped[84..].chunks_exact_mut(50) {
        record[..48].chunks_exact_mut(4).for_each(<[u8]>::reverse);
    }
    let mut half_swapped = whole.clone();
    half_swapped[84..]
        .chunks_exact_mut(50)
        .for_each(|record| record[..48].chunks_exact_mut(4).for_each(<[u8]>::reverse));
    let text = b"solid block\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0";
    for (name, bytes, says) in [
        ("empty", &[][..], "model.stl"),
        ("header", &whole[..84], "12 triangles, but the file holds 0"),
        ("cut", &whole[..84 + 5 * 50], "12 triangles, but the file holds 5"),
        ("cut-inside", &whole[..84 + 5 * 50 + 17], "5 (17 bytes over)"),
        ("other-order", &swapped[..], "declares 201326592 triangles"),
        ("mixed-order", &half_swapped[..], "less than half a layer"),
        ("text-cut", &text[..], "line 5: expected"),
    ] {
        let folder = folder(&format!("file-{name}"));
        fs::write(folder.join("model.stl"), bytes).unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_argil"))
            .args(["plan", "model.stl", "-o", "out.gcode"])
            .current_dir(&folder)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(BAD_INPUT), "{name}: {said}");
        assert!(said.contains(says) && !said.contains("panicked"), "{name}: no `{says}` in\n{said}");
        assert!(!folder.join("out.gcode").exists());
    }
}

#[test]
fn what_was_planned_can_be_written_and_measured_against() {
    // A block with a missing triangle, one that is inside out, and one inside it.
    let mut torn = block();
    torn.remove(4);
    let others =
        [flipped(&cuboid([15.0, 5.0, 0.0], [35.0, 15.0, 4.0])), cuboid([4.0, 4.0, 0.0], [9.0, 9.0, 3.0])];
    let (status, said, report) =
        planned("repaired", &[torn, others.concat()].concat(), &["--repaired", "repaired.stl"]);
    assert_eq!(status, Some(DONE), "{said}");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("broken/repaired");
    let argil = |words: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_argil"))
            .args(words.split(' '))
            .current_dir(&folder)
            .output()
            .unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let (status, figures) = argil("audit out.gcode --model repaired.stl --width 3");
    assert!(status == Some(DONE) && figures.ends_with("sound\n"), "{figures}");
    // It is planned to the same walls, and needs no repair but that its prisms touch.
    let (status, _) = argil("plan repaired.stl -o again.gcode --width 3 --report again.json");
    assert_eq!(status, Some(DONE));
    let again: Value = serde_json::from_slice(&fs::read(folder.join("again.json")).unwrap()).unwrap();
    assert_eq!(again["losses"].as_array().unwrap().len(), 0, "{again}");
    let walls = [&report.unwrap(), &again].map(|report| report["wall_mm"].as_f64().unwrap());
    assert!((walls[0] - walls[1]).abs() < 1e-3 * walls[0], "{walls:?}");
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
