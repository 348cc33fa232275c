//! The plan of one region: its attachments, its tours, and the graph that they are drawn on.

use std::cell::RefCell;
use std::collections::BTreeMap;

use argil_curve::{ClosedCurve, DVec2, SegmentIndex};
use argil_graph::{DistanceMatrix, FreeSpace, Nodes, PathFinder, PathGraph};
#[cfg(feature = "rayon")]
use rayon::prelude::*;

use crate::attachment::{Attachments, attach};
use crate::cycle::Leg;
use crate::excursion::{Excursion, Hops, Stops};
use crate::joint::{Reuse, join_walls};
use crate::round_tour::{meeting_places, taken_along};
use crate::sketch::{Sketch, Stop};
use crate::spine::LANES;
use crate::straight::Straight;
use crate::tours::{TourDistances, Tours};
use crate::{Region, RouteError, RouteSettings};

/// What one region sees of its layer.
pub(crate) struct RegionView<'a> {
    pub(crate) settings: &'a RouteSettings,
    pub(crate) solver: &'a dyn Tours,
    pub(crate) region: &'a Region,
    /// All walls of the layer.
    pub(crate) curves: &'a [ClosedCurve],
    /// Indices of the region's walls: the one around it or, outside of all, the longest; then the others, longest first.
    pub(crate) walls: Vec<usize>,
    /// Segments of the region's walls.
    pub(crate) index: SegmentIndex,
    /// The cycle above.
    pub(crate) above: Option<&'a SegmentIndex>,
    /// Where paths may bend.
    pub(crate) steiner: Vec<DVec2>,
    /// Anchors of the region's demands.
    pub(crate) anchors: Vec<&'a [DVec2]>,
}

/// An attachment: a place on a wall that is a vertex of the region's graph.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    pub(crate) wall: usize,
    pub(crate) arc: f64,
    pub(crate) at: DVec2,
    pub(crate) vertex: u32,
}

/// A closed walk through the region.
#[derive(Clone, Debug)]
pub(crate) struct Tour {
    /// Graph vertices of the stops, in order.
    pub(crate) stops: Vec<u32>,
    pub(crate) leg: Leg,
}

/// Everything that the assembly needs of a region.
#[derive(Debug)]
pub(crate) struct RegionPlan {
    pub(crate) graph: PathGraph,
    pub(crate) cuts: Vec<Cut>,
    pub(crate) tours: Vec<Tour>,
    /// Where the region's demands are met.
    pub(crate) demands: Vec<DVec2>,
    /// What was drawn, its tours in their order.
    sketch: Sketch,
    /// Length of all tours and the price of their roots and rings, mm.
    cost: f64,
}

/// A tour through all demands is taken where it costs no more than this share of one through some: it has no tip that dies, and a
/// layer that is planned otherwise than the one above stands apart from it.
const WORTH: f64 = 0.9;

/// The way to a wall that counts in full where stops are paired, in w.
const FAR: f64 = 87.5;

/// Strand nearer than this to a wall all along, in w, lies between the lanes of a thin part.
const BETWEEN: f64 = 0.04;

/// What it counts there: it pierces the wall at both ends and lies on the bead of the lanes. A hop from lane to lane is short enough.
const BETWEEN_COST: f64 = 5.0;

