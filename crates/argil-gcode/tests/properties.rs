//! What is written is what was planned, what is read is what was written, and no text stops the reader.
#![allow(clippy::unwrap_used)]

use argil_gcode::{
    Extrusion, Fault, Flavour, GcodeError, GcodeSettings, Poses, RoleNames, read_gcode, write_gcode,
};
use argil_strand::{BeadShape, DVec2, Move, Rise, Role, Strand, StrandLayer};
use proptest::prelude::*;

const ROLES: [Role; 4] = [Role::Wall, Role::Support, Role::Connection, Role::Fill];

/// Strands with points on a grid of `step` mm; a coarse grid makes many points coincide.
fn strands(step: f64, reach: i32) -> impl Strategy<Value = Strand> {
    (level_strands(step, reach), any::<bool>())
        .prop_map(|(strand, rises)| if rises { risen(strand) } else { strand })
}

/// The same strand, its layers rising evenly but for the lowest and the uppermost, on a grid of 1e-4 mm.
fn risen(strand: Strand) -> Strand {
    let mut below = strand.layers()[0].z;
    let last = strand.layers().len() - 1;
    let rise = |(k, layer): (usize, &StrandLayer)| {
        let (from, count) = (std::mem::replace(&mut below, layer.z), layer.moves.len() as f64);
        let at = |n: usize| {
            let share = (n + 1) as f64 / count;
            let z = ((from + (layer.z - from) * share) * 1e4).round() / 1e4;
            Rise { z, height: layer.height * (0.5 + 0.5 * share) }
        };
        if k == 0 || k == last { Vec::new() } else { (0..layer.moves.len()).map(at).collect() }
    };
    let rises = strand.layers().iter().enumerate().map(rise).collect();
    strand.risen(rises).unwrap()
}

fn level_strands(step: f64, reach: i32) -> impl Strategy<Value = Strand> {
    let point = (-reach..reach, -reach..reach)
        .prop_map(move |(x, y)| DVec2::new(f64::from(x) * step, f64::from(y) * step));
    let cycle = prop::collection::vec((point, 0..4usize), 1..12);
    prop::collection::vec((cycle, 1..40u32, 0.3..4.0f64, 1..3usize), 1..6).prop_map(|cycles| {
        let start = cycles[0].0[0].0;
        let (mut z, mut index) = (0.0, 0);
        let mut layers = Vec::new();
        for (cycle, height, width, skip) in cycles {
            let height = f64::from(height) * 0.05;
            z += height;
            index += skip;
            let seam = cycle[0].0;
            let rise = (!layers.is_empty()).then_some(Move { to: seam, role: Role::Seam });
            let turn = cycle[1..].iter().map(|&(to, role)| Move { to, role: ROLES[role] });
            let back = Move { to: seam, role: Role::Wall };
            let moves = rise.into_iter().chain(turn).chain([back]).collect();
            layers.push(StrandLayer { index, z, height, width, moves, supports: vec![] });
        }
        Strand::new(start, layers).unwrap()
    })
}

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

fn square(side: f64) -> Strand {
    let corners = [(side, 0.0), (side, side), (0.0, side), (0.0, 0.0)];
    let moves = corners.map(|(x, y)| Move { to: DVec2::new(x, y), role: Role::Wall }).to_vec();
    let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves, supports: vec![] };
    Strand::new(DVec2::ZERO, vec![layer]).unwrap()
}

#[test]
fn the_file_is_what_its_description_says() {
    let settings = GcodeSettings {
        generator: "a planner".into(),
        header: vec![("epsilon_across".into(), "0.45 mm".into())],
        start: "G28".into(),
        end: "M84".into(),
        mm3_per_e: 1.0,
        bead: BeadShape::Box,
        ..GcodeSettings::default()
    };
    let expected = "\
; generated by a planner
; epsilon_across = 0.45 mm
;LAYER_COUNT:1
G28
G21 ; millimetres
G90 ; absolute coordinates
M83 ; E
G92 E0
G1 Z5.5 F1500
G1 X0 Y0
G1 Z0.5
;LAYER_CHANGE
;Z:0.5
;HEIGHT:0.5
;LAYER:0
;WIDTH:1.5
;TYPE:External perimeter
G1 X8 Y0 E6 F900
G1 X8 Y8 E6
G1 X0 Y8 E6
G1 X0 Y0 E6
G1 Z5.5 F1500
M84
";
    assert_eq!(write_gcode(&square(8.0), &settings).unwrap(), expected);
}

