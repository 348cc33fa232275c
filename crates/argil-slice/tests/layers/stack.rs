//! Contours of layers made a mesh, and cut again.

use crate::body::{Body, star};
use crate::soundness::{distance_to, polygon};
use argil_slice::{Loss, SliceError, SliceSettings, slice, stacked};
use geo::Contains;
use geo_types::Point;
use glam::DVec2;
use proptest::prelude::*;

/// Contours of random layers: rings about several centres, which overlap as they like and run either way.
fn contours() -> impl Strategy<Value = Vec<Vec<Vec<DVec2>>>> {
    let ring = (star(), [-15.0..15.0_f64, -15.0..15.0], any::<bool>()).prop_map(|(radii, at, turned)| {
        let mut points: Vec<DVec2> =
            Body::ring(&radii, at, 0.0).into_iter().map(|[x, y, _]| DVec2::new(x, y)).collect();
        if turned {
            points.reverse();
        }
        points
    });
    prop::collection::vec(prop::collection::vec(ring, 1..5), 1..6)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn stacked_layers_are_cut_into_themselves(layers in contours(), height in 0.2..2.0_f64) {
        let settings = SliceSettings { layer_height: height, width: 1.5, ..SliceSettings::default() };
        let mesh = stacked(&layers, height).unwrap();
        let cut = slice(&mesh, &settings).unwrap();
        prop_assert_eq!(cut.len(), layers.len());
        for (layer, contours) in cut.iter().zip(&layers) {
            let is_gap = |loss: &Loss| matches!(loss, Loss::OpenOutline { .. } | Loss::ClosedGap { .. });
            prop_assert!(!layer.losses.iter().any(is_gap));
            // Where a point lies inside an odd number of contours there is solid, but for rounding at the contours.
            let sides: Vec<(DVec2, DVec2)> = contours
                .iter()
                .flat_map(|ring| (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()])))
                .collect();
            for p in (0..900).map(|k| DVec2::new(f64::from(k % 30) * 1.8 - 27.0, f64::from(k / 30) * 1.8 - 27.0)) {
                if sides.iter().all(|&side| distance_to(p, side) > 1e-3) {
                    let at = Point::new(p.x, p.y);
                    let around = contours.iter().filter(|ring| polygon(ring).contains(&at)).count();
                    prop_assert_eq!(layer.outline.contains(&at), around % 2 == 1, "{}", p);
                }
            }
        }
    }
}

#[test]
fn layers_that_enclose_nothing_are_no_mesh() {
    let p = DVec2::new;
    assert_eq!(stacked(&[], 0.5).unwrap_err(), SliceError::NoContours);
    assert_eq!(stacked(&[vec![vec![p(0.0, 0.0), p(1.0, 0.0)]]], 0.5).unwrap_err(), SliceError::NoContours);
    let far = vec![p(0.0, 0.0), p(f64::NAN, 0.0), p(0.0, 1.0)];
    assert!(matches!(
        stacked(&[vec![], vec![far]], 0.5),
        Err(SliceError::Contour { layer: 1, contour: 0, .. })
    ));
    assert!(matches!(stacked(&[], f64::NAN), Err(SliceError::Setting { setting: "layer_height", .. })));
}

/// Without the vertices that change nothing the corner on the left would cross itself, and the kernel lose the hole.
#[test]
fn a_hole_with_a_blunt_corner_has_a_wall() {
    let ring = |points: &[[f64; 2]]| points.iter().copied().map(DVec2::from).collect::<Vec<_>>();
    let hole = ring(&[
        [0.5449, 1.6449],
        [0.548, 1.6486],
        [0.5491, 1.65],
        [0.55, 1.6506],
        [0.5513, 1.6513],
        [0.85, 1.8231],
        [2.1098, 2.1098],
        [1.65, 1.0868],
        [1.1, 1.4238],
        [0.8041, 1.4],
        [0.5573, 1.6419],
        [0.55, 1.6491],
    ]);
    let square = ring(&[[-6.0, -6.0], [8.0, -6.0], [8.0, 8.0], [-6.0, 8.0]]);
    let mesh = stacked(&[vec![square, hole]], 0.5).unwrap();
    let layers = slice(&mesh, &SliceSettings::default()).unwrap();
    let holes: Vec<bool> = layers[0].walls.iter().map(|wall| wall.hole).collect();
    assert_eq!(holes, [false, true]);
}
