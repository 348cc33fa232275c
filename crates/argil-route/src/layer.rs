//! One layer, from walls and demands to its cycle.

use std::collections::BTreeMap;

use argil_curve::{ClosedCurve, DVec2, SegmentIndex, on_grid};

use crate::attachment::Attachments;
use crate::circuit::euler_circuit;
use crate::cycle::{Cycle, Leg};
use crate::lane::draw;
use crate::multigraph::Multigraph;
use crate::region_plan::{Cut, RegionPlan, RegionView};
use crate::spine::spines;
use crate::{Region, RouteError, RouteSettings, ShortestTours, Tours, regions};

/// How far attachments keep from where a wall turns off into a spine, in w: a strand that came from inside and went on
/// along the spine would be told from one that goes through the wall by the length of wall between.
const ROOT_GAP: f64 = 0.5;

/// How far from the nearest demand paths may bend in a region of one wall, in w. Beyond it there are a few paths all the same, through
/// the middles of the triangulation's edges.
const NEAR: f64 = 6.0;

/// A wall of the layer: a closed loop that is printed whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall<'a> {
    /// Its vertices on the output grid, simple, disjoint from all other walls, no repeated last point.
    pub points: &'a [DVec2],
    /// The smallest wall around it.
    pub parent: Option<usize>,
}

/// A point that the cycle has to pass, such as a support point of the layer above.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Demand {
    /// Where.
    pub position: DVec2,
    /// It may be moved as long as it stays within [`RouteSettings::slack`] of each of these.
    pub anchors: Vec<DVec2>,
}

/// What one layer gives to be routed.
#[derive(Clone, Copy, Debug)]
pub struct LayerInput<'a> {
    /// All walls.
    pub walls: &'a [Wall<'a>],
    /// All points to pass.
    pub demands: &'a [Demand],
    /// Closed polylines that lead paths round the model, such as the safeguard's rings.
    pub safeguard: &'a [Vec<DVec2>],
    /// The cycle of the layer above, for coherence.
    pub above: Option<&'a SegmentIndex>,
    /// Places on walls to keep attachments away from, as if strand were attached there already.
    pub barred: &'a [DVec2],
}

/// How much farther than the nearest part of a wall from a barred place others are barred as well, in w.
const BESIDE: f64 = 0.2;

/// Routes layers; see the crate's documentation for the method.
#[derive(Clone, Debug)]
pub struct Router {
    settings: RouteSettings,
}

impl Router {
    /// A router with the given settings.
    ///
    /// # Errors
    /// [`RouteError::Setting`] names a value that no plan can be made with.
    pub fn new(settings: RouteSettings) -> Result<Self, RouteError> {
        settings.check()?;
        Ok(Self { settings })
    }

    /// One closed cycle through all walls and demands.
    ///
    /// # Errors
    /// See [`RouteError`]; each names a place. Nothing is ever left out instead.
    ///
    /// # Complexity
    /// Dominated by the distances in each region's graph, about O(T · V) for T stops and V vertices.
    pub fn cycle(&self, layer: &LayerInput<'_>) -> Result<Cycle, RouteError> {
        self.cycle_with(layer, &ShortestTours)
    }

    /// One closed cycle through all walls and demands, by tours of another solver; [`Tours`] has an example.
    ///
    /// # Errors
    /// See [`RouteError`]; [`RouteError::Tour`] where an order is not one of all stops.
    ///
    /// # Complexity
    /// That of [`cycle`](Self::cycle), and what the solver takes for some four tours a region.
    pub fn cycle_with(&self, layer: &LayerInput<'_>, tours: &dyn Tours) -> Result<Cycle, RouteError> {
        let s = &self.settings;
        let curves = curves(layer.walls)?;
        if curves.is_empty() && layer.demands.is_empty() {
            return Err(RouteError::Empty);
        }
        let all = SegmentIndex::of_curves(&curves, s.width);
        let positions: Vec<DVec2> = layer.demands.iter().map(|d| clear_of(&all, d, s)).collect();
        let spines = spines(&curves, &all, s.width);
        let (gap, root_gap) = (s.attachment_gap * s.width, ROOT_GAP * s.width);
        let mut attachments = Attachments::new(spines, gap, root_gap, s.width / 6.0);
        for &place in layer.barred {
            for (wall, curve) in curves.iter().enumerate() {
                let nearest = curve.nearest(place).distance;
                if nearest < s.width {
                    // Where a line turns off, the wall passes twice, at arcs far apart.
                    let near = (0..curve.segment_count()).map(|k| curve.on_segment(k, place));
                    let beside = near.filter(|on| on.distance <= nearest + BESIDE * s.width);
                    beside.for_each(|on| attachments.take(wall, on.s));
                }
            }
        }
        let mut plans = Vec::new();
        for region in regions(layer.walls, &curves, &positions)? {
            if region.outer.is_none() && region.demands.is_empty() && region.children.len() < 2 {
                continue;
            }
            let own: Vec<DVec2> = region.demands.iter().map(|&d| positions[d]).collect();
            let view = self.view((layer, tours), &curves, &region, &own);
            plans.push((region.clone(), view.plan(&own, &mut attachments)?));
        }
        self.assemble(layer, &curves, &plans)
    }

