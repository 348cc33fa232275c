//! What goes in and what comes out.

use glam::DVec2;

use crate::ElasticError;

/// A vertex that holds something above: it stays within the envelope of `anchor`.
///
/// A vertex may appear in several carriers; it then stays inside the intersection of their discs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Carrier {
    /// Index into [`Path::points`].
    pub vertex: usize,
    /// The point of the layer above that needs support, mm.
    pub anchor: DVec2,
}

/// A signed distance field to keep clear of: the safeguard of the model (Sec. 3.4).
///
/// A trait and not a polygon, because the planner already holds an index over the safeguard's edges, and because
/// the paper's implicit surface ([`ImlsField`](crate::ImlsField)) is another answer to the same question.
pub trait Clearance {
    /// Signed distance from `p` in mm, positive outside the safeguard, and its gradient by `p`.
    ///
    /// The gradient of an exact distance has unit length. A result that is not finite counts as infinitely far away.
    fn distance(&self, p: DVec2) -> (f64, DVec2);
}

/// One layer's candidate cycle and what is known about its vertices.
///
/// The walls are part of the cycle, as fixed vertices; free vertices should lie about w/2 apart.
#[derive(Clone, Copy)]
pub struct Path<'a> {
    /// The closed polyline in mm; the last point is not repeated.
    pub points: &'a [DVec2],
    /// For every vertex whether it must not move.
    pub fixed: &'a [bool],
    /// The vertices that hold the layer above, in any order.
    pub carriers: &'a [Carrier],
    /// The field that free vertices keep clear of, if any.
    pub clear_of: Option<&'a dyn Clearance>,
    /// For every vertex whether it feels `clear_of`; empty if none does.
    ///
    /// Strands inside the model must not feel it: there the field would push them through the wall.
    pub felt: &'a [bool],
}

impl std::fmt::Debug for Path<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Path")
            .field("points", &self.points)
            .field("fixed", &self.fixed)
            .field("carriers", &self.carriers)
            .field("clear_of", &self.clear_of.is_some())
            .field("felt", &self.felt)
            .finish()
    }
}

impl Path<'_> {
    /// Refuses lists of unequal length and points that are no numbers.
    pub(crate) fn check(&self) -> Result<(), ElasticError> {
        let expected = self.points.len();
        if self.fixed.len() != expected {
            return Err(ElasticError::LengthMismatch { list: "fixed", found: self.fixed.len(), expected });
        }
        if !self.felt.is_empty() && self.felt.len() != expected {
            return Err(ElasticError::LengthMismatch { list: "felt", found: self.felt.len(), expected });
        }
        if let Some(vertex) = self.points.iter().position(|p| !p.is_finite()) {
            return Err(ElasticError::PointNotFinite { vertex });
        }
        for (carrier, c) in self.carriers.iter().enumerate() {
            if c.vertex >= expected || !c.anchor.is_finite() {
                return Err(ElasticError::BadCarrier { carrier, vertex: c.vertex });
            }
        }
        Ok(())
    }
}

/// Why the relaxation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Stop {
    /// The last Newton step was shorter than the tolerance.
    Converged,
    /// The cap on iterations was reached; the usual case where strands repel each other.
    IterationCap,
    /// No step that lowers the energy, crosses nothing and stays in all envelopes was found.
    NoProgress,
}

/// The relaxed path.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Relaxed {
    /// As many points as went in, in mm; fixed ones are the very same bits.
    pub points: Vec<DVec2>,
    /// Energy of the candidate, in w.
    pub energy_before: f64,
    /// Energy of the result, in w; never above `energy_before`.
    pub energy_after: f64,
    /// Steps taken.
    pub iterations: usize,
    /// Why no further step was taken.
    pub stop: Stop,
}
