//! The paper's own path planning: one connection point a wall, one tour a region, walls spliced in.

use argil_curve::{ClosedCurve, DVec2, Segment, SegmentIndex, on_grid};
use argil_graph::{DistanceMatrix, FreeSpace, Nodes, PathGraph};
use argil_tour::{Metric, shortest_tour};

use crate::attachment::attach;
use crate::cycle::{Cycle, Leg};
use crate::joint::closest;
use crate::lane::{Drawn, push, subdivided};
use crate::layer::{clear_of, curves, dot};
use crate::{LayerInput, Region, RouteError, RouteSettings, regions};

/// Least distance of two bends of replaced edges, in w; the rings of a safeguard have finer vertices on round corners.
const BEND_SPACING: f64 = 0.27;

/// Routes a layer as section 3.3 of the paper has it, for comparison with [`Router`](crate::Router).
///
/// 1. *Model connections.* Every wall gets one connection point: the one of its points that is nearest to the
///    support points of the region around it or, where that has none, nearest to the region's other walls. A wall
///    that is alone in its region looks inwards instead. Whether the support points of the whole layer count, and
///    what "the distance to all other model paths" adds up, the text leaves open; a support point behind another
///    wall is no opportunity to connect, and the nearest wall is the plainest of distances.
/// 2. *Model-avoiding distance.* The graph's vertices are the safeguard's rings and the support points. Three things are
///    added: the connection points, which the text does not list and without which no edge ends at one; points along
///    the rings' long edges, for the triangulation takes walls only as constraints; and the portals of [`PathGraph`],
///    without which narrow regions fall apart, in particular those inside of walls, where no safeguard is.
///    Edges along the path above weigh [`RouteSettings::coherence`] of their length ("sufficiently close" is both
///    ends and the middle within [`RouteSettings::across`]).
/// 3. One shortest tour for each region; an edge of it stays straight unless it crosses a wall, and only
///    then becomes its path in the graph.
/// 4. *Nested support.* Where the tour meets a wall it first walks the tour of the region inside, which begins and ends
///    at the same connection point, then prints the wall whole in the orientation that it came in, and goes on.
///
/// What is known to go wrong, beside the plan of [`Router`](crate::Router) that mends it:
/// - A wall spliced in against the order round its connection point crosses the tour there (89 times in three
///   slanted columns, 145 times in the Stanford bunny).
/// - A nested tour that shares the connection point passes through the wall (80 times in the bunny).
/// - A straight edge may cross the path that replaces another one (50 proper crossings in a table).
/// - A corridor that is walked twice is printed twice, one strand on top of the other.
/// - All nested support hangs on one point of its wall: the strands inside are far longer than excursions from
///   wherever a wall is near.
///
/// Of the settings only `width`, `across`, `coherence`, `steiner_step`, `spacing`, `grid`, `tour` and, for a layer that
/// is a single point, `slack` are read.
#[derive(Clone, Debug)]
pub struct SplicedRouter {
    settings: RouteSettings,
}

/// What a tour visits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stop {
    Wall(usize),
    Demand(usize),
}

/// A stop and the bends on the way from it to the next one.
#[derive(Clone, Debug)]
struct Hop {
    stop: Stop,
    bends: Vec<DVec2>,
}

/// The tour of one region; it begins at the wall around the region, if there is one.
#[derive(Clone, Debug)]
struct RegionTour {
    outer: Option<usize>,
    hops: Vec<Hop>,
    leg: Leg,
    /// Demands in the same place as another one, which is visited: (that one, the twin).
    twins: Vec<(usize, usize)>,
}

/// All regions' distances as a metric of tours.
struct Stops<'a>(&'a DistanceMatrix);

impl Metric for Stops<'_> {
    fn nodes(&self) -> usize {
        self.0.len()
    }

    fn distance(&self, a: usize, b: usize) -> f64 {
        self.0.get(a, b)
    }

    fn row(&self, a: usize) -> Option<&[f64]> {
        Some(self.0.row(a))
    }
}

impl SplicedRouter {
    /// A router with the given settings.
    ///
    /// # Errors
    /// [`RouteError::Setting`] names a value that no plan can be made with.
    pub fn new(settings: RouteSettings) -> Result<Self, RouteError> {
        settings.check()?;
        Ok(Self { settings })
    }

