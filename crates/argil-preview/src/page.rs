//! The whole strand as a page for a browser.

use std::fmt::{self, Write};

use argil_strand::{DVec2, Role, Strand};

use crate::Palette;
use crate::base64::Base64;
use crate::markup::{Escaped, Num};
use crate::outline::Outline;
use crate::widths::SHARES;

/// The frame of the page, with a word in braces where each part goes.
const FRAME: &str = include_str!("page/frame.html");
const STYLE: &str = include_str!("page/style.css");

/// The parts of the page's program, each after those that it uses.
const PROGRAM: [&str; 11] = [
    include_str!("page/plan.js"),
    include_str!("page/colours.js"),
    include_str!("page/camera.js"),
    include_str!("page/beads.js"),
    include_str!("page/solid_view.js"),
    include_str!("page/bead_tables.js"),
    include_str!("page/raster_view.js"),
    include_str!("page/player.js"),
    include_str!("page/pointer.js"),
    include_str!("page/marks.js"),
    include_str!("page/main.js"),
];

/// A place of the print that the page lists and leads to: a finding of an audit, a contact to be cleaned.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PageMark {
    /// What it is; places of one kind are listed together.
    pub kind: String,
    /// Whether it makes the print unsound. Faults are listed first.
    pub fault: bool,
    /// The layer's number ([`StrandLayer::index`](argil_strand::StrandLayer::index)).
    pub layer: usize,
    /// The number of the last layer that it reaches; that of its layer, for most.
    pub last_layer: usize,
    /// Where, mm; `None` leads to the layer.
    pub at: Option<DVec2>,
    /// How much, in the unit given.
    pub measure: f64,
    /// The unit of the measure, as shown; may be empty.
    pub unit: String,
}

/// What a page shows beside the strand.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct PageStyle {
    /// The page's title. Default `strand`.
    pub title: String,
    /// Facts about the plan, shown as a table in this order. Default none.
    pub facts: Vec<(String, String)>,
    /// Places to be listed. Default none.
    pub marks: Vec<PageMark>,
    /// Speed of the nozzle on the lowest layer and on the others, mm/s, for times and flow. Default 15 and 25. What is
    /// no positive number is replaced by the default.
    pub speeds: [f64; 2],
    /// Moves beyond which points are left out, to keep the page usable; it then says how many, and how far the drawn
    /// line may be off. Default 400,000, a page of about 3 MB.
    pub most_moves: usize,
    /// Colours by role.
    pub palette: Palette,
}

impl Default for PageStyle {
    fn default() -> Self {
        Self {
            title: "strand".to_owned(),
            facts: Vec::new(),
            marks: Vec::new(),
            speeds: [15.0, 25.0],
            most_moves: 400_000,
            palette: Palette::default(),
        }
    }
}

/// The whole strand as one self-contained HTML page that shows its beads in space.
///
/// The page needs a browser of today and nothing else: no network, no server, no script of others. It turns, zooms and
/// shows any range of layers, lays the strand before one's eyes, colours it by role, height, flow or marks, and leads
/// to every mark. It draws by WebGL 2, or on a plain canvas where there is none. Points are carried as integers of
/// 1/65,535 of the longer side.
///
/// # Complexity
/// O(n log n) in the number of moves; the page has 7 bytes for each, 12 where the strand rises, and 60 kB besides.
///
/// # Example
/// ```
/// # use argil_preview::strand::{DVec2, Move, Role, Strand, StrandLayer};
/// use argil_preview::{PageMark, PageStyle, page_html};
/// # let moves = [(9.0, 0.0), (0.0, 9.0), (0.0, 0.0)].map(|(x, y)| Move { to: DVec2::new(x, y), role: Role::Wall });
/// # let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves: moves.to_vec(), supports: vec![] };
/// # let strand = Strand::new(DVec2::ZERO, vec![layer]).unwrap();
/// let contact = PageMark {
///     kind: "contact".into(),
///     fault: false,
///     layer: 0,
///     last_layer: 0,
///     at: Some(DVec2::new(4.5, 4.5)),
///     measure: 2.5,
///     unit: "mm".into(),
/// };
/// let page = page_html(&strand, &PageStyle { marks: vec![contact], ..PageStyle::default() });
/// assert!(page.starts_with("<!doctype html>") && page.contains("\"marks\":[[0,0,4.5,4.5,2.5,0]]"));
/// assert!(!page.contains("http"));
/// ```
#[must_use]
pub fn page_html(strand: &Strand, style: &PageStyle) -> String {
    let outline = Outline::new(strand, style.most_moves);
    let mut page = String::new();
    let mut rest = FRAME;
    // The frame's words stand in the order in which they are met, so nothing that is put in is searched for words.
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let (word, after) = after.split_once("}}").unwrap_or((after, ""));
        match word {
            "title" => {
                let _ = write!(page, "{}", Escaped(&style.title));
            }
            "style" => page.push_str(STYLE),
            "plan" => {
                let _ = write!(page, "{}", PlanData { outline: &outline, style });
            }
            _ => PROGRAM.into_iter().for_each(|part| page.push_str(part)),
        }
        rest = after;
    }
    page.push_str(rest);
    page
}

/// The plan as JSON that can stand inside a script element.
struct PlanData<'a> {
    outline: &'a Outline,
    style: &'a PageStyle,
}

