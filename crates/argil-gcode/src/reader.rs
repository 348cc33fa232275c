//! G-code of any slicer back into moves.

use std::collections::BTreeMap;

use crate::arc::{Arc, Centre};
use crate::words::{Word, words};
use crate::{BadLine, Fault, Move, Program};

/// How far the chords that stand for an arc may be from it, mm: a fiftieth of a thin bead.
pub const ARC_TOLERANCE: f64 = 0.02;

/// Reads g-code as a machine would, with the layers and types that its comments give.
///
/// Understood are the moves G0 and G1, arcs G2 and G3 (as chords, [`ARC_TOLERANCE`]), the modes G90, G91, M82 and M83,
/// G92, and the comments `;LAYER:n`, `;LAYER_CHANGE` and `;TYPE:word`. Line numbers (N) are passed over. G90 and G91
/// leave the mode of E alone; some firmwares switch E as well, so a portable file sets M82 or M83 after them. Every
/// other line is none of a path's business and is skipped. The machine is taken to begin at the origin, with absolute
/// coordinates and absolute E.
///
/// No text makes this fail: what cannot be read is listed in [`Program::bad_lines`] and otherwise left out.
///
/// # Complexity
/// O(n) in the length of the text; the moves hold no text.
///
/// # Example
/// ```
/// let program = argil_gcode::read_gcode("M83\n;LAYER:4\n;TYPE:SUPPORT\nG1 X3 Y4 E.5 F1500 ; there\nG28\nG1 X0 E1e999");
/// assert_eq!(program.moves.len(), 1);
/// let step = &program.moves[0];
/// assert_eq!((step.to, step.extruded, step.layer, step.line), ([3.0, 4.0, 0.0], 0.5, Some(4), 4));
/// assert_eq!(program.kind_of(step), Some("SUPPORT"));
/// assert_eq!(program.bad_lines[0].line, 6);
/// ```
#[must_use]
pub fn read_gcode(text: &str) -> Program {
    let mut machine = Machine::default();
    let unix = text.split('\n').map(|line| line.strip_suffix('\r').unwrap_or(line));
    // A carriage return alone ends a line too, as old systems wrote it.
    for (k, line) in unix.flat_map(|line| line.split('\r')).enumerate() {
        machine.line = k + 1;
        let (code, comment) = line.split_once(';').unwrap_or((line, ""));
        machine.comment(comment.trim());
        machine.code(code);
    }
    machine.program
}

/// The numbers of a line's words, by letter; the last of a letter counts.
#[derive(Default)]
struct Words {
    of: [Option<f64>; 26],
}

impl Words {
    fn get(&self, letter: u8) -> Option<f64> {
        self.of.get(usize::from(letter.wrapping_sub(b'A'))).copied().flatten()
    }

    fn set(&mut self, word: Word) {
        if let Some(place) = self.of.get_mut(usize::from(word.letter.wrapping_sub(b'A'))) {
            *place = Some(word.value);
        }
    }
}

/// What a machine knows between two lines.
#[derive(Default)]
struct Machine {
    at: [f64; 3],
    e: f64,
    relative: bool,
    relative_e: bool,
    layer: Option<i64>,
    kind: Option<usize>,
    known: BTreeMap<String, usize>,
    line: usize,
    program: Program,
}

impl Machine {
    fn bad(&mut self, fault: Fault) {
        self.program.bad_lines.push(BadLine { line: self.line, fault });
    }

    fn comment(&mut self, comment: &str) {
        if let Some(number) = after(comment, "LAYER:") {
            if let Some(Ok(number)) = number.split_whitespace().next().map(str::parse) {
                self.layer = Some(number);
            }
        } else if after(comment, "LAYER_CHANGE").is_some() {
            self.layer = Some(self.layer.map_or(0, |layer| layer.saturating_add(1)));
        } else if let Some(word) = after(comment, "TYPE:") {
            let word = word.trim();
            self.kind = Some(match self.known.get(word) {
                Some(&kind) => kind,
                None => {
                    let kind = self.program.kinds.len();
                    self.program.kinds.push(word.to_owned());
                    self.known.insert(word.to_owned(), kind);
                    kind
                }
            });
        }
    }

