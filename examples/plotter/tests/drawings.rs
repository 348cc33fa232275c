//! What must be true of every line, and of the program.
#![allow(clippy::unwrap_used, reason = "what fails here fails the test")]

use std::io::Write;
use std::process::{Command, Stdio};

use argil::curve::{ClosedCurve, SegmentIndex, self_crossings};
use argil_plotter::{DVec2, one_line, read_drawing};

const PEN: f64 = 0.5;

fn ring(middle: DVec2, radius: f64, corners: u32) -> Vec<DVec2> {
    let at = |k: u32| {
        middle + radius * DVec2::from_angle(f64::from(k) / f64::from(corners) * std::f64::consts::TAU)
    };
    (0..corners).map(at).map(|p| (p * 1e3).round() / 1e3).collect()
}

/// A field of flowers: a ring of petals round each heart, all in a frame.
fn field(columns: u32, rows: u32) -> Vec<Vec<DVec2>> {
    let size = DVec2::new(f64::from(columns), f64::from(rows)) * 30.0;
    let mut loops = vec![vec![DVec2::ZERO, DVec2::new(size.x, 0.0), size, DVec2::new(0.0, size.y)]];
    for k in 0..columns * rows {
        let middle = DVec2::new(f64::from(k % columns), f64::from(k / columns)) * 30.0 + 15.0;
        loops.push(ring(middle, 3.0 + 0.1 * f64::from(k % 7), 24));
        loops.push(ring(middle, 1.5, 5));
        let petals = 5 + k % 3;
        loops.extend((0..petals).map(|j| {
            ring(
                middle + 9.0 * DVec2::from_angle(f64::from(j) / f64::from(petals) * std::f64::consts::TAU),
                2.8,
                16,
            )
        }));
    }
    loops
}

fn length(line: &[DVec2]) -> f64 {
    (0..line.len()).map(|k| line[k].distance(line[(k + 1) % line.len()])).sum()
}

#[test]
fn every_outline_is_drawn_and_nothing_is_crossed() {
    for (columns, rows) in [(1, 1), (3, 2)] {
        let loops = field(columns, rows);
        let line = one_line(&loops, PEN).unwrap();
        let met = self_crossings(&line);
        assert!(met.is_empty(), "{met:?}");

        let drawn = SegmentIndex::of_curves([&ClosedCurve::new(line.clone()).unwrap()], PEN);
        let outlines: f64 = loops.iter().map(|l| length(l)).sum();
        for outline in &loops {
            let curve = ClosedCurve::new(outline.clone()).unwrap();
            // A root is a notch of less than the pen's width.
            let bare = curve.resampled(0.05).iter().filter(|p| !drawn.is_within(**p, 0.5 * PEN)).count();
            assert_eq!(bare, 0, "part of an outline is not drawn");
            // The grid is 1e-4 mm, and multiples of it are rounded in their last bits.
            assert!(outline.iter().all(|corner| line.iter().any(|p| p.distance(*corner) < 1e-9)));
        }
        // Joints are walked there and back: flowers of rings some 5 mm apart, 30 mm from each other.
        let joints = length(&line) - outlines;
        assert!(joints > 0.0 && joints < 2.0 * 8.0 * loops.len() as f64, "{joints} mm of joints");
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_with_its_reason() {
    assert!(one_line(&[], PEN).is_err());
    assert!(one_line(&[vec![DVec2::ZERO; 3]], PEN).is_err());
    assert!(one_line(&field(1, 1), f64::NAN).is_err());
    assert_eq!(read_drawing("0,0 1,0 1;1").unwrap_err().word, "1;1");
}

fn run(drawing: &str) -> (bool, String, String) {
    let mut plotter = Command::new(env!("CARGO_BIN_EXE_plotter"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    plotter.stdin.take().unwrap().write_all(drawing.as_bytes()).unwrap();
    let done = plotter.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (done.status.success(), text(done.stdout), text(done.stderr))
}

#[test]
fn the_pen_goes_down_once() {
    let (done, hpgl, _) = run("# two squares\n0,0 9,0 9,9 0,9\n20,0 29,0 29,9 20,9\n");
    assert!(done && hpgl.starts_with("IN;SP1;PU") && hpgl.ends_with("PU;\n"), "{hpgl}");
    assert_eq!(hpgl.matches("PD").count(), 1);
    assert!(hpgl.contains(",1160,360,"), "a corner at 29, 9 mm");

    let (done, hpgl, why) = run("0,0 1,x");
    assert!(!done && hpgl.is_empty() && why.contains("line: 1"), "{why}");
}
