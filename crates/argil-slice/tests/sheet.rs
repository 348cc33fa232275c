//! What holds of sheets: walls run along their sections and nowhere else, cross nothing, and tell of ends.

use std::f64::consts::TAU;

use argil_curve::{DVec2, Segment, SegmentIndex, self_crossings};
use argil_slice::mesh::Mesh;
use argil_slice::{Layer, Loss, SliceError, SliceSettings, slice};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const WIDTH: f64 = 1.5;
const HEIGHT: f64 = 4.0;

/// An upright sheet over each of these polylines; closed ones repeat their first point.
fn upright(lines: &[Vec<DVec2>]) -> Mesh {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for line in lines {
        let first = u32::try_from(vertices.len()).expect("a few points");
        let closed = line.first() == line.last();
        let own = if closed { &line[1..] } else { &line[..] };
        vertices.extend(own.iter().flat_map(|p| [[p.x, p.y, 0.0], [p.x, p.y, HEIGHT]]));
        let count = u32::try_from(own.len()).expect("a few points");
        let squares = (0..count - u32::from(!closed)).map(|k| (first + 2 * k, first + 2 * ((k + 1) % count)));
        triangles.extend(squares.flat_map(|(a, b)| [[a, b, b + 1], [a, b + 1, a + 1]]));
    }
    Mesh::new(vertices, triangles).expect("a sheet is a mesh")
}

/// A closed wave about a point.
fn wave(radius: f64, ribs: u32, depth: f64, at: DVec2) -> Vec<DVec2> {
    let point = |k: u32| {
        let angle = TAU * f64::from(k % 180) / 180.0;
        at + radius * (1.0 + depth * (f64::from(ribs) * angle).cos()) * DVec2::from_angle(angle)
    };
    (0..=180).map(point).collect()
}

fn sides(lines: &[Vec<DVec2>]) -> SegmentIndex {
    SegmentIndex::new(
        lines.iter().flat_map(|l| l.windows(2)).map(|e| Segment::new(e[0], e[1])).collect(),
        WIDTH,
    )
}

/// The walls of a layer, each with its first point again at the end.
fn walls(layer: &Layer) -> Vec<Vec<DVec2>> {
    let closed = |points: &Vec<DVec2>| points.iter().chain(points.first()).copied().collect();
    layer.walls.iter().map(|wall| closed(&wall.points)).collect()
}

fn settings() -> SliceSettings {
    SliceSettings { surface: true, ..SliceSettings::default() }
}

/// That the walls run along these lines, all of them, and nowhere else.
fn along(layers: &[Layer], lines: &[Vec<DVec2>]) -> Result<(), TestCaseError> {
    let section = sides(lines);
    for layer in layers {
        let laid = walls(layer);
        for wall in &layer.walls {
            prop_assert!(self_crossings(&wall.points).is_empty());
        }
        let index = sides(&laid);
        let far = |points: &[DVec2], from: &SegmentIndex| {
            points.iter().map(|&p| from.distance(p)).fold(0.0, f64::max)
        };
        for line in lines {
            prop_assert!(
                far(line, &index) < 0.05 * WIDTH,
                "{} mm without a wall: {:?}, {} walls",
                far(line, &index),
                layer.losses,
                laid.len()
            );
        }
        for wall in &laid {
            prop_assert!(far(wall, &section) < 0.06 * WIDTH, "a wall {} mm off", far(wall, &section));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, rng_seed: RngSeed::Fixed(3), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn closed_sections_are_loops(radius in 6.0..30.0, ribs in 2_u32..9, depth in 0.0..0.12, inner in 0.3..0.6) {
        let lines = [wave(radius, ribs, depth, DVec2::ZERO), wave(inner * radius, 3, 0.05, DVec2::ZERO)];
        let layers = slice(&upright(&lines), &settings()).unwrap();
        prop_assert_eq!(layers.len(), 8);
        along(&layers, &lines)?;
        for layer in &layers {
            prop_assert_eq!(layer.walls.iter().map(|wall| wall.parent).collect::<Vec<_>>(), [None, Some(0)]);
            prop_assert!(layer.losses.is_empty(), "{:?}", layer.losses);
        }
    }

    #[test]
    fn open_sections_are_gone_along_twice(
        lines in prop::collection::vec(((-30.0..30.0, -30.0..30.0), 0.0..TAU, 4.0..12.0), 1..4),
    ) {
        // Side by side, 40 mm apart.
        let lines: Vec<Vec<DVec2>> = lines
            .into_iter()
            .enumerate()
            .map(|(k, ((_, y), turn, length))| {
                let from = DVec2::new(40.0 * k as f64, y);
                (0..=9).map(|t| from + length * f64::from(t) / 9.0 * DVec2::from_angle(turn + 0.05 * f64::from(t))).collect()
            })
            .collect();
        let layers = slice(&upright(&lines), &settings()).unwrap();
        along(&layers, &lines)?;
        for layer in &layers {
            prop_assert_eq!(layer.walls.len(), lines.len());
            let told = layer.losses.iter().filter(|loss| matches!(loss, Loss::OpenSheet { .. })).count();
            prop_assert_eq!(told, lines.len());
        }
    }

    /// A fin that meets its vessel, or stands in it.
    #[test]
    fn a_wall_turns_off_along_a_fin(from in 0.2..1.4, to in 0.2..1.4, turn in 0.0..TAU) {
        let along_ray = |share: f64| 20.0 * share * DVec2::from_angle(turn);
        prop_assume!(f64::abs(to - from) > 0.2 && f64::abs(from - 1.0) > 0.05 && f64::abs(to - 1.0) > 0.05);
        let lines = [wave(20.0, 5, 0.03, DVec2::ZERO), vec![along_ray(from), along_ray(to)]];
        let layers = slice(&upright(&lines), &settings()).unwrap();
        along(&layers, &lines)?;
    }
}

#[test]
fn a_sheet_has_one_wall() {
    let mesh = upright(&[wave(10.0, 3, 0.0, DVec2::ZERO)]);
    let refused = slice(&mesh, &SliceSettings { walls: 2, ..settings() });
    assert_eq!(refused, Err(SliceError::SheetWalls { walls: 2 }));
}
