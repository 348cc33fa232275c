use crate::SliceSettings;
use crate::containment::nest;
use crate::further::laid_distance;
use crate::layer::{Loss, WallLoop};
use crate::region::{self, perimeter, polygon_through, ring_points, signed_area};
use crate::simplification::{distance_to_side, rounded, simplified};
use crate::soundness::unsound;
use geo::{Area, BooleanOps, Centroid, InteriorPoint, Intersects};
use geo_types::{MultiPolygon, Polygon};
use glam::DVec2;

/// How far arcs may cut their corners, in w: a hundredth of what the eye sees on clay, and
/// arcs still have few enough chords to be simplified quickly.
const CHORD: f64 = 0.003;

/// What an outline is simplified by before it is inset, in w. Scans have many more vertices than
/// a bead can follow, and the polygon kernel's time grows with the number that lie within the inset of each other.
const OUTLINE_TOLERANCE: f64 = 0.002;

/// How an inset is cleaned, in w: `opening` is the radius of the disc that must fit everywhere, `tolerance` what
/// the simplification may move the curve by.
///
/// Slivers of a thousandth of a millimetre cross themselves once they are rounded; discs of 0.03 mm
/// (0.02 w) leave room for the simplification on both sides and change 0.04 % of the wall. Where a loop still
/// touches itself it is opened more; there is no fourth try.
const ATTEMPTS: [Cleaning; 4] = [
    Cleaning { opening: 0.01, tolerance: 0.006 },
    Cleaning { opening: 0.02, tolerance: 0.006 },
    Cleaning { opening: 0.04, tolerance: 0.003 },
    Cleaning { opening: 0.08, tolerance: 0.003 },
];

#[derive(Clone, Copy)]
struct Cleaning {
    opening: f64,
    tolerance: f64,
}

/// Insets in w/2 that are tried in turn on an outline in which no bead fits: the first that
/// exists squeezes the clay out least.
const THIN_INSETS: [f64; 9] = [0.96, 0.92, 0.87, 0.8, 0.6, 0.45, 0.3, 0.2, 0.1];

/// A thin loop is printed if it is at least this long and this wide, in w: less is a blob.
const THIN_LENGTH: f64 = 0.8;
const THIN_WIDTH: f64 = 0.08;

/// A part of an outline that no bead reaches is reported from this area on, in w²: rounded
/// corners are smaller (0.05 w² at a right angle).
const BRANCH_AREA: f64 = 0.25;

/// What the bead may fall short of an outline by without it being a lost branch, in w.
const BRANCH_SLACK: f64 = 1.0 / 30.0;

/// Outlines whose boundary comes within this of a wall everywhere, in w, have no lost branch: at its tip
/// a branch is farther away. A right angle, where nothing is lost, is 0.707 w from the wall.
const BRANCH_DISTANCE: f64 = 0.75;

/// The walls of a layer's outline, and what of it they do not print.
pub(crate) fn walls(
    layer: usize,
    outline: &MultiPolygon<f64>,
    settings: &SliceSettings,
) -> (Vec<WallLoop>, Vec<Loss>) {
    let mut losses = Vec::new();
    let mut pieces: Vec<Piece<'_>> = Vec::new();
    let simple: Vec<Polygon<f64>> = outline.iter().map(|polygon| simpler(polygon, settings.width)).collect();
    for (polygon, original) in simple.iter().zip(outline) {
        let found = pieces.len();
        for wall in 0..settings.walls {
            let distance = (wall as f64 + 0.5) * settings.width;
            let before = pieces.len();
            pieces.extend(Source { polygon, distance, wall, thin: false }.pieces(ATTEMPTS[0], settings));
            if wall > 0 {
                losses.extend(slight_parts(layer, polygon, distance, &pieces[before..], settings));
            }
            if pieces.len() == before {
                break;
            }
        }
        if pieces.len() == found {
            let thin = thin_pieces(polygon, settings);
            let (at, area) = (inner_point(original), original.unsigned_area());
            losses.push(match thin.first() {
                Some(piece) => Loss::Thin { layer, at, area, inset: piece.source.distance },
                None => Loss::Vanished { layer, at, area },
            });
            pieces.extend(thin);
        } else {
            let first: Vec<&Piece<'_>> =
                pieces[found..].iter().filter(|piece| piece.source.wall == 0).collect();
            if !comes_near(polygon, &first, settings.width) {
                losses.extend(lost_branches(layer, polygon, &first, settings));
            }
        }
    }
    let pieces = sound_pieces(pieces, layer, settings, &mut losses);
    let mut walls: Vec<WallLoop> = pieces.into_iter().flat_map(Piece::into_loops).collect();
    nest(&mut walls);
    (walls, losses)
}

