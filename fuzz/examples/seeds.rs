//! Writes the made seeds again: `cargo run --example seeds`. Those that were found by fuzzing stay as they are.

use std::fs;
use std::path::Path;

/// Numbers that depend on nothing but their seed.
struct SplitMix(u64);

impl SplitMix {
    fn byte(&mut self) -> u8 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed >> 56) as u8
    }
}

/// A tetrahedron as text and in binary, whole, cut short, and with a number that is none.
fn stl_files() -> [(&'static str, Vec<u8>); 5] {
    let corners = [[0.0_f32, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 10.0]];
    let sides = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let mut text = String::from("solid tetrahedron\n");
    let mut binary = vec![b' '; 80];
    binary.extend(4_u32.to_le_bytes());
    for side in sides {
        text += "  facet normal 0 0 0\n    outer loop\n";
        binary.extend([0; 12]);
        for corner in side.map(|k: usize| corners[k]) {
            text += &format!("      vertex {} {} {}\n", corner[0], corner[1], corner[2]);
            binary.extend(corner.iter().flat_map(|value| value.to_le_bytes()));
        }
        text += "    endloop\n  endfacet\n";
        binary.extend([0, 0]);
    }
    text += "endsolid tetrahedron\n";
    let mut not_a_number = binary.clone();
    not_a_number[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    [
        ("ascii", text.clone().into_bytes()),
        ("ascii_cut", text.as_bytes()[..200].to_vec()),
        ("binary_cut", binary[..150].to_vec()),
        ("not_a_number", not_a_number),
        ("binary", binary),
    ]
}

/// Moves, arcs and comments as slicers write them, and as none should.
fn gcode_files() -> [(&'static str, &'static str); 5] {
    [
        (
            "strand",
            "G21\nG90\nM83\nG1 Z0.5 F1200\n;LAYER:0\n;TYPE:WALL-OUTER\nG1 X10 Y0 E1.2\nG1 X10 Y10 E1.2\nG1 X0 Y0 E1.7\n",
        ),
        ("arcs", "M82\nG92 E0\nG2 X10 Y0 I5 J0 E3\nG3 X0 Y0 R-5.5 E9\nG2 X0 Y0 I1e9 J-1e9\nG2 X1 Y1\n"),
        (
            "odd_numbers",
            "G1 X1e400 Y-.5 Z+.5\nG1 X--1 Ynan Z\nG1X1Y2E.\nG0 X9999999999999999999999\nG92 X1e308\nG91\nG1 X1e308\n",
        ),
        ("relative", "G91\nM83\nG1 X1 E1\nG1 Y1 E1\nG28\nG90\nG20\nG1 X1\nG10\nG11\n"),
        (
            "line_ends",
            "G1 X1\rG1 X2\r\nG1 X3 ; (a) comment\n(b) G1 X4 *71\nN5 G1 X5*12\n;LAYER:-3\n;LAYER:x\n\u{fffd}",
        ),
    ]
}

fn main() -> std::io::Result<()> {
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds");
    let write = |target: &str, name: &str, bytes: &[u8]| {
        fs::create_dir_all(kept.join(target))?;
        fs::write(kept.join(target).join(name), bytes)
    };
    for (name, bytes) in stl_files() {
        write("read_stl", name, &bytes)?;
    }
    for (name, text) in gcode_files() {
        write("read_gcode", name, text.as_bytes())?;
    }
    // Of the other targets any bytes make an input; longer ones make larger inputs.
    let drawn = argil_fuzz::TARGETS.iter().filter(|(name, _)| !name.starts_with("read_"));
    for (number, (name, _)) in drawn.enumerate() {
        for (k, length) in [24, 48, 96, 192, 384].into_iter().enumerate() {
            let mut random = SplitMix((10 * number + k) as u64);
            let bytes: Vec<u8> = (0..length).map(|_| random.byte()).collect();
            write(name, &format!("drawn_{length}"), &bytes)?;
        }
    }
    Ok(())
}