impl RegionView<'_> {
    /// Plans the region: excursions, or one tour through all, whichever is cheaper; then again with the
    /// demands moved towards the tours, for as long as that pays.
    pub(crate) fn plan(
        &self,
        demands: &[DVec2],
        attachments: &mut Attachments,
    ) -> Result<RegionPlan, RouteError> {
        let taken = attachments.clone();
        let mut best = self.cheapest(demands, &taken)?;
        let passes = self.settings.relaxations.saturating_sub(usize::from(best.sketch.moved));
        for _ in 0..passes {
            if self.region.demands.is_empty() {
                break;
            }
            // Which kind of plan is cheapest hardly ever changes when demands move by less than a bead: only the one that
            // was is drawn again.
            let moved = self.relaxed(&best)?;
            let next = self.draw(self.rerooted(&best.sketch, &moved, &taken), &moved)?;
            if next.cost >= best.cost {
                break;
            }
            best = next;
        }
        for cut in &best.cuts {
            attachments.take(cut.wall, cut.arc);
        }
        Ok(best)
    }

    fn cheapest(&self, demands: &[DVec2], taken: &Attachments) -> Result<RegionPlan, RouteError> {
        if self.walls.is_empty() {
            let tour = (0..demands.len()).map(Stop::Demand).collect();
            return self.draw(Sketch { tours: vec![tour], ..Sketch::default() }, demands);
        }
        // The first pass needs no drawing: tours lead straight from stop to stop but for corners.
        let drawn = |sketch: Sketch| {
            if self.settings.relaxations == 0 {
                return self.draw(sketch, demands);
            }
            let moved = self.relaxed_along(&sketch, demands);
            self.draw(Sketch { moved: true, ..self.rerooted(&sketch, &moved, taken) }, &moved)
        };
        let excursions = || drawn(self.sketch_excursions(demands, taken));
        if self.walls.len() == 1 {
            return excursions();
        }
        let round = || self.cheapest_round(demands, taken, &drawn);
        #[cfg(feature = "rayon")]
        let (plan, round) = rayon::join(excursions, round);
        #[cfg(not(feature = "rayon"))]
        let (plan, round) = (excursions(), round());
        let (plan, round) = (plan?, round?);
        Ok(if round.cost < plan.cost { round } else { plan })
    }

    /// One tour through all walls, with all demands or with those that lie on its way.
    fn cheapest_round(
        &self,
        demands: &[DVec2],
        taken: &Attachments,
        drawn: &impl Fn(Sketch) -> Result<RegionPlan, RouteError>,
    ) -> Result<RegionPlan, RouteError> {
        let some = drawn(self.sketch_round(demands, taken)?)?;
        // Round two walls such a tour is a ring.
        if demands.is_empty() || self.walls.len() < 3 {
            return Ok(some);
        }
        let all = drawn(self.sketch_whole_round(demands, taken)?)?;
        Ok(if all.cost < WORTH * some.cost { all } else { some })
    }

    pub(crate) fn wall(&self, local: usize) -> &ClosedCurve {
        &self.curves[self.walls[local]]
    }

    /// The arc of one of the region's walls that is nearest to a wanted one and free. `from` is where its strand comes from.
    fn free_near(&self, taken: &Attachments, local: usize, wanted: f64, from: DVec2) -> f64 {
        let wall = self.walls[local];
        let curve = &self.curves[wall];
        let hops = curve.point_at(wanted).distance(from) < LANES * self.settings.width;
        taken.free_near(wall, curve, wanted, (self.region.outer == Some(wall), hops))
    }

    /// Walls joined by a tree, demands served by excursions.
    fn sketch_excursions(&self, demands: &[DVec2], taken: &Attachments) -> Sketch {
        let s = self.settings;
        let walls: Vec<&ClosedCurve> = (0..self.walls.len()).map(|w| self.wall(w)).collect();
        let to_wall: Vec<Vec<f64>> =
            demands.iter().map(|&d| walls.iter().map(|w| w.nearest(d).distance).collect()).collect();
        let reuse = Reuse { reach: s.reuse_reach * s.width, share: s.reuse };
        let joints = join_walls(&walls, demands, &to_wall, reuse);
        let mut taken = taken.clone();
        let mut places = Vec::with_capacity(joints.len());
        for joint in &joints {
            let on_parent = walls[joint.parent].nearest(walls[joint.wall].point_at(joint.arc)).point;
            let arc = self.free_near(&taken, joint.wall, joint.arc, on_parent);
            taken.take(self.walls[joint.wall], arc);
            places.push((joint.wall, arc));
        }
        // Stops are the joints first, each bound to its parent, then the demands.
        let at: Vec<DVec2> = places
            .iter()
            .map(|&(wall, arc)| walls[wall].point_at(arc))
            .chain(demands.iter().copied())
            .collect();
        let mut reach: Vec<Vec<f64>> = Vec::with_capacity(at.len());
        for (joint, &place) in joints.iter().zip(&at) {
            let mut row = vec![f64::INFINITY; walls.len()];
            row[joint.parent] = walls[joint.parent].nearest(place).distance;
            reach.push(row);
        }
        let hopping: Vec<bool> =
            joints.iter().zip(&reach).map(|(joint, row)| row[joint.parent] < LANES * s.width).collect();
        reach.extend(to_wall);
        let bound: Vec<bool> = (0..at.len()).map(|k| k < joints.len()).collect();
        let hops = self.straight(&at, &hopping);
        let stops = Stops {
            hops: &hops,
            to_wall: &reach,
            bound: &bound,
            far: FAR * s.width,
            root_cost: s.root_cost * s.width,
            length_cost: s.length_cost / s.width,
        };
        let mut excursions = stops.excursions();
        excursions.sort_by_key(|e| e.stops.len());
        let stop = |k: usize| if k < joints.len() { Stop::Place(k) } else { Stop::Demand(k - joints.len()) };
        let mut sketch = Sketch { places, ordered: true, ..Sketch::default() };
        self.root(&excursions, &stops, &mut taken, &mut sketch, |k| at[k], stop);
        sketch
    }

    /// Gives every excursion a place on its wall, the one nearest to it that is free, and adds it to the sketch. `at` tells where a stop
    /// is and `stop` what it is.
    fn root<H: Hops>(
        &self,
        excursions: &[Excursion],
        stops: &Stops<'_, H>,
        taken: &mut Attachments,
        sketch: &mut Sketch,
        at: impl Fn(usize) -> DVec2,
        stop: impl Fn(usize) -> Stop,
    ) {
        for excursion in excursions {
            let (wall, curve) = (self.walls[excursion.wall], self.wall(excursion.wall));
            let reach = |stop: usize| stops.to_wall[stop][excursion.wall];
            let near = excursion.stops.iter().copied();
            let near =
                near.min_by(|&a, &b| reach(a).total_cmp(&reach(b)).then(a.cmp(&b))).unwrap_or_default();
            let arc = self.free_near(taken, excursion.wall, curve.nearest(at(near)).s, at(near));
            taken.take(wall, arc);
            let home = Stop::Place(sketch.places.len());
            sketch.places.push((excursion.wall, arc));
            sketch.tours.push(excursion.stops.iter().map(|&k| stop(k)).chain([home]).collect());
        }
    }

    /// The same sketch for demands that have moved a little: every excursion leaves its wall at the place that is now nearest.
    fn rerooted(&self, sketch: &Sketch, demands: &[DVec2], taken: &Attachments) -> Sketch {
        let mut moved = sketch.clone();
        let mut taken = taken.clone();
        // The places that come first join walls, and stay where they are.
        let homes: BTreeMap<usize, &Vec<Stop>> =
            sketch.tours.iter().filter_map(|tour| Self::home(tour).map(|home| (home, tour))).collect();
        for (k, place) in moved.places.iter_mut().enumerate() {
            let (wall, curve) = (self.walls[place.0], self.wall(place.0));
            if let Some(tour) = homes.get(&k) {
                let near = tour.iter().filter_map(|stop| match *stop {
                    Stop::Demand(demand) => Some((curve.nearest(demands[demand]), demands[demand])),
                    Stop::Place(_) => None,
                });
                if let Some((near, from)) = near.min_by(|p, q| p.0.distance.total_cmp(&q.0.distance)) {
                    place.1 = self.free_near(&taken, place.0, near.s, from);
                }
            }
            taken.take(wall, place.1);
        }
        moved
    }

    /// The place on a wall that a tour sets out from, if that is the only one that it has.
    fn home(tour: &[Stop]) -> Option<usize> {
        let mut places = tour.iter().filter_map(|stop| match *stop {
            Stop::Place(place) => Some(place),
            Stop::Demand(_) => None,
        });
        places.next().filter(|_| places.next().is_none())
    }

    /// One tour through all walls and all demands.
    fn sketch_whole_round(&self, demands: &[DVec2], taken: &Attachments) -> Result<Sketch, RouteError> {
        let places = self.met_by_one_tour(demands, &mut taken.clone());
        let met = places.iter().map(|&(wall, arc)| self.wall(wall).point_at(arc));
        let at: Vec<DVec2> = met.chain(demands.iter().copied()).collect();
        let (order, _) = TourDistances::straight(&at).toured(self.solver, None, &self.settings.tour)?;
        let stop = |k: usize| match k.checked_sub(places.len()) {
            Some(demand) => Stop::Demand(demand),
            None => Stop::Place(k),
        };
        let tours = vec![order.into_iter().map(stop).collect()];
        Ok(Sketch { places, tours, round: true, ordered: true, moved: false })
    }

    /// Where one tour through the walls and the given points meets each of the walls.
    fn met_by_one_tour(&self, points: &[DVec2], taken: &mut Attachments) -> Vec<(usize, f64)> {
        let walls: Vec<&ClosedCurve> = (0..self.walls.len()).map(|w| self.wall(w)).collect();
        let wanted = meeting_places(&walls, points, &self.settings.tour).into_iter().enumerate();
        wanted
            .map(|(local, arc)| {
                // It has to get on from there to the next wall.
                let arc = self.free_near(taken, local, arc, DVec2::INFINITY);
                taken.take(self.walls[local], arc);
                (local, arc)
            })
            .collect()
    }

    /// One tour through all walls, which takes along what demands it can; the others are served by excursions.
    fn sketch_round(&self, demands: &[DVec2], taken: &Attachments) -> Result<Sketch, RouteError> {
        let s = self.settings;
        let walls: Vec<&ClosedCurve> = (0..self.walls.len()).map(|w| self.wall(w)).collect();
        let mut taken = taken.clone();
        let places = self.met_by_one_tour(&[], &mut taken);
        // The demands first, so that they have the numbers of their stops.
        let met = places.iter().map(|&(wall, arc)| walls[wall].point_at(arc));
        let at: Vec<DVec2> = demands.iter().copied().chain(met).collect();
        let to_wall: Vec<Vec<f64>> =
            demands.iter().map(|&d| walls.iter().map(|w| w.nearest(d).distance).collect()).collect();
        let bound = vec![false; demands.len()];
        let hops = self.straight(&at, &[]);
        let stops = Stops {
            hops: &hops,
            to_wall: &to_wall,
            bound: &bound,
            far: FAR * s.width,
            root_cost: s.root_cost * s.width,
            length_cost: s.length_cost / s.width,
        };
        let (order, _) = TourDistances::straight(&at[demands.len()..]).toured(self.solver, None, &s.tour)?;
        let mut round: Vec<usize> = order.into_iter().map(|k| demands.len() + k).collect();
        let excursions = taken_along(&mut round, stops.excursions(), &stops, s.ring_cost);
        let stop = |k: usize| match k.checked_sub(demands.len()) {
            Some(place) => Stop::Place(place),
            None => Stop::Demand(k),
        };
        let tours = vec![round.into_iter().map(stop).collect()];
        let mut sketch = Sketch { places, tours, round: true, ordered: true, moved: false };
        self.root(&excursions, &stops, &mut taken, &mut sketch, |k| demands[k], stop);
        Ok(sketch)
    }

    /// Straight hops between places, of which some hop across a spine.
    fn straight<'a>(
        &'a self,
        places: &'a [DVec2],
        hopping: &'a [bool],
    ) -> Straight<'a, impl Fn(DVec2, DVec2) -> f64 + 'a> {
        Straight {
            places,
            walls: &self.index,
            hopping,
            cheapest: self.settings.coherence.min(1.0),
            weight: |a, b| self.weight(a, b),
            grid: self.settings.grid,
            known: RefCell::default(),
        }
    }

    /// Draws a sketch: the graph with all its places, and the shortest tour through the stops of each.
    fn draw(&self, mut sketch: Sketch, demands: &[DVec2]) -> Result<RegionPlan, RouteError> {
        let s = self.settings;
        let (graph, cuts) = self.graph(&sketch.places, demands)?;
        let among: Vec<u32> =
            cuts.iter().map(|c| c.vertex).chain((0..demands.len()).map(|d| graph.terminal(d))).collect();
        let distances = self.distances(&graph, &among)?;
        let tour = |stops: &mut Vec<Stop>| {
            let serves = stops.iter().any(|stop| matches!(stop, Stop::Demand(_)));
            let nodes: Vec<usize> = stops
                .iter()
                .map(|&stop| match stop {
                    Stop::Place(place) => place,
                    Stop::Demand(demand) => cuts.len() + demand,
                })
                .collect();
            let start: Vec<usize> = (0..nodes.len()).collect();
            let start = sketch.ordered.then_some(start.as_slice());
            let (order, length) =
                TourDistances::new(&distances, &nodes).toured(self.solver, start, &s.tour)?;
            *stops = order.iter().map(|&k| stops[k]).collect();
            let stops = order.iter().map(|&k| among[nodes[k]]).collect();
            Ok((length, Tour { stops, leg: if serves { Leg::Support } else { Leg::Joint } }))
        };
        let mut tours = std::mem::take(&mut sketch.tours);
        #[cfg(feature = "rayon")]
        let drawn: Vec<Result<_, RouteError>> = tours.par_iter_mut().map(tour).collect();
        #[cfg(not(feature = "rayon"))]
        let drawn: Vec<Result<_, RouteError>> = tours.iter_mut().map(tour).collect();
        // The first that fails, whatever thread was first.
        let drawn = drawn.into_iter().collect::<Result<Vec<_>, _>>()?;
        sketch.tours = tours;
        sketch.ordered = true;
        // What a tour through all walls is longer for the demands that it takes along.
        let mut detour = 0.0;
        if let (true, Some((length, _))) = (sketch.round, drawn.first()) {
            let walls: Vec<usize> = (0..self.walls.len()).collect();
            let (_, bare) = TourDistances::new(&distances, &walls).toured(self.solver, None, &s.tour)?;
            detour = (length - bare).max(0.0);
        }
        let mut cost = s.root_cost * s.width * cuts.len() as f64 + (s.ring_cost - 1.0) * detour;
        let mut tours = Vec::with_capacity(drawn.len());
        for (length, tour) in drawn {
            cost += length;
            tours.push(tour);
        }
        Ok(RegionPlan { graph, cuts, tours, demands: demands.to_vec(), sketch, cost })
    }

    /// The region's graph with the given places on its walls as attachments.
    fn graph(&self, places: &[(usize, f64)], demands: &[DVec2]) -> Result<(PathGraph, Vec<Cut>), RouteError> {
        let s = self.settings;
        let mut cuts: Vec<Cut> = places
            .iter()
            .map(|&(local, arc)| Cut { wall: self.walls[local], arc, at: DVec2::ZERO, vertex: 0 })
            .collect();
        let mut loops = Vec::with_capacity(self.walls.len());
        for &wall in &self.walls {
            let own: Vec<usize> = (0..cuts.len()).filter(|&k| cuts[k].wall == wall).collect();
            let arcs: Vec<f64> = own.iter().map(|&k| cuts[k].arc).collect();
            let outside = vec![self.region.outer != Some(wall); own.len()];
            let attached = attach(&self.curves[wall], &arcs, &outside, s.grid);
            for (&k, &at) in own.iter().zip(&attached.at) {
                cuts[k].at = attached.points[at];
            }
            loops.push(attached.points);
        }
        let outer = self.region.outer.map(|_| loops[0].as_slice());
        let holes = loops.iter().skip(usize::from(outer.is_some())).map(Vec::as_slice).collect();
        let attachments: Vec<DVec2> = cuts.iter().map(|c| c.at).collect();
        let nodes = Nodes {
            attachments: &attachments,
            terminals: demands,
            steiner: &self.steiner,
            spacing: 0.27 * s.width,
        };
        let graph = PathGraph::build(&FreeSpace { outer, holes }, &nodes, |a, b| self.weight(a, b))
            .map_err(|source| RouteError::Graph { near: self.somewhere(demands), source })?;
        for (k, cut) in cuts.iter_mut().enumerate() {
            cut.vertex = graph.attachment(k);
        }
        Ok((graph, cuts))
    }

    /// Length of an edge, cheaper along the cycle above (coherence) and dearer beside a wall.
    fn weight(&self, a: DVec2, b: DVec2) -> f64 {
        let s = self.settings;
        let mut weight = a.distance(b);
        if let Some(above) = self.above
            && [a, b, a.midpoint(b)].iter().all(|&p| above.is_within(p, s.across))
        {
            weight *= s.coherence;
        }
        let crowding = |t: f64| {
            self.index.nearest_within(a.lerp(b, t), s.width).map_or(0.0, |near| 1.0 - near.distance / s.width)
        };
        let crowded = [0.15, 0.5, 0.85].map(crowding);
        if crowded.iter().all(|&c| c > 1.0 - BETWEEN) {
            weight *= BETWEEN_COST;
        }
        weight * (1.0 + s.wall_penalty * (crowded[0] + crowded[1] + crowded[2]) / 3.0)
    }

    /// Distances among vertices, all of them finite.
    fn distances(&self, graph: &PathGraph, among: &[u32]) -> Result<DistanceMatrix, RouteError> {
        let distances = graph.distances(among);
        match (0..among.len()).find(|&k| !distances.get(0, k).is_finite()) {
            Some(k) => Err(RouteError::Unreachable { at: graph.position(among[k]) }),
            None => Ok(distances),
        }
    }

    /// A point to name in errors.
    fn somewhere(&self, demands: &[DVec2]) -> DVec2 {
        let wall = self.walls.first().map(|&w| self.curves[w].points()[0]);
        demands.first().copied().or(wall).unwrap_or_default()
    }
}

impl RegionPlan {
    /// Calls `visit` with the graph path of every hop of a tour.
    pub(crate) fn walk(&self, tour: &Tour, mut visit: impl FnMut(&[u32])) -> Result<(), RouteError> {
        let mut finder = PathFinder::new(&self.graph);
        let n = tour.stops.len();
        for k in 0..if n > 1 { n } else { 0 } {
            let (from, to) = (tour.stops[k], tour.stops[(k + 1) % n]);
            if from != to {
                let path = finder.path(from, to);
                visit(&path.ok_or_else(|| RouteError::Unreachable { at: self.graph.position(to) })?);
            }
        }
        Ok(())
    }
}
