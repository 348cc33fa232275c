//! The whole strand at an angle from above.

use std::collections::BTreeMap;
use std::fmt::Write;

use argil_strand::{DVec2, DVec3, Step, Strand, StrandLayer};

use crate::colour::COATS;
use crate::markup::{Escaped, Num};
use crate::projection::Projection;
use crate::simplify::kept;
use crate::widths::{SHARES, drawn_width, width_share};
use crate::{Colour, Palette};

/// Steps of light between the dark and the lit side. More are hardly told apart and make the file longer.
const TONES: f64 = 11.0;

/// Path data is in integers of this many to a millimetre, which is less than a tenth of a pixel at any usual size.
const FINENESS: f64 = 100.0;

/// How the whole strand is drawn.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct ViewStyle {
    /// Direction of the view round the part, degrees: at 0 x points right and y away, positive turns the part
    /// clockwise. Default 25.
    pub azimuth: f64,
    /// Height of the eye above the horizon, degrees, between 5 and 90. Default 32.
    pub elevation: f64,
    /// Longer side of the picture, pixels. Default 1200. Beads are drawn at scale, so more pixels show more coils.
    pub size: f64,
    /// Points beyond which lines are drawn more coarsely, to limit the size of the file. Default 120,000, about 2 MB.
    pub most_points: usize,
    /// Whether support and connections are drawn; without them the part is seen as it will be. Default true.
    pub non_model: bool,
    /// Whether the bed is drawn, with lines every 10 mm. Default true.
    pub bed: bool,
    /// The picture's title, shown by browsers on hovering. Default none.
    pub title: Option<String>,
    /// Colours by role.
    pub palette: Palette,
}

impl Default for ViewStyle {
    fn default() -> Self {
        Self {
            azimuth: 25.0,
            elevation: 32.0,
            size: 1200.0,
            most_points: 120_000,
            non_model: true,
            bed: true,
            title: None,
            palette: Palette::default(),
        }
    }
}

/// The whole strand as an SVG, seen at an angle from above, each layer painted over the one below.
///
/// Painting layers from the bed upwards hides what is behind, since nothing that is both farther away and higher up falls
/// on the same place of the paper as what is nearer and lower. Beads are drawn in the plane of their layer, as wide as
/// they look from the eye, over a darker rim, and lit by their direction, so that layers read as coils of clay; colours
/// grow a little lighter towards the top.
///
/// Values of the style that make no picture are replaced: angles and sizes that are not finite by the defaults.
///
/// # Complexity
/// O(n log n) in the number of moves.
///
/// # Example
/// ```
/// # use argil_preview::strand::{DVec2, Move, Role, Strand, StrandLayer};
/// use argil_preview::{ViewStyle, overview_svg};
/// # let moves = [(9.0, 0.0), (0.0, 9.0), (0.0, 0.0)].map(|(x, y)| Move { to: DVec2::new(x, y), role: Role::Wall });
/// # let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves: moves.to_vec(), supports: vec![] };
/// # let strand = Strand::new(DVec2::ZERO, vec![layer]).unwrap();
/// let svg = overview_svg(&strand, &ViewStyle { title: Some("a < b".into()), ..ViewStyle::default() });
/// assert!(svg.starts_with("<svg") && svg.contains("<title>a &lt; b</title>"));
/// ```
#[must_use]
pub fn overview_svg(strand: &Strand, style: &ViewStyle) -> String {
    View::new(strand, style).draw()
}

struct View<'a> {
    strand: &'a Strand,
    style: &'a ViewStyle,
    projection: Projection,
    low: DVec2,
    size: DVec2,
    /// Pixels to the millimetre.
    scale: f64,
    bed: (DVec2, DVec2),
}

/// What strokes of one layer share: coat and tone, the numbers that they are painted with, and the width of the bead in [`SHARES`] of the
/// layer's.
type Look = (usize, u32, u32);

/// Path data of one layer by look, coat after coat.
#[derive(Default)]
struct Strokes {
    paths: BTreeMap<Look, String>,
    /// Where the pen stands, and in which look, so that a line that goes on needs no new beginning.
    pen: Option<(Look, [i64; 2])>,
}

impl Strokes {
    fn line(&mut self, look: Look, from: [i64; 2], to: [i64; 2]) {
        let path = self.paths.entry(look).or_default();
        if self.pen == Some((look, from)) {
            path.push(' ');
        } else {
            let _ = write!(path, "M{} {}l", from[0], from[1]);
        }
        let _ = write!(path, "{} {}", to[0].saturating_sub(from[0]), to[1].saturating_sub(from[1]));
        self.pen = Some((look, to));
    }
}

