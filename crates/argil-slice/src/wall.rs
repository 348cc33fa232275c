use crate::SliceSettings;
use crate::containment::nest;
use crate::fit::{Fit, inner_point};
use crate::further::laid_distance;
use crate::layer::{Loss, WallLoop};
use crate::mitre::mitre;
use crate::pockets::without_gaps;
use crate::region::{self, perimeter, polygon_through, ring_points, signed_area};
use crate::slender::{SLACK, is_strip_lost, strips};
use crate::soundness::unsound;
use crate::spine::{self, is_bare_somewhere};
use crate::thin::{HALF_LANE, has_spine, with_spines};
use argil_curve::{SegmentIndex, rounded, self_crossings, simplified};
use geo::{Area, BooleanOps, Contains, Intersects};
use geo_types::{LineString, MultiPolygon, Polygon};
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

/// Notches beside a spine that are narrower than twice this, in w, are closed.
const CLOSING: f64 = 0.03;

#[derive(Clone, Copy)]
struct Cleaning {
    opening: f64,
    tolerance: f64,
}

/// The walls of an outline.
pub(crate) struct Walls {
    /// Where a bead fits.
    pub(crate) walled: MultiPolygon<f64>,
    pub(crate) walls: Vec<WallLoop>,
    /// What the walls do not print.
    pub(crate) losses: Vec<Loss>,
}

/// The walls of a layer's outline, and what of it they do not print.
pub(crate) fn walls(layer: usize, outline: &MultiPolygon<f64>, settings: &SliceSettings) -> Walls {
    let mut losses = Vec::new();
    let mut pieces: Vec<Piece<'_>> = Vec::new();
    let simple: Vec<Polygon<f64>> = outline.iter().map(|polygon| simpler(polygon, settings.width)).collect();
    let mut firsts = Vec::with_capacity(simple.len());
    for polygon in &simple {
        let first = Source { polygon, distance: 0.5 * settings.width, wall: 0, thin: false };
        let mut first = FirstWall::of(first, first.pieces(ATTEMPTS[0], settings), settings);
        let walls = if first.walled.0.is_empty() { 1 } else { settings.walls };
        pieces.append(&mut first.pieces);
        firsts.push(first);
        for wall in 1..walls {
            let distance = (wall as f64 + 0.5) * settings.width;
            let source = Source { polygon, distance, wall, thin: false };
            let mut further = source.pieces(ATTEMPTS[0], settings);
            if !slight_parts(layer, polygon, distance, &further, settings).is_empty() {
                further = source.widened_pieces(settings);
            }
            losses.extend(slight_parts(layer, polygon, distance, &further, settings));
            if further.is_empty() {
                break;
            }
            pieces.append(&mut further);
        }
    }
    let faulty = faulty_pieces(&pieces, settings.grid);
    if faulty.contains(&true) {
        let widened = widened(pieces, &faulty, &mut firsts, settings);
        pieces = sound_pieces(widened, layer, settings, &mut losses);
    }
    for (first, original) in firsts.iter().zip(outline) {
        let is_its =
            |piece: &&Piece<'_>| piece.source.wall == 0 && std::ptr::eq(piece.source.polygon, first.polygon);
        let rings: Vec<&Vec<DVec2>> = pieces.iter().filter(is_its).flat_map(|piece| &piece.rings).collect();
        let FirstWall { outline, walled, spines, .. } = first;
        losses.extend(Fit { layer, original, outline, walled, spines, rings: &rings }.losses(settings));
    }
    let mut walls: Vec<WallLoop> = pieces.into_iter().flat_map(Piece::into_loops).collect();
    nest(&mut walls);
    let walled = firsts.into_iter().flat_map(|first| first.walled).collect();
    Walls { walled: MultiPolygon(walled), walls, losses }
}

/// The walls whose paths are the rings of a region as they are, and those round lines inside of it, gone along there and back.
pub(crate) fn walls_along(
    layer: usize,
    region: &MultiPolygon<f64>,
    slits: &MultiPolygon<f64>,
    settings: &SliceSettings,
) -> Walls {
    let mut losses = Vec::new();
    let simple: Vec<Polygon<f64>> =
        region.iter().chain(slits).map(|polygon| simpler(polygon, settings.width)).collect();
    let sources = simple.iter().map(|polygon| Source { polygon, distance: 0.0, wall: 0, thin: true });
    let pieces = sources.flat_map(|source| source.pieces(ATTEMPTS[0], settings)).collect();
    let pieces = sound_pieces(pieces, layer, settings, &mut losses);
    let mut walls: Vec<WallLoop> = pieces.into_iter().flat_map(Piece::into_loops).collect();
    nest(&mut walls);
    let mut walled = region.clone();
    for slit in slits {
        let around =
            walled.0.iter_mut().find(|polygon| slit.exterior().points().all(|p| polygon.contains(&p)));
        if let Some(around) = around {
            around.interiors_push(slit.exterior().clone());
        }
    }
    Walls { walled, walls, losses }
}

