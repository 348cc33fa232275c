//! Paths at the edge of what makes sense: refused with a reason, or answered without a panic.

use argil_elastic::{
    Carrier, Clearance, DVec2, ElasticError, ElasticOptions, ImlsField, Path, Stop, relax, relax_literally,
};

fn square() -> Vec<DVec2> {
    [(0.0, 0.0), (1.0, 0.1), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(DVec2::from).to_vec()
}

fn path<'a>(points: &'a [DVec2], fixed: &'a [bool]) -> Path<'a> {
    Path { points, fixed, carriers: &[], clear_of: None, felt: &[] }
}

#[test]
fn lists_of_another_length_are_refused() {
    let points = square();
    let refused = relax(&path(&points, &[true; 4]), &ElasticOptions::default());
    assert_eq!(refused, Err(ElasticError::LengthMismatch { list: "fixed", found: 4, expected: 5 }));
    let felt = Path { felt: &[true; 2], ..path(&points, &[false; 5]) };
    let refused = relax(&felt, &ElasticOptions::default());
    assert_eq!(refused, Err(ElasticError::LengthMismatch { list: "felt", found: 2, expected: 5 }));
}

#[test]
fn points_that_are_no_numbers_are_refused() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut points = square();
        points[3].y = bad;
        let refused = relax(&path(&points, &[false; 5]), &ElasticOptions::default());
        assert_eq!(refused, Err(ElasticError::PointNotFinite { vertex: 3 }));
    }
}

#[test]
fn carriers_are_checked() {
    let points = square();
    let fixed = [true, false, true, true, true];
    let outside = [Carrier { vertex: 1, anchor: DVec2::new(1.0, 0.7) }];
    let refused = relax(&Path { carriers: &outside, ..path(&points, &fixed) }, &ElasticOptions::default());
    let Err(ElasticError::CarrierOutside { carrier: 0, vertex: 1, distance, envelope }) = refused else {
        panic!("{refused:?}");
    };
    assert!((distance - 0.6).abs() < 1e-12 && (envelope - 0.45).abs() < 1e-12);
    // The literal reading has no carriers.
    let ignored = Path { carriers: &outside, ..path(&points, &fixed) };
    assert!(relax_literally(&ignored, &ElasticOptions::literal(1.5)).is_ok());
    for carrier in
        [Carrier { vertex: 5, anchor: DVec2::ZERO }, Carrier { vertex: 1, anchor: DVec2::new(f64::NAN, 0.0) }]
    {
        let refused =
            relax(&Path { carriers: &[carrier], ..path(&points, &fixed) }, &ElasticOptions::default());
        assert_eq!(refused, Err(ElasticError::BadCarrier { carrier: 0, vertex: carrier.vertex }));
    }
}

#[test]
fn a_carrier_on_a_wall_is_only_checked() {
    let points = square();
    let held = [Carrier { vertex: 0, anchor: DVec2::new(0.0, 0.1) }];
    let fixed = [true, false, true, true, true];
    let relaxed =
        relax(&Path { carriers: &held, ..path(&points, &fixed) }, &ElasticOptions::default()).unwrap();
    assert_eq!(relaxed, relax(&path(&points, &fixed), &ElasticOptions::default()).unwrap());
}

#[test]
fn options_without_meaning_are_refused() {
    let default = ElasticOptions::default();
    let points = square();
    for (option, options) in [
        ("width", ElasticOptions { width: 0.0, ..default }),
        ("envelope", ElasticOptions { envelope: -0.1, ..default }),
        ("length", ElasticOptions { length: f64::NAN, ..default }),
        ("bend", ElasticOptions { bend: -1.0, ..default }),
        ("clear_distance", ElasticOptions { clear_distance: f64::INFINITY, ..default }),
        ("max_step", ElasticOptions { max_step: 0.0, ..default }),
    ] {
        let refused = relax(&path(&points, &[false; 5]), &options);
        assert!(matches!(refused, Err(ElasticError::BadOption { option: o, .. }) if o == option), "{option}");
    }
}

