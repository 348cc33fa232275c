//! What holds of sparse fill: it crosses nothing, stays inside, has its share, stands on itself, and reaches what it has to hold.

mod shapes;

use argil_curve::{DVec2, SegmentIndex};
use argil_skin::{FillError, Filled, ModelLoop, Section, SkinOptions, Stripes, beneath, zones};
use geo::{Area, BooleanOps, Distance, Euclidean};
use geo_types::{MultiPolygon, Point};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use shapes::{GRID, WIDTH, disc, inset, is_plane, sides, stack, walls};

fn options() -> SkinOptions {
    SkinOptions::for_width(WIDTH)
}

fn stripes(share: f64, upright: bool) -> Stripes {
    Stripes { pitch: WIDTH / share, origin: DVec2::new(0.3, -0.4), upright }
}

/// A layer with this zone filled and stripes in what is left, and how many of its loops came before them.
fn striped(outline: &MultiPolygon<f64>, zone: &MultiPolygon<f64>, stripes: &Stripes) -> (Filled, usize) {
    let walls = walls(outline);
    let section = Section { outline, walls: &walls };
    let mut filled = section.filled(zone, &options(), &[]).expect("a zone of finite size has a fill");
    let before = filled.loops.len();
    let length = section.striped(&mut filled, (zone, None), stripes, &options()).expect("stripes fit");
    let laid: f64 = filled.loops[before..].iter().flat_map(sides).map(|side| side.length()).sum();
    assert!((length - laid).abs() < 1e-6, "{length} mm told, {laid} mm laid");
    (filled, before)
}

fn index(loops: &[ModelLoop]) -> SegmentIndex {
    SegmentIndex::new(loops.iter().flat_map(sides).collect(), WIDTH)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn stripes_cross_nothing_and_keep_clear(stack in stack(), share in 0.05..1.0, upright: bool) {
        let outlines: Vec<_> = stack.iter().collect();
        let closed = zones(&outlines, &SkinOptions { skin: 1, ..options() }).unwrap();
        for (outline, zone) in stack.iter().zip(&closed) {
            let stripes = stripes(share, upright);
            let (made, before) = striped(outline, zone, &stripes);
            prop_assert!(is_plane(&made.loops));
            prop_assert_eq!(&(made.clone(), before), &striped(outline, zone, &stripes), "the same again");
            let taken = index(&made.loops[..before]);
            for one in &made.loops[before..] {
                prop_assert!(one.fill && one.parent.is_some());
                for &p in &one.points {
                    prop_assert!((p / GRID - (p / GRID).round()).abs().max_element() < 1e-3, "{p} is off the grid");
                    prop_assert!(!taken.is_within(p, 0.69 * WIDTH), "{p} lies on a bead");
                }
            }
        }
    }

    /// Far from walls every lane is one of the lines, and every line is a lane.
    #[test]
    fn lanes_are_the_same_lines_everywhere(radius in 12.0..30.0, at in (-9.0..9.0, -9.0..9.0), share in 0.1..0.9, upright: bool) {
        let outline = disc(radius, at);
        let stripes = stripes(share, upright);
        let (made, before) = striped(&outline, &MultiPolygon(Vec::new()), &stripes);
        let lanes = index(&made.loops[before..]);
        let middle = |t: f64| if upright { DVec2::new(t, at.1) } else { DVec2::new(at.0, t) };
        let [centre, origin] = if upright { [at.0, stripes.origin.x] } else { [at.1, stripes.origin.y] };
        let room = radius - 3.0 * WIDTH - stripes.pitch;
        let lines = (-400..400).map(|k| origin + f64::from(k) * stripes.pitch);
        for line in lines.filter(|line| (line - centre).abs() < room) {
            prop_assert!(lanes.distance(middle(line)) < 2.0 * GRID, "no lane at {line}");
            if stripes.pitch > 2.0 * WIDTH {
                prop_assert!(lanes.distance(middle(line + 0.5 * stripes.pitch)) > 0.49 * stripes.pitch);
            }
        }
    }

    #[test]
    fn the_share_of_clay_is_what_was_asked_for(share in 0.1..0.9) {
        let outline = disc(60.0, (0.0, 0.0));
        let (made, before) = striped(&outline, &MultiPolygon(Vec::new()), &stripes(share, false));
        let laid: f64 = made.loops[before..].iter().flat_map(sides).map(|side| side.length()).sum();
        let area = inset(&outline, WIDTH).unsigned_area();
        prop_assert!((laid * WIDTH / area / share - 1.0).abs() < 0.12, "{}", laid * WIDTH / area);
    }

    #[test]
    fn what_lies_beneath_a_roof_holds_it(stack in stack(), skin in 1_usize..3) {
        let outlines: Vec<_> = stack.iter().collect();
        let options = SkinOptions { skin, ..options() };
        let closed = zones(&outlines, &options).unwrap();
        let paths: Vec<_> = stack.iter().map(walls).collect();
        let sections: Vec<_> =
            stack.iter().zip(&paths).map(|(outline, walls)| Section { outline, walls }).collect();
        let retreat = 0.3 * WIDTH;
        let hollow = beneath(&sections, &closed, retreat, &options).unwrap();
        prop_assert_eq!(hollow.len(), stack.len());
        for (layer, part) in hollow.iter().enumerate() {
            let inside = inset(&stack[layer], WIDTH);
            prop_assert!(part.difference(&inside).unsigned_area() < 0.05, "it leaves the walls");
            let Some((above, outline)) = closed.get(layer + 1).zip(stack.get(layer + 1)) else { continue };
            // All of a zone above that is neither over fill nor over a wall.
            let filled = inset(&above.intersection(&inset(outline, WIDTH)), 0.5 * WIDTH);
            // Fill of what is narrow reaches 0.6 w out in under what covers it.
            let covered = inset(&closed[layer], -0.7 * WIDTH);
            let open = filled.intersection(&inset(&inside, 0.1)).difference(&covered);
            prop_assert!(open.difference(part).unsigned_area() < 0.05, "layer {layer} holds no roof");
            // What is held by what lies beneath reaches no farther than a retreat beyond that, or beyond walls and fill.
            let solid = closed[layer].union(part);
            for polygon in &hollow[layer + 1..].first().cloned().unwrap_or(MultiPolygon(Vec::new())) {
                for at in polygon.exterior().points() {
                    let beside = Euclidean.distance(&at, &solid);
                    let wall = walls_distance(&stack[layer], at);
                    prop_assert!(beside.min(wall) < 1.6 * retreat + 0.02, "{beside} mm out, {wall} mm from the walls");
                }
            }
        }
    }
}

