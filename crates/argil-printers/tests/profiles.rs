//! The bundled profiles are sound, and no text makes the readers panic.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::path::Path;

use argil_printers::{Material, Printer, ProfileError, materials, printers, render};
use proptest::prelude::*;

/// Names that templates of bundled printers may use, as the program gives them.
const NAMES: [&str; 4] = ["first_z", "approach_z", "first_x", "first_y"];

fn files(folder: &str) -> BTreeSet<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let names =
        std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.map(|name| name.strip_suffix(".toml").unwrap().to_owned()).collect()
}

#[test]
fn every_file_is_listed_in_order() {
    for (folder, listed) in [("printers", printers()), ("materials", materials())] {
        let names: Vec<&str> = listed.iter().map(|(name, _)| *name).collect();
        assert!(names.is_sorted());
        assert_eq!(names.into_iter().map(str::to_owned).collect::<BTreeSet<_>>(), files(folder));
    }
}

#[test]
fn printers_are_sound_and_their_code_is_safe() {
    for (name, text) in printers() {
        let printer = Printer::from_toml(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(printer.flavour.value().is_some(), "{name}");
        let values = NAMES.map(|name| (name, "1".to_owned()));
        for code in [&printer.start, &printer.end].into_iter().filter_map(|fact| fact.value()) {
            let code = render(code, &values).unwrap_or_else(|error| panic!("{name}: {error}"));
            for line in code.lines() {
                let word = line.split_whitespace().next().unwrap_or("");
                // M92 changes the machine for good; M302 without a parameter only reports; G92 Z hides the height.
                assert!(word != "M92" && line.trim() != "M302", "{name}: {line}");
                assert!(!(word == "G92" && line.contains('Z')), "{name}: {line}");
                // A paste is not heated.
                assert!(!["M104", "M109", "M140", "M190"].contains(&word), "{name}: {line}");
            }
        }
        let used: BTreeSet<&str> =
            text.split("source = \"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(printer.sources.keys().map(String::as_str).collect::<BTreeSet<_>>(), used, "{name}");
    }
}

#[test]
fn e_is_the_filament_that_the_note_names() {
    let mut told = 0;
    for (name, text) in printers() {
        let printer = Printer::from_toml(text).unwrap();
        let Some((_, Some(note))) = printer.mm3_per_e.origin() else { continue };
        let Some(diameter) =
            note.strip_prefix("mm of a filament of ").and_then(|rest| rest.strip_suffix(" mm"))
        else {
            continue;
        };
        let area = std::f64::consts::PI * diameter.parse::<f64>().unwrap().powi(2) / 4.0;
        assert!((printer.mm3_per_e.value().unwrap() - area).abs() < 1e-3, "{name}: {area}");
        told += 1;
    }
    assert!(told > 6, "{told}");
}

#[test]
fn materials_are_sound() {
    for (name, text) in materials() {
        let material = Material::from_toml(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        if let (Some([low, high]), Some(drying), Some(firing)) =
            (material.shrinkage.value(), material.drying.value(), material.firing.value())
        {
            // Shares that contradict their total by more than the ranges allow are a slip.
            let total = |k: usize| 100.0 * (1.0 - (1.0 - drying[k] / 100.0) * (1.0 - firing[k] / 100.0));
            assert!(total(0) <= *high && total(1) >= *low, "{name}");
        }
    }
}

#[test]
fn profiles_without_a_source_are_refused() {
    let text = printers().iter().find(|(name, _)| *name == "eazao-zero").unwrap().1;
    assert!(matches!(
        Printer::from_toml(&text.replace("source = \"cura\"", "source = \"hearsay\"")),
        Err(ProfileError::Source { .. })
    ));
    assert!(matches!(Printer::from_toml(&text.replace("2.405", "-1.0")), Err(ProfileError::Number { .. })));
    assert!(matches!(Printer::from_toml(&text.replace("feed =", "speed =")), Err(ProfileError::Toml(_))));
    assert!(matches!(
        Printer::from_toml(&text.replace("feed = { value = 25, ", "feed = { ")),
        Err(ProfileError::Toml(_))
    ));
}

#[test]
fn reach_is_that_of_the_bed() {
    let zero = Printer::bundled("eazao-zero").unwrap().unwrap();
    assert_eq!(zero.reaches([0.0; 3], [150.0, 150.0, 240.0]), Some(true));
    assert_eq!(zero.reaches([-1.0, 0.0, 0.0], [10.0; 3]), Some(false));
    let delta = Printer::bundled("wasp-2040-clay").unwrap().unwrap();
    assert_eq!(delta.middle(), Some([0.0, 0.0]));
    assert_eq!(delta.reaches([-70.0, -70.0, 0.0], [70.0, 70.0, 400.0]), Some(true));
    assert_eq!(delta.reaches([-80.0, -80.0, 0.0], [70.0, 70.0, 10.0]), Some(false));
    // Prints run from 17 to 398 mm and from 12 to 393 mm.
    let large = Printer::bundled("potterbot-10-xl").unwrap().unwrap();
    assert_eq!(large.middle(), Some([207.5, 202.5]));
    assert_eq!(large.reaches([17.0, 12.0, 0.0], [398.0, 393.0, 710.0]), Some(true));
    assert_eq!(large.reaches([16.0, 12.0, 0.0], [398.0, 393.0, 710.0]), Some(false));
    assert_eq!(Printer::bundled("robot-cell").unwrap().unwrap().reaches([0.0; 3], [1.0; 3]), None);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_text_stops_the_readers(text in "(?s).{0,120}", template in "[{}a-z; \n]{0,40}") {
        prop_assert!(Printer::from_toml(&text).is_err());
        prop_assert!(Material::from_toml(&text).is_err());
        drop(render(&template, &[("a", "1".to_owned())]));
    }

    #[test]
    fn text_without_braces_is_kept_and_doubled_braces_are_one(text in "[^{}]{0,40}") {
        prop_assert_eq!(render(&text, &[]).unwrap(), text.clone());
        prop_assert_eq!(render(&format!("{{{{{text}}}}}"), &[]).unwrap(), format!("{{{text}}}"));
    }
}
