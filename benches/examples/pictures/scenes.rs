//! What is drawn: small instances on which each crate shows what it does.

use std::f64::consts::TAU;

use argil::curve::{ClosedCurve, DVec2, Segment, SegmentIndex, gaps};
use argil::elastic::{Carrier, ElasticOptions, Path, relax};
use argil::fill::{Bead, FillOptions};
use argil::graph::{FreeSpace, Nodes, PathGraph};
use argil::route::{Demand, LayerInput, Leg, RouteSettings, Router, Wall};
use argil::safeguard::{SafeguardSettings, safeguards};
use argil::support::{Criterion, Placement, place_supports};
use argil::tour::{MatrixMetric, TourOptions, shortest_tour};
use geo_types::{MultiPolygon, Rect, polygon};

use crate::Outcome;
use crate::drawing::{CONNECTION, DARK, Drawing, PALE, SUPPORT, WALL};

/// Bead width of all pictures, mm.
const W: f64 = 1.5;

fn square(low: (f64, f64), side: f64) -> Vec<DVec2> {
    let low = DVec2::from(low);
    [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|c| low + DVec2::from(c)).to_vec()
}

fn round(centre: (f64, f64), radius: impl Fn(f64) -> f64, corners: u32) -> Vec<DVec2> {
    let turn = |k: u32| f64::from(k) / f64::from(corners) * TAU;
    (0..corners).map(|k| DVec2::from(centre) + radius(turn(k)) * DVec2::from_angle(turn(k))).collect()
}

pub(crate) fn held_spans() -> Outcome<String> {
    let below = ClosedCurve::new(round((0.0, 0.0), |turn| 6.0 + 0.6 * (3.0 * turn).cos(), 180))?;
    let above = ClosedCurve::new(round((0.4, 0.0), |turn| 6.0 + 1.2 * (2.0 * turn).cos(), 180))?;
    let across = 0.45;
    let mut drawing = Drawing::new((-12.0, -8.0), (12.0, 8.0));
    drawing.band(below.points(), DARK, 2.0 * across);
    drawing.ring(below.points(), DARK, 0.12);
    let held = argil::curve::held_spans(&above, &SegmentIndex::of_curves([&below], W), across);
    held.iter().for_each(|span| drawing.stretch(&above, span, WALL, 0.35));
    gaps(above.length(), &held).iter().for_each(|span| drawing.stretch(&above, span, SUPPORT, 0.35));
    Ok(drawing.finished("Held spans of a curve in terracotta and its gaps in blue; the band is what holds"))
}

pub(crate) fn support_points() -> Outcome<String> {
    let mut drawing = Drawing::new((-18.0, -11.0), (18.0, 11.0));
    let ring = round((0.0, 0.0), |turn| 8.0 + 1.2 * (5.0 * turn).cos(), 180);
    let wall: Vec<DVec2> = ring[50..=130].to_vec();
    let pieces: Vec<Segment> = wall.windows(2).map(|ends| Segment::new(ends[0], ends[1])).collect();
    let (above, walls) = (ClosedCurve::new(ring)?, SegmentIndex::new(pieces, W));
    let placement = Placement::for_criterion(W, &Criterion::for_width(W));
    drawing.line(&wall, WALL, W);
    drawing.ring(above.points(), DARK, 0.15);
    for point in place_supports(&above, &walls, &placement) {
        drawing.disc(point.position, placement.slack, SUPPORT);
        drawing.dot(point.position, 0.2, SUPPORT);
    }
    Ok(drawing.finished(
        "A path above a wall that holds half of it, and the points that hold the rest, with their slack",
    ))
}

pub(crate) fn safeguard() -> String {
    let mut drawing = Drawing::new((-20.0, -11.0), (20.0, 11.0));
    let tile = |x: f64, y: f64| MultiPolygon(vec![Rect::new((-x, -y), (x, y)).to_polygon()]);
    let layers =
        [tile(14.0, 7.0), tile(4.0, 4.0), tile(4.0, 4.0), tile(4.0, 4.0), tile(4.0, 4.0), tile(4.0, 4.0)];
    for envelope in safeguards(&layers, &SafeguardSettings { dilation: W, shrink: 1.0 }) {
        drawing.region(&envelope, SUPPORT, 0.06);
    }
    for outline in layers.iter().take(2) {
        drawing.region(outline, WALL, 0.35);
    }
    drawing.finished(
        "The safeguard of six layers: a plate, and a tower on it; the envelope closes in on the tower",
    )
}

