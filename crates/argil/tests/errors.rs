//! What cannot be planned is an error with its reason, and what is merely awkward is planned.

mod invariants;
mod sample;
mod verdict;

use argil::curve::DVec2;
use argil::mesh::Mesh;
use argil::slice::{Layer, Loss, SliceError, WallLoop};
use argil::strand::Role;
use argil::{Material, PlanError, Planner, Settings};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};
use invariants::departures;
use sample::sample;
use verdict::audited;

/// A box with one corner at the origin, mm.
fn block(x: f64, y: f64, z: f64) -> Mesh {
    Mesh::cuboid([0.0; 3], [x, y, z]).expect("a box is a mesh")
}

fn refusal(settings: &Settings) -> (&'static str, f64) {
    match Planner::default().plan(&block(9.0, 9.0, 3.0), settings) {
        Err(PlanError::Setting { name, value, .. }) => (name, value),
        other => panic!("{settings:?} gives {other:?}"),
    }
}

#[test]
fn lengths_that_are_none_are_named() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let good = Settings::default();
        let material = Material::default();
        let cases = [
            ("width", Settings { width: bad, ..good }),
            ("layer_height", Settings { layer_height: bad, ..good }),
            ("grid", Settings { grid: bad, ..good }),
            ("material.across", Settings { material: Material { across: bad, ..material }, ..good }),
            ("material.along", Settings { material: Material { along: bad, ..material }, ..good }),
        ];
        for (expected, settings) in cases {
            let (name, value) = refusal(&settings);
            assert_eq!(name, expected);
            assert_eq!(value.to_bits(), bad.to_bits());
        }
    }
}

#[test]
fn settings_beyond_their_range_are_named() {
    let good = Settings::default();
    assert_eq!(refusal(&Settings { layer_height: 1.6, ..good }), ("layer_height", 1.6));
    assert_eq!(refusal(&Settings { walls: 0, ..good }), ("walls", 0.0));
    assert_eq!(refusal(&Settings { walls: usize::MAX, ..good }).0, "walls");
    assert_eq!(refusal(&Settings { grid: 0.1, ..good }), ("grid", 0.1));
    let loose = Material { across: 1.5, ..Material::default() };
    assert_eq!(refusal(&Settings { material: loose, ..good }), ("material.across", 1.5));
}

#[test]
fn sizes_at_the_ends_of_numbers_are_refused_or_planned() {
    for width in [f64::MIN_POSITIVE, 1e-12, 1e-3, 1e12, f64::MAX] {
        match Planner::default().plan(&block(9.0, 9.0, 3.0), &Settings::for_width(width)) {
            Ok(plan) => {
                let length = plan.strand.length();
                assert!(length.is_finite() && length > 0.0, "width {width}: a strand of {length} mm");
            }
            Err(refusal) => assert!(!refusal.to_string().is_empty(), "width {width}: refused without a word"),
        }
    }
}

#[test]
fn a_mesh_thinner_than_a_layer() {
    let outcome = Planner::default().plan(&block(9.0, 9.0, 0.2), &Settings::default());
    let Err(PlanError::Slice(SliceError::ThinnerThanALayer { height, .. })) = outcome else {
        panic!("{outcome:?}");
    };
    assert!((height - 0.2).abs() < 1e-9);
}

#[test]
fn a_mesh_without_a_printable_outline() {
    let outcome = Planner::default().plan(&block(9.0, 0.02, 3.0), &Settings::default());
    assert!(matches!(outcome, Err(PlanError::Nothing)), "{outcome:?}");
}

#[test]
fn no_layers_and_empty_layers() {
    let settings = Settings::default();
    for layers in [vec![], vec![empty(0)], vec![empty(0), empty(1), empty(2)]] {
        let outcome = Planner::default().plan_layers(&layers, &settings);
        assert!(matches!(outcome, Err(PlanError::Nothing)), "{outcome:?}");
    }
}

#[test]
fn layers_in_disorder() {
    let mut swapped = stack(3, &[square(DVec2::ZERO, 6.0, None)]);
    swapped.swap(0, 1);
    let mut level = stack(3, &[square(DVec2::ZERO, 6.0, None)]);
    level[2].print_z = level[1].print_z;
    let mut nowhere = stack(3, &[square(DVec2::ZERO, 6.0, None)]);
    nowhere[1].print_z = f64::NAN;
    for layers in [swapped, level, nowhere] {
        let outcome = Planner::default().plan_layers(&layers, &Settings::default());
        assert!(matches!(outcome, Err(PlanError::Strand(_))), "{outcome:?}");
    }
}

#[test]
fn walls_that_are_no_curves() {
    let nan = DVec2::new(f64::NAN, 0.0);
    let far = DVec2::new(f64::INFINITY, 1.0);
    let flawed =
        [vec![], vec![DVec2::ZERO], vec![DVec2::ZERO; 4], vec![nan; 4], vec![DVec2::ZERO, DVec2::X, far]];
    for points in flawed {
        let mut layers = stack(3, &[square(DVec2::ZERO, 6.0, None)]);
        layers[1].walls[0].points = points.clone();
        let outcome = Planner::default().plan_layers(&layers, &Settings::default());
        assert!(matches!(outcome, Err(PlanError::Layer { layer: 1, .. })), "{points:?}: {outcome:?}");
    }
}

#[test]
fn walls_with_parents_that_do_not_exist() {
    for parent in [0, 7] {
        let mut layers = stack(3, &[square(DVec2::ZERO, 6.0, None)]);
        layers[1].walls[0].parent = Some(parent);
        let outcome = Planner::default().plan_layers(&layers, &Settings::default());
        assert!(matches!(outcome, Err(PlanError::Layer { layer: 1, .. })), "{outcome:?}");
    }
}

