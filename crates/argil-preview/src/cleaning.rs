//! The page that says where to cut after printing.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write};

use argil_strand::{DVec2, Role, Strand};

use crate::colour::COATS;
use crate::cut::Walls;
use crate::markup::{Escaped, Num};
use crate::simplify::kept;
use crate::{Colour, Palette};

const STYLE: &str = include_str!("page/cleaning.css");

/// Side of the picture of a place, in bead widths.
const WINDOW: f64 = 14.0;

/// How far the drawn line may be off, in bead widths: a fraction of a pixel.
const OFF: f64 = 0.02;

/// A place where the strand beside the model touches the model, to be cut or left.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CutPlace {
    /// Why it touches there; places of one cause are summed up together.
    pub cause: String,
    /// What is to be done.
    pub advice: String,
    /// Whether it is where strand leaves or joins the wall: the blade then goes across each such strand there, and
    /// otherwise along the wall.
    pub at_roots: bool,
    /// The number of its lowest layer ([`StrandLayer::index`](argil_strand::StrandLayer::index)).
    pub first_layer: usize,
    /// The number of its highest layer.
    pub last_layer: usize,
    /// Its middle, mm.
    pub at: DVec2,
    /// Length of strand that touches, over all its layers, mm.
    pub length: f64,
}

/// What a cleaning guide shows beside the places.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct CleaningStyle {
    /// The page's title. Default `strand`.
    pub title: String,
    /// Colours by role.
    pub palette: Palette,
}

impl Default for CleaningStyle {
    fn default() -> Self {
        Self { title: "strand".to_owned(), palette: Palette::default() }
    }
}

/// A guide for the hour after printing as one self-contained HTML page: every place where the strand beside the model
/// touches it, in the order of work.
///
/// The order is from the top down, so that what is cut away uncovers what comes next; places that end on one layer stand
/// under it, longest first, beside that layer as seen from above with the places numbered. Each has its layers, height, length, cause,
/// what to do, a box to tick, and a picture of its middle layer with the line along which a blade goes: the edge of the
/// nearest wall. Numbers are given from the top, so that they are the order of work. The page has no script, needs no network, and can be
/// printed.
///
/// Places on layers that the strand skips are shown on the next one below; a strand without layers has a page without
/// places.
///
/// # Complexity
/// O(n log n) in the moves of the layers that are shown, and O(m) in a layer's moves for each place on it. The page holds
/// each layer once, however many pictures show it.
///
/// # Example
/// ```
/// # use argil_preview::strand::{DVec2, Move, Role, Strand, StrandLayer};
/// use argil_preview::{CleaningStyle, CutPlace, cleaning_html};
/// # let moves = [(9.0, 0.0, Role::Wall), (0.0, 9.0, Role::Support), (0.0, 0.0, Role::Wall)]
/// #     .map(|(x, y, role)| Move { to: DVec2::new(x, y), role });
/// # let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves: moves.to_vec(), supports: vec![] };
/// # let strand = Strand::new(DVec2::ZERO, vec![layer]).unwrap();
/// let root = CutPlace {
///     cause: "root".into(),
///     advice: "cut it off".into(),
///     at_roots: true,
///     first_layer: 0,
///     last_layer: 0,
///     at: DVec2::new(8.2, 0.8),
///     length: 0.7,
/// };
/// let page = cleaning_html(&strand, &[root], &CleaningStyle::default());
/// assert!(page.starts_with("<!doctype html>") && page.contains("root"));
/// assert!(!page.contains("http") && !page.contains("<script"));
/// ```
#[must_use]
pub fn cleaning_html(strand: &Strand, places: &[CutPlace], style: &CleaningStyle) -> String {
    let mut page = String::new();
    let steps = steps(strand, places);
    // Writing into a string cannot fail, so the results of `write!` are dropped throughout.
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n<h1>{0}</h1>\n",
        Escaped(&format!("{}: where to cut", style.title))
    );
    summary(&mut page, &steps, style);
    let shown: BTreeSet<usize> = steps.iter().flat_map(|step| [step.top, step.middle]).collect();
    let sheets = Sheets::new(strand, &shown, style.palette, &mut page);
    for group in steps.chunk_by(|a, b| a.top == b.top) {
        sheets.section(group, &mut page);
    }
    page.push_str("</body>\n</html>\n");
    page
}

/// A place with its number in the order of work.
struct Step<'p> {
    number: usize,
    place: &'p CutPlace,
    /// Position of its highest layer.
    top: usize,
    /// Position of its middle layer, on which its picture is drawn: its place is a mean over its layers.
    middle: usize,
    /// How many layers it reaches over.
    layers: usize,
}

