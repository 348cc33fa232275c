use argil::gcode::{GcodeSettings, read_gcode, write_gcode};
use argil::{Infill, Planner, Settings, Skirt};
use argil_audit::{AuditSettings, audit};
use argil_models::{Bounds, DVec3, Field, mesh_of};

use crate::Draw;

/// Half side of the box that the solid is cut to, mm.
const REACH: f64 = 12.0;

/// Its height, mm.
const TOP: f64 = 10.0;

/// Plans a small solid: a typed error, or a strand that the audit finds sound.
pub fn pipeline(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let settings = settings(&mut draw);
    let mut body = Field::empty();
    for _ in 0..4 {
        if draw.is_empty() {
            break;
        }
        let piece = piece(&mut draw);
        body = match draw.below(8) {
            0 => body.without(piece),
            1 => body.common(piece),
            2 => body.blended(piece, 2.0),
            _ => body.union(piece),
        };
    }
    let bounds = Bounds { min: DVec3::new(-REACH, -REACH, 0.0), max: DVec3::new(REACH, REACH, TOP) };
    let solid = mesh_of(&body, bounds, 1.0).expect("the box spans a grid");
    let Ok(mesh) = argil::mesh::read_stl(&solid.to_stl()) else { return };
    let Ok(plan) = Planner::default().plan(&mesh, &settings) else { return };
    assert!(plan.strand.length() > 0.0);
    let text = write_gcode(&plan.strand, &GcodeSettings::default()).expect("a planned strand can be written");
    let criterion = settings.criterion();
    let wanted = AuditSettings {
        layer_height: settings.layer_height,
        walls: settings.walls,
        floor: settings.floor,
        skin: settings.skin > 0,
        across: criterion.across,
        along: criterion.along,
        ..AuditSettings::for_width(settings.width)
    };
    let report = audit(&read_gcode(&text), &mesh, &wanted).expect("a plan can be measured");
    // What the slicer said it could not print as it is, the audit misses too; without such a loss nothing may be amiss.
    assert!(!plan.losses.is_empty() || report.is_sound(), "{report}");
}

/// One wall most often, and half of the time nothing inside of it.
fn settings(draw: &mut Draw<'_>) -> Settings {
    let walls = [1, 1, 1, 1, 1, 1, 2, 3][draw.below(8)];
    let width = [2.0, 2.5, 3.0][draw.below(3)];
    let floor = draw.below(6).saturating_sub(2);
    let skin = draw.below(5).saturating_sub(2);
    let spiral = draw.flag();
    let skirt = [None, None, Some(Skirt::default())][draw.below(3)];
    let infill = match draw.below(6) {
        0..=2 => Infill::None,
        3 => Infill::Auto,
        sparse => Infill::Ratio([0.1, 0.3][sparse - 4]),
    };
    Settings { walls, floor, skin, spiral, skirt, infill, ..Settings::for_width(width) }
}

/// A ball, a rod, a cylinder, a box, a tube or a ring somewhere in the box.
fn piece(draw: &mut Draw<'_>) -> Field {
    let kind = draw.below(6);
    let at = draw.point(REACH - 3.0);
    let base = at.extend(draw.within(0.0, TOP));
    let size = draw.within(2.0, 6.0);
    let other = draw.point(REACH - 3.0).extend(draw.within(0.0, TOP));
    match kind {
        0 => Field::sphere(base, size),
        1 => Field::rod((base, size), (other, 2.0)),
        2 => Field::cylinder(at, size, -1.0, other.z + 2.0),
        3 => Field::rounded_box(base - DVec3::splat(size), base + DVec3::splat(size), 1.0),
        4 => Field::tube((size, size + 3.0), (-2.0, other.z + 2.0), 0.5).translated(at.extend(0.0)),
        _ => Field::torus(base, other - base, size, 2.0),
    }
}
