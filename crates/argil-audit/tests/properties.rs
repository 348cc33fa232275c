//! What holds of every audit.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use argil_audit::gcode::read_gcode;
use argil_audit::mesh::Mesh;
use argil_audit::{AuditSettings, Figures, Report, audit};
use proptest::prelude::*;
use std::fmt::Write;

/// A box from the origin to `size`, moved by `offset`.
fn block(size: [f64; 3], offset: [f64; 2]) -> Mesh {
    let [x, y] = offset;
    Mesh::cuboid([x, y, 0.0], [x + size[0], y + size[1], size[2]]).unwrap()
}

/// Layers of loops as g-code, scaled and then moved; moves whose running number is in `dry` lay nothing.
fn text(layers: &[Vec<(f64, f64)>], height: f64, scale: f64, offset: [f64; 2], dry: &[usize]) -> String {
    let mut text = String::from("M83\n");
    let mut count = 0;
    for (k, points) in layers.iter().enumerate() {
        writeln!(text, ";LAYER:{k}\nG1 Z{:.9}", (k + 1) as f64 * height * scale).unwrap();
        for &(x, y) in points {
            let e = if (k, count) == (0, 0) || dry.contains(&count) { "" } else { " E1" };
            writeln!(text, "G1 X{:.9} Y{:.9}{e}", x * scale + offset[0], y * scale + offset[1]).unwrap();
            count += 1;
        }
    }
    text
}

/// A wall loop in a box of 20 mm, with an excursion through some points.
fn layer() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((-8.0..28.0, -8.0..28.0), 0..4).prop_map(|excursion| {
        let wall = [(0.75, 0.75), (19.25, 0.75), (19.25, 19.25), (0.75, 19.25), (0.75, 0.75)];
        wall.into_iter().chain(excursion).chain([(0.75, 0.75)]).collect()
    })
}

fn audited(layers: &[Vec<(f64, f64)>], scale: f64, offset: [f64; 2], known: bool) -> Report {
    let height = 0.5;
    let top = layers.len() as f64 * height * scale;
    let program = read_gcode(&text(layers, height, scale, offset, &[]));
    let mesh = block([20.0 * scale, 20.0 * scale, top], if known { [0.0; 2] } else { offset });
    let settings = AuditSettings {
        layer_height: height * scale,
        offset: if known { offset } else { [0.0; 2] },
        ..AuditSettings::for_width(1.5 * scale)
    };
    audit(&program, &mesh, &settings).unwrap()
}

/// Figures that are counts, and those without a length in them, to compare prints of different scale.
fn shape(f: &Figures) -> ([usize; 8], [f64; 8]) {
    let counts = [
        f.layers,
        f.open_layers,
        f.self_crossings,
        f.wall_crossings,
        f.unsupported_spans,
        f.sharp_turns_nonmodel,
        f.paths_per_layer_max,
        f.seam_starts_unsupported,
    ];
    let shares = [
        f.material_ratio,
        f.model_missed_fraction,
        f.contour_uncovered_fraction,
        f.unsupported_fraction,
        f.contact_per_model_mm,
        f.doubled_per_model_mm,
        f.overdeposit,
        f.overdeposit_apart_from_roots,
    ];
    (counts, shares)
}

fn same_shape(a: &Figures, b: &Figures) -> Result<(), TestCaseError> {
    let ((counts_a, shares_a), (counts_b, shares_b)) = (shape(a), shape(b));
    prop_assert_eq!(counts_a, counts_b);
    for (x, y) in shares_a.into_iter().zip(shares_b) {
        // One sample at the brink of a tolerance may fall to either side.
        prop_assert!((x - y).abs() < 5e-3, "{:?} {:?}", shares_a, shares_b);
    }
    Ok(())
}

