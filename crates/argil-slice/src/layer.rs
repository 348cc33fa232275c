use geo_types::{Coord, LineString, MultiPolygon, Polygon};
use glam::DVec2;

/// One layer: the cut through the solid and the wall paths inside it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Layer {
    /// Number of the layer, 0 at the bottom.
    pub index: usize,
    /// Height of the cut in millimetres: the middle of the layer.
    pub cut_z: f64,
    /// Height in millimetres at which the nozzle prints it: the top of the layer.
    pub print_z: f64,
    /// The region that is solid at `cut_z`: disjoint polygons, exteriors counter-clockwise.
    #[cfg_attr(feature = "serde", serde(with = "crate::rings"))]
    pub outline: MultiPolygon<f64>,
    /// Where a bead fits: the outline inset by w/2. Its rings are the first walls, but for the lines there and back along
    /// what is too thin. Of a sheet ([`SliceSettings::surface`](crate::SliceSettings::surface)) it is what its section goes round.
    #[cfg_attr(feature = "serde", serde(with = "crate::rings"))]
    pub walled: MultiPolygon<f64>,
    /// The wall loops: simple, pairwise disjoint, on the output grid.
    pub walls: Vec<WallLoop>,
    /// What of the outline is not, or not quite, printed by these walls.
    pub losses: Vec<Loss>,
}

/// One closed wall path.
///
/// # Example
/// ```
/// use argil_slice::{SliceSettings, WallLoop, mesh::Mesh, slice};
/// let settings = SliceSettings { walls: 2, ..SliceSettings::default() };
/// let layers = slice(&Mesh::cuboid([0.0; 3], [20.0, 20.0, 1.0])?, &settings)?;
/// let inner: &WallLoop = layers[0].walls.iter().find(|wall| wall.wall == 1).ok_or("there are two walls")?;
/// assert!(!inner.hole && inner.depth == 1);
/// assert!(layers[0].walls[inner.parent.ok_or("it lies in the first")?].wall == 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WallLoop {
    /// The vertices in millimetres, on the output grid, without repeating the first at the end.
    /// Counter-clockwise where the loop runs round solid, clockwise (`hole`) where it runs
    /// round a hole.
    pub points: Vec<DVec2>,
    /// The smallest loop that contains this one, as an index into [`Layer::walls`].
    pub parent: Option<usize>,
    /// How many loops contain this one. With one wall its parity is `hole`; further walls of
    /// the same outline nest inside without being holes.
    pub depth: usize,
    /// Which wall of its outline this is: its path runs (`wall` + ½) w inside.
    pub wall: usize,
    /// Whether the loop bounds a hole of the solid.
    pub hole: bool,
    /// Whether part of the outline is too thin for a bead, so that the loop runs nearer to it than w/2 there.
    pub thin: bool,
}

