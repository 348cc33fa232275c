//! Test prints are sound where they are easy, ask what they say where they are hard, and never stop.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use argil_calibrate::{CalibrateError, Calibration, DVec2, GAPS, LEANS, Strand, legend_svg};
use argil_gcode::{GcodeSettings, read_gcode, write_gcode};
use argil_support::{ClosedCurve, Criterion, SegmentIndex, unsupported_spans};
use proptest::prelude::*;

fn calibrations() -> impl Strategy<Value = Calibration> {
    let place = (-300.0..300.0f64, -300.0..300.0f64);
    (0.4..12.0f64, 0.1..0.9f64, place).prop_map(|(width, share, (x, y))| Calibration {
        width,
        layer_height: share * width,
        centre: DVec2::new(x, y),
        mm3_per_e: Some(2.405),
        ..Calibration::default()
    })
}

fn prints(calibration: &Calibration) -> [Strand; 3] {
    [calibration.fan(), calibration.windows(), calibration.ring()].map(Result::unwrap)
}

fn curve(print: &Strand, layer: usize) -> ClosedCurve {
    let mut points = print.polyline(layer);
    points.pop();
    ClosedCurve::new(points).unwrap()
}

/// Middles of the stretches of a layer that hang, and their lengths.
fn hanging(print: &Strand, layer: usize, criterion: &Criterion) -> Vec<(DVec2, f64)> {
    let (above, below) = (curve(print, layer), curve(print, layer - 1));
    let index = SegmentIndex::of_curves([&below], print.layers()[0].width);
    let spans = unsupported_spans(&above, &index, criterion);
    spans.iter().map(|span| (above.point_at(span.start + span.length / 2.0), span.length)).collect()
}

/// The sector of the fan in which a point lies.
fn sector(calibration: &Calibration, at: DVec2) -> usize {
    let turn = (at - calibration.centre).to_angle().rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
    ((turn * LEANS.len() as f64) as usize).min(LEANS.len() - 1)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn prints_are_one_strand_without_a_transfer(calibration in calibrations()) {
        let in_volume = GcodeSettings { mm3_per_e: 1.0, ..GcodeSettings::default() };
        for print in prints(&calibration) {
            let program = read_gcode(&write_gcode(&print, &in_volume).unwrap());
            let wet = |k: &usize| program.moves[*k].extruded > 0.0;
            let all: Vec<usize> = (0..program.moves.len()).collect();
            let first = all.iter().copied().find(wet).unwrap();
            let last = all.iter().copied().rfind(wet).unwrap();
            prop_assert!(last - first > 100);
            prop_assert!((first..=last).all(|k| wet(&k)));
            let paste: f64 = program.moves.iter().map(|step| step.extruded).sum();
            prop_assert!((paste / print.volume() - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn no_print_crosses_itself(calibration in calibrations()) {
        for print in prints(&calibration) {
            for layer in 0..print.layers().len() {
                let curve = curve(&print, layer);
                let segments: Vec<_> = curve.segments().collect();
                for (k, a) in segments.iter().enumerate() {
                    for b in segments.iter().skip(k + 2) {
                        prop_assert!(!a.crosses(b));
                    }
                }
            }
        }
    }

    #[test]
    fn a_sector_is_held_by_pastes_that_bear_its_lean(calibration in calibrations(), paste in 0..LEANS.len()) {
        let print = calibration.fan().unwrap();
        let width = calibration.width;
        // Halfway to the next lean, so that no rounding decides.
        let criterion = Criterion { across: (LEANS[paste] + 0.05) * width, along: 2.0 * width };
        let hangs = hanging(&print, print.layers().len() - 1, &criterion);
        let sectors: Vec<usize> = hangs.iter().map(|&(at, _)| sector(&calibration, at)).collect();
        prop_assert!(sectors.iter().all(|&sector| sector > paste), "{sectors:?}");
        prop_assert!((paste + 1..LEANS.len()).all(|harder| sectors.contains(&harder)), "{sectors:?}");
    }

    #[test]
    fn a_window_is_as_wide_as_it_says(calibration in calibrations()) {
        let print = calibration.windows().unwrap();
        let width = calibration.width;
        let lintel = 4;
        // At half a bead the rule of support measures from edge to edge.
        let criterion = Criterion { across: 0.5 * width, along: 0.0 };
        let mut clear: Vec<f64> = hanging(&print, lintel, &criterion).iter().map(|(_, long)| long / width).collect();
        clear.sort_by(f64::total_cmp);
        prop_assert_eq!(clear.len(), GAPS.len());
        prop_assert!(clear.iter().zip(GAPS).all(|(found, told)| (found - told).abs() < 1e-6), "{clear:?}");
        for layer in (1..print.layers().len()).filter(|&layer| layer != lintel) {
            let still = Criterion { across: 1e-6 * width, along: 1e-3 * width };
            prop_assert!(hanging(&print, layer, &still).is_empty());
        }
    }

    #[test]
    fn the_ring_stands_upright_and_steps_are_short(calibration in calibrations()) {
        let print = calibration.ring().unwrap();
        let still = Criterion { across: 1e-6 * calibration.width, along: 1e-3 * calibration.width };
        for layer in 1..print.layers().len() {
            prop_assert!(hanging(&print, layer, &still).is_empty());
        }
        for print in prints(&calibration) {
            for layer in 1..print.layers().len() {
                let (from, to) = (print.seam(layer - 1).unwrap(), print.seam(layer).unwrap());
                prop_assert!(from.distance(to) < 1.01 * calibration.width);
            }
        }
    }

    #[test]
    fn numbers_that_cannot_be_are_refused(width in prop::num::f64::ANY, height in prop::num::f64::ANY, x in prop::num::f64::ANY) {
        let calibration = Calibration { width, layer_height: height, centre: DVec2::new(x, 0.0), ..Calibration::default() };
        for print in [calibration.fan(), calibration.windows(), calibration.ring()] {
            match print {
                Ok(print) => prop_assert!(print.volume() > 0.0),
                Err(error) => {
                    let refused = matches!(error, CalibrateError::Setting { .. });
                    prop_assert!(refused, "{error}");
                }
            }
        }
    }
}

#[test]
fn the_legend_has_a_line_for_every_reading() {
    let calibration = Calibration { mm3_per_e: Some(2.0), ..Calibration::default() };
    let legend = legend_svg(&calibration).unwrap();
    assert_eq!(legend.matches("overhang = { value = ").count(), LEANS.len() - 1);
    assert_eq!(legend.matches("bridge = { value = ").count(), GAPS.len());
    // The paper's clay: 0.3 bead widths a layer at 1.5 × 0.5 mm are 42°.
    assert!(legend.contains("overhang = { value = 42,") && legend.contains("bridge = { value = 1.6,"));
    assert!(legend.contains("mm3_per_e = { value = 2.0000,"));
    assert!(!legend_svg(&Calibration::default()).unwrap().contains("mm3_per_e"));
}
