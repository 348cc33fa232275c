//! Invariants of the safeguard, over stacks of random walls.

use argil_safeguard::{SafeguardSettings, safeguards};
use geo::{Contains, CoordsIter, Distance, Euclidean, Validation};
use geo_types::{Coord, LineString, MultiPolygon, Point, Polygon};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn star(radii: &[f64], at: [f64; 2]) -> Polygon<f64> {
    let step = TAU / radii.len() as f64;
    let place = |(k, r): (usize, &f64)| Coord {
        x: at[0] + r * (step * k as f64).cos(),
        y: at[1] + r * (step * k as f64).sin(),
    };
    Polygon::new(LineString(radii.iter().enumerate().map(place).collect()), vec![])
}

/// Layers of one or two bodies each that wander; some are empty.
fn stack() -> impl Strategy<Value = Vec<MultiPolygon<f64>>> {
    let body = (prop::collection::vec(0.5..8.0_f64, 3..24), [-4.0..4.0_f64, -4.0..4.0]);
    let layer = (prop::collection::vec(body, 0..3)).prop_map(|bodies| {
        // Bodies side by side, so that their walls are disjoint as those of a layer are.
        let place =
            |(k, (radii, at)): (usize, (Vec<f64>, [f64; 2]))| star(&radii, [at[0] + 30.0 * k as f64, at[1]]);
        MultiPolygon(bodies.into_iter().enumerate().map(place).collect())
    });
    prop::collection::vec(layer, 1..7)
}

fn boundary_distance(region: &MultiPolygon<f64>, p: Point<f64>) -> f64 {
    let rings =
        region.iter().flat_map(|polygon| std::iter::once(polygon.exterior()).chain(polygon.interiors()));
    rings.map(|ring| Euclidean.distance(&p, ring)).fold(f64::INFINITY, f64::min)
}

/// Points along the walls, corners included.
fn wall_points(walls: &MultiPolygon<f64>) -> Vec<Point<f64>> {
    let sides = walls.iter().flat_map(|polygon| polygon.exterior().lines());
    sides
        .flat_map(|side| (0..4).map(move |k| Point::from(side.start + side.delta() * (0.25 * f64::from(k)))))
        .collect()
}

#[test]
fn a_needle_without_width_bites_nothing_out() {
    // The corner of a square, with a needle that stands out of it by a fiftieth of a millimetre.
    let ring = [
        (-12.000000005683978, -11.968508171973832),
        (-12.020000001511653, -11.965358990369447),
        (-11.800000002703745, -12.000000002918847),
        (-5.000000005683978, -12.000000002918847),
        (-4.2682927009678675, -6.146341460881837),
        (-3.0000000056839777, -9.000000002918847),
        (-2.5740740803099467, -4.953703704414972),
        (-11.000000005683978, 5.999999997081153),
        (-7.000000005683978, -2.9188473860131126e-09),
        (-5.157894751153071, -4.144736859141),
        (-12.000000005683978, -5.000000002918847),
    ];
    for turn in 0..ring.len() {
        let mut ring: Vec<Coord<f64>> = ring.iter().copied().map(Coord::from).collect();
        ring.rotate_left(turn);
        let other = [
            (-1.0000000056839777, 9.999999997081153),
            (-2.5740740803099467, -4.953703704414972),
            (-1.0000000056839777, -7.000000002918847),
            (1.9999999943160223, -1.0000000029188474),
        ]
        .map(Coord::from)
        .to_vec();
        let walls = MultiPolygon([ring, other].map(|ring| Polygon::new(LineString(ring), vec![])).to_vec());
        let settings = SafeguardSettings::for_width(1.5);
        let region = &safeguards(std::slice::from_ref(&walls), &settings)[0];
        let p = Point::new(-11.998, -11.968_823);
        assert!(boundary_distance(region, p) >= settings.dilation - ROUNDING, "begun at {turn}");
    }
}

#[test]
fn what_is_nothing_but_a_needle_is_no_wall() {
    let needle = [(0.0, 0.0), (4.0, 1.0), (8.0, 2.0), (4.0, 1.0)].map(Coord::from).to_vec();
    let square = [(20.0, 0.0), (24.0, 0.0), (24.0, 4.0), (20.0, 4.0)].map(Coord::from).to_vec();
    let hole = [(21.0, 1.0), (23.0, 1.0), (22.0, 1.0)].map(Coord::from).to_vec();
    let walls = MultiPolygon(vec![
        Polygon::new(LineString(needle), vec![]),
        Polygon::new(LineString(square), vec![LineString(hole)]),
    ]);
    let region = &safeguards(std::slice::from_ref(&walls), &SafeguardSettings::for_width(1.5))[0];
    assert!(
        region.0.len() == 1
            && region.contains(&Point::new(22.0, 2.0))
            && !region.contains(&Point::new(4.0, 1.0))
    );
}

