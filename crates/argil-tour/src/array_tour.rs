//! A tour that is changed by reversals, and can take them back.

/// A cyclic order of nodes in an array, with the position of each node.
///
/// Every move of the search is a short sequence of reversals. A reversal is its own inverse, so that the journal
/// of reversals is all that is needed to take a failed kick back, at the price of what it changed.
#[derive(Clone, Debug, Default)]
pub(crate) struct ArrayTour {
    order: Vec<u32>,
    position: Vec<u32>,
    journal: Vec<(u32, u32)>,
}

impl ArrayTour {
    pub(crate) fn set(&mut self, order: &[u32]) {
        self.order.clear();
        self.order.extend_from_slice(order);
        self.position.clear();
        self.position.resize(order.len(), 0);
        for (k, &node) in order.iter().enumerate() {
            self.position[node as usize] = k as u32;
        }
        self.journal.clear();
    }

    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }

    pub(crate) fn len(&self) -> usize {
        self.order.len()
    }

    #[inline]
    pub(crate) fn next(&self, a: u32) -> u32 {
        let k = self.position[a as usize] as usize + 1;
        self.order[if k == self.order.len() { 0 } else { k }]
    }

    #[inline]
    pub(crate) fn previous(&self, a: u32) -> u32 {
        let k = self.position[a as usize] as usize;
        self.order[if k == 0 { self.order.len() } else { k } - 1]
    }

    /// The node `steps` (below the number of nodes) after `a`.
    #[inline]
    pub(crate) fn ahead(&self, a: u32, steps: usize) -> u32 {
        let k = self.position[a as usize] as usize + steps;
        self.order[if k >= self.order.len() { k - self.order.len() } else { k }]
    }

    /// How many steps `b` lies after `a`.
    #[inline]
    pub(crate) fn steps(&self, a: u32, b: u32) -> usize {
        let (from, to) = (self.position[a as usize] as usize, self.position[b as usize] as usize);
        if to >= from { to - from } else { to + self.order.len() - from }
    }

    /// Reverses the path that runs forward from `a` to `b`, or else the rest of the tour, whichever has fewer
    /// nodes. As cycles the two are the same; which nodes are `next` and which `previous` may differ.
    pub(crate) fn reverse(&mut self, a: u32, b: u32) {
        let n = self.order.len();
        let (mut i, mut j) = (self.position[a as usize] as usize, self.position[b as usize] as usize);
        let inside = self.steps(a, b) + 1;
        if inside == 1 {
            return;
        }
        if 2 * inside > n {
            (i, j) = (if j + 1 == n { 0 } else { j + 1 }, if i == 0 { n - 1 } else { i - 1 });
        }
        self.journal.push((i as u32, j as u32));
        self.reverse_positions(i, j);
    }

    /// The 2-opt move: of a tour that runs `a`, `b`, …, `d`, `c` in either direction, replaces the edges `a b`
    /// and `d c` by `b c` and `d a`.
    pub(crate) fn exchange(&mut self, a: u32, b: u32, c: u32, d: u32) {
        debug_assert!(self.next(d) == c || self.previous(d) == c);
        if self.next(a) == b {
            self.reverse(b, d);
        } else {
            self.reverse(d, b);
        }
    }

    fn reverse_positions(&mut self, mut i: usize, mut j: usize) {
        let n = self.order.len();
        let inside = if j >= i { j - i + 1 } else { j + n + 1 - i };
        for _ in 0..inside / 2 {
            let (a, b) = (self.order[i], self.order[j]);
            self.order[i] = b;
            self.position[b as usize] = i as u32;
            self.order[j] = a;
            self.position[a as usize] = j as u32;
            i = if i + 1 == n { 0 } else { i + 1 };
            j = if j == 0 { n - 1 } else { j - 1 };
        }
    }

    /// Makes what was done so far final.
    pub(crate) fn commit(&mut self) {
        self.journal.clear();
    }

    /// Takes back every reversal since the last [`commit`](Self::commit).
    pub(crate) fn roll_back(&mut self) {
        while let Some((i, j)) = self.journal.pop() {
            self.reverse_positions(i as usize, j as usize);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rolling_back_restores_every_position() {
        let mut tour = ArrayTour::default();
        tour.set(&[3, 0, 4, 1, 5, 2, 6]);
        let before = tour.order().to_vec();
        tour.reverse(2, 3);
        tour.reverse(0, 1);
        tour.reverse(4, 4);
        assert_ne!(tour.order(), before);
        tour.roll_back();
        assert_eq!(tour.order(), before);
        assert!((0..7).all(|node| tour.previous(tour.next(node)) == node));
    }

    #[test]
    fn reversing_the_rest_gives_the_same_cycle() {
        let mut tour = ArrayTour::default();
        tour.set(&[0, 1, 2, 3, 4, 5]);
        tour.reverse(1, 4);
        let neighbours = |tour: &ArrayTour, node| {
            let mut pair = [tour.previous(node), tour.next(node)];
            pair.sort_unstable();
            pair
        };
        assert_eq!(neighbours(&tour, 0), [4, 5]);
        assert_eq!(neighbours(&tour, 1), [2, 5]);
    }
}
