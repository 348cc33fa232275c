use crate::chain::{Linker, OpenChain};
use crate::gaps::{Closing, close_gaps, runs_inside};
use crate::layer::{Layer, Loss};
use crate::region::{perimeter, signed_area, wound_region};
use crate::section::Sweep;
use crate::settings::MOST_LAYERS;
use crate::sheet::{Sheet, SheetSection};
use crate::wall::{Walls, walls};
use crate::winding::unlike_one;
use crate::{SliceError, SliceSettings};
use argil_mesh::Mesh;
use geo::{Distance, Euclidean};
use geo_types::{Coord, MultiPolygon, Point};
use glam::DVec2;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// Outlines smaller than this, in square millimetres, are rounding errors of the cut.
const LEAST_AREA: f64 = 1e-6;

/// Thickness, in w, below which a closed contour is a sheet: the mesh has two sides there and nothing in between.
const SHEET: f64 = 3e-4;

/// Open pieces of a cut up to this length, in w, bound nothing that a bead could show.
const SPECK: f64 = 0.05;

/// Layers that are cut before somebody is asked whether to go on: so few that an answer is not long in coming, and enough for all
/// threads of a desk.
const BATCH: usize = 16;

/// Cuts a mesh into layers and lays the wall paths into each outline. The paper
/// takes both as given.
///
/// Layer n is cut at the height (n + ½) h above the lowest point of the mesh and printed at
/// (n + 1) h. Layers are returned bottom first, also empty ones in
/// the middle, where the model vanishes for a while. The mesh is [oriented](Mesh::oriented) first.
///
/// # Errors
/// [`SliceError`] for settings that are no lengths, for a mesh that does not reach the middle of the first
/// layer, for more than 100,000 layers, and for a mesh too wide for its output grid. Flaws of
/// the mesh are no errors: they are in [`Layer::losses`], also the gaps that were closed.
///
/// # Complexity
/// O(triangles + crossings of planes with triangles) for the cuts; the polygon operations on each layer
/// are near linear in its vertices.
///
/// # Example
/// ```
/// use argil_slice::{mesh::Mesh, slice, SliceError, SliceSettings};
/// let flat = Mesh::new(vec![[0.0; 3], [9.0, 0.0, 0.0], [0.0, 9.0, 0.1]], vec![[0, 1, 2]]).unwrap();
/// assert_eq!(
///     slice(&flat, &SliceSettings::default()),
///     Err(SliceError::ThinnerThanALayer { height: 0.1, layer_height: 0.5 }),
/// );
/// ```
pub fn slice(mesh: &Mesh, settings: &SliceSettings) -> Result<Vec<Layer>, SliceError> {
    // Nobody ends it, so that there are layers.
    slice_while(mesh, settings, &mut || true).map(Option::unwrap_or_default)
}

/// The same for as long as `goes_on` says so: it is asked before the mesh is oriented, and again before every sixteen layers.
/// `None` where it has ended the work.
///
/// # Errors
/// Those of [`slice()`].
///
/// # Complexity
/// That of [`slice()`]; what one batch of layers leaves behind is let go before the next, but for the layers themselves.
///
/// # Example
/// ```
/// use argil_slice::{SliceSettings, slice_while, stacked};
/// # use glam::DVec2;
/// # let square = vec![DVec2::ZERO, DVec2::new(8.0, 0.0), DVec2::new(8.0, 8.0), DVec2::new(0.0, 8.0)];
/// let mesh = stacked(&vec![vec![square]; 40], 0.5)?;
/// let mut asked = 0;
/// let layers = slice_while(&mesh, &SliceSettings::default(), &mut || { asked += 1; asked < 3 })?;
/// assert_eq!((layers, asked), (None, 3));
/// # Ok::<(), argil_slice::SliceError>(())
/// ```
pub fn slice_while(
    mesh: &Mesh,
    settings: &SliceSettings,
    goes_on: &mut dyn FnMut() -> bool,
) -> Result<Option<Vec<Layer>>, SliceError> {
    settings.check()?;
    let bounds = mesh.bounds();
    let [wide, deep, height] = bounds.size();
    check_width(wide.max(deep), settings.grid)?;
    let layers = layer_count(height, settings.layer_height)?;
    let bottom = bounds.min[2];
    let planes: Vec<f64> = (0..layers).map(|n| bottom + (n as f64 + 0.5) * settings.layer_height).collect();

    if !goes_on() {
        return Ok(None);
    }
    let mesh = mesh.oriented();
    let edges = mesh.edges();
    let mut sweep = Sweep::new(&mesh, &edges, &planes);
    let mut linker = Linker::new(edges.ends().len());
    let mut cuts = Vec::new();
    let mut done = Vec::with_capacity(layers);
    for (batch, heights) in planes.chunks(BATCH).enumerate() {
        if !goes_on() {
            return Ok(None);
        }
        let mut section = |(k, &cut_z): (usize, &f64)| {
            let index = batch * BATCH + k;
            sweep.advance(&mut cuts);
            let (contours, open) = linker.link(&cuts);
            let print_z = bottom + (index as f64 + 1.0) * settings.layer_height;
            UnclosedSection { index, cut_z, print_z, contours, open }
        };
        let sections: Vec<UnclosedSection> = heights.iter().enumerate().map(&mut section).collect();
        #[cfg(feature = "rayon")]
        done.par_extend(sections.into_par_iter().map(|section| section.layer(settings)));
        #[cfg(not(feature = "rayon"))]
        done.extend(sections.into_iter().map(|section| section.layer(settings)));
    }
    Ok(Some(done))
}

/// What one plane cuts out of the mesh.
struct UnclosedSection {
    index: usize,
    cut_z: f64,
    print_z: f64,
    contours: Vec<Vec<DVec2>>,
    open: Vec<OpenChain>,
}