impl<'a> View<'a> {
    fn new(strand: &'a Strand, style: &'a ViewStyle) -> Self {
        let defaults = ViewStyle::default();
        let finite = |value: f64, default: f64| if value.is_finite() { value } else { default };
        let azimuth = finite(style.azimuth, defaults.azimuth);
        let elevation = finite(style.elevation, defaults.elevation).clamp(5.0, 90.0);
        let longer = finite(style.size, defaults.size).clamp(16.0, 20_000.0);
        let widest = strand.layers().iter().map(|layer| layer.width).fold(0.0, f64::max);
        let start = strand.start();
        let points = || strand.steps().map(|step| step.to.truncate());
        let (low, high) = points().fold((start, start), |(low, high), p| (low.min(p), high.max(p)));
        let bed = (grid_line(low - widest * 3.0, f64::floor), grid_line(high + widest * 3.0, f64::ceil));

        // First at one pixel to the millimetre, to learn how large the picture is.
        let unit = Projection::new(azimuth, elevation, 1.0);
        let top = strand.layers().last().map_or(0.0, |layer| layer.z);
        let corners = [bed.0, DVec2::new(bed.1.x, bed.0.y), bed.1, DVec2::new(bed.0.x, bed.1.y)];
        let outline = strand.steps().map(|step| unit.place(step.to.truncate(), step.to.z));
        let ground = corners.iter().filter(|_| style.bed).map(|&corner| unit.place(corner, 0.0));
        let first = unit.place(start, 0.0);
        let (min, max) = outline.chain(ground).fold((first, first), |(a, b), p| (a.min(p), b.max(p)));
        let space = DVec2::splat(widest + 0.03 * (max - min).max_element().max(top));
        let (min, max) = (min - space, max + space);
        let scale = longer / (max - min).max_element();
        let projection = Projection::new(azimuth, elevation, scale);
        Self { strand, style, projection, low: min * scale, size: (max - min) * scale, scale, bed }
    }

    // Writing into a string cannot fail, so the results of `write!` are dropped throughout.
    fn draw(&self) -> String {
        let mut svg = String::new();
        let _ = writeln!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"{2} {3} {0} {1}\">",
            Num(self.size.x),
            Num(self.size.y),
            Num(self.low.x),
            Num(self.low.y)
        );
        if let Some(title) = &self.style.title {
            let _ = writeln!(svg, "<title>{}</title>", Escaped(title));
        }
        let _ = writeln!(
            svg,
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>",
            Num(self.low.x),
            Num(self.low.y),
            Num(self.size.x),
            Num(self.size.y)
        );
        if self.style.bed {
            self.draw_bed(&mut svg);
        }
        svg.push_str("<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
        let tolerance = self.tolerance();
        let mut steps = self.strand.steps().peekable();
        for (k, layer) in self.strand.layers().iter().enumerate() {
            let mut strokes = [Strokes::default(), Strokes::default()];
            let mut own = Vec::with_capacity(layer.moves.len());
            while let Some(step) = steps.next_if(|step| step.layer == k) {
                own.push(step);
            }
            let share = |step: &Step| width_share(step.width, layer.width);
            for run in own.chunk_by(|a, b| a.role == b.role && share(a) == share(b)) {
                self.add_run(run, layer, tolerance, &mut strokes);
            }
            self.draw_layer(&mut svg, k, layer, &strokes);
        }
        svg.push_str("</g>\n</svg>\n");
        svg
    }

    /// A pale plate with lines every 10 mm, and the print's shadow on it.
    fn draw_bed(&self, svg: &mut String) {
        let place = |x: f64, y: f64| {
            let p = self.projection.place(DVec2::new(x, y), 0.0);
            format!("{} {}", Num(p.x), Num(p.y))
        };
        let (low, high) = self.bed;
        let plate = [place(low.x, low.y), place(high.x, low.y), place(high.x, high.y), place(low.x, high.y)];
        let _ = writeln!(svg, "<path d=\"M{}Z\" fill=\"#f7f4f0\"/>", plate.join("L"));
        let mut lines = String::new();
        // A bed of hundreds of lines would be grey, not ruled.
        let count = ((high - low) / 10.0).round().max(DVec2::ZERO);
        if count.max_element() <= 200.0 {
            for k in 0..=count.x as u32 {
                let x = low.x + 10.0 * f64::from(k);
                let _ = write!(lines, "M{}L{}", place(x, low.y), place(x, high.y));
            }
            for k in 0..=count.y as u32 {
                let y = low.y + 10.0 * f64::from(k);
                let _ = write!(lines, "M{}L{}", place(low.x, y), place(high.x, y));
            }
            let _ =
                writeln!(svg, "<path d=\"{lines}\" fill=\"none\" stroke=\"#e6e0d8\" stroke-width=\"1\"/>");
        }
    }