    fn view<'a>(
        &'a self,
        (layer, solver): (&LayerInput<'a>, &'a dyn Tours),
        curves: &'a [ClosedCurve],
        region: &'a Region,
        demands: &[DVec2],
    ) -> RegionView<'a> {
        let s = &self.settings;
        let mut children = region.children.clone();
        children.sort_by(|&a, &b| curves[b].length().total_cmp(&curves[a].length()).then(a.cmp(&b)));
        let walls: Vec<usize> = region.outer.into_iter().chain(children).collect();
        let index = SegmentIndex::of_curves(walls.iter().map(|&w| &curves[w]), s.width);
        let mut view = RegionView {
            settings: s,
            solver,
            region,
            curves,
            walls,
            index,
            above: layer.above,
            steiner: Vec::new(),
            anchors: region.demands.iter().map(|&d| layer.demands[d].anchors.as_slice()).collect(),
        };
        view.steiner = steiner(&view, layer.safeguard, demands);
        view
    }

    /// Walls and tours into one multigraph, its circuit, and the drawn cycle.
    fn assemble(
        &self,
        layer: &LayerInput<'_>,
        curves: &[ClosedCurve],
        plans: &[(Region, RegionPlan)],
    ) -> Result<Cycle, RouteError> {
        let s = &self.settings;
        let mut graph = Multigraph::default();
        let mut cuts_of: Vec<Vec<(Cut, u32)>> = vec![Vec::new(); curves.len()];
        let mut twins: Vec<(usize, usize)> = Vec::new();
        for (region, plan) in plans {
            let mut vertex_of: BTreeMap<u32, u32> = BTreeMap::new();
            for (k, &demand) in region.demands.iter().enumerate() {
                let v = plan.graph.terminal(k);
                match vertex_of.get(&v) {
                    Some(&shared) => twins.extend(graph.demand[shared as usize].map(|first| (first, demand))),
                    None => {
                        vertex_of.insert(v, graph.vertex(plan.demands[k], Some(demand)));
                    }
                }
            }
            for &cut in &plan.cuts {
                let v = *vertex_of.entry(cut.vertex).or_insert_with(|| graph.vertex(cut.at, None));
                cuts_of[cut.wall].push((cut, v));
            }
            for tour in &plan.tours {
                plan.walk(tour, |path| {
                    for pair in path.windows(2) {
                        let [a, b] = [pair[0], pair[1]].map(|v| {
                            *vertex_of.entry(v).or_insert_with(|| graph.vertex(plan.graph.position(v), None))
                        });
                        graph.walk(a, b, tour.leg);
                    }
                })?;
            }
        }
        for (curve, cuts) in curves.iter().zip(&mut cuts_of) {
            add_wall(&mut graph, curve, cuts);
        }
        graph.settle();
        let unattached = cuts_of.iter().position(Vec::is_empty);
        if graph.edges.is_empty() {
            return Ok(match (curves, layer.demands) {
                ([only], []) => Cycle::of_wall(only.points()),
                (_, demands) => dot(demands, s),
            });
        }
        if let Some(wall) = unattached {
            return Err(RouteError::Disconnected { at: curves[wall].points()[0] });
        }
        let circuit = euler_circuit(&graph)?;
        let mut cycle = draw(&graph, &circuit, s.lane * s.width, s.spacing * s.width, s.grid);
        for (first, twin) in twins {
            let carriers =
                cycle.carriers.iter().filter(|c| c.1 == first).map(|c| (c.0, twin)).collect::<Vec<_>>();
            cycle.carriers.extend(carriers);
        }
        Ok(cycle)
    }
}

/// The walls as curves.
pub(crate) fn curves(walls: &[Wall<'_>]) -> Result<Vec<ClosedCurve>, RouteError> {
    walls
        .iter()
        .enumerate()
        .map(|(wall, w)| match ClosedCurve::new(w.points.to_vec()) {
            Ok(curve) if curve.segment_count() > 2 => Ok(curve),
            _ => Err(RouteError::Wall { wall }),
        })
        .collect()
}

/// A demand's place on the grid, at least a little away from every wall. Where straight away from the nearest one there is another,
/// such as between the lanes of a spine, the places round about are tried.
pub(crate) fn clear_of(walls: &SegmentIndex, demand: &Demand, s: &RouteSettings) -> DVec2 {
    let keep = 0.05 * s.width;
    let place = demand.position;
    let on_grid = |p: DVec2| on_grid(p, s.grid);
    let Some(near) = walls.nearest_within(place, keep) else { return on_grid(place) };
    let anchor = demand.anchors.first().copied().unwrap_or(place);
    let away = [place - near.point, anchor - near.point, DVec2::X]
        .into_iter()
        .find(|v| v.length() > s.grid)
        .unwrap_or(DVec2::X);
    let straight = near.point + keep * away.normalize_or(DVec2::X);
    let around = (1..=4).flat_map(|ring| {
        let turn = |k: u32| DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_6);
        (0..12).map(move |k| place + f64::from(ring) * keep * turn(k))
    });
    let mut best = (f64::NEG_INFINITY, straight);
    for at in std::iter::once(straight).chain(around).map(on_grid) {
        let room = walls.nearest_within(at, keep).map_or(keep, |near| near.distance);
        if room > 0.5 * keep {
            return at;
        }
        if room > best.0 {
            best = (room, at);
        }
    }
    best.1
}

