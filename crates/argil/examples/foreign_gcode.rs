//! The audit on a file in the dialect of another slicer: is it one strand, does it lie on something, is the wall there?

use std::error::Error;

use argil::mesh::Mesh;
use argil_audit::{AuditSettings, audit, gcode::read_gcode};

/// A file in CuraEngine's dialect: absolute E, `;LAYER:` and `;TYPE:` comments, the wall of the block, and one side of
/// it left out by a `hop`.
fn file(layers: usize, hop: bool) -> String {
    let mut text = String::from(";FLAVOR:Marlin\n;Generated with Cura_SteamEngine 5.6.0\nM82\nG92 E0\n");
    let mut e = 0.0;
    for layer in 0..layers {
        let z = 0.5 * (layer + 1) as f64;
        text.push_str(&format!(";LAYER:{layer}\n"));
        text.push_str(if layer == 0 { "G0 F3000 X.75 Y.75 Z.5\n" } else { "" });
        text.push_str(";TYPE:WALL-OUTER\n");
        for (k, (x, y)) in
            [(0.75, 0.75), (17.25, 0.75), (17.25, 17.25), (0.75, 17.25), (0.75, 0.75)].into_iter().enumerate()
        {
            e += if k == 0 { 0.05 } else { 1.65 };
            if hop && k == 3 {
                text.push_str(&format!("G0 X{x} Y{y}\n"));
            } else {
                text.push_str(&format!("G1 F1500 X{x} Y{y} Z{z} E{e:.5}\n"));
            }
        }
    }
    text
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mesh = Mesh::cuboid([0.0; 3], [18.0, 18.0, 3.0])?;
    let settings = AuditSettings::for_width(1.5);

    let sound = audit(&read_gcode(&file(6, false)), &mesh, &settings)?;
    assert!(sound.is_sound(), "{sound}");

    let hopping = audit(&read_gcode(&file(6, true)), &mesh, &settings)?;
    assert_eq!(hopping.figures.transfer_moves, 6);
    let short: Vec<&str> = hopping.falls_short().iter().map(|short| short.figure).collect();
    assert!(short.contains(&"transfer_moves"), "{short:?}");
    Ok(())
}
