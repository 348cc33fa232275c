//! What must hold of plans whose layers rise along their cycles.

mod sample;
mod verdict;

use argil::curve::{DVec2, Segment, SegmentIndex};
use argil::gcode::{GcodeSettings, read_gcode, write_gcode};
use argil::mesh::{Ground, Mesh, Placement, Size};
use argil::strand::{Role, Strand};
use argil::{Climb, LayerReport, LevelCause, Plan, Planner, Settings};
use sample::sample;
use verdict::audited;

fn scaled(name: &str, factor: f64) -> Mesh {
    let placement = Placement { size: Size::Scale(factor), ground: Ground::Keep };
    sample(name).placed(&placement).expect("a mesh can be scaled")
}

/// The level plan and the spiral of a model.
fn plans(mesh: &Mesh, settings: &Settings) -> [Plan; 2] {
    [false, true].map(|spiral| {
        Planner::default().plan(mesh, &Settings { spiral, ..*settings }).expect("the model can be planned")
    })
}

/// Every layer is the same closed path in the plane with the same roles; where it begins and which way round it goes may differ.
fn assert_same_in_the_plane(level: &Strand, spiral: &Strand, settings: &Settings) {
    assert_eq!(level.layers().len(), spiral.layers().len());
    let lines = |strand: &Strand, k: usize, role: Role| -> Vec<Segment> {
        let (points, moves) = (strand.polyline(k), strand.cycle(k));
        let sides = points.windows(2).zip(moves).filter(|(_, step)| step.role == role);
        sides.map(|(ends, _)| Segment::new(ends[0], ends[1])).collect()
    };
    let length = |lines: &[Segment]| lines.iter().map(Segment::length).sum::<f64>();
    for k in 0..level.layers().len() {
        for role in Role::ALL {
            let (flat, risen) = (lines(level, k, role), lines(spiral, k, role));
            assert!((length(&flat) - length(&risen)).abs() < 1e-3, "layer {k}: {role}");
            for (of, on) in [(&flat, &risen), (&risen, &flat)] {
                let on = SegmentIndex::new(on.clone(), settings.width);
                let off = of.iter().flat_map(|side| [side.start, side.end]).map(|p| on.distance(p));
                assert!(off.fold(0.0, f64::max) <= 1.5 * settings.grid, "layer {k}: {role} lies elsewhere");
            }
        }
    }
}

/// The longest stretch of a layer whose bead is thinner than half a layer, apart from where it begins and ends.
fn longest_thin(strand: &Strand, layer: usize, settings: &Settings) -> f64 {
    let own: Vec<_> = strand.steps().filter(|step| step.layer == layer).collect();
    let whole: f64 = own.iter().map(|step| step.length()).sum();
    let seam = 2.0 * settings.seaming().reach;
    let (mut way, mut run, mut longest) = (0.0, 0.0, 0.0_f64);
    for step in own {
        let counts = way >= seam && way + step.length() <= whole - seam;
        let thin = counts && step.height < 0.5 * settings.layer_height;
        run = if thin { run + step.length() } else { 0.0 };
        longest = longest.max(run);
        way += step.length();
    }
    longest
}

/// A layer with a ramp begins lower by its share of the step, and lies level from six beads on; its bead is nowhere much thinner or thicker than
/// the layer.
fn assert_ramp(strand: &Strand, layer: usize, report: &LayerReport, settings: &Settings) {
    let (own, h) = (&strand.layers()[layer], settings.layer_height);
    let mut way = 0.0;
    for step in strand.steps().filter(|step| step.layer == layer) {
        way += step.length();
        let below = (own.z - step.to.z) / h;
        let left = report.ramp * (1.0 - way / (6.0 * settings.width)).max(0.0);
        assert!((below - left).abs() < 0.05, "layer {layer}: {below} of {left} of a layer at {way} mm");
    }
    let [thin, thick] = report.bead_heights;
    assert!(thin > 0.5 * h && thick < 1.4 * h, "layer {layer}: beads of {thin} to {thick} mm");
}

