//! Writes the made seeds again: `cargo run --example seeds`. Those that were found by fuzzing stay as they are.

use std::fs;
use std::path::Path;

/// Numbers that depend on nothing but their seed.
struct SplitMix(u64);

impl SplitMix {
    fn byte(&mut self) -> u8 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed >> 56) as u8
    }
}

/// A tetrahedron as text and in binary, whole, cut short, and with a number that is none.
fn stl_files() -> [(&'static str, Vec<u8>); 5] {
    let corners = [[0.0_f32, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 10.0]];
    let sides = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let mut text = String::from("solid tetrahedron\n");
    let mut binary = vec![b' '; 80];
    binary.extend(4_u32.to_le_bytes());
    for side in sides {
        text += "  facet normal 0 0 0\n    outer loop\n";
        binary.extend([0; 12]);
        for corner in side.map(|k: usize| corners[k]) {
            text += &format!("      vertex {} {} {}\n", corner[0], corner[1], corner[2]);
            binary.extend(corner.iter().flat_map(|value| value.to_le_bytes()));
        }
        text += "    endloop\n  endfacet\n";
        binary.extend([0, 0]);
    }
    text += "endsolid tetrahedron\n";
    let mut not_a_number = binary.clone();
    not_a_number[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    [
        ("ascii", text.clone().into_bytes()),
        ("ascii_cut", text.as_bytes()[..200].to_vec()),
        ("binary_cut", binary[..150].to_vec()),
        ("not_a_number", not_a_number),
        ("binary", binary),
    ]
}

/// A tetrahedron as OBJ, with polygons and indices of all kinds, and what is none.
fn obj_files() -> [(&'static str, &'static str); 4] {
    [
        ("tetrahedron", "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"),
        (
            "polygons",
            "# quads\r\no a\r\nv 0 0 0 1\r\nv 9 0 0\r\nv 9 9 0\r\nv 0 9 0\r\nf 1/1/1 2//2 \\\r\n -2 -1\r\nvn 0 0 1\r\n",
        ),
        ("out_of_range", "v 1 1 1\nf 1 2 3\nf 0 -9 1\n"),
        ("odd_numbers", "v nan 1e999 -.5\nv 1 2\nf 99999999999999999999 1 1\ncurv 0 1\n"),
    ]
}

/// Layers in JSON and in SVG as programs write them, and what is none.
fn layer_files() -> [(&'static str, &'static str); 6] {
    [
        (
            "json",
            r#"{ "unit": "cm", "layer_height": 0.1, "layers": [[[[0,0],[2,0],[2,2],[0,2]]], [], [[[0,0],[1,0],[1,1]]]] }"#,
        ),
        (
            "slic3r",
            r#"<?xml version="1.0" encoding="UTF-8" standalone="yes"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.0//EN" "http://www.w3.org/TR/2001/REC-SVG-20010904/DTD/svg10.dtd">
<svg width="20.0" height="10.0" xmlns="http://www.w3.org/2000/svg" xmlns:slic3r="http://slic3r.org/namespaces/slic3r">
<g id="layer0" slic3r:z="0.5" slic3r:layer-height="0.5"><path d="M 1 9 9 9 9 1 1 1 z M 3 3 3 5 5 5 5 3 z"/></g>
<g id="layer1" slic3r:z="1" slic3r:layer-height="0.5"><polygon points="1,1 9,1 9,9" slic3r:type="contour"/><circle r="2" slic3r:type="support"/></g>
</svg>"#,
        ),
        (
            "shapes",
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="3cm" viewBox="0 0 400 300"><g transform="rotate(3)">
<g transform="matrix(1 0 0 1 5 5)"><rect x="1" width="9" height="9"/></g><g><circle cx="5" cy="5" r="4"/><ellipse rx="3" ry="2"/></g>
<g style="display:none"><polyline points="0 0 9 0 9 9 0 0"/></g></g></svg>"#,
        ),
        (
            "curves",
            r#"<svg><g><path d="m1 2c3 4 5 6 7 8s1 2 3 4q5 6 7 8t9-9a25 26 -30 0 1 50-25h4v5H1V2z"/></g><g><path d="M0 0L1 0L1 1Z"/></g></svg>"#,
        ),
        (
            "entities",
            r#"<!DOCTYPE svg [<!ENTITY a "1 0 "><!ENTITY b "&a;&a;&b;">]><svg><g><polygon points="&b;"/></g></svg>"#,
        ),
        (
            "not_read",
            r#"<svg viewBox="0 0 1e300 1"><g><text>7</text><path d="M0 0A1e300 1 0 0 1 9 9" clip-path="url(#a)"/></g></svg>"#,
        ),
    ]
}

/// A triangle as PLY in all encodings, and headers that promise too much.
fn ply_files() -> [(&'static str, Vec<u8>); 5] {
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty float y\nproperty short z\n\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
        .into_bytes()
    };
    let ascii = [header("ascii"), b"0 0 0\n9 0 1\n0 9 2\n3 0 1 2\n".to_vec()].concat();
    let mut least = header("binary_little_endian");
    let mut greatest = header("binary_big_endian");
    for [x, y, z] in [[0.0_f32, 0.0, 0.0], [9.0, 0.0, 1.0], [0.0, 9.0, 2.0]] {
        least.extend([x, y].iter().flat_map(|value| value.to_le_bytes()).chain((z as i16).to_le_bytes()));
        greatest.extend([x, y].iter().flat_map(|value| value.to_be_bytes()).chain((z as i16).to_be_bytes()));
    }
    least.extend([3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    greatest.extend([3, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2]);
    let promises = b"ply\nformat binary_little_endian 1.0\nelement vertex 4294967296\nproperty list uint double x\nend_header\n\xff\xff\xff\xff";
    let strips = b"ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n3 0 1 2\n";
    [
        ("ascii", ascii),
        ("binary_least_first", least),
        ("binary_greatest_first", greatest),
        ("promises", promises.to_vec()),
        ("strips", strips.to_vec()),
    ]
}

/// Models as they stand in 3MF packages; the target packs them.
fn three_mf_files() -> [(&'static str, &'static str); 4] {
    [
        (
            "tetrahedron",
            "<?xml version=\"1.0\"?><model unit=\"inch\"><resources><object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>\
             <vertex x=\"9\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"9\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"9\"/></vertices><triangles>\
             <triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/>\
             <triangle v1=\"2\" v2=\"0\" v3=\"3\"/></triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>",
        ),
        (
            "components",
            "<m:model xmlns:m=\"c\"><m:resources><m:object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>\
             <vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh></m:object>\
             <object id=\"2\"><components><component objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 5 6 7\"/><component objectid=\"1\"/></components>\
             </object><object id=\"3\" type=\"support\"/></m:resources><build><item objectid=\"2\"/><item objectid=\"3\"/></build></m:model>",
        ),
        (
            "cycle",
            "<model><resources><object id=\"1\"><components><component objectid=\"1\"/><component objectid=\"1\"/></components></object></resources>\
             <build><item objectid=\"1\" p:path=\"/3D/3dmodel.model\"/></build></model>",
        ),
        (
            "extension",
            "<model xmlns:b=\"beams\" requiredextensions=\"b q\"><!DOCTYPE x [<!ENTITY e \"e\">]>&e;</model>",
        ),
    ]
}

/// Moves, arcs and comments as slicers write them, and as none should.
fn gcode_files() -> [(&'static str, &'static str); 5] {
    [
        (
            "strand",
            "G21\nG90\nM83\nG1 Z0.5 F1200\n;LAYER:0\n;TYPE:WALL-OUTER\nG1 X10 Y0 E1.2\nG1 X10 Y10 E1.2\nG1 X0 Y0 E1.7\n",
        ),
        ("arcs", "M82\nG92 E0\nG2 X10 Y0 I5 J0 E3\nG3 X0 Y0 R-5.5 E9\nG2 X0 Y0 I1e9 J-1e9\nG2 X1 Y1\n"),
        (
            "odd_numbers",
            "G1 X1e400 Y-.5 Z+.5\nG1 X--1 Ynan Z\nG1X1Y2E.\nG0 X9999999999999999999999\nG92 X1e308\nG91\nG1 X1e308\n",
        ),
        ("relative", "G91\nM83\nG1 X1 E1\nG1 Y1 E1\nG28\nG90\nG20\nG1 X1\nG10\nG11\n"),
        (
            "line_ends",
            "G1 X1\rG1 X2\r\nG1 X3 ; (a) comment\n(b) G1 X4 *71\nN5 G1 X5*12\n;LAYER:-3\n;LAYER:x\n\u{fffd}",
        ),
    ]
}

fn main() -> std::io::Result<()> {
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds");
    let write = |target: &str, name: &str, bytes: &[u8]| {
        fs::create_dir_all(kept.join(target))?;
        fs::write(kept.join(target).join(name), bytes)
    };
    for (name, bytes) in stl_files() {
        write("read_stl", name, &bytes)?;
    }
    for (name, text) in obj_files() {
        write("read_obj", name, text.as_bytes())?;
    }
    for (name, text) in layer_files() {
        write("read_layers", name, text.as_bytes())?;
    }
    for (name, bytes) in ply_files() {
        write("read_ply", name, &bytes)?;
    }
    for (name, text) in three_mf_files() {
        write("read_three_mf", name, text.as_bytes())?;
    }
    for (name, text) in gcode_files() {
        write("read_gcode", name, text.as_bytes())?;
    }
    // Of the other targets any bytes make an input; longer ones make larger inputs.
    for (name, _) in argil_fuzz::TARGETS.iter().filter(|(name, _)| !name.starts_with("read_")) {
        // Of the name, so that the seeds of a target stay when there are more targets.
        let own = name.bytes().fold(0, |sum: u64, byte| sum.wrapping_mul(31).wrapping_add(u64::from(byte)));
        for length in [24, 48, 96, 192, 384] {
            let mut random = SplitMix(own.wrapping_mul(1000).wrapping_add(length));
            let bytes: Vec<u8> = (0..length).map(|_| random.byte()).collect();
            write(name, &format!("drawn_{length}"), &bytes)?;
        }
    }
    Ok(())
}