fn wall(points: Vec<DVec2>, parent: Option<usize>, depth: usize) -> WallLoop {
    WallLoop { points, parent, depth, wall: 0, hole: depth % 2 == 1, thin: false }
}

/// A square wall about `middle` whose sides are 2 `half` mm long; within `parent` it bounds a hole.
fn square(middle: DVec2, half: f64, parent: Option<usize>) -> WallLoop {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    wall(corners.map(|c| middle + half * DVec2::from(c)).to_vec(), parent, 0)
}

/// Squares about one point, each within the one before.
fn nested(middle: DVec2, halves: &[f64]) -> Vec<WallLoop> {
    let mut walls = Vec::new();
    for (depth, &half) in halves.iter().enumerate() {
        let mut points = square(middle, half, None).points;
        if depth % 2 == 1 {
            points.reverse();
        }
        walls.push(wall(points, depth.checked_sub(1), depth));
    }
    walls
}

fn layer(index: usize, walls: Vec<WallLoop>) -> Layer {
    let filled = walls.iter().filter(|w| w.parent.is_none()).map(|w| {
        let ring: Vec<Coord<f64>> = w.points.iter().map(|p| Coord { x: p.x, y: p.y }).collect();
        Polygon::new(LineString(ring), vec![])
    });
    let outline = MultiPolygon(filled.collect());
    let h = Settings::default().layer_height;
    let below = index as f64 * h;
    Layer {
        index,
        cut_z: below + 0.5 * h,
        print_z: below + h,
        outline,
        walled: MultiPolygon(Vec::new()),
        walls,
        losses: vec![],
    }
}

fn empty(index: usize) -> Layer {
    layer(index, vec![])
}

fn stack(layers: usize, walls: &[WallLoop]) -> Vec<Layer> {
    (0..layers).map(|index| layer(index, walls.to_vec())).collect()
}

fn assert_plans(layers: &[Layer]) {
    let settings = Settings::default();
    let plan = Planner::default().plan_layers(layers, &settings).expect("there is a plan");
    let found = departures(&plan, layers, &settings);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_model_that_vanishes_for_a_while() {
    let mut layers = stack(7, &[square(DVec2::ZERO, 7.0, None)]);
    layers[3] = empty(3);
    assert_plans(&layers);
}

#[test]
fn a_model_that_stands_on_support_alone() {
    let mut layers = stack(6, &nested(DVec2::ZERO, &[8.0, 4.0]));
    for (index, gone) in layers.iter_mut().enumerate().take(3) {
        *gone = empty(index);
    }
    assert_plans(&layers);
}

#[test]
fn nothing_above_the_last_wall() {
    let mut layers = stack(6, &[square(DVec2::ZERO, 7.0, None)]);
    layers[4] = empty(4);
    layers[5] = empty(5);
    assert_plans(&layers);
}

#[test]
fn an_island_that_begins_in_mid_air() {
    let body = square(DVec2::ZERO, 6.0, None);
    let island = square(DVec2::new(16.0, 3.0), 3.0, None);
    let mut layers = stack(4, std::slice::from_ref(&body));
    layers.extend((4..8).map(|index| layer(index, vec![body.clone(), island.clone()])));
    assert_plans(&layers);
}

#[test]
fn islands_in_holes_in_islands() {
    let mut walls = nested(DVec2::ZERO, &[14.0, 10.5, 7.0, 3.0]);
    let beside = nested(DVec2::new(21.0, 0.0), &[5.0, 2.0]).into_iter();
    walls.extend(beside.map(|w| WallLoop { parent: w.parent.map(|p| p + 4), ..w }));
    assert_plans(&stack(4, &walls));
}

#[test]
fn a_hole_that_closes() {
    let open = nested(DVec2::ZERO, &[9.0, 5.0]);
    let shut = nested(DVec2::ZERO, &[9.0]);
    let mut layers = stack(3, &open);
    layers.extend((3..6).map(|index| layer(index, shut.clone())));
    assert_plans(&layers);
}

#[test]
fn walls_side_by_side() {
    for (name, walls) in [("columns", 3), ("table", 3), ("spire", 2)] {
        let (mesh, settings) = (sample(name), Settings { walls, ..Settings::default() });
        let plan = Planner::default()
            .plan(&mesh, &settings)
            .unwrap_or_else(|e| panic!("{name}, {walls} walls: {e}"));
        let report = audited(&plan, &mesh, &settings);
        assert!(report.is_sound(), "{name}, {walls} walls fall short\n{report}");
    }
}

#[test]
fn a_mesh_with_a_hole_is_planned_as_if_it_were_whole() {
    let whole = block(9.0, 9.0, 3.0);
    let torn = Mesh::new(whole.vertices().to_vec(), whole.triangles()[..10].to_vec()).expect("a mesh");
    let plan = |mesh: &Mesh| Planner::default().plan(mesh, &Settings::default()).expect("a plan");
    let (torn, whole) = (plan(&torn), plan(&whole));
    assert_eq!(torn.losses.len(), torn.strand.layers().len());
    assert!(
        torn.losses
            .iter()
            .all(|loss| matches!(loss, Loss::ClosedGap { gap, .. } if (gap - 9.0).abs() < 1e-9))
    );
    assert!((torn.strand.length_of(Role::Wall) - whole.strand.length_of(Role::Wall)).abs() < 1e-6);
}

#[test]
fn a_mesh_of_which_all_is_open_has_no_plan() {
    let whole = block(9.0, 9.0, 3.0);
    let sheet = Mesh::new(whole.vertices().to_vec(), whole.triangles()[4..6].to_vec()).expect("a mesh");
    let outcome = Planner::default().plan(&sheet, &Settings::default());
    assert!(matches!(outcome, Err(PlanError::Nothing)), "{outcome:?}");
}
