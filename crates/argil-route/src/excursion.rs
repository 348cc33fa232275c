//! Closed excursions from walls: the savings method of Clarke and Wright (1964, DOI 10.1287/opre.12.4.568)
//! with every wall of the region as a depot.

/// Stops farther apart than so many times what both cost by themselves are not looked at: by themselves they are joined up to once.
const HOPELESS: f64 = 2.0;

/// A chain of stops that leaves one wall and comes back to it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Excursion {
    /// The stops in order.
    pub(crate) stops: Vec<usize>,
    /// The wall that it starts from.
    pub(crate) wall: usize,
    /// Length of the chain between its first and last stop.
    length: f64,
    /// Whether a stop is the joint of another wall: then the wall is not free to choose.
    bound: bool,
}

impl Excursion {
    /// Its first and last stop; an excursion has at least one.
    pub(crate) fn ends(&self) -> [usize; 2] {
        [self.stops[0], self.stops[self.stops.len() - 1]]
    }

    /// Length between its ends, mm.
    pub(crate) fn length(&self) -> f64 {
        self.length
    }
}

/// What is known of the ways between stops.
pub(crate) trait Hops {
    /// Length of the way from one stop to another, or less, mm.
    fn at_least(&self, a: usize, b: usize) -> f64;

    /// The same way in full; `None` where there is no direct one.
    fn whole(&self, a: usize, b: usize) -> Option<f64>;
}

/// The stops of a region. Stop k lies `to_wall[k][w]` from wall w, infinity where that wall is no choice;
/// `bound[k]` tells that the stop joins another wall.
pub(crate) struct Stops<'a, H> {
    pub(crate) hops: &'a H,
    pub(crate) to_wall: &'a [Vec<f64>],
    pub(crate) bound: &'a [bool],
    /// A stop farther than this from all walls counts as so far where pairs are chosen, mm; it may be infinitely far.
    pub(crate) far: f64,
    /// What a root costs, mm.
    pub(crate) root_cost: f64,
    /// What the square of an excursion's length costs, 1/mm.
    pub(crate) length_cost: f64,
}

impl<H: Hops> Stops<'_, H> {
    /// Cost of an excursion: both legs meet the wall at one place, so they are never shorter together
    /// than the way from its last stop to its first.
    fn cost(&self, first: usize, last: usize, wall: usize, length: f64) -> f64 {
        let legs = self.to_wall[first][wall] + self.to_wall[last][wall];
        let whole = length + legs.max(self.hops.at_least(first, last));
        whole + self.length_cost * whole * whole + self.root_cost
    }

    /// What an excursion costs by itself.
    pub(crate) fn cost_of(&self, excursion: &Excursion) -> f64 {
        let [first, last] = excursion.ends();
        self.cost(first, last, excursion.wall, excursion.length)
    }

    /// Chains stops into excursions for as long as that saves strand.
    ///
    /// # Complexity
    /// O(n² log n) for n stops.
    pub(crate) fn excursions(&self) -> Vec<Excursion> {
        let n = self.to_wall.len();
        let mut chains: Vec<Option<Excursion>> = (0..n)
            .map(|k| {
                let walls = &self.to_wall[k];
                let wall = (0..walls.len()).min_by(|&a, &b| walls[a].total_cmp(&walls[b])).unwrap_or(0);
                Some(Excursion { stops: vec![k], wall, length: 0.0, bound: self.bound[k] })
            })
            .collect();
        let mut chain_of: Vec<usize> = (0..n).collect();
        let order = self.pairs_by_saving();
        for _ in 0..3 {
            let mut merged = false;
            for &(a, b) in &order {
                let (a, b) = (a as usize, b as usize);
                let (ca, cb) = (chain_of[a], chain_of[b]);
                if ca == cb {
                    continue;
                }
                if let (Some(left), Some(right)) = (&chains[ca], &chains[cb])
                    && let Some(chain) = self.merge(left, right, a, b)
                {
                    for &stop in &chain.stops {
                        chain_of[stop] = ca;
                    }
                    chains[ca] = Some(chain);
                    chains[cb] = None;
                    merged = true;
                }
            }
            if !merged {
                break;
            }
        }
        chains.into_iter().flatten().collect()
    }

    /// All pairs, the most promising first.
    fn pairs_by_saving(&self) -> Vec<(u32, u32)> {
        let n = self.to_wall.len();
        let near: Vec<f64> =
            self.to_wall.iter().map(|w| w.iter().copied().fold(self.far, f64::min)).collect();
        let mut pairs: Vec<(f64, u32, u32)> = Vec::new();
        for a in 0..n {
            for b in a + 1..n {
                let hop = self.hops.at_least(a, b);
                // Two excursions that lead straight to one stop each would save nothing long before.
                if hop <= HOPELESS * (near[a] + near[b] + self.root_cost) {
                    pairs.push((hop - 0.5 * (near[a] + near[b]), a as u32, b as u32));
                }
            }
        }
        pairs.sort_by(|p, q| p.0.total_cmp(&q.0).then((p.1, p.2).cmp(&(q.1, q.2))));
        pairs.into_iter().map(|(_, a, b)| (a, b)).collect()
    }

    /// The chain of two excursions joined by the hop a–b, if both are ends and it costs less than the two.
    fn merge(&self, left: &Excursion, right: &Excursion, a: usize, b: usize) -> Option<Excursion> {
        let ([lf, ll], [rf, rl]) = (left.ends(), right.ends());
        if (a != lf && a != ll)
            || (b != rf && b != rl)
            || (left.bound && right.bound && left.wall != right.wall)
        {
            return None;
        }
        let (first, last) = (if a == ll { lf } else { ll }, if b == rf { rl } else { rf });
        let apart = self.cost(lf, ll, left.wall, left.length) + self.cost(rf, rl, right.wall, right.length);
        let walls = match (left.bound, right.bound) {
            (true, _) => [left.wall, left.wall],
            (_, true) => [right.wall, right.wall],
            _ => [left.wall, right.wall],
        };
        let joined = |hop: f64| {
            let length = left.length + right.length + hop;
            let costs = walls.into_iter().map(|wall| (self.cost(first, last, wall, length), wall));
            let (together, wall) = costs.min_by(|p, q| p.0.total_cmp(&q.0))?;
            (together < apart - 1e-9).then_some((length, wall))
        };
        // What a lower bound rules out needs no closer look.
        joined(self.hops.at_least(a, b))?;
        let (length, wall) = joined(self.hops.whole(a, b)?)?;
        let mut stops = left.stops.clone();
        if a != ll {
            stops.reverse();
        }
        if b == rf {
            stops.extend(&right.stops);
        } else {
            stops.extend(right.stops.iter().rev());
        }
        Some(Excursion { stops, wall, length, bound: left.bound || right.bound })
    }
}
