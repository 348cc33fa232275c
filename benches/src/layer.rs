//! Layers as path planning meets them: obstacles, dense patches and wandering chains of support points.

use std::f64::consts::TAU;

use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
use argil_graph::{FreeSpace, GraphError, Nodes, PathGraph};

use crate::{SplitMix, WIDTH};

/// Neighbouring support points on one strand lie about this far apart: `ε_along` of the paper's clay, mm.
const STRIDE: f64 = 1.6 * WIDTH;

/// No two support points are nearer than this, mm: one of them would hold for both.
const LEAST: f64 = 0.5 * STRIDE;

/// How far a point moves from a layer to the next: `ε_across`, mm.
const DRIFT: f64 = 0.3 * WIDTH;

/// Of a layer's points, the share that has no counterpart in the layer below, and as many come new.
const TURNOVER: f64 = 0.04;

/// A plate with obstacles, which are the walls of the layer, and support points between them.
///
/// Half of the points fill dense patches, as below a flat underside; the other half lie on chains, as below a slanted
/// wall and on the strands that support strands. Both are hard for tour search in their own ways: patches have many tours of nearly the same length,
/// chains have few good ways between them.
#[derive(Clone, Debug)]
pub struct MixedLayer {
    /// The side of the square plate, mm; its corners are the outer loop.
    pub side: f64,
    /// Loops counter-clockwise on the output grid, apart from each other.
    pub obstacles: Vec<Vec<DVec2>>,
    /// The support points, which lie clear of the obstacles.
    pub terminals: Vec<DVec2>,
    /// How far apart the Steiner points of the graph are, mm; six by default, which gives some five vertices a support point.
    pub spacing: f64,
}

impl MixedLayer {
    /// The layer with this many support points that a seed gives. The plate grows with them.
    #[must_use]
    pub fn new(terminals: usize, seed: u64) -> Self {
        let mut random = SplitMix::new(seed);
        let side = 12.0 * (terminals.max(4) as f64).sqrt();
        let mut layer = Self { side, obstacles: Vec::new(), terminals: Vec::new(), spacing: 4.0 * WIDTH };
        layer.add_obstacles((terminals / 40).clamp(1, 20), &mut random);
        let walls = layer.walls();
        while layer.terminals.len() < terminals / 2 {
            layer.add_patch(terminals / 2, &walls, &mut random);
        }
        while layer.terminals.len() < terminals {
            layer.add_chain(terminals, &walls, &mut random);
        }
        layer
    }

    /// The layer below: the points have drifted, some are gone and others new. With each point's number in this layer.
    #[must_use]
    pub fn below(&self, seed: u64) -> (Self, Vec<Option<usize>>) {
        let mut random = SplitMix::new(seed);
        let walls = self.walls();
        let mut below = Self { terminals: Vec::new(), ..self.clone() };
        let mut came_from = Vec::new();
        for (number, &p) in self.terminals.iter().enumerate() {
            let drifted = p + random.within(0.0, DRIFT) * DVec2::from_angle(random.within(0.0, TAU));
            if random.within(0.0, 1.0) < TURNOVER {
                continue;
            }
            let moved = below.is_free(drifted, &walls);
            below.terminals.push(if moved { drifted } else { p });
            came_from.push(Some(number));
        }
        while below.terminals.len() < self.terminals.len() {
            below.add_patch(self.terminals.len(), &walls, &mut random);
        }
        came_from.resize(below.terminals.len(), None);
        (below, came_from)
    }

    /// The graph of the free space. One vertex of every obstacle is an attachment, as in Section 3.3 of the paper.
    ///
    /// # Errors
    /// None is known; the loops are disjoint and the points lie between them.
    pub fn graph(&self) -> Result<PathGraph, GraphError> {
        let s = self.side;
        let plate = [(0.0, 0.0), (s, 0.0), (s, s), (0.0, s)].map(DVec2::from);
        let attachments: Vec<DVec2> = self.obstacles.iter().map(|obstacle| obstacle[0]).collect();
        let count = ((s / self.spacing) as usize).max(1);
        let node = |k: usize| (DVec2::new((k % count) as f64, (k / count) as f64) + 0.5) * s / count as f64;
        let steiner: Vec<DVec2> = (0..count * count).map(node).collect();
        let space =
            FreeSpace { outer: Some(&plate), holes: self.obstacles.iter().map(Vec::as_slice).collect() };
        let nodes = Nodes {
            attachments: &attachments,
            terminals: &self.terminals,
            steiner: &steiner,
            spacing: WIDTH,
        };
        PathGraph::build(&space, &nodes, |a, b| a.distance(b))
    }

