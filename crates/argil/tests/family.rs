//! Bodies drawn by lot: whatever they are, their strand is sound.

mod verdict;

use argil::mesh::{Mesh, read_stl};
use argil::{Planner, Settings};
use argil_models::{Bounds, DVec3, Field, mesh_of};
use verdict::audited;

/// How many bodies are drawn, unless `ARGIL_SEEDS` says otherwise.
const SEEDS: u64 = 12;
/// In how many tests, which run side by side.
const TESTS: u64 = 4;
/// Half the width of the room that bodies are drawn in, and its height, mm.
const REACH: f64 = 12.0;
const TOP: f64 = 14.0;

/// A small generator (`SplitMix64`), so that a seed gives the same body for good.
struct Lot(u64);

impl Lot {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self, low: f64, high: f64) -> DVec3 {
        let reach = REACH - 4.0;
        DVec3::new(self.between(-reach, reach), self.between(-reach, reach), self.between(low, high))
    }
}

/// Three to six balls and rods, some blended, the first ones on the bed, the others anywhere, also in mid-air.
fn body(seed: u64) -> Mesh {
    let mut lot = Lot(seed);
    let parts = 3 + lot.next() % 4;
    let body = (0..parts).fold(Field::empty(), |body, part| {
        let stands = part < 2;
        let from = if stands { lot.point(-1.0, 2.0) } else { lot.point(2.0, TOP - 3.0) };
        let thick = lot.between(1.6, 3.6);
        let part = if lot.next().is_multiple_of(3) {
            Field::sphere(from, thick)
        } else {
            Field::rod((from, thick), (lot.point(2.0, TOP - 3.0), lot.between(1.6, 3.0)))
        };
        if lot.next().is_multiple_of(2) { body.blended(part, 2.0) } else { body.union(part) }
    });
    let room = Bounds { min: DVec3::new(-REACH, -REACH, 0.0), max: DVec3::new(REACH, REACH, TOP) };
    let solid = mesh_of(&body, room, 0.7).expect("the room spans a grid");
    read_stl(&solid.to_stl()).expect("meshes of fields are sound")
}

/// What is wrong with the plan of a body, if anything.
fn shortfall(seed: u64) -> Option<String> {
    let (mesh, settings) = (body(seed), Settings::default());
    match Planner::default().plan(&mesh, &settings) {
        Err(error) => Some(format!("seed {seed}: {error}")),
        Ok(plan) => {
            let report = audited(&plan, &mesh, &settings);
            (!report.is_sound()).then(|| format!("seed {seed}:\n{report}"))
        }
    }
}

/// Every `TESTS`-th seed from `first` on.
fn assert_sound(first: u64) {
    let seeds = std::env::var("ARGIL_SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(SEEDS);
    let found: Vec<String> = (first..seeds).step_by(TESTS as usize).filter_map(shortfall).collect();
    assert!(found.is_empty(), "{} of the bodies fall short\n{}", found.len(), found.join("\n"));
}

#[test]
fn bodies_by_lot_are_sound() {
    assert_sound(0);
}

#[test]
fn more_bodies_by_lot_are_sound() {
    assert_sound(1);
}

#[test]
fn further_bodies_by_lot_are_sound() {
    assert_sound(2);
}

#[test]
fn the_last_bodies_by_lot_are_sound() {
    assert_sound(3);
}