/// Which inset of which outline a piece belongs to.
#[derive(Clone, Copy)]
struct Source<'a> {
    polygon: &'a Polygon<f64>,
    distance: f64,
    wall: usize,
    thin: bool,
}

/// One connected piece of an inset, with the loops that print its rings.
struct Piece<'a> {
    source: Source<'a>,
    region: Polygon<f64>,
    /// The exterior first.
    rings: Vec<Vec<DVec2>>,
}

impl<'a> Source<'a> {
    fn pieces(self, cleaning: Cleaning, settings: &SliceSettings) -> Vec<Piece<'a>> {
        let width = settings.width;
        let opening = cleaning.opening * width;
        let chord = CHORD * width;
        let opened_at = |distance: f64| {
            let shrunk = region::inset(self.polygon, distance + opening, chord);
            if shrunk.0.is_empty() { shrunk } else { region::mitred_dilation(&shrunk, opening) }
        };
        let mut opened = opened_at(self.distance);
        if self.wall > 0 {
            let distance = laid_distance(self.polygon, self.distance, &opened, (width, chord));
            if distance < self.distance {
                opened = opened_at(distance);
            }
        }
        opened.into_iter().filter_map(|region| self.piece(region, cleaning, settings)).collect()
    }

    fn piece(self, region: Polygon<f64>, cleaning: Cleaning, settings: &SliceSettings) -> Option<Piece<'a>> {
        // Sides of a thousandth of a millimetre have no direction left after rounding.
        let least_side = 12.0 * settings.grid;
        let tolerance = cleaning.tolerance * settings.width;
        let exterior = std::iter::once(region.exterior());
        let rings: Vec<Vec<DVec2>> = exterior
            .chain(region.interiors())
            .map(|ring| rounded(&simplified(&ring_points(ring), tolerance), settings.grid, least_side))
            .collect();
        let kept = rings.first().is_some_and(|ring| ring.len() >= 3);
        kept.then_some(Piece { source: self, region, rings })
    }
}

impl Piece<'_> {
    fn into_loops(self) -> impl Iterator<Item = WallLoop> {
        let Source { wall, thin, .. } = self.source;
        self.rings.into_iter().enumerate().map(move |(number, mut points)| {
            let hole = number > 0;
            if (signed_area(&points) < 0.0) != hole {
                points.reverse();
            }
            WallLoop { points, parent: None, depth: 0, wall, hole, thin }
        })
    }
}

/// The parts of a further wall's inset that are too slight for a loop that stays apart from itself, and so are in
/// none of its pieces.
fn slight_parts(
    layer: usize,
    polygon: &Polygon<f64>,
    distance: f64,
    pieces: &[Piece<'_>],
    settings: &SliceSettings,
) -> Vec<Loss> {
    let parts = region::inset(polygon, distance, CHORD * settings.width);
    let lost = parts.iter().filter(|part| !pieces.iter().any(|piece| piece.region.intersects(*part)));
    lost.map(|part| Loss::Branch { layer, at: inner_point(part), area: part.unsigned_area() }).collect()
}

/// The pieces of the largest inset, among a few, that leaves something worth printing.
fn thin_pieces<'a>(polygon: &'a Polygon<f64>, settings: &SliceSettings) -> Vec<Piece<'a>> {
    let cleaning = Cleaning { opening: 0.5 * THIN_WIDTH, ..ATTEMPTS[0] };
    for factor in THIN_INSETS {
        let source = Source { polygon, distance: factor * 0.5 * settings.width, wall: 0, thin: true };
        let mut pieces = source.pieces(cleaning, settings);
        pieces.retain(|piece| {
            piece.rings.first().is_some_and(|ring| perimeter(ring) >= THIN_LENGTH * settings.width)
        });
        if !pieces.is_empty() {
            return pieces;
        }
    }
    Vec::new()
}

/// The outline with the vertices left out that change nothing.
fn simpler(polygon: &Polygon<f64>, width: f64) -> Polygon<f64> {
    let rings: Vec<Vec<DVec2>> = std::iter::once(polygon.exterior())
        .chain(polygon.interiors())
        .map(|ring| simplified(&ring_points(ring), OUTLINE_TOLERANCE * width))
        .collect();
    if rings[0].len() < 3 { polygon.clone() } else { polygon_through(&rings) }
}

