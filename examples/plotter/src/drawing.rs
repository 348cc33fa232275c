//! Drawings as text.

use std::fmt;

use argil::curve::DVec2;

/// A word that is no point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DrawingError {
    /// The line it stands on, counted from 1.
    pub line: usize,
    /// The word.
    pub word: String,
}

impl fmt::Display for DrawingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: `{}` is no point x,y in millimetres", self.line, self.word)
    }
}

impl std::error::Error for DrawingError {}

/// Reads a closed outline a line: points `x,y` in millimetres; `#` begins a comment.
///
/// # Errors
/// The first word that is no point.
///
/// # Example
/// ```
/// let loops = argil_plotter::read_drawing("# a triangle\n0,0 9,0 4.5,8\n")?;
/// assert_eq!(loops[0].len(), 3);
/// assert_eq!(argil_plotter::read_drawing("0,0\n1,one").unwrap_err().line, 2);
/// # Ok::<(), argil_plotter::DrawingError>(())
/// ```
pub fn read_drawing(text: &str) -> Result<Vec<Vec<DVec2>>, DrawingError> {
    let mut loops = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let words = line.split('#').next().unwrap_or_default().split_whitespace();
        let points = words
            .map(|word| point(word).ok_or_else(|| DrawingError { line: k + 1, word: word.to_owned() }))
            .collect::<Result<Vec<_>, _>>()?;
        if !points.is_empty() {
            loops.push(points);
        }
    }
    Ok(loops)
}

fn point(word: &str) -> Option<DVec2> {
    let (x, y) = word.split_once(',')?;
    let point = DVec2::new(x.parse().ok()?, y.parse().ok()?);
    point.is_finite().then_some(point)
}
