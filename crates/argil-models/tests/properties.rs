//! Every mesh is closed, faces outwards, stands on the bed, and is what its name says.
#![allow(clippy::unwrap_used)]

use argil_models::{Bounds, DVec3, Field, ModelError, by_name, mesh_of, names};
use proptest::prelude::*;

/// Bodies from balls and rods, some of which reach out of the box of ± 10 mm.
fn bodies() -> impl Strategy<Value = Field> {
    let point = (-11.0..11.0f64, -11.0..11.0f64, -11.0..11.0f64).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let part = (point.clone(), point, 0.3..5.0f64, 0.3..5.0f64, 0..3usize);
    prop::collection::vec(part, 1..7).prop_map(|parts| {
        parts.into_iter().fold(Field::empty(), |body, (a, b, r, s, how)| match how {
            0 => body.union(Field::rod((a, r), (b, s))),
            1 => body.blended(Field::sphere(a, r), 1.0),
            _ => body.without(Field::torus(a, b, r + s, s)),
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_the_body_its_mesh_is_closed_and_outward(body in bodies(), cell in 0.7..2.5f64) {
        let room = Bounds { min: DVec3::splat(-10.0), max: DVec3::splat(10.0) };
        let solid = mesh_of(&body, room, cell).unwrap();
        prop_assert!(solid.is_closed());
        prop_assert!(solid.volume() >= 0.0);
        prop_assert_eq!(solid.euler_characteristic() % 2, 0);
        for vertex in &solid.vertices {
            prop_assert!(vertex.iter().all(|&v| (-10.0..=10.0 + cell).contains(&v)));
        }
        for &[a, b, c] in &solid.triangles {
            let [a, b, c] = [a, b, c].map(|k| DVec3::from(solid.vertices[k as usize]));
            prop_assert!((b - a).cross(c - a).length() > 0.0);
        }
    }

    #[test]
    fn no_two_vertices_share_a_place_in_single_precision(body in bodies()) {
        let room = Bounds { min: DVec3::splat(-10.0), max: DVec3::splat(10.0) };
        let solid = mesh_of(&body, room, 1.0).unwrap();
        let mut places: Vec<[u32; 3]> =
            solid.vertices.iter().map(|vertex| vertex.map(|v| (v as f32).to_bits())).collect();
        let count = places.len();
        places.sort_unstable();
        places.dedup();
        prop_assert_eq!(places.len(), count);
    }

    #[test]
    fn a_ball_has_the_volume_of_a_ball(radius in 3.0..9.0f64, x in -0.5..0.5f64, y in -0.5..0.5f64) {
        let room = Bounds { min: DVec3::splat(-10.0), max: DVec3::splat(10.0) };
        let solid = mesh_of(&Field::sphere(DVec3::new(x, y, 0.3), radius), room, 0.6).unwrap();
        let exact = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
        prop_assert!((solid.volume() / exact - 1.0).abs() < 0.03);
        prop_assert_eq!(solid.euler_characteristic(), 2);
    }
}

#[test]
fn every_model_is_closed_stands_flat_and_has_its_genus() {
    let expected = [
        ("spire", 2, 36.0..41.0),
        ("table", 2, 29.0..30.0),
        ("cup", 0, 30.5..32.5),
        ("columns", 4, 30.0..32.0),
        ("arch", 2, 33.0..35.0),
        ("nested-rings", 2, 25.0..26.0),
        ("hanging-island", 2, 33.0..36.0),
        ("cactus", 2, 32.0..34.0),
    ];
    assert_eq!(names().collect::<Vec<_>>(), expected.iter().map(|entry| entry.0).collect::<Vec<_>>());
    for (name, euler, height) in expected {
        let solid = by_name(name).unwrap();
        assert!(solid.is_closed(), "{name}");
        assert_eq!(solid.lowest(), Some(0.0), "{name}");
        assert_eq!(solid.euler_characteristic(), euler, "{name}");
        assert!(solid.volume() > 1000.0, "{name}");
        assert!(solid.triangles.len() < 65_000, "{name}: {}", solid.triangles.len());
        let top = solid.vertices.iter().map(|vertex| vertex[2]).fold(0.0, f64::max);
        assert!(height.contains(&top), "{name}: {top}");
        let foot = solid.triangles.iter().filter(|t| t.iter().all(|&k| solid.vertices[k as usize][2] == 0.0));
        assert!(foot.count() > 40, "{name} has no flat foot");
    }
}

#[test]
fn the_same_model_is_the_same_bytes() {
    for name in ["spire", "nested-rings"] {
        assert!(by_name(name).unwrap().to_stl() == by_name(name).unwrap().to_stl());
    }
}

#[test]
fn a_body_that_fills_the_box_is_the_box() {
    let room = Bounds { min: DVec3::ZERO, max: DVec3::new(2.0, 3.0, 4.0) };
    let solid = mesh_of(&Field::sphere(DVec3::ZERO, 100.0), room, 1.0).unwrap();
    assert!(solid.is_closed());
    assert!((solid.volume() - 24.0).abs() < 1e-12);
    assert_eq!(solid.euler_characteristic(), 2);
    let nothing = mesh_of(&Field::empty(), room, 1.0).unwrap();
    assert!(nothing.vertices.is_empty() && nothing.lowest().is_none() && nothing.volume() == 0.0);
    let torn = Field::new(|p| if p.x < 1.5 { f64::NEG_INFINITY } else { f64::NAN });
    assert!(mesh_of(&torn, room, 1.0).unwrap().is_closed());
}

#[test]
fn grids_that_cannot_be_are_refused() {
    let room = Bounds { min: DVec3::ZERO, max: DVec3::ONE };
    let ball = Field::sphere(DVec3::ZERO, 1.0);
    for cell in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-6] {
        assert!(matches!(mesh_of(&ball, room, cell), Err(ModelError::Cell { .. })), "{cell}");
    }
    for max in [DVec3::ZERO, DVec3::splat(f64::NAN), DVec3::splat(f64::INFINITY), DVec3::new(1.0, -1.0, 1.0)]
    {
        let room = Bounds { min: DVec3::ZERO, max };
        assert!(matches!(mesh_of(&ball, room, 1.0), Err(ModelError::NoSpace { .. })), "{max}");
    }
}
