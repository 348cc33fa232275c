//! One layer from above.

use std::fmt::Write;

use argil_strand::{DVec2, Role, Strand, StrandLayer};

use crate::colour::COATS;
use crate::markup::{Escaped, Num};
use crate::widths::{drawn_width, width_share};
use crate::{Colour, Palette};

/// Round ends of a stroke, as a bead has them.
const ROUND: &str = " stroke-linecap=\"round\"";

/// How a layer is drawn.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct SvgStyle {
    /// Pixels to a millimetre, for programs that show the picture at its own size. Default 12.
    pub scale: f64,
    /// Empty space round the strand, mm. Default 3.
    pub margin: f64,
    /// Whether the layer above is drawn as a pale ghost, to see what has to be supported. Default true.
    pub ghost: bool,
    /// Whether support points are drawn, with lines to the points above that need them. Default true.
    pub support_points: bool,
    /// Whether the seam is marked with an arrow in the direction of laying. Default true.
    pub seam: bool,
    /// Text above the picture; `None`, the default, gives the layer's number, height and lengths.
    pub title: Option<String>,
    /// Colours by role.
    pub palette: Palette,
}

impl Default for SvgStyle {
    fn default() -> Self {
        Self {
            scale: 12.0,
            margin: 3.0,
            ghost: true,
            support_points: true,
            seam: true,
            title: None,
            palette: Palette::default(),
        }
    }
}

/// One layer of a strand as an SVG, seen from above, its beads at their true width.
///
/// The unit of the drawing is the millimetre, y upwards on the paper, and the frame is that of the whole strand, so that
/// the pictures of all layers lie upon one another. Adjoining beads show the line between them; where a bead is laid
/// over another, its edge does not show. `layer` is a position from the lowest; beyond the uppermost layer the picture
/// holds the frame alone.
///
/// # Complexity
/// O(n) in the number of moves of the strand (for the frame) and of the layer.
///
/// # Example
/// ```
/// # use argil_preview::strand::{DVec2, Move, Role, Strand, StrandLayer};
/// use argil_preview::{Palette, SvgStyle, layer_svg};
/// # let moves = [(9.0, 0.0), (0.0, 9.0), (0.0, 0.0)].map(|(x, y)| Move { to: DVec2::new(x, y), role: Role::Wall });
/// # let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves: moves.to_vec(), supports: vec![] };
/// # let strand = Strand::new(DVec2::ZERO, vec![layer]).unwrap();
/// let svg = layer_svg(&strand, 0, &SvgStyle::default());
/// assert!(svg.contains("stroke-width=\"1.5\""));
/// assert!(svg.contains(&Palette::default().wall.to_string()));
/// ```
#[must_use]
pub fn layer_svg(strand: &Strand, layer: usize, style: &SvgStyle) -> String {
    let frame = Frame::of(strand, style);
    let mut picture = Picture { svg: String::new(), strand, style, frame };
    picture.open(layer);
    if let Some(laid) = strand.layers().get(layer) {
        if style.ghost {
            picture.ghost(layer + 1);
        }
        picture.beads(layer);
        if style.ghost {
            picture.ghost_line(layer + 1);
        }
        if style.support_points {
            picture.support_points(laid);
        }
        if style.seam {
            picture.seam_mark(layer, laid);
        }
    }
    picture.scale_bar();
    picture.svg.push_str("</svg>\n");
    picture.svg
}

/// The paper, mm: y points down on it.
struct Frame {
    low: DVec2,
    size: DVec2,
    /// A hundredth of the longer side: the measure of marks and letters.
    unit: f64,
}

impl Frame {
    fn of(strand: &Strand, style: &SvgStyle) -> Self {
        let widest = strand.layers().iter().map(|layer| layer.width).fold(0.0, f64::max);
        let start = strand.start();
        let points = strand.layers().iter().flat_map(|layer| layer.moves.iter().map(|step| step.to));
        let (low, high) = points.fold((start, start), |(low, high), p| (low.min(p), high.max(p)));
        let margin = if style.margin.is_finite() { style.margin.max(0.0) } else { 0.0 };
        // Numbers are written to the thousandth, so a frame of less would have no size.
        let space = DVec2::splat((widest / 2.0 + margin).max(0.01));
        let (low, high) = (low - space, high + space);
        let unit = (high - low).max_element() / 100.0;
        // Room for the title above and the scale bar below.
        let (low, high) = (low - DVec2::new(0.0, 6.0 * unit), high + DVec2::new(0.0, 6.0 * unit));
        Self { low: DVec2::new(low.x, -high.y), size: high - low, unit }
    }
}

