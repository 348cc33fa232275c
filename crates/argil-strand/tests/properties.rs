//! Invariants of strands: what `Strand::new` lets in, and what the measures add up to.

use argil_strand::{BeadShape, DVec2, Move, Rise, Role, Strand, StrandError, StrandLayer};
use proptest::prelude::*;

const ROLES: [Role; 3] = [Role::Wall, Role::Support, Role::Connection];

/// Layers of random cycles, each reached by a seam step.
fn strands() -> impl Strategy<Value = (DVec2, Vec<StrandLayer>)> {
    let point = (-50.0..50.0f64, -50.0..50.0f64).prop_map(|(x, y)| DVec2::new(x, y));
    let cycle = prop::collection::vec((point, 0..3usize), 1..12);
    prop::collection::vec((cycle, 0.1..2.0f64, 0.1..4.0f64, 1..3usize), 1..6).prop_map(|cycles| {
        let start = cycles[0].0[0].0;
        let (mut z, mut index) = (0.0, 0);
        let mut layers = Vec::new();
        for (cycle, height, width, skip) in cycles {
            z += height;
            index += skip;
            let seam = cycle[0].0;
            let rise = (!layers.is_empty()).then_some(Move { to: seam, role: Role::Seam });
            let turn = cycle[1..].iter().map(|&(to, role)| Move { to, role: ROLES[role] });
            let back = Move { to: seam, role: Role::Wall };
            let moves = rise.into_iter().chain(turn).chain([back]).collect();
            layers.push(StrandLayer { index, z, height, width, moves, supports: vec![] });
        }
        (start, layers)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_step_begins_where_the_one_before_ended((start, layers) in strands()) {
        let strand = Strand::new(start, layers).unwrap();
        let steps: Vec<_> = strand.steps().collect();
        prop_assert_eq!(steps[0].from.truncate(), start);
        for pair in steps.windows(2) {
            prop_assert_eq!(pair[0].to, pair[1].from);
        }
        prop_assert_eq!(steps[steps.len() - 1].to.truncate(), strand.end());
        prop_assert_eq!(steps.len(), strand.layers().iter().map(|layer| layer.moves.len()).sum::<usize>());
    }

    #[test]
    fn polylines_close_and_the_measures_add_up((start, layers) in strands()) {
        let strand = Strand::new(start, layers).unwrap();
        let mut planar = 0.0;
        for k in 0..strand.layers().len() {
            let line = strand.polyline(k);
            prop_assert_eq!(line.first(), line.last());
            prop_assert_eq!(line.first().copied(), strand.seam(k));
            planar += line.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>();
        }
        let seams = strand.length_of(Role::Seam);
        prop_assert!((strand.length() - planar - seams).abs() < 1e-9 * strand.length().max(1.0));
        let summaries = strand.summaries();
        let volume: f64 = summaries.iter().map(|summary| summary.volume).sum();
        prop_assert!((volume - strand.volume()).abs() < 1e-9 * volume.max(1.0));
        for role in Role::ALL {
            let length: f64 = summaries.iter().map(|summary| summary.lengths.of(role)).sum();
            prop_assert!((length - strand.length_of(role)).abs() < 1e-9 * length.max(1.0));
        }
        prop_assert!(strand.volume() <= strand.volume_as(BeadShape::Box) * (1.0 + 1e-12));
    }

    #[test]
    fn one_spoilt_coordinate_is_refused(
        (start, mut layers) in strands(), pick in any::<prop::sample::Index>(),
        bad in prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY]),
    ) {
        let k = pick.index(layers.len());
        let last = layers[k].moves.len() - 1;
        layers[k].moves[last].to.y = bad;
        let refused = matches!(Strand::new(start, layers), Err(StrandError::NotFinite { layer, .. }) if layer == k);
        prop_assert!(refused);
    }

    #[test]
    fn an_open_layer_is_refused((start, mut layers) in strands(), pick in any::<prop::sample::Index>()) {
        let k = pick.index(layers.len());
        let last = layers[k].moves.len() - 1;
        layers[k].moves[last].to.x += 0.001;
        let refused = matches!(Strand::new(start, layers), Err(StrandError::Open { layer, .. }) if layer == k);
        prop_assert!(refused);
    }

    #[test]
    fn a_bead_grows_with_its_size(width in 0.01..10.0f64, height in 0.01..10.0f64, more in 0.001..1.0f64) {
        for shape in [BeadShape::Rounded, BeadShape::Box] {
            prop_assert!(shape.area(width + more, height) > shape.area(width, height));
            prop_assert!(shape.area(width, height + more) >= shape.area(width, height) * (1.0 - 1e-12));
        }
        prop_assert!(BeadShape::Rounded.area(width, height) < BeadShape::Box.area(width, height));
    }
}

