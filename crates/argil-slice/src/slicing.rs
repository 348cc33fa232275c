use crate::chain::{Linker, OpenChain};
use crate::gaps::{Closing, close_gaps, runs_inside};
use crate::layer::{Layer, Loss};
use crate::region::{perimeter, signed_area, wound_region};
use crate::section::Sweep;
use crate::settings::MOST_LAYERS;
use crate::wall::{Walls, walls};
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
    let sections = sections(mesh, settings)?;
    #[cfg(feature = "rayon")]
    let sections = sections.into_par_iter();
    #[cfg(not(feature = "rayon"))]
    let sections = sections.into_iter();
    Ok(sections.map(|section| section.layer(settings)).collect())
}

/// What is solid at the height of one cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Height of the cut in millimetres.
    pub cut_z: f64,
    /// As [`Layer::outline`].
    pub region: MultiPolygon<f64>,
}

/// The outlines of [`slice`]'s layers by themselves, for those who want no walls in them: most of the work is theirs.
///
/// # Errors
/// As [`slice`].
///
/// # Complexity
/// O(triangles + crossings of planes with triangles), and near linear in the vertices of each outline.
///
/// # Example
/// ```
/// use argil_slice::{mesh::Mesh, outlines, SliceSettings};
/// let corners = vec![[0.0; 3], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]];
/// let pyramid = Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]).unwrap();
/// let outlines = outlines(&pyramid, &SliceSettings::default())?;
/// assert_eq!((outlines.len(), outlines[0].cut_z), (18, 0.25));
/// # Ok::<(), argil_slice::SliceError>(())
/// ```
pub fn outlines(mesh: &Mesh, settings: &SliceSettings) -> Result<Vec<Outline>, SliceError> {
    let sections = sections(mesh, settings)?;
    #[cfg(feature = "rayon")]
    let sections = sections.into_par_iter();
    #[cfg(not(feature = "rayon"))]
    let sections = sections.into_iter();
    let outline = |mut section: UnclosedSection| {
        let cut_z = section.cut_z;
        let mut losses = Vec::new();
        section.close(settings, &mut losses);
        Outline { cut_z, region: wound_region(section.contours, LEAST_AREA) }
    };
    Ok(sections.map(outline).collect())
}

/// The cuts of all layers, bottom first.
fn sections(mesh: &Mesh, settings: &SliceSettings) -> Result<Vec<UnclosedSection>, SliceError> {
    settings.check()?;
    let bounds = mesh.bounds();
    let [wide, deep, height] = bounds.size();
    check_width(wide.max(deep), settings.grid)?;
    let layers = layer_count(height, settings.layer_height)?;
    let bottom = bounds.min[2];
    let planes: Vec<f64> = (0..layers).map(|n| bottom + (n as f64 + 0.5) * settings.layer_height).collect();

    let mesh = mesh.oriented();
    let edges = mesh.edges();
    let mut sweep = Sweep::new(&mesh, &edges, &planes);
    let mut linker = Linker::new(edges.ends().len());
    let mut cuts = Vec::new();
    let mut sections = Vec::with_capacity(layers);
    for (index, &cut_z) in planes.iter().enumerate() {
        sweep.advance(&mut cuts);
        let (contours, open) = linker.link(&cuts);
        let print_z = bottom + (index as f64 + 1.0) * settings.layer_height;
        sections.push(UnclosedSection { index, cut_z, print_z, contours, open });
    }
    Ok(sections)
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
        let index = self.index;
        let width = settings.width;
        let mut losses = Vec::new();
        self.close(settings, &mut losses);
        let sheets: Vec<Vec<DVec2>> =
            self.contours.iter().filter(|contour| is_sheet(contour, width)).cloned().collect();
        let outline = wound_region(self.contours, LEAST_AREA);
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

    /// Closes contours across gaps: narrow ones first, then wider ones, where that leaves little to guess.
    fn close(&mut self, settings: &SliceSettings, losses: &mut Vec<Loss>) {
        if self.open.is_empty() {
            return;
        }
        let sure = settings.gap * settings.width;
        let nothing = MultiPolygon(Vec::new());
        let narrow = Closing { limit: sure, sure, solid: &nothing };
        let mut closed = close_gaps(&mut self.open, &narrow);
        self.contours.append(&mut closed.contours);
        let mut gaps = closed.gaps;
        let limit = settings.hole * settings.width;
        if !self.open.is_empty() && limit > sure {
            let solid = wound_region(self.contours.clone(), LEAST_AREA);
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