impl UnclosedSection {
    /// The layer with its walls; this is most of the work, and that of one layer is none of another's.
    fn layer(mut self, settings: &SliceSettings) -> Layer {
        if settings.surface {
            return self.sheet(settings);
        }
        let index = self.index;
        let width = settings.width;
        let mut losses = Vec::new();
        if !self.open.is_empty() {
            self.close(settings, &mut losses);
        }
        let sheets: Vec<Vec<DVec2>> =
            self.contours.iter().filter(|contour| is_sheet(contour, width)).cloned().collect();
        let outline = wound_region(&self.contours, LEAST_AREA);
        losses.extend(unlike_one(index, &self.contours, &outline, width));
        for chain in &self.open {
            let Some(&at) = chain.points.last() else { continue };
            let length = chain.length();
            let is_stray = length <= SPECK * width || runs_inside(chain, &outline);
            losses.push(match is_stray {
                true => Loss::Stray { layer: index, at, length },
                false => Loss::OpenOutline { layer: index, at, length, gap: chain.gap() },
            });
        }
        let bare = sheets.iter().filter_map(|sheet| sheet.iter().find(|p| is_outside(**p, &outline, width)));
        losses.extend(bare.map(|&at| Loss::Vanished { layer: index, at, area: 0.0 }));
        let mut inset = walls(index, &outline, settings);
        losses.append(&mut inset.losses);
        let Walls { walled, walls, .. } = inset;
        Layer { index, cut_z: self.cut_z, print_z: self.print_z, outline, walled, walls, losses }
    }

    /// The layer of a sheet. Gaps that a bead covers are closed; wider ones are where the sheet ends.
    fn sheet(mut self, settings: &SliceSettings) -> Layer {
        let (layer, width) = (self.index, settings.width);
        let sure = settings.gap * width;
        let nothing = MultiPolygon(Vec::new());
        let mut closed = close_gaps(&mut self.open, &Closing { limit: sure, sure, solid: &nothing });
        self.contours.append(&mut closed.contours);
        let (doubled, contours): (Vec<_>, Vec<_>) =
            self.contours.into_iter().partition(|contour| is_sheet(contour, width));
        let (open, specks): (Vec<_>, Vec<_>) =
            self.open.into_iter().partition(|chain| chain.length() > SPECK * width);
        let section = SheetSection { layer, contours: &contours, doubled: &doubled, open: &open };
        let Sheet { outline, walls: Walls { walled, walls, mut losses } } = section.sheet(settings);
        let seen = closed.gaps.into_iter().filter(|&(_, gap)| gap > settings.grid);
        losses.extend(seen.map(|(at, gap)| Loss::ClosedGap { layer, at, gap }));
        let strays = specks.iter().filter_map(|chain| Some((*chain.points.last()?, chain.length())));
        losses.extend(strays.map(|(at, length)| Loss::Stray { layer, at, length }));
        Layer { index: layer, cut_z: self.cut_z, print_z: self.print_z, outline, walled, walls, losses }
    }

    /// Closes contours across gaps: narrow ones first, then wider ones, where that leaves little to guess.
    fn close(&mut self, settings: &SliceSettings, losses: &mut Vec<Loss>) {
        let sure = settings.gap * settings.width;
        let nothing = MultiPolygon(Vec::new());
        let narrow = Closing { limit: sure, sure, solid: &nothing };
        let mut closed = close_gaps(&mut self.open, &narrow);
        self.contours.append(&mut closed.contours);
        let mut gaps = closed.gaps;
        let limit = settings.hole * settings.width;
        if !self.open.is_empty() && limit > sure {
            let solid = wound_region(&self.contours, LEAST_AREA);
            self.open.retain(|chain| match chain.points.last() {
                Some(&at) if runs_inside(chain, &solid) => {
                    losses.push(Loss::Stray { layer: self.index, at, length: chain.length() });
                    false
                }
                _ => true,
            });
            let mut closed = close_gaps(&mut self.open, &Closing { limit, sure, solid: &solid });
            self.contours.append(&mut closed.contours);
            gaps.append(&mut closed.gaps);
        }
        let seen = gaps.into_iter().filter(|&(_, gap)| gap > settings.grid);
        losses.extend(seen.map(|(at, gap)| Loss::ClosedGap { layer: self.index, at, gap }));
    }
}

/// Whether a closed contour encloses next to nothing along a length that would show.
fn is_sheet(contour: &[DVec2], width: f64) -> bool {
    let length = perimeter(contour);
    length > width && signed_area(contour).abs() <= 0.5 * SHEET * width * length
}

/// Whether a point lies off the region and not on its boundary either.
fn is_outside(p: DVec2, region: &MultiPolygon<f64>, width: f64) -> bool {
    Euclidean.distance(&Point(Coord { x: p.x, y: p.y }), region) > SHEET * width
}

fn layer_count(height: f64, layer_height: f64) -> Result<usize, SliceError> {
    let layers = (height / layer_height + 0.5).floor();
    if layers < 1.0 {
        return Err(SliceError::ThinnerThanALayer { height, layer_height });
    }
    if layers > MOST_LAYERS as f64 {
        return Err(SliceError::TooManyLayers { layers, limit: MOST_LAYERS });
    }
    Ok(layers as usize)
}

/// The polygon kernel computes on 30-bit integers over the box of what it is given; its step must be well below the output's.
fn check_width(extent: f64, grid: f64) -> Result<(), SliceError> {
    let limit = 0.25 * grid * f64::from(1 << 29);
    if extent > limit { Err(SliceError::TooWide { extent, limit }) } else { Ok(()) }
}
