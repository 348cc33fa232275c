//! Invariants of path graphs on random regions and random graphs.

use std::collections::HashMap;

use argil_graph::{FreeSpace, GraphError, Nodes, PathFinder, PathGraph};
use glam::{DVec2, dvec2};
use petgraph::graph::{DiGraph, NodeIndex};
use proptest::prelude::*;

fn grid(p: DVec2) -> DVec2 {
    (p * 1e4).round() / 1e4
}

fn side(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c))
}

fn crosses((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Whether `p` lies on the closed segment.
fn is_on(p: DVec2, (a, b): (DVec2, DVec2)) -> bool {
    side(a, b, p) == 0.0 && p.cmpge(a.min(b)).all() && p.cmple(a.max(b)).all()
}

fn boxes_apart((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    a.min(b).cmpgt(c.max(d)).any() || c.min(d).cmpgt(a.max(b)).any()
}

fn segments(curve: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    (0..curve.len()).map(|k| (curve[k], curve[(k + 1) % curve.len()]))
}

fn contains(curve: &[DVec2], p: DVec2) -> bool {
    let mut inside = false;
    for (a, b) in segments(curve) {
        if (a.y > p.y) != (b.y > p.y) && (side(a, b, p) > 0.0) == (b.y > a.y) {
            inside = !inside;
        }
    }
    inside
}

fn distance_to_walls(p: DVec2, walls: &[(DVec2, DVec2)]) -> f64 {
    let to = |&(a, b): &(DVec2, DVec2)| {
        let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a + t * (b - a))
    };
    walls.iter().map(to).fold(f64::INFINITY, f64::min)
}

#[derive(Clone, Debug)]
struct Region {
    outer: Option<Vec<DVec2>>,
    holes: Vec<Vec<DVec2>>,
    attachments: Vec<DVec2>,
    terminals: Vec<DVec2>,
    steiner: Vec<DVec2>,
    spacing: f64,
}

impl Region {
    fn loops(&self) -> impl Iterator<Item = &Vec<DVec2>> + '_ {
        self.outer.iter().chain(&self.holes)
    }

    fn walls(&self) -> Vec<(DVec2, DVec2)> {
        self.loops().flat_map(|curve| segments(curve)).collect()
    }

    fn is_free(&self, p: DVec2) -> bool {
        self.outer.iter().all(|outer| contains(outer, p))
            && !self.holes.iter().any(|hole| contains(hole, p))
            && !self.walls().into_iter().any(|wall| is_on(p, wall))
    }

    fn build(&self, weight: impl Fn(DVec2, DVec2) -> f64 + Sync) -> Result<PathGraph, GraphError> {
        PathGraph::build(
            &FreeSpace {
                outer: self.outer.as_deref(),
                holes: self.holes.iter().map(|hole| hole.as_slice()).collect(),
            },
            &Nodes {
                attachments: &self.attachments,
                terminals: &self.terminals,
                steiner: &self.steiner,
                spacing: self.spacing,
            },
            weight,
        )
    }

    fn wanted(&self, graph: &PathGraph) -> Vec<u32> {
        let attachments = (0..self.attachments.len()).map(|k| graph.attachment(k));
        attachments.chain((0..self.terminals.len()).map(|k| graph.terminal(k))).collect()
    }
}

/// Whether two closed loops neither meet nor contain each other.
fn are_apart(a: &[DVec2], b: &[DVec2]) -> bool {
    !contains(a, b[0]) && !contains(b, a[0]) && do_not_meet(a, b)
}

fn do_not_meet(a: &[DVec2], b: &[DVec2]) -> bool {
    segments(a).all(|s| {
        segments(b)
            .all(|t| !crosses(s, t) && !is_on(s.0, t) && !is_on(s.1, t) && !is_on(t.0, s) && !is_on(t.1, s))
    })
}

/// A polygon whose vertices go once round `centre` at the given distances.
fn star(centre: DVec2, turn: f64, radii: &[f64]) -> Vec<DVec2> {
    let angle = |k: usize| turn + std::f64::consts::TAU * k as f64 / radii.len() as f64;
    radii.iter().enumerate().map(|(k, &r)| grid(centre + r * DVec2::from_angle(angle(k)))).collect()
}

/// A row of rectangles with narrow gaps between them.
fn bricks(corner: DVec2, turn: f64, sizes: &[(f64, f64)], gap: f64) -> Vec<Vec<DVec2>> {
    let along = DVec2::from_angle(turn);
    let mut at = 0.0;
    let mut row = Vec::new();
    for &(length, height) in sizes {
        let (a, b) = (corner + at * along, corner + (at + length) * along);
        row.push([a, b, b + height * along.perp(), a + height * along.perp()].map(grid).to_vec());
        at += length + gap;
    }
    row
}

fn regions() -> impl Strategy<Value = Region> {
    let outer = prop::option::weighted(0.8, prop::collection::vec(20.0..40.0, 5..24));
    let stars = prop::collection::vec(
        ((-30.0..30.0, -30.0..30.0), 0.0..6.3, prop::collection::vec(1.0..8.0, 3..12), any::<bool>()),
        0..6,
    );
    let gaps = prop_oneof![Just(0.01), Just(0.001), 0.01..2.0];
    let row = ((-15.0..5.0, -15.0..5.0), 0.0..1.6, prop::collection::vec((1.0..6.0, 1.0..6.0), 0..5), gaps);
    let points = |count| prop::collection::vec((-40.0..40.0, -40.0..40.0), count);
    let picks = prop::collection::vec(any::<prop::sample::Index>(), 0..8);
    let spacings = prop_oneof![Just(0.0), 0.5..6.0];
    (outer, stars, row, points(1..12), points(0..60), picks, spacings).prop_map(
        |(outer, stars, row, terminals, steiner, picks, spacing)| {
            let outer = outer.map(|radii| star(DVec2::ZERO, 0.1, &radii));
            let mut holes: Vec<Vec<DVec2>> = Vec::new();
            let ((x, y), turn, sizes, gap) = row;
            let rows = bricks(dvec2(x, y), turn, &sizes, gap);
            let stars = stars.into_iter().map(|((x, y), turn, radii, clockwise)| {
                let mut star = star(dvec2(x, y), turn, &radii);
                if clockwise {
                    star.reverse();
                }
                star
            });
            for hole in rows.into_iter().chain(stars) {
                let is_inside = outer.iter().all(|o| contains(o, hole[0]) && do_not_meet(o, &hole));
                if is_inside && holes.iter().all(|other| are_apart(other, &hole)) {
                    holes.push(hole);
                }
            }
            let mut region =
                Region { outer, holes, attachments: vec![], terminals: vec![], steiner: vec![], spacing };
            let corners: Vec<DVec2> = region.loops().flatten().copied().collect();
            if !corners.is_empty() {
                region.attachments = picks.iter().map(|pick| corners[pick.index(corners.len())]).collect();
            }
            // A point in every gap between neighbouring bricks, as well.
            let gaps: Vec<DVec2> = region
                .holes
                .windows(2)
                .filter(|pair| pair[0].len() == 4 && pair[1].len() == 4)
                .map(|pair| 0.25 * (pair[0][1] + pair[0][2] + pair[1][0] + pair[1][3]))
                .collect();
            let points = terminals.into_iter().map(|(x, y)| dvec2(x, y));
            region.terminals = points.chain(gaps).filter(|&p| region.is_free(p)).collect();
            region.terminals.extend(region.terminals.first().copied());
            region.steiner = steiner.into_iter().map(|(x, y)| dvec2(x, y)).collect();
            region
        },
    )
}

/// Distances by petgraph from one vertex, without a way through attachments.
fn oracle(graph: &PathGraph, from: u32) -> HashMap<NodeIndex, f64> {
    let mut directed = DiGraph::<(), f64>::new();
    for _ in 0..graph.vertex_count() {
        directed.add_node(());
    }
    for (a, b, weight) in graph.edges() {
        for (start, end) in [(a, b), (b, a)] {
            if start == from || !graph.is_attachment(start) {
                directed.add_edge(start.into(), end.into(), weight);
            }
        }
    }
    petgraph::algo::dijkstra(&directed, from.into(), None, |edge| *edge.weight()).into_iter().collect()
}

fn weight_of(graph: &PathGraph, a: u32, b: u32) -> Option<f64> {
    graph.neighbours(a).find(|&(u, _)| u == b).map(|(_, weight)| weight)
}

fn check_path(graph: &PathGraph, from: u32, to: u32, path: &[u32], length: f64) -> Result<(), TestCaseError> {
    prop_assert_eq!((path.first(), path.last()), (Some(&from), Some(&to)));
    let mut sorted = path.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    prop_assert_eq!(sorted.len(), path.len(), "a vertex is visited twice");
    prop_assert!(path.iter().all(|&v| v == from || v == to || !graph.is_attachment(v)));
    let mut sum = 0.0;
    for step in path.windows(2) {
        let weight = weight_of(graph, step[0], step[1]);
        prop_assert!(weight.is_some(), "{:?} is no edge", step);
        sum += weight.unwrap_or(0.0);
    }
    prop_assert!((sum - length).abs() <= 1e-9 * length, "the path is {} long, not {}", sum, length);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_graph_is_plane_and_clear_of_walls(region in regions()) {
        let graph = region.build(|a, b| a.distance(b))?;
        let place = |v: u32| graph.position(v);
        let edges: Vec<(u32, u32)> = graph.edges().map(|(a, b, _)| (a, b)).collect();
        for (k, &(a, b)) in edges.iter().enumerate() {
            let edge = (place(a), place(b));
            prop_assert!(edge.0 != edge.1);
            for &(c, d) in &edges[k + 1..] {
                let other = (place(c), place(d));
                if boxes_apart(edge, other) {
                    continue;
                }
                prop_assert!(!crosses(edge, other), "{:?} crosses {:?}", edge, other);
                for v in [c, d].into_iter().filter(|&v| v != a && v != b) {
                    prop_assert!(!is_on(place(v), edge), "{:?} runs through {}", edge, place(v));
                }
                for v in [a, b].into_iter().filter(|&v| v != c && v != d) {
                    prop_assert!(!is_on(place(v), other), "{:?} runs through {}", other, place(v));
                }
            }
            for wall in region.walls() {
                if boxes_apart(edge, wall) {
                    continue;
                }
                prop_assert!(!crosses(edge, wall), "{:?} crosses the wall {:?}", edge, wall);
                for v in [a, b] {
                    prop_assert!(graph.is_attachment(v) || !is_on(place(v), wall));
                }
                for corner in [wall.0, wall.1] {
                    prop_assert!(corner == edge.0 || corner == edge.1 || !is_on(corner, edge));
                }
            }
            prop_assert!(!(graph.is_attachment(a) && graph.is_attachment(b)));
            prop_assert!(region.is_free(0.5 * (edge.0 + edge.1)));
        }
    }

    #[test]
    fn everything_that_is_connected_is_reachable(region in regions()) {
        let graph = region.build(|a, b| a.distance(b))?;
        for (k, &p) in region.terminals.iter().enumerate() {
            prop_assert_eq!(graph.position(graph.terminal(k)), p);
        }
        for (k, &p) in region.attachments.iter().enumerate() {
            prop_assert_eq!(graph.position(graph.attachment(k)), p);
            prop_assert!(graph.is_attachment(graph.attachment(k)));
        }
        let all: Vec<u32> = (0..graph.vertex_count() as u32).collect();
        let distances = graph.distances(&all);
        for i in 0..all.len() {
            prop_assert_eq!(distances.get(i, i), 0.0);
            for j in 0..i {
                prop_assert!(distances.get(i, j).is_finite(), "{} is cut off from {}", i, j);
                prop_assert_eq!(distances.get(i, j), distances.get(j, i));
                let straight = graph.position(all[i]).distance(graph.position(all[j]));
                prop_assert!(distances.get(i, j) >= straight * (1.0 - 1e-12));
            }
        }
    }

    #[test]
    fn nearby_vertices_are_the_nearest_and_look_back(region in regions(), count in 0..6_usize) {
        let graph = region.build(|a, b| a.distance(b))?;
        let mut wanted = region.wanted(&graph);
        wanted.sort_unstable();
        wanted.dedup();
        graph.arrange(&mut wanted);
        let distances = graph.distances(&wanted);
        let lists = graph.nearby(&wanted, count);
        prop_assert_eq!(lists.len(), wanted.len());
        for (k, list) in lists.iter().enumerate() {
            let mut sorted: Vec<f64> =
                (0..wanted.len()).filter(|&j| j != k).map(|j| distances.get(k, j)).collect();
            sorted.sort_by(f64::total_cmp);
            let nearest = count.min(sorted.len());
            for (&other, &length) in list.iter().zip(&sorted).take(nearest) {
                let found = distances.get(k, other as usize);
                prop_assert!((found - length).abs() <= 1e-9 * length, "{} and not {}", found, length);
            }
            prop_assert!(list.len() >= nearest && list.iter().all(|&other| other as usize != k));
            // What is beyond the nearest is there for its cell, and cells touch both ways.
            for &other in &list[nearest..] {
                prop_assert!(lists[other as usize].contains(&(k as u32)));
            }
        }
    }

    #[test]
    fn distances_and_paths_are_those_of_dijkstra(region in regions()) {
        let graph = region.build(|a, b| a.distance(b) * (1.0 + (a.x * b.x).abs().sqrt()))?;
        let wanted = region.wanted(&graph);
        let distances = graph.distances(&wanted);
        let mut finder = PathFinder::new(&graph);
        for (i, &from) in wanted.iter().enumerate() {
            let oracle = oracle(&graph, from);
            for (j, &to) in wanted.iter().enumerate() {
                let length = distances.get(i, j);
                let expected = oracle[&NodeIndex::from(to)];
                prop_assert!((length - expected).abs() <= 1e-9 * expected, "{} and not {}", length, expected);
                let path = finder.path(from, to).ok_or(TestCaseError::fail("no path"))?;
                check_path(&graph, from, to, &path, length)?;
                prop_assert_eq!(Some(path), graph.path(from, to));
            }
        }
    }

    #[test]
    fn kept_steiner_points_have_room(region in regions()) {
        let graph = region.build(|a, b| a.distance(b))?;
        let walls = region.walls();
        let is_kept = |p: &DVec2| graph.positions().contains(p) && !region.terminals.contains(p);
        let kept: Vec<DVec2> = region.steiner.iter().copied().filter(is_kept).collect();
        let others: Vec<DVec2> = region.terminals.iter().chain(&region.attachments).copied().collect();
        let has_room = |p: DVec2, kept: &[DVec2]| {
            distance_to_walls(p, &walls) >= 0.5 * region.spacing * (1.0 - 1e-12)
                && kept.iter().chain(&others).all(|&q| p == q || p.distance(q) >= region.spacing)
        };
        for &p in &region.steiner {
            if kept.contains(&p) {
                prop_assert!(region.is_free(p) && has_room(p, &kept));
            } else {
                prop_assert!(!region.is_free(p) || !has_room(p, &kept), "{} is dropped for no reason", p);
            }
        }
    }

    #[test]
    fn building_twice_gives_the_same_graph(region in regions()) {
        let edges = |graph: &PathGraph| graph.edges().collect::<Vec<_>>();
        let (a, b) = (region.build(|a, b| a.distance(b))?, region.build(|a, b| a.distance(b))?);
        prop_assert_eq!(a.positions(), b.positions());
        prop_assert_eq!(edges(&a), edges(&b));
        let wanted = region.wanted(&a);
        prop_assert_eq!(a.distances(&wanted), b.distances(&wanted));
    }
}

fn networks() -> impl Strategy<Value = (usize, Vec<u32>, Vec<(u32, u32, f64)>)> {
    (2_usize..40).prop_flat_map(|count| {
        let vertex = 0..count as u32;
        let edge = (vertex.clone(), vertex.clone(), 0_u32..20);
        let edges = prop::collection::vec(edge, 0..4 * count).prop_map(|edges| {
            let edges = edges.into_iter().filter(|&(a, b, _)| a != b);
            edges.map(|(a, b, weight)| (a, b, f64::from(weight))).collect()
        });
        (Just(count), prop::collection::vec(vertex, 0..5), edges)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    /// More vertices than are eliminated as rows of bits, and hardly fewer: a square net with a few chords, attachments at its corners.
    #[test]
    fn distances_in_a_large_net_are_those_of_dijkstra(
        side in 28_u32..48,
        weights in prop::collection::vec(0_u32..1000, 97),
        chords in prop::collection::vec((0_u32..2500, 0_u32..2500), 0..6),
    ) {
        let count = side * side;
        let weight = |k: u32| f64::from(weights[k as usize % weights.len()]);
        let across = (0..count).filter(|v| (v + 1) % side > 0).map(|v| (v, v + 1, weight(2 * v)));
        let along = (0..count - side).map(|v| (v, v + side, weight(2 * v + 1)));
        let chords = chords.iter().map(|&(a, b)| (a % count, b % count, 1.0)).filter(|(a, b, _)| a != b);
        let edges: Vec<(u32, u32, f64)> = across.chain(along).chain(chords).collect();
        let attachments = [0, side - 1, count - 1];
        let graph = PathGraph::from_edges(vec![DVec2::ZERO; count as usize], &attachments, &[], &edges)?;
        let among: Vec<u32> = (0..count).step_by(41).chain(attachments).collect();
        let distances = graph.distances(&among);
        let mut finder = PathFinder::new(&graph);
        for (i, &from) in among.iter().enumerate().step_by(9) {
            let oracle = oracle(&graph, from);
            for (j, &to) in among.iter().enumerate() {
                let expected = oracle.get(&NodeIndex::from(to)).copied().unwrap_or(f64::INFINITY);
                prop_assert_eq!(distances.get(i, j), expected);
                if let Some(path) = finder.path(from, to) {
                    check_path(&graph, from, to, &path, expected)?;
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    /// Neither plane nor connected, with edges between attachments and edges of no weight.
    #[test]
    fn whole_number_distances_are_exact_on_any_graph((count, attachments, edges) in networks()) {
        let graph = PathGraph::from_edges(vec![DVec2::ZERO; count], &attachments, &[], &edges)?;
        // Some vertices twice, in an order of its own.
        let among: Vec<u32> = (0..count as u32).rev().chain(0..count as u32 / 2).collect();
        let distances = graph.distances(&among);
        let mut finder = PathFinder::new(&graph);
        for (i, &from) in among.iter().enumerate() {
            let oracle = oracle(&graph, from);
            for (j, &to) in among.iter().enumerate() {
                let expected = oracle.get(&NodeIndex::from(to)).copied().unwrap_or(f64::INFINITY);
                prop_assert_eq!(distances.get(i, j), expected);
                match finder.path(from, to) {
                    Some(path) => check_path(&graph, from, to, &path, expected)?,
                    None => prop_assert_eq!(expected, f64::INFINITY),
                }
            }
        }
    }

    /// Weights that vanish beside others, or whose sums are rounded one way here and another way there, make
    /// detours that cost nothing.
    #[test]
    fn a_path_visits_no_vertex_twice_however_sums_are_rounded((count, attachments, edges) in networks()) {
        let tenths = |weight: f64| if weight < 10.0 { weight * 1e-17 } else { weight / 10.0 };
        let edges: Vec<(u32, u32, f64)> = edges.iter().map(|&(a, b, w)| (a, b, tenths(w))).collect();
        let graph = PathGraph::from_edges(vec![DVec2::ZERO; count], &attachments, &[], &edges)?;
        let among: Vec<u32> = (0..count as u32).collect();
        let distances = graph.distances(&among);
        let mut finder = PathFinder::new(&graph);
        for &from in &among {
            for &to in &among {
                let length = distances.get(from as usize, to as usize);
                if let Some(path) = finder.path(from, to) {
                    check_path(&graph, from, to, &path, length)?;
                }
            }
        }
    }

    /// Loops on a coarse grid cross, touch and repeat themselves all the time.
    #[test]
    fn unsound_input_is_an_error_and_no_panic(
        loops in prop::collection::vec(prop::collection::vec((0_u8..7, 0_u8..7), 0..7), 0..4),
        points in prop::collection::vec((0_u8..13, 0_u8..13), 0..12),
        has_outer in any::<bool>(),
        odd in prop::option::weighted(0.1, prop_oneof![
            Just(f64::NAN), Just(f64::INFINITY), Just(1e300), Just(1e9), Just(1e-300), Just(-0.0)
        ]),
    ) {
        let mut loops: Vec<Vec<DVec2>> = loops
            .iter()
            .map(|curve| curve.iter().map(|&(x, y)| dvec2(x.into(), y.into())).collect())
            .collect();
        let mut points: Vec<DVec2> =
            points.iter().map(|&(x, y)| dvec2(f64::from(x) / 2.0, f64::from(y) / 2.0)).collect();
        if let (Some(odd), Some(p)) = (odd, loops.iter_mut().flatten().chain(&mut points).last()) {
            p.x = odd;
        }
        let (terminals, steiner) = points.split_at(points.len() / 3);
        let holes: Vec<&[DVec2]> = loops.iter().skip(has_outer.into()).map(|curve| curve.as_slice()).collect();
        let outer = loops.first().filter(|_| has_outer).map(|curve| curve.as_slice());
        let attachments: Vec<DVec2> = loops.iter().flatten().copied().step_by(3).collect();
        let nodes = Nodes { attachments: &attachments, terminals, steiner, spacing: 0.3 };
        if let Ok(graph) = PathGraph::build(&FreeSpace { outer, holes }, &nodes, |a, b| a.distance(b)) {
            let all: Vec<u32> = (0..graph.vertex_count() as u32 + 1).collect();
            prop_assert_eq!(graph.distances(&all).len(), all.len());
        }
    }
}