/// The places from the top down, the longest of a layer first.
fn steps<'p>(strand: &Strand, places: &'p [CutPlace]) -> Vec<Step<'p>> {
    let position = |index: usize| {
        let above = strand.layers().partition_point(|layer| layer.index <= index);
        (!strand.layers().is_empty()).then(|| above.saturating_sub(1))
    };
    let placed = places.iter().filter_map(|place| {
        let (first, last) =
            (place.first_layer.min(place.last_layer), place.first_layer.max(place.last_layer));
        let (low, top) = (position(first)?, position(last)?);
        let middle = low + (top - low) / 2;
        Some(Step { number: 0, place, top, middle, layers: (last - first).saturating_add(1) })
    });
    let mut steps: Vec<Step<'_>> = placed.collect();
    steps.sort_by(|a, b| b.top.cmp(&a.top).then(b.place.length.total_cmp(&a.place.length)));
    steps.iter_mut().enumerate().for_each(|(k, step)| step.number = k + 1);
    steps
}

/// What there is to do in all, and the causes with what to do about each.
fn summary(page: &mut String, steps: &[Step<'_>], style: &CleaningStyle) {
    if steps.is_empty() {
        page.push_str("<p>The strand touches the model nowhere outside: nothing has to be cut.</p>\n");
        return;
    }
    let length: f64 = steps.iter().map(|step| step.place.length).sum();
    let _ = write!(
        page,
        "<p>{} places, {} mm of strand to part from the model. They are numbered from the top down: what is cut \
         away uncovers the next. Cut while the clay is leather-hard: it holds its shape and does not crumble yet.</p>\n\
         <p class=\"key\"><b style=\"background:{}\"></b> the model <b style=\"background:{}\"></b> \
         <b style=\"background:{}\"></b> to be cut away <i></i> where the blade goes</p>\n\
         <table>\n<tr><th>cause<th>places<th>mm<th>what to do\n",
        steps.len(),
        Num(length.round()),
        style.palette.wall,
        style.palette.support,
        style.palette.connection
    );
    let mut causes: Vec<(&CutPlace, usize, f64)> = Vec::new();
    for Step { place, .. } in steps {
        match causes.iter_mut().find(|(other, _, _)| other.cause == place.cause) {
            Some((_, count, length)) => {
                *count += 1;
                *length += place.length;
            }
            None => causes.push((place, 1, place.length)),
        }
    }
    causes.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cause.cmp(&b.0.cause)));
    for (place, count, length) in causes {
        let (cause, advice) = (Escaped(&place.cause), Escaped(&place.advice));
        let _ = writeln!(page, "<tr><td>{cause}<td>{count}<td>{}<td>{advice}", Num(length.round()));
    }
    page.push_str("</table>\n");
}

/// The layers that pictures show, each drawn once and used by its name.
struct Sheets<'s> {
    strand: &'s Strand,
    /// By the layer's position.
    walls: BTreeMap<usize, Walls>,
    low: DVec2,
    high: DVec2,
}

impl<'s> Sheets<'s> {
    fn new(strand: &'s Strand, shown: &BTreeSet<usize>, palette: Palette, page: &mut String) -> Self {
        let mut walls = BTreeMap::new();
        page.push_str("<svg width=\"0\" height=\"0\" aria-hidden=\"true\"><defs>\n");
        let (mut low, mut high) = (strand.start(), strand.start());
        for (position, layer) in strand.layers().iter().enumerate() {
            (low, high) =
                layer.moves.iter().fold((low, high), |(l, h), step| (l.min(step.to), h.max(step.to)));
            if !shown.contains(&position) {
                continue;
            }
            let stretches = stretches(strand, position);
            let _ = writeln!(
                page,
                "<g id=\"layer-{}\" fill=\"none\" stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"round\">",
                layer.index,
                Num(0.9 * layer.width)
            );
            for role in COATS {
                let path: String =
                    stretches.iter().filter(|s| s.0 == role).map(|s| path(&s.1, OFF * layer.width)).collect();
                if !path.is_empty() {
                    let _ = writeln!(page, "<path stroke=\"{}\" d=\"{path}\"/>", palette.of(role));
                }
            }
            page.push_str("</g>\n");
            walls.insert(position, Walls::new(&stretches, layer.width));
        }
        page.push_str("</defs></svg>\n");
        let widest = strand.layers().iter().map(|layer| layer.width).fold(0.01, f64::max);
        let margin = DVec2::splat(2.0 * widest);
        Self { strand, walls, low: low - margin, high: high + margin }
    }

    /// Where a place is drawn: within the picture of the strand, also where it was never laid.
    fn seen(&self, place: &CutPlace) -> DVec2 {
        place.at.max(self.low).min(self.high)
    }

