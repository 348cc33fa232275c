//! The same model in every format gives the same print, and units are stated.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const DONE: i32 = 0;
const BAD_INPUT: i32 = 3;

/// A new, empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("formats").join(name);
    drop(fs::remove_dir_all(&path));
    fs::create_dir_all(&path).unwrap();
    path
}

/// The vertices and triangles of a wedge.
fn wedge(scale: f64) -> ([[f64; 3]; 6], [[usize; 3]; 8]) {
    let vertices = [
        [0.0, 0.0, 0.0],
        [24.0, 0.0, 0.0],
        [0.0, 16.0, 0.0],
        [0.0, 0.0, 6.0],
        [24.0, 0.0, 6.0],
        [0.0, 16.0, 6.0],
    ];
    let triangles = [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
    (vertices.map(|vertex| vertex.map(|value| value * scale)), triangles)
}

fn stl(scale: f64) -> Vec<u8> {
    let (vertices, triangles) = wedge(scale);
    let mut text = "solid wedge\n".to_owned();
    for corners in triangles {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in corners.map(|k| vertices[k]) {
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    (text + "endsolid wedge\n").into_bytes()
}

fn obj(scale: f64) -> Vec<u8> {
    let (vertices, triangles) = wedge(scale);
    let positions = vertices.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = triangles.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    positions.chain(faces).collect::<String>().into_bytes()
}

fn ply(scale: f64) -> Vec<u8> {
    let (vertices, triangles) = wedge(scale);
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 6\nproperty double x\nproperty double y\nproperty double z\n\
        element face 8\nproperty list uchar uint vertex_index\nend_header\n";
    let mut bytes = header.as_bytes().to_vec();
    bytes.extend(vertices.iter().flatten().flat_map(|value| value.to_le_bytes()));
    for corners in triangles {
        bytes.push(3);
        bytes.extend(corners.iter().flat_map(|&k| u32::try_from(k).unwrap().to_le_bytes()));
    }
    bytes
}

fn three_mf(scale: f64, unit: &str) -> Vec<u8> {
    let (vertices, triangles) = wedge(scale);
    let vertices = vertices.iter().map(|[x, y, z]| format!("<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>"));
    let triangles = triangles.iter().map(|[a, b, c]| format!("<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>"));
    let (vertices, triangles): (String, String) = (vertices.collect(), triangles.collect());
    let model = format!(
        "<model unit=\"{unit}\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources><object id=\"1\"><mesh>\
         <vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object></resources>\
         <build><item objectid=\"1\"/></build></model>"
    );
    stored("3D/3dmodel.model", model.as_bytes())
}

/// A ZIP archive of one part that is not packed.
fn stored(name: &str, part: &[u8]) -> Vec<u8> {
    let checksum = !part.iter().fold(!0_u32, |sum, byte| {
        (0..8).fold(
            sum ^ u32::from(*byte),
            |sum, _| if sum & 1 == 1 { sum >> 1 ^ 0xedb8_8320 } else { sum >> 1 },
        )
    });
    let (size, name_size) = (u32::try_from(part.len()).unwrap(), u16::try_from(name.len()).unwrap());
    let mut common = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    for number in [checksum, size, size] {
        common.extend(number.to_le_bytes());
    }
    common.extend(name_size.to_le_bytes());
    common.extend([0, 0]);
    let mut bytes = b"PK\x03\x04".to_vec();
    bytes.extend(&common);
    bytes.extend(name.as_bytes());
    bytes.extend(part);
    let directory = u32::try_from(bytes.len()).unwrap();
    bytes.extend(b"PK\x01\x02\x14\x00");
    bytes.extend(&common);
    bytes.extend([0; 14]);
    bytes.extend(name.as_bytes());
    let length = u32::try_from(bytes.len()).unwrap() - directory;
    bytes.extend(b"PK\x05\x06\0\0\0\0\x01\0\x01\0");
    bytes.extend(length.to_le_bytes());
    bytes.extend(directory.to_le_bytes());
    bytes.extend([0, 0]);
    bytes
}

/// Plans a file with a bead of 3 mm; the moves and what was said.
fn planned(folder: &Path, file: &str, bytes: &[u8], extra: &[&str], status: i32) -> (Vec<String>, String) {
    fs::write(folder.join(file), bytes).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_argil"))
        .args(["plan", file, "-o", "out.gcode", "--width", "3"])
        .args(extra)
        .current_dir(folder)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{file} {extra:?}: {said}");
    let gcode = fs::read_to_string(folder.join("out.gcode")).unwrap_or_default();
    let moves = gcode.lines().filter(|line| !line.starts_with("; model")).map(str::to_owned).collect();
    drop(fs::remove_file(folder.join("out.gcode")));
    (moves, said)
}

#[test]
fn the_same_model_in_every_format_is_the_same_print() {
    let folder = folder("same");
    let (wanted, said) = planned(&folder, "wedge.stl", &stl(1.0), &["--strict"], DONE);
    assert!(wanted.len() > 30 && !said.contains("--unit"), "{said}");
    // By content, whatever the name.
    for (file, bytes) in
        [("wedge.obj", obj(1.0)), ("wedge.ply", ply(1.0)), ("wedge.stl", ply(1.0)), ("wedge", obj(1.0))]
    {
        assert_eq!(planned(&folder, file, &bytes, &["--strict"], DONE).0, wanted, "{file}");
    }
    #[cfg(feature = "3mf")]
    for (scale, unit) in [(1.0, "millimeter"), (0.1, "centimeter"), (1000.0, "micron")] {
        let bytes = three_mf(scale, unit);
        assert_eq!(planned(&folder, "wedge.3mf", &bytes, &["--strict"], DONE).0, wanted, "{unit}");
    }
}

#[test]
fn units_are_stated_and_never_guessed() {
    let folder = folder("units");
    let (wanted, _) = planned(&folder, "wedge.obj", &obj(1.0), &[], DONE);
    for (scale, unit) in [(0.001, "m"), (0.1, "cm"), (1000.0, "micron")] {
        let (moves, said) = planned(&folder, "wedge.obj", &obj(scale), &["--unit", unit], DONE);
        assert!(moves == wanted && !said.contains("odd"), "{unit}: {said}");
    }
    // A file in metres taken as it is: too small, and the hint says why.
    let (_, said) = planned(&folder, "wedge.stl", &stl(0.001), &[], BAD_INPUT);
    assert!(said.contains("largest extent is 0.024 mm") && said.contains("--unit m\n"), "{said}");
    let (_, said) = planned(&folder, "wedge.obj", &obj(1.0 / 3.0), &[], DONE);
    assert!(said.contains("--unit inch\n"), "{said}");
    let (_, said) = planned(&folder, "wedge.obj", &obj(1.0 / 3.0), &["--unit", "mm"], DONE);
    assert!(!said.contains("odd"), "{said}");
    #[cfg(feature = "3mf")]
    {
        let (_, said) = planned(&folder, "wedge.3mf", &three_mf(1.0 / 3.0, "millimeter"), &[], DONE);
        assert!(!said.contains("odd"), "{said}");
        // The option wins over what the file states.
        let (moves, _) = planned(&folder, "wedge.3mf", &three_mf(1.0, "meter"), &["--unit", "mm"], DONE);
        assert_eq!(moves, wanted);
    }
}

#[test]
fn layers_of_another_program_are_printed_as_they_are() {
    let folder = folder("layers");
    let ring = |half: f64| format!("[[-{half},-{half}],[{half},-{half}],[{half},{half}],[-{half},{half}]]");
    // A tower that narrows, with a hole that runs the same way round as its outline.
    let layers: Vec<String> =
        (0..6).map(|k| format!("[{},{}]", ring(12.0 - 0.2 * f64::from(k)), ring(6.0))).collect();
    let text = format!("{{\"layer_height\": 1, \"layers\": [{}]}}", layers.join(","));
    let (moves, said) = planned(&folder, "tower.json", text.as_bytes(), &["--report", "out.json"], DONE);
    assert!(said.contains("6 layers in one strand") && said.contains("audit: sound"), "{said}");
    assert!(moves.len() > 30);
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    // Half a bead inside the outline, and outside the hole.
    let walls: f64 = (0..6).map(|k| 8.0 * (10.5 - 0.2 * f64::from(k)) + 8.0 * 7.5).sum();
    assert!(
        (report["wall_mm"].as_f64().unwrap() / walls - 1.0).abs() < 0.01,
        "{} of {walls}",
        report["wall_mm"]
    );
    assert_eq!(report["losses"].as_array().unwrap().len(), 0);
    // In metres.
    let metres = text.replace("\"layer_height\": 1,", "\"unit\": \"mm\", \"layer_height\": 1.0,");
    assert_eq!(planned(&folder, "tower.json", metres.as_bytes(), &["--unit", "mm"], DONE).0, moves);
    for (text, extra, says) in [
        (
            text.clone(),
            &["--layer-height", "0.5"][..],
            "its layers are 1 mm high, the plan's 0.5 mm; say --layer-height 1",
        ),
        (text.replace("mm", ""), &["--scale", "2"], "say --layer-height 2"),
        ("{\"layers\": []}".to_owned(), &[], "missing field `layer_height`"),
        ("{\"layer_height\": 1, \"layers\": [[]]}".to_owned(), &[], "no layer has a contour"),
        ("{\"layer_height\": 0, \"layers\": [[]]}".to_owned(), &[], "layer_height must be"),
        (
            "{\"layer_height\": 1, \"layers\": [[[[0,1],[1e9,0],[0,0]]]]}".to_owned(),
            &[],
            "contour 0 of layer 0",
        ),
        (
            "{\"unit\": \"ell\", \"layer_height\": 1, \"layers\": []}".to_owned(),
            &[],
            "there is no unit `ell`",
        ),
        ("{\"layer_height\": 1, \"layers\": [[[[0,1,2]]]]}".to_owned(), &[], "tower.json, read as layers"),
    ] {
        let (_, said) = planned(&folder, "tower.json", text.as_bytes(), extra, BAD_INPUT);
        assert!(said.contains(says), "no `{says}` in\n{said}");
    }
}

#[test]
fn a_drawing_is_printed_as_its_layers() {
    let folder = folder("drawing");
    // A tower of 6 layers with a hole: the same as JSON and as two kinds of SVG.
    let (mut json, mut drawn, mut sliced) = (String::new(), String::new(), String::new());
    for k in 0..6 {
        let (low, high) = (f64::from(k) * 0.2, 24.0 - f64::from(k) * 0.2);
        json += &format!(
            "{}[[[{low},{low}],[{high},{low}],[{high},{high}],[{low},{high}]],[[8,8],[14,8],[14,16],[8,16]]]",
            if k == 0 { "" } else { "," }
        );
        let [side, far] = [10.0 * (high - low), 240.0 - 10.0 * low - 10.0 * (high - low)];
        drawn += &format!(
            "<g><rect x=\"{}\" y=\"{far}\" width=\"{side}\" height=\"{side}\"/><rect x=\"80\" y=\"80\" width=\"60\" height=\"80\"/></g>",
            10.0 * low
        );
        let [low_y, high_y] = [24.0 - low, 24.0 - high];
        sliced += &format!(
            "<g slic3r:z=\"{}\" slic3r:layer-height=\"1\"><path d=\"M {low} {low_y} {high} {low_y} {high} {high_y} {low} {high_y} z \
             M 8 16 8 8 14 8 14 16 z\"/></g>",
            k + 1
        );
    }
    let json = format!("{{\"layer_height\": 1, \"layers\": [{json}]}}");
    let drawn = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"24mm\" height=\"24mm\" viewBox=\"0 0 240 240\">{drawn}</svg>"
    );
    let sliced = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\" width=\"24\" height=\"24\">{sliced}</svg>"
    );
    let (moves, said) = planned(&folder, "tower.json", json.as_bytes(), &[], DONE);
    assert!(said.contains("audit: sound"), "{said}");
    let (same, said) = planned(&folder, "drawn.svg", drawn.as_bytes(), &[], DONE);
    assert!(said.contains("it does not say how high its layers are: 1 mm is taken"), "{said}");
    assert!(said.contains("6 layers in one strand") && said.contains("audit: sound"), "{said}");
    assert_eq!(same, moves);
    let (same, said) = planned(&folder, "sliced.svg", sliced.as_bytes(), &[], DONE);
    assert!(!said.contains("note: sliced.svg"), "{said}");
    assert_eq!(same, moves);
    // Scaled, its layers are as high as the plan's all the same; in inches it is larger.
    let (_, said) = planned(&folder, "drawn.svg", drawn.as_bytes(), &["--scale", "2"], DONE);
    assert!(said.contains("6 layers in one strand"), "{said}");
    for (text, extra, says) in [
        (sliced.replace("layer-height=\"1\"", "layer-height=\"0.5\""), &[][..], "say --layer-height 0.5"),
        (drawn.replace("<rect x=\"80\"", "<text x=\"80\""), &[], "layer 0, line 1: `text` is not read"),
        (drawn.replace("<g>", "").replace("</g>", ""), &[], "belongs to no layer"),
        ("<svg/>".to_owned(), &[], "it has no group"),
        (drawn, &["--height", "12"], "say --layer-height 2"),
    ] {
        let (_, said) = planned(&folder, "bad.svg", text.as_bytes(), extra, BAD_INPUT);
        assert!(said.contains("bad.svg") && said.contains(says), "no `{says}` in\n{said}");
    }
}

#[test]
fn what_is_no_model_is_told_by_name() {
    let folder = folder("none");
    for (file, bytes, says) in [
        ("part.step", &b"ISO-10303-21;\nHEADER;\n"[..], "part.step: no STL, OBJ, PLY or 3MF file"),
        ("part.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 3\n", "part.obj, read as OBJ: line 3"),
        (
            "part.ply",
            b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n1\n",
            "part.ply, read as PLY: line 6",
        ),
        ("part.3mf", b"PK\x03\x04", "part.3mf, read as 3MF"),
        ("part.3mf", b"<model/>", "part.3mf, read as 3MF"),
    ] {
        let (moves, said) = planned(&folder, file, bytes, &[], BAD_INPUT);
        assert!(moves.is_empty() && said.contains(says), "no `{says}` in\n{said}");
    }
}
