//! The same body in every format is the same body; what is broken is an error.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use argil_mesh::{Format, MeshError, Remark, Soup, Unit, obj, ply};
use proptest::prelude::*;

/// A box of 9 by 6 by 3.
fn cuboid() -> Soup {
    Soup::cuboid([0.0; 3], [9.0, 6.0, 3.0])
}

fn volume(soup: &Soup) -> f64 {
    let (mesh, repairs) = soup.clone().repaired().unwrap();
    assert_eq!(repairs.worst(), None);
    mesh.signed_volume()
}

fn obj_text(soup: &Soup) -> String {
    let positions = soup.vertices.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    let faces = soup.triangles.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    positions.chain(faces).collect()
}

#[test]
fn an_obj_file_is_read() {
    let soup = obj(obj_text(&cuboid()).as_bytes()).unwrap();
    assert_eq!((&soup.vertices, &soup.triangles, soup.unit), (&cuboid().vertices, &cuboid().triangles, None));
    // Quads, indices from the end, texture and normal indices, colours, a line that goes on, other statements.
    let text = "# made by hand\r\nmtllib a.mtl\r\no box\r\nv 0 0 0 0.5 0.5 0.5\r\nv 9 0 0\r\nv 9 6 0\r\nv 0 6 0\r\n\
        v 0 0 3\r\nv 9 0 3\r\nv 9 6 3\r\nv 0 6 3\r\nvn 0 0 1\r\nvt 0 0\r\nusemtl clay\r\ns off\r\n\
        f 4/1/1 3/1/1 2/1/1 1/1/1\r\nf -4 -3 \\\r\n  -2 -1\r\nf 1//1 2//1 6//1 5//1\r\nf 2 3 7 6\r\nf 3 4 8 7\r\nf 4 1 5 8\r\nl 1 2\r\n";
    let soup = obj(text.as_bytes()).unwrap();
    assert_eq!(soup.triangles.len(), 12);
    assert!((volume(&soup) - 162.0).abs() < 1e-9);
}

#[test]
fn a_broken_obj_file_tells_its_line() {
    let line = |text: &str| match obj(text.as_bytes()) {
        Err(MeshError::Unreadable { line, .. }) => line,
        other => panic!("{other:?}"),
    };
    assert_eq!(line("v 0 0 0\nv 1 0\n"), 2);
    assert_eq!(line("v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\n"), 5);
    assert_eq!(line("v 0 0 0\nf 1 0 1\n"), 2);
    assert_eq!(line("v 0 0 0\nf 1 -2 1\n"), 2);
    assert_eq!(line("v 0 0 0\nf 1 1\n"), 2);
    assert_eq!(line("v 0 0 0\nf 1 1 x\n"), 2);
    assert_eq!(obj(b""), Err(MeshError::Empty));
    assert!(matches!(obj(b"cstype bezier\n"), Err(MeshError::Unsupported { .. })));
    assert_eq!(obj(b"v 0 0 0\n").unwrap().repaired().unwrap_err(), MeshError::NoTriangles);
}

/// A PLY file of the box, with properties and elements that do not matter.
fn ply_file(soup: &Soup, format: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {format} 1.0\ncomment made by hand\nobj_info none\nelement vertex {}\nproperty float x\nproperty double y\n\
         property uchar red\nproperty float z\nelement edge 1\nproperty int vertex1\nproperty list uchar short more\n\
         element face {}\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n",
        soup.vertices.len(),
        soup.triangles.len(),
    )
    .into_bytes();
    if format == "ascii" {
        let vertices = soup.vertices.iter().map(|[x, y, z]| format!("{x} {y} 255 {z}\n"));
        let faces = soup.triangles.iter().map(|[a, b, c]| format!("0 3 {a} {b} {c}\n"));
        let text: String = vertices.chain(["7 2 -1 5\n".to_owned()]).chain(faces).collect();
        bytes.extend(text.into_bytes());
        return bytes;
    }
    let mut put = |number: &[u8]| {
        let mut number = number.to_vec();
        if format == "binary_big_endian" {
            number.reverse();
        }
        bytes.extend(number);
    };
    for [x, y, z] in &soup.vertices {
        put(&(*x as f32).to_le_bytes());
        put(&y.to_le_bytes());
        put(&[255]);
        put(&(*z as f32).to_le_bytes());
    }
    put(&7_i32.to_le_bytes());
    put(&[2]);
    put(&(-1_i16).to_le_bytes());
    put(&5_i16.to_le_bytes());
    for corners in &soup.triangles {
        put(&[0]);
        put(&[3]);
        corners.iter().for_each(|corner| put(&corner.to_le_bytes()));
    }
    bytes
}

