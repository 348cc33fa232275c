//! The paper's text, taken literally where it is definite: for comparison, not for printing.

use crate::Planner;

/// A planner whose stages follow the paper.
#[must_use]
pub fn planner() -> Planner {
    Planner { checked: false, ..Planner::default() }
}
