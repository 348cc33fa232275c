//! Distances on demand against the matrix.

use argil_graph::{Distances, FreeSpace, Nodes, PathGraph};
use glam::{DVec2, dvec2};
use proptest::prelude::*;

fn networks() -> impl Strategy<Value = (usize, Vec<u32>, Vec<(u32, u32, u32)>)> {
    (2_usize..60).prop_flat_map(|count| {
        let vertex = 0..count as u32;
        let edges = prop::collection::vec((vertex.clone(), vertex.clone(), 0_u32..1000), 0..3 * count);
        let edges = edges.prop_map(|edges| edges.into_iter().filter(|edge| edge.0 != edge.1).collect());
        (Just(count), prop::collection::vec(vertex, 0..8), edges)
    })
}

/// A room with pillars on a grid of its own, and what is asked about: all corners of the pillars and all points.
fn rooms() -> impl Strategy<Value = (Vec<DVec2>, Vec<DVec2>)> {
    let pillar = (0_u8..8, 0_u8..8);
    let point = (0.0..80.0, 0.0..80.0);
    (prop::collection::vec(pillar, 0..20), prop::collection::vec(point, 1..120)).prop_map(
        |(mut cells, points)| {
            cells.sort_unstable();
            cells.dedup();
            let corners: Vec<DVec2> =
                cells.iter().map(|&(x, y)| 10.0 * dvec2(x.into(), y.into()) + DVec2::splat(2.5)).collect();
            let clear = |p: &DVec2| corners.iter().all(|&c| (*p - c - 2.5).abs().max_element() > 2.6);
            let points = points.into_iter().map(DVec2::from).filter(clear).collect();
            (corners, points)
        },
    )
}

fn room_graph(corners: &[DVec2], points: &[DVec2]) -> (PathGraph, Vec<u32>) {
    let outer = [(-1.0, -1.0), (81.0, -1.0), (81.0, 81.0), (-1.0, 81.0)].map(DVec2::from);
    let squares: Vec<[DVec2; 4]> = corners
        .iter()
        .map(|&c| [c, c + dvec2(0.0, 5.0), c + DVec2::splat(5.0), c + dvec2(5.0, 0.0)])
        .collect();
    let attachments: Vec<DVec2> = squares.iter().flatten().copied().collect();
    let nodes = Nodes { attachments: &attachments, terminals: points, ..Nodes::default() };
    let holes = squares.iter().map(|square| &square[..]).collect();
    let space = FreeSpace { outer: Some(&outer), holes };
    let graph = PathGraph::build(&space, &nodes, |a, b| a.distance(b)).expect("pillars stand apart");
    let terminals = (0..points.len()).map(|k| graph.terminal(k));
    let among = terminals.chain((0..attachments.len()).map(|k| graph.attachment(k))).collect();
    (graph, among)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    /// Neither plane nor connected, with attachments, edges between them, vertices twice and one that does not exist.
    #[test]
    fn whole_numbers_are_the_same_to_the_bit((count, attachments, edges) in networks()) {
        let edges: Vec<_> = edges.into_iter().map(|(a, b, weight)| (a, b, f64::from(weight))).collect();
        let graph = PathGraph::from_edges(vec![DVec2::ZERO; count], &attachments, &[], &edges)?;
        let among: Vec<u32> = (0..=count as u32).rev().chain(0..count as u32 / 2).collect();
        let (matrix, labels) = (graph.distances(&among), graph.distances_on_demand(&among));
        prop_assert_eq!(labels.len(), among.len());
        for i in 0..=among.len() {
            for j in 0..=among.len() {
                prop_assert_eq!(matrix.get(i, j).to_bits(), labels.get(i, j).to_bits(), "{} to {}", i, j);
            }
        }
    }

    #[test]
    fn lengths_are_the_same_but_for_rounding((corners, points) in rooms()) {
        let (graph, mut among) = room_graph(&corners, &points);
        for arranged in [false, true] {
            if arranged {
                graph.arrange(&mut among);
            }
            let (matrix, labels) = (graph.distances(&among), graph.distances_on_demand(&among));
            for i in 0..among.len() {
                prop_assert_eq!(labels.get(i, i), 0.0);
                for j in 0..i {
                    let (length, expected) = (labels.get(i, j), matrix.get(i, j));
                    prop_assert!((length - expected).abs() <= 1e-13 * expected, "{} and not {}", length, expected);
                    prop_assert_eq!(length.to_bits(), labels.get(j, i).to_bits());
                }
            }
        }
    }

    #[test]
    fn the_limit_decides((corners, points) in rooms(), limit in 0_usize..200_000) {
        let (graph, among) = room_graph(&corners, &points);
        let distances = graph.distances_within(&among, limit);
        prop_assert_eq!(matches!(distances, Distances::Matrix(_)), 8 * among.len() * among.len() <= limit);
        prop_assert_eq!((distances.len(), distances.is_empty()), (among.len(), among.is_empty()));
    }
}
