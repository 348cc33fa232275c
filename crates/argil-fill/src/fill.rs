//! A region to closed curves of beads.

use argil_curve::{DVec2, SegmentIndex, self_crossings};
use geo::Area;
use geo_types::{LineString, MultiPolygon, Polygon};

use crate::bare::{BareDisc, Scan, Survey, scan};
use crate::curve::FillCurve;
use crate::detour::{Strand, mended};
use crate::flow::{Laid, follow_room};
use crate::joint::Joint;
use crate::merge::merge_within;
use crate::offset::{dilation, rings};
use crate::ring::{Ring, perimeter, plainer};
use crate::rings::{rings_of, sides_of};
use crate::spiral::with_spirals;
use crate::tree::Fence;
use crate::{FillError, FillOptions, FillPattern};

/// A filled region.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Fill {
    /// The curves: one for each part of the region that joints can reach from the others. None crosses itself or another.
    pub curves: Vec<FillCurve>,
    /// The joints that made them.
    pub joints: Vec<Joint>,
    /// Bare discs wider than [`FillOptions::bare`] that no detour could mend, widest first, between beads of full width.
    pub bare: Vec<BareDisc>,
    /// What was reached.
    pub figures: Figures,
}

/// What a fill has reached. Areas are counted on a grid of about a third of a bead.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Figures {
    /// Rings that were merged, those that were given included; a spiral counts as one.
    pub rings: usize,
    /// Detours into places that would have stayed bare.
    pub detours: usize,
    /// Length of all curves, mm.
    pub length: f64,
    /// Area that a bead can reach without leaving the region, mm².
    pub reachable: f64,
    /// Share of it that lies under a bead.
    pub coverage: f64,
    /// Share of the clay that lies on other clay: 1 − area / (length · width).
    pub overdeposit: f64,
}

/// Largest coordinate, in w and in steps of the grid: beyond, offsets lose the bead to rounding.
const FARTHEST: f64 = 1e6;
const FARTHEST_STEPS: f64 = 1e9;

/// A ring that finds no joint is left out if it is shorter than this, in w.
const LONGEST_BLOB: f64 = 4.0;

/// What an edge may be moved by before the area that a bead can reach is measured, in w.
const MEASURED: f64 = 0.002;

