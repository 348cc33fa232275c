//! The g-code of eleven plans, byte by byte, as it was kept: a change of any byte is seen, and is either meant or a fault.
//!
//! `ARGIL_KEEP=1 cargo test -p argil --test kept_bytes` keeps what is there now. Sums of many products have other last bits
//! with fused multiplication than without, and another mathematical library has other sines, so that hashes are
//! kept for the kinds of machine that they were made on; on another kind only two runs are compared.

mod sample;

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use argil::gcode::{GcodeSettings, write_gcode};
use argil::mesh::{Ground, Mesh, Placement, Size};
use argil::{Planner, Settings, Skirt};
use sample::sample;

/// Bundled models by name, with the factor and the bead width that they are planned with, so that each takes a second or two.
const MODELS: [(&str, f64, f64); 11] = [
    ("arch", 0.5, 2.0),
    ("cactus", 0.4, 2.0),
    ("columns", 1.0, 3.0),
    ("columns", 0.5, 1.5),
    ("cup", 0.4, 2.0),
    ("cup:spiral", 0.4, 2.0),
    ("hanging-island", 0.5, 2.0),
    ("nested-rings", 0.5, 2.0),
    ("nested-rings", 0.7, 3.0),
    ("spire", 0.7, 3.0),
    ("table", 0.5, 2.0),
];

/// Behind the name of a model that is planned as a spiral with a skirt.
const SPIRAL: &str = ":spiral";

fn kept() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/kept_bytes.txt")
}

/// What of a machine may change last bits, as far as a program can see it.
fn machine() -> String {
    #[cfg(target_arch = "x86_64")]
    let fused = std::arch::is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    let fused = true;
    let fused = if fused { "fused" } else { "plain" };
    format!("{}-{}-{fused}", std::env::consts::ARCH, std::env::consts::OS)
}

/// The hash of Fowler, Noll and Vo in 64 bits, which is the same everywhere.
fn hash(text: &str) -> u64 {
    text.bytes()
        .fold(0xcbf2_9ce4_8422_2325, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

fn mesh(name: &str, factor: f64) -> Mesh {
    let placement = Placement { size: Size::Scale(factor), ground: Ground::Keep };
    sample(name).placed(&placement).expect("a mesh can be scaled")
}

fn hash_of((name, factor, width): (&str, f64, f64)) -> u64 {
    let plain = Settings::for_width(width);
    let (model, settings) = match name.strip_suffix(SPIRAL) {
        Some(model) => (model, Settings { spiral: true, skirt: Some(Skirt::default()), ..plain }),
        None => (name, plain),
    };
    let plan = Planner::default().plan(&mesh(model, factor), &settings);
    let plan = plan.unwrap_or_else(|error| panic!("{name} times {factor}, bead {width}: {error}"));
    hash(&write_gcode(&plan.strand, &GcodeSettings::default()).expect("a strand can be written"))
}

#[test]
fn the_bytes_are_those_that_were_kept() {
    let machine = machine();
    let mut now = String::new();
    for model in MODELS {
        let (name, factor, width) = model;
        writeln!(now, "{machine} {name} {factor} {width} {:016x}", hash_of(model))
            .expect("a text takes a line");
    }
    let text = fs::read_to_string(kept()).unwrap_or_default();
    let is_ours = |line: &&str| line.starts_with(&format!("{machine} "));
    if std::env::var_os("ARGIL_KEEP").is_some() {
        let others = text.lines().filter(|line| !is_ours(line));
        let all: String = others.chain(now.lines()).flat_map(|line| [line, "\n"]).collect();
        fs::write(kept(), all).expect("the hashes can be kept");
        return;
    }
    let before: Vec<&str> = text.lines().filter(is_ours).collect();
    if before.is_empty() {
        assert_eq!(hash_of(MODELS[2]), hash_of(MODELS[2]), "two runs differ");
        return;
    }
    let changed: Vec<&str> = now.lines().filter(|line| !before.contains(line)).collect();
    assert!(
        changed.is_empty() && before.len() == MODELS.len(),
        "the g-code has changed:\n{}",
        changed.join("\n")
    );
}
