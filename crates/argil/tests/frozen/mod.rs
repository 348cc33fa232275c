//! Bodies that once fell short, each taken apart to the least that did.

use crate::body::Join::{Add, Cut};
use crate::body::Piece::{Block, Rod};
use crate::body::{Body, Join, Piece, fault};
use argil::Settings;

fn assert_sound(pieces: &[(Join, Piece)], width: f64, walls: usize) {
    let settings = Settings { layer_height: 0.5, walls, ..Settings::for_width(width) };
    let found = fault(&Body(pieces.to_vec()), &settings);
    assert!(found.is_none(), "{}", found.map_or_else(String::new, |fault| fault.to_string()));
}

/// The wall of the thin tooth was left out.
#[test]
fn two_teeth_in_mid_air() {
    let thin = Block([-9.0, -7.5, 3.0], [4.5, -5.9, 6.7]);
    assert_sound(&[(Add, thin), (Add, Block([-9.0, -5.4, 3.0], [2.9, -2.6, 6.7]))], 1.5, 1);
}

/// The tube is just as thick as a bead on one side, and thinner on the other.
#[test]
fn a_tube_off_its_middle() {
    let hole = Rod([0.0, 0.0, -9.0], 6.6, [0.1, 0.4, 18.0], 6.6);
    assert_sound(&[(Add, Rod([0.0, 0.0, -3.0], 9.0, [0.0, 0.0, 1.0], 9.0)), (Cut, hole)], 1.5, 1);
}

/// The hole begins as a point, and the wall round it as a sliver.
#[test]
fn a_hollow_that_begins_in_a_solid() {
    let hollow = Rod([0.4, 0.0, 8.5], 3.6, [1.9, 0.6, 11.0], 2.7);
    assert_sound(&[(Add, Rod([0.4, 0.0, -2.0], 6.0, [1.9, 0.6, 11.0], 5.1)), (Cut, hollow)], 1.5, 1);
}

/// Three walls where there is room for one.
#[test]
fn a_thin_cup_with_three_walls() {
    let hollow = Rod([0.0, 0.0, -4.0], 3.3, [-1.0, -1.0, 11.0], 3.5);
    assert_sound(&[(Add, Rod([0.0, 0.0, -2.0], 4.9, [-1.0, -1.0, 11.0], 5.1)), (Cut, hollow)], 1.5, 3);
}

/// It narrows to less than a bead while it begins in mid-air.
#[test]
fn a_rod_in_mid_air() {
    assert_sound(&[(Add, Rod([-7.0, 0.0, 9.0], 1.8, [6.0, 2.0, 8.0], 1.3))], 3.0, 1);
}

/// What was left between hole and edge got no clay, and no loss told of it.
#[test]
fn a_hole_at_the_edge_of_a_plate() {
    let hole = Rod([-4.0, -5.0, -5.0], 1.7, [-5.0, -7.0, 8.0], 1.7);
    assert_sound(&[(Add, Block([-8.0, -8.0, -2.0], [8.0, 8.0, 5.0])), (Cut, hole)], 1.5, 1);
}

/// A twig beside a fin: what lies between the two got no clay, and no loss told of it.
#[test]
fn a_twig_beside_a_fin() {
    let trunk = Rod([0.0, 0.0, -2.0], 3.9, [0.0, 0.0, 9.0], 2.9);
    let fin = Block([0.0, -2.7, 0.9], [8.5, -0.5, 9.0]);
    assert_sound(&[(Add, trunk), (Add, fin), (Add, Rod([0.0, 0.0, 4.1], 1.6, [7.9, 0.0, 6.6], 1.6))], 3.0, 1);
}
