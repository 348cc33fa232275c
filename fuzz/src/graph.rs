use argil_curve::DVec2;
use argil_graph::{FreeSpace, GraphError, Nodes, PathGraph};

use crate::Draw;

/// Builds the graph of a region and compares its distances and paths with a plain search; any loops give a graph or a
/// reason.
pub fn graph(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let tidy = draw.byte() > 63;
    let framed = draw.flag();
    let frame = [(-30.0, -30.0), (30.0, -30.0), (30.0, 30.0), (-30.0, 30.0)].map(DVec2::from);
    let count = draw.below(7);
    let holes: Vec<Vec<DVec2>> = (0..count).map(|cell| hole(&mut draw, tidy.then_some(cell))).collect();
    let mut corners = holes.iter().flatten().copied().chain(frame.into_iter().filter(|_| framed));
    let attachments: Vec<DVec2> = corners.by_ref().filter(|_| draw.byte() > 199).take(12).collect();
    let spacing = [0.0, 0.5, 2.0, 6.0][draw.below(4)];
    let (mut terminals, mut steiner) = (Vec::new(), Vec::new());
    while terminals.len() + steiner.len() < 60 && !draw.is_empty() {
        let list = if draw.byte() > 127 { &mut terminals } else { &mut steiner };
        list.push(if tidy { draw.point(29.0) } else { draw.lattice_point(31) });
    }
    let space =
        FreeSpace { outer: framed.then_some(&frame[..]), holes: holes.iter().map(Vec::as_slice).collect() };
    let nodes = Nodes { attachments: &attachments, terminals: &terminals, steiner: &steiner, spacing };
    match PathGraph::build(&space, &nodes, |a, b| a.distance(b)) {
        Ok(graph) => distances_are_shortest(&graph, attachments.len(), terminals.len()),
        Err(GraphError::Triangulation { points }) => panic!("{points} points were not triangulated"),
        Err(_) => {}
    }
}

/// A star-shaped loop: in a cell of its own, or anywhere, of any shape.
fn hole(draw: &mut Draw<'_>, cell: Option<usize>) -> Vec<DVec2> {
    let corners = 3 + draw.below(8);
    let Some(cell) = cell else { return (0..corners).map(|_| draw.lattice_point(31)).collect() };
    let centre = DVec2::new(18.0 * (cell % 3) as f64 - 18.0, 18.0 * (cell / 3) as f64 - 18.0);
    let corner = |k: usize| DVec2::from_angle(std::f64::consts::TAU * k as f64 / corners as f64);
    (0..corners).map(|k| ((centre + draw.within(0.5, 8.9) * corner(k)) * 1e4).round() / 1e4).collect()
}

fn distances_are_shortest(graph: &PathGraph, attachments: usize, terminals: usize) {
    let among: Vec<u32> = (0..attachments)
        .map(|k| graph.attachment(k))
        .chain((0..terminals).map(|k| graph.terminal(k)))
        .take(24)
        .collect();
    let distances = graph.distances(&among);
    assert_eq!(distances.len(), among.len());
    for (i, &from) in among.iter().enumerate() {
        let reached = search(graph, from);
        for (j, &to) in among.iter().enumerate() {
            let (found, wanted) = (distances.get(i, j), reached[to as usize]);
            let agree = found == wanted || (found - wanted).abs() <= 1e-9 * (1.0 + wanted);
            assert!(agree, "from {from} to {to}: {found}, not {wanted}");
        }
    }
    for pair in among.windows(2).take(8) {
        let wanted = search(graph, pair[0])[pair[1] as usize];
        let Some(path) = graph.path(pair[0], pair[1]) else {
            assert!(wanted.is_infinite(), "no path from {} to {}", pair[0], pair[1]);
            continue;
        };
        assert_eq!((path.first(), path.last()), (Some(&pair[0]), Some(&pair[1])));
        let inner = path.get(1..path.len().saturating_sub(1)).unwrap_or_default();
        assert!(inner.iter().all(|&v| !graph.is_attachment(v)), "{path:?} passes an attachment");
        let step =
            |a: u32, b: u32| graph.neighbours(a).find(|&(v, _)| v == b).expect("a path goes along edges").1;
        let length: f64 = path.windows(2).map(|step_of| step(step_of[0], step_of[1])).sum();
        assert!((length - wanted).abs() <= 1e-9 * (1.0 + wanted), "{path:?} is {length}, not {wanted}");
    }
}

/// Dijkstra's search in its plainest form; attachments are ends, never passed.
fn search(graph: &PathGraph, from: u32) -> Vec<f64> {
    let mut distance = vec![f64::INFINITY; graph.vertex_count()];
    let mut open = vec![true; graph.vertex_count()];
    distance[from as usize] = 0.0;
    loop {
        let nearest = (0..open.len()).filter(|&v| open[v] && distance[v].is_finite());
        let Some(v) = nearest.min_by(|&a, &b| distance[a].total_cmp(&distance[b])) else { return distance };
        open[v] = false;
        if v as u32 != from && graph.is_attachment(v as u32) {
            continue;
        }
        for (next, weight) in graph.neighbours(v as u32) {
            distance[next as usize] = distance[next as usize].min(distance[v] + weight);
        }
    }
}
