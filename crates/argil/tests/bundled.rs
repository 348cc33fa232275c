//! Every bundled model plans to a strand that the audit finds sound.

mod sample;
mod verdict;

use argil::{Planner, Settings};
use sample::sample;
use verdict::audited;

fn assert_sound(name: &str, width: f64) {
    let (mesh, settings) = (sample(name), Settings::for_width(width));
    let plan = Planner::default().plan(&mesh, &settings).unwrap_or_else(|e| panic!("{name}: {e}"));
    let report = audited(&plan, &mesh, &settings);
    assert!(report.is_sound(), "{name} at {width} mm falls short\n{report}");
}

macro_rules! sound {
    ($($test:ident: $name:literal at $width:literal mm;)*) => {
        $(#[test]
        fn $test() {
            assert_sound($name, $width);
        })*

        /// The models that are planned above.
        const PLANNED: &[&str] = &[$($name),*];
    };
}

// One test a model, so that they run side by side; the dear ones in a wider bead.
sound! {
    arch_is_sound: "arch" at 1.5 mm;
    cactus_is_sound: "cactus" at 2.5 mm;
    columns_are_sound: "columns" at 1.5 mm;
    cup_is_sound: "cup" at 1.5 mm;
    hanging_island_is_sound: "hanging-island" at 1.5 mm;
    nested_rings_are_sound: "nested-rings" at 1.5 mm;
    spire_is_sound: "spire" at 1.5 mm;
    table_is_sound: "table" at 1.5 mm;
}

#[test]
fn no_bundled_model_is_left_out() {
    let missing: Vec<&str> = argil_models::names().filter(|name| !PLANNED.contains(name)).collect();
    assert!(missing.is_empty(), "{missing:?} are not planned here");
}
