//! Bodies and settings drawn by lot.

use std::f64::consts::{PI, TAU};

use argil::Settings;

use super::Join::{Add, Blend, Cut};
use super::Piece::{Block, Ring, Rod};
use super::{Body, Join, Piece, REACH, TOP};

/// Bead width, layer height and walls of the cases, mm.
const BEADS: [(f64, f64, usize); 12] = [
    (1.5, 0.5, 1),
    (1.5, 0.5, 2),
    (1.5, 0.5, 1),
    (1.0, 0.5, 1),
    (3.0, 0.5, 1),
    (1.5, 0.5, 3),
    (1.5, 0.5, 1),
    (1.5, 0.3, 1),
    (1.0, 0.3, 2),
    (1.5, 0.5, 2),
    (3.0, 0.5, 2),
    (1.0, 0.5, 3),
];

/// The kinds of bodies: names and how each is drawn.
type Kind = (&'static str, fn(&mut Lot) -> Vec<(Join, Piece)>);
pub(crate) const KINDS: [Kind; 9] = [
    ("balls", balls),
    ("columns", columns),
    ("cup", cup),
    ("plate", plate),
    ("comb", comb),
    ("chain", chain),
    ("nest", nest),
    ("hanging", hanging),
    ("twigs", twigs),
];

/// The kind, body and settings of a seed: for good the same.
pub(crate) fn case_of(seed: u64) -> (&'static str, Body, Settings) {
    let mut lot = Lot(seed);
    let (name, draw) = KINDS[seed as usize % KINDS.len()];
    let (width, layer_height, walls) = BEADS[seed as usize / KINDS.len() % BEADS.len()];
    (name, Body(draw(&mut lot)), Settings { layer_height, walls, ..Settings::for_width(width) })
}

/// A small generator (`SplitMix64`), so that a seed gives the same body for good.
#[derive(Debug)]
pub(crate) struct Lot(u64);

impl Lot {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// To a tenth of a millimetre, so that a body can be written down.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let at = low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        (10.0 * at).round() / 10.0
    }

    fn count(&mut self, low: u64, high: u64) -> u64 {
        low + self.next() % (high - low + 1)
    }

    fn chance(&mut self, one_in: u64) -> bool {
        self.next().is_multiple_of(one_in)
    }

    fn point(&mut self, low: f64, high: f64) -> [f64; 3] {
        let reach = REACH - 3.5;
        [self.between(-reach, reach), self.between(-reach, reach), self.between(low, high)]
    }

    /// The point itself, or one to the side at another height: lean.
    fn leaning(&mut self, [x, y, z]: [f64; 3], rise: f64, lean: f64) -> [f64; 3] {
        [x + self.between(-lean, lean), y + self.between(-lean, lean), tenth(z + rise)]
    }
}

fn tenth(value: f64) -> f64 {
    (10.0 * value).round() / 10.0
}

fn about(centre: [f64; 3], radius: f64, angle: f64) -> [f64; 3] {
    [tenth(centre[0] + radius * angle.cos()), tenth(centre[1] + radius * angle.sin()), centre[2]]
}

/// Balls and rods, some blended, the first ones on the bed, the others anywhere, also in mid-air.
fn balls(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let parts = lot.count(3, 6);
    let piece = |part| {
        let from = if part < 2 { lot.point(-1.0, 1.0) } else { lot.point(1.0, TOP - 2.0) };
        let thick = lot.between(1.5, 3.4);
        let piece = if lot.chance(3) {
            Rod(from, thick, from, thick)
        } else {
            Rod(from, thick, lot.point(1.0, TOP - 2.0), lot.between(1.2, 2.8))
        };
        (if lot.chance(2) { Blend } else { Add }, piece)
    };
    (0..parts).map(piece).collect()
}

/// Columns that lean up to 60°, with or without a plate across their tops.
fn columns(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let mut body: Vec<_> = (0..lot.count(2, 5))
        .map(|_| {
            let foot = lot.point(-1.0, -1.0);
            let head = lot.leaning(foot, TOP + 1.0, 9.0);
            (Add, Rod(foot, lot.between(1.2, 3.0), head, lot.between(0.8, 2.6)))
        })
        .collect();
    if lot.chance(2) {
        let low = lot.between(TOP - 3.0, TOP - 1.5);
        let half = lot.between(4.0, REACH - 2.0);
        body.push((Add, Block([-half, -half, low], [half, tenth(half * 0.7), TOP + 2.0])));
    }
    body
}

/// A cup that leans, with walls of 1 to 3 beads, with or without floor and handle.
fn cup(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let foot = [lot.between(-2.0, 2.0), 0.0, -2.0];
    let head = lot.leaning(foot, TOP + 4.0, 3.0);
    let (wide, rim) = (lot.between(4.5, 6.5), lot.between(4.0, 7.5));
    let thick = lot.between(1.6, 4.0);
    let floor = if lot.chance(2) { lot.between(1.0, 3.0) + wide } else { -4.0 };
    let mut body = vec![(Add, Rod(foot, wide, head, rim))];
    if lot.chance(2) {
        let side = lot.between(0.0, TAU);
        let out = about([foot[0], foot[1], 4.5], wide, side);
        let across = [tenth(-side.sin()), tenth(side.cos()), 0.0];
        body.push((Blend, Ring(out, across, lot.between(2.5, 3.5), lot.between(0.8, 1.5))));
    }
    let inside = (tenth(wide - thick), tenth((rim - thick).max(0.6)));
    body.push((Cut, Rod([foot[0], foot[1], tenth(floor)], inside.0.max(0.6), head, inside.1)));
    body
}

