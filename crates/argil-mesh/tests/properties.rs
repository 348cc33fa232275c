//! Invariants of reading, welding, winding and placing, over meshes made here.

use argil_mesh::{Ground, Mesh, MeshError, Placement, Remark, Repairs, Size, Soup, read_stl, stl};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A prism over a polygon that is star-shaped about the origin: vertices and outward triangles.
fn prism(radii: &[f64], height: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let count = radii.len() as u32;
    let rim = |z: f64| {
        let step = TAU / f64::from(count);
        radii
            .iter()
            .enumerate()
            .map(move |(k, r)| [r * (step * k as f64).cos(), r * (step * k as f64).sin(), z])
    };
    let vertices = rim(0.0).chain(rim(height)).chain([[0.0, 0.0, 0.0], [0.0, 0.0, height]]).collect();
    let triangles = (0..count)
        .flat_map(|k| {
            let next = (k + 1) % count;
            let (above, above_next) = (count + k, count + next);
            [
                [k, next, above],
                [next, above_next, above],
                [2 * count, next, k],
                [2 * count + 1, above, above_next],
            ]
        })
        .collect();
    (vertices, triangles)
}

fn binary_stl(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<u8> {
    let facets: Vec<stl_io::Triangle> = triangles
        .iter()
        .map(|corners| stl_io::Triangle {
            normal: stl_io::Normal::new([0.0; 3]),
            vertices: corners.map(|k| stl_io::Vertex::new(vertices[k as usize].map(|value| value as f32))),
        })
        .collect();
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, facets.iter()).expect("writing to memory does not fail");
    bytes
}