/// Each layer but the lowest rises evenly from the one below, with beads as thick as it has risen so far.
fn rises(layers: &[StrandLayer]) -> Vec<Vec<Rise>> {
    let mut below = None;
    let rise = |layer: &StrandLayer| {
        let from = below.replace(layer.z)?;
        let count = layer.moves.len() as f64;
        let share = move |k: usize| (k + 1) as f64 / count;
        let at = |k: usize| Rise { z: from + (layer.z - from) * share(k), height: layer.height * share(k) };
        Some((0..layer.moves.len()).map(at).collect())
    };
    layers.iter().map(rise).map(Option::unwrap_or_default).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_strand_that_rises_never_falls_and_stays_in_place((start, layers) in strands()) {
        let level = Strand::new(start, layers.clone()).unwrap();
        let strand = level.clone().risen(rises(&layers)).unwrap();
        let mut volume = 0.0;
        for (step, flat) in strand.steps().zip(level.steps()) {
            prop_assert!(step.to.z >= step.from.z && step.to.z <= flat.to.z + 1e-12);
            prop_assert_eq!((step.to.truncate(), step.role), (flat.to.truncate(), flat.role));
            volume += step.length() * BeadShape::Box.area(layers[step.layer].width, step.height);
        }
        prop_assert!((volume - strand.volume_as(BeadShape::Box)).abs() < 1e-9 * volume.max(1.0));
        let by_layer: f64 = strand.summaries().iter().map(|summary| summary.volume).sum();
        prop_assert!((by_layer - strand.volume()).abs() < 1e-9 * by_layer.max(1.0));
        prop_assert_eq!(strand.risen(Vec::new()).unwrap(), level);
    }

    #[test]
    fn widths_are_one_for_each_move((start, layers) in strands(), pick in any::<prop::sample::Index>()) {
        let strand = Strand::new(start, layers.clone()).unwrap();
        let half: Vec<Vec<f64>> = layers.iter().map(|l| vec![0.5 * l.width; l.moves.len()]).collect();
        let slender = strand.clone().of_widths(half.clone()).unwrap();
        prop_assert!(slender.steps().all(|step| step.width == 0.5 * layers[step.layer].width));
        prop_assert!(slender.volume_as(BeadShape::Box) <= 0.5 * strand.volume_as(BeadShape::Box) * (1.0 + 1e-12));
        prop_assert_eq!(slender.clone().of_widths(vec![]).unwrap(), strand.clone());
        let k = pick.index(layers.len());
        let refused = |spoil: &dyn Fn(&mut Vec<Vec<f64>>)| {
            let mut widths = half.clone();
            spoil(&mut widths);
            strand.clone().of_widths(widths).err()
        };
        let too_many = matches!(
            refused(&|w| w[k].push(1.0)), Some(StrandError::WidthCount { layer, .. }) if layer == k
        );
        let no_layer = matches!(refused(&|w| w.push(vec![])), Some(StrandError::WidthCount { .. }));
        let none = matches!(refused(&|w| w[k][0] = 0.0), Some(StrandError::NoBead { layer, .. }) if layer == k);
        let unknown = matches!(refused(&|w| w[k][0] = f64::NAN), Some(StrandError::NotFinite { .. }));
        prop_assert!(too_many && no_layer && none && unknown);
    }

    #[test]
    fn a_rise_that_falls_or_does_not_fit_is_refused((start, layers) in strands(), pick in any::<prop::sample::Index>()) {
        let strand = Strand::new(start, layers.clone()).unwrap();
        let refused = |spoil: &dyn Fn(&mut Vec<Vec<Rise>>)| {
            let mut rises = rises(&layers);
            spoil(&mut rises);
            strand.clone().risen(rises).err()
        };
        let (lowest, count) = (layers[0].z, layers.len());
        let on_bed = |r: &mut Vec<Vec<Rise>>| r[0] = vec![Rise { z: lowest, height: 0.1 }; layers[0].moves.len()];
        let is_count = |error, at, due| matches!(
            error, Some(StrandError::RiseCount { layer, wanted, .. }) if layer == at && wanted == due
        );
        prop_assert!(is_count(refused(&|r| r.push(vec![])), count, count));
        prop_assert!(is_count(refused(&on_bed), 0, 0));
        if count > 1 {
            let k = 1 + pick.index(count - 1);
            let short = |r: &mut Vec<Vec<Rise>>| { r[k].pop(); };
            // A single move less one is none: the layer lies level.
            let due = layers[k].moves.len();
            prop_assert!(due == 1 || is_count(refused(&short), k, due));
            let falling = refused(&|r| r[k][0].z = lowest - 0.01);
            let falls = matches!(falling, Some(StrandError::Falling { layer, .. }) if layer == k);
            let thin = refused(&|r| r[k][0].height = -1e-9);
            let has_none = matches!(thin, Some(StrandError::NoBead { layer, .. }) if layer == k);
            let wild = refused(&|r| r[k][0].height = f64::NAN);
            let is_wild = matches!(wild, Some(StrandError::NotFinite { layer, .. }) if layer == k);
            prop_assert_eq!((falls, has_none, is_wild), (true, true, true));
        }
    }
}