#[test]
fn comments_cannot_smuggle_code_or_layers() {
    for (key, value) in [("a\nG1 X0", "b"), ("a", "b\rG1"), ("LAYER:3", ""), ("layer_change", ""), (" ", "b")]
    {
        let settings = GcodeSettings { header: vec![(key.into(), value.into())], ..GcodeSettings::default() };
        let refused = write_gcode(&square(8.0), &settings);
        assert!(matches!(refused, Err(GcodeError::Comment { .. })), "{key:?} {value:?}");
    }
}

#[test]
fn settings_that_cannot_extrude_are_refused() {
    let with = |change: &dyn Fn(&mut GcodeSettings)| {
        let mut settings = GcodeSettings::default();
        change(&mut settings);
        write_gcode(&square(8.0), &settings).unwrap_err()
    };
    for error in [
        with(&|s| s.mm3_per_e = 0.0),
        with(&|s| s.mm3_per_e = f64::NAN),
        with(&|s| s.feed = -1.0),
        with(&|s| s.lift = f64::INFINITY),
        with(&|s| s.decimals = 7),
        with(&|s| s.e_decimals = Some(10)),
    ] {
        assert!(matches!(error, GcodeError::Setting { .. }), "{error}");
    }
    let far = write_gcode(&square(1e15), &GcodeSettings::default());
    assert!(matches!(far, Err(GcodeError::OutOfRange { layer: 0, .. })));
}