#[test]
fn a_ply_file_is_read_in_all_encodings() {
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let bytes = ply_file(&cuboid(), format);
        let soup = ply(&bytes).unwrap();
        assert_eq!(
            (&soup.vertices, &soup.triangles, soup.unit),
            (&cuboid().vertices, &cuboid().triangles, None),
            "{format}"
        );
        assert_eq!(Format::of(&bytes, None), Some(Format::Ply));
        // Nothing shorter is taken for the file.
        for length in 1..bytes.len() - 1 {
            assert!(ply(&bytes[..length]).is_err(), "{format}, {length} bytes");
        }
    }
}

#[test]
fn a_ply_header_that_promises_too_much_ends_with_the_file() {
    let bomb = "ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\nproperty float x\nend_header\n\0\0\0\0";
    assert!(matches!(ply(bomb.as_bytes()), Err(MeshError::Unreadable { .. })));
    let nothing = "ply\nformat ascii 1.0\nelement vertex 18446744073709551615\nend_header\n";
    assert_eq!(ply(nothing.as_bytes()).unwrap().repaired().unwrap_err(), MeshError::NoTriangles);
    let strips = "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n3 0 1 2\n";
    assert!(matches!(ply(strips.as_bytes()), Err(MeshError::Unsupported { .. })));
    let outside = String::from_utf8(ply_file(&cuboid(), "ascii")).unwrap().replace("0 3 3 7 5", "0 3 3 7 8");
    assert_eq!(
        ply(outside.as_bytes()).unwrap().repaired().unwrap_err(),
        MeshError::NoSuchVertex { triangle: 11, vertex: 8 }
    );
}

#[test]
fn formats_are_told_by_content_first() {
    let text = obj_text(&cuboid());
    assert_eq!(Format::of(text.as_bytes(), Some("STL")), Some(Format::Stl));
    assert_eq!(Format::of(text.as_bytes(), Some("txt")), Some(Format::Obj));
    assert_eq!(Format::of(b"solid a\nendsolid a\n", Some("obj")), Some(Format::Stl));
    assert_eq!(Format::of(b"solidity 1\n", None), None);
    let mut binary = vec![b'x'; 84 + 50];
    binary[80..84].copy_from_slice(&1_u32.to_le_bytes());
    assert_eq!(Format::of(&binary, Some("ply")), Some(Format::Stl));
    assert_eq!(Format::of(b"PK\x03\x04", None), Some(Format::ThreeMf));
    assert_eq!(Format::of(b"", None), None);
}

#[cfg(feature = "3mf")]
mod three_mf {
    use super::*;
    use argil_mesh::three_mf;
    use std::io::Write;

    const CORE: &str = "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" \
        xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"";
    const RELATIONS: &str = "<?xml version=\"1.0\"?><Relationships><Relationship Target=\"/Metadata/a.png\" Id=\"0\" Type=\"thumbnail\"/>\
        <Relationship Target=\"/3D/body.model\" Id=\"1\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

    fn zip(parts: &[(&str, &str)]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut archive = rawzip::ZipArchiveWriter::new(&mut bytes);
        for (name, text) in parts {
            let (mut entry, config) = archive
                .new_file(name)
                .compression_method(rawzip::CompressionMethod::DEFLATE)
                .start()
                .unwrap();
            let packer = flate2::write::DeflateEncoder::new(&mut entry, flate2::Compression::default());
            let mut writer = config.wrap(packer);
            writer.write_all(text.as_bytes()).unwrap();
            let (packer, descriptor) = writer.finish().unwrap();
            packer.finish().unwrap();
            entry.finish(descriptor).unwrap();
        }
        archive.finish().unwrap();
        bytes
    }