/// Places where paths may bend: one bead off every wall, along the safeguard, and round everything.
fn steiner(view: &RegionView<'_>, safeguard: &[Vec<DVec2>], demands: &[DVec2]) -> Vec<DVec2> {
    let s = view.settings;
    let step = s.steiner_step * s.width;
    let mut places = Vec::new();
    for &wall in &view.walls {
        let curve = &view.curves[wall];
        let inside = view.region.outer == Some(wall);
        let sign = if inside == (curve.signed_area() > 0.0) { 1.0 } else { -1.0 };
        let count = (curve.length() / step).ceil().clamp(3.0, 1e5) as usize;
        for k in 0..count {
            let on = curve.locate((k as f64 + 0.5) * curve.length() / count as f64);
            let segment = curve.segment(on.segment);
            let left = (segment.end - segment.start).normalize_or_zero().perp();
            let place = segment.point_at(on.t) + sign * s.width * left;
            if !view.index.is_within(place, 0.8 * s.width) {
                places.push(place);
            }
        }
    }
    if view.region.outer.is_none() {
        for ring in safeguard {
            if let Ok(ring) = ClosedCurve::new(ring.clone()) {
                places.extend(ring.resampled(step));
            }
        }
    }
    // Round one wall nothing but excursions is led, which stay near what they visit.
    if view.walls.len() == 1 && !demands.is_empty() {
        let near = (NEAR * s.width).powi(2);
        places.retain(|place| demands.iter().any(|demand| demand.distance_squared(*place) <= near));
    }
    if view.region.outer.is_none() {
        places.extend(frame(&places, view, demands));
    }
    places.into_iter().map(|p| on_grid(p, s.grid)).collect()
}

/// A frame round everything, so that a path leads round any body.
fn frame(places: &[DVec2], view: &RegionView<'_>, demands: &[DVec2]) -> Vec<DVec2> {
    let margin = 2.0 * view.settings.width;
    let walls = view.walls.iter().flat_map(|&w| view.curves[w].points());
    let all = walls.chain(demands).chain(places);
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for &p in all {
        (low, high) = (low.min(p), high.max(p));
    }
    let (low, high) = (low - margin, high + margin);
    let count = ((high - low).max_element() / (4.0 * margin)).ceil().clamp(2.0, 64.0) as usize;
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    (0..4 * count)
        .map(|k| corners[k / count].lerp(corners[(k / count + 1) % 4], (k % count) as f64 / count as f64))
        .collect()
}

/// Cuts a wall at its attachments and adds the pieces as edges.
fn add_wall(graph: &mut Multigraph, curve: &ClosedCurve, cuts: &mut Vec<(Cut, u32)>) {
    cuts.sort_by(|a, b| a.0.arc.total_cmp(&b.0.arc).then(a.1.cmp(&b.1)));
    // Attachments that share a vertex of the wall are one.
    cuts.dedup_by(|next, kept| next.0.at == kept.0.at);
    let n = cuts.len();
    let length = curve.length();
    for k in 0..n {
        let (from, to) = (cuts[k], cuts[(k + 1) % n]);
        let span = if n == 1 { length } else { (to.0.arc - from.0.arc).rem_euclid(length) };
        let mut via: Vec<(f64, DVec2)> = (0..curve.segment_count())
            .map(|v| ((curve.arc_of(v) - from.0.arc).rem_euclid(length), curve.points()[v]))
            .filter(|&(s, p)| s < span && p != from.0.at && p != to.0.at)
            .collect();
        via.sort_by(|a, b| a.0.total_cmp(&b.0));
        graph.wall(from.1, to.1, via.into_iter().map(|(_, p)| p).collect());
    }
}

/// The smallest cycle through demands that all lie in one place: a ring within their slack.
pub(crate) fn dot(demands: &[Demand], s: &RouteSettings) -> Cycle {
    let radius = (0.5 * s.slack).max(4.0 * s.grid);
    let centre = demands.first().map_or(DVec2::ZERO, |d| d.position);
    let corners =
        (0..6).map(|k| centre + radius * DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_3));
    let mut cycle = Cycle::of_wall(&corners.map(|p| on_grid(p, s.grid)).collect::<Vec<_>>());
    cycle.legs.fill(Leg::Support);
    cycle.carriers = (0..demands.len()).map(|d| (0, d)).collect();
    cycle
}