struct Picture<'a> {
    svg: String,
    strand: &'a Strand,
    style: &'a SvgStyle,
    frame: Frame,
}

// Writing into a string cannot fail, so the results of `write!` are dropped throughout.
impl Picture<'_> {
    fn open(&mut self, layer: usize) {
        let Frame { low, size, unit } = self.frame;
        // Pictures of less than a pixel or of more than any program opens are brought back to what can be seen.
        let scale = if self.style.scale.is_finite() { self.style.scale } else { SvgStyle::default().scale };
        let longer = size.max_element();
        let pixels = size * ((scale * longer).clamp(16.0, 100_000.0) / longer);
        let _ = writeln!(
            self.svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"{} {} {} {}\">",
            Num(pixels.x.max(1.0)),
            Num(pixels.y.max(1.0)),
            Num(low.x),
            Num(low.y),
            Num(size.x),
            Num(size.y)
        );
        let title = self.style.title.clone().unwrap_or_else(|| self.title(layer));
        let _ = writeln!(
            self.svg,
            "<title>{0}</title>\n<rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\" fill=\"#ffffff\"/>\n\
             <text x=\"{5}\" y=\"{6}\" font-family=\"sans-serif\" font-size=\"{7}\" fill=\"{8}\">{0}</text>",
            Escaped(&title),
            Num(low.x),
            Num(low.y),
            Num(size.x),
            Num(size.y),
            Num(low.x + 3.0 * unit),
            Num(low.y + 5.0 * unit),
            Num(3.0 * unit),
            Colour::DARK
        );
    }

    fn title(&self, layer: usize) -> String {
        let Some(summary) = self.strand.summaries().into_iter().nth(layer) else {
            return format!("no layer {layer}");
        };
        let mut title = format!("layer {}, z {} mm", summary.index, Num(summary.z));
        if let [first, .., last] = self.strand.rises(layer) {
            title = format!("layer {}, z {} to {} mm", summary.index, Num(first.z), Num(last.z));
        }
        for role in Role::ALL {
            let length = summary.lengths.of(role);
            if length > 0.0 && role != Role::Seam {
                let _ = write!(title, ", {role} {length:.0} mm");
            }
        }
        title
    }

    /// The points of the stretches of one role, as path commands by the width of their beads; the move that begins a stretch starts at
    /// the end of the one before it.
    fn stretches(&self, layer: usize, role: Role) -> Vec<(f64, String)> {
        let mut paths: Vec<(f64, String)> = Vec::new();
        let Some(laid) = self.strand.layers().get(layer) else { return paths };
        let widths = self.strand.widths(layer);
        let below = layer.checked_sub(1).and_then(|below| self.strand.layers().get(below));
        let mut at = below.and_then(|below| below.moves.last()).map_or(self.strand.start(), |step| step.to);
        let mut drawing = None;
        for (k, step) in laid.moves.iter().enumerate() {
            let bead = widths
                .get(k)
                .map_or(laid.width, |&bead| drawn_width(width_share(bead, laid.width), laid.width));
            let path = paths.iter().position(|path| path.0 == bead).unwrap_or(paths.len());
            if step.role == role {
                if path == paths.len() {
                    paths.push((bead, String::new()));
                }
                let commands = &mut paths[path].1;
                if drawing != Some(path) {
                    let _ = write!(commands, "M{} {}", Num(at.x), Num(-at.y));
                }
                let _ = write!(commands, "L{} {}", Num(step.to.x), Num(-step.to.y));
            }
            drawing = (step.role == role).then_some(path);
            at = step.to;
        }
        paths
    }

    fn stroke(&mut self, path: &str, colour: Colour, width: f64, more: &str) {
        if !path.is_empty() {
            let _ = writeln!(
                self.svg,
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{more}/>",
                Num(width)
            );
        }
    }

    fn whole(&self, layer: usize) -> String {
        let mut path = String::new();
        for (k, p) in self.strand.polyline(layer).into_iter().enumerate() {
            let _ = write!(path, "{}{} {}", if k == 0 { 'M' } else { 'L' }, Num(p.x), Num(-p.y));
        }
        path
    }

    fn ghost(&mut self, layer: usize) {
        if let Some(above) = self.strand.layers().get(layer) {
            let (path, width) = (self.whole(layer), above.width);
            self.stroke(&path, Colour::new(0xee, 0xea, 0xe6), width, ROUND);
        }
    }

    /// The middle of the layer above, over the beads, so that it is seen where both lie upon each other.
    fn ghost_line(&mut self, layer: usize) {
        if let Some(above) = self.strand.layers().get(layer) {
            let (path, width) = (self.whole(layer), above.width);
            let dashes =
                format!(" stroke-dasharray=\"{} {}\" opacity=\"0.55\"", Num(width * 0.3), Num(width * 0.4));
            self.stroke(&path, Colour::DARK, width * 0.07, &dashes);
        }
    }

    /// Edge, body and light of every bead: three coats, each over all roles, so that the line between adjoining beads
    /// shows and stretches of one role end smoothly in the next.
    fn beads(&mut self, layer: usize) {
        let paths = COATS.map(|role| (role, self.stretches(layer, role)));
        let palette = self.style.palette;
        let coats = [
            (1.0, Colour::DARK, 0.32, ROUND),
            (0.88, Colour::DARK, 0.0, ROUND),
            (0.42, Colour::WHITE, 0.14, ""),
        ];
        for (share, tint, tone, ends) in coats {
            for (role, paths) in &paths {
                for (width, path) in paths {
                    self.stroke(path, palette.of(*role).towards(tint, tone), width * share, ends);
                }
            }
        }
    }

    fn support_points(&mut self, laid: &StrandLayer) {
        let mut links = String::new();
        for source in &laid.supports {
            for need in &source.needs {
                let _ = write!(
                    links,
                    "M{} {}L{} {}",
                    Num(source.at.x),
                    Num(-source.at.y),
                    Num(need.x),
                    Num(-need.y)
                );
            }
        }
        self.stroke(&links, Colour::DARK, laid.width * 0.06, "");
        let rim = self.style.palette.support.towards(Colour::DARK, 0.65);
        for source in &laid.supports {
            let _ = writeln!(
                self.svg,
                "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"#ffffff\" stroke=\"{rim}\" stroke-width=\"{}\"/>",
                Num(source.at.x),
                Num(-source.at.y),
                Num(laid.width * 0.2),
                Num(laid.width * 0.09)
            );
        }
    }

    /// An arrowhead where the layer's cycle begins, in the direction in which it is laid.
    fn seam_mark(&mut self, layer: usize, laid: &StrandLayer) {
        let Some(at) = self.strand.seam(layer) else { return };
        // The first point far enough away to tell a direction from.
        let ahead =
            self.strand.cycle(layer).iter().map(|step| step.to).find(|to| to.distance(at) > 0.2 * laid.width);
        let along = ahead.and_then(|ahead| (ahead - at).try_normalize()).unwrap_or(DVec2::X) * laid.width;
        let across = along.perp();
        let corners = [at + along * 0.8, at - along * 0.35 + across * 0.5, at - along * 0.35 - across * 0.5];
        let [a, b, c] = corners.map(|p| format!("{} {}", Num(p.x), Num(-p.y)));
        let _ = writeln!(
            self.svg,
            "<path d=\"M{a}L{b}L{c}Z\" fill=\"{}\" stroke=\"#ffffff\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>",
            Colour::DARK,
            Num(laid.width * 0.12)
        );
    }

    /// A bar of a round length, at most a third of the picture's width.
    fn scale_bar(&mut self) {
        let Frame { low, size, unit } = self.frame;
        let third = size.x / 3.0;
        let decade = 10f64.powf(third.max(1e-6).log10().floor());
        let length =
            [5.0, 2.0, 1.0].map(|step| step * decade).into_iter().find(|&l| l <= third).unwrap_or(decade);
        let (x, y) = (low.x + 3.0 * unit, low.y + size.y - 3.0 * unit);
        let _ = writeln!(
            self.svg,
            "<path d=\"M{x0} {top}V{y}H{x1}V{top}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n\
             <text x=\"{tx}\" y=\"{y}\" font-family=\"sans-serif\" font-size=\"{}\" fill=\"{}\">{} mm</text>",
            Colour::DARK,
            Num(0.25 * unit),
            Num(2.6 * unit),
            Colour::DARK,
            Num(length),
            x0 = Num(x),
            x1 = Num(x + length),
            y = Num(y),
            top = Num(y - 1.4 * unit),
            tx = Num(x + length + 1.5 * unit),
        );
    }
}