#[test]
fn a_way_there_and_back_is_swept_alike_at_any_scale() {
    // By rounding the turn at the tip came out at less than −180° at one scale alone, and its round end was lost.
    let wall = [(0.75, 0.75), (19.25, 0.75), (19.25, 19.25), (0.75, 19.25), (0.75, 0.75)];
    let tip = (-2.394_428_139_668_166, 1.029_087_981_349_024);
    let layer = vec![wall.into_iter().chain([tip, (0.75, 0.75)]).collect()];
    let at = |scale: f64| audited(&layer, scale, [0.0; 2], false).figures.doubled_per_model_mm;
    assert!((at(1.0) - at(0.6176)).abs() < 1e-6, "{} {}", at(1.0), at(0.6176));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn lengths_add_up(layers in prop::collection::vec(layer(), 1..4)) {
        let figures = audited(&layers, 1.0, [0.0; 2], false).figures;
        let parts = figures.model_mm + figures.nonmodel_mm + figures.fill_mm;
        prop_assert!((parts - figures.path_mm).abs() < 1e-6 * figures.path_mm);
        let length = |(a, b): ((f64, f64), (f64, f64))| (a.0 - b.0).hypot(a.1 - b.1);
        let laid: f64 = layers
            .iter()
            .map(|points| points.iter().copied().zip(points.iter().skip(1).copied()).map(length).sum::<f64>())
            .sum();
        prop_assert!((laid - figures.path_mm).abs() < 1e-6 * laid);
        prop_assert!(figures.overdeposit < 1.0 && figures.unsupported_fraction <= 1.0);
    }

    #[test]
    fn the_place_does_not_matter(
        layers in prop::collection::vec(layer(), 1..4),
        x in -300.0..300.0,
        y in -300.0..300.0,
    ) {
        let here = audited(&layers, 1.0, [0.0; 2], false).figures;
        same_shape(&here, &audited(&layers, 1.0, [x, y], false).figures)?;
        same_shape(&here, &audited(&layers, 1.0, [x, y], true).figures)?;
    }

    #[test]
    fn the_scale_does_not_matter(layers in prop::collection::vec(layer(), 1..3), scale in 0.2_f64..20.0) {
        same_shape(&audited(&layers, 1.0, [0.0; 2], false).figures, &audited(&layers, scale, [0.0; 2], false).figures)?;
    }

    #[test]
    fn every_dry_move_is_seen(dry in prop::collection::btree_set(2_usize..18, 0..4)) {
        // Layers of six moves, of which the first and the last of the file lay clay.
        let wall = vec![(0.75, 0.75), (9.0, 0.75), (19.25, 0.75), (19.25, 19.25), (0.75, 19.25), (0.75, 0.75)];
        let dry: Vec<usize> = dry.into_iter().filter(|&k| k % 6 != 0 && k != 17).collect();
        let program = read_gcode(&text(&vec![wall; 3], 0.5, 1.0, [0.0; 2], &dry));
        let report = audit(&program, &block([20.0, 20.0, 1.5], [0.0; 2]), &AuditSettings::default()).unwrap();
        // Those that follow one another are one; the move up between two layers parts them.
        let runs = dry.iter().filter(|&&k| !dry.contains(&(k - 1))).count();
        prop_assert_eq!(report.figures.transfer_moves, runs);
        prop_assert_eq!(report.is_sound(), runs == 0);
    }

    #[test]
    fn no_text_and_no_setting_panics(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "G0", "G1", "G92", "G2 I1", "M82", "M83", "G91", "\n", "\n;LAYER:3\n", "\n;LAYER:-9999999999\n",
                "\n;TYPE:SKIN\n", "\n;TYPE:SKIRT\n", " X1", " X-12", " Y7.5", " Y0", " Z9", " Z.5", " E3", " E-2", " E0",
                " X4e5", " Y1e300", " E1e308", ";", "N4 ",
            ]),
            0..60,
        ),
        width in prop::sample::select(vec![1.5, 1e-3, 0.0, -1.0, 40.0, f64::NAN, f64::INFINITY]),
        walls in 0_usize..4,
    ) {
        let settings = AuditSettings { walls, layer_height: 0.5, ..AuditSettings::for_width(width) };
        let report = audit(&read_gcode(&words.concat()), &block([20.0, 20.0, 3.0], [0.0; 2]), &settings);
        if let Ok(report) = report {
            prop_assert!(report.figures.path_mm.is_finite());
            prop_assert!(report.to_string().contains("path_mm"));
        }
    }
}
