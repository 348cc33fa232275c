use argil_curve::DVec2;
use argil_gcode::strand::{BeadShape, Move, Role, Strand, StrandLayer};
use argil_gcode::{Extrusion, Flavour, GcodeSettings, read_gcode};

use crate::Draw;

/// Most layers of an input.
const MOST_LAYERS: usize = 8;

/// Most moves of a layer.
const MOST_MOVES: usize = 40;

/// Writes a strand in any dialect and reads it again: a typed error, or the moves, layers, roles and the paste of the strand.
pub fn write_gcode(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let settings = settings(&mut draw);
    let Some(strand) = strand(&mut draw) else { return };
    let Ok(text) = argil_gcode::write_gcode(&strand, &settings) else { return };
    let program = read_gcode(&text);
    assert!(program.bad_lines.is_empty(), "{:?}", program.bad_lines);
    let laid = program.strand_moves();
    for pair in laid.windows(2) {
        assert_eq!(pair[0].to, pair[1].from, "a move between moves that lay paste");
        assert!(pair[1].to[2] >= pair[0].to[2], "{:?} goes down", pair[1]);
    }
    let steps = 10f64.powi(-i32::from(settings.decimals));
    let places: Vec<(usize, [f64; 3], Role)> = strand
        .steps()
        .map(|step| (strand.layers()[step.layer].index, step.to.to_array(), step.role))
        .collect();
    for step in laid {
        let is_place = |place: &&(usize, [f64; 3], Role)| {
            step.layer == Some(place.0 as i64)
                && (0..2).all(|k| (place.1[k] - step.to[k]).abs() <= 0.51 * steps)
        };
        assert!(places.iter().any(|place| is_place(&place)), "{step:?} ends at no place of its layer");
        let word = program.kind_of(step).expect("every move is of a kind");
        assert!(settings.names.role(word).is_some(), "{word} is no role");
    }
    if matches!(settings.extrusion, Extrusion::Units)
        && settings.e_decimals.is_none()
        && settings.decimals >= 4
    {
        // What is shorter than a step of the output is joined with what follows, so that the clay is all laid.
        let (paste, volume) = (program.extruded() * settings.mm3_per_e, strand.volume_as(settings.bead));
        assert!(
            (paste - volume).abs() <= 1e-3 * settings.mm3_per_e.max(1.0) + 1e-3 * volume,
            "{paste} of {volume} mm³"
        );
    }
}

fn settings(draw: &mut Draw<'_>) -> GcodeSettings {
    GcodeSettings {
        relative_e: draw.flag(),
        mm3_per_e: [2.405, 1.0, 6.379, 403.0, 0.01][draw.below(5)],
        bead: if draw.flag() { BeadShape::Box } else { BeadShape::Rounded },
        flavour: [Flavour::Marlin, Flavour::RepRapFirmware, Flavour::Klipper][draw.below(3)],
        extrusion: [
            Extrusion::Units,
            Extrusion::Volumetric { diameter: 1.75 },
            Extrusion::Constant { rate: 20.0 },
        ][draw.below(3)],
        line_numbers: draw.flag(),
        decimals: 2 + draw.byte() % 4,
        e_decimals: draw.flag().then(|| draw.byte() % 6),
        ..GcodeSettings::default()
    }
}

/// Cycles, one above the other, with points that may coincide; `None` for what is no strand.
fn strand(draw: &mut Draw<'_>) -> Option<Strand> {
    const ROLES: [Role; 4] = [Role::Wall, Role::Support, Role::Connection, Role::Fill];
    let fine = draw.flag();
    let point = |draw: &mut Draw<'_>| if fine { draw.point(60.0) } else { draw.lattice_point(20) * 0.01 };
    let start: DVec2 = point(draw);
    let (mut z, mut index) = (0.0, 0);
    let mut layers = Vec::new();
    while layers.len() < MOST_LAYERS && !draw.is_empty() {
        let height = 0.05 * (1.0 + draw.below(40) as f64);
        z += height;
        index += 1 + draw.below(2);
        let mut moves = Vec::new();
        for number in 0..=draw.below(MOST_MOVES) {
            let role = if number == 0 && !layers.is_empty() { Role::Seam } else { ROLES[draw.below(4)] };
            moves.push(Move { to: point(draw), role });
        }
        let width = draw.within(0.3, 4.0);
        layers.push(StrandLayer { index, z, height, width, moves, supports: Vec::new() });
    }
    Strand::new(start, layers).ok()
}
