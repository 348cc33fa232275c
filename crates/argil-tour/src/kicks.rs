//! Iterated local search: kick, repair, keep what is not longer.

use crate::Metric;
use crate::or_3opt::LocalSearch;
use crate::random::SplitMix;

/// The longest of the three segments that a kick permutes.
const LONGEST_SEGMENT: usize = 30;

/// Fewer nodes than this leave the double bridge no room.
const FEWEST_NODES: usize = 8;

impl<M: Metric> LocalSearch<'_, M> {
    /// Spends `kicks` kicks on the tour; returns by how much it got shorter.
    ///
    /// Each kick is a double bridge (Martin, Otto and Felten 1991) of three short neighbouring segments: it takes
    /// four changes that no sequence of the local search's moves makes, and moves little in the array. The search
    /// then starts from the kick's ends alone. What is longer afterwards is taken back.
    pub(crate) fn iterate(&mut self, kicks: usize, random: &mut SplitMix) -> f64 {
        let n = self.tour.len();
        if n < FEWEST_NODES {
            return 0.0;
        }
        let longest = LONGEST_SEGMENT.min((n - 2) / 3);
        let most_moves = 10 * n;
        let mut gained = 0.0;
        for _ in 0..kicks {
            self.tour.commit();
            let at = self.tour.order()[random.below(n)];
            let lengths = [0; 3].map(|_| 1 + random.below(longest));
            let gain = self.double_bridge(at, lengths) + self.descend(most_moves);
            if gain < 0.0 || gain.is_nan() {
                self.tour.roll_back();
            } else {
                gained += gain;
            }
        }
        self.tour.commit();
        gained
    }

    /// Turns A B C D into A D C B, where B, C and D are the segments of the given lengths that follow `at`;
    /// returns the gain, which is mostly a loss.
    fn double_bridge(&mut self, at: u32, lengths: [usize; 3]) -> f64 {
        let n = self.tour.len();
        let ahead = |steps: usize| self.tour.ahead(at, steps % n);
        let [b, c, d] = lengths;
        let (b1, b2) = (ahead(1), ahead(b));
        let (c1, c2) = (ahead(b + 1), ahead(b + c));
        let (d1, d2) = (ahead(b + c + 1), ahead(b + c + d));
        let end = ahead(b + c + d + 1);
        let removed =
            self.distance(at, b1) + self.distance(b2, c1) + self.distance(c2, d1) + self.distance(d2, end);
        let added =
            self.distance(at, d1) + self.distance(d2, c1) + self.distance(c2, b1) + self.distance(b2, end);
        // The whole window backwards, then each segment forwards again.
        self.tour.exchange(at, b1, end, d2);
        self.tour.exchange(at, d2, c2, d1);
        self.tour.exchange(d2, c2, b2, c1);
        self.tour.exchange(c2, b2, end, b1);
        for node in [at, b1, b2, c1, c2, d1, d2, end] {
            self.queue.push(node);
        }
        removed - added
    }
}
