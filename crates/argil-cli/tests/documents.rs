//! Settings and results of every library survive JSON and TOML, and nothing is read that is not understood.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking, also outside of its own function")]

use std::fmt::Debug;

use argil::curve::{ClosedCurve, DVec2, Segment, SegmentIndex, gaps, held_spans, self_crossings};
use argil::elastic::{Carrier, ElasticOptions, Path, relax};
use argil::fill::{FillOptions, fill};
use argil::gcode::{Extrusion, Flavour, GcodeSettings, RoleNames, read_gcode, write_gcode};
use argil::mesh::{Format, Ground, Mesh, Placement, Size, Soup, Unit};
use argil::route::{Demand, LayerInput, RouteSettings, Router, Wall};
use argil::skin::{Section, SkinOptions, zones};
use argil::support::{Criterion, place_supports};
use argil::tour::{MatrixMetric, TourOptions, shortest_tour};
use argil::{Document, Material, Plan, Planner, Settings};
use argil_audit::{AuditSettings, Report, audit};
use argil_calibrate::Calibration;
use argil_models::{Bounds, DVec3, Field, Solid, mesh_of};
use argil_preview::{CleaningStyle, Colour, CutPlace, PageMark, PageStyle, Palette, SvgStyle, ViewStyle};
use proptest::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Reads what it has written, alone and as a document.
fn assert_survives<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    let text = serde_json::to_string(value).unwrap();
    assert_eq!(&serde_json::from_str::<T>(&text).unwrap(), value, "{text}");
    if text.starts_with('{') {
        let document = serde_json::to_value(Document(value)).unwrap();
        assert_eq!(document["schema"], Document::<T>::SCHEMA);
        assert_eq!(&serde_json::from_value::<Document<T>>(document).unwrap().0, value);
    }
}

/// The same, and a field that nobody knows is refused in all depths that have names.
fn assert_survives_strictly<T: Serialize + DeserializeOwned + PartialEq + Debug>(settings: &T) {
    assert_survives(settings);
    let written = serde_json::to_value(settings).unwrap();
    let spoilt = |value: &Value| {
        let mut value = value.clone();
        value.as_object_mut().unwrap().insert("no-such-setting".into(), Value::from(1));
        value
    };
    assert!(serde_json::from_value::<T>(spoilt(&written)).is_err(), "{written}");
    let document = spoilt(&serde_json::to_value(Document(settings)).unwrap());
    assert!(serde_json::from_value::<Document<T>>(document).is_err(), "{written}");
    for (name, inner) in written.as_object().unwrap().iter().filter(|(_, inner)| inner.is_object()) {
        let mut outer = written.clone();
        outer[name] = spoilt(inner);
        assert!(serde_json::from_value::<T>(outer).is_err(), "{name} of {written}");
    }
}

fn settings() -> impl Strategy<Value = Settings> {
    let sizes = (0.05..100.0f64, 0.1..1.0f64, 1e-7..1e-3f64);
    let paste = (0.01..1.0f64, 0.01..9.0f64);
    (sizes, paste, 1..9usize, 0..9usize, 0..9usize).prop_map(
        |((width, high, grid), (across, along), walls, floor, skin)| Settings {
            layer_height: high * width,
            material: Material { across, along },
            grid: grid * width,
            walls,
            floor,
            skin,
            ..Settings::for_width(width)
        },
    )
}

fn machine() -> impl Strategy<Value = GcodeSettings> {
    let flavour = prop_oneof![Just(Flavour::Marlin), Just(Flavour::RepRapFirmware), Just(Flavour::Klipper)];
    let extrusion = prop_oneof![
        Just(Extrusion::Units),
        (0.1..9.0f64).prop_map(|diameter| Extrusion::Volumetric { diameter }),
        (0.1..9.0f64).prop_map(|rate| Extrusion::Constant { rate }),
    ];
    let names = prop_oneof![Just(RoleNames::cura()), Just(RoleNames::prusa_slicer())];
    let texts = ("\\PC*", prop::collection::vec(("\\PC*", "\\PC*"), 0..3));
    (flavour, extrusion, names, texts, 0.1..99.0f64, prop::option::of(0..9u8)).prop_map(
        |(flavour, extrusion, names, (start, header), feed, e_decimals)| GcodeSettings {
            flavour,
            extrusion,
            names,
            start,
            header,
            feed,
            e_decimals,
            arc_tolerance: Some(0.01 * feed),
            ..GcodeSettings::default()
        },
    )
}