#[test]
fn nothing_to_do_changes_nothing() {
    let options = ElasticOptions::default();
    for n in 0..3 {
        let points = square()[..n].to_vec();
        let relaxed = relax(&path(&points, &vec![false; n]), &options).unwrap();
        assert_eq!((relaxed.points, relaxed.iterations, relaxed.stop), (points, 0, Stop::Converged));
    }
    let relaxed = relax(&path(&square(), &[true; 5]), &options).unwrap();
    assert_eq!((relaxed.points, relaxed.iterations), (square(), 0));
}

#[test]
fn degenerate_paths_are_answered() {
    let options = ElasticOptions::default();
    let spot = vec![DVec2::ONE; 7];
    let back_and_forth: Vec<DVec2> =
        (0..9).map(|k| DVec2::new(f64::from(4 - (k - 4_i32).abs()), 0.0)).collect();
    let huge: Vec<DVec2> = square().iter().map(|p| *p * 1e307).collect();
    let far: Vec<DVec2> = square().iter().map(|p| *p + DVec2::splat(1e12)).collect();
    let tiny: Vec<DVec2> = square().iter().map(|p| *p * 1e-300).collect();
    for points in [spot, back_and_forth, huge, far, tiny] {
        for free in 1..=points.len() {
            let fixed: Vec<bool> = (0..points.len()).map(|k| k >= free).collect();
            let relaxed = relax(&path(&points, &fixed), &options).unwrap();
            assert!(relaxed.points.iter().all(|p| p.is_finite()));
            assert!(relaxed.energy_after <= relaxed.energy_before);
            assert!(relax_literally(&path(&points, &fixed), &options).is_ok());
        }
    }
}

/// Answers nonsense on one side.
#[derive(Debug)]
struct Nonsense;

impl Clearance for Nonsense {
    fn distance(&self, p: DVec2) -> (f64, DVec2) {
        if p.x > 1.0 { (f64::NAN, DVec2::NAN) } else { (-1e9, DVec2::X) }
    }
}

#[test]
fn a_field_without_an_answer_is_far_away() {
    let points = square();
    let fixed = [true, false, true, true, true];
    let feeling = Path { clear_of: Some(&Nonsense), felt: &[true; 5], ..path(&points, &fixed) };
    let relaxed = relax(&feeling, &ElasticOptions::default()).unwrap();
    assert!(relaxed.points.iter().all(|p| p.is_finite()));
    assert!(relaxed.energy_after <= relaxed.energy_before);
}

/// A wall along y = 0 and a strand that leaves it for a corridor of two lanes, 0.5 mm apart, and comes back.
fn corridor() -> (Vec<DVec2>, Vec<bool>) {
    let mut points: Vec<DVec2> = [(0.5, 0.0), (8.0, 0.0), (8.0, -8.0), (-8.0, -8.0), (-8.0, 0.0), (0.0, 0.0)]
        .map(DVec2::from)
        .to_vec();
    points.extend((1..=16).map(|k| DVec2::new(0.0, 0.75 * f64::from(k))));
    points.extend((1..=16).rev().map(|k| DVec2::new(0.5, 0.75 * f64::from(k))));
    let fixed = (0..points.len()).map(|k| k < 6).collect();
    (points, fixed)
}

#[test]
fn the_paper_lets_lanes_lie_on_each_other_and_its_tips_retract() {
    let (points, fixed) = corridor();
    let tip = [21, 22].map(|vertex| Carrier { vertex, anchor: points[vertex] });
    let path = Path { carriers: &tip, ..path(&points, &fixed) };
    let mended = relax(&path, &ElasticOptions::default()).unwrap();
    let literal = relax_literally(&path, &ElasticOptions::literal(1.5)).unwrap();
    let apart = |points: &[DVec2]| points[13].distance(points[30]);
    assert!(apart(&mended.points) > 0.8, "{}", apart(&mended.points));
    assert!(apart(&literal.points) < 0.6, "{}", apart(&literal.points));
    let left = |points: &[DVec2]| points[21].distance(tip[0].anchor);
    assert!(left(&mended.points) < 0.45);
    assert!(left(&literal.points) > 0.45, "{}", left(&literal.points));
}

