use glam::{DAffine2, DVec2};
use roxmltree::Node;
use svgtypes::{PathParser, PathSegment, PointsParser, SimplePathSegment, SimplifyingPathParser};

use super::attribute::{coordinate, line, unreadable};
use crate::LayersError;

/// Coordinates beyond this are refused, in millimetres.
const LARGEST: f64 = 1e6;

/// Numbers beyond this are refused before anything is made of them; any page with a unit of its own is far below.
const LARGEST_NUMBER: f64 = 1e9;

/// The finest chords, in millimetres.
const LEAST_CHORD_ERROR: f64 = 1e-4;

/// Ends of a contour closer than this, in millimetres, are one point: what is written with three digits.
const CLOSED: f64 = 2e-3;

pub(super) fn is_shape(element: &str) -> bool {
    ["path", "polygon", "polyline", "rect", "circle", "ellipse"].contains(&element)
}

/// A shape in its layer.
pub(super) struct Shape<'a, 'i> {
    pub(super) node: Node<'a, 'i>,
    pub(super) layer: usize,
    /// From its coordinates to millimetres.
    pub(super) transform: DAffine2,
    pub(super) chord_error: f64,
}

impl Shape<'_, '_> {
    /// Its closed contours of at most so many points.
    pub(super) fn contours(&self, most: usize) -> Result<Vec<Vec<DVec2>>, LayersError> {
        let mut pen = Pen { shape: self, contours: Vec::new(), points: Vec::new(), left: most };
        match self.node.tag_name().name() {
            "path" => self.path(&mut pen)?,
            "rect" => self.rectangle(&mut pen)?,
            "circle" => {
                let radius = coordinate(self.node, "r")?;
                self.ellipse(&mut pen, DVec2::splat(radius))?;
            }
            "ellipse" => {
                let radii = DVec2::new(coordinate(self.node, "rx")?, coordinate(self.node, "ry")?);
                self.ellipse(&mut pen, radii)?;
            }
            kind => self.polygon(&mut pen, kind == "polygon")?,
        }
        Ok(pen.contours)
    }

    fn path(&self, pen: &mut Pen<'_, '_, '_>) -> Result<(), LayersError> {
        let text = self.node.attribute("d").unwrap_or_default();
        // Arcs of any radius would be made into any number of curves.
        for segment in PathParser::from(text) {
            let segment = segment.map_err(|why| unreadable(self.node, "d", &why))?;
            if !numbers(&segment).into_iter().all(|number| number.abs() <= LARGEST_NUMBER) {
                return Err(self.far());
            }
        }
        let mut at = DVec2::ZERO;
        for segment in SimplifyingPathParser::from(text) {
            match segment.map_err(|why| unreadable(self.node, "d", &why))? {
                SimplePathSegment::MoveTo { x, y } => {
                    pen.end(false)?;
                    at = DVec2::new(x, y);
                    pen.to(self.placed(at))?;
                }
                SimplePathSegment::LineTo { x, y } => {
                    at = DVec2::new(x, y);
                    pen.to(self.placed(at))?;
                }
                SimplePathSegment::Quadratic { x1, y1, x, y } => {
                    let (middle, end) = (DVec2::new(x1, y1), DVec2::new(x, y));
                    // The same curve as a cubic.
                    let handles = [at, end].map(|p| p + (middle - p) * (2.0 / 3.0));
                    pen.curve([at, handles[0], handles[1], end].map(|p| self.placed(p)))?;
                    at = end;
                }
                SimplePathSegment::CurveTo { x1, y1, x2, y2, x, y } => {
                    let end = DVec2::new(x, y);
                    pen.curve([at, DVec2::new(x1, y1), DVec2::new(x2, y2), end].map(|p| self.placed(p)))?;
                    at = end;
                }
                SimplePathSegment::ClosePath => pen.end(true)?,
            }
        }
        pen.end(false)
    }

    fn polygon(&self, pen: &mut Pen<'_, '_, '_>, is_closed: bool) -> Result<(), LayersError> {
        let text = self.node.attribute("points").unwrap_or_default();
        if svgtypes::NumberListParser::from(text).any(|number| number.is_err()) {
            return Err(unreadable(self.node, "points", &"a list of numbers is needed"));
        }
        if svgtypes::NumberListParser::from(text).count() % 2 == 1 {
            return Err(unreadable(self.node, "points", &"the last point has no y"));
        }
        for (x, y) in PointsParser::from(text) {
            pen.to(self.placed(DVec2::new(x, y)))?;
        }
        pen.end(is_closed)
    }

    fn rectangle(&self, pen: &mut Pen<'_, '_, '_>) -> Result<(), LayersError> {
        for corner in ["rx", "ry"] {
            if coordinate(self.node, corner)? != 0.0 {
                return Err(LayersError::Unsupported {
                    layer: self.layer,
                    line: line(self.node),
                    what: "a rectangle with round corners is not read; convert it to a path".to_owned(),
                });
            }
        }
        let low = DVec2::new(coordinate(self.node, "x")?, coordinate(self.node, "y")?);
        let size = DVec2::new(coordinate(self.node, "width")?, coordinate(self.node, "height")?);
        for corner in [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y] {
            pen.to(self.placed(low + size * corner))?;
        }
        pen.end(true)
    }