    fn mesh(soup: &Soup) -> String {
        let vertices =
            soup.vertices.iter().map(|[x, y, z]| format!("<vertex x=\"{x}\" y=\"{y}\" z=\"{z}\"/>"));
        let triangles = soup
            .triangles
            .iter()
            .map(|[a, b, c]| format!("<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\" pid=\"1\"/>"));
        let (vertices, triangles): (String, String) = (vertices.collect(), triangles.collect());
        format!("<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>")
    }

    fn model(attributes: &str, resources: &str, build: &str) -> String {
        format!(
            "\u{feff}<?xml version=\"1.0\" encoding=\"UTF-8\"?><!-- made by hand --><model {attributes} {CORE}>\
             <resources>{resources}</resources><build>{build}</build></model>"
        )
    }

    fn plain(attributes: &str, build: &str) -> Vec<u8> {
        let body = format!("<object id=\"7\" type=\"model\">{}</object>", mesh(&cuboid()));
        zip(&[("_rels/.rels", RELATIONS), ("3D/body.model", &model(attributes, &body, build))])
    }

    #[test]
    fn a_file_is_read_with_its_unit() {
        let bytes = plain("unit=\"inch\"", "<item objectid=\"7\"/>");
        assert_eq!(Format::of(&bytes, Some("zip")), Some(Format::ThreeMf));
        let soup = three_mf(&bytes).unwrap();
        assert_eq!((soup.unit, soup.triangles.len()), (Some(Unit::Inch), 12));
        assert!((volume(&soup.in_millimetres(Unit::Inch)) - 162.0 * 25.4_f64.powi(3)).abs() < 1e-6);
        let soup = three_mf(&plain("", "<item objectid=\"7\"/>")).unwrap();
        assert_eq!((soup.unit, &soup.vertices), (Some(Unit::Millimetre), &cuboid().vertices));
    }

    #[test]
    fn items_and_components_stand_in_their_places() {
        let part = format!("<object id=\"1\">{}</object>", mesh(&cuboid()));
        let resources = "<object id=\"2\"><components><component objectid=\"1\" p:path=\"/3D/Objects/part.model\"/>\
            <component objectid=\"1\" p:path=\"/3D/Objects/part.model\" transform=\"-1 0 0 0 1 0 0 0 1 -10 0 0\"/></components></object>\
            <object id=\"3\" type=\"support\"><mesh/></object>";
        let build = "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 2 0 0 5\"/><item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 1 0 100 0\"/>\
            <item objectid=\"3\"/>";
        let bytes = zip(&[
            ("_rels/.rels", RELATIONS),
            ("3D/body.model", &model("requiredextensions=\"p\"", resources, build)),
            // The part counts in centimetres, the model in millimetres.
            ("3D/Objects/part.model", &model("unit=\"centimeter\"", &part, "")),
        ]);
        let soup = three_mf(&bytes).unwrap();
        assert_eq!((soup.triangles.len(), soup.remarks.as_slice()), (48, &[Remark::Aids { count: 1 }][..]));
        assert!((volume(&soup) - 162e3 * (2.0 + 2.0 + 1.0 + 1.0)).abs() < 1e-6);
        let bounds = soup.bounds();
        assert_eq!((bounds.min, bounds.max), ([-100.0, 0.0, 0.0], [90.0, 190.0, 65.0]));
    }

