//! What a g-code file makes a machine do.

/// A straight move, extruding or not.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Move {
    /// Where it begins, mm.
    pub from: [f64; 3],
    /// Where it ends, mm.
    pub to: [f64; 3],
    /// What it pushes out, in the file's unit of E; negative for a retraction.
    pub extruded: f64,
    /// The layer that the file's comments say it belongs to; `None` before the first such comment.
    pub layer: Option<i64>,
    /// Which of [`Program::kinds`] the file's comments say it is; `None` before the first such comment.
    pub kind: Option<usize>,
    /// The line it stands on, counted from 1.
    pub line: usize,
}

impl Move {
    /// Length in the plane, mm.
    #[must_use]
    pub fn planar_length(&self) -> f64 {
        (self.to[0] - self.from[0]).hypot(self.to[1] - self.from[1])
    }
}

/// What is wrong with a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Fault {
    /// A number too large for arithmetic, or a position that became one.
    NotFinite,
    /// An arc whose centre or radius does not fit its ends; it is read as a straight move.
    BadArc,
    /// Coordinates in inches (G20), which are read as if they were millimetres.
    Inches,
}

/// A line that could not be read as it was meant.
///
/// # Example
/// ```
/// use argil_gcode::{ARC_TOLERANCE, BadLine, Fault, read_gcode};
/// let program = read_gcode("G20\nG2 X10 Y0 I1 J0 E1\nG2 X20 Y0 I5 J0 E2\n");
/// let inches = BadLine { line: 1, fault: Fault::Inches };
/// assert_eq!(program.bad_lines, [inches, BadLine { line: 2, fault: Fault::BadArc }]);
/// // The arc on line 2 fits its ends nowhere, that on line 3 is half a circle in short moves.
/// let length: f64 = program.moves[1..].iter().map(argil_gcode::Move::planar_length).sum();
/// assert!((length - 5.0 * std::f64::consts::PI).abs() < ARC_TOLERANCE * program.moves.len() as f64);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BadLine {
    /// Its number, counted from 1.
    pub line: usize,
    /// What is wrong with it.
    pub fault: Fault,
}

/// The moves of a g-code file, with what its comments say about them.
///
/// # Example
/// ```
/// use argil_gcode::{Program, read_gcode};
/// let program: Program = read_gcode("M83\nG0 X5\n;TYPE:WALL-OUTER\nG1 X9 E2\nG1 Y9 E2\nG0 Z9\n");
/// let strand = program.strand_moves();
/// assert_eq!((program.moves.len(), strand.len()), (4, 2));
/// assert_eq!(program.kind_of(&strand[0]), Some("WALL-OUTER"));
/// assert_eq!(program.extruded(), 4.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Program {
    /// Every move, in order; each begins where the one before ended, but for G92.
    pub moves: Vec<Move>,
    /// The words after `;TYPE:`, in the order in which they first occur.
    pub kinds: Vec<String>,
    /// Lines that could not be read as they were meant. A sound file has none.
    pub bad_lines: Vec<BadLine>,
}

impl Program {
    /// The word that the file gives a move, if any.
    #[must_use]
    pub fn kind_of(&self, step: &Move) -> Option<&str> {
        self.kinds.get(step.kind?).map(String::as_str)
    }

    /// Sum of what is pushed out, in the file's unit of E; retractions count against it.
    #[must_use]
    pub fn extruded(&self) -> f64 {
        self.moves.iter().map(|step| step.extruded).sum()
    }

    /// The moves from the first to the last that extrude while moving in the plane: what is left when approach,
    /// priming on the spot and departure are cut off.
    #[must_use]
    pub fn strand_moves(&self) -> &[Move] {
        let lays = |step: &Move| step.extruded > 1e-9 && step.planar_length() > 1e-6;
        let first = self.moves.iter().position(lays);
        let last = self.moves.iter().rposition(lays);
        match (first, last) {
            (Some(first), Some(last)) => &self.moves[first..=last],
            _ => &[],
        }
    }
}
