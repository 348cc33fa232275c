//! Lines, regions and points as SVG: one element a line and none of them blank, so that it can stand in a page of documentation.

use std::fmt::Write;

use argil::curve::{ArcSpan, ClosedCurve, DVec2};
use geo_types::MultiPolygon;

pub(crate) const WALL: &str = "#b5563a";
pub(crate) const SUPPORT: &str = "#4f6d94";
pub(crate) const CONNECTION: &str = "#c2912f";
pub(crate) const DARK: &str = "#2b2320";
pub(crate) const PALE: &str = "#c9beb4";

/// A drawing in millimetres, y upwards.
pub(crate) struct Drawing {
    low: DVec2,
    high: DVec2,
    body: String,
}

impl Drawing {
    pub(crate) fn new(low: (f64, f64), high: (f64, f64)) -> Self {
        Self { low: low.into(), high: high.into(), body: String::new() }
    }

    fn place(&self, p: DVec2) -> String {
        format!("{:.2} {:.2}", p.x - self.low.x, self.high.y - p.y)
    }

    fn data(&self, points: &[DVec2], closed: bool) -> String {
        let places: Vec<String> = points.iter().map(|&p| self.place(p)).collect();
        format!("M{}{}", places.join(" "), if closed { "z" } else { "" })
    }

    fn element(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    fn stroke(&mut self, data: &str, (colour, width): (&str, f64), more: &str) {
        self.element(&format!(
            r#"<path d="{data}" fill="none" stroke="{colour}" stroke-width="{width}" {more}/>"#
        ));
    }

    /// A line of round ends.
    pub(crate) fn line(&mut self, points: &[DVec2], colour: &str, width: f64) {
        let data = self.data(points, false);
        self.stroke(&data, (colour, width), r#"stroke-linejoin="round" stroke-linecap="round""#);
    }

    /// A closed line whose stretch from each point to the next has its own colour.
    pub(crate) fn coloured(&mut self, points: &[DVec2], colours: &[&str], width: f64) {
        let mut run: Vec<DVec2> = points.first().copied().into_iter().collect();
        for (k, colour) in colours.iter().enumerate() {
            run.extend(points.get((k + 1) % points.len()));
            if colours.get(k + 1) != Some(colour) {
                self.line(&run, colour, width);
                run.drain(..run.len() - 1);
            }
        }
    }

    pub(crate) fn ring(&mut self, points: &[DVec2], colour: &str, width: f64) {
        let data = self.data(points, true);
        self.stroke(&data, (colour, width), r#"stroke-linejoin="round""#);
    }

    pub(crate) fn dashed(&mut self, points: &[DVec2], colour: &str, width: f64) {
        let data = self.data(points, true);
        self.stroke(&data, (colour, width), r#"stroke-dasharray="0.8 0.5""#);
    }

    /// A broad see-through line.
    pub(crate) fn band(&mut self, points: &[DVec2], colour: &str, width: f64) {
        let data = self.data(points, true);
        self.stroke(&data, (colour, width), r#"stroke-opacity="0.25" stroke-linejoin="round""#);
    }

    pub(crate) fn dot(&mut self, at: DVec2, radius: f64, colour: &str) {
        let p = DVec2::new(at.x - self.low.x, self.high.y - at.y);
        self.element(&format!(r#"<circle cx="{:.2}" cy="{:.2}" r="{radius}" fill="{colour}"/>"#, p.x, p.y));
    }

    pub(crate) fn disc(&mut self, at: DVec2, radius: f64, colour: &str) {
        let p = DVec2::new(at.x - self.low.x, self.high.y - at.y);
        let opaque = r#"fill-opacity="0.25""#;
        self.element(&format!(
            r#"<circle cx="{:.2}" cy="{:.2}" r="{radius:.2}" fill="{colour}" {opaque}/>"#,
            p.x, p.y
        ));
    }

    /// A region with its holes.
    pub(crate) fn region(&mut self, region: &MultiPolygon<f64>, colour: &str, opacity: f64) {
        let rings = region.iter().flat_map(|part| std::iter::once(part.exterior()).chain(part.interiors()));
        let data: String = rings
            .map(|ring| {
                let points: Vec<DVec2> = ring.coords().map(|c| DVec2::new(c.x, c.y)).collect();
                self.data(&points, true)
            })
            .collect();
        let look = format!(r#"fill="{colour}" fill-opacity="{opacity}" fill-rule="evenodd""#);
        self.element(&format!(r#"<path d="{data}" {look} stroke="{colour}" stroke-width="0.15"/>"#));
    }

    /// A stretch of a curve.
    pub(crate) fn stretch(&mut self, curve: &ClosedCurve, span: &ArcSpan, colour: &str, width: f64) {
        let steps = (span.length / 0.2).ceil().max(1.0) as usize;
        let at = |k: usize| curve.point_at(span.start + span.length * k as f64 / steps as f64);
        let points: Vec<DVec2> = (0..=steps).map(at).collect();
        self.line(&points, colour, width);
    }

    pub(crate) fn finished(self, title: &str) -> String {
        let size = self.high - self.low;
        let scale = 480.0 / size.x;
        let mut svg = String::new();
        // Writing to a string does not fail.
        let _ = writeln!(
            svg,
            r#"<svg xmlns="http://www.w3.org/2000/svg" role="img" width="480" height="{:.0}" viewBox="0 0 {} {}">"#,
            size.y * scale,
            size.x,
            size.y
        );
        let _ = writeln!(svg, "<title>{title}</title>");
        let _ = writeln!(svg, r##"<rect width="{}" height="{}" fill="#faf7f2"/>"##, size.x, size.y);
        svg + &self.body + "</svg>\n"
    }
}