    /// How far a line may be off, mm, so that all lines together keep within the points allowed.
    fn tolerance(&self) -> f64 {
        let moves: usize = self.strand.layers().iter().map(|layer| layer.moves.len()).sum();
        let most = self.style.most_points.max(1000);
        // The points that a smooth curve needs go with the inverse square root of the tolerance.
        let excess = (moves as f64 / most as f64).max(1.0);
        0.2 / self.scale * excess * excess
    }

    /// Adds the steps of a run of one role and width to the strokes of their look: first the rim's, then the body's.
    fn add_run(&self, run: &[Step], layer: &StrandLayer, tolerance: f64, [rims, bodies]: &mut [Strokes; 2]) {
        let Some(first) = run.first() else { return };
        let (plane, share) = (layer.z, width_share(first.width, layer.width));
        if !(self.style.non_model || first.role.is_model()) {
            return;
        }
        // The step to a level layer is drawn in its plane; what rises along a layer is drawn as high as it is.
        let rises = !self.strand.rises(first.layer).is_empty();
        let drawn =
            |p: DVec3| if rises { self.projection.onto(p.truncate(), p.z, plane) } else { p.truncate() };
        let points: Vec<DVec2> =
            std::iter::once(first.from).chain(run.iter().map(|step| step.to)).map(drawn).collect();
        let coat = COATS.iter().position(|&role| role == first.role).unwrap_or(0);
        let whole = |p: DVec2| (p * FINENESS).round().to_array().map(|value| value as i64);
        for pair in kept(&points, tolerance).windows(2) {
            let (from, to) = (points[pair[0]], points[pair[1]]);
            let tone = (self.projection.light(to - from) * TONES).round() as u32;
            rims.line((coat, 0, share), whole(from), whole(to));
            bodies.line((coat, tone, share), whole(from), whole(to));
        }
    }

    /// Paints a layer twice: dark at the foot of the beads and a little wider, which leaves the line between coils, and
    /// lit by direction at their middle.
    fn draw_layer(&self, svg: &mut String, k: usize, layer: &StrandLayer, [rims, bodies]: &[Strokes; 2]) {
        let count = self.strand.layers().len().max(2) - 1;
        let height = k as f64 / count as f64;
        let colour = |coat: usize| self.style.palette.of(COATS[coat]).towards(Colour::WHITE, 0.16 * height);
        let rim = 0.16 * layer.height;
        self.open_plane(svg, layer.z - 0.58 * layer.height, layer.width + rim);
        for (&(coat, _, share), path) in &rims.paths {
            let width = own_width(share, layer.width, rim);
            let _ = writeln!(
                svg,
                "<path d=\"{path}\" stroke=\"{}\"{width}/>",
                colour(coat).towards(Colour::DARK, 0.52)
            );
        }
        svg.push_str("</g>\n");
        self.open_plane(svg, layer.z - 0.36 * layer.height, layer.width);
        for (&(coat, tone, share), path) in &bodies.paths {
            let light = f64::from(tone) / TONES;
            let lit =
                colour(coat).towards(Colour::DARK, 0.36 * (1.0 - light)).towards(Colour::WHITE, 0.2 * light);
            let width = own_width(share, layer.width, 0.0);
            let _ = writeln!(svg, "<path d=\"{path}\" stroke=\"{lit}\"{width}/>");
        }
        svg.push_str("</g>\n");
    }

    /// Opens a group whose strokes lie flat at a height.
    fn open_plane(&self, svg: &mut String, z: f64, width: f64) {
        let [a, b, c, d, e, f] = self.projection.matrix(z);
        let [a, b, c, d] = [a, b, c, d].map(|value| value / FINENESS);
        let _ = writeln!(
            svg,
            "<g transform=\"matrix({a:.6} {b:.6} {c:.6} {d:.6} {} {})\" stroke-width=\"{}\">",
            Num(e),
            Num(f),
            Num(width * FINENESS)
        );
    }
}

/// The attribute of strokes that are not as wide as their layer's.
fn own_width(share: u32, width: f64, rim: f64) -> String {
    if share == SHARES {
        return String::new();
    }
    format!(" stroke-width=\"{}\"", Num((drawn_width(share, width) + rim) * FINENESS))
}

/// A coordinate pair moved to a multiple of 10 mm.
fn grid_line(p: DVec2, to: fn(f64) -> f64) -> DVec2 {
    DVec2::new(to(p.x / 10.0), to(p.y / 10.0)) * 10.0
}
