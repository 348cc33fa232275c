//! A layer of loops that come from elsewhere.

use argil_curve::{ClosedCurve, on_grid};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};
use glam::DVec2;

use crate::{Layer, WallLoop};

impl Layer {
    /// The layer that another slicer's wall paths make: the lines that the middle of the bead follows, `height` mm high and printed
    /// at `print_z`, rounded to `grid`.
    ///
    /// What contains what is found here, and loops are turned so that every second one inwards bounds a hole. The outline is not known
    /// here: it is taken to be where the bead's middle goes, half a bead inside. Loops must be simple and disjoint on the grid. One
    /// that is no closed curve is kept as it is, and a plan of the layer fails with its place.
    ///
    /// # Complexity
    /// O(n · p) for n loops with p points in all.
    ///
    /// # Example
    /// ```
    /// use argil_slice::{DVec2, Layer};
    ///
    /// let square = |half: f64| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|c| half * DVec2::from(c)).to_vec();
    /// let layer = Layer::of_loops(0, 0.5, 0.5, &[square(4.0), square(8.0)], 1e-4);
    /// assert_eq!(layer.walls[0].parent, Some(1));
    /// assert!(layer.walls[0].hole && !layer.walls[1].hole);
    /// assert_eq!(layer.outline.0[0].interiors().len(), 1);
    /// ```
    #[must_use]
    pub fn of_loops(index: usize, print_z: f64, height: f64, loops: &[Vec<DVec2>], grid: f64) -> Self {
        let on_grid = |p: &DVec2| on_grid(*p, grid);
        let points: Vec<Vec<DVec2>> = loops.iter().map(|l| l.iter().map(on_grid).collect()).collect();
        let curves: Vec<Option<ClosedCurve>> =
            points.iter().map(|points| ClosedCurve::new(points.clone()).ok()).collect();
        let size = |k: usize| curves[k].as_ref().map_or(0.0, |curve| curve.signed_area().abs());
        let contains = |outer: usize, inner: usize| {
            let (Some(around), Some(first)) = (&curves[outer], points[inner].first()) else { return false };
            outer != inner && size(outer) > size(inner) && around.contains(*first)
        };
        let around: Vec<Vec<usize>> = (0..points.len())
            .map(|inner| (0..points.len()).filter(|&outer| contains(outer, inner)).collect())
            .collect();
        let walls: Vec<WallLoop> = around
            .iter()
            .zip(points)
            .enumerate()
            .map(|(k, (around, mut points))| {
                let hole = around.len() % 2 == 1;
                if curves[k].as_ref().is_some_and(|curve| (curve.signed_area() < 0.0) != hole) {
                    points.reverse();
                }
                let parent = around.iter().copied().min_by(|&a, &b| size(a).total_cmp(&size(b)));
                WallLoop { points, parent, depth: around.len(), wall: 0, hole, thin: false }
            })
            .collect();
        let outline = solid(&walls);
        Self {
            index,
            cut_z: print_z - 0.5 * height,
            print_z,
            walled: outline.clone(),
            outline,
            walls,
            losses: Vec::new(),
        }
    }

    /// The same of the rings of polygons: the exterior and the interiors of each are wall paths.
    ///
    /// # Complexity
    /// As of [`Layer::of_loops`].
    ///
    /// # Example
    /// ```
    /// use argil_slice::Layer;
    /// use geo_types::{LineString, MultiPolygon, Polygon, Rect};
    ///
    /// let window = LineString::from(vec![(4.0, 4.0), (8.0, 4.0), (8.0, 8.0), (4.0, 8.0)]);
    /// let around = Rect::new((0.0, 0.0), (12.0, 12.0)).to_polygon().exterior().clone();
    /// let layer = Layer::of_region(0, 0.5, 0.5, &Polygon::new(around, vec![window]).into(), 1e-4);
    /// assert_eq!(layer.walls.iter().map(|wall| wall.hole).collect::<Vec<_>>(), [false, true]);
    ///
    /// let back: Vec<LineString> = layer.walls.iter().map(LineString::from).collect();
    /// assert!(back.iter().all(LineString::is_closed));
    /// ```
    #[must_use]
    pub fn of_region(index: usize, print_z: f64, height: f64, region: &MultiPolygon<f64>, grid: f64) -> Self {
        let rings = region.iter().flat_map(|part| std::iter::once(part.exterior()).chain(part.interiors()));
        let loops: Vec<Vec<DVec2>> = rings.map(corners).collect();
        Self::of_loops(index, print_z, height, &loops, grid)
    }
}

/// The vertices of a ring, the first not repeated at the end.
fn corners(ring: &LineString<f64>) -> Vec<DVec2> {
    let repeated = usize::from(ring.0.len() > 1 && ring.is_closed());
    ring.coords().take(ring.0.len() - repeated).map(|c| DVec2::new(c.x, c.y)).collect()
}

impl From<&WallLoop> for LineString<f64> {
    /// The wall as a closed line, its first point repeated at the end.
    fn from(wall: &WallLoop) -> Self {
        wall.points.iter().chain(wall.points.first()).map(|p| Coord { x: p.x, y: p.y }).collect()
    }
}

/// What lies inside walls that bound no hole, without the holes directly inside them.
fn solid(walls: &[WallLoop]) -> MultiPolygon<f64> {
    let ring = |wall: &WallLoop| LineString(wall.points.iter().map(|p| Coord { x: p.x, y: p.y }).collect());
    let polygon = |(k, wall): (usize, &WallLoop)| {
        let holes = walls.iter().filter(|inner| inner.parent == Some(k));
        Polygon::new(ring(wall), holes.map(ring).collect())
    };
    MultiPolygon(walls.iter().enumerate().filter(|(_, wall)| !wall.hole).map(polygon).collect())
}