/// Whether every point of the outline has a wall near, so that no branch of it can be lost.
fn comes_near(polygon: &Polygon<f64>, pieces: &[&Piece<'_>], width: f64) -> bool {
    let sides: Vec<(DVec2, DVec2)> = pieces
        .iter()
        .flat_map(|piece| &piece.rings)
        .flat_map(|ring| ring.iter().copied().zip(ring.iter().copied().cycle().skip(1)))
        .collect();
    let limit = BRANCH_DISTANCE * width;
    // Walls follow their outline: the next point is near the side that the last was near.
    let mut near = 0;
    let mut is_near = |point: DVec2| {
        let found = (0..sides.len())
            .map(|k| (near + k) % sides.len())
            .find(|&k| distance_to_side(point, sides[k].0, sides[k].1) <= limit);
        near = found.unwrap_or(near);
        found.is_some()
    };
    std::iter::once(polygon.exterior()).chain(polygon.interiors()).flat_map(|ring| ring.lines()).all(|line| {
        let (from, to) = (DVec2::new(line.start.x, line.start.y), DVec2::new(line.end.x, line.end.y));
        let parts = (from.distance(to) / (0.5 * width)).ceil().max(1.0);
        (0..parts as usize).all(|k| is_near(from.lerp(to, k as f64 / parts)))
    })
}

/// The parts of an outline that lie farther from its first wall than the bead reaches.
fn lost_branches(
    layer: usize,
    polygon: &Polygon<f64>,
    pieces: &[&Piece<'_>],
    settings: &SliceSettings,
) -> Vec<Loss> {
    let width = settings.width;
    let reach = (0.5 + BRANCH_SLACK) * width;
    let printed = MultiPolygon(pieces.iter().map(|piece| polygon_through(&piece.rings)).collect());
    let covered = region::dilation(&printed, reach, 0.5 * BRANCH_SLACK * width);
    let missed = MultiPolygon(vec![polygon.clone()]).difference(&covered);
    missed
        .iter()
        .map(|part| (part, part.unsigned_area()))
        .filter(|&(_, area)| area > BRANCH_AREA * width * width)
        .map(|(part, area)| Loss::Branch { layer, at: inner_point(part), area })
        .collect()
}

/// Replaces the pieces whose loops touch themselves or others by better cleaned ones, and drops those that
/// stay unsound.
fn sound_pieces<'a>(
    mut pieces: Vec<Piece<'a>>,
    layer: usize,
    settings: &SliceSettings,
    losses: &mut Vec<Loss>,
) -> Vec<Piece<'a>> {
    for cleaning in ATTEMPTS.iter().skip(1).map(Some).chain([None]) {
        let faulty = faulty_pieces(&pieces, settings.grid);
        if !faulty.contains(&true) {
            break;
        }
        let mut sound = Vec::with_capacity(pieces.len());
        for (piece, is_faulty) in pieces.into_iter().zip(faulty) {
            if !is_faulty {
                sound.push(piece);
                continue;
            }
            let better = cleaning.map_or(Vec::new(), |cleaning| piece.cleaned(*cleaning, settings));
            if better.is_empty() {
                losses.push(Loss::Unsound {
                    layer,
                    at: piece.rings.first().and_then(|ring| ring.first()).copied().unwrap_or_default(),
                    length: piece.rings.iter().map(|ring| perimeter(ring)).sum(),
                });
            }
            sound.extend(better);
        }
        pieces = sound;
    }
    pieces
}

impl<'a> Piece<'a> {
    /// The same piece opened further; it may fall apart.
    fn cleaned(&self, cleaning: Cleaning, settings: &SliceSettings) -> Vec<Piece<'a>> {
        let opening = cleaning.opening * settings.width;
        let shrunk = region::inset(&self.region, opening, CHORD * settings.width);
        let opened = region::mitred_dilation(&shrunk, opening);
        opened.into_iter().filter_map(|region| self.source.piece(region, cleaning, settings)).collect()
    }
}

fn faulty_pieces(pieces: &[Piece<'_>], grid: f64) -> Vec<bool> {
    let rings: Vec<Vec<DVec2>> = pieces.iter().flat_map(|piece| piece.rings.iter().cloned()).collect();
    let mut faulty = unsound(&rings, grid).into_iter();
    pieces
        .iter()
        .map(|piece| faulty.by_ref().take(piece.rings.len()).fold(false, |any, is| any | is))
        .collect()
}

/// A point inside the polygon, or at least near it where it has no inside.
fn inner_point(polygon: &Polygon<f64>) -> DVec2 {
    let point = polygon.interior_point().or_else(|| polygon.centroid());
    point.map_or(DVec2::ZERO, |p| DVec2::new(p.x(), p.y()))
}
