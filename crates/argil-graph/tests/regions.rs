//! Regions and mistakes that deserve a name.

use argil_graph::{FreeSpace, GraphError, Nodes, PathGraph, PointKind};
use glam::{DVec2, dvec2};

fn square(low: f64, high: f64) -> Vec<DVec2> {
    vec![dvec2(low, low), dvec2(high, low), dvec2(high, high), dvec2(low, high)]
}

fn build(outer: Option<&[DVec2]>, holes: &[&[DVec2]], nodes: &Nodes<'_>) -> Result<PathGraph, GraphError> {
    PathGraph::build(&FreeSpace { outer, holes: holes.to_vec() }, nodes, |a, b| a.distance(b))
}

#[test]
fn a_wall_that_splits_the_convex_hull_is_passed_round_its_ends() {
    let wall = [dvec2(-0.1, -9.0), dvec2(0.1, -9.0), dvec2(0.1, 9.0), dvec2(-0.1, 9.0)];
    let terminals = [dvec2(-1.0, 0.0), dvec2(1.0, 0.0)];
    let graph = build(None, &[&wall], &Nodes { terminals: &terminals, ..Nodes::default() }).unwrap();
    let length = graph.distances(&[graph.terminal(0), graph.terminal(1)]).get(0, 1);
    assert!(length > 18.0 && length.is_finite(), "{length}");
}

#[test]
fn terminals_in_the_open_need_no_walls() {
    let terminals = [dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(2.0, 0.0), dvec2(1.0, 0.0)];
    let graph = build(None, &[], &Nodes { terminals: &terminals, ..Nodes::default() }).unwrap();
    let wanted: Vec<u32> = (0..4).map(|k| graph.terminal(k)).collect();
    assert_eq!(wanted[1], wanted[3]);
    assert_eq!(graph.distances(&wanted).row(0), [0.0, 1.0, 2.0, 1.0]);
    assert_eq!(graph.path(wanted[0], wanted[2]), Some(vec![wanted[0], wanted[1], wanted[2]]));
}

#[test]
fn nothing_gives_an_empty_graph() {
    let graph = build(None, &[], &Nodes::default()).unwrap();
    assert_eq!((graph.vertex_count(), graph.edge_count()), (0, 0));
    assert!(graph.distances(&[]).is_empty());
    assert_eq!(graph.path(0, 0), None);
}

#[test]
fn an_attachment_between_two_walls_of_an_ear_has_a_way_out() {
    // The corner at the far left belongs to one triangle only, whose third side is a gap between walls.
    let outer = [dvec2(0.0, 0.0), dvec2(4.0, -1.0), dvec2(9.0, -4.0), dvec2(9.0, 4.0), dvec2(4.0, 1.0)];
    let nodes = Nodes { attachments: &outer[..1], terminals: &[dvec2(8.0, 0.0)], ..Nodes::default() };
    let graph = build(Some(&outer), &[], &nodes).unwrap();
    let path = graph.path(graph.attachment(0), graph.terminal(0)).unwrap();
    let places: Vec<DVec2> = path.iter().map(|&v| graph.position(v)).collect();
    assert_eq!(places, [dvec2(0.0, 0.0), dvec2(4.0, 0.0), dvec2(8.0, 0.0)]);
}

#[test]
fn a_hole_in_a_hole_is_still_no_free_space() {
    let (outer, hole, island) = (square(0.0, 30.0), square(5.0, 25.0), square(10.0, 20.0));
    let inside_island = Nodes { terminals: &[dvec2(15.0, 15.0)], ..Nodes::default() };
    let error = build(Some(&outer), &[&hole, &island], &inside_island).unwrap_err();
    assert_eq!(error, GraphError::TerminalOutside { index: 0, point: dvec2(15.0, 15.0) });
}

#[test]
fn a_path_does_not_pass_through_an_attachment() {
    // The attachment at the tip of the wedge is on the short way.
    let outer = square(0.0, 10.0);
    let wedge = [dvec2(5.0, 9.0), dvec2(4.0, 0.5), dvec2(6.0, 0.5)];
    let terminals = [dvec2(4.0, 9.2), dvec2(6.0, 9.2)];
    let attached = Nodes { attachments: &wedge[..1], terminals: &terminals, ..Nodes::default() };
    let graph = build(Some(&outer), &[&wedge], &attached).unwrap();
    let path = graph.path(graph.terminal(0), graph.terminal(1)).unwrap();
    assert!(!path.contains(&graph.attachment(0)));
    let tip = graph.path(graph.terminal(0), graph.attachment(0)).unwrap();
    assert_eq!(tip.last(), Some(&graph.attachment(0)));
}