proptest! {
    #[test]
    fn settings_survive(settings in settings(), machine in machine(), seed: u64) {
        assert_survives_strictly(&settings);
        assert_survives_strictly(&settings.criterion());
        assert_survives_strictly(&settings.slicing());
        assert_survives_strictly(&settings.safeguarding());
        assert_survives_strictly(&settings.support());
        assert_survives_strictly(&RouteSettings { tour: TourOptions { seed, ..TourOptions::default() }, ..settings.routing() });
        assert_survives_strictly(&settings.smoothing());
        assert_survives_strictly(&settings.tautening());
        assert_survives_strictly(&settings.seaming());
        assert_survives_strictly(&FillOptions { flow: Some([0.75, 1.33]), ..FillOptions::for_width(settings.width) });
        assert_survives_strictly(&SkinOptions { floor: settings.floor, ..SkinOptions::for_width(settings.width) });
        assert_survives_strictly(&AuditSettings { offset: [machine.feed, -machine.feed], ..AuditSettings::for_width(settings.width) });
        assert_survives_strictly(&Calibration { width: settings.width, mm3_per_e: Some(machine.feed), ..Calibration::default() });
        assert_survives_strictly(&machine);
        for size in [Size::Modelled, Size::Scale(settings.width), Size::Height(settings.width)] {
            for ground in [Ground::Keep, Ground::Centre, Ground::At([machine.feed, settings.width])] {
                assert_survives_strictly(&Placement { size, ground });
            }
        }
        let toml = toml::to_string(&Document(settings)).unwrap();
        prop_assert_eq!(toml::from_str::<Document<Settings>>(&toml).unwrap().0, settings);
    }

    #[test]
    fn styles_and_marks_survive(title in "\\PC*", scale in 0.01..99.0f64, layer in 0..999usize, [red, green, blue]: [u8; 3]) {
        let palette = Palette { wall: Colour::new(red, green, blue), ..Palette::default() };
        let at = Some(DVec2::new(scale, -scale));
        let mark = PageMark { kind: title.clone(), fault: true, layer, last_layer: layer, at, measure: scale, unit: "mm".into() };
        assert_survives_strictly(&PageStyle { title: title.clone(), marks: vec![mark], palette, ..PageStyle::default() });
        assert_survives_strictly(&SvgStyle { title: Some(title.clone()), scale, palette, ..SvgStyle::default() });
        assert_survives_strictly(&ViewStyle { azimuth: scale, palette, ..ViewStyle::default() });
        assert_survives_strictly(&CleaningStyle { title: title.clone(), palette });
        assert_survives(&CutPlace {
            cause: title.clone(), advice: title, at_roots: false, first_layer: layer, last_layer: layer, at: DVec2::splat(scale), length: scale,
        });
    }

    #[test]
    fn curves_survive(corners in prop::collection::vec((-99.0..99.0f64, -99.0..99.0f64), 3..20)) {
        let Ok(curve) = ClosedCurve::new(corners.iter().copied().map(DVec2::from).collect()) else { return Ok(()) };
        assert_survives(&curve);
        assert_survives(&self_crossings(curve.points()));
        let index = SegmentIndex::new(vec![curve.segment(0), Segment::new(DVec2::ZERO, DVec2::ONE)], 1.0);
        let held = held_spans(&curve, &index, 5.0);
        assert_survives(&gaps(curve.length(), &held));
        assert_survives(&held);
        assert_survives(&(curve.nearest(DVec2::ONE), curve.locate(9.0), index.nearest(DVec2::ONE)));
        let metric: Vec<f64> = corners.iter().flat_map(|a| corners.iter().map(move |b| (a.0 - b.0).abs())).collect();
        assert_survives(&shortest_tour(&MatrixMetric::new(corners.len(), &metric).unwrap(), &[], None, &TourOptions::default()));
    }
}

/// A block with a hole through one of its triangles.
fn soup() -> Soup {
    let solid = mesh_of(
        &Field::rounded_box(DVec3::ZERO, DVec3::splat(9.0), 1.0),
        Bounds { min: DVec3::splat(-1.0), max: DVec3::splat(10.0) },
        1.0,
    );
    let Solid { vertices, mut triangles } = solid.unwrap();
    triangles.pop();
    Soup { vertices, triangles, unit: Some(Unit::Inch), ..Soup::default() }
}

#[test]
fn what_is_read_from_a_file_survives() {
    let soup = soup();
    assert_survives(&soup);
    let (mesh, repairs) = soup.repaired().unwrap();
    assert!(repairs.open_edges.count > 0);
    assert_survives(&repairs);
    assert_survives(&mesh);
    assert_survives(&(mesh.bounds(), Format::Stl, Format::ThreeMf));
    assert_survives(&argil_models::columns());
}

