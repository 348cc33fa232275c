//! Every dialect pushes out the paste of the strand.

use argil_gcode::{Extrusion, Flavour, GcodeError, GcodeSettings, Poses, read_gcode, write_gcode};
use argil_strand::{BeadShape, Strand};

use crate::strands::{helix, square};

#[test]
fn volumetric_e_is_the_volume_and_is_switched_off_again() {
    let strand = square(8.0);
    let settings = GcodeSettings {
        extrusion: Extrusion::Volumetric { diameter: 1.75 },
        end: "M84".into(),
        ..GcodeSettings::default()
    };
    let text = write_gcode(&strand, &settings).unwrap();
    assert!(text.contains("\nM200 D1.75 ") && text.ends_with("M200 D0\nM84\n"), "{text}");
    assert!((read_gcode(&text).extruded() - strand.volume()).abs() < 1e-4);
    let klipper = GcodeSettings { flavour: Flavour::Klipper, ..settings };
    assert!(matches!(write_gcode(&strand, &klipper), Err(GcodeError::Dialect { .. })));
}

#[test]
fn a_constant_rate_keeps_the_bead_by_speed_alone() {
    let strand = square(8.0);
    let settings = GcodeSettings {
        extrusion: Extrusion::Constant { rate: 7.5 },
        bead: BeadShape::Box,
        ..GcodeSettings::default()
    };
    let text = write_gcode(&strand, &settings).unwrap();
    assert!(text.contains("G1 X8 Y0 F600\nG1 X8 Y8\n"), "{text}");
    assert!(
        !text.contains('E') || text.lines().filter(|l| l.contains('E')).all(|l| l.starts_with(';')),
        "{text}"
    );
}

#[test]
fn a_constant_rate_is_spread_along_what_rises() {
    let strand = helix(3, 60);
    let rate = 20.0;
    let settings = GcodeSettings { extrusion: Extrusion::Constant { rate }, ..GcodeSettings::default() };
    for step in strand.steps() {
        let paste = settings.speed_of(&strand, &step) * settings.bead.area(1.5, step.height.max(0.125));
        assert!((paste - rate).abs() < 1e-9);
    }
    assert!(write_gcode(&strand, &settings).unwrap().matches(" F").count() > 60);
}

#[test]
fn paste_follows_the_width_of_each_bead() {
    let whole = square(8.0);
    let widths = whole.layers().iter().map(|layer| vec![0.8 * layer.width; layer.moves.len()]).collect();
    let slender = whole.clone().of_widths(widths).unwrap();
    let settings = GcodeSettings { bead: BeadShape::Box, ..GcodeSettings::default() };
    let pushed = |strand: &Strand| {
        let file = read_gcode(&write_gcode(strand, &settings).unwrap());
        file.strand_moves().iter().map(|step| step.extruded).sum::<f64>()
    };
    assert!((pushed(&slender) / pushed(&whole) - 0.8).abs() < 1e-3);
    let constant = GcodeSettings { extrusion: Extrusion::Constant { rate: 20.0 }, ..settings };
    for (thin, wide) in slender.steps().zip(whole.steps()) {
        let ratio = constant.speed_of(&slender, &thin) / constant.speed_of(&whole, &wide);
        assert!((ratio - 1.25).abs() < 1e-9);
    }
}

#[test]
fn poses_have_the_paste_of_the_strand() {
    let strand = square(8.0);
    let table = Poses::new(&strand, &GcodeSettings::default()).unwrap().to_string();
    let mut rows = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = rows.next().unwrap();
    let column = |row: &[&str], name: &str| -> f64 {
        row[names.iter().position(|&other| other == name).unwrap()].parse().unwrap()
    };
    let rows: Vec<_> = rows.collect();
    let paste: f64 = rows
        .windows(2)
        .map(|pair| {
            let gone = |axis| column(&pair[1], axis) - column(&pair[0], axis);
            let length = gone("x_mm").hypot(gone("y_mm")).hypot(gone("z_mm"));
            length / column(&pair[1], "speed_mm_s") * column(&pair[1], "flow_mm3_s")
        })
        .sum();
    assert!((paste - strand.volume()).abs() < 1e-3, "{paste}");
}