/// The kernel rounds to a thousandth of a millimetre's thousandth at these sizes.
const ROUNDING: f64 = 1e-5;

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn walls_are_kept_at_their_distance(layers in stack(), width in 0.3..3.0_f64) {
        let settings = SafeguardSettings::for_width(width);
        for (region, walls) in safeguards(&layers, &settings).iter().zip(&layers) {
            for p in wall_points(walls) {
                prop_assert!(region.contains(&p));
                prop_assert!(boundary_distance(region, p) >= settings.dilation - ROUNDING);
            }
        }
    }

    #[test]
    fn what_is_outside_is_near_an_outside_below(layers in stack(), width in 0.3..3.0_f64) {
        let settings = SafeguardSettings::for_width(width);
        let regions = safeguards(&layers, &settings);
        for pair in regions.windows(2) {
            // The farthest inside S_{i-1} that a point outside S_i can be is on the boundary of S_i or
            // anywhere outside it: sample both.
            let edge = pair[1].coords_iter().map(Point::from);
            let field = (0..900).map(|k| Point::new(-14.0 + 2.0 * f64::from(k % 30), -14.0 + f64::from(k / 30)));
            for p in edge.chain(field.filter(|p| !pair[1].contains(p))) {
                let depth = if pair[0].contains(&p) { boundary_distance(&pair[0], p) } else { 0.0 };
                prop_assert!(depth <= settings.shrink + ROUNDING, "{depth} below a point outside");
            }
        }
    }

    #[test]
    fn it_is_hardly_larger_than_the_formula(layers in stack(), width in 0.3..3.0_f64) {
        let settings = SafeguardSettings::for_width(width);
        let regions = safeguards(&layers, &settings);
        let slack = 0.2 * settings.shrink + ROUNDING;
        for (index, region) in regions.iter().enumerate() {
            for p in region.coords_iter().map(Point::from) {
                let near = Euclidean.distance(&p, &layers[index]) <= settings.dilation + slack;
                let kept = index > 0
                    && regions[index - 1].contains(&p)
                    && boundary_distance(&regions[index - 1], p) >= settings.shrink - slack;
                prop_assert!(near || kept);
            }
        }
    }

    #[test]
    fn regions_are_valid_and_stay_small(layers in stack(), width in 0.3..3.0_f64, upper in 0_usize..40) {
        let mut layers = layers;
        let last = layers[layers.len() - 1].clone();
        layers.extend(std::iter::repeat_n(last, upper));
        let regions = safeguards(&layers, &SafeguardSettings::for_width(width));
        prop_assert_eq!(regions.len(), layers.len());
        let most_of_walls = layers.iter().map(|walls| walls.coords_count()).max().unwrap_or(0);
        for region in &regions {
            prop_assert!(region.is_valid());
            prop_assert!(region.coords_count() <= 40 * (most_of_walls + 2));
        }
        prop_assert_eq!(&regions, &safeguards(&layers, &SafeguardSettings::for_width(width)));
    }
}

#[test]
fn nothing_in_gives_nothing_out() {
    assert!(safeguards(&[], &SafeguardSettings::default()).is_empty());
    assert_eq!(safeguards(&[MultiPolygon(vec![])], &SafeguardSettings::default()), [MultiPolygon(vec![])]);
}

#[test]
fn clockwise_walls_are_dilated_too() {
    let mut ring = star(&[5.0; 12], [0.0; 2]).exterior().clone();
    ring.0.reverse();
    let region =
        &safeguards(&[MultiPolygon(vec![Polygon::new(ring, vec![])])], &SafeguardSettings::default())[0];
    assert!(region.contains(&Point::new(6.2, 0.0)));
}

#[test]
fn what_is_not_finite_is_left_out() {
    let walls = |radius: f64| MultiPolygon(vec![star(&[radius; 8], [0.0; 2])]);
    let layers = [walls(5.0), walls(f64::NAN), walls(1e300)];
    for value in [f64::NAN, f64::INFINITY, -1.0] {
        let regions = safeguards(&layers, &SafeguardSettings { dilation: value, shrink: value });
        assert_eq!(regions.len(), 3);
        assert!(regions.iter().all(|region| region.contains(&Point::new(4.9, 0.0))));
    }
}