fn text_stl(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> String {
    let mut text = String::from("solid part\n");
    for corners in triangles {
        text += "facet normal 0 0 0\n outer loop\n";
        for &corner in corners {
            let [x, y, z] = vertices[corner as usize].map(|value| value as f32);
            text += &format!("  vertex {x} {y} {z}\n");
        }
        text += " endloop\nendfacet\n";
    }
    text + "endsolid part\n"
}

fn radii() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(2.0..9.0_f64, 3..20)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_round_trip_through_stl_keeps_the_mesh(radii in radii(), height in 1.0..20.0_f64) {
        let (vertices, triangles) = prism(&radii, height);
        let mesh = Mesh::new(vertices.clone(), triangles.clone()).unwrap();
        let binary = read_stl(&binary_stl(&vertices, &triangles)).unwrap();
        prop_assert_eq!(binary.vertices().len(), vertices.len());
        prop_assert_eq!(binary.triangles().len(), triangles.len());
        let volume = mesh.signed_volume();
        prop_assert!((binary.signed_volume() - volume).abs() < 1e-4 * volume);
        // Text holds the shortest decimals that name the same single-precision numbers.
        let text = read_stl(text_stl(&vertices, &triangles).as_bytes()).unwrap();
        prop_assert_eq!(text.triangles(), binary.triangles());
        for (a, b) in text.vertices().iter().zip(binary.vertices()) {
            prop_assert_eq!(a.map(|value| value as f32), b.map(|value| value as f32));
        }
        let again = binary_stl(binary.vertices(), binary.triangles());
        prop_assert_eq!(&binary, &read_stl(&again).unwrap());
    }

    #[test]
    fn every_edge_of_a_welded_closed_mesh_has_two_triangles(
        radii in radii(),
        jitter in prop::collection::vec(-2e-7..2e-7_f64, 16),
    ) {
        // Every triangle with its own corners, each a little off.
        let (vertices, triangles) = prism(&radii, 5.0);
        let corners = triangles.iter().flatten().enumerate();
        let soup: Vec<[f64; 3]> = corners
            .map(|(k, &v)| { let mut p = vertices[v as usize]; p[k % 3] += jitter[k % 16]; p })
            .collect();
        let loose = (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let mesh = Mesh::new(soup, loose).unwrap();
        prop_assert_eq!(mesh.vertices().len(), vertices.len());
        let edges = mesh.edges();
        let mut met = vec![0; edges.ends().len()];
        edges.of_triangles().iter().flatten().for_each(|&edge| met[edge as usize] += 1);
        prop_assert!(met.iter().all(|&count| count == 2));
    }

    #[test]
    fn orienting_undoes_any_turned_triangles(radii in radii(), turned in prop::collection::vec(any::<bool>(), 80)) {
        let (vertices, triangles) = prism(&radii, 5.0);
        let volume = Mesh::new(vertices.clone(), triangles.clone()).unwrap().signed_volume();
        let mut mixed = triangles;
        for (triangle, _) in mixed.iter_mut().zip(turned).filter(|(_, turned)| *turned) {
            triangle.swap(0, 1);
        }
        let mesh = Mesh::new(vertices, mixed).unwrap().oriented();
        prop_assert!((mesh.signed_volume() - volume).abs() < 1e-9 * volume);
        prop_assert_eq!(&mesh.oriented(), &mesh);
    }

    #[test]
    fn a_placed_mesh_stands_on_the_bed_at_its_size(
        radii in radii(), height in 0.1..20.0_f64, to in 0.1..500.0_f64, factor in 0.01..100.0_f64, lift in -9.0..9.0_f64,
    ) {
        let (mut vertices, triangles) = prism(&radii, height);
        vertices.iter_mut().for_each(|v| v[2] += lift);
        let mesh = Mesh::new(vertices, triangles).unwrap();
        let tall = mesh.placed(&Placement { size: Size::Height(to), ground: Ground::Centre }).unwrap();
        prop_assert_eq!((tall.bounds().min[2], tall.bounds().max[2]), (0.0, to));
        let [x, y, _] = tall.bounds().centre();
        prop_assert!(x.abs() < 1e-9 * to * 500.0 && y.abs() < 1e-9 * to * 500.0);
        let bed = mesh.placed(&Placement { size: Size::Height(to), ground: Ground::At([75.0, -40.0]) }).unwrap();
        for (there, here) in bed.vertices().iter().zip(tall.vertices()) {
            prop_assert!((there[0] - here[0] - 75.0).abs() < 1e-9 && (there[1] - here[1] + 40.0).abs() < 1e-9);
            prop_assert_eq!(there[2], here[2]);
        }
        let scaled = mesh.placed(&Placement { size: Size::Scale(factor), ground: Ground::Keep }).unwrap();
        for (after, before) in scaled.vertices().iter().zip(mesh.vertices()) {
            prop_assert!((after[0] - factor * before[0]).abs() <= 1e-12 * factor * 100.0);
        }
        let volume = mesh.signed_volume() * factor.powi(3);
        prop_assert!((scaled.signed_volume() - volume).abs() < 1e-6 * volume);
    }

    #[test]
    fn bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = read_stl(&bytes);
    }

    #[test]
    fn words_never_panic(words in prop::collection::vec(prop::sample::select(vec![
        "solid", "endsolid", "facet", "normal", "outer", "loop", "vertex", "endloop", "endfacet", "0", "1", "-2e3", "nan", "inf", "\n", "ü",
    ]), 0..60)) {
        let _ = read_stl(("solid ".to_owned() + &words.join(" ")).as_bytes());
    }
}

#[test]
fn no_proper_prefix_is_taken_for_the_file() {
    let (vertices, triangles) = prism(&[3.0, 4.0, 5.0, 4.0], 2.0);
    let binary = binary_stl(&vertices, &triangles);
    assert!(read_stl(&binary).is_ok());
    for length in 0..binary.len() {
        assert!(read_stl(&binary[..length]).is_err(), "binary, {length} bytes");
    }
    let text = text_stl(&vertices, &triangles);
    for length in 0..text.find("endsolid").unwrap() + "endsolid".len() {
        assert!(read_stl(&text.as_bytes()[..length]).is_err(), "text, {length} bytes");
    }
}

#[test]
fn a_binary_body_whose_length_disagrees_says_so() {
    let (vertices, triangles) = prism(&[3.0, 4.0, 5.0], 2.0);
    let mut bytes = binary_stl(&vertices, &triangles);
    let declared = triangles.len() as u64;
    assert_eq!(
        read_stl(&bytes[..bytes.len() - 60]),
        Err(MeshError::Truncated { declared, present: declared - 2, extra: 40 }),
    );
    bytes.extend([0; 3]);
    assert_eq!(read_stl(&bytes), Err(MeshError::Truncated { declared, present: declared, extra: 3 }));
}

