//! What holds of zones, of loops with fill, and of lanes that give way.

mod shapes;

use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
use argil_skin::{Bumps, FillError, Filled, ModelLoop, Section, SkinOptions, bumped, zones};
use geo::{Area, BooleanOps, Contains};
use geo_types::{MultiPolygon, Point};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use shapes::{GRID, WIDTH, disc, inset, is_plane, sides, stack, walls};

fn options(floor: usize, skin: usize) -> SkinOptions {
    SkinOptions { floor, skin, ..SkinOptions::for_width(WIDTH) }
}

/// A layer whose narrow gaps are closed, too.
fn filled(outline: &MultiPolygon<f64>, zone: &MultiPolygon<f64>) -> Filled {
    with(outline, zone, &SkinOptions { tight: true, ..options(0, 0) })
}

fn with(outline: &MultiPolygon<f64>, zone: &MultiPolygon<f64>, options: &SkinOptions) -> Filled {
    let walls = walls(outline);
    Section { outline, walls: &walls }.filled(zone, options, &[]).expect("a zone of finite size has a fill")
}

fn index(loops: &[ModelLoop]) -> SegmentIndex {
    SegmentIndex::new(loops.iter().flat_map(sides).collect(), WIDTH)
}

/// Points of a square lattice inside a region.
fn lattice(region: &MultiPolygon<f64>) -> Vec<DVec2> {
    let steps = (-60..=60).map(|k| 0.41 * f64::from(k));
    steps
        .clone()
        .flat_map(|x| steps.clone().map(move |y| DVec2::new(x, y)))
        .filter(|p| region.contains(&Point::new(p.x, p.y)))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, rng_seed: RngSeed::Fixed(5), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_open_face_is_closed(stack in stack(), skin in 1_usize..3) {
        let outlines: Vec<_> = stack.iter().collect();
        let closed = zones(&outlines, &options(0, skin)).unwrap();
        prop_assert_eq!(closed.len(), stack.len());
        let none = MultiPolygon(Vec::new());
        for (layer, outline) in stack.iter().enumerate() {
            prop_assert!(closed[layer].difference(outline).unsigned_area() < 1e-3, "a zone leaves its layer");
            let above = stack.get(layer + 1).unwrap_or(&none);
            let below = layer.checked_sub(1).map_or(&none, |k| &stack[k]);
            for neighbour in [above, below] {
                // A disc as wide as a bead fits everywhere into what is left of this.
                let open = inset(&outline.difference(neighbour), 0.51 * WIDTH);
                prop_assert!(open.difference(&closed[layer]).unsigned_area() < 1e-3, "layer {layer} stays open");
                for behind in 1..skin {
                    for other in [layer.checked_sub(behind), Some(layer + behind)].into_iter().flatten() {
                        let faces_it = (other < layer) == std::ptr::eq(neighbour, above);
                        let Some(its) = stack.get(other).filter(|_| faces_it) else { continue };
                        let left = open.intersection(its).difference(&closed[other]);
                        prop_assert!(left.unsigned_area() < 1e-3, "layer {other} behind layer {layer}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_covered_on_both_sides_stays_as_it_is(outline in stack(), skin in 1_usize..3) {
        let same = vec![&outline[0]; 2 * skin + 1];
        let closed = zones(&same, &options(0, skin)).unwrap();
        prop_assert!(closed[skin].0.is_empty());
        prop_assert!(closed[0].unsigned_area() > 0.0 && closed[2 * skin].unsigned_area() > 0.0);
    }

    #[test]
    fn walls_and_fill_are_loops_that_cross_nowhere(stack in stack()) {
        let outlines: Vec<_> = stack.iter().collect();
        let closed = zones(&outlines, &options(1, 1)).unwrap();
        for (outline, zone) in stack.iter().zip(&closed) {
            let made = filled(outline, zone);
            prop_assert!(is_plane(&made.loops));
            prop_assert_eq!(&made, &filled(outline, zone), "the same again");
            let strand = index(&made.loops);
            let given = walls(outline);
            let kept = made.loops.iter().take_while(|one| !one.fill).map(|one| &one.points);
            prop_assert!(kept.eq(&given), "walls have changed");
            prop_assert!(made.loops[given.len()..].iter().all(|one| one.fill));
            for one in &made.loops {
                if let Some(parent) = one.parent {
                    let around = ClosedCurve::new(made.loops[parent].points.clone()).unwrap();
                    prop_assert!(one.points.iter().all(|&p| around.contains(p)));
                }
            }
            // Nothing of a zone wider than two beads is farther from a bead than the widest bare disc that is listed.
            let wide = inset(&inset(zone, WIDTH), -WIDTH);
            let solid = inset(outline, 0.5 * WIDTH);
            for place in lattice(&wide.intersection(&solid)) {
                let beside = strand.distance(place);
                let listed = made.bare.iter().any(|disc| disc.centre.distance(place) < disc.diameter);
                prop_assert!(beside < 0.9 * WIDTH || listed, "{beside} mm from a bead at {place}");
            }
        }
    }

    #[test]
    fn lanes_give_way_without_crossing(stack in stack(), shift in (-0.5..0.5, -0.5..0.5)) {
        let outline = &stack[0];
        let made = filled(outline, outline);
        // The lanes of the layer above, moved a little: every bead and a half a need.
        let shift = WIDTH * DVec2::from(shift);
        let needs: Vec<DVec2> = made
            .loops
            .iter()
            .flat_map(|one| ClosedCurve::new(one.points.clone()).unwrap().resampled(1.5 * WIDTH))
            .map(|p| p + shift)
            .collect();
        let bumps = Bumps { width: WIDTH, within: 0.2 * WIDTH, most: 0.45 * WIDTH, grid: GRID };
        let mut loops = made.loops.clone();
        let count = bumped(&mut loops, &needs, &bumps);
        prop_assert!(is_plane(&loops));
        let after = index(&loops);
        let held = |index: &SegmentIndex| needs.iter().filter(|need| index.is_within(**need, bumps.within)).count();
        prop_assert!(held(&after) >= count, "{count} bumps");
        for (one, next) in made.loops.iter().zip(&loops) {
            prop_assert_eq!((one.fill, one.parent), (next.fill, next.parent));
            prop_assert!(one.fill || one == next, "a wall has moved");
        }
    }
}

#[test]
fn a_plate_on_a_post_has_an_underside() {
    let stack =
        [disc(4.0, (0.0, 0.0)), disc(4.0, (0.0, 0.0)), disc(12.0, (0.0, 0.0)), disc(12.0, (0.0, 0.0))];
    let closed = zones(&stack.iter().collect::<Vec<_>>(), &options(0, 1)).unwrap();
    let ring = std::f64::consts::PI * (144.0 - 16.0);
    assert!((closed[2].unsigned_area() - ring).abs() < 0.1 * ring, "the underside");
    assert!(closed[1].0.is_empty(), "the post stays hollow");
    let made = filled(&stack[2], &closed[2]);
    assert_eq!(made.loops.iter().map(|one| one.fill).collect::<Vec<_>>(), [false, true]);
}

#[test]
fn fill_may_lie_anywhere_between_walls() {
    // A plate with a window; a zone round the window and one by itself.
    let outline = disc(20.0, (0.0, 0.0)).difference(&disc(3.0, (-8.0, 0.0)));
    let zone = disc(8.0, (-8.0, 0.0)).union(&disc(4.0, (10.0, 0.0)));
    let made = filled(&outline, &zone);
    let parents = |fill: bool| made.loops.iter().filter(move |one| one.fill == fill).map(|one| one.parent);
    assert_eq!(parents(true).collect::<Vec<_>>(), [Some(0), Some(0)], "two fills within the outer wall");
    assert_eq!(parents(false).count(), 2);
}

#[test]
fn a_gap_between_walls_is_closed_where_that_is_asked_for() {
    // A ring 2.8 beads wide: between its two walls 0.8 of a bead is left.
    let outline = disc(14.0, (0.0, 0.0)).difference(&disc(14.0 - 2.8 * WIDTH, (0.0, 0.0)));
    let fills = |tight: bool| {
        let made = with(&outline, &outline, &SkinOptions { tight, ..options(0, 0) });
        made.loops.iter().filter(|one| one.fill).count()
    };
    assert_eq!((fills(false), fills(true)), (0, 1));
}

#[test]
fn without_a_zone_walls_stay_as_they_are() {
    let outline = disc(10.0, (0.0, 0.0)).difference(&disc(5.0, (0.0, 0.0)));
    let made = filled(&outline, &MultiPolygon(Vec::new()));
    let given = walls(&outline);
    assert_eq!(
        made.loops.iter().map(|one| &one.points).collect::<Vec<_>>(),
        given.iter().collect::<Vec<_>>()
    );
    assert_eq!(made.loops.iter().map(|one| one.parent).collect::<Vec<_>>(), [None, Some(0)]);
}

#[test]
fn needs_beside_walls_or_far_from_lanes_move_nothing() {
    let outline = disc(10.0, (0.0, 0.0));
    let bumps = Bumps { width: WIDTH, within: 0.2, most: 0.6, grid: GRID };
    let mut walls_only = filled(&outline, &MultiPolygon(Vec::new())).loops;
    let before = walls_only.clone();
    assert_eq!(bumped(&mut walls_only, &[DVec2::new(8.8, 0.0), DVec2::new(0.0, 0.0), DVec2::NAN], &bumps), 0);
    assert_eq!(walls_only, before);
    let none = Bumps { within: f64::NAN, ..bumps };
    assert_eq!(bumped(&mut filled(&outline, &outline).loops, &[DVec2::new(3.0, 0.3)], &none), 0);
}

#[test]
fn what_is_no_width_is_refused() {
    let outline = disc(10.0, (0.0, 0.0));
    for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = SkinOptions { skin: 1, ..SkinOptions::for_width(width) };
        assert!(matches!(zones(&[&outline], &options), Err(FillError::Option { name: "width", .. })));
        let section = Section { outline: &outline, walls: &[] };
        assert!(section.filled(&outline, &options, &[]).is_err());
    }
    let far = disc(10.0, (1e12, 0.0));
    let section = Section { outline: &far, walls: &[] };
    assert!(section.filled(&far, &options(1, 0), &[]).is_err());
}