pub(crate) fn path_graph() -> Outcome<String> {
    let mut drawing = Drawing::new((-15.0, -9.0), (15.0, 9.0));
    let (left, right) = (square((-8.0, -4.0), 6.0), round((5.0, 1.5), |_| 4.5, 24));
    let outer = vec![(-14.0, -8.0), (14.0, -8.0), (14.0, 8.0), (-14.0, 8.0)]
        .into_iter()
        .map(DVec2::from)
        .collect::<Vec<_>>();
    // Room in the open, more than half a bead from every wall.
    let curves = [&outer, &left, &right].map(|points| ClosedCurve::new(points.clone()));
    let curves = curves.into_iter().collect::<Result<Vec<_>, _>>()?;
    let walls = SegmentIndex::of_curves(&curves, W);
    let steiner: Vec<DVec2> = (0..12 * 7)
        .map(|k| DVec2::new(-13.0 + 2.4 * f64::from(k % 12), -7.0 + 2.4 * f64::from(k / 12)))
        .filter(|&p| curves.iter().filter(|curve| curve.contains(p)).count() == 1 && walls.distance(p) > 0.9)
        .collect();
    let terminals = [DVec2::new(-12.0, 4.0), DVec2::new(12.0, -3.0)];
    let graph = PathGraph::build(
        &FreeSpace { outer: Some(&outer), holes: vec![&left, &right] },
        &Nodes { attachments: &[left[2]], terminals: &terminals, steiner: &steiner, spacing: 1.0 },
        |a, b| a.distance(b),
    )?;
    for (a, b, _) in graph.edges() {
        drawing.line(&[graph.position(a), graph.position(b)], PALE, 0.08);
    }
    for wall in [&outer, &left, &right] {
        drawing.ring(wall, WALL, 0.3);
    }
    let path = graph.path(graph.terminal(0), graph.terminal(1)).ok_or("the walls part the terminals")?;
    let path: Vec<DVec2> = path.into_iter().map(|vertex| graph.position(vertex)).collect();
    drawing.line(&path, SUPPORT, 0.3);
    terminals.iter().for_each(|&p| drawing.dot(p, 0.4, DARK));
    drawing.dot(left[2], 0.4, CONNECTION);
    Ok(drawing.finished(
        "The path graph between two walls inside a third, and the shortest path between two terminals in it",
    ))
}

pub(crate) fn tour() -> Outcome<String> {
    let mut drawing = Drawing::new((-15.0, -10.0), (15.0, 10.0));
    // Seeds of a sunflower, drawn out in breadth.
    let seed = |k: u32| {
        1.05 * f64::from(k).sqrt() * DVec2::from_angle(2.399_963 * f64::from(k)) * DVec2::new(1.5, 1.0)
    };
    let places: Vec<DVec2> = (1..=72).map(seed).collect();
    let lengths: Vec<f64> = places.iter().flat_map(|a| places.iter().map(|b| a.distance(*b))).collect();
    let metric = MatrixMetric::new(places.len(), &lengths)?;
    let tour =
        shortest_tour(&metric, &[], None, &TourOptions { kicks_per_node: 8.0, ..TourOptions::default() });
    let order: Vec<DVec2> = tour.order.iter().map(|&k| places[k]).collect();
    drawing.ring(&order, SUPPORT, 0.25);
    places.iter().for_each(|&p| drawing.dot(p, 0.3, DARK));
    Ok(drawing.finished("A short closed tour through 72 places"))
}

