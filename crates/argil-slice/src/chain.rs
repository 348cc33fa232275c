use crate::section::Cut;
use glam::DVec2;

const NONE: u32 = u32::MAX;

/// A chain of cuts whose ends do not meet: the mesh has a hole there.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OpenChain {
    pub(crate) points: Vec<DVec2>,
}

impl OpenChain {
    pub(crate) fn gap(&self) -> f64 {
        match (self.points.first(), self.points.last()) {
            (Some(first), Some(last)) => first.distance(*last),
            _ => 0.0,
        }
    }

    pub(crate) fn length(&self) -> f64 {
        self.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }
}

/// Links cuts at the mesh edges that they share. The tables are as long as the mesh has edges
/// and are cleaned after each layer by what was touched, so that a layer costs its cuts.
pub(crate) struct Linker {
    /// First cut that begins on each edge.
    first: Vec<u32>,
    /// Cuts that begin less cuts that end on each edge.
    balance: Vec<i32>,
    /// Next cut that begins on the same edge.
    next: Vec<u32>,
}

impl Linker {
    pub(crate) fn new(edge_count: usize) -> Self {
        Self { first: vec![NONE; edge_count], balance: vec![0; edge_count], next: Vec::new() }
    }

    /// The closed contours of a cut, and the chains that do not close.
    ///
    /// Where more than two triangles share an edge, several chains meet. They may be linked
    /// in any way: winding numbers depend only on which pieces there are.
    pub(crate) fn link(&mut self, cuts: &[Cut]) -> (Vec<Vec<DVec2>>, Vec<OpenChain>) {
        self.next.clear();
        self.next.resize(cuts.len(), NONE);
        for (index, cut) in cuts.iter().enumerate().rev() {
            self.next[index] = self.first[cut.start as usize];
            self.first[cut.start as usize] = index as u32;
            self.balance[cut.start as usize] += 1;
            self.balance[cut.end as usize] -= 1;
        }
        let mut open = Vec::new();
        for cut in cuts {
            // More cuts begin here than end: a chain has to begin here.
            while self.balance[cut.start as usize] > 0 {
                self.balance[cut.start as usize] -= 1;
                let points = self.follow(cuts, cut.start, NONE);
                open.push(OpenChain { points });
            }
        }
        let mut closed = Vec::new();
        for cut in cuts {
            while self.first[cut.start as usize] != NONE {
                let mut points = self.follow(cuts, cut.start, cut.start);
                if points.first() == points.last() {
                    points.pop();
                }
                closed.push(points);
            }
        }
        for cut in cuts {
            for edge in [cut.start, cut.end] {
                self.first[edge as usize] = NONE;
                self.balance[edge as usize] = 0;
            }
        }
        (closed, open)
    }

    /// Takes unused cuts from an edge on until the stop edge is reached or no cut goes on.
    fn follow(&mut self, cuts: &[Cut], start: u32, stop: u32) -> Vec<DVec2> {
        let mut points: Vec<DVec2> = Vec::new();
        let mut edge = start;
        while let Some(cut) = cuts.get(self.first[edge as usize] as usize) {
            self.first[edge as usize] = self.next[self.first[edge as usize] as usize];
            for point in [cut.from, cut.to] {
                // Cuts through a vertex of the mesh have no length.
                if points.last() != Some(&point) {
                    points.push(point);
                }
            }
            edge = cut.end;
            if edge == stop {
                break;
            }
        }
        points
    }
}