/// A plate on the bed or on legs, with holes of half a bead to six.
fn plate(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let on_legs = lot.chance(2);
    let (low, high) = if on_legs { (4.0, TOP) } else { (-2.0, lot.between(2.5, 5.0)) };
    let half = [lot.between(6.0, 9.5), lot.between(4.0, 9.5)];
    let mut body = vec![(Add, Block([-half[0], -half[1], low], [half[0], half[1], high]))];
    for _ in 0..lot.count(1, 6) {
        let hole = lot.point(low - 3.0, low - 3.0);
        let radius = lot.between(0.4, 3.0);
        let end = lot.leaning(hole, high - low + 6.0, 2.0);
        body.push((Cut, Rod(hole, radius, end, radius)));
    }
    if on_legs {
        for _ in 0..lot.count(1, 4) {
            let foot = lot.point(-1.0, -1.0);
            body.push((
                Add,
                Rod(foot, lot.between(1.0, 2.2), [foot[0], foot[1], 5.5], lot.between(1.0, 2.0)),
            ));
        }
    }
    body
}

/// A spine with teeth of half a bead to two, along the bed, in mid-air or upright.
fn comb(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let spine = lot.between(1.5, 3.0);
    let mut body = vec![(Add, Block([-9.0, -9.0, -1.0], [tenth(spine - 9.0), 9.0, TOP + 1.0]))];
    let teeth = lot.count(2, 6);
    let pitch = 16.0 / teeth as f64;
    let (low, high) =
        if lot.chance(2) { (-1.0, lot.between(2.0, 5.0)) } else { (3.0, lot.between(5.0, 8.5)) };
    for tooth in 0..teeth {
        let y = tenth(-8.0 + (tooth as f64 + 0.5) * pitch);
        let thick = lot.between(0.75, 3.0);
        let end = lot.between(-2.0, 9.0);
        body.push((Add, Block([-9.0, tenth(y - 0.5 * thick), low], [end, tenth(y + 0.5 * thick), high])));
    }
    body
}

/// Rings that hang in one another, the first one in the bed.
fn chain(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let ring = lot.between(2.8, 4.0);
    let section = lot.between(0.8, 1.3);
    let links = lot.count(2, 4);
    let rise = if lot.chance(2) { 1.5 } else { 0.0 };
    (0..links)
        .map(|link| {
            let x = -7.0 + 1.25 * ring * link as f64;
            let centre = [tenth(x), lot.between(-0.5, 0.5), tenth(2.5 + rise * link as f64)];
            let axis = if link % 2 == 0 { [0.0, lot.between(-0.4, 0.4), 1.0] } else { [0.0, 1.0, 0.3] };
            (Add, Ring(centre, axis, ring, section))
        })
        .collect()
}

/// Islands in holes in islands, each of its own height, leaning and off the middle.
fn nest(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let mut body = Vec::new();
    let mut radius = lot.between(8.0, 9.5);
    let mut centre = [0.0, 0.0, -3.0];
    while radius > 1.2 {
        let thick = lot.between(1.0, 3.2);
        // The round top of the rod ends here.
        let top = tenth(lot.between(5.0, TOP + 4.0) - radius);
        let head = lot.leaning([centre[0], centre[1], top.max(1.0)], 0.0, 0.6);
        body.push((Add, Rod(centre, radius, head, radius)));
        let inner = tenth(radius - thick);
        if inner < 0.6 {
            break;
        }
        body.push((Cut, Rod([centre[0], centre[1], -9.0], inner, [head[0], head[1], TOP + 9.0], inner)));
        let gap = lot.between(0.6, 2.5);
        radius = tenth(inner - gap);
        let off = lot.between(-0.3, 0.3);
        centre = [tenth(centre[0] + off), tenth(centre[1] - off), -3.0];
    }
    body
}

/// A post with an arm, from which bodies hang that begin in mid-air.
fn hanging(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let post = [-7.0, 0.0, -2.0];
    let mut body = vec![(Add, Rod(post, lot.between(1.5, 3.0), [-7.0, 0.0, TOP], lot.between(1.5, 2.5)))];
    let end = [lot.between(4.0, 8.0), lot.between(-3.0, 3.0), lot.between(TOP - 1.5, TOP)];
    body.push((Add, Rod([-7.0, 0.0, TOP - 0.5], 1.8, end, lot.between(1.2, 2.0))));
    for _ in 0..lot.count(1, 4) {
        let t = lot.between(0.3, 1.0);
        let root = [tenth(-7.0 + t * (end[0] + 7.0)), tenth(t * end[1]), TOP - 1.0];
        let length = lot.between(2.0, 6.5);
        let tip = lot.leaning(root, -length, 1.5);
        body.push((Blend, Rod(root, lot.between(1.0, 2.2), tip, lot.between(0.4, 1.6))));
    }
    body
}

/// A trunk with twigs and fins of half a bead to three.
fn twigs(lot: &mut Lot) -> Vec<(Join, Piece)> {
    let mut body =
        vec![(Add, Rod([0.0, 0.0, -2.0], lot.between(1.5, 4.0), [0.0, 0.0, TOP], lot.between(1.0, 3.0)))];
    for _ in 0..lot.count(2, 6) {
        let thick = lot.between(0.4, 2.2);
        let angle = lot.between(0.0, 2.0 * PI);
        let low = lot.between(-1.0, 5.0);
        let out = about([0.0, 0.0, tenth(low + lot.between(1.0, 6.0))], lot.between(5.0, 9.0), angle);
        if lot.chance(3) {
            let (a, b) =
                ([0.0_f64.min(out[0]), out[1] - thick, low], [0.0_f64.max(out[0]), out[1] + thick, TOP]);
            body.push((Add, Block(a, [b[0].max(a[0] + 1.0), tenth(b[1]), b[2]])));
        } else {
            body.push((Add, Rod([0.0, 0.0, low], thick, out, thick)));
        }
    }
    body
}