    fn code(&mut self, code: &str) {
        let mut line = words(code).skip_while(|word| word.letter == b'N');
        let Some(command) = line.next() else { return };
        if !matches!(command.letter, b'G' | b'M') {
            return;
        }
        let mut given = Words::default();
        let mut finite = command.value.is_finite();
        for word in line {
            finite &= word.value.is_finite();
            given.set(word);
        }
        if !finite {
            return self.bad(Fault::NotFinite);
        }
        // `as` saturates and cuts off a sub-code: G92.1 is read as G92.
        match (command.letter, command.value as i64) {
            (b'G', 0 | 1) => self.straight(&given),
            (b'G', turn @ (2 | 3)) => self.arc(&given, turn == 2),
            (b'G', 20) => self.bad(Fault::Inches),
            (b'G', 90) => self.relative = false,
            (b'G', 91) => self.relative = true,
            (b'G', 92) => {
                for (axis, letter) in self.at.iter_mut().zip(*b"XYZ") {
                    *axis = given.get(letter).unwrap_or(*axis);
                }
                self.e = given.get(b'E').unwrap_or(self.e);
            }
            (b'M', 82) => self.relative_e = false,
            (b'M', 83) => self.relative_e = true,
            _ => {}
        }
    }

    /// Where a line's coordinates lead and what its E pushes out; the machine's E is moved on.
    fn target(&mut self, given: &Words) -> Option<([f64; 3], f64)> {
        let mut to = self.at;
        for (axis, letter) in to.iter_mut().zip(*b"XYZ") {
            if let Some(value) = given.get(letter) {
                *axis = if self.relative { *axis + value } else { value };
            }
        }
        let pushed = match given.get(b'E') {
            None => 0.0,
            Some(amount) if self.relative_e => amount,
            Some(amount) => amount - self.e,
        };
        if !(pushed.is_finite() && to.iter().all(|value| value.is_finite())) {
            self.bad(Fault::NotFinite);
            return None;
        }
        if let (Some(amount), false) = (given.get(b'E'), self.relative_e) {
            self.e = amount;
        }
        Some((to, pushed))
    }

    fn go(&mut self, to: [f64; 3], extruded: f64) {
        let Self { at, layer, kind, line, .. } = *self;
        self.program.moves.push(Move { from: at, to, extruded, layer, kind, line });
        self.at = to;
    }

    fn straight(&mut self, given: &Words) {
        if let Some((to, pushed)) = self.target(given) {
            self.go(to, pushed);
        }
    }

    /// An arc in the XY plane, as chords that share rise and E by their number, which are equally long.
    fn arc(&mut self, given: &Words, clockwise: bool) {
        let Some((to, pushed)) = self.target(given) else { return };
        let from = self.at;
        let centre = match (given.get(b'R'), given.get(b'I'), given.get(b'J')) {
            (Some(radius), _, _) => Some(Centre::Radius(radius)),
            (None, None, None) => None,
            (None, i, j) => Some(Centre::Offset([i.unwrap_or(0.0), j.unwrap_or(0.0)])),
        };
        let arc = Arc { start: [from[0], from[1]], end: [to[0], to[1]], clockwise };
        let Some(points) = centre.and_then(|centre| arc.chords(centre, ARC_TOLERANCE)) else {
            self.bad(Fault::BadArc);
            return self.go(to, pushed);
        };
        let count = points.len() as f64;
        for (k, [x, y]) in points.into_iter().enumerate() {
            let share = (k + 1) as f64 / count;
            self.go([x, y, from[2] + (to[2] - from[2]) * share], pushed / count);
        }
    }
}

/// What follows a word at the beginning of a comment, whatever its case.
fn after<'t>(comment: &'t str, word: &str) -> Option<&'t str> {
    let head = comment.get(..word.len())?;
    // The head ends between characters, or there would be none.
    head.eq_ignore_ascii_case(word).then(|| &comment[word.len()..])
}
