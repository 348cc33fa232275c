//! Iterated local search: kick, descend, keep what is not longer.

use crate::Metric;
use crate::array_tour::Piece;
use crate::local_search::LocalSearch;
use crate::random::SplitMix;
use crate::remembered::FEWEST_REMEMBERED;

/// Steps of the walks that find the cuts of a near kick.
const NEAR_STEPS: usize = 8;

/// Of this many near kicks drawn the one that lengthens the tour least is taken: it takes the fewest exchanges to
/// mend, and is the likeliest to be worth it.
const NEAR_DRAWS: usize = 8;

/// Of five kicks one is a far one.
const FAR_ONE_IN: usize = 5;

/// Steps of the walks that look for the long edges of a far kick: enough to cross a patch of some hundred nodes.
const FAR_STEPS: usize = 50;

/// A far kick begins at the longest of this many edges drawn.
const FAR_DRAWS: usize = 10;

/// On a long tour a kick begins within so many places, which move along it from kick to kick, once round: what is
/// asked for then has mostly been asked for shortly before.
const DISTRICT: usize = 250;

/// Fewer nodes than this leave no room for kicks, nor need for them.
const FEWEST_NODES: usize = 8;

impl<M: Metric> LocalSearch<'_, M> {
    /// Spends `kicks` kicks on the tour, or fewer once `patience` in a row have not made it shorter; returns by how much it did get.
    ///
    /// Each kick is a double bridge (Martin, Otto and Felten, "Large-step Markov chains for the TSP incorporating local
    /// search heuristics", 1992, DOI 10.1016/0167-6377(92)90028-2), the exchange of four edges that no sequence of
    /// the exchanges tried by the descent contains. The descent then starts from the kick's ends alone, and
    /// what is longer afterwards is taken back.
    pub(crate) fn iterate(&mut self, kicks: usize, patience: usize, random: &mut SplitMix) -> f64 {
        let n = self.tour.len();
        if n < FEWEST_NODES {
            return 0.0;
        }
        let mut gained = 0.0;
        let mut in_vain = 0;
        for kick in 0..kicks {
            if in_vain >= patience {
                break;
            }
            in_vain += 1;
            if n >= FEWEST_REMEMBERED {
                // Below the number of nodes, for the kick is below the number of kicks.
                let start = (kick as f64 / kicks as f64 * n as f64) as usize;
                self.district = (start.min(n - 1), DISTRICT);
            }
            self.tour.commit();
            let far = random.below(FAR_ONE_IN) == 0;
            let bridge = if far { self.far_bridge(random) } else { self.gentlest_near_bridge(random) };
            let Some(bridge) = bridge else { continue };
            let gain = self.cross(&bridge) + self.descend(10 * n);
            if gain > self.least_gain {
                in_vain = 0;
            }
            if gain >= 0.0 {
                gained += gain;
            } else {
                self.tour.roll_back();
            }
        }
        self.tour.commit();
        gained
    }

    fn gentlest_near_bridge(&self, random: &mut SplitMix) -> Option<DoubleBridge> {
        let mut best: Option<DoubleBridge> = None;
        for _ in 0..NEAR_DRAWS {
            let drawn = self.near_bridge(random);
            if drawn.as_ref().is_some_and(|drawn| best.as_ref().is_none_or(|best| drawn.gain > best.gain)) {
                best = drawn;
            }
        }
        best
    }

    /// Cuts near each other, at the ends of short random walks from one node over candidate neighbours:
    /// Applegate, Cook and Rohe, "Chained Lin–Kernighan for large traveling salesman problems" (2003),
    /// DOI 10.1287/ijoc.15.1.82.15157, where it is the best of the kicks tried. Near is meant in the metric; the
    /// edges may be far apart on the tour.
    fn near_bridge(&self, random: &mut SplitMix) -> Option<DoubleBridge> {
        let first = self.draw(random);
        let cuts = [0, 1, 2, 3].map(|walk| {
            let mut node = self.tour.at(first).node;
            for _ in 0..if walk == 0 { 0 } else { NEAR_STEPS } {
                node = self.step(node, random);
            }
            self.tour.position(node)
        });
        self.bridge(cuts)
    }

    /// Cuts long edges, each the longest that a walk from the first comes by.
    ///
    /// Where terminals lie in patches, which gaps the tour crosses is decided by a few long edges. Changing that
    /// decision makes the tour longer until the patches behind are passed another way, so that near kicks do not
    /// find it: without these kicks some layers stay 0.4 to 1.5 % too long for good.
    fn far_bridge(&self, random: &mut SplitMix) -> Option<DoubleBridge> {
        let longer = |a: usize, b: usize| if self.tour.at(b).ahead > self.tour.at(a).ahead { b } else { a };
        let first = (1..FAR_DRAWS).fold(self.draw(random), |longest, _| longer(longest, self.draw(random)));
        let ends = [first, self.tour.after(first)].map(|position| self.tour.at(position).node);
        let mut cuts = [first; 4];
        for k in 1..4 {
            let mut node = ends[random.below(2)];
            let mut longest = None;
            for _ in 0..FAR_STEPS {
                node = self.step(node, random);
                let position = self.tour.position(node);
                for position in [position, self.tour.before(position)] {
                    if !cuts[..k].contains(&position) {
                        longest = Some(longest.map_or(position, |other| longer(other, position)));
                    }
                }
            }
            cuts[k] = longest?;
        }
        self.bridge(cuts)
    }

    /// A random position of the district.
    fn draw(&self, random: &mut SplitMix) -> usize {
        let (start, length) = self.district;
        let position = start + random.below(length);
        if position >= self.tour.len() { position - self.tour.len() } else { position }
    }

    /// A random candidate neighbour of `node`.
    fn step(&self, node: u32, random: &mut SplitMix) -> u32 {
        let candidates = self.candidates.of(node);
        candidates.get(random.below(candidates.len())).map_or(node, |candidate| candidate.node)
    }

    /// The double bridge with cuts after the given positions, if these are four that may be cut.
    fn bridge(&self, mut cuts: [usize; 4]) -> Option<DoubleBridge> {
        for cut in &mut cuts {
            // A fixed edge stays; the next is none, for a node has at most one.
            if self.tour.at(*cut).ahead == f64::NEG_INFINITY {
                *cut = self.tour.after(*cut);
            }
        }
        cuts.sort_unstable();
        if cuts.windows(2).any(|pair| pair[0] == pair[1]) {
            return None;
        }
        let ends = cuts.map(|cut| (self.tour.at(cut).node, self.tour.at(self.tour.after(cut)).node));
        let removed: f64 = cuts.iter().map(|&cut| self.tour.at(cut).ahead).sum();
        let added: f64 = (0..4).map(|k| self.distance(ends[k].0, ends[(k + 2) % 4].1)).sum();
        Some(DoubleBridge { cuts, ends, gain: removed - added })
    }

    /// Turns A B C D into A D C B; returns the gain.
    ///
    /// A C B D would not do: read round the cycle it exchanges three edges only.
    fn cross(&mut self, bridge: &DoubleBridge) -> f64 {
        let n = self.tour.len();
        let piece = |k: usize| {
            let before = bridge.cuts[(k + 3) % 4];
            let length = (bridge.cuts[k] + n - before) % n;
            Piece { first: self.tour.after(before) as u32, length: length as u32, reversed: false }
        };
        let pieces = [piece(0), piece(3), piece(2), piece(1)];
        let metric = self.metric;
        self.tour.rearrange(&pieces, |a, b| metric.distance(a as usize, b as usize));
        for (a, b) in bridge.ends {
            self.queue.push(a);
            self.queue.push(b);
        }
        bridge.gain
    }
}

/// A kick that is yet to be done.
#[derive(Clone, Copy, Debug)]
struct DoubleBridge {
    /// The positions after which the tour is cut, lowest first.
    cuts: [usize; 4],
    /// The nodes before and after each cut.
    ends: [(u32, u32); 4],
    /// By how much the tour gets shorter, mostly less than nothing.
    gain: f64,
}