fn assert_rises(mesh: &Mesh, settings: &Settings) -> [Plan; 2] {
    let [level, spiral] = plans(mesh, settings);
    let h = settings.layer_height;
    assert_same_in_the_plane(&level.strand, &spiral.strand, settings);
    let tops: Vec<f64> = spiral.strand.steps().map(|step| step.to.z).collect();
    assert!(tops.is_sorted(), "the strand falls");
    let rim = |plan: &Plan| plan.strand.steps().last().map(|step| step.to.z);
    assert_eq!(rim(&level), rim(&spiral), "the rim is not where it was");
    for step in spiral.strand.steps() {
        let z = spiral.strand.layers()[step.layer].z;
        assert!(
            (step.to.z - z).abs() <= h + 1e-9,
            "layer {} lies at {} and not at {z}",
            step.layer,
            step.to.z
        );
        assert!((0.0..=1.5 * h + 1e-9).contains(&step.height), "a bead of {} mm", step.height);
    }
    for (k, pair) in spiral.layers.windows(2).enumerate() {
        let [below, report] = pair else { continue };
        assert_eq!(report.climb == Climb::Rising, report.level_because.is_none(), "layer {}", report.index);
        assert!((below.ramp - report.ramp).abs() <= 0.3 + 1e-9, "layer {}", report.index);
        if below.climb == Climb::Rising && report.climb == Climb::Rising {
            let longest = longest_thin(&spiral.strand, k + 1, settings);
            assert!(longest <= settings.criterion().along, "layer {}: {longest} mm are thin", report.index);
        }
        if report.climb == Climb::Step && below.climb != Climb::Ramp {
            assert!(spiral.strand.rises(k + 1).is_empty());
        }
        assert_eq!(report.climb == Climb::Ramp, report.ramp > 0.0, "layer {}", report.index);
        if report.climb == Climb::Ramp {
            assert_ramp(&spiral.strand, k + 1, report, settings);
        }
    }
    for run in spiral.layers.split(|layer| layer.climb != Climb::Rising).filter(|run| !run.is_empty()) {
        assert!(run.len() >= 9, "a run of {} layers", run.len());
    }
    let program =
        read_gcode(&write_gcode(&spiral.strand, &GcodeSettings::default()).expect("it can be written"));
    let paste = program.extruded() * GcodeSettings::default().mm3_per_e;
    assert!((paste / spiral.strand.volume() - 1.0).abs() < 1e-4, "E tells another volume");
    assert!((spiral.strand.volume() / level.strand.volume() - 1.0).abs() < 0.05, "the paste is another");
    let report = audited(&spiral, mesh, settings);
    assert!(report.is_sound(), "{report}");
    [level, spiral]
}

#[test]
fn a_vessel_rises_from_bed_to_rim() {
    let settings = Settings::for_width(3.0);
    let [level, spiral] = assert_rises(&sample("cup"), &settings);
    let count = spiral.layers.len();
    let rising = spiral.layers.iter().filter(|layer| layer.climb == Climb::Rising).count();
    assert!(rising * 10 >= count * 9, "{rising} of {count}");
    assert_eq!(spiral.layers[0].level_because, Some(LevelCause::Bed));
    assert_eq!(spiral.layers[count - 1].level_because, Some(LevelCause::Rim));
    assert_eq!(spiral.layers[count - 1].climb, Climb::Levelling);
    assert!(level.layers.iter().all(|layer| layer.climb == Climb::Step && layer.level_because.is_none()));
    // The first turn begins with nothing, the last one ends with nothing.
    let h = settings.layer_height;
    for layer in [1, count - 1] {
        let [thin, thick] = spiral.layers[layer].bead_heights;
        assert!(thin < 0.2 * h && thick > 0.9 * h, "layer {layer}: {thin} to {thick}");
    }
    let mut ends = spiral.strand.steps().filter(|step| step.layer == 1);
    assert!(ends.next().is_some_and(|step| step.height < 0.05 * h));
    assert!(spiral.strand.steps().last().is_some_and(|step| step.height < 0.05 * h));
}

#[test]
fn islands_and_their_support_rise_where_they_can() {
    assert_rises(&sample("columns"), &Settings::for_width(2.5));
    assert_rises(&scaled("arch", 0.5), &Settings::for_width(2.0));
}

#[test]
fn what_cannot_rise_begins_with_a_ramp() {
    let [_, spiral] = assert_rises(&sample("cup"), &Settings::for_width(2.5));
    let ramps: Vec<f64> = spiral.layers.iter().map(|layer| layer.ramp).filter(|&ramp| ramp > 0.0).collect();
    assert!(ramps.len() > 5 && ramps.contains(&1.0), "{ramps:?}");
}

#[test]
fn few_layers_lie_level_as_they_would_otherwise() {
    let settings = Settings { layer_height: 3.0, ..Settings::for_width(3.0) };
    let [level, spiral] = plans(&scaled("cup", 0.4), &settings);
    assert!(spiral.layers.len() < 11, "{}", spiral.layers.len());
    assert!(level.strand == spiral.strand, "another strand where no layer rises");
    assert!(spiral.layers.iter().any(|layer| layer.level_because == Some(LevelCause::Few)));
}

#[test]
fn a_tube_has_as_much_paste_as_in_level_layers() {
    let settings = Settings::for_width(2.0);
    let ring: Vec<DVec2> =
        (0..120).map(|k| 15.0 * DVec2::from_angle(f64::from(k) / 120.0 * std::f64::consts::TAU)).collect();
    let h = settings.layer_height;
    let layers: Vec<_> = (0..24)
        .map(|k| {
            argil::slice::Layer::of_loops(
                k,
                (k + 1) as f64 * h,
                h,
                std::slice::from_ref(&ring),
                settings.grid,
            )
        })
        .collect();
    let plan =
        |spiral| Planner::default().plan_layers(&layers, &Settings { spiral, ..settings }).expect("a tube");
    let (level, spiral) = (plan(false).strand, plan(true).strand);
    // The steps between level layers are strand as well.
    let paste = |strand: &Strand| -> f64 {
        let cycles = strand.steps().filter(|step| step.role != Role::Seam);
        cycles.map(|step| step.length() * step.height).sum()
    };
    let ratio = paste(&spiral) / paste(&level);
    assert!((ratio - 1.0).abs() < 3e-3, "{ratio}");
    assert_same_in_the_plane(&level, &spiral, &settings);
}