#[test]
fn a_plan_survives_with_all_that_it_is_made_of() {
    let mesh = argil::mesh::read_stl(&argil_models::columns().to_stl()).unwrap();
    let settings = Settings { floor: 1, ..Settings::for_width(3.0) };
    let mut planner = Planner::default();
    let layers = planner.slices(&mesh, &settings).unwrap();
    assert_survives(&layers);
    let plan: Plan = planner.plan_layers(&layers, &settings).unwrap();
    assert_survives(&plan);
    assert_survives(&plan.strand);
    assert_survives(&plan.strand.summaries());
    assert_survives(&plan.strand.steps().collect::<Vec<_>>());

    let text = write_gcode(&plan.strand, &GcodeSettings::default()).unwrap() + "G1 Xnan\n";
    let program = read_gcode(&text);
    assert_survives(&program);
    let report = audit(&program, &mesh, &AuditSettings::for_width(1.5)).unwrap();
    assert!(!report.is_sound() && !report.findings.is_empty(), "another bead than was planned with");
    assert_survives(&report);

    // The verdict of a text is not believed.
    let mut told = serde_json::to_value(&report).unwrap();
    assert_eq!(told["sound"], false);
    told["sound"] = Value::from(true);
    assert!(!serde_json::from_value::<Report>(told).unwrap().is_sound());
}

#[test]
fn what_single_stages_give_survives() {
    let square = |x: f64| [(x, 0.0), (x + 12.0, 0.0), (x + 12.0, 12.0), (x, 12.0)].map(DVec2::from);
    let (below, above) = (square(0.0), ClosedCurve::new(square(3.0).to_vec()).unwrap());
    let curve = ClosedCurve::new(below.to_vec()).unwrap();
    let index = SegmentIndex::of_curves([&curve], 1.5);
    let supports = place_supports(&above, &index, &Settings::default().support());
    assert!(!supports.is_empty());
    assert_survives(&supports);

    let demands: Vec<Demand> =
        supports.iter().map(|s| Demand { position: s.position, anchors: s.needs.clone() }).collect();
    assert_survives(&demands);
    let walls = [Wall { points: &below, parent: None }];
    let layer = LayerInput { walls: &walls, demands: &demands, safeguard: &[], above: None, barred: &[] };
    let cycle = Router::new(RouteSettings::for_width(1.5)).unwrap().cycle(&layer).unwrap();
    assert_survives(&cycle);
    let positions: Vec<DVec2> = demands.iter().map(|d| d.position).collect();
    assert_survives(&argil::route::regions(&walls, &[curve], &positions).unwrap());

    let carriers: Vec<Carrier> = Vec::new();
    let path =
        Path { points: &cycle.points, fixed: &cycle.fixed, carriers: &carriers, clear_of: None, felt: &[] };
    assert_survives(&relax(&path, &ElasticOptions::for_width(1.5)).unwrap());
    assert_survives(&Carrier { vertex: 3, anchor: DVec2::ONE });

    let mesh = argil::mesh::read_stl(&argil_models::columns().to_stl()).unwrap();
    let layer = Planner::default().slices(&mesh, &Settings::default()).unwrap().swap_remove(0);
    let options = SkinOptions { floor: 1, ..SkinOptions::for_width(1.5) };
    let zone = zones(&[&layer.outline], &options).unwrap().swap_remove(0);
    let walls: Vec<Vec<DVec2>> = layer.walls.iter().map(|wall| wall.points.clone()).collect();
    let section = Section { outline: &layer.outline, walls: &walls };
    assert_survives(&section.filled(&zone, &options, &[]).unwrap());
    assert_survives(&fill(&layer.outline, &[], &FillOptions::for_width(1.5), &[]).unwrap());
}

#[test]
fn what_cannot_be_is_refused() {
    let refused = |text: &str| serde_json::from_str::<Settings>(text).is_err();
    assert!(refused("{}") && refused(r#"{"width": 3}"#), "another width needs other heights as well");
    assert!(serde_json::from_str::<TourOptions>("{}").is_ok(), "these have nothing to do with the width");
    assert!(serde_json::from_str::<ClosedCurve>("[[0, 0], [0, 0]]").is_err());
    assert!(serde_json::from_str::<Mesh>(r#"{"vertices": [[0, 0, 0]], "triangles": [[0, 1, 2]]}"#).is_err());

    let criterion = r#""across": 0.45, "along": 2.4"#;
    let read = |schema: &str| {
        serde_json::from_str::<Document<Criterion>>(&format!("{{{criterion}{schema}}}"))
            .map(|document| document.0)
    };
    let meant = Criterion { across: 0.45, along: 2.4 };
    assert_eq!(read(r#", "schema": 1"#).unwrap(), meant, "in any place");
    assert_eq!(read("").unwrap(), meant, "as before there was a number");
    for schema in ["0", "2", "-1", "\"1\"", "18446744073709551615"] {
        assert!(read(&format!(r#", "schema": {schema}"#)).is_err(), "schema {schema}");
    }
}