impl fmt::Display for PlanData<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { outline, style } = *self;
        let [first, others] = [0, 1].map(|k| {
            let speed = style.speeds[k];
            if speed > 0.0 && speed.is_finite() { speed } else { PageStyle::default().speeds[k] }
        });
        write!(f, "{{\"title\":{},\"facts\":", Quoted(&style.title))?;
        list(f, &style.facts, |f, (name, value)| write!(f, "[{},{}]", Quoted(name), Quoted(value)))?;
        write!(f, ",\"origin\":[{},{}],\"step\":{}", outline.origin.x, outline.origin.y, outline.step)?;
        write!(f, ",\"moves\":{},\"off\":{},\"layers\":", outline.moves, outline.off)?;
        let mut speed = first;
        list(f, &outline.layers, |f, layer| {
            let [z, height, width] = [layer.z, layer.height, layer.width].map(Fine);
            write!(f, "[{},{z},{height},{width},{},{speed}]", layer.index, layer.points)?;
            speed = others;
            Ok(())
        })?;
        write!(f, ",\"roles\":")?;
        list(f, &Role::ALL, |f, &role| write!(f, "[\"{role}\",\"{}\"]", style.palette.of(role)))?;
        let kinds = kinds(&style.marks);
        write!(f, ",\"kinds\":")?;
        list(f, &kinds, |f, kind| {
            write!(f, "[{},{},{}]", Quoted(&kind.kind), kind.fault, Quoted(&kind.unit))
        })?;
        write!(f, ",\"marks\":")?;
        let placed = style.marks.iter().filter_map(|mark| Some((mark, outline.position(mark.layer)?)));
        list(f, placed, |f, (mark, layer)| {
            let kind = kinds.iter().position(|kind| kind.kind == mark.kind).unwrap_or(0);
            write!(f, "[{kind},{layer},")?;
            match mark.at.filter(|at| at.is_finite()) {
                Some(at) => write!(f, "{},{}", Num(at.x), Num(at.y))?,
                None => f.write_str("null,null")?,
            }
            let last = outline.position(mark.last_layer).map_or(layer, |last| last.max(layer));
            write!(f, ",{},{last}]", Num(mark.measure))
        })?;
        let points: Vec<u8> = outline.points.iter().flatten().flat_map(|value| value.to_le_bytes()).collect();
        if !outline.rises.is_empty() {
            let rises: Vec<u8> =
                outline.rises.iter().flatten().flat_map(|value| value.to_le_bytes()).collect();
            write!(f, ",\"climb\":{},\"rises\":\"{}\"", outline.climb, Base64(&rises))?;
        }
        if !outline.widths.is_empty() {
            write!(f, ",\"shares\":{SHARES},\"widths\":\"{}\"", Base64(&outline.widths))?;
        }
        write!(f, ",\"points\":\"{}\",\"moveRoles\":\"{}\"}}", Base64(&points), Base64(&outline.roles))
    }
}

impl Outline {
    /// Position of the layer of a number, or of the one below where the strand skips it.
    fn position(&self, index: usize) -> Option<usize> {
        let above = self.layers.partition_point(|layer| layer.index <= index);
        (!self.layers.is_empty()).then(|| above.saturating_sub(1))
    }
}

/// One mark of each kind, faults first, otherwise in the order in which the kinds first occur.
fn kinds(marks: &[PageMark]) -> Vec<&PageMark> {
    let mut kinds: Vec<&PageMark> = Vec::new();
    for mark in marks {
        if !kinds.iter().any(|kind| kind.kind == mark.kind) {
            kinds.push(mark);
        }
    }
    kinds.sort_by_key(|kind| !kind.fault);
    kinds
}

/// A JSON array.
fn list<T>(
    f: &mut fmt::Formatter<'_>,
    items: impl IntoIterator<Item = T>,
    mut item: impl FnMut(&mut fmt::Formatter<'_>, T) -> fmt::Result,
) -> fmt::Result {
    f.write_str("[")?;
    for (k, value) in items.into_iter().enumerate() {
        if k > 0 {
            f.write_str(",")?;
        }
        item(f, value)?;
    }
    f.write_str("]")
}

/// A length to the millionth of a millimetre: prints of a bead of a hundredth have layers as well.
struct Fine(f64);

impl fmt::Display for Fine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded = (self.0 * 1e6).round() / 1e6;
        write!(f, "{}", if rounded.is_finite() { rounded } else { self.0 })
    }
}

/// A JSON string in which nothing can end the script element that holds it.
struct Quoted<'t>(&'t str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"")?;
        for c in self.0.chars() {
            match c {
                '"' => f.write_str("\\\"")?,
                '\\' => f.write_str("\\\\")?,
                c if c.is_control() || matches!(c, '<' | '>' | '&' | '\u{2028}' | '\u{2029}') => {
                    write!(f, "\\u{:04x}", c as u32)?;
                }
                c => write!(f, "{c}")?,
            }
        }
        f.write_str("\"")
    }
}

#[cfg(test)]
mod tests {
    use super::{FRAME, Fine, PROGRAM, Quoted, STYLE};

    #[test]
    fn text_stays_inside_its_quotes_and_its_script() {
        assert_eq!(Quoted("a\"b\\c").to_string(), r#""a\"b\\c""#);
        assert_eq!(Quoted("</script>\n\u{2028}").to_string(), r#""\u003c/script\u003e\u000a\u2028""#);
    }

    #[test]
    fn the_frame_has_one_place_for_each_part() {
        let words: Vec<&str> = FRAME.split("{{").skip(1).filter_map(|rest| rest.split("}}").next()).collect();
        assert_eq!(words, ["title", "style", "plan", "program"]);
        for part in PROGRAM {
            assert!(!part.contains("</script") && !part.contains("<!--"));
        }
        assert!(!STYLE.contains("</style"));
    }

    #[test]
    fn lengths_keep_the_thinnest_layer() {
        assert_eq!([0.3, 0.1 + 0.2, 1e-5, 1e300].map(|v| Fine(v).to_string().len() < 310), [true; 4]);
        assert_eq!(Fine(0.1 + 0.2).to_string(), "0.3");
    }
}