    #[test]
    fn what_does_not_hang_together_is_an_error() {
        let broken = |bytes: &[u8], says: &str| {
            let error = three_mf(bytes).expect_err(says).to_string();
            assert!(error.contains(says), "no `{says}` in: {error}");
        };
        let good = plain("", "<item objectid=\"7\"/>");
        for length in 0..good.len() {
            assert!(three_mf(&good[..length]).is_err(), "{length} bytes");
        }
        broken(&plain("", "<item objectid=\"8\"/>"), "every id");
        broken(&plain("unit=\"ell\"", ""), "a unit");
        broken(&plain("", "<item objectid=\"7\" transform=\"1 0 0\"/>"), "3D/body.model, byte");
        broken(&plain("", "<item objectid=\"7\" p:path=\"/3D/none.model\"/>"), "3D/none.model");
        broken(
            &plain("xmlns:b=\"http://example.org/beams\" requiredextensions=\"b\"", ""),
            "http://example.org/beams",
        );
        broken(&zip(&[("3D/3dmodel.model", "<model><resources></model>")]), "well-formed");
        broken(&zip(&[("3D/3dmodel.model", "<html/>")]), "a model");
        broken(&zip(&[("a.txt", "")]), "3D/3dmodel.model");
        let mut flipped = good.clone();
        let middle = good.windows(7).position(|name| name == b"3D/body").unwrap() + 100;
        flipped[middle] ^= 0x55;
        assert!(three_mf(&flipped).is_err());
    }

    #[test]
    fn bombs_are_refused() {
        let spaces = " ".repeat(300 << 20);
        let bytes = zip(&[("3D/3dmodel.model", &format!("<model>{spaces}</model>"))]);
        assert!(bytes.len() < 1 << 20);
        assert!(matches!(three_mf(&bytes), Err(MeshError::Unpacked { .. })));
        // Each object is twice the one before.
        let object = |id: u32| {
            format!(
                "<object id=\"{id}\"><components><component objectid=\"{0}\"/><component objectid=\"{0}\"/></components></object>",
                id - 1
            )
        };
        let resources: String = (2..60).map(object).collect();
        let body = format!("<object id=\"1\">{}</object>", mesh(&cuboid()));
        for first in [
            body.as_str(),
            "<object id=\"1\"><mesh/></object>",
            "<object id=\"1\"><components><component objectid=\"59\"/></components></object>",
        ] {
            let bytes = zip(&[(
                "3D/3dmodel.model",
                &model("", &format!("{first}{resources}"), "<item objectid=\"59\"/>"),
            )]);
            assert!(three_mf(&bytes).is_err());
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn damaged_packages_never_panic(at in any::<prop::sample::Index>(), to: u8, cut in any::<prop::sample::Index>()) {
            let mut bytes = plain("", "<item objectid=\"7\"/>");
            let place = at.index(bytes.len());
            bytes[place] = to;
            let _ = three_mf(&bytes);
            let _ = three_mf(&bytes[cut.index(bytes.len())..]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn words_never_panic(words in prop::collection::vec(prop::sample::select(vec![
        "v", "f", "1", "-1", "0", "2/3", "//", "\\", "\n", "\r", "nan", "1e999", "9999999999999999999999", "#", "ply", "format", "ascii", "1.0",
        "binary_big_endian", "element", "vertex", "face", "property", "list", "uchar", "int", "float", "x", "vertex_index", "end_header", "3",
    ]), 0..60)) {
        let text = words.join(" ").replace(" \n ", "\n");
        for soup in [obj(text.as_bytes()), ply(text.as_bytes()), ply(format!("ply\nformat ascii 1.0\n{text}").as_bytes())] {
            let _ = soup.map(Soup::repaired);
        }
    }

    #[test]
    fn a_body_survives_obj_and_ply(scale in 0.01..100.0_f64, shift in [-50.0..50.0_f64, -50.0..50.0, -50.0..50.0]) {
        let mut soup = cuboid();
        soup.vertices.iter_mut().for_each(|v| (0..3).for_each(|axis| v[axis] = v[axis] * scale + shift[axis]));
        prop_assert_eq!(&obj(obj_text(&soup).as_bytes()).unwrap().vertices, &soup.vertices);
        prop_assert_eq!(&ply(&ply_file(&soup, "ascii")).unwrap().vertices, &soup.vertices);
        for format in ["binary_little_endian", "binary_big_endian"] {
            let read = ply(&ply_file(&soup, format)).unwrap();
            let single: Vec<[f64; 3]> =
                soup.vertices.iter().map(|&[x, y, z]| [f64::from(x as f32), y, f64::from(z as f32)]).collect();
            prop_assert_eq!(&read.vertices, &single);
        }
    }
}