/// The first wall of an outline and how it came about.
struct FirstWall<'a> {
    polygon: &'a Polygon<f64>,
    pieces: Vec<Piece<'a>>,
    /// The outline's rings.
    outline: Vec<Vec<DVec2>>,
    /// What lies within the wall where the outline is wide enough for one.
    walled: MultiPolygon<f64>,
    spines: Vec<Vec<DVec2>>,
}

impl<'a> FirstWall<'a> {
    /// From the pieces that it has without thin lines.
    fn of(source: Source<'a>, mut pieces: Vec<Piece<'a>>, settings: &SliceSettings) -> Self {
        let width = settings.width;
        let outline: Vec<Vec<DVec2>> = region::rings(source.polygon).map(ring_points).collect();
        let mitred = |pieces: &mut Vec<Piece<'_>>| {
            let mut rings: Vec<_> = pieces.iter_mut().flat_map(|piece| &mut piece.rings).collect();
            mitre(&mut rings, &outline, |_| true, width, settings.grid)
        };
        let mut index = mitred(&mut pieces);
        if is_strip_lost(&outline, &index, width) {
            pieces = source.widened_pieces(settings);
            index = mitred(&mut pieces);
        }
        let walled = MultiPolygon(pieces.iter().map(|piece| piece.region.clone()).collect());
        let mut spines = Vec::new();
        if is_bare_somewhere(&outline, &index, width) {
            spines = spine::spines(&outline, &index, width);
        }
        if !spines.is_empty() {
            let joined = with_spines(&walled, &spines, &outline, width);
            let piece = |region: Polygon<f64>| {
                let is_thin = |old: &Piece<'_>| old.source.thin && old.region.intersects(&region);
                let thin = has_spine(&region, &spines) || pieces.iter().any(is_thin);
                Source { thin, ..source }.piece(region, ATTEMPTS[0], settings)
            };
            pieces = joined.into_iter().filter_map(piece).collect();
            // What lies near the outline is the end of a spine and no corner.
            let sides =
                SegmentIndex::new(outline.iter().flat_map(|ring| spine::sides(ring)).collect(), width);
            let is_corner = |p: DVec2| !sides.is_within(p, 0.4 * width);
            let mut rings: Vec<_> = pieces.iter_mut().flat_map(|piece| &mut piece.rings).collect();
            mitre(&mut rings, &outline, is_corner, width, settings.grid);
        }
        Self { polygon: source.polygon, pieces, outline, walled, spines }
    }
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
    /// The exterior first; the solid is on the left of each.
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

    /// The pieces with what is slender widened; opened as little as any.
    fn widened_pieces(self, settings: &SliceSettings) -> Vec<Piece<'a>> {
        let (width, chord) = (settings.width, CHORD * settings.width);
        let strips = strips(&region::inset(self.polygon, self.distance - SLACK * width, chord), width, chord);
        let whole = region::inset(self.polygon, self.distance, chord).union(&strips);
        let opening = ATTEMPTS[0].opening * width;
        let opened = region::mitred_dilation(&region::inset(&whole, opening, chord), opening);
        let piece = |region: Polygon<f64>| {
            let thin = self.thin || strips.intersects(&region);
            Source { thin, ..self }.piece(region, ATTEMPTS[0], settings)
        };
        opened.into_iter().filter_map(piece).collect()
    }

    fn piece(self, region: Polygon<f64>, cleaning: Cleaning, settings: &SliceSettings) -> Option<Piece<'a>> {
        // Sides of a thousandth of a millimetre have no direction left after rounding.
        let least_side = 12.0 * settings.grid;
        let tolerance = cleaning.tolerance * settings.width;
        let rings: Vec<Vec<DVec2>> = region::rings(&region)
            .map(|ring| rounded(&simplified(&ring_points(ring), tolerance), settings.grid, least_side))
            .enumerate()
            .map(|(number, mut ring)| {
                if (signed_area(&ring) < 0.0) != (number > 0) {
                    ring.reverse();
                }
                ring
            })
            .collect();
        let kept = rings.first().is_some_and(|ring| ring.len() >= 3);
        kept.then_some(Piece { source: self, region, rings })
    }
}

