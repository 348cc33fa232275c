//! Each fault that the audit claims to see, in one toy print of a tube.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use argil_audit::gcode::read_gcode;
use argil_audit::mesh::Mesh;
use argil_audit::{AuditError, AuditSettings, ContactCause, FindingKind, Report, audit};
use std::f64::consts::TAU;
use std::fmt::Write;

const WIDTH: f64 = 1.5;
const HEIGHT: f64 = 0.5;
const LAYERS: usize = 8;
const RADIUS: f64 = 15.0;
const SIDES: u32 = 128;

type Points = Vec<(f64, f64)>;

/// The wall path of the tube: a regular polygon, half a bead inside of its sides.
fn ring() -> Points {
    let radius = RADIUS - 0.5 * WIDTH / (0.5 * TAU / f64::from(SIDES)).cos();
    (0..=SIDES)
        .map(|k| (TAU * f64::from(k % SIDES) / f64::from(SIDES)).sin_cos())
        .map(|(s, c)| (radius * c, radius * s))
        .collect()
}

fn shifted(by: f64) -> Points {
    ring().into_iter().map(|(x, y)| (x + by, y)).collect()
}

/// The wall path that begins and ends at corner `k`.
fn started_at(k: usize) -> Points {
    let mut ring = ring();
    ring.pop();
    ring.rotate_left(k);
    ring.push(ring[0]);
    ring
}

/// The wall path with an excursion through `points` from its end back to its beginning.
fn with_excursion(points: &[(f64, f64)]) -> Points {
    let ring = ring();
    let home = ring[0];
    ring.into_iter().chain(points.iter().copied()).chain([home]).collect()
}

