//! A sheet of paper with lines of text, tables and outlines of prints.

use std::fmt::Write;

use argil_strand::{DVec2, Strand};

/// Millimetres on A4.
pub(crate) const PAPER: DVec2 = DVec2::new(210.0, 297.0);

/// A warm black, as the other pictures have it.
const INK: &str = "#2b2320";
const CLAY: &str = "#c66b4b";
const PALE: &str = "#eadfd8";

/// An SVG in the making; y points down.
pub(crate) struct Sheet(String);

// Writing into a string cannot fail, so the results of `write!` are dropped throughout. No text comes from outside of
// this crate but numbers, so nothing has to be escaped.
impl Sheet {
    pub(crate) fn new(title: &str) -> Self {
        let mut svg = String::new();
        let DVec2 { x, y } = PAPER;
        let _ = writeln!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{x}mm\" height=\"{y}mm\" viewBox=\"0 0 {x} {y}\" \
             font-family=\"sans-serif\" fill=\"{INK}\">\n<title>{title}</title>\n\
             <rect width=\"{x}\" height=\"{y}\" fill=\"#ffffff\"/>"
        );
        Self(svg)
    }

    pub(crate) fn finished(mut self) -> String {
        self.0.push_str("</svg>\n");
        self.0
    }

    pub(crate) fn text(&mut self, x: f64, y: f64, size: f64, text: &str) {
        let _ = writeln!(self.0, "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\">{text}</text>");
    }

    /// Text about a middle, as numbers stand beside what they name.
    pub(crate) fn label(&mut self, at: DVec2, text: &str) {
        let _ = writeln!(
            self.0,
            "<text x=\"{:.2}\" y=\"{:.2}\" font-size=\"3\" text-anchor=\"middle\">{text}</text>",
            at.x,
            at.y + 1.1
        );
    }

    /// Text in which every sign has its width, as it is typed into a file.
    pub(crate) fn code(&mut self, x: f64, y: f64, text: &str) {
        let _ = writeln!(
            self.0,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"2.5\" font-family=\"monospace\">{text}</text>"
        );
    }

    pub(crate) fn rule(&mut self, y: f64) {
        let _ = writeln!(self.0, "<path d=\"M14 {y}H196\" stroke=\"{INK}\" stroke-width=\"0.2\"/>");
    }

    /// The lowest and the uppermost layer of a print in a frame of the sheet, and how to get from the print there.
    pub(crate) fn outline(
        &mut self,
        print: &Strand,
        low: DVec2,
        size: DVec2,
    ) -> impl Fn(DVec2) -> DVec2 + use<> {
        let points = || print.layers().iter().flat_map(|layer| layer.moves.iter().map(|step| step.to));
        let (start, width) = (print.start(), print.layers().first().map_or(0.0, |layer| layer.width));
        let (least, most) = points().fold((start, start), |(least, most), p| (least.min(p), most.max(p)));
        let middle = (least + most) / 2.0;
        let scale = (size / (most - least + width)).min_element();
        let place = move |p: DVec2| low + size / 2.0 + (p - middle) * DVec2::new(scale, -scale);
        let last = print.layers().len().saturating_sub(1);
        for (layer, colour, share) in [(0, PALE, 1.0), (last, CLAY, 1.0), (0, INK, 0.12)] {
            let mut path = String::new();
            for (k, point) in print.polyline(layer).into_iter().enumerate() {
                let at = place(point);
                let _ = write!(path, "{}{:.2} {:.2}", if k == 0 { 'M' } else { 'L' }, at.x, at.y);
            }
            let stroke = scale * width * share;
            let _ = writeln!(
                self.0,
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{stroke:.2}\" stroke-linejoin=\"round\"/>"
            );
        }
        place
    }
}
