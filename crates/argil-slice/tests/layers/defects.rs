//! Bodies that overlap, are inside out, torn or twice there: what is cut, and what is told.

use crate::body::{Body, star};
use crate::soundness::{area, check, settings};
use argil_slice::mesh::Mesh;
use argil_slice::{Layer, Loss, slice};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

proptest! {
    // Always the same bodies, so that the gate says the same twice.
    #![proptest_config(ProptestConfig { cases: 40, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn overlapping_bodies_are_one(
        a in [-9.0..0.0_f64, -9.0..0.0], b in [-5.0..9.0_f64, -5.0..9.0], size in [3.0..9.0_f64, 3.0..9.0], inverted: bool,
    ) {
        let cuboid = |at: [f64; 2]| Body::cuboid([at[0], at[1], 0.0], [at[0] + size[0], at[1] + size[1], 1.5]);
        let both = cuboid(a).and(cuboid(b));
        let both = if inverted { both.inverted() } else { both };
        let shared: f64 = (0..2).map(|axis| (size[axis] - (a[axis] - b[axis]).abs()).max(0.0)).product();
        for layer in slice(&both.mesh(), &settings(1)).unwrap() {
            check(&layer, &settings(1))?;
            prop_assert!((area(&layer) - (2.0 * size[0] * size[1] - shared)).abs() < 1e-3);
        }
    }

    #[test]
    fn turned_triangles_and_an_inside_out_mesh_change_nothing(radii in star(), turned in prop::collection::vec(any::<bool>(), 120)) {
        let body = Body::prism(&radii, [0.0; 2], [0.0, 1.0], 0.8);
        let mut mixed = body.clone().inverted();
        for (corners, _) in mixed.triangles.iter_mut().zip(turned).filter(|(_, turned)| *turned) {
            corners.swap(1, 2);
        }
        let plain = slice(&body.mesh(), &settings(1)).unwrap();
        for (layer, other) in plain.iter().zip(&slice(&mixed.mesh(), &settings(1)).unwrap()) {
            prop_assert!((area(layer) - area(other)).abs() < 1e-6);
            prop_assert_eq!(layer.walls.len(), other.walls.len());
            prop_assert_eq!(&layer.losses.len(), &other.losses.len());
        }
    }

    #[test]
    fn a_hole_in_the_mesh_is_closed_and_reported_or_its_outline_is_reported_as_open(radii in star(), missing: prop::sample::Index) {
        let mut body = Body::prism(&radii, [0.0; 2], [0.0, 2.0], 1.0);
        let whole = slice(&body.mesh(), &settings(1)).unwrap();
        let missing = missing.index(body.triangles.len());
        body.triangles.remove(missing);
        let is_side = missing % 4 < 2;
        for (layer, sound) in slice(&body.mesh(), &settings(1)).unwrap().iter().zip(&whole) {
            check(layer, &settings(1))?;
            let open = layer.losses.iter().any(|loss| matches!(loss, Loss::OpenOutline { .. }));
            // The sides are plane, so that a straight line across a missing triangle is where the side was.
            prop_assert!(open || (area(layer) - area(sound)).abs() < 1e-6);
            prop_assert!(!open || area(layer) < 1e-6);
            let is_told = layer.losses.iter().any(|loss| matches!(loss, Loss::ClosedGap { .. }));
            prop_assert_eq!(open || is_told, is_side);
        }
    }

    #[test]
    fn loose_triangles_never_break_it(
        points in prop::collection::vec([-9.0..9.0_f64, -9.0..9.0, 0.0..4.0], 9..60),
        on_planes: bool,
        scale in prop::sample::select(vec![1e-3, 1.0, 1e3]),
        far in prop::sample::select(vec![0.0, 1e3, 1e7]),
    ) {
        let place = |p: [f64; 3]| if on_planes { p.map(|v| (4.0 * v).round() / 4.0) } else { p };
        let vertices: Vec<[f64; 3]> =
            points.into_iter().map(place).map(|[x, y, z]| [x * scale + far, y * scale + far, z]).collect();
        let count = vertices.len() as u32;
        let triangles = (0..count - 2).map(|k| [k, k + 1, k + 2]).collect();
        let Ok(mesh) = Mesh::new(vertices, triangles) else { return Ok(()) };
        if let Ok(layers) = slice(&mesh, &settings(2)) {
            for layer in &layers {
                check(layer, &settings(2))?;
            }
            prop_assert_eq!(&layers, &slice(&mesh, &settings(2)).unwrap());
        }
    }
}

/// A box with a flipped box of the same size that overlaps it, nested in it, or beside it.
fn with_flipped(at: [f64; 3], size: f64) -> Vec<Layer> {
    let high = at.map(|low| low + size);
    let body = Body::cuboid([0.0; 3], [20.0; 3]).and(Body::cuboid(at, high).inverted());
    slice(&body.mesh(), &settings(1)).expect("boxes are sliced")
}

