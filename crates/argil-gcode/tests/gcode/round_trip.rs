//! What is written is what was planned, and what is read is what was written.

use argil_gcode::{GcodeSettings, RoleNames, read_gcode, write_gcode};
use argil_strand::BeadShape;
use proptest::prelude::*;

use crate::strands::strands;

fn settings() -> impl Strategy<Value = GcodeSettings> {
    (any::<bool>(), prop::sample::select(vec![2.405, 1.0, 6.379, 403.0, 0.01]), any::<bool>(), 0..3usize)
        .prop_map(|(relative_e, mm3_per_e, boxed, words)| GcodeSettings {
            relative_e,
            mm3_per_e,
            bead: if boxed { BeadShape::Box } else { BeadShape::Rounded },
            names: [RoleNames::prusa_slicer(), RoleNames::cura(), RoleNames::orca_slicer()][words].clone(),
            ..GcodeSettings::default()
        })
}

/// The places that a layer's moves pass, from wherever the strand was before, each once in a row.
fn passed(points: impl IntoIterator<Item = [f64; 3]>) -> Vec<[f64; 3]> {
    let mut points: Vec<_> = points.into_iter().collect();
    points.dedup_by(|a, b| a.iter().zip(b.iter()).all(|(a, b)| (a - b).abs() < 1e-6));
    points
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_written_is_read_again(strand in strands(1e-4, 600_000), settings in settings()) {
        let program = read_gcode(&write_gcode(&strand, &settings).unwrap());
        prop_assert!(program.bad_lines.is_empty());
        let laid: Vec<_> = program.moves.iter().filter(|step| step.extruded != 0.0).collect();
        let steps: Vec<_> = strand.steps().filter(|step| step.from != step.to).collect();
        prop_assert_eq!(laid.len(), steps.len());
        for (laid, step) in laid.iter().zip(&steps) {
            prop_assert!(step.to.distance(laid.to.into()) < 1e-9 && step.from.distance(laid.from.into()) < 1e-9);
            prop_assert_eq!(laid.layer, Some(strand.layers()[step.layer].index as i64));
            let word = program.kind_of(laid).unwrap();
            prop_assert_eq!(settings.names.role(word), Some(step.role));
        }
        let paste = program.extruded() * settings.mm3_per_e;
        let volume = strand.volume_as(settings.bead);
        prop_assert!((paste - volume).abs() < 1e-4 * settings.mm3_per_e.min(1.0) + 1e-9 * volume, "{} {}", paste, volume);
    }

    #[test]
    fn nothing_is_dry_between_first_and_last_even_where_rounding_bites(
        strand in strands(3.1e-5, 9), mut settings in settings(), e_decimals in prop::option::of(0..4u8),
        decimals in 2..6u8,
    ) {
        settings.e_decimals = e_decimals;
        settings.decimals = decimals;
        let program = read_gcode(&write_gcode(&strand, &settings).unwrap());
        let laid = program.strand_moves();
        for step in laid {
            prop_assert!(step.extruded > 0.0 && step.from != step.to);
        }
        for pair in laid.windows(2) {
            prop_assert_eq!(pair[0].to, pair[1].from);
            prop_assert!(pair[1].to[2] >= pair[0].to[2]);
        }
        let grid = 10f64.powi(-i32::from(decimals));
        for layer in strand.layers() {
            let own = laid.iter().filter(|step| step.layer == Some(layer.index as i64));
            for point in own.map(|step| step.to) {
                let near = layer.moves.iter().any(|step| {
                    (step.to.x - point[0]).abs() < 0.51 * grid && (step.to.y - point[1]).abs() < 0.51 * grid
                });
                prop_assert!(near, "{:?} is no point of the layer", point);
            }
        }
    }

    #[test]
    fn points_off_the_grid_move_by_half_a_step_at_most(strand in strands(0.012_345_67, 4000)) {
        let program = read_gcode(&write_gcode(&strand, &GcodeSettings::default()).unwrap());
        let laid = program.moves.iter().filter(|step| step.extruded > 0.0);
        let written = passed(laid.map(|step| step.to));
        let planned = passed(strand.steps().filter(|step| step.from != step.to).map(|step| step.to.to_array()));
        prop_assert_eq!(written.len(), planned.len());
        for (a, b) in written.iter().zip(&planned) {
            prop_assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 0.5e-4 + 1e-9));
        }
    }
}