    /// One closed cycle through all walls and demands. Unlike that of [`Router`](crate::Router) it may cross itself and
    /// the walls, and passes its demands where they are rather than within their slack.
    ///
    /// # Errors
    /// See [`RouteError`]; each names a place, in particular [`RouteError::Unreachable`] a wall or demand that no path
    /// leads to. Nothing is ever left out instead.
    ///
    /// # Complexity
    /// Dominated by the distances in each region's graph, about O(T · V) for T stops and V vertices.
    ///
    /// # Example
    /// ```
    /// use argil_route::{DVec2, Demand, LayerInput, Leg, RouteSettings, SplicedRouter, Wall};
    /// let square = [(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0)].map(DVec2::from);
    /// let demand = Demand { position: DVec2::new(9.0, 3.0), anchors: Vec::new() };
    /// let layer = LayerInput {
    ///     walls: &[Wall { points: &square, parent: None }],
    ///     demands: &[demand],
    ///     safeguard: &[],
    ///     above: None,
    ///     barred: &[],
    /// };
    /// let cycle = SplicedRouter::new(RouteSettings::default())?.cycle(&layer)?;
    /// // Out to the demand and straight back from the one connection point.
    /// assert!((cycle.length_of(Leg::Wall) - 24.0).abs() < 1e-3);
    /// assert!((cycle.length_of(Leg::Support) - 6.0).abs() < 1e-3);
    /// # Ok::<(), argil_route::RouteError>(())
    /// ```
    pub fn cycle(&self, layer: &LayerInput<'_>) -> Result<Cycle, RouteError> {
        let s = &self.settings;
        let curves = curves(layer.walls)?;
        if curves.is_empty() && layer.demands.is_empty() {
            return Err(RouteError::Empty);
        }
        let all = SegmentIndex::of_curves(&curves, s.width);
        let demands: Vec<DVec2> = layer.demands.iter().map(|d| clear_of(&all, d, s)).collect();
        let regions = regions(layer.walls, &curves, &demands)?;
        let connections: Vec<f64> =
            (0..curves.len()).map(|wall| connection(wall, &curves, &regions, &demands)).collect();
        let rings = bends(layer.safeguard, s.steiner_step * s.width);

        let mut tours = Vec::with_capacity(regions.len());
        for region in &regions {
            let site = Site { layer, settings: s, curves: &curves, connections: &connections, region };
            tours.extend(site.tour(&demands, &rings)?);
        }
        let mut splice = Splice::new(&curves, &connections, &tours, &demands, s.grid);
        let outermost = tours.iter().find(|tour| tour.outer.is_none());
        let lone =
            regions.iter().find(|region| region.outer.is_none()).and_then(|region| region.children.first());
        match (outermost, lone) {
            (Some(tour), _) => splice.tour(tour),
            (None, Some(&wall)) => splice.wall(wall),
            (None, None) => return Ok(dot(layer.demands, s)),
        }
        splice.close();
        let roots =
            tours.iter().flat_map(|t| &t.hops).filter(|hop| matches!(hop.stop, Stop::Wall(_))).count();
        let mut cycle = subdivided(&splice.drawn, s.spacing * s.width, s.grid, roots);
        for (first, twin) in tours.iter().flat_map(|tour| tour.twins.iter().copied()) {
            let carrier = cycle.carriers.iter().find(|carrier| carrier.1 == first).map(|carrier| carrier.0);
            cycle.carriers.extend(carrier.map(|vertex| (vertex, twin)));
        }
        Ok(cycle)
    }
}

/// The arc of a wall's connection point.
fn connection(wall: usize, curves: &[ClosedCurve], regions: &[Region], demands: &[DVec2]) -> f64 {
    let curve = &curves[wall];
    let around = regions.iter().find(|region| region.children.contains(&wall));
    let within = regions.iter().find(|region| region.outer == Some(wall));
    let nearest = |region: &Region| {
        let to_demands =
            region.demands.iter().map(|&d| curve.nearest(demands[d])).map(|near| (near.distance, near.s));
        let others = region.outer.iter().chain(&region.children).filter(|&&other| other != wall);
        let to_walls =
            others.map(|&other| closest(curve, &curves[other])).map(|(distance, s, _)| (distance, s));
        let least = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0);
        to_demands.min_by(least).or_else(|| to_walls.min_by(least)).map(|(_, s)| s)
    };
    around.and_then(nearest).or_else(|| within.and_then(nearest)).unwrap_or_default()
}