#[test]
fn a_flipped_body_that_overlaps_another_cuts_no_hole() {
    let overlapping = with_flipped([10.0, 10.0, 0.0], 20.0);
    assert!(overlapping.iter().all(|layer| (area(layer) - 700.0).abs() < 1e-3));
    let beside = with_flipped([30.0, 0.0, 0.0], 20.0);
    assert!(beside.iter().all(|layer| (area(layer) - 800.0).abs() < 1e-3));
    // Inside, it is a cavity, also where it touches the outside from within.
    for low in [4.0, 0.0] {
        let nested = with_flipped([4.0, 4.0, low], 8.0);
        let middle = &nested[((low + 4.0) / 0.5) as usize];
        assert!((area(middle) - 336.0).abs() < 1e-3, "{}", area(middle));
    }
}

#[test]
fn a_body_of_two_shells_that_is_inside_out_keeps_its_cavity() {
    let body = Body::cuboid([0.0; 3], [20.0; 3]).inverted().and(Body::cuboid([4.0; 3], [16.0; 3]));
    let layers = slice(&body.mesh(), &settings(1)).unwrap();
    assert!((area(&layers[20]) - 256.0).abs() < 1e-3);
}

#[test]
fn faces_that_are_there_twice_leave_nothing_open() {
    let whole = Body::cuboid([0.0; 3], [20.0; 3]);
    let plain = slice(&whole.mesh(), &settings(1)).unwrap();
    for again in [0..3, 4..12, 0..12] {
        let mut body = whole.clone();
        body.triangles.extend(whole.triangles[again.clone()].iter().map(|&[a, b, c]| [b, c, a]));
        assert_eq!(slice(&body.mesh(), &settings(1)).unwrap(), plain);
        // For both sides, as some programs write them.
        let mut body = whole.clone();
        body.triangles.extend(whole.triangles[again].iter().map(|&[a, b, c]| [a, c, b]));
        assert_eq!(slice(&body.mesh(), &settings(1)).unwrap(), plain);
    }
}

#[test]
fn bodies_that_share_a_face_are_one() {
    let left = Body::cuboid([0.0; 3], [10.0, 10.0, 3.0]);
    let layers =
        slice(&left.and(Body::cuboid([10.0, 0.0, 0.0], [20.0, 10.0, 3.0])).mesh(), &settings(1)).unwrap();
    for layer in &layers {
        assert!(layer.losses.is_empty() && layer.outline.0.len() == 1);
        assert!((area(layer) - 200.0).abs() < 1e-6);
    }
}

#[test]
fn an_open_handle_pushed_into_a_body_is_part_of_it() {
    // Its two sides towards the body are missing, 8 mm wide: the gap lies in the solid.
    let mut handle = Body::cuboid([9.0, 2.0, 0.0], [14.0, 10.0, 3.0]);
    handle.triangles.retain(|corners| !corners.iter().all(|&k| k % 2 == 0));
    assert_eq!(handle.triangles.len(), 10);
    let body = Body::cuboid([0.0; 3], [12.0, 12.0, 3.0]).and(handle);
    for layer in &slice(&body.mesh(), &settings(1)).unwrap() {
        assert!((area(layer) - (144.0 + 16.0)).abs() < 1e-3);
        assert!(
            matches!(layer.losses[..], [Loss::ClosedGap { gap, .. }, Loss::Overlap { .. }] if (gap - 8.0).abs() < 1e-9)
        );
    }
}

#[test]
fn sheets_are_never_left_out_without_a_word() {
    let fin = |x: [f64; 2]| Body {
        vertices: vec![[x[0], 5.0, 0.0], [x[1], 5.0, 0.0], [x[1], 5.0, 3.0], [x[0], 5.0, 3.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    let losses = |body: Body| {
        let layers = slice(&body.mesh(), &settings(1)).unwrap();
        assert!(layers.iter().all(|layer| (area(layer) - 100.0).abs() < 1e-3));
        layers.into_iter().flat_map(|layer| layer.losses).collect::<Vec<_>>()
    };
    let block = || Body::cuboid([0.0; 3], [10.0, 10.0, 3.0]);
    let outside = losses(block().and(fin([8.0, 16.0])));
    assert!(outside.len() == 6 && outside.iter().all(|loss| matches!(loss, Loss::OpenOutline { .. })));
    let inside = losses(block().and(fin([2.0, 8.0])));
    assert!(inside.len() == 6 && inside.iter().all(|loss| matches!(loss, Loss::Stray { .. })));
    // Both sides, cut into triangles differently, so that no triangle is there twice.
    let mut back = fin([8.0, 16.0]);
    back.triangles = vec![[0, 3, 1], [1, 3, 2]];
    let both = losses(block().and(fin([8.0, 16.0])).and(back));
    assert!(
        both.len() == 6 && both.iter().all(|loss| matches!(loss, Loss::Vanished { area: 0.0, .. })),
        "{both:?}"
    );
}

#[test]
fn bodies_with_a_side_in_common_overlap_as_others_do() {
    // Both have the side at x = 10, with the same triangles, wound alike.
    let short = Body::cuboid([0.0; 3], [10.0, 10.0, 3.0]);
    let long = Body::cuboid([-5.0, 0.0, 0.0], [10.0, 10.0, 3.0]);
    for layer in &slice(&short.and(long).mesh(), &settings(1)).unwrap() {
        assert!((area(layer) - 150.0).abs() < 1e-6);
        assert!(
            matches!(layer.losses[..], [Loss::Overlap { area, .. }] if (area - 100.0).abs() < 1e-6),
            "{:?}",
            layer.losses
        );
    }
}