fn tube() -> Mesh {
    let top = HEIGHT * LAYERS as f64;
    let corner = |k: u32, z: f64| {
        let (s, c) = (TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
        [RADIUS * c, RADIUS * s, z]
    };
    let mut vertices: Vec<[f64; 3]> = (0..SIDES).flat_map(|k| [corner(k, 0.0), corner(k, top)]).collect();
    vertices.extend([[0.0, 0.0, 0.0], [0.0, 0.0, top]]);
    let (bottom, lid) = (2 * SIDES, 2 * SIDES + 1);
    let side = |k: u32| {
        let (a, b) = (2 * k, 2 * ((k + 1) % SIDES));
        [[a, b, b + 1], [a, b + 1, a + 1], [bottom, b, a], [lid, a + 1, b + 1]]
    };
    Mesh::new(vertices, (0..SIDES).flat_map(side).collect()).unwrap()
}

fn text(layers: &[Points], travel_at: Option<(usize, usize)>) -> String {
    let (mut x, mut y) = layers[0][0];
    let mut text = format!("M83\nG1 X{x:.4} Y{y:.4} Z{HEIGHT} F3000\n");
    for (k, points) in layers.iter().enumerate() {
        writeln!(text, ";LAYER:{k}\nG1 Z{:.3} E0.01", (k + 1) as f64 * HEIGHT).unwrap();
        for (i, &(a, b)) in points.iter().enumerate() {
            let length = (a - x).hypot(b - y);
            if length < 1e-9 {
                continue;
            }
            write!(text, "G1 X{a:.4} Y{b:.4}").unwrap();
            if travel_at != Some((k, i)) {
                write!(text, " E{:.5}", 0.3 * length).unwrap();
            }
            text.push('\n');
            (x, y) = (a, b);
        }
    }
    text
}

fn audited(layers: &[Points]) -> Report {
    audit(&read_gcode(&text(layers, None)), &tube(), &AuditSettings::default()).unwrap()
}

/// `layers` of wall path with some of them replaced.
fn tube_but(replace: impl Fn(usize) -> Option<Points>) -> Vec<Points> {
    (0..LAYERS).map(|k| replace(k).unwrap_or_else(ring)).collect()
}

fn only(layer: usize, points: &Points) -> Vec<Points> {
    tube_but(|k| (k == layer).then(|| points.clone()))
}

#[test]
fn a_plain_tube_is_sound() {
    let report = audited(&tube_but(|_| None));
    assert!(report.is_sound(), "{report}");
    assert!(report.findings.is_empty(), "{report}");
    let f = &report.figures;
    assert_eq!((f.layers, f.mesh_layers, f.wanted_layers), (LAYERS, LAYERS, LAYERS));
    assert!(
        (f.path_mm - f.model_mm).abs() < 1e-6 && f.material_ratio == 0.0 && f.model_missed_fraction == 0.0
    );
    assert!((f.flow_per_mm_median.unwrap() - 0.3).abs() < 1e-3);
}

#[test]
fn a_travel_move() {
    let text = text(&tube_but(|_| None), Some((3, 40)));
    let report = audit(&read_gcode(&text), &tube(), &AuditSettings::default()).unwrap();
    assert_eq!((report.figures.transfer_moves, report.figures.paths_per_layer_max), (1, 2));
    let transfer = report.findings_of(FindingKind::Transfer).next().unwrap();
    assert_eq!(transfer.layer, 3);
    let at = transfer.at.unwrap();
    let (x, y) = ring()[39];
    assert!((at.x - x).hypot(at.y - y) < 1e-3);
}

#[test]
fn a_missing_stretch_of_wall() {
    let report = audited(&only(4, &ring()[..100].to_vec()));
    assert!(report.figures.model_missed_fraction > 0.01, "{report}");
    let missed = report.findings_of(FindingKind::MissedWall).next().unwrap();
    assert!(missed.layer == 4 && (missed.measure - 29.0 * 0.7).abs() < 1.0, "{missed:?}");
    assert_eq!(report.findings_of(FindingKind::BareOutline).map(|f| f.layer).collect::<Vec<_>>(), [4]);
    // The next layer is open too: it begins with the way from where this one stopped.
    assert_eq!(report.findings_of(FindingKind::OpenLayer).map(|f| f.layer).collect::<Vec<_>>(), [4, 5]);
}

/// A loop that starts and ends on the wall, outward and back.
fn spur() -> Points {
    let out = RADIUS - 0.5 * WIDTH + 6.0;
    with_excursion(&[(out, -2.0), (out, 2.0)])
}

#[test]
fn a_spur_in_mid_air() {
    let report = audited(&only(5, &spur()));
    assert_eq!(report.figures.unsupported_spans, 1);
    let span = report.findings_of(FindingKind::UnsupportedSpan).next().unwrap();
    assert!(span.layer == 5 && span.at.unwrap().x > RADIUS, "{span:?}");
}

#[test]
fn the_same_spur_on_a_spur() {
    let report = audited(&tube_but(|k| (k < 6).then(spur)));
    assert!(report.is_sound(), "{report}");
    assert!(report.figures.material_ratio > 0.0 && report.figures.roots_per_model_m > 0.0);
}

#[test]
fn a_spur_in_every_layer_is_one_root() {
    let report = audited(&tube_but(|_| Some(spur())));
    let f = &report.figures;
    assert!(f.coherence_mm < 0.05 && f.jumps_fraction == 0.0, "{report}");
    assert_eq!(report.contacts.len(), 1, "{report}");
    let root = report.contacts[0];
    assert_eq!((root.cause, root.first_layer, root.last_layer), (ContactCause::Root, 0, 7));
    // Two legs of less than 4/3 w each, from where they leave the wall's own bead.
    assert!(root.length > 8.0 && root.length < 8.0 * 4.0 && root.at.x > RADIUS - 0.5 * WIDTH, "{root:?}");
}

#[test]
fn a_spur_that_holds_nothing_is_a_jump() {
    let report = audited(&only(0, &spur()));
    let jump = report.findings_of(FindingKind::Jump).next().unwrap();
    assert!(jump.layer == 0 && jump.measure > 10.0 && jump.at.unwrap().x > RADIUS, "{jump:?}");
    assert!(report.figures.jumps_fraction > 0.5 && report.figures.coherence_widths > 1.0, "{report}");
    assert_eq!(report.figures.jumps_fraction, report.figures.apart_from_above_fraction);
}

/// Points at an angle in degrees and a distance from the axis.
fn at(degrees: f64, radius: f64) -> (f64, f64) {
    let (s, c) = degrees.to_radians().sin_cos();
    (radius * c, radius * s)
}

#[test]
fn strand_along_the_wall_is_a_place_to_clean() {
    let beside = RADIUS + 0.5;
    let along = (0..=20).map(|k| at(-10.0 - 2.0 * f64::from(k), beside));
    let back = (0..=20).map(|k| at(-50.0 + 2.0 * f64::from(k), RADIUS + 3.0));
    let points: Vec<(f64, f64)> = along.chain(back).collect();
    let report = audited(&tube_but(|_| Some(with_excursion(&points))));
    let place = report.contacts.iter().find(|place| place.cause == ContactCause::Passing).unwrap();
    assert_eq!((place.first_layer, place.last_layer), (0, 7));
    assert!(place.length > 8.0 * 9.0 && place.length < 8.0 * 13.0, "{place:?}");
    assert!(report.to_string().contains("passing by (1 places"), "{report}");
}

#[test]
fn a_narrow_hairpin_is_a_bend_and_no_turn() {
    let points = [at(-1.0, RADIUS + 5.0), at(1.0, RADIUS + 5.0)];
    let f = audited(&only(0, &with_excursion(&points))).figures;
    assert_eq!((f.sharp_turns_nonmodel, f.sharp_bends_nonmodel), (0, 1));
}

#[test]
fn a_chord_through_the_wall() {
    let home = RADIUS - 0.5 * WIDTH;
    let chord = with_excursion(&[(home + 5.0, 0.5), (-RADIUS - 5.0, 1.0), (-RADIUS - 5.0, 4.0)]);
    let report = audited(&only(0, &chord));
    assert!(report.figures.wall_crossings >= 2 && report.figures.self_crossings >= 2, "{report}");
    assert!(report.findings_of(FindingKind::WallCrossing).all(|found| found.layer == 0));
}

#[test]
fn a_nested_excursion_inside_is_no_crossing() {
    let report = audited(&only(0, &with_excursion(&[(8.0, -2.0), (4.0, 0.0), (8.0, 2.0)])));
    assert_eq!((report.figures.wall_crossings, report.figures.self_crossings), (0, 0));
    assert!(report.figures.inside_model_mm > 5.0, "{report}");
}

#[test]
fn a_step_sideways_within_the_overhang() {
    let report = audited(&tube_but(|k| (k > 3).then(|| shifted(0.35))));
    assert_eq!(report.figures.unsupported_spans, 0);
}

#[test]
fn a_step_sideways_beyond_it() {
    let report = audited(&tube_but(|k| (k > 3).then(|| shifted(0.9))));
    assert!(report.figures.unsupported_spans >= 2, "{report}");
}

#[test]
fn a_seam_that_jumps() {
    let report = audited(&tube_but(|k| (k > 3).then(|| started_at(64))));
    assert!(report.figures.open_layers == 1 && report.figures.unsupported_spans > 0, "{report}");
    let open = report.findings_of(FindingKind::OpenLayer).next().unwrap();
    assert!(open.layer == 4 && open.measure > 25.0, "{open:?}");
}

#[test]
fn a_seam_that_steps_along_the_wall() {
    let report = audited(&tube_but(|k| Some(started_at(k))));
    assert!(report.is_sound(), "{report}");
    assert!((0.6..0.8).contains(&report.figures.seam_gap_max_mm));
}

#[test]
fn a_bow_tie_through_a_shared_vertex() {
    let (x, y) = ring()[0];
    let bow = [(x + 3.0, y), (x + 6.0, y + 3.0), (x + 6.0, y - 3.0), (x + 3.0, y), (x + 4.0, y + 3.0)];
    let bow: Points = [(x, y)].into_iter().chain(bow).chain(ring()).collect();
    assert!(audited(&only(0, &bow)).figures.self_crossings >= 1);
}

#[test]
fn two_strands_that_touch_at_a_vertex() {
    let (x, y) = ring()[0];
    let touch = [(x + 1.0, y - 3.0), (x + 3.0, y), (x + 6.0, y - 3.0), (x + 6.0, y + 3.0), (x + 3.0, y)];
    let touch: Points = [(x, y)].into_iter().chain(touch).chain(ring()).collect();
    assert_eq!(audited(&only(0, &touch)).figures.self_crossings, 0);
}

#[test]
fn layers_missing_at_the_top() {
    let report = audited(&tube_but(|_| None)[..6]);
    let short = report.falls_short();
    assert!(short.iter().any(|s| s.figure == "layers" && s.value == 6.0 && s.limit == 8.0), "{report}");
    assert!(report.figures.model_missed_fraction > 0.2);
    assert_eq!(report.findings_of(FindingKind::MissingLayer).map(|f| f.layer).collect::<Vec<_>>(), [6, 7]);
}

#[test]
fn a_retraction_and_a_move_down() {
    let good = text(&tube_but(|_| None), None);
    let faulty = good.replacen(";LAYER:5\n", "G1 E-1\nG1 Z1\nG1 Z2.5\nG1 E1\n;LAYER:5\n", 1);
    let report = audit(&read_gcode(&faulty), &tube(), &AuditSettings::default()).unwrap();
    assert_eq!((report.figures.retractions, report.figures.z_down_moves), (1, 1));
    assert_eq!(report.findings_of(FindingKind::Retraction).next().unwrap().layer, 4);
    assert_eq!(report.falls_short().len(), 2, "{report}");
}

#[test]
fn a_skirt_counts_for_continuity_alone() {
    let good = text(&tube_but(|_| None), None);
    let skirt = ";LAYER:0\n;TYPE:SKIRT\nG1 X40 E1\nG1 X14.2500 E1\nG1 Y0 E1\n;TYPE:WALL-OUTER\n";
    let report =
        audit(&read_gcode(&good.replacen(";LAYER:0\n", skirt, 1)), &tube(), &AuditSettings::default())
            .unwrap();
    assert_eq!(report.figures.material_ratio, 0.0);
    assert!(report.is_sound(), "{report}");
}

#[test]
fn fill_is_no_nonmodel_strand() {
    let zigzag: Points = with_excursion(&[(-8.0, 2.0), (-8.0, -2.0)]);
    let walls = text(&only(0, &zigzag), None);
    let filled: String = walls
        .lines()
        .map(|line| {
            if line.starts_with("G1 X-8.0000 Y2") {
                format!(";TYPE:FILL\n{line}\n")
            } else {
                format!("{line}\n")
            }
        })
        .collect();
    let filled = filled.replacen(";LAYER:1\n", ";TYPE:WALL-OUTER\n;LAYER:1\n", 1);
    let settings = AuditSettings::default();
    let as_fill = audit(&read_gcode(&filled), &tube(), &settings).unwrap().figures;
    let as_support = audit(&read_gcode(&walls), &tube(), &settings).unwrap().figures;
    assert!(as_fill.nonmodel_mm == 0.0 && as_fill.fill_mm > 40.0, "{as_fill:?}");
    assert!((as_fill.fill_mm - as_support.nonmodel_mm).abs() < 1e-9 && as_support.fill_mm == 0.0);
}

#[test]
fn layers_by_height_when_the_file_does_not_tell() {
    let told = text(&tube_but(|_| None), None);
    let untold: String =
        told.lines().filter(|line| !line.starts_with(';')).map(|line| format!("{line}\n")).collect();
    let report = audit(&read_gcode(&untold), &tube(), &AuditSettings::default()).unwrap();
    assert!(report.is_sound(), "{report}");
    assert_eq!(report.figures.layers, LAYERS);
}

#[test]
fn what_cannot_be_audited() {
    let program = read_gcode(&text(&tube_but(|_| None), None));
    let settings = AuditSettings { across: f64::NAN, ..AuditSettings::default() };
    assert!(matches!(
        audit(&program, &tube(), &settings),
        Err(AuditError::Setting { name: "across", value }) if value.is_nan()
    ));
    let settings = AuditSettings { walls: 0, ..AuditSettings::default() };
    assert!(matches!(audit(&program, &tube(), &settings), Err(AuditError::Setting { name: "walls", .. })));
    let nothing = read_gcode("G0 X1\nG1 X3\n");
    let nothing = audit(&nothing, &tube(), &AuditSettings::default());
    assert!(matches!(nothing, Err(AuditError::NothingExtruded)));
    let far = read_gcode("M83\nG1 X1e14 E1\nG1 X-1e300 E1\n");
    assert!(matches!(audit(&far, &tube(), &AuditSettings::default()), Err(AuditError::TooLong { .. })));
}

#[test]
fn the_text_tells_figures_findings_and_verdict() {
    let text = audited(&only(5, &spur())).to_string();
    assert!(text.contains("transfer_moves                    0\n"), "{text}");
    assert!(text.contains("unsupported span (1):\n    layer 5 at "), "{text}");
    assert!(text.ends_with("short of: unsupported_spans = 1.0000 (limit 0)"), "{text}");
}

#[cfg(feature = "serde")]
#[test]
fn json_has_the_figures_by_name() {
    let report = audited(&only(5, &spur()));
    let json: serde_json::Value = serde_json::to_value(&report).unwrap();
    assert_eq!(json["sound"], false);
    assert_eq!(json["falls_short"][0]["figure"], "unsupported_spans");
    assert_eq!(json["figures"]["layers"], 8);
    let span = json["findings"].as_array().unwrap().iter().find(|f| f["kind"] == "unsupported_span").unwrap();
    assert_eq!(span["layer"], 5);
    assert!(span["at"][0].as_f64().unwrap() > RADIUS);
}

/// The tube as a spiral: a level turn, turns that rise evenly by `pitch`, and a level one at last. Moves of the given turn lie
/// higher by so much.
fn spiral(pitch: f64, lifted: Option<(usize, f64)>) -> String {
    let mut text = String::from("M83\n");
    let ring = ring();
    let (x, y) = ring[0];
    writeln!(text, "G0 X{x:.4} Y{y:.4} Z{HEIGHT}").unwrap();
    for layer in 0..LAYERS {
        writeln!(text, ";LAYER:{layer}").unwrap();
        for (k, (x, y)) in ring.iter().enumerate().skip(1) {
            let turns = (layer as f64 - 1.0 + k as f64 / f64::from(SIDES)).clamp(0.0, LAYERS as f64 - 2.0);
            let lift = lifted.filter(|&(turn, _)| layer >= turn).map_or(0.0, |(_, by)| by);
            writeln!(text, "G1 X{x:.4} Y{y:.4} Z{:.4} E1", HEIGHT + pitch * turns + lift).unwrap();
        }
    }
    text
}

#[test]
fn a_spiral_is_sound_and_has_no_step() {
    let of = |text: &str| audit(&read_gcode(text), &tube(), &AuditSettings::default()).unwrap();
    let level = audited(&tube_but(|_| None));
    let report = of(&spiral(HEIGHT, None));
    assert!(report.is_sound(), "{report}");
    assert_eq!(report.figures.layers, LAYERS);
    assert!((level.figures.steepest_rise_mm - HEIGHT).abs() < 1e-9, "{level}");
    assert!(report.figures.steepest_rise_mm < 0.02 * HEIGHT, "{report}");
}

#[test]
fn turns_too_far_above_the_one_below() {
    let of = |text: &str| audit(&read_gcode(text), &tube(), &AuditSettings::default()).unwrap();
    // One turn that leaps up has no hold; what follows lies on it.
    let report = of(&spiral(HEIGHT, Some((4, 0.5))));
    let short: Vec<&str> = report.falls_short().iter().map(|short| short.figure).collect();
    assert_eq!(short, ["unsupported_spans"], "{report}");
    assert!(report.findings_of(FindingKind::UnsupportedSpan).all(|span| span.layer == 4), "{report}");
    assert!(report.figures.unsupported_mm > 80.0, "{report}");
    assert!(of(&spiral(HEIGHT, Some((4, 0.2)))).is_sound());
    // And so has every turn of a helix that rises too steeply, the first and the last where they are thickest.
    assert!(of(&spiral(1.5 * HEIGHT, None)).is_sound());
    assert_eq!(of(&spiral(1.7 * HEIGHT, None)).figures.unsupported_spans, LAYERS - 1);
}

#[test]
fn a_spiral_that_goes_down_or_stays_open() {
    let of = |text: &str| audit(&read_gcode(text), &tube(), &AuditSettings::default()).unwrap();
    let down = spiral(HEIGHT, None).replacen(";LAYER:5\n", "G1 Z2.4 E0\n;LAYER:5\n", 1);
    assert_eq!(of(&down).falls_short().iter().map(|s| s.figure).collect::<Vec<_>>(), ["z_down_moves"]);
    let good = spiral(HEIGHT, None);
    let (head, tail) = good.split_once(";LAYER:5\n").unwrap();
    let cut: Vec<&str> = head.lines().collect();
    let open = format!("{}\n;LAYER:5\n{tail}", cut[..cut.len() - 12].join("\n"));
    assert!(of(&open).falls_short().iter().any(|s| s.figure == "open_layers"));
}