#[test]
fn a_terminal_on_a_wall_or_outside_is_named() {
    let outer = square(0.0, 10.0);
    let at = |point: DVec2| {
        let terminals = [dvec2(1.0, 1.0), dvec2(1.0, 1.0), point];
        build(Some(&outer), &[], &Nodes { terminals: &terminals, ..Nodes::default() }).unwrap_err()
    };
    for point in [dvec2(10.0, 10.0), dvec2(10.0, 4.0), dvec2(0.3, 0.0)] {
        assert_eq!(at(point), GraphError::TerminalOnWall { index: 2, point });
    }
    for point in [dvec2(10.0 + 1e-9, 4.0), dvec2(-40.0, 4.0)] {
        assert_eq!(at(point), GraphError::TerminalOutside { index: 2, point });
    }
}

#[test]
fn walls_that_meet_are_named() {
    let outer = square(0.0, 10.0);
    let meeting = [
        vec![dvec2(5.0, 5.0), dvec2(12.0, 5.0), dvec2(12.0, 6.0)], // crosses the outer loop
        vec![dvec2(5.0, 5.0), dvec2(10.0, 4.0), dvec2(10.0, 6.0)], // runs along it
        vec![dvec2(5.0, 5.0), dvec2(10.0, 4.0), dvec2(8.0, 6.0)],  // touches it between two vertices
        vec![dvec2(5.0, 5.0), dvec2(10.0, 10.0), dvec2(5.0, 6.0)], // touches it at a vertex
        vec![dvec2(2.0, 2.0), dvec2(4.0, 4.0), dvec2(4.0, 2.0), dvec2(2.0, 4.0)], // crosses itself
        vec![dvec2(2.0, 2.0), dvec2(3.0, 3.0), dvec2(4.0, 4.0)],   // encloses nothing
    ];
    for hole in &meeting {
        let result = build(Some(&outer), &[hole], &Nodes::default());
        assert!(matches!(result, Err(GraphError::WallsMeet { .. })), "{hole:?}: {result:?}");
    }
    let twice = build(None, &[&outer, &outer], &Nodes::default());
    assert!(matches!(twice, Err(GraphError::WallsMeet { .. })));
}

#[test]
fn other_mistakes_are_named() {
    let outer = square(0.0, 10.0);
    let error = |nodes: &Nodes<'_>| build(Some(&outer), &[], nodes).unwrap_err();
    let off = Nodes { attachments: &[dvec2(0.0, 5.0)], ..Nodes::default() };
    assert_eq!(error(&off), GraphError::AttachmentOffWall { index: 0, point: dvec2(0.0, 5.0) });
    let nan = Nodes { steiner: &[DVec2::ONE, DVec2::NAN], ..Nodes::default() };
    assert!(matches!(error(&nan), GraphError::Coordinate { kind: PointKind::Steiner, index: 1, .. }));
    for spacing in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(error(&Nodes { spacing, ..Nodes::default() }), GraphError::Spacing { .. }));
    }
    assert_eq!(
        build(Some(&outer), &[&outer[..2]], &Nodes::default()).unwrap_err(),
        GraphError::ShortLoop { kind: PointKind::Hole(0), vertices: 2 }
    );
    for weight in [-1.0, f64::NAN, f64::INFINITY] {
        let nodes = Nodes { terminals: &[dvec2(2.0, 2.0), dvec2(8.0, 2.0)], ..Nodes::default() };
        let space = FreeSpace { outer: Some(&outer), holes: vec![] };
        let result = PathGraph::build(&space, &nodes, |_, _| weight);
        assert!(matches!(result, Err(GraphError::Weight { .. })));
    }
}

#[test]
fn an_explicit_graph_must_be_one() {
    let places = || vec![DVec2::ZERO; 3];
    let error = |edge| PathGraph::from_edges(places(), &[], &[], &[edge]).unwrap_err();
    assert_eq!(error((0, 3, 1.0)), GraphError::NoSuchVertex { vertex: 3, count: 3 });
    assert_eq!(error((1, 1, 1.0)), GraphError::LoopEdge { vertex: 1 });
    assert!(matches!(error((0, 1, -1.0)), GraphError::Weight { .. }));
    assert!(PathGraph::from_edges(places(), &[3], &[], &[]).is_err());
    assert!(PathGraph::from_edges(places(), &[], &[7], &[]).is_err());
    assert!(PathGraph::from_edges(vec![DVec2::NAN], &[], &[], &[]).is_err());
}

#[test]
fn vertices_that_do_not_exist_are_unreachable() {
    let graph = PathGraph::from_edges(vec![DVec2::ZERO; 2], &[], &[], &[(0, 1, 1.0)]).unwrap();
    let none = graph.terminal(0);
    assert_eq!(none, PathGraph::NO_VERTEX);
    assert!(graph.position(none).is_nan() && graph.neighbours(none).next().is_none());
    let distances = graph.distances(&[none, 0, 2]);
    assert_eq!(distances.row(0), [f64::INFINITY; 3]);
    assert_eq!(distances.row(1), [f64::INFINITY, 0.0, f64::INFINITY]);
    assert_eq!(distances.get(9, 0), f64::INFINITY);
    assert_eq!(graph.paths_from(none, &[0, none]), [None, None]);
}
