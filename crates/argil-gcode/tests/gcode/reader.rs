//! Modes and comments of any program are followed, and no text stops the reader.

use argil_gcode::{Fault, read_gcode};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_text_stops_the_reader(text in "(?s).{0,300}") {
        let program = read_gcode(&text);
        prop_assert!(program.moves.iter().all(|step| step.to.iter().all(|value| value.is_finite())));
    }

    #[test]
    fn no_code_stops_the_reader(lines in prop::collection::vec(
        ("[GM;]", prop::sample::select(vec!["0", "1", "2", "3", "20", "82", "83", "90", "91", "92", "LAYER:", "TYPE:"]),
         "( ?[XYZEIJRF]-?[0-9]{1,3}(\\.[0-9]{1,3})?(e[0-9]{1,3})?){0,5}"), 0..30)) {
        let text: String = lines.iter().map(|(a, b, c)| format!("{a}{b}{c}\n")).collect();
        let program = read_gcode(&text);
        prop_assert!(program.moves.iter().all(|step| step.to.iter().all(|value| value.is_finite())));
        prop_assert!(program.moves.iter().all(|step| step.line >= 1 && step.line <= lines.len()));
    }
}

#[test]
fn modes_offsets_and_arcs_are_followed() {
    let program = read_gcode(
        "G90\nM82\nG92 X1 Y2 Z3 E4\nG1 X2 E5\nG91\nG0 X1\nM83\nG1 Y1 E-2\nG90\nG3 X13 Y3 I5 J0 E1\nG2 X0 Y0 R1\nG20",
    );
    assert_eq!(program.moves[0].from, [1.0, 2.0, 3.0]);
    assert_eq!((program.moves[0].to, program.moves[0].extruded), ([2.0, 2.0, 3.0], 1.0));
    assert_eq!(program.moves[1].to, [3.0, 2.0, 3.0]);
    assert_eq!((program.moves[2].to, program.moves[2].extruded), ([3.0, 3.0, 3.0], -2.0));
    let arc: Vec<_> = program.moves.iter().filter(|step| step.line == 10).collect();
    assert!(arc.len() > 10 && arc.iter().all(|step| step.to[1] < 3.0 + 1e-9));
    let length: f64 = arc.iter().map(|step| step.planar_length()).sum();
    assert!((length - 5.0 * std::f64::consts::PI).abs() < 0.1);
    assert!((arc.iter().map(|step| step.extruded).sum::<f64>() - 1.0).abs() < 1e-12);
    let faults: Vec<_> = program.bad_lines.iter().map(|bad| (bad.line, bad.fault)).collect();
    assert_eq!(faults, [(11, Fault::BadArc), (12, Fault::Inches)]);
    assert_eq!(program.moves.last().unwrap().to, [0.0, 0.0, 3.0]);
}

#[test]
fn layer_comments_are_read_in_every_form() {
    let program =
        read_gcode(";LAYER_CHANGE\nG1 X1\n; layer:7 of 9\nG1 X2\r\n;LAYER_CHANGE\rG1 X3\n;LAYER:x\nG1 X4");
    let layers: Vec<_> = program.moves.iter().map(|step| step.layer).collect();
    assert_eq!(layers, [Some(0), Some(7), Some(8), Some(8)]);
    assert_eq!(program.moves[2].line, 6);
}
