//! Cycles to be relaxed.

use std::f64::consts::TAU;

use argil_curve::DVec2;

use crate::{SplitMix, WIDTH};

/// A round wall that is left for winding excursions of two lanes, as the route stage hands them on.
#[derive(Clone, Debug)]
pub struct Excursions {
    /// The closed polyline.
    pub points: Vec<DVec2>,
    /// Which vertices are wall.
    pub fixed: Vec<bool>,
    /// Vertices that hold the layer above, with the place that they must stay near to.
    pub carriers: Vec<(usize, DVec2)>,
    /// Radius of the wall, mm; its centre is the origin.
    pub radius: f64,
}

impl Excursions {
    /// A wall with this many excursions of 50 vertices each, which leave it at equal distances.
    #[must_use]
    pub fn new(count: usize, seed: u64) -> Self {
        const REACH: usize = 24;
        let mut random = SplitMix::new(seed);
        let sector = TAU / count.max(1) as f64;
        let radius = 8.0 * WIDTH / sector;
        let mut made = Self { points: Vec::new(), fixed: Vec::new(), carriers: Vec::new(), radius };
        for excursion in 0..count.max(1) {
            let from = excursion as f64 * sector;
            // The wall takes two thirds of the sector and the mouth of the excursion, at its end, the rest.
            for k in 0..16 {
                made.points.push(
                    radius * DVec2::from_angle(from + sector * (1.0 + 4.0 * f64::from(k) / 15.0) / 6.0),
                );
                made.fixed.push(true);
            }
            let out = DVec2::from_angle(from + sector);
            let phase = random.within(0.0, TAU);
            for k in 0..=2 * REACH {
                let (step, side) = if k <= REACH { (k, -1.0) } else { (2 * REACH - k, 1.0) };
                let along = (step + 1) as f64 * 0.5 * WIDTH;
                let across = 0.13 * WIDTH * side + (0.4 * along + phase).sin() - phase.sin();
                let p = out * (radius + along) + out.perp() * across + 0.1 * random.point(DVec2::ONE);
                if k % 3 == 1 && k < REACH {
                    made.carriers.push((made.points.len(), p + 0.1 * random.point(DVec2::ONE)));
                }
                made.points.push(p);
                made.fixed.push(false);
            }
        }
        made
    }
}