impl Piece<'_> {
    fn into_loops(self) -> impl Iterator<Item = WallLoop> {
        let Source { wall, thin, .. } = self.source;
        self.rings.into_iter().enumerate().map(move |(number, points)| WallLoop {
            points,
            parent: None,
            depth: 0,
            wall,
            hole: number > 0,
            thin,
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

/// The outline with the vertices left out that change nothing. Where a ring would cross itself without them it keeps them: the
/// kernel may lose it.
fn simpler(polygon: &Polygon<f64>, width: f64) -> Polygon<f64> {
    let ring = |ring: &LineString<f64>| {
        let whole = ring_points(ring);
        let simple = simplified(&whole, OUTLINE_TOLERANCE * width);
        if simple.len() < 3 || (simple.len() < whole.len() && !self_crossings(&simple).is_empty()) {
            return whole;
        }
        simple
    };
    polygon_through(&region::rings(polygon).map(ring).collect::<Vec<_>>())
}

/// The pieces with each first wall that has a faulty one made anew, its slender parts widened, where that makes it sound by itself.
fn widened<'a>(
    mut pieces: Vec<Piece<'a>>,
    faulty: &[bool],
    firsts: &mut [FirstWall<'a>],
    settings: &SliceSettings,
) -> Vec<Piece<'a>> {
    let faults: Vec<Source<'a>> = pieces
        .iter()
        .zip(faulty)
        .filter(|(piece, is_faulty)| **is_faulty && piece.source.wall == 0)
        .map(|(piece, _)| Source { thin: false, ..piece.source })
        .collect();
    for first in firsts {
        let Some(source) = faults.iter().find(|source| std::ptr::eq(source.polygon, first.polygon)) else {
            continue;
        };
        let mut anew = FirstWall::of(*source, source.widened_pieces(settings), settings);
        if !anew.pieces.is_empty() && !faulty_pieces(&anew.pieces, settings.grid).contains(&true) {
            pieces
                .retain(|piece| piece.source.wall > 0 || !std::ptr::eq(piece.source.polygon, first.polygon));
            pieces.append(&mut anew.pieces);
            *first = anew;
        }
    }
    pieces
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
    /// The same piece opened further; it may fall apart. Notches beside a spine are closed first, since opening costs
    /// the spine.
    fn cleaned(&self, cleaning: Cleaning, settings: &SliceSettings) -> Vec<Piece<'a>> {
        let (width, chord) = (settings.width, CHORD * settings.width);
        let opening = cleaning.opening * width;
        let cleaned: MultiPolygon<f64> = if self.source.thin && cleaning.opening <= HALF_LANE {
            let closing = CLOSING * width;
            let closed = region::inset(&region::dilation(&self.region, closing, chord), closing, chord);
            // A bay that is closed at its mouth is a pocket.
            let outline: Vec<Vec<DVec2>> = region::rings(self.source.polygon).map(ring_points).collect();
            closed.into_iter().map(|polygon| without_gaps(polygon, &outline, width)).collect()
        } else {
            region::mitred_dilation(&region::inset(&self.region, opening, chord), opening)
        };
        let piece = |region| self.source.piece(region, cleaning, settings);
        cleaned.into_iter().filter_map(piece).collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use geo_types::Coord;

    #[test]
    fn a_bay_that_is_closed_at_its_mouth_is_no_loop() {
        let ring = |points: &[(f64, f64)]| LineString(points.iter().copied().map(Coord::from).collect());
        let outline = Polygon::new(ring(&[(-2.0, -2.0), (9.0, -2.0), (9.0, 9.0), (-2.0, 9.0)]), Vec::new());
        // A square with a bay in its side, 0.6 mm across, behind a mouth of a twentieth of a millimetre.
        let bay = [
            (3.0, 0.0),
            (3.0, 0.1),
            (2.7, 0.1),
            (2.7, 0.7),
            (3.3, 0.7),
            (3.3, 0.1),
            (3.05, 0.1),
            (3.05, 0.0),
        ];
        let square = [(6.0, 0.0), (6.0, 6.0), (0.0, 6.0)];
        let region = Polygon::new(ring(&[&[(0.0, 0.0)], &bay[..], &square[..]].concat()), Vec::new());
        let source = Source { polygon: &outline, distance: 0.75, wall: 0, thin: true };
        let settings = SliceSettings::default();
        let piece = source.piece(region, ATTEMPTS[0], &settings).expect("it has rings");
        let cleaned = piece.cleaned(ATTEMPTS[1], &settings);
        assert_eq!(cleaned.iter().map(|piece| piece.rings.len()).collect::<Vec<_>>(), [1]);
    }
}