    fn ellipse(&self, pen: &mut Pen<'_, '_, '_>, radii: DVec2) -> Result<(), LayersError> {
        let middle = DVec2::new(coordinate(self.node, "cx")?, coordinate(self.node, "cy")?);
        let axes = [DVec2::X, DVec2::Y].map(|axis| self.transform.transform_vector2(axis * radii));
        // The longest radius is at most the diagonal of the half axes.
        let radius = axes[0].length().hypot(axes[1].length());
        if radius.is_nan() || radius > LARGEST {
            return Err(self.far());
        }
        let ratio = (self.chord_error.max(LEAST_CHORD_ERROR) / radius.max(LEAST_CHORD_ERROR)).min(0.5);
        // At most 230,000, with both bounds.
        let count = (std::f64::consts::PI / (1.0 - ratio).acos()).ceil() as usize;
        for k in 0..count {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            pen.to(self.placed(middle + DVec2::from_angle(angle) * radii))?;
        }
        pen.end(true)
    }

    fn placed(&self, p: DVec2) -> DVec2 {
        self.transform.transform_point2(p)
    }

    fn far(&self) -> LayersError {
        LayersError::Far { layer: self.layer, line: line(self.node), limit: LARGEST }
    }
}

/// The numbers of a segment, with those of its kind that are none left at 0.
fn numbers(segment: &PathSegment) -> [f64; 6] {
    match *segment {
        PathSegment::MoveTo { x, y, .. }
        | PathSegment::LineTo { x, y, .. }
        | PathSegment::SmoothQuadratic { x, y, .. } => [x, y, 0.0, 0.0, 0.0, 0.0],
        PathSegment::HorizontalLineTo { x, .. } => [x, 0.0, 0.0, 0.0, 0.0, 0.0],
        PathSegment::VerticalLineTo { y, .. } => [0.0, y, 0.0, 0.0, 0.0, 0.0],
        PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => [x1, y1, x2, y2, x, y],
        PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => [x2, y2, x, y, 0.0, 0.0],
        PathSegment::Quadratic { x1, y1, x, y, .. } => [x1, y1, x, y, 0.0, 0.0],
        PathSegment::EllipticalArc { rx, ry, x_axis_rotation, x, y, .. } => {
            [rx, ry, x_axis_rotation, x, y, 0.0]
        }
        PathSegment::ClosePath { .. } => [0.0; 6],
    }
}

/// Whether a point is a place at all; what is not a number is none.
fn is_near(p: DVec2) -> bool {
    p.to_array().iter().all(|value| value.abs() <= LARGEST)
}

/// Draws contours point by point.
struct Pen<'s, 'a, 'i> {
    shape: &'s Shape<'a, 'i>,
    contours: Vec<Vec<DVec2>>,
    points: Vec<DVec2>,
    /// How many more points may come.
    left: usize,
}

impl Pen<'_, '_, '_> {
    fn to(&mut self, p: DVec2) -> Result<(), LayersError> {
        if !is_near(p) {
            return Err(self.shape.far());
        }
        self.left = self
            .left
            .checked_sub(1)
            .ok_or(LayersError::TooMany { what: "points", limit: super::drawing::MOST_POINTS })?;
        self.points.push(p);
        Ok(())
    }

    /// A cubic curve from where the pen is, as chords.
    ///
    /// A chord over a step of 1/n lies beside the curve by at most an eighth of the second derivative, divided by n².
    fn curve(&mut self, [start, a, b, end]: [DVec2; 4]) -> Result<(), LayersError> {
        if ![a, b].into_iter().all(is_near) {
            return Err(self.shape.far());
        }
        let bend = (start - 2.0 * a + b).length().max((a - 2.0 * b + end).length());
        // At most 250,000, with both bounds.
        let count =
            (0.75 * bend / self.shape.chord_error.max(LEAST_CHORD_ERROR)).sqrt().ceil().max(1.0) as usize;
        for k in 1..count {
            let t = k as f64 / count as f64;
            let [p, q, r] = [start.lerp(a, t), a.lerp(b, t), b.lerp(end, t)];
            self.to(p.lerp(q, t).lerp(q.lerp(r, t), t))?;
        }
        self.to(end)
    }

    /// Ends a contour, if one was begun; what is not closed by itself has to end where it began.
    fn end(&mut self, is_closed: bool) -> Result<(), LayersError> {
        let mut points = std::mem::take(&mut self.points);
        let [Some(&first), Some(&last)] = [points.first(), points.last()] else { return Ok(()) };
        let gap = first.distance(last);
        // A single point is a move to where the next contour begins.
        if !is_closed && points.len() > 1 && gap > CLOSED {
            return Err(LayersError::Open {
                layer: self.shape.layer,
                line: line(self.shape.node),
                gap,
                ends: [first, last].map(|p| p.to_array()),
            });
        }
        if points.len() > 1 && gap <= CLOSED {
            points.pop();
        }
        if points.len() > 2 {
            self.contours.push(points);
        }
        Ok(())
    }
}