#[test]
fn a_binary_body_under_a_solid_header_is_read() {
    let (vertices, triangles) = prism(&[3.0, 4.0, 5.0], 2.0);
    let mut bytes = binary_stl(&vertices, &triangles);
    bytes[..14].copy_from_slice(b"solid exported");
    assert_eq!(read_stl(&bytes).unwrap().triangles().len(), triangles.len());
}

#[test]
fn several_solids_in_one_text_are_one_mesh() {
    let (vertices, triangles) = prism(&[3.0, 4.0, 5.0], 2.0);
    let text = text_stl(&vertices, &triangles);
    let moved: Vec<[f64; 3]> = vertices.iter().map(|v| [v[0] + 50.0, v[1], v[2]]).collect();
    let both = text + &text_stl(&moved, &triangles);
    assert_eq!(read_stl(both.as_bytes()).unwrap().triangles().len(), 2 * triangles.len());
}

#[test]
fn normals_that_are_no_numbers_do_not_matter_but_corners_do() {
    let facet = |normal: &str, x: &str| {
        format!(
            "solid a\nfacet normal {normal}\nouter loop\nvertex {x} 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a"
        )
    };
    assert!(read_stl(facet("nan nan nan", "0").as_bytes()).is_ok());
    assert_eq!(read_stl(facet("0 0 1", "nan").as_bytes()), Err(MeshError::NotFinite { triangle: 0 }));
    assert_eq!(read_stl(facet("0 0 1", "-inf").as_bytes()), Err(MeshError::NotFinite { triangle: 0 }));
    assert_eq!(read_stl(facet("0 0 1", "1").as_bytes()), Err(MeshError::NoTriangles));
}

#[test]
fn what_is_missing_is_named() {
    assert_eq!(read_stl(b""), Err(MeshError::Empty));
    assert_eq!(read_stl(&[0; 84]), Err(MeshError::NoTriangles));
    assert!(matches!(read_stl(b"ply\nformat ascii 1.0\n"), Err(MeshError::Unreadable { line: 0, .. })));
    assert!(matches!(
        read_stl(b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nendloop"),
        Err(MeshError::Unreadable { line: 5, .. })
    ));
    assert_eq!(
        Mesh::new(vec![[0.0; 3]], vec![[0, 0, 7]]),
        Err(MeshError::NoSuchVertex { triangle: 0, vertex: 7 })
    );
}

#[test]
fn sizes_that_are_no_sizes_are_refused() {
    let (vertices, triangles) = prism(&[3.0, 4.0, 5.0], 2.0);
    let mesh = Mesh::new(vertices, triangles).unwrap();
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(mesh.placed(&Placement { size: Size::Scale(factor), ..Placement::default() }).is_err());
        assert!(mesh.placed(&Placement { size: Size::Height(factor), ..Placement::default() }).is_err());
        assert!(mesh.stretched([1.0, factor, 1.0]).is_err());
    }
    let huge = Placement { size: Size::Scale(1e300), ..Placement::default() };
    assert!(matches!(mesh.placed(&huge), Err(MeshError::NotFinite { .. })));
    let flat = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap();
    let tall = Placement { size: Size::Height(5.0), ..Placement::default() };
    assert_eq!(flat.placed(&tall), Err(MeshError::Height { from: 0.0, to: 5.0 }));
}

fn flipped(mut soup: Soup) -> Soup {
    soup.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
    soup
}

fn both(mut soup: Soup, other: Soup) -> Soup {
    let first = soup.vertices.len() as u32;
    soup.vertices.extend(other.vertices);
    soup.triangles.extend(other.triangles.iter().map(|corners| corners.map(|k| k + first)));
    soup
}

/// Defects by their names, with their counts.
fn defects(repairs: &Repairs) -> Vec<(&'static str, usize)> {
    repairs.listed().iter().filter(|(_, p)| p.count > 0).map(|(name, p)| (*name, p.count)).collect()
}

