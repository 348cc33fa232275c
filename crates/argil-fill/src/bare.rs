//! What stays bare: discs that no bead touches, and how much there is of it.

use std::collections::HashMap;

use argil_curve::{DVec2, Segment, SegmentIndex};

use crate::nearest::{Line, Nearest};
use crate::rings::Core;

/// A disc inside of the region that no bead touches.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BareDisc {
    /// Its middle, mm.
    pub centre: DVec2,
    /// Its diameter, mm.
    pub diameter: f64,
}

/// What a look at a grid of points has found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scan {
    /// Area that a bead could reach and none does, mm².
    pub(crate) bare: f64,
    /// Discs wider than the limit, widest first, no two of them overlapping.
    pub(crate) discs: Vec<BareDisc>,
}

/// Distances beyond the first are as good as it while discs are looked for, and beyond the second for good; in w.
const FAR: f64 = 1.5;
const FARTHEST: f64 = 3.0;

/// A disc's middle is looked for with steps from and down to these, in w.
const LARGEST_STEP: f64 = 0.1;
const SMALLEST_STEP: f64 = 0.01;

/// It is no farther than this from where it is looked for, in w.
const FARTHEST_RISE: f64 = 0.5;

/// Eight directions.
const AROUND: [DVec2; 8] = {
    const D: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [
        DVec2::X,
        DVec2::new(D, D),
        DVec2::Y,
        DVec2::new(-D, D),
        DVec2::NEG_X,
        DVec2::new(-D, -D),
        DVec2::NEG_Y,
        DVec2::new(D, -D),
    ]
};

/// Where strand has changed, points so far away are looked at again, in w.
const RENEWED: f64 = 0.8;

/// The distance from the strand all over a core.
#[derive(Debug)]
pub(crate) struct Survey<'a> {
    core: &'a Core,
    distance: Vec<f64>,
}

impl<'a> Survey<'a> {
    /// # Complexity
    /// O(points of the plot + length of the strand).
    pub(crate) fn new(core: &'a Core, strand: &SegmentIndex) -> Self {
        Self { core, distance: Nearest::new(&core.plot, strand.segments()).into_distances() }
    }

    /// Looks again at the points about places where the strand has changed, each from a low corner to a high one.
    pub(crate) fn renew(&mut self, places: &[[DVec2; 2]], strand: &SegmentIndex, width: f64) {
        let plot = &self.core.plot;
        let mut near: Vec<Line> = Vec::new();
        for [low, high] in places {
            let (from, to) = (*low - RENEWED * width - plot.low, *high + RENEWED * width - plot.low);
            near.clear();
            let reach = RENEWED * width + FAR * width;
            strand
                .for_each_near(Segment::new(*low, *high), reach, |_, segment| near.push(Line::of(&segment)));
            for row in plot.between(from.y, to.y, plot.rows) {
                for column in plot.between(from.x, to.x, plot.columns) {
                    let distance = &mut self.distance[row * plot.columns + column];
                    if *distance >= 0.0 {
                        *distance = distance_to(&near, plot.at(column, row), width);
                    }
                }
            }
        }
    }
}

/// Looks for what the strand leaves bare of the core, the places where the middle of a bead may be: the inside of the plot.
///
/// What lies farther out than the core is reached by a bead along the core's edge or by none, so nothing else can be bare.
///
/// # Complexity
/// O(points of the plot), and a look at the segments about each point that is bare.
pub(crate) fn scan(survey: &Survey<'_>, strand: &SegmentIndex, width: f64, limit: f64) -> Scan {
    let (core, plot) = (survey.core, &survey.core.plot);
    let step = plot.step;
    let least = 0.5 * (width + limit);
    // The point nearest to a disc's middle is at most half a diagonal away from it.
    let suspicious = least - std::f64::consts::FRAC_1_SQRT_2 * step;
    let mut found = Scan::default();
    let mut suspects: Vec<(f64, usize, usize)> = Vec::new();
    for &(row, first, last) in &plot.runs {
        for column in first..=last {
            let distance = survey.distance[row * plot.columns + column];
            if distance > 0.5 * width {
                found.bare += step * step;
            }
            if distance > suspicious {
                suspects.push((distance, row, column));
            }
        }
    }
    // The sort keeps the order of the grid among equals.
    suspects.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen = Chosen { cell: width, ..Chosen::default() };
    // Whether the rise from a place leads to a disc that is wide enough.
    let mut leads: HashMap<(usize, usize), bool> = HashMap::with_capacity(suspects.len());
    let mut near: Vec<Line> = Vec::new();
    for (_, row, column) in suspects {
        let around = (row - 1..=row + 1).flat_map(|r| (column - 1..=column + 1).map(move |c| (r, c)));
        let mut higher = around.filter_map(|place| leads.get(&place)).copied().peekable();
        // A place below one that leads nowhere rises to the same top.
        if higher.peek().is_some() && !higher.any(|leads| leads) {
            leads.insert((row, column), false);
            continue;
        }
        let at = plot.at(column, row);
        if chosen.covers(at) {
            leads.insert((row, column), true);
            continue;
        }
        near.clear();
        strand.for_each_near(Segment::new(at, at), FAR * width, |_, segment| near.push(Line::of(&segment)));
        let (centre, distance) = summit(at, &near, width, least);
        leads.insert((row, column), distance >= least);
        if distance >= least && holds(&core.sides, centre) {
            let distance = strand.distance(centre).min(FARTHEST * width);
            chosen.add(BareDisc { centre, diameter: 2.0 * distance - width });
        }
    }
    found.discs = chosen.discs;
    found.discs.sort_by(|a, b| b.diameter.total_cmp(&a.diameter));
    found
}

