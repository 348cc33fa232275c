//! Graph and tour alone: a drone that has to see eight masts between buildings, and no clay at all.

use std::error::Error;

use argil::curve::{DVec2, Segment};
use argil::graph::{FreeSpace, Nodes, PathGraph};
use argil::tour::{MatrixMetric, TourOptions, shortest_tour};

fn block(x: f64, y: f64) -> Vec<DVec2> {
    [(0.0, 0.0), (30.0, 0.0), (30.0, 20.0), (0.0, 20.0)].map(|(u, v)| DVec2::new(x + u, y + v)).to_vec()
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let blocks: Vec<Vec<DVec2>> =
        (0..3).flat_map(|i| (0..2).map(move |j| block(50.0 * f64::from(i), 40.0 * f64::from(j)))).collect();
    let masts: Vec<DVec2> = [
        (-8.0, 10.0),
        (40.0, 3.0),
        (40.0, 50.0),
        (92.0, 30.0),
        (15.0, 30.0),
        (139.0, 55.0),
        (65.0, -9.0),
        (70.0, 68.0),
    ]
    .map(DVec2::from)
    .to_vec();
    // Where the way may bend: three metres off every corner.
    let bends: Vec<DVec2> = blocks
        .iter()
        .flat_map(|block| {
            let middle = (block[0] + block[2]) / 2.0;
            block.iter().map(move |corner| *corner + 3.0 * (*corner - middle).signum())
        })
        .collect();

    let space = FreeSpace { outer: None, holes: blocks.iter().map(Vec::as_slice).collect() };
    let nodes = Nodes { attachments: &[], terminals: &masts, steiner: &bends, spacing: 1.0 };
    let graph = PathGraph::build(&space, &nodes, |a, b| a.distance(b))?;
    let stops: Vec<u32> = (0..masts.len()).map(|k| graph.terminal(k)).collect();
    let distances = graph.distances(&stops);
    let rows: Vec<f64> = (0..stops.len()).flat_map(|k| distances.row(k).to_vec()).collect();
    let tour = shortest_tour(&MatrixMetric::new(stops.len(), &rows)?, &[], None, &TourOptions::default());

    let mut length = 0.0;
    for (k, &from) in tour.order.iter().enumerate() {
        let to = tour.order[(k + 1) % tour.order.len()];
        let path = graph.path(stops[from], stops[to]).ok_or("two masts with no way between them")?;
        for pair in path.windows(2) {
            let hop = Segment::new(graph.position(pair[0]), graph.position(pair[1]));
            let walls =
                blocks.iter().flat_map(|b| (0..4).map(|side| Segment::new(b[side], b[(side + 1) % 4])));
            assert!(walls.into_iter().all(|wall| !wall.crosses(&hop)), "the way leads through a building");
            length += hop.length();
        }
    }
    assert!((length - tour.length).abs() < 1e-9 * length, "the tour is as long as its way");
    let bird: f64 = (0..8).map(|k| masts[tour.order[k]].distance(masts[tour.order[(k + 1) % 8]])).sum();
    assert!(bird < length && length < 1.5 * bird, "{length} m round what a bird flies in {bird} m");
    Ok(())
}
