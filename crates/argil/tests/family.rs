//! Bodies drawn by lot: whatever they are, their strand is sound.
//!
//! `ARGIL_SEEDS=1000` draws as many, `ARGIL_SEEDS=200..1000` those of a range. With `ARGIL_SHRINK=1` a body that fails
//! is taken apart to the least that fails in the same way, which can be written down as a test of its own.

mod body;
mod invariants;
mod verdict;

use std::ops::Range;

use argil::Settings;
use body::{KINDS, case_of, fault, shrunk};

/// Which seeds are drawn, unless `ARGIL_SEEDS` says otherwise.
const SEEDS: Range<u64> = 0..200;

/// In how many tests, which run side by side.
const TESTS: u64 = 4;

fn seeds() -> Range<u64> {
    let Ok(told) = std::env::var("ARGIL_SEEDS") else { return SEEDS };
    let number = |text: &str| text.trim().parse().expect("ARGIL_SEEDS is a number or a range");
    told.split_once("..").map_or_else(|| 0..number(&told), |(from, to)| number(from)..number(to))
}

/// What is wrong with the plan of a seed, if anything.
fn shortfall(seed: u64) -> Option<String> {
    let (kind, body, settings) = case_of(seed);
    let found = fault(&body, &settings)?;
    let Settings { width, layer_height, walls, .. } = settings;
    let told = format!("seed {seed} ({kind}; w {width}, h {layer_height}, {walls} walls): {found}");
    if std::env::var_os("ARGIL_SHRINK").is_none() {
        return Some(told);
    }
    let least = shrunk(&body, |body| fault(body, &settings).is_some_and(|other| other.kind == found.kind));
    Some(format!("{told}\n  {least:?}"))
}

/// Every `TESTS`-th seed from `first` on.
fn assert_sound(first: u64) {
    let seeds = seeds();
    let drawn = (seeds.start + first..seeds.end).step_by(TESTS as usize);
    let found: Vec<String> = drawn.filter_map(shortfall).collect();
    assert!(found.is_empty(), "{} of the bodies fall short\n{}", found.len(), found.join("\n"));
}

/// Seeds that are drawn with floors and skins, unless `ARGIL_SEEDS` says otherwise.
const CLOSED: Range<u64> = 300..312;

#[test]
fn bodies_with_floor_and_skin_are_sound() {
    let mut found = Vec::new();
    let told = std::env::var_os("ARGIL_SEEDS").map(|_| seeds());
    for seed in told.unwrap_or(CLOSED) {
        let (kind, body, settings) = case_of(seed);
        let settings = Settings { floor: 2, skin: 1 + seed as usize % 2, ..settings };
        found.extend(fault(&body, &settings).map(|fault| format!("seed {seed} ({kind}): {fault}")));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
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

/// What a case is drawn as must not change with what is drawn after it: seeds are written down.
#[test]
fn every_kind_has_a_body() {
    for seed in 0..4 * KINDS.len() as u64 {
        let (kind, body, _) = case_of(seed);
        assert!(body.mesh().is_some(), "seed {seed}, {kind}, is empty");
        assert_eq!(body, case_of(seed).1);
    }
}