/// Discs that do not overlap, by the squares in which their middles lie.
#[derive(Debug, Default)]
struct Chosen {
    cell: f64,
    widest: f64,
    discs: Vec<BareDisc>,
    squares: HashMap<(i64, i64), Vec<usize>>,
}

impl Chosen {
    fn square(&self, p: DVec2) -> (i64, i64) {
        ((p.x / self.cell).floor() as i64, (p.y / self.cell).floor() as i64)
    }

    /// The discs whose middles lie within `reach`, and some more.
    fn near(&self, p: DVec2, reach: f64) -> impl Iterator<Item = &BareDisc> {
        let (low, high) = (self.square(p - reach), self.square(p + reach));
        (low.0..=high.0)
            .flat_map(move |x| (low.1..=high.1).map(move |y| (x, y)))
            .filter_map(|square| self.squares.get(&square))
            .flatten()
            .map(|&k| &self.discs[k])
    }

    fn covers(&self, p: DVec2) -> bool {
        self.near(p, 0.5 * self.widest).any(|disc| disc.centre.distance(p) < 0.5 * disc.diameter)
    }

    /// Adds a disc, unless it overlaps another.
    fn add(&mut self, disc: BareDisc) {
        let apart = |other: &BareDisc| 0.5 * (other.diameter + disc.diameter);
        let reach = 0.5 * (self.widest + disc.diameter);
        if self.near(disc.centre, reach).all(|other| other.centre.distance(disc.centre) > apart(other)) {
            self.widest = self.widest.max(disc.diameter);
            self.squares.entry(self.square(disc.centre)).or_default().push(self.discs.len());
            self.discs.push(disc);
        }
    }
}

/// Distance to the strand, at most [`FAR`].
fn distance_to(strand: &[Line], p: DVec2, width: f64) -> f64 {
    strand.iter().map(|line| line.square(p)).fold(FAR * width * FAR * width, f64::min).sqrt()
}

/// The place to which the distance from the strand rises, not far away, and that distance; it ends early where `least` cannot be
/// reached.
pub(crate) fn summit(from: DVec2, strand: &[Line], width: f64, least: f64) -> (DVec2, f64) {
    let (mut at, mut best, mut step) = (from, distance_to(strand, from, width), LARGEST_STEP * width);
    let reach = best + 2.0 * FARTHEST_RISE * width;
    let near: Vec<Line> = strand.iter().filter(|line| line.square(from) <= reach * reach).copied().collect();
    while step >= SMALLEST_STEP * width && best + 2.0 * step > least {
        let around = AROUND.map(|towards| at + step * towards);
        let highest =
            around.map(|p| (distance_to(&near, p, width), p)).into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        match highest {
            Some((distance, p))
                if distance > best + 1e-3 * step && p.distance(from) < FARTHEST_RISE * width =>
            {
                (best, at) = (distance, p);
            }
            _ => step *= 0.5,
        }
    }
    (at, best)
}

/// Whether the point lies inside by the even-odd rule.
pub(crate) fn holds(sides: &[Segment], p: DVec2) -> bool {
    sides.iter().fold(false, |inside, side| {
        let (from, to) = (side.start, side.end);
        let straddles = (from.y > p.y) != (to.y > p.y);
        inside ^ (straddles && from.x + (to.x - from.x) * (p.y - from.y) / (to.y - from.y) > p.x)
    })
}