/// Two layers of a triangle, to be spoilt.
fn triangle() -> (DVec2, Vec<StrandLayer>) {
    let to = |x, y, role| Move { to: DVec2::new(x, y), role };
    let turn = [to(9.0, 0.0, Role::Wall), to(4.0, 6.0, Role::Wall), to(0.0, 0.0, Role::Wall)];
    let above = [to(0.0, 0.0, Role::Seam)].into_iter().chain(turn).collect();
    let layer =
        |index, z, moves| StrandLayer { index, z, height: 0.5, width: 1.5, moves, supports: Vec::new() };
    (DVec2::ZERO, vec![layer(0, 0.5, turn.to_vec()), layer(1, 1.0, above)])
}

#[test]
fn every_departure_has_its_own_error() {
    let spoilt = |spoil: &dyn Fn(&mut Vec<StrandLayer>)| {
        let (start, mut layers) = triangle();
        spoil(&mut layers);
        Strand::new(start, layers).unwrap_err()
    };
    assert!(matches!(spoilt(&|l| l.clear()), StrandError::NoLayers));
    assert!(matches!(spoilt(&|l| l[1].z = 0.5), StrandError::NotRising { layer: 1, .. }));
    assert!(matches!(spoilt(&|l| l[1].index = 0), StrandError::NumberNotRising { layer: 1, .. }));
    assert!(matches!(spoilt(&|l| l[1].moves[0].role = Role::Wall), StrandError::NoSeamStep { layer: 1 }));
    assert!(matches!(spoilt(&|l| l[0].moves.clear()), StrandError::NoMoves { layer: 0 }));
    assert!(matches!(spoilt(&|l| l[1].moves.truncate(1)), StrandError::NoMoves { layer: 1 }));
    assert!(matches!(spoilt(&|l| l[1].width = 0.0), StrandError::NoBead { layer: 1, .. }));
    assert!(matches!(spoilt(&|l| l[0].moves.truncate(2)), StrandError::Open { layer: 0, .. }));
}

#[test]
fn positions_above_the_uppermost_layer_are_empty() {
    let (start, layers) = triangle();
    let strand = Strand::new(start, layers).unwrap();
    assert_eq!(strand.seam(2), None);
    assert!(strand.cycle(2).is_empty());
    assert!(strand.polyline(2).is_empty());
}

#[test]
fn a_skirt_leads_to_the_cycle_and_lies_nowhere_else() {
    let (start, mut layers) = triangle();
    let skirt = |x, y| Move { to: DVec2::new(x, y), role: Role::Skirt };
    layers[0].moves.splice(0..0, [skirt(20.0, 0.0), skirt(20.0, 20.0), skirt(start.x, start.y)]);
    let strand = Strand::new(DVec2::new(-5.0, -5.0), layers.clone()).unwrap();
    assert_eq!((strand.seam(0), strand.cycle(0).len()), (Some(start), 3));
    assert_eq!(strand.polyline(0).first(), strand.polyline(0).last());
    assert_eq!(strand.steps().next().unwrap().from.truncate(), strand.start());
    let refused = |layer: usize, at: usize| {
        let mut spoilt = layers.clone();
        spoilt[layer].moves[at].role = Role::Skirt;
        Strand::new(DVec2::new(-5.0, -5.0), spoilt).unwrap_err()
    };
    assert_eq!(refused(0, 4), StrandError::Skirt { layer: 0 });
    assert_eq!(refused(1, 2), StrandError::Skirt { layer: 1 });
    assert_eq!(refused(1, 0), StrandError::NoSeamStep { layer: 1 });
    layers[0].moves.truncate(3);
    assert_eq!(Strand::new(DVec2::ZERO, layers).unwrap_err(), StrandError::NoMoves { layer: 0 });
}

#[cfg(feature = "serde")]
#[test]
fn a_strand_survives_json_and_a_broken_one_is_refused() {
    let (start, layers) = triangle();
    let strand = Strand::new(start, layers).unwrap();
    let text = serde_json::to_string(&strand).unwrap();
    assert_eq!(serde_json::from_str::<Strand>(&text).unwrap(), strand);
    let spiral = strand.clone().risen(rises(strand.layers())).unwrap();
    let risen = serde_json::to_string(&spiral).unwrap();
    assert_eq!(serde_json::from_str::<Strand>(&risen).unwrap(), spiral);
    assert!(!text.contains("rises") && risen.contains("rises"));
    let broken = text.replace("\"seam\"", "\"wall\"");
    assert!(serde_json::from_str::<Strand>(&broken).is_err());
}
