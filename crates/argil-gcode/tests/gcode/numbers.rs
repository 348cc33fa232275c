//! Numbered lines with checksums.

use argil_gcode::{GcodeSettings, read_gcode, write_gcode};
use proptest::prelude::*;

use crate::strands::waves;

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn numbered_lines_read_as_the_bare_ones(strand in waves()) {
        let bare = GcodeSettings { start: "G28 ; home".into(), ..GcodeSettings::default() };
        let numbered = GcodeSettings { line_numbers: true, ..bare.clone() };
        let text = write_gcode(&strand, &numbered).unwrap();
        for line in text.lines().filter(|line| !line.starts_with(';')) {
            let (code, sum) = line.rsplit_once('*').unwrap();
            prop_assert_eq!(code.bytes().fold(0, |sum, byte| sum ^ byte), sum.parse::<u8>().unwrap());
        }
        let moves = |settings| -> Vec<_> {
            let program = read_gcode(&write_gcode(&strand, settings).unwrap());
            program.moves.iter().map(|step| (step.from, step.to, step.extruded, step.layer, step.kind)).collect()
        };
        prop_assert_eq!(moves(&bare), moves(&numbered));
    }
}