/// Fills a region with beads one width apart, joined to as few closed curves as possible.
///
/// The region's boundary is inset by (k + ½) w for every k, every strip that stays bare gets a loop there and back, and
/// all rings are [merged](crate::merge). Where a disc stays bare, the nearest strand that is no wall makes a detour into it.
///
/// `beside` are rings that exist already next to the region, such as the walls round it. They are merged with the fill and
/// stay as they are but for the joints. `avoid` are places to keep joints away from, such as [`Joint::middle`] of
/// the layer below.
///
/// # Errors
/// See [`FillError`].
///
/// # Complexity
/// Near linear in the length of the fill: offsets level by level, a few queries for every fifth of a bead.
///
/// # Example
/// ```
/// use argil_fill::{FillOptions, fill};
/// use geo_types::{MultiPolygon, polygon};
/// let tile = MultiPolygon(vec![polygon![(x: 0.0, y: 0.0), (x: 30.0, y: 0.0), (x: 30.0, y: 30.0), (x: 0.0, y: 30.0)]]);
/// let filled = fill(&tile, &[], &FillOptions::for_width(1.5), &[])?;
/// assert_eq!(filled.curves.len(), 1);
/// assert!(filled.figures.coverage > 0.985 && filled.figures.overdeposit < 0.03);
/// # Ok::<(), argil_fill::FillError>(())
/// ```
pub fn fill(
    region: &MultiPolygon<f64>,
    beside: &[Ring],
    options: &FillOptions,
    avoid: &[DVec2],
) -> Result<Fill, FillError> {
    options.check()?;
    check_coordinates(region, options)?;
    let w = options.width;
    let region = with_rings_that_are_some(region);
    // A joint from part to part of the region would lay clay outside.
    let edges = region.iter().flat_map(sides_of).collect();
    let fence = Fence { index: SegmentIndex::new(edges, w), first: beside.len() };
    let mut own = rings_of(&region, &fence.index, options)?;
    if options.pattern == FillPattern::Spirals {
        own.rings = with_spirals(own.rings, w, options.grid);
    }
    let mut all = beside.to_vec();
    all.extend(own.rings);
    let mut merged = merge_within(&all, options, avoid, Some(&fence))?;
    // A blob without room for a joint is left to mending.
    let lonely = lonely_blobs(&all[beside.len()..], beside.len(), &merged.joints, w);
    if !lonely.is_empty() {
        let mut number = 0;
        all.retain(|_| {
            number += 1;
            lonely.binary_search(&(number - 1)).is_err()
        });
        merged = merge_within(&all, options, avoid, Some(&fence))?;
    }
    let mut curves = merged.curves;
    let plain: Vec<_> = own.outline.iter().map(|polygon| plainer(polygon, MEASURED * w)).collect();
    let reachable =
        if plain.is_empty() { 0.0 } else { dilation(&MultiPolygon(plain), 0.5 * w, w).unsigned_area() };
    let limit = options.bare * w;
    // What is narrower than a residue loop's strip stays bare as the option has it.
    let mended_from = limit.max(options.residue * w);
    let mut strand = Strand::new(&curves, &fence.index, w, options.grid);
    let mut surveys: Vec<Survey<'_>> =
        own.cores.iter().map(|core| Survey::new(core, &strand.index)).collect();
    let mut found = scan_all(&surveys, &strand, w, limit);
    let merged_only = (curves.clone(), found.clone());
    let mut detours = 0;
    for _ in 0..options.mending {
        let wide = found.discs.partition_point(|disc| disc.diameter > mended_from);
        let made = mended(&mut curves, &strand, &found.discs[..wide], options.wall_cut * w);
        if made.is_empty() {
            break;
        }
        detours += made.len();
        strand = Strand::new(&curves, &fence.index, w, options.grid);
        surveys.iter_mut().for_each(|survey| survey.renew(&made, &strand.index, w));
        found = scan_all(&surveys, &strand, w, limit);
    }
    if detours > 0 && curves.iter().any(|curve| !self_crossings(&curve.points).is_empty()) {
        (curves, found) = merged_only;
        detours = 0;
    }
    let length: f64 = curves.iter().map(FillCurve::length).sum();
    let all_laid = match options.flow {
        Some(limits) => follow_room(&mut curves, &own.cores, w, limits)?,
        None => Laid { bare: found.bare, beads: length * w },
    };
    // Rings that were given lie beside the region, and their clay with them.
    let laid = all_laid.beads - beside.iter().map(|ring| perimeter(&ring.points)).sum::<f64>() * w;
    let figures = Figures {
        rings: all.len(),
        detours,
        length,
        reachable,
        coverage: if reachable > 0.0 { 1.0 - all_laid.bare / reachable } else { 1.0 },
        overdeposit: if laid > 0.0 { 1.0 - (reachable - all_laid.bare) / laid } else { 0.0 },
    };
    Ok(Fill { curves, joints: merged.joints, bare: found.discs, figures })
}

/// Rings that are part of no wall, short and joined to nothing, by their numbers, the first of which is `first`.
fn lonely_blobs(own: &[Ring], first: usize, joints: &[Joint], width: f64) -> Vec<usize> {
    let mut joined = vec![false; own.len()];
    for ring in joints.iter().flat_map(|joint| joint.rings).filter(|&ring| ring >= first) {
        joined[ring - first] = true;
    }
    let is_blob = |ring: &Ring| ring.wall.is_none() && perimeter(&ring.points) < LONGEST_BLOB * width;
    (0..own.len()).filter(|&k| !joined[k] && is_blob(&own[k])).map(|k| first + k).collect()
}

/// The region without rings of fewer than three corners, which the polygon kernel does not expect.
fn with_rings_that_are_some(region: &MultiPolygon<f64>) -> MultiPolygon<f64> {
    let is_some = |ring: &&LineString<f64>| ring.0.len() > 3;
    let polygons = region.iter().filter(|polygon| is_some(&polygon.exterior()));
    MultiPolygon(
        polygons
            .map(|p| {
                Polygon::new(p.exterior().clone(), p.interiors().iter().filter(is_some).cloned().collect())
            })
            .collect(),
    )
}

fn scan_all(surveys: &[Survey<'_>], strand: &Strand<'_>, width: f64, limit: f64) -> Scan {
    let mut all = Scan::default();
    for survey in surveys {
        let own = scan(survey, &strand.index, width, limit);
        all.bare += own.bare;
        all.discs.extend(own.discs);
    }
    all.discs.sort_by(|a, b| b.diameter.total_cmp(&a.diameter));
    all
}

fn check_coordinates(region: &MultiPolygon<f64>, options: &FillOptions) -> Result<(), FillError> {
    let limit = (FARTHEST * options.width).min(FARTHEST_STEPS * options.grid);
    let mut coordinates = region.iter().flat_map(rings).flat_map(|ring| &ring.0).flat_map(|c| [c.x, c.y]);
    match coordinates.find(|value| !value.is_finite() || value.abs() > limit) {
        Some(value) => Err(FillError::Coordinate { value, limit }),
        None => Ok(()),
    }
}
