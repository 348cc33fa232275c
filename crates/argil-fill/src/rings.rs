//! The rings of a region: its boundary inset by (k + ½) w, level by level, and what stays bare between them.

use argil_curve::{DVec2, Segment, SegmentIndex};
use geo::Area;
use geo_types::{Coord, MultiPolygon, Polygon};

use crate::bare::holds;
use crate::contour::{Spot, contours};
use crate::nearest::Nearest;
use crate::offset::{opened_inset, rings};
use crate::options::MOST_RINGS;
use crate::plot::Plot;
use crate::residue::strips;
use crate::ring::{Ring, plainer, ring_on_grid, rings_round};
use crate::{FillError, FillOptions};

/// Radius of the disc that fits everywhere into what a ring goes round, in w: what is thinner would cross itself once it is simplified.
const SLIGHT: f64 = 0.02;

/// Paths so near to the edge of their region, in w, are no insets by half a bead.
const WHOLE: f64 = 0.45;

/// Rings shorter than this are blobs, in w.
const LEAST_LENGTH: f64 = 0.5;

/// What an edge may be moved by between two levels, in w.
const PLAINER: f64 = 0.005;

/// Distance of the points of a plot, in w: so much, or less down to so much for a plot of few points.
const STEP: f64 = 0.2;
const LEAST_STEP: f64 = 0.05;
const FEW_POINTS: f64 = 3000.0;

/// Where the middle of a bead may be in one part of a region.
#[derive(Debug)]
pub(crate) struct Core {
    pub(crate) sides: Vec<Segment>,
    pub(crate) plot: Plot,
}

/// The rings of a region, outermost first.
#[derive(Debug)]
pub(crate) struct Rings {
    pub(crate) rings: Vec<Ring>,
    /// What the outermost rings go round.
    pub(crate) outline: MultiPolygon<f64>,
    /// The same, part by part.
    pub(crate) cores: Vec<Core>,
}

/// All rings of a region: insets of its boundary, and loops there and back in the strips between them.
///
/// Walls are offsets of polygons; rings inside of them are lines of equal distance from the innermost wall.
///
/// # Complexity
/// Two offsets a wall, and for what is inside near linear in its area.
pub(crate) fn rings_of(
    region: &MultiPolygon<f64>,
    edges: &SegmentIndex,
    options: &FillOptions,
) -> Result<Rings, FillError> {
    let w = options.width;
    let mut outline = opened_inset(region, 0.5 * w, SLIGHT * w, w);
    // The kernel leaves scraps at sharp corners of what is smaller than the offset.
    outline.0.retain(|polygon| {
        let sides = sides_of(polygon);
        sides.iter().all(|side| !edges.is_within(side.start, WHOLE * w))
            && sides.first().is_some_and(|side| holds(edges.segments(), side.start))
    });
    let mut found: Vec<Ring> = Vec::new();
    let mut innermost = outline.clone();
    for number in 0..options.walls.max(1) {
        if number > 0 {
            let plain = innermost.iter().map(|polygon| plainer(polygon, PLAINER * w)).collect();
            innermost = opened_inset(&MultiPolygon(plain), w, SLIGHT * w, w);
        }
        if innermost.0.is_empty() {
            break;
        }
        // A wall's rings are wanted however short; they too are dropped below three points.
        let (wall, least) =
            if number < options.walls { (Some(number), 0.0) } else { (None, LEAST_LENGTH * w) };
        let round = innermost.iter().flat_map(|polygon| rings_round(polygon, w, options.grid, least));
        found.extend(round.map(|points| Ring { points, wall }));
        if found.len() > MOST_RINGS {
            return Err(FillError::TooManyRings { limit: MOST_RINGS });
        }
    }
    let mut cores = Vec::new();
    for polygon in &outline {
        cores.extend(plotted(polygon, w)?);
    }
    if options.walls > 1 {
        for polygon in &innermost {
            if let Some(part) = plotted(polygon, w)? {
                found.extend(inner_rings(&part, options));
            }
        }
    } else {
        found.extend(cores.iter().flat_map(|core| inner_rings(core, options)));
    }
    let laid: Vec<Segment> = found.iter().flat_map(|ring| sides(&ring.points)).collect();
    for core in &cores {
        // A residue loop beside a wall is fill, too.
        let loops = strips(&Nearest::new(&core.plot, &laid), options);
        found.extend(loops.into_iter().map(|points| Ring { points, wall: None }));
    }
    if found.len() > MOST_RINGS {
        return Err(FillError::TooManyRings { limit: MOST_RINGS });
    }
    Ok(Rings { rings: found, outline, cores })
}

/// A polygon with a grid of points.
fn plotted(polygon: &Polygon<f64>, width: f64) -> Result<Option<Core>, FillError> {
    let sides = sides_of(polygon);
    let step = (polygon.unsigned_area() / FEW_POINTS).sqrt().clamp(LEAST_STEP * width, STEP * width);
    Ok(Plot::new(&sides, step)?.map(|plot| Core { sides, plot }))
}

/// The sides of a polygon and of its holes.
pub(crate) fn sides_of(polygon: &Polygon<f64>) -> Vec<Segment> {
    let corner = |c: Coord<f64>| DVec2::new(c.x, c.y);
    let lines = rings(polygon).flat_map(|ring| ring.lines());
    lines.map(|line| Segment::new(corner(line.start), corner(line.end))).collect()
}

/// The rings inside of a ring's path, one width apart.
fn inner_rings(part: &Core, options: &FillOptions) -> Vec<Ring> {
    let w = options.width;
    let slight = SLIGHT * w;
    let plot = &part.plot;
    let nearest = Nearest::new(plot, &part.sides);
    let spot = |column: usize, row: usize| Spot {
        at: plot.at(column, row),
        distance: nearest.distance(column, row),
        site: nearest.site(column, row),
        level: 0.0,
    };
    let cells =
        plot.runs.iter().flat_map(|&(row, first, last)| (first - 1..=last).map(move |column| (column, row)));
    let corners_of = |column: usize, row: usize| {
        let corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
        let (mut lowest, mut highest) = (f64::INFINITY, 0.0_f64);
        for (column, row) in corners {
            let distance = nearest.distance(column, row);
            (lowest, highest) = (lowest.min(distance), highest.max(distance));
        }
        let level = ((highest - slight) / w).floor() * w;
        (level > 0.0 && lowest <= level + slight)
            .then(|| corners.map(|(column, row)| Spot { level, ..spot(column, row) }))
    };
    let distance = |column, row| nearest.distance(column, row);
    let lines = contours(cells, nearest.sites, plot.step, slight, corners_of, distance);
    let mut leveled: Vec<(f64, Vec<DVec2>)> = lines
        .into_iter()
        .filter_map(|(level, points)| {
            ring_on_grid(points, w, options.grid, LEAST_LENGTH * w).map(|points| (level, points))
        })
        .collect();
    leveled.sort_by(|a, b| a.0.total_cmp(&b.0));
    leveled.into_iter().map(|(_, points)| Ring { points, wall: None }).collect()
}

/// The sides of a ring.
fn sides(points: &[DVec2]) -> impl Iterator<Item = Segment> + '_ {
    (0..points.len()).map(|k| Segment::new(points[k], points[(k + 1) % points.len()]))
}
