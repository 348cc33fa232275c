//! The rule that a layer must satisfy to hold the one above.

use argil_curve::{ArcSpan, ClosedCurve, SegmentIndex, gaps, held_spans};

/// How far a strand of paste may lie beside the strand below, and how far it may bridge (Sec. 3.2 of the
/// paper).
///
/// Both belong to the paste and are found by test prints; the default is the paper's clay at a bead of 1.5
/// mm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Criterion {
    /// `ε_across`: a point is held when some point of the layer below lies within this of it in the plane,
    /// mm.
    pub across: f64,
    /// `ε_along`: the longest stretch of path that may be held nowhere between its ends, mm.
    pub along: f64,
}

impl Criterion {
    /// The paper's values for its clay and a bead of width `w` mm: `ε_across` = 0.3 w, `ε_along` = 1.6 w.
    #[must_use]
    pub fn for_width(w: f64) -> Self {
        Self { across: 0.3 * w, along: 1.6 * w }
    }
}

impl Default for Criterion {
    fn default() -> Self {
        Self::for_width(1.5)
    }
}

/// The stretches of `above` that hang: every maximal run held nowhere by `below` that is longer than
/// `ε_along`, in the order of their starts.
///
/// The paper tests samples one `ε_along` apart and lets each lean on a contact up to half of it away, on
/// either side; two samples may lean away from each other, so gaps of up to twice `ε_along` pass. Here a
/// point is held when it lies within `ε_across` of the layer below, the held stretches are exact, and no run
/// between them may be longer than `ε_along`.
///
/// A curve that nothing holds is one span of its full length, however short it is: it rests on nothing, so
/// there is no bridge to measure. A limit that is not a number holds nothing.
///
/// # Complexity
/// That of [`held_spans`]: near-linear.
///
/// # Example
/// ```
/// use argil_support::{ClosedCurve, Criterion, DVec2, Segment, SegmentIndex, unsupported_spans};
/// let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)];
/// let square = ClosedCurve::new(square.map(DVec2::from).to_vec())?;
/// // Everything but the right side stands on strand.
/// let below = [(9.0, 9.0), (0.0, 9.0), (0.0, 0.0), (9.0, 0.0)].map(DVec2::from);
/// let below = below.windows(2).map(|e| Segment::new(e[0], e[1])).collect();
/// let below = SegmentIndex::new(below, 1.0);
/// let hanging = unsupported_spans(&square, &below, &Criterion { across: 0.5, along: 2.4 });
/// assert_eq!(hanging.len(), 1);
/// assert!((hanging[0].start - 9.5).abs() < 1e-9 && (hanging[0].length - 8.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn unsupported_spans(above: &ClosedCurve, below: &SegmentIndex, criterion: &Criterion) -> Vec<ArcSpan> {
    let held = held_spans(above, below, criterion.across);
    let mut hanging = gaps(above.length(), &held);
    if !held.is_empty() {
        hanging.retain(|span| span.length > criterion.along || criterion.along.is_nan());
    }
    hanging
}
