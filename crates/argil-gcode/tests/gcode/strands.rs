//! Strands by lot, and plain ones.

use argil_strand::{DVec2, Move, Rise, Role, Strand, StrandLayer};
use proptest::prelude::*;

const ROLES: [Role; 4] = [Role::Wall, Role::Support, Role::Connection, Role::Fill];

/// Strands with points on a grid of `step` mm; a coarse grid makes many points coincide.
pub(crate) fn strands(step: f64, reach: i32) -> impl Strategy<Value = Strand> {
    (level_strands(step, reach), any::<bool>())
        .prop_map(|(strand, rises)| if rises { risen(strand) } else { strand })
}

/// The same strand, its layers rising evenly but for the lowest and the uppermost, on a grid of 1e-4 mm.
fn risen(strand: Strand) -> Strand {
    let mut below = strand.layers()[0].z;
    let last = strand.layers().len() - 1;
    let rise = |(k, layer): (usize, &StrandLayer)| {
        let (from, count) = (std::mem::replace(&mut below, layer.z), layer.moves.len() as f64);
        let at = |n: usize| {
            let share = (n + 1) as f64 / count;
            let z = ((from + (layer.z - from) * share) * 1e4).round() / 1e4;
            Rise { z, height: layer.height * (0.5 + 0.5 * share) }
        };
        if k == 0 || k == last { Vec::new() } else { (0..layer.moves.len()).map(at).collect() }
    };
    let rises = strand.layers().iter().enumerate().map(rise).collect();
    strand.risen(rises).unwrap()
}

fn level_strands(step: f64, reach: i32) -> impl Strategy<Value = Strand> {
    let point = (-reach..reach, -reach..reach)
        .prop_map(move |(x, y)| DVec2::new(f64::from(x) * step, f64::from(y) * step));
    let cycle = prop::collection::vec((point, 0..4usize), 1..12);
    prop::collection::vec((cycle, 1..40u32, 0.3..4.0f64, 1..3usize), 1..6).prop_map(|cycles| {
        let start = cycles[0].0[0].0;
        let (mut z, mut index) = (0.0, 0);
        let mut layers = Vec::new();
        for (cycle, height, width, skip) in cycles {
            let height = f64::from(height) * 0.05;
            z += height;
            index += skip;
            let seam = cycle[0].0;
            let rise = (!layers.is_empty()).then_some(Move { to: seam, role: Role::Seam });
            let turn = cycle[1..].iter().map(|&(to, role)| Move { to, role: ROLES[role] });
            let back = Move { to: seam, role: Role::Wall };
            let moves = rise.into_iter().chain(turn).chain([back]).collect();
            layers.push(StrandLayer { index, z, height, width, moves, supports: vec![] });
        }
        Strand::new(start, layers).unwrap()
    })
}

/// Wavy rings with many points: runs of arcs, with corners between.
pub(crate) fn waves() -> impl Strategy<Value = Strand> {
    (3..9u32, 0.0..0.5f64, 40..200usize, 5.0..60.0f64).prop_map(|(lobes, depth, count, radius)| {
        let at = |k: usize| {
            let angle = std::f64::consts::TAU * (k % count) as f64 / count as f64;
            DVec2::from_angle(angle) * radius * (1.0 + depth * (angle * f64::from(lobes)).sin().abs())
        };
        let roles = |k: usize| if k % 37 < 9 { Role::Support } else { Role::Wall };
        let turn: Vec<Move> = (1..=count).map(|k| Move { to: at(k), role: roles(k) }).collect();
        let layer = |k: usize| StrandLayer {
            index: k,
            z: 0.5 * (k as f64 + 1.0),
            height: 0.5,
            width: 1.5,
            moves: (k > 0)
                .then_some(Move { to: at(0), role: Role::Seam })
                .into_iter()
                .chain(turn.clone())
                .collect(),
            supports: vec![],
        };
        Strand::new(at(0), (0..2).map(layer).collect()).unwrap()
    })
}

pub(crate) fn square(side: f64) -> Strand {
    let corners = [(side, 0.0), (side, side), (0.0, side), (0.0, 0.0)];
    let moves = corners.map(|(x, y)| Move { to: DVec2::new(x, y), role: Role::Wall }).to_vec();
    let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves, supports: vec![] };
    Strand::new(DVec2::ZERO, vec![layer]).unwrap()
}

/// A ring of many points, laid level once, then rising by a layer a turn as often as is said, and level at last.
pub(crate) fn helix(turns: usize, count: usize) -> Strand {
    let at = |k: usize| DVec2::from_angle(std::f64::consts::TAU * (k % count) as f64 / count as f64) * 30.0;
    let turn: Vec<Move> = (1..=count).map(|k| Move { to: at(k), role: Role::Wall }).collect();
    let seam = Move { to: at(0), role: Role::Seam };
    let layer = |k: usize| StrandLayer {
        index: k,
        z: 0.5 * (k as f64 + 1.0),
        height: 0.5,
        width: 1.5,
        moves: (k > 0).then_some(seam).into_iter().chain(turn.clone()).collect(),
        supports: vec![],
    };
    let share = |n: usize| n as f64 / count as f64;
    let rise = |k: usize, n: usize| match k {
        1 => Rise { z: 0.5 + 0.5 * share(n), height: 0.5 * share(n) },
        _ if k > turns => Rise { z: 0.5 * (turns as f64 + 1.0), height: 0.5 * (1.0 - share(n)) },
        _ => Rise { z: 0.5 * (k as f64 + share(n)), height: 0.5 },
    };
    let rises = |k: usize| if k == 0 { Vec::new() } else { (0..=count).map(|n| rise(k, n)).collect() };
    let strand = Strand::new(at(0), (0..turns + 2).map(layer).collect()).unwrap();
    strand.risen((0..turns + 2).map(rises).collect()).unwrap()
}
