//! Runs of points as arcs.

use argil_gcode::{GcodeSettings, read_gcode, write_gcode};
use argil_strand::{DVec2, Move, Role, Strand, StrandLayer};
use proptest::prelude::*;

use crate::strands::{helix, waves};

fn to_segment(p: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    let (p, a, b) = (DVec2::new(p[0], p[1]), DVec2::new(a[0], a[1]), DVec2::new(b[0], b[1]));
    let along = b - a;
    let square = along.length_squared();
    let t = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * t)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arcs_keep_to_their_tolerance_and_to_the_paste(strand in waves(), tolerance in 0.005..0.3f64, relative_e: bool) {
        let settings = GcodeSettings { arc_tolerance: Some(tolerance), relative_e, ..GcodeSettings::default() };
        let text = write_gcode(&strand, &settings).unwrap();
        let program = read_gcode(&text);
        prop_assert!(program.bad_lines.is_empty());
        let paste = program.extruded() * settings.mm3_per_e;
        prop_assert!((paste - strand.volume()).abs() < 1e-3 + 1e-9 * strand.volume());
        // The reader's chords are within its own tolerance of the arcs.
        let within = tolerance + argil_gcode::ARC_TOLERANCE + 3e-4;
        let laid: Vec<_> = program.moves.iter().filter(|step| step.extruded > 0.0).collect();
        let near = |p: [f64; 3]| laid.iter().any(|step| {
            (step.to[2] - p[2]).abs() < 1e-6 && to_segment(p, step.from, step.to) <= within
        });
        prop_assert!(strand.steps().all(|step| near(step.to.to_array())));
        let planned: Vec<_> = strand.steps().collect();
        for step in &laid {
            let close = planned.iter().any(|plan| {
                let (from, to) = (plan.from.to_array(), plan.to.to_array());
                (to[2] - step.to[2]).abs() < 1e-6 && to_segment(step.to, from, to) <= within
            });
            prop_assert!(close, "{:?}", step);
            let word = program.kind_of(step).unwrap();
            prop_assert!(settings.names.role(word).is_some());
        }
    }
}

#[test]
fn a_ring_becomes_few_arcs() {
    let count = 400;
    let at = |k: usize| DVec2::from_angle(std::f64::consts::TAU * (k % count) as f64 / count as f64) * 30.0;
    let moves = (1..=count).map(|k| Move { to: at(k), role: Role::Wall }).collect();
    let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves, supports: vec![] };
    let strand = Strand::new(at(0), vec![layer]).unwrap();
    let settings = GcodeSettings { arc_tolerance: Some(0.02), ..GcodeSettings::default() };
    let text = write_gcode(&strand, &settings).unwrap();
    let arcs = text.lines().filter(|line| line.starts_with("G3 ")).count();
    assert!((3..=5).contains(&arcs), "{arcs} arcs");
}

#[test]
fn a_helix_becomes_few_arcs_that_rise_evenly() {
    let strand = helix(4, 400);
    let settings = GcodeSettings { arc_tolerance: Some(0.02), ..GcodeSettings::default() };
    let text = write_gcode(&strand, &settings).unwrap();
    let rising = |line: &&str| line.starts_with("G3 ") && line.contains(" Z");
    let helical = text.lines().filter(rising).count();
    assert!((9..60).contains(&helical) && text.lines().count() < 400, "{helical} arcs that rise in {text}");
    let program = read_gcode(&text);
    assert!((program.extruded() * settings.mm3_per_e - strand.volume()).abs() < 1e-3);
    // Everywhere on the way up the nozzle is as high as the angle asks for.
    for step in program.strand_moves().iter().filter(|step| (2..=4).contains(&step.layer.unwrap())) {
        let turned = step.to[1].atan2(step.to[0]).rem_euclid(std::f64::consts::TAU) / std::f64::consts::TAU;
        let off = (step.to[2] / 0.5 - turned).rem_euclid(1.0);
        assert!(off.min(1.0 - off) < 0.06, "{step:?}: {off}");
    }
    // A bead that tapers is no arc of an even flow.
    let flows = |layer: i64| -> Vec<f64> {
        let own = program.strand_moves().iter().filter(|step| step.layer == Some(layer));
        own.filter(|step| step.planar_length() > 0.3)
            .map(|step| step.extruded / step.planar_length())
            .collect()
    };
    let (first, last) = (flows(1), flows(5));
    assert!(first[first.len() - 1] > 8.0 * first[0] && last[0] > 8.0 * last[last.len() - 1]);
    let bare = write_gcode(&strand, &GcodeSettings::default()).unwrap();
    let heights: Vec<f64> = read_gcode(&bare).strand_moves().iter().map(|step| step.to[2]).collect();
    assert!(heights.is_sorted() && heights.len() > 2000);
}