    /// The lengths of the shortest paths between all pairs of support points, row by row.
    ///
    /// # Errors
    /// As for [`graph`](Self::graph).
    pub fn distances(&self) -> Result<Vec<f64>, GraphError> {
        let graph = self.graph()?;
        let among: Vec<u32> = (0..self.terminals.len()).map(|k| graph.terminal(k)).collect();
        let matrix = graph.distances(&among);
        Ok((0..among.len()).flat_map(|k| matrix.row(k).to_vec()).collect())
    }

    /// Wavy rings, kept apart from each other by the room of some strands.
    fn add_obstacles(&mut self, count: usize, random: &mut SplitMix) {
        let mut discs: Vec<(DVec2, f64)> = Vec::new();
        // Most tries succeed, since obstacles take a tenth of the plate; the limit is for small plates.
        for _ in 0..50 * count {
            if discs.len() == count {
                break;
            }
            let radius = random.within(3.0, 7.0);
            let centre = random.point(DVec2::splat(self.side));
            let (waves, corners) = (random.whole(2, 6) as f64, random.whole(12, 40));
            let inside = (centre - self.side / 2.0).abs().max_element() + radius + 4.0 < self.side / 2.0;
            if !inside || discs.iter().any(|disc| disc.0.distance(centre) < disc.1 + radius + 6.0) {
                continue;
            }
            discs.push((centre, radius));
            let corner = |k: usize| {
                let angle = k as f64 * TAU / corners as f64;
                let p = centre + radius * (0.85 + 0.15 * (waves * angle).sin()) * DVec2::from_angle(angle);
                (p * 1e4).round() / 1e4
            };
            self.obstacles.push((0..corners).map(corner).collect());
        }
    }

    /// A dense patch of up to 60 points, rows as far apart as points in a row, until there are `limit` points.
    fn add_patch(&mut self, limit: usize, walls: &SegmentIndex, random: &mut SplitMix) {
        let corner = random.point(DVec2::splat(self.side));
        let along = DVec2::from_angle(random.within(0.0, TAU));
        let (columns, rows) = (random.whole(2, 10), random.whole(2, 7));
        for k in 0..columns * rows {
            let place = DVec2::new((k % columns) as f64, (k / columns) as f64) * STRIDE;
            let p = corner + along.rotate(place) + random.point(DVec2::splat(0.2 * STRIDE));
            if self.terminals.len() < limit && self.is_free(p, walls) {
                self.terminals.push(p);
            }
        }
    }

    /// A chain that turns a little at every point and ends where it would leave the plate or meet anything.
    fn add_chain(&mut self, limit: usize, walls: &SegmentIndex, random: &mut SplitMix) {
        let mut p = random.point(DVec2::splat(self.side));
        let mut heading = random.within(0.0, TAU);
        for _ in 0..random.whole(4, 40) {
            if self.terminals.len() == limit || !self.is_free(p, walls) {
                return;
            }
            self.terminals.push(p);
            heading += random.within(-0.5, 0.5);
            p += STRIDE * DVec2::from_angle(heading);
        }
    }

    fn walls(&self) -> SegmentIndex {
        let curves: Vec<ClosedCurve> =
            self.obstacles.iter().filter_map(|obstacle| ClosedCurve::new(obstacle.clone()).ok()).collect();
        SegmentIndex::of_curves(&curves, WIDTH)
    }

    /// Whether a point may stand here: on the plate, a bead away from walls, outside of them, and not beside another.
    fn is_free(&self, p: DVec2, walls: &SegmentIndex) -> bool {
        let on_plate = p.min_element() > WIDTH && p.max_element() < self.side - WIDTH;
        let inside =
            |obstacle: &Vec<DVec2>| ClosedCurve::new(obstacle.clone()).is_ok_and(|curve| curve.contains(p));
        on_plate
            && walls.distance(p) > WIDTH
            && self.terminals.iter().all(|q| q.distance_squared(p) > LEAST * LEAST)
            && !self.obstacles.iter().any(inside)
    }
}