/// Something of the model that the walls of a layer do not print as it is.
///
/// # Example
/// ```
/// use argil_slice::{Loss, SliceSettings, mesh::Mesh, slice};
/// // A sheet of a tenth of a millimetre.
/// let layers = slice(&Mesh::cuboid([0.0; 3], [9.0, 0.1, 2.0])?, &SliceSettings::default())?;
/// assert!(matches!(layers[0].losses[..], [Loss::Vanished { layer: 0, .. }]));
/// assert!((0.0..=0.1).contains(&layers[0].losses[0].at().y));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(tag = "kind", rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Loss {
    /// The cut through the mesh has an end: the mesh has a hole here that is too wide to close without guessing.
    OpenOutline {
        /// The layer.
        layer: usize,
        /// One end of the gap.
        at: DVec2,
        /// Length in millimetres of the piece of outline that is left out.
        length: f64,
        /// Distance in millimetres between its ends.
        gap: f64,
    },
    /// The mesh has a hole here, and the outline was closed with a straight line across it.
    ClosedGap {
        /// The layer.
        layer: usize,
        /// The middle of the gap.
        at: DVec2,
        /// Its width in millimetres.
        gap: f64,
    },
    /// An open piece of surface that bounds nothing was left out: it lies inside the solid, or is too short to show.
    Stray {
        /// The layer.
        layer: usize,
        /// One end of it.
        at: DVec2,
        /// Its length in millimetres.
        length: f64,
    },
    /// Contours that overlap were made one: bodies that overlap, or lie inside each other.
    Overlap {
        /// The layer.
        layer: usize,
        /// A point of it.
        at: DVec2,
        /// The area in square millimetres that is solid more than once.
        area: f64,
    },
    /// A surface is inside out in a way that could not be put right: where it overlaps another body, there is a hole.
    InsideOut {
        /// The layer.
        layer: usize,
        /// A point of it or near it.
        at: DVec2,
        /// The area in square millimetres.
        area: f64,
    },
    /// An outline is everywhere thinner than a bead: its wall runs along the middle, less than w/2 inside, and
    /// prints it wider than it is.
    Thin {
        /// The layer.
        layer: usize,
        /// A point inside the outline.
        at: DVec2,
        /// The outline's area in square millimetres.
        area: f64,
        /// How far inside the outline the wall gets, in millimetres.
        inset: f64,
    },
    /// An outline is so thin or small that it gets no wall at all.
    Vanished {
        /// The layer.
        layer: usize,
        /// A point inside the outline.
        at: DVec2,
        /// The outline's area in square millimetres; 0 for a sheet that has two sides and nothing between them.
        area: f64,
    },
    /// Part of an outline is thinner than a bead: its wall runs there and back along the middle, and
    /// prints it wider than it is.
    Narrow {
        /// The layer.
        layer: usize,
        /// A point half way along.
        at: DVec2,
        /// Length in millimetres of the middle line.
        length: f64,
    },
    /// Part of an outline is not printed, since it is too thin for a line along its middle.
    Branch {
        /// The layer.
        layer: usize,
        /// A point inside the part.
        at: DVec2,
        /// The part's area in square millimetres.
        area: f64,
    },
    /// The section of a sheet has two ends: it is printed there and back, as two lanes in one bead.
    OpenSheet {
        /// The layer.
        layer: usize,
        /// A point on it.
        at: DVec2,
        /// Its length in millimetres.
        length: f64,
    },
    /// Wall loops that would touch themselves or others after rounding, and were left out.
    Unsound {
        /// The layer.
        layer: usize,
        /// A point on the loop.
        at: DVec2,
        /// Length of the loops in millimetres.
        length: f64,
    },
}

impl Loss {
    /// The layer that it concerns.
    #[must_use]
    pub fn layer(&self) -> usize {
        match *self {
            Self::OpenOutline { layer, .. }
            | Self::ClosedGap { layer, .. }
            | Self::Stray { layer, .. }
            | Self::Overlap { layer, .. }
            | Self::InsideOut { layer, .. }
            | Self::Thin { layer, .. }
            | Self::Vanished { layer, .. }
            | Self::Narrow { layer, .. }
            | Self::Branch { layer, .. }
            | Self::OpenSheet { layer, .. }
            | Self::Unsound { layer, .. } => layer,
        }
    }

    /// Where it is, in millimetres.
    #[must_use]
    pub fn at(&self) -> DVec2 {
        match *self {
            Self::OpenOutline { at, .. }
            | Self::ClosedGap { at, .. }
            | Self::Stray { at, .. }
            | Self::Overlap { at, .. }
            | Self::InsideOut { at, .. }
            | Self::Thin { at, .. }
            | Self::Vanished { at, .. }
            | Self::Narrow { at, .. }
            | Self::Branch { at, .. }
            | Self::OpenSheet { at, .. }
            | Self::Unsound { at, .. } => at,
        }
    }
}

/// The regions that the outermost wall loops enclose, holes filled: what the safeguard dilates.
///
/// # Example
/// ```
/// use argil_slice::{outer_walls, slice, SliceSettings};
/// use argil_slice::mesh::Mesh;
/// let mesh = Mesh::cuboid([0.0; 3], [20.0, 20.0, 4.0])?;
/// let layers = slice(&mesh, &SliceSettings::default())?;
/// let filled = outer_walls(&layers[0]);
/// assert_eq!(filled.0.len(), 1);
/// assert!(filled.0[0].interiors().is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn outer_walls(layer: &Layer) -> MultiPolygon<f64> {
    let filled = layer.walls.iter().filter(|wall| wall.parent.is_none()).map(|wall| {
        let ring: Vec<Coord<f64>> = wall.points.iter().map(|p| Coord { x: p.x, y: p.y }).collect();
        Polygon::new(LineString(ring), Vec::new())
    });
    MultiPolygon(filled.collect())
}