#[test]
fn a_sound_mesh_is_left_as_it_is() {
    let soup = both(Soup::cuboid([0.0; 3], [9.0; 3]), Soup::cuboid([20.0, 0.0, 0.0], [29.0, 9.0, 9.0]));
    let (mesh, repairs) = soup.clone().repaired().unwrap();
    assert_eq!(mesh.triangles(), soup.triangles);
    assert_eq!((defects(&repairs), repairs.shells, repairs.worst()), (vec![], 2, None));
    assert_eq!(repairs.to_string(), "");
}

#[test]
fn every_defect_is_counted_with_its_place() {
    let whole = || Soup::cuboid([0.0; 3], [9.0; 3]);
    let seen = |soup: Soup| soup.repaired().unwrap().1;

    let mut soup = whole();
    soup.triangles.remove(4);
    let repairs = seen(soup);
    assert_eq!(defects(&repairs), [("open edges", 3)]);
    assert!(repairs.open_edges.first.contains(&[4.5, 0.0, 0.0]), "{repairs:?}");
    assert_eq!(repairs.worst().unwrap().0, "open edges");

    let mut soup = whole();
    soup.triangles[6].swap(1, 2);
    let repairs = seen(soup);
    assert_eq!(defects(&repairs), [("triangles turned over", 1)]);
    assert_eq!(repairs.turned_triangles.first, [[3.0, 9.0, 3.0]]);

    let mut soup = whole();
    soup.triangles.push([3, 5, 1]);
    soup.triangles.push([2, 2, 3]);
    let repairs = seen(soup);
    assert_eq!(
        defects(&repairs),
        [("triangles without area dropped", 1), ("duplicate triangles dropped", 1)]
    );
    assert_eq!(repairs.duplicates.first, [[9.0, 3.0, 3.0]]);

    let repairs = seen(flipped(whole()));
    assert_eq!(defects(&repairs), [("shells turned over", 1)]);
    assert!(repairs.to_string().starts_with("1 shells turned over, the first at ("));

    let beside = Soup::cuboid([9.0, 0.0, 0.0], [18.0, 9.0, 9.0]);
    let repairs = seen(both(whole(), beside));
    assert_eq!(
        (defects(&repairs), repairs.shells),
        (vec![("duplicate triangles dropped", 2), ("faces between bodies dropped", 2)], 1)
    );

    // Two boxes that touch in an edge only.
    let diagonal = Soup::cuboid([9.0, 9.0, 0.0], [18.0, 18.0, 9.0]);
    let repairs = seen(both(whole(), diagonal));
    assert_eq!((defects(&repairs), repairs.shells), (vec![("edges with more than two triangles", 1)], 2));
    assert_eq!(repairs.crowded_edges.first, [[9.0, 9.0, 4.5]]);

    let mut soup = whole();
    soup.vertices.push([1e-6, 0.0, 0.0]);
    soup.triangles[0][0] = 8;
    let repairs = seen(soup);
    assert_eq!((defects(&repairs), repairs.welded), (vec![], 1));
}