#[test]
fn layers_that_rounding_would_merge_are_refused() {
    let layer = |index, z, moves| StrandLayer { index, z, height: 0.5, width: 1.5, moves, supports: vec![] };
    let square = square(8.0);
    let turn = square.layers()[0].moves.clone();
    let seam = Move { to: DVec2::ZERO, role: Role::Seam };
    let above = [seam].into_iter().chain(turn.clone()).collect();
    let strand = Strand::new(DVec2::ZERO, vec![layer(0, 0.5, turn), layer(1, 0.500_01, above)]).unwrap();
    let refused = write_gcode(&strand, &GcodeSettings::default());
    assert_eq!(refused, Err(GcodeError::LayersMerge { layer: 1, z: 0.500_01, decimals: 4 }));
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

/// Wavy rings with many points: runs of arcs, with corners between.
fn waves() -> impl Strategy<Value = Strand> {
    (3..9u32, 0.0..0.5f64, 40..200usize, 5.0..60.0f64).prop_map(|(lobes, depth, count, radius)| {
        let at = |k: usize| {
            let angle = std::f64::consts::TAU * (k % count) as f64 / count as f64;
            DVec2::from_angle(angle) * radius * (1.0 + depth * (angle * f64::from(lobes)).sin().abs())
        };
        let roles = |k: usize| if k % 37 < 9 { Role::Support } else { Role::Wall };
        let turn: Vec<Move> = (1..=count).map(|k| Move { to: at(k), role: roles(k) }).collect();
        let layer = |k: usize| StrandLayer {
            index: k,
            z: 0.5 * (k as f64 + 1.0),
            height: 0.5,
            width: 1.5,
            moves: (k > 0)
                .then_some(Move { to: at(0), role: Role::Seam })
                .into_iter()
                .chain(turn.clone())
                .collect(),
            supports: vec![],
        };
        Strand::new(at(0), (0..2).map(layer).collect()).unwrap()
    })
}

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
fn what_comes_before_the_strand_is_comment() {
    let with = |line: &str| {
        let settings = GcodeSettings { preface: vec![line.into()], ..GcodeSettings::default() };
        write_gcode(&square(8.0), &settings)
    };
    assert!(with("; thumbnail begin 1x1 4").unwrap().contains("\n; thumbnail begin 1x1 4\n"));
    for line in ["G28", ";a\nG28", ""] {
        assert!(matches!(with(line), Err(GcodeError::Comment { .. })), "{line:?}");
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

/// A ring of many points, laid level once, then rising by a layer a turn as often as is said, and level at last.
fn helix(turns: usize, count: usize) -> Strand {
    let at = |k: usize| DVec2::from_angle(std::f64::consts::TAU * (k % count) as f64 / count as f64) * 30.0;
    let turn: Vec<Move> = (1..=count).map(|k| Move { to: at(k), role: Role::Wall }).collect();
    let seam = Move { to: at(0), role: Role::Seam };
    let layer = |k: usize| StrandLayer {
        index: k,
        z: 0.5 * (k as f64 + 1.0),
        height: 0.5,
        width: 1.5,
        moves: (k > 0).then_some(seam).into_iter().chain(turn.clone()).collect(),
        supports: vec![],
    };
    let share = |n: usize| n as f64 / count as f64;
    let rise = |k: usize, n: usize| match k {
        1 => Rise { z: 0.5 + 0.5 * share(n), height: 0.5 * share(n) },
        _ if k > turns => Rise { z: 0.5 * (turns as f64 + 1.0), height: 0.5 * (1.0 - share(n)) },
        _ => Rise { z: 0.5 * (k as f64 + share(n)), height: 0.5 },
    };
    let rises = |k: usize| if k == 0 { Vec::new() } else { (0..=count).map(|n| rise(k, n)).collect() };
    let strand = Strand::new(at(0), (0..turns + 2).map(layer).collect()).unwrap();
    strand.risen((0..turns + 2).map(rises).collect()).unwrap()
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
fn the_nozzle_is_wiped_along_what_lies_there() {
    let wiped =
        |wipe| write_gcode(&square(8.0), &GcodeSettings { wipe, ..GcodeSettings::default() }).unwrap();
    assert!(wiped(10.0).ends_with("E2.31607\nG1 X8 Y0\nG1 X8 Y2\nG1 Z5.5 F1500\n"), "{}", wiped(10.0));
    let whole = wiped(1e6);
    assert!(whole.ends_with("G1 X8 Y0\nG1 X8 Y8\nG1 X0 Y8\nG1 X0 Y0\nG1 Z5.5 F1500\n"), "{whole}");
    let (with, without) = (read_gcode(&whole), read_gcode(&wiped(0.0)));
    assert_eq!(with.strand_moves(), without.strand_moves());
    let refused = write_gcode(&square(8.0), &GcodeSettings { wipe: -1.0, ..GcodeSettings::default() });
    assert!(matches!(refused, Err(GcodeError::Setting { name: "wipe", .. })));
}

#[test]
fn a_skirt_is_named_so_that_tools_leave_it_out() {
    let mut layers = square(8.0).into_layers();
    let skirt = [(20.0, -5.0), (0.0, 0.0)].map(|(x, y)| Move { to: DVec2::new(x, y), role: Role::Skirt });
    layers[0].moves.splice(0..0, skirt);
    let strand = Strand::new(DVec2::new(-5.0, -5.0), layers).unwrap();
    for names in [RoleNames::prusa_slicer(), RoleNames::cura(), RoleNames::orca_slicer()] {
        let settings = GcodeSettings { names, ..GcodeSettings::default() };
        let program = read_gcode(&write_gcode(&strand, &settings).unwrap());
        let kinds: Vec<_> = program.strand_moves().iter().filter_map(|step| program.kind_of(step)).collect();
        assert_eq!(kinds.len(), 6);
        assert!(kinds[..2].iter().all(|kind| kind.to_lowercase().contains("skirt")), "{kinds:?}");
        assert!(kinds[2..].iter().all(|kind| !kind.to_lowercase().contains("skirt")), "{kinds:?}");
    }
}