/// The vertices of the rings, and points along their edges at most `step` apart.
fn bends(rings: &[Vec<DVec2>], step: f64) -> Vec<DVec2> {
    let curves = rings.iter().filter_map(|ring| ClosedCurve::new(ring.clone()).ok());
    let mut places = Vec::new();
    for segment in curves.flat_map(|curve| curve.segments().collect::<Vec<_>>()) {
        let pieces = (segment.length() / step).ceil().clamp(1.0, 1e4) as usize;
        places.extend((0..pieces).map(|k| segment.point_at(k as f64 / pieces as f64)));
    }
    places
}

/// A region with what its tour depends on.
struct Site<'a> {
    layer: &'a LayerInput<'a>,
    settings: &'a RouteSettings,
    curves: &'a [ClosedCurve],
    connections: &'a [f64],
    region: &'a Region,
}

impl Site<'_> {
    /// The shortest tour through the connection points of the region's walls and its demands, if it has two stops.
    fn tour(&self, demands: &[DVec2], rings: &[DVec2]) -> Result<Option<RegionTour>, RouteError> {
        let (s, region) = (self.settings, self.region);
        let walls: Vec<usize> = region.outer.iter().chain(&region.children).copied().collect();
        if walls.len() < 2 && region.demands.is_empty() {
            return Ok(None);
        }
        // A connection point leans to the side on which its strand lies, so each region has its own image of it.
        let attached = |&wall: &usize| {
            let outside = [region.outer != Some(wall)];
            let attached = attach(&self.curves[wall], &self.connections[wall..=wall], &outside, s.grid);
            (attached.points[attached.at[0]], attached.points)
        };
        let (places, loops): (Vec<DVec2>, Vec<Vec<DVec2>>) = walls.iter().map(attached).unzip();
        let own: Vec<DVec2> = region.demands.iter().map(|&d| demands[d]).collect();
        let space = FreeSpace {
            outer: region.outer.map(|_| loops[0].as_slice()),
            holes: loops[usize::from(region.outer.is_some())..].iter().map(Vec::as_slice).collect(),
        };
        let spacing = BEND_SPACING * s.width;
        let nodes = Nodes { attachments: &places, terminals: &own, steiner: rings, spacing };
        let graph = PathGraph::build(&space, &nodes, |a, b| self.weight(a, b)).map_err(|source| {
            let near = own.first().or(places.first()).copied().unwrap_or_default();
            RouteError::Graph { near, source }
        })?;

        let mut stops: Vec<(u32, Stop)> =
            (0..).zip(&walls).map(|(k, &w)| (graph.attachment(k), Stop::Wall(w))).collect();
        let mut twins = Vec::new();
        for (k, &demand) in region.demands.iter().enumerate() {
            let vertex = graph.terminal(k);
            match stops.iter().find(|stop| stop.0 == vertex) {
                Some(&(_, Stop::Demand(first))) => twins.push((first, demand)),
                _ => stops.push((vertex, Stop::Demand(demand))),
            }
        }
        if stops.len() < 2 {
            return Ok(None);
        }
        let vertices: Vec<u32> = stops.iter().map(|stop| stop.0).collect();
        let distances = graph.distances(&vertices);
        let unreachable = |vertex: u32| RouteError::Unreachable { at: graph.position(vertex) };
        if let Some(k) = (0..vertices.len()).find(|&k| !distances.get(0, k).is_finite()) {
            return Err(unreachable(vertices[k]));
        }
        // The order begins with stop 0, which is the wall around the region where there is one.
        let order = shortest_tour(&Stops(&distances), &[], None, &s.tour).order;

        let edges = loops.iter().flat_map(|l| (0..l.len()).map(|k| Segment::new(l[k], l[(k + 1) % l.len()])));
        let edges = SegmentIndex::new(edges.collect(), s.width);
        let mut hops = Vec::with_capacity(order.len());
        for (k, &here) in order.iter().enumerate() {
            let (from, to) = (vertices[here], vertices[order[(k + 1) % order.len()]]);
            let straight = Segment::new(graph.position(from), graph.position(to));
            let bends = if self.is_free(straight, &edges) {
                Vec::new()
            } else {
                let path = graph.path(from, to).ok_or_else(|| unreachable(to))?;
                let inner = path.get(1..path.len().saturating_sub(1)).unwrap_or_default();
                inner.iter().map(|&v| on_grid(graph.position(v), s.grid)).collect()
            };
            hops.push(Hop { stop: stops[here].1, bends });
        }
        let leg = if region.demands.is_empty() { Leg::Joint } else { Leg::Support };
        Ok(Some(RegionTour { outer: region.outer, hops, leg, twins }))
    }

    /// Length of an edge, discounted along the cycle above.
    fn weight(&self, a: DVec2, b: DVec2) -> f64 {
        let near = |above: &SegmentIndex| {
            [a, b, a.midpoint(b)].iter().all(|&p| above.nearest_within(p, self.settings.across).is_some())
        };
        let factor = if self.layer.above.is_some_and(near) { self.settings.coherence } else { 1.0 };
        factor * a.distance(b)
    }

    /// Whether a straight edge between two stops stays in the region. Its middle is asked for too: an edge that leaves
    /// a wall exactly through a vertex crosses no segment of it.
    fn is_free(&self, edge: Segment, walls: &SegmentIndex) -> bool {
        let mut crosses = false;
        walls.for_each_near(edge, 0.0, |_, wall| crosses |= wall.crosses(&edge));
        let middle = edge.point_at(0.5);
        let inside = |wall: &usize| self.curves[*wall].contains(middle);
        !crosses && self.region.outer.iter().all(inside) && !self.region.children.iter().any(inside)
    }
}

