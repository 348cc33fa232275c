use argil_curve::{DVec2, Segment, SegmentIndex, self_crossings, without_needles};
use argil_fill::{Fill, FillOptions, FillPattern, fill};
use argil_safeguard::{SafeguardSettings, safeguards};
use geo::{Area, BooleanOps, Contains, Distance, Euclidean, Point};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};

use crate::Draw;

/// The bead's width, mm.
const WIDTH: f64 = 1.5;

/// Nearer to the edge of its region, in w, is no middle of a bead: half a bead but for what a corner that is cut off takes.
const NEAREST: f64 = 0.47;

/// Most shapes that a region is made of.
const MOST_SHAPES: usize = 8;

/// The kernel rounds to a hundredth of a micrometre at these sizes.
const ROUNDING: f64 = 1e-5;

/// What is thinner has no side, mm.
const THINNEST: f64 = 1e-6;

/// Offsets of any region, inward and outward: its fill crosses nothing and stays inside, its safeguard keeps its distance.
pub fn offsets(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let pattern = if draw.flag() { FillPattern::Spirals } else { FillPattern::Rings };
    let options = FillOptions { pattern, walls: draw.below(4), ..FillOptions::for_width(WIDTH) };
    let region = region(&mut draw);
    if let Ok(fill) = fill(&region, &[], &options, &[]) {
        is_sound(&without_slits(&region), &fill, &options);
    }
    keeps_its_distance(&region);
}

/// Shapes that may overlap, less others.
fn region(draw: &mut Draw<'_>) -> MultiPolygon<f64> {
    let mut region = MultiPolygon(Vec::new());
    for _ in 0..MOST_SHAPES {
        if draw.is_empty() {
            break;
        }
        let (hollow, shape) = (draw.below(3) == 2, shape(draw));
        region = if hollow { region.difference(&shape) } else { region.union(&shape) };
    }
    region
}

/// A star with two radii, so a disc, a polygon or a star; or a polygon with corners on a lattice, which may cross itself.
fn shape(draw: &mut Draw<'_>) -> MultiPolygon<f64> {
    let corners = 3 + draw.below(22);
    let ring: Vec<Coord<f64>> = if draw.flag() {
        let lattice = (0..corners.min(6)).map(|_| draw.lattice_point(12));
        lattice.map(|p| Coord { x: p.x, y: p.y }).collect()
    } else {
        let (centre, radius) = (draw.point(12.0), draw.within(0.2, 14.0));
        let (inner, turn) = (draw.within(0.2, 1.0), draw.within(0.0, 6.3));
        let corner = |k: usize| {
            let angle = turn + k as f64 * std::f64::consts::TAU / corners as f64;
            let p =
                centre + radius * if k.is_multiple_of(2) { 1.0 } else { inner } * DVec2::from_angle(angle);
            Coord { x: p.x, y: p.y }
        };
        (0..corners).map(corner).collect()
    };
    // What is united with nothing is a valid region.
    MultiPolygon(vec![Polygon::new(LineString(ring), Vec::new())]).union(&MultiPolygon(Vec::new()))
}

/// The region without slits and needles that have no width, and without what is nothing else: there is nothing between their sides.
fn without_slits(region: &MultiPolygon<f64>) -> MultiPolygon<f64> {
    let whole = |ring: &LineString<f64>| -> Option<LineString<f64>> {
        let points: Vec<DVec2> = ring.0.iter().skip(1).map(|c| DVec2::new(c.x, c.y)).collect();
        let kept = without_needles(&points);
        (kept.len() >= 3).then(|| kept.into_iter().map(|p| Coord { x: p.x, y: p.y }).collect())
    };
    let polygon = |p: &Polygon<f64>| {
        Some(Polygon::new(whole(p.exterior())?, p.interiors().iter().filter_map(whole).collect()))
    };
    MultiPolygon(region.iter().filter_map(polygon).collect())
}

fn rings(region: &MultiPolygon<f64>) -> impl Iterator<Item = &LineString<f64>> {
    region.iter().flat_map(|polygon| std::iter::once(polygon.exterior()).chain(polygon.interiors()))
}

fn distance(region: &MultiPolygon<f64>, p: DVec2) -> f64 {
    let to = |ring: &LineString<f64>| Euclidean.distance(&Point::new(p.x, p.y), ring);
    rings(region).map(to).fold(f64::INFINITY, f64::min)
}

fn is_sound(region: &MultiPolygon<f64>, fill: &Fill, options: &FillOptions) {
    assert_eq!(fill.joints.len() + fill.curves.len(), fill.figures.rings, "the joints are no tree");
    let edges = rings(region)
        .flat_map(LineString::lines)
        .map(|line| Segment::new(DVec2::new(line.start.x, line.start.y), DVec2::new(line.end.x, line.end.y)));
    let edges = SegmentIndex::new(edges.collect(), WIDTH);
    let mut earlier: Vec<Segment> = Vec::new();
    for curve in &fill.curves {
        let points = &curve.points;
        assert_eq!((curve.beads.len(), curve.flow.len()), (points.len(), points.len()));
        assert!(self_crossings(points).is_empty(), "a curve crosses itself");
        let others = SegmentIndex::new(earlier.clone(), WIDTH);
        for k in 0..points.len() {
            let side = Segment::new(points[k], points[(k + 1) % points.len()]);
            let steps = points[k] / options.grid;
            assert!((steps - steps.round()).abs().max_element() < 1e-3, "{} is off the grid", points[k]);
            assert!(
                distance(region, points[k]) > NEAREST * WIDTH,
                "the bead at {} leaves the region",
                points[k]
            );
            others.for_each_near(side, 0.0, |_, other| {
                assert!(!side.crosses(&other), "two curves cross at {side:?}")
            });
            edges.for_each_near(side, 0.0, |_, edge| {
                assert!(!side.crosses(&edge), "{side:?} leaves the region")
            });
            earlier.push(side);
        }
    }
}

fn keeps_its_distance(region: &MultiPolygon<f64>) {
    let settings = SafeguardSettings::for_width(WIDTH);
    let envelope = safeguards(&[region.clone(), MultiPolygon(Vec::new())], &settings);
    for line in rings(region).flat_map(LineString::lines) {
        let length = line.dx().hypot(line.dy());
        // The end of what has no width.
        if length < THINNEST {
            continue;
        }
        let inward = Coord { x: -line.dy(), y: line.dx() } * (THINNEST / length);
        for p in [0.1, 0.5, 0.9].map(|share| line.start + line.delta() * share) {
            // A needle without any width is no wall.
            if !region.contains(&Point::from(p + inward)) {
                continue;
            }
            assert!(envelope[0].contains(&Point::from(p)), "{p:?} is outside of its safeguard");
            let away = distance(&envelope[0], DVec2::new(p.x, p.y));
            assert!(away >= settings.dilation - ROUNDING, "the safeguard is {away} mm from {p:?}");
        }
    }
    assert!(envelope[1].unsigned_area() <= envelope[0].unsigned_area(), "a safeguard grows without a wall");
}