/// Distance from what the walls of an outline take up, mm.
fn walls_distance(outline: &MultiPolygon<f64>, at: Point) -> f64 {
    let inside = inset(outline, WIDTH);
    if inside.0.is_empty() {
        return 0.0;
    }
    let edges = inside.iter().flat_map(|p| std::iter::once(p.exterior()).chain(p.interiors()));
    let edge = edges.map(|ring| Euclidean.distance(&at, ring)).fold(f64::INFINITY, f64::min);
    if Euclidean.distance(&at, &inside) > 0.0 { 0.0 } else { edge }
}

#[test]
fn nothing_is_laid_beneath_what_has_no_roof() {
    let tower = vec![disc(10.0, (0.0, 0.0)); 6];
    let paths: Vec<_> = tower.iter().map(walls).collect();
    let sections: Vec<_> =
        tower.iter().zip(&paths).map(|(outline, walls)| Section { outline, walls }).collect();
    let none = vec![MultiPolygon(Vec::new()); 6];
    let hollow = beneath(&sections, &none, 0.4, &options()).unwrap();
    assert!(hollow.iter().all(|part| part.0.is_empty()));
}

#[test]
fn what_is_no_pitch_is_refused() {
    let outline = disc(10.0, (0.0, 0.0));
    let section = Section { outline: &outline, walls: &[] };
    let none = MultiPolygon(Vec::new());
    for (pitch, origin) in [(0.5, 0.0), (f64::NAN, 0.0), (f64::INFINITY, 0.0), (5.0, f64::NAN)] {
        let stripes = Stripes { pitch, origin: DVec2::splat(origin), upright: false };
        let refused = section.striped(&mut Filled::default(), (&none, None), &stripes, &options());
        assert!(matches!(refused, Err(FillError::Option { name: "pitch", .. })), "{pitch}");
    }
    let wide = disc(1e6, (0.0, 0.0));
    let refused = Section { outline: &wide, walls: &[] }.striped(
        &mut Filled::default(),
        (&none, None),
        &stripes(1.0, false),
        &options(),
    );
    assert!(matches!(refused, Err(FillError::TooManyRings { .. })));
    assert!(matches!(
        beneath(&[section], std::slice::from_ref(&none), 0.0, &options()),
        Err(FillError::Option { name: "retreat", .. })
    ));
}
