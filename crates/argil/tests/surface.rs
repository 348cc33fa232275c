//! Sheets without thickness: their sections are the path of the wall itself, closed or there and back.

mod verdict;

use std::f64::consts::{PI, TAU};

use argil::curve::{DVec2, Segment, SegmentIndex};
use argil::mesh::Mesh;
use argil::slice::Loss;
use argil::strand::Role;
use argil::{Infill, Plan, PlanError, Planner, Settings};
use verdict::audited;

const HEIGHT: f64 = 12.0;

/// A sheet over `columns` by 8 squares: `at` gives its points for u and v from 0 to 1. Closed ones go round.
fn sheet(columns: u32, closed: bool, at: impl Fn(f64, f64) -> [f64; 3]) -> Mesh {
    let rows = 8_u32;
    let across = if closed { columns } else { columns + 1 };
    let share = |k: u32, of: u32| f64::from(k) / f64::from(of);
    let vertices = (0..=rows)
        .flat_map(|v| (0..across).map(move |u| (u, v)))
        .map(|(u, v)| at(share(u, columns), share(v, rows)));
    let squares = (0..rows).flat_map(|v| (0..columns).map(move |u| (u, v)));
    let triangles = squares.flat_map(|(u, v)| {
        let [a, b] = [v * across + u, v * across + (u + 1) % across];
        [[a, b, b + across], [a, b + across, a + across]]
    });
    Mesh::new(vertices.collect(), triangles.collect()).expect("a sheet is a mesh")
}

/// A vase of eight ribs that widens upwards.
fn vase(u: f64, v: f64) -> [f64; 3] {
    let radius = 14.0 + 2.0 * v + 1.5 * (8.0 * TAU * u).cos();
    [radius * (TAU * u).cos(), radius * (TAU * u).sin(), HEIGHT * v]
}

fn half_pipe(u: f64, v: f64) -> [f64; 3] {
    [15.0 * (PI * u).cos(), 15.0 * (PI * u).sin(), HEIGHT * v]
}

fn settings() -> Settings {
    Settings { surface: true, ..Settings::for_width(1.5) }
}

/// The plan of a sheet, which the audit must find sound against the sheet.
fn planned(mesh: &Mesh, settings: &Settings) -> Plan {
    let plan = Planner::default().plan(mesh, settings).expect("a sheet has a plan");
    let report = audited(&plan, mesh, settings);
    assert!(report.is_sound() && report.figures.model_missed_fraction < 1e-4, "{report}");
    plan
}

/// How far the section of a sheet is from the strand of its layer at most, mm.
fn farthest(plan: &Plan, at: impl Fn(f64, f64) -> [f64; 3]) -> f64 {
    let layers = plan.strand.layers().len();
    let away = |layer: usize| {
        let path = plan.strand.polyline(layer);
        let laid =
            SegmentIndex::new(path.windows(2).map(|ends| Segment::new(ends[0], ends[1])).collect(), 1.5);
        let v = (layer as f64 + 0.5) / layers as f64;
        let section = (0..=300).map(|k| at(f64::from(k) / 300.0, v));
        section.map(|[x, y, _]| laid.distance(DVec2::new(x, y))).fold(0.0, f64::max)
    };
    (0..layers).map(away).fold(0.0, f64::max)
}

#[test]
fn a_closed_section_is_the_path_itself() {
    let plan = planned(&sheet(240, true, vase), &settings());
    assert_eq!(plan.strand.layers().len(), 24);
    let away = farthest(&plan, vase);
    assert!(away < 0.06, "the sheet is {away} mm from the strand");
    assert!(plan.losses.is_empty(), "{:?}", plan.losses);
}

#[test]
fn an_open_section_is_printed_there_and_back() {
    let plan = planned(&sheet(48, false, half_pipe), &settings());
    assert!(farthest(&plan, half_pipe) < 0.06);
    let lengths: Vec<f64> = plan
        .losses
        .iter()
        .map(|loss| match loss {
            Loss::OpenSheet { length, .. } => *length,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(lengths.len(), plan.layers.len());
    for (length, layer) in lengths.iter().zip(&plan.layers) {
        assert!(
            (length - 15.0 * PI).abs() < 0.1 && (layer.wall_length - 2.0 * length).abs() < 0.5,
            "{layer:?}"
        );
    }
}

#[test]
fn a_sheet_may_have_a_floor() {
    let plan = planned(&sheet(240, true, vase), &Settings { floor: 2, ..settings() });
    let filled: Vec<bool> = plan.layers.iter().map(|layer| layer.fill_length > 0.0).collect();
    assert!(filled[..2].iter().all(|&is| is) && !filled[2..].contains(&true));
    assert!(plan.strand.length_of(Role::Fill) > 500.0);
}

#[test]
fn what_needs_an_inside_is_refused() {
    let mesh = sheet(24, true, vase);
    for (name, asked) in [
        ("walls", Settings { walls: 2, ..settings() }),
        ("skin", Settings { skin: 1, ..settings() }),
        ("infill", Settings { infill: Infill::Ratio(0.2), ..settings() }),
    ] {
        let refused = Planner::default().plan(&mesh, &asked);
        assert!(matches!(refused, Err(PlanError::Setting { name: told, .. }) if told == name), "{refused:?}");
    }
}
