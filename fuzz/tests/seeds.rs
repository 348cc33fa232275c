//! Replays the kept inputs of every target, without libFuzzer.

use std::panic::catch_unwind;
use std::path::Path;

#[test]
fn every_seed_holds() {
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds");
    for (name, target) in argil_fuzz::TARGETS {
        let folder =
            std::fs::read_dir(kept.join(name)).unwrap_or_else(|error| panic!("seeds of {name}: {error}"));
        let mut files: Vec<_> = folder.map(|entry| entry.unwrap().path()).collect();
        files.sort();
        assert!(files.len() > 2, "{name} has only {} seeds", files.len());
        for file in files {
            // The harness shows this only if the target panics.
            println!("{}", file.display());
            target(&std::fs::read(&file).unwrap());
        }
    }
}

#[test]
fn short_inputs_hold() {
    for (name, target) in argil_fuzz::TARGETS {
        for length in 0..8 {
            for byte in [0, 1, 127, 255] {
                let held = catch_unwind(|| target(&vec![byte; length]));
                assert!(held.is_ok(), "{name}: {length} times {byte}");
            }
        }
    }
}
