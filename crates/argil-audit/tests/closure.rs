//! What of floors and faces lies open, in a toy print of a drum that is closed by rings; and sheets.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use argil_audit::gcode::read_gcode;
use argil_audit::mesh::Mesh;
use argil_audit::{AuditSettings, FindingKind, Report, audit};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

const WIDTH: f64 = 1.5;
const HEIGHT: f64 = 0.5;
const LAYERS: usize = 4;
const RADIUS: f64 = 15.0;
const SIDES: u32 = 128;

/// A drum, or without its two ends a sheet.
fn drum(ends: bool) -> Mesh {
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
        let all = [[a, b, b + 1], [a, b + 1, a + 1], [bottom, b, a], [lid, a + 1, b + 1]];
        all[..if ends { 4 } else { 2 }].to_vec()
    };
    Mesh::new(vertices, (0..SIDES).flat_map(side).collect()).unwrap()
}

/// G-code of layers, each of rings with these radii, one after the other.
fn rings(layers: &[Vec<f64>]) -> String {
    let inscribed = |radius: f64| radius / (0.5 * TAU / f64::from(SIDES)).cos();
    let mut text = format!("M83\nG0 X{:.4} Y0\n", inscribed(layers[0][0]));
    for (k, radii) in layers.iter().enumerate() {
        writeln!(text, ";LAYER:{k}\nG1 Z{:.3}", (k + 1) as f64 * HEIGHT).unwrap();
        for &radius in radii {
            for k in 0..=SIDES {
                let (s, c) = (TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
                writeln!(text, "G1 X{:.4} Y{:.4} E.1", inscribed(radius) * c, inscribed(radius) * s).unwrap();
            }
        }
    }
    text
}

/// Radii of rings one bead apart, from the wall to the middle.
fn closed() -> Vec<f64> {
    (0..10).map(|k| RADIUS - WIDTH * (0.5 + f64::from(k))).collect()
}

fn audited(layers: &[Vec<f64>], floor: usize, skin: bool) -> Report {
    let settings = AuditSettings { floor, skin, ..AuditSettings::default() };
    audit(&read_gcode(&rings(layers)), &drum(true), &settings).unwrap()
}

#[test]
fn a_closed_floor_has_no_open_place() {
    let wall = closed()[..1].to_vec();
    let report = audited(&[closed(), closed(), wall.clone(), wall], 2, false);
    let f = &report.figures;
    assert_eq!(report.findings_of(FindingKind::BareFill).count(), 0, "{report}");
    assert!((f.closed_mm2 / (2.0 * PI * RADIUS * RADIUS) - 1.0).abs() < 0.01, "{}", f.closed_mm2);
    assert!(f.closed_bare_fraction < 1e-3 && f.closed_farthest_widths < 0.505, "{report}");
}

#[test]
fn a_ring_that_is_missing_leaves_an_open_one() {
    let wall = closed()[..1].to_vec();
    let mut open = closed();
    let missing = open.remove(4);
    let report = audited(&[closed(), open, wall.clone(), wall.clone()], 2, false);
    let f = &report.figures;
    assert!((f.closed_farthest_widths - 1.0).abs() < 0.01, "{}", f.closed_farthest_widths);
    let bare = TAU * missing * WIDTH / (2.0 * PI * RADIUS * RADIUS);
    assert!((f.closed_bare_fraction / bare - 1.0).abs() < 0.05, "{} {bare}", f.closed_bare_fraction);
    let found: Vec<_> = report.findings_of(FindingKind::BareFill).collect();
    assert!(found.len() > 20, "{}", found.len());
    for place in found {
        let at = place.at.unwrap();
        assert!(place.layer == 1 && (at.length() - missing).abs() < 0.05, "{place:?}");
        assert!((place.measure / WIDTH - 1.0).abs() < 0.01, "{place:?}");
    }
    // The same print, of which nothing is to be closed.
    let asked = audited(&[closed(), wall.clone(), wall.clone(), wall], 0, false);
    assert!(asked.figures.closed_mm2 == 0.0 && asked.figures.closed_farthest_widths == 0.0);
}

#[test]
fn faces_are_the_ends_of_the_drum() {
    let wall = closed()[..1].to_vec();
    let report = audited(&[closed(), wall.clone(), wall.clone(), wall], 0, true);
    // The underside is closed, the roof is open.
    let layers: Vec<i64> = report.findings_of(FindingKind::BareFill).map(|found| found.layer).collect();
    assert!(!layers.is_empty() && layers.iter().all(|&layer| layer == 3), "{layers:?}");
    assert!((report.figures.closed_mm2 / (2.0 * PI * RADIUS * RADIUS) - 1.0).abs() < 0.02);
}

#[test]
fn a_sheet_is_its_own_wall() {
    let settings = AuditSettings { surface: true, ..AuditSettings::default() };
    let judged = |radius: f64| {
        let inscribed = radius * (0.5 * TAU / f64::from(SIDES)).cos();
        audit(&read_gcode(&rings(&vec![vec![inscribed]; LAYERS])), &drum(false), &settings).unwrap()
    };
    let on_it = judged(RADIUS);
    assert!(on_it.is_sound(), "{on_it}");
    assert!(
        on_it.figures.material_ratio == 0.0 && on_it.figures.contour_uncovered_fraction == 0.0,
        "{on_it}"
    );
    let inside = judged(RADIUS - 0.5 * WIDTH);
    assert!(inside.figures.model_missed_fraction > 0.99, "{inside}");
}