/// The walk round all tours with the walls spliced in.
struct Splice<'a> {
    /// Every wall from its connection point.
    walls: Vec<Vec<DVec2>>,
    /// The tour inside each wall.
    inside: Vec<Option<&'a RegionTour>>,
    demands: &'a [DVec2],
    drawn: Vec<Drawn>,
}

impl<'a> Splice<'a> {
    /// A walk that has not begun.
    fn new(
        curves: &[ClosedCurve],
        connections: &[f64],
        tours: &'a [RegionTour],
        demands: &'a [DVec2],
        grid: f64,
    ) -> Self {
        let opened = |(curve, &arc): (&ClosedCurve, &f64)| {
            let mut attached = attach(curve, &[arc], &[true], grid);
            attached.points.rotate_left(attached.at[0]);
            attached.points
        };
        let mut inside = vec![None; curves.len()];
        for tour in tours {
            if let Some(wall) = tour.outer {
                inside[wall] = Some(tour);
            }
        }
        let walls = curves.iter().zip(connections).map(opened).collect();
        Self { walls, inside, demands, drawn: Vec::new() }
    }

    /// Drops the last vertex where it repeats the first.
    fn close(&mut self) {
        while self.drawn.len() > 1 && self.drawn[0].at == self.drawn[self.drawn.len() - 1].at {
            self.drawn.pop();
        }
    }

    fn put(&mut self, at: DVec2, fixed: bool, carries: Option<usize>, leg: Leg) {
        push(&mut self.drawn, Drawn { at, vertex: None, fixed, carries, leg });
    }

    /// The region inside, then the wall itself, back to where it began.
    fn wall(&mut self, wall: usize) {
        if let Some(tour) = self.inside[wall] {
            self.tour(tour);
        }
        for k in 0..=self.walls[wall].len() {
            let at = self.walls[wall][k % self.walls[wall].len()];
            self.put(at, true, None, Leg::Wall);
        }
    }

    fn tour(&mut self, tour: &RegionTour) {
        for hop in &tour.hops {
            match hop.stop {
                Stop::Wall(wall) if tour.outer == Some(wall) => {
                    self.put(self.walls[wall][0], true, None, tour.leg);
                }
                Stop::Wall(wall) => self.wall(wall),
                Stop::Demand(demand) => self.put(self.demands[demand], false, Some(demand), tour.leg),
            }
            if let Some(last) = self.drawn.last_mut() {
                last.leg = tour.leg;
            }
            for &bend in &hop.bends {
                self.put(bend, false, None, tour.leg);
            }
        }
    }
}