#[test]
fn places_are_the_first_few() {
    let mut soup = Soup::cuboid([0.0; 3], [9.0; 3]);
    soup.triangles = soup.triangles.repeat(2);
    let (_, repairs) = soup.repaired().unwrap();
    assert_eq!((repairs.duplicates.count, repairs.duplicates.first.len()), (12, 8));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn flipping_whole_bodies_and_single_triangles_changes_no_volume(
        radii in radii(),
        // The first body has its axis at x = 0.
        at in [0.5..30.0_f64, -30.0..30.0, -10.0..10.0],
        turned in prop::collection::vec(any::<bool>(), 80),
        flips: [bool; 2],
    ) {
        // Two bodies, which may overlap but of which none holds the other, and a cavity in the first one.
        let (vertices, triangles) = prism(&radii, 5.0);
        let first = Soup { vertices: vertices.clone(), triangles: triangles.clone(), ..Soup::default() };
        let small: Vec<[f64; 3]> = vertices.iter().map(|v| [0.5 * v[0], 0.5 * v[1], 0.5 * v[2] + 1.25]).collect();
        let cavity = flipped(Soup { vertices: small, triangles: triangles.clone(), ..Soup::default() });
        let other = Soup::cuboid(at, [at[0] + 15.0, at[1] + 15.0, at[2] + 10.0]);
        let sound = both(both(first, cavity), other);
        let count = triangles.len();
        let mut broken = sound.clone();
        for (k, corners) in broken.triangles.iter_mut().enumerate() {
            // The body with its cavity is flipped as one. Few triangles are turned, so that most of each patch stays.
            let is_turned = turned[k % 80] && k % 7 == 0;
            if flips[usize::from(k >= 2 * count)] != is_turned {
                corners.swap(0, 2);
            }
        }
        let area_kept = broken.repaired().unwrap().0;
        let plain = sound.repaired().unwrap().0;
        prop_assert!((area_kept.signed_volume() - plain.signed_volume()).abs() < 1e-6 * plain.signed_volume());
        prop_assert!(plain.signed_volume() > 0.0);
        prop_assert_eq!(&area_kept.oriented(), &area_kept);
    }

    #[test]
    fn any_triangles_are_repaired_to_a_mesh_that_stays_as_it_is(
        points in prop::collection::vec([0_u8..4, 0_u8..4, 0_u8..4], 3..12),
        corners in prop::collection::vec([0_u32..12, 0_u32..12, 0_u32..12], 1..40),
    ) {
        let count = points.len() as u32;
        let soup = Soup {
            vertices: points.into_iter().map(|p| p.map(f64::from)).collect(),
            triangles: corners.into_iter().map(|corners| corners.map(|k| k % count)).collect(),
            ..Soup::default()
        };
        let Ok((mesh, repairs)) = soup.clone().repaired() else { return Ok(()) };
        let dropped = repairs.degenerate.count + repairs.duplicates.count + repairs.inner_faces.count;
        prop_assert_eq!(mesh.triangles().len() + dropped, soup.triangles.len());
        prop_assert_eq!(&mesh.oriented(), &mesh);
        let again = Soup { vertices: mesh.vertices().to_vec(), triangles: mesh.triangles().to_vec(), ..Soup::default() };
        let (same, after) = again.repaired().unwrap();
        let mut sets: Vec<[u32; 3]> = mesh.triangles().to_vec();
        sets.iter_mut().for_each(|set| set.sort_unstable());
        sets.sort_unstable();
        // Whether a face that two bodies have in common stays depends on what is around, which the first repair has changed.
        if sets.windows(2).any(|pair| pair[0] == pair[1]) {
            return Ok(());
        }
        prop_assert_eq!(&same, &mesh);
        prop_assert_eq!(after.turned_triangles.count + after.turned_shells.count, 0);
    }
}

#[test]
fn text_may_have_any_line_ends() {
    let (vertices, triangles) = prism(&[3.0, 4.0, 5.0], 2.0);
    let text = text_stl(&vertices, &triangles);
    let mesh = read_stl(text.as_bytes()).unwrap();
    for end in ["\r", "\r\n", "\n\r"] {
        assert_eq!(read_stl(text.replace('\n', end).as_bytes()).as_ref(), Ok(&mesh), "{end:?}");
    }
    let broken = text.replace("endloop", "endlop");
    let line = |text: &str| match read_stl(text.as_bytes()) {
        Err(MeshError::Unreadable { line, .. }) => line,
        other => panic!("{other:?}"),
    };
    for end in ["\r", "\r\n"] {
        assert_eq!(line(&broken.replace('\n', end)), line(&broken));
    }
}

#[test]
fn a_count_that_is_too_low_or_unknown_is_told_and_all_is_read() {
    let (vertices, triangles) = prism(&[3.0, 4.0, 5.0], 2.0);
    let mut bytes = binary_stl(&vertices, &triangles);
    let present = triangles.len() as u64;
    for declared in [0, 3, u32::MAX] {
        bytes[80..84].copy_from_slice(&declared.to_le_bytes());
        let soup = stl(&bytes).unwrap();
        assert_eq!(soup.triangles.len() as u64, present);
        assert_eq!(soup.remarks, [Remark::Count { declared: declared.into(), present }]);
    }
    bytes[80..84].copy_from_slice(&(present as u32 + 1).to_le_bytes());
    assert_eq!(stl(&bytes), Err(MeshError::Truncated { declared: present + 1, present, extra: 0 }));
}