pub(crate) fn cycle() -> Outcome<String> {
    let mut drawing = Drawing::new((-3.0, -5.0), (37.0, 17.0));
    let (left, mut window) = (square((0.0, 0.0), 13.0), square((4.0, 4.0), 5.0));
    window.reverse();
    let right = round((28.0, 6.0), |_| 5.5, 40);
    let walls = [
        Wall { points: &left, parent: None },
        Wall { points: &window, parent: Some(0) },
        Wall { points: &right, parent: None },
    ];
    let places = [(16.0, 10.0), (19.0, 8.5), (18.0, 3.0), (17.5, 0.0), (34.9, 9.0), (35.1, 4.0), (6.5, 6.5)]
        .map(DVec2::from);
    let demands = places.map(|p| Demand { position: p, anchors: vec![p] });
    let layer = LayerInput { walls: &walls, demands: &demands, safeguard: &[], above: None, barred: &[] };
    let cycle = Router::new(RouteSettings::for_width(W))?.cycle(&layer)?;
    let colour = |leg: &Leg| match leg {
        Leg::Wall => WALL,
        Leg::Support => SUPPORT,
        Leg::Joint => CONNECTION,
    };
    let colours: Vec<&str> = cycle.legs.iter().map(colour).collect();
    drawing.coloured(&cycle.points, &colours, 0.4);
    places.iter().for_each(|&p| drawing.dot(p, 0.35, DARK));
    Ok(drawing.finished(
        "Three walls and seven demands in one closed cycle: walls terracotta, support blue, joints ochre",
    ))
}

pub(crate) fn relaxed() -> Outcome<String> {
    let mut drawing = Drawing::new((-7.0, -4.5), (17.0, 7.5));
    let wall: Vec<DVec2> = [(0.0, 0.0), (-5.0, 0.0), (-5.0, -3.0), (15.0, -3.0), (15.0, 0.0), (10.0, 0.0)]
        .map(DVec2::from)
        .to_vec();
    // A strand from one end of the wall to the other, with the corners of a graph.
    let corners: Vec<DVec2> = [
        (10.0, 0.0),
        (9.0, 2.5),
        (7.5, 2.0),
        (6.5, 5.0),
        (4.5, 4.5),
        (4.0, 2.0),
        (2.0, 3.5),
        (0.5, 2.5),
        (0.0, 0.0),
    ]
    .map(DVec2::from)
    .to_vec();
    let strand = corners.windows(2).flat_map(|ends| {
        let steps = (ends[0].distance(ends[1]) / 0.7).ceil();
        (0..steps as u32).map(move |k| ends[0].lerp(ends[1], f64::from(k) / steps))
    });
    let points: Vec<DVec2> = wall.iter().copied().chain(strand.skip(1)).collect();
    let fixed: Vec<bool> = (0..points.len()).map(|k| k < wall.len()).collect();
    let carried = |p: DVec2| points.iter().position(|q| *q == p).map(|vertex| Carrier { vertex, anchor: p });
    let carriers: Vec<Carrier> = [corners[3], corners[6]].into_iter().filter_map(carried).collect();
    let options = ElasticOptions::for_width(W);
    let path = Path { points: &points, fixed: &fixed, carriers: &carriers, clear_of: None, felt: &[] };
    let relaxed = relax(&path, &options)?;
    drawing.dashed(&points, DARK, 0.12);
    carriers.iter().for_each(|carrier| drawing.disc(carrier.anchor, options.envelope, SUPPORT));
    drawing.ring(&relaxed.points, SUPPORT, 0.3);
    drawing.line(&wall, WALL, 0.3);
    Ok(drawing.finished(
        "A path with the corners of a graph, dashed, and relaxed: two of its points stay within the discs",
    ))
}

pub(crate) fn fill() -> Outcome<String> {
    let mut drawing = Drawing::new((-1.0, -1.0), (31.0, 21.0));
    let plate = MultiPolygon(vec![polygon!(
        exterior: [(x: 0.0, y: 0.0), (x: 30.0, y: 0.0), (x: 30.0, y: 20.0), (x: 0.0, y: 20.0)],
        interiors: [[(x: 12.0, y: 6.0), (x: 12.0, y: 14.0), (x: 20.0, y: 14.0), (x: 20.0, y: 6.0)]],
    )]);
    let filled = argil::fill::fill(&plate, &[], &FillOptions { walls: 1, ..FillOptions::for_width(W) }, &[])?;
    drawing.region(&plate, PALE, 0.3);
    for curve in &filled.curves {
        let colour = |bead: &Bead| match bead {
            Bead::Wall(_) => WALL,
            Bead::Fill => CONNECTION,
            Bead::Joint => SUPPORT,
        };
        let colours: Vec<&str> = curve.beads.iter().map(colour).collect();
        drawing.coloured(&curve.points, &colours, 0.45);
    }
    Ok(drawing
        .finished("A plate with a window as one closed curve: walls terracotta, rings ochre, joints blue"))
}