    /// The places that end on one layer, beside that layer.
    fn section(&self, group: &[Step<'_>], page: &mut String) {
        let Some(layer) = group.first().and_then(|step| self.strand.layers().get(step.top)) else { return };
        let size = self.high - self.low;
        let unit = size.max_element() / 100.0;
        let _ = write!(
            page,
            "<section>\n<h2>Layer {}, {} mm up</h2>\n<svg class=\"whole\" role=\"img\" aria-label=\"Layer {0} from above\" \
             viewBox=\"{} {} {} {}\"><use href=\"#layer-{0}\"/>",
            layer.index,
            Num(layer.z),
            Num(self.low.x),
            Num(-self.high.y),
            Num(size.x),
            Num(size.y)
        );
        for (k, step) in group.iter().enumerate() {
            let at = self.seen(step.place);
            // Numbers of neighbours stand on different sides.
            let beside =
                DVec2::from([[1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]][k % 4]) * 1.3 * layer.width;
            let _ = write!(
                page,
                "<circle cx=\"{0}\" cy=\"{1}\" r=\"{2}\" fill=\"none\" stroke=\"{3}\" stroke-width=\"{4}\"/>\
                 <text x=\"{5}\" y=\"{6}\" font-size=\"{7}\" fill=\"{3}\" stroke-width=\"{8}\" text-anchor=\"middle\" dominant-baseline=\"middle\">{9}</text>",
                Num(at.x),
                Num(-at.y),
                Num(1.2 * layer.width),
                Colour::DARK,
                Num(0.4 * unit),
                Num(at.x + beside.x),
                Num(-at.y - beside.y),
                Num(5.0 * unit),
                Num(unit),
                step.number
            );
        }
        page.push_str("</svg>\n<ol>\n");
        group.iter().for_each(|step| self.item(step, page));
        page.push_str("</ol>\n</section>\n");
    }

    /// One place: its picture and what is known about it.
    fn item(&self, step: &Step<'_>, page: &mut String) {
        let Step { number, place, .. } = *step;
        let Some(layer) = self.strand.layers().get(step.middle) else { return };
        let (at, side) = (self.seen(place), WINDOW * layer.width);
        let _ = write!(
            page,
            "<li id=\"place-{number}\"><svg role=\"img\" aria-label=\"Place {number} from above\" viewBox=\"{} {} {2} {2}\">\
             <use href=\"#layer-{3}\"/>",
            Num(at.x - side / 2.0),
            Num(-at.y - side / 2.0),
            Num(side),
            layer.index
        );
        let share = place.length / step.layers as f64;
        let cuts = self.walls.get(&step.middle).map(|walls| walls.cuts(at, share, place.at_roots));
        for cut in cuts.unwrap_or_default() {
            for (colour, width) in [(Colour::WHITE, 0.42), (Colour::DARK, 0.22)] {
                let _ = write!(
                    page,
                    "<path class=\"cut\" d=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\"/>",
                    path(&cut, 0.0),
                    Num(width * layer.width)
                );
            }
        }
        let _ = writeln!(
            page,
            "</svg>\n<div><label><input type=\"checkbox\"> <b>{number}</b> {}</label>\n<p>{}{} mm at x {}, y {}{}</p>\n\
             <p>{}</p></div></li>",
            Escaped(&place.cause),
            Layers(place),
            tenths(place.length),
            tenths(place.at.x),
            tenths(place.at.y),
            if step.layers > 1 {
                format!("; the picture shows layer {}", layer.index)
            } else {
                String::new()
            },
            Escaped(&place.advice)
        );
    }
}

/// The layers of a place in words.
struct Layers<'p>(&'p CutPlace);

impl fmt::Display for Layers<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let CutPlace { first_layer, last_layer, .. } = self.0;
        if first_layer == last_layer {
            write!(f, "layer {first_layer}, ")
        } else {
            write!(f, "layers {last_layer} down to {first_layer}, ")
        }
    }
}

/// A length as it can be measured on clay.
fn tenths(length: f64) -> Num {
    Num((length * 10.0).round() / 10.0)
}

/// A layer's moves gathered by role: each stretch with the point that it begins at.
fn stretches(strand: &Strand, position: usize) -> Vec<(Role, Vec<DVec2>)> {
    let mut at = strand.seam(position).unwrap_or(strand.start());
    strand
        .cycle(position)
        .chunk_by(|a, b| a.role == b.role)
        .map(|run| {
            let points: Vec<DVec2> = std::iter::once(at).chain(run.iter().map(|step| step.to)).collect();
            at = points.last().copied().unwrap_or(at);
            (run.first().map_or(Role::Connection, |step| step.role), points)
        })
        .collect()
}

/// A line as the commands of a path, perhaps with fewer points.
fn path(points: &[DVec2], off: f64) -> String {
    let mut text = String::new();
    for (k, &p) in kept(points, off).iter().filter_map(|&k| points.get(k)).enumerate() {
        let _ = write!(text, "{}{} {}", if k == 0 { 'M' } else { 'L' }, Num(p.x), Num(-p.y));
    }
    text
}