/// Two bows from (-10, 0) over (0, 0) to (10, 0), closed below by a wall with a spike under the first bow.
fn bows(spike: f64) -> (Vec<DVec2>, Vec<bool>) {
    let bow = |centre: f64| {
        (1..16).map(move |k| {
            let angle = std::f64::consts::PI * (1.0 - f64::from(k) / 16.0);
            DVec2::new(centre + 5.0 * angle.cos(), 3.0 * angle.sin())
        })
    };
    let mut points = vec![DVec2::new(-10.0, 0.0)];
    points.extend(bow(-5.0));
    points.push(DVec2::ZERO);
    points.extend(bow(5.0));
    let free = |k: usize| (1..16).contains(&k) || (17..32).contains(&k);
    points.extend(
        [(10.0, 0.0), (10.0, -5.0), (-4.5, -5.0), (-5.0, spike), (-5.5, -5.0), (-10.0, -5.0)]
            .map(DVec2::from),
    );
    let fixed = (0..points.len()).map(|k| !free(k)).collect();
    (points, fixed)
}

#[test]
fn a_blocked_place_does_not_hold_up_the_rest() {
    // Without repulsion only the guard keeps the first bow off the spike.
    let options = ElasticOptions { repulsion: 0.0, ..ElasticOptions::default() };
    let relaxed = |spike: f64| {
        let (points, fixed) = bows(spike);
        relax(&path(&points, &fixed), &options).unwrap().points
    };
    let (blocked, unhindered) = (relaxed(2.9), relaxed(-4.0));
    let over_spike = blocked[..17].windows(2).find(|e| e[0].x <= -5.0 && e[1].x > -5.0).unwrap();
    let height =
        over_spike[0].lerp(over_spike[1], (-5.0 - over_spike[0].x) / (over_spike[1].x - over_spike[0].x)).y;
    assert!(height > 2.9 && height < 2.99, "{height}");
    assert!(unhindered[8].y < 2.7, "{}", unhindered[8].y);
    for (p, q) in blocked[17..32].iter().zip(&unhindered[17..32]) {
        assert!(p.distance(*q) < 0.05, "{p} and {q}");
    }
}

#[test]
fn the_implicit_field_is_near_the_distance_and_its_gradient_exact() {
    let outer: Vec<DVec2> =
        (0..120).map(|k| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 120.0) * 10.0).collect();
    let hole: Vec<DVec2> = outer.iter().rev().map(|p| *p * 0.5).collect();
    let field = ImlsField::new([outer.as_slice(), hole.as_slice()], 0.5).unwrap();
    for (p, expected) in [((12.0, 0.0), 2.0), ((0.0, 9.0), -1.0), ((5.5, 0.0), -0.5), ((0.0, -4.0), 1.0)] {
        let p = DVec2::from(p);
        let (distance, gradient) = field.distance(p);
        assert!((distance - expected).abs() < 0.1, "{distance} at {p}");
        let h = 1e-6;
        let slope = |e: DVec2| (field.distance(p + e * h).0 - field.distance(p - e * h).0) / (2.0 * h);
        assert!(gradient.distance(DVec2::new(slope(DVec2::X), slope(DVec2::Y))) < 1e-5);
    }
}

#[test]
fn the_implicit_field_falls_back_to_the_nearest_vertex() {
    let outer: Vec<DVec2> =
        (0..120).map(|k| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 120.0) * 10.0).collect();
    let field = ImlsField::new([outer.as_slice()], 0.5).unwrap();
    assert_eq!(field.distance(DVec2::new(110.0, 0.0)), (100.0, DVec2::X));
    let (inside, gradient) = ImlsField::new([outer.as_slice()], 0.1).unwrap().distance(DVec2::new(1.0, 0.0));
    assert!((inside + 9.0).abs() < 1e-12 && gradient.distance(DVec2::X) < 1e-12);
    assert_eq!(ImlsField::new([], 0.5).unwrap().distance(DVec2::ZERO).0, f64::INFINITY);
    assert!(ImlsField::new([outer.as_slice()], f64::NAN).is_err());
    assert_eq!(
        ImlsField::new([[DVec2::NAN].as_slice()], 1.0),
        Err(ElasticError::PointNotFinite { vertex: 0 })
    );
}
