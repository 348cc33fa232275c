//! What is wrong with the plan of a body.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

use argil::{PlanError, Planner, Settings};
use argil_audit::FindingKind;

use super::Body;
use crate::invariants::departures;
use crate::verdict::audited;

/// A fault: of which kind, and in words.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    /// Equal for faults of one sort, wherever they are.
    pub(crate) kind: String,
    said: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind, self.said)
    }
}

/// The first fault of a body's plan: a panic, an error, a figure short of its limit, a departure from what must hold of
/// every strand, or clay that is missing where the plan tells of no loss.
pub(crate) fn fault(body: &Body, settings: &Settings) -> Option<Fault> {
    let panic = |_| Some(Fault { kind: "panic".to_owned(), said: String::new() });
    catch_unwind(AssertUnwindSafe(|| planned(body, settings))).unwrap_or_else(panic)
}

fn planned(body: &Body, settings: &Settings) -> Option<Fault> {
    let mesh = body.mesh()?;
    let mut planner = Planner::default();
    let (layers, plan) = match planner.slices(&mesh, settings) {
        Ok(layers) => {
            let plan = planner.plan_layers(&layers, settings);
            (layers, plan)
        }
        // A body of less than a layer.
        Err(PlanError::Slice(_)) => return None,
        Err(error) => return Some(Fault { kind: "settings".to_owned(), said: error.to_string() }),
    };
    let plan = match plan {
        Ok(plan) => plan,
        // A body of which nothing is as thick as a bead.
        Err(PlanError::Nothing) => return None,
        Err(error) => {
            let kind = match &error {
                PlanError::Layer { fault, .. } => {
                    fault.to_string().chars().filter(|c| !c.is_numeric()).collect()
                }
                PlanError::Seam(_) => "seam".to_owned(),
                _ => "error".to_owned(),
            };
            return Some(Fault { kind, said: error.to_string() });
        }
    };
    let report = audited(&plan, &mesh, settings);
    let short = report.falls_short();
    if !short.is_empty() {
        let kind = short.iter().map(|s| s.figure).collect::<Vec<_>>().join(" + ");
        let values =
            short.iter().map(|s| format!("{} is {:.4}", s.figure, s.value)).collect::<Vec<_>>().join(", ");
        let first = report.findings.iter().find(|found| is_fault(found.kind));
        return Some(Fault { kind, said: format!("{values}; {first:?}") });
    }
    let found = departures(&plan, &layers, settings);
    if let Some(first) = found.first() {
        return Some(Fault { kind: "departure".to_owned(), said: first.clone() });
    }
    let is_told = |layer: i64| plan.losses.iter().any(|loss| i64::try_from(loss.layer()) == Ok(layer));
    let silent = report.findings_of(FindingKind::BareOutline).find(|bare| !is_told(bare.layer));
    silent.map(|bare| Fault { kind: "silent loss".to_owned(), said: format!("{bare:?}") })
}

/// Whether a finding of this kind makes a print unsound.
fn is_fault(kind: FindingKind) -> bool {
    use FindingKind::{BareFill, BareOutline, Contact, Jump, SharpBend, SharpTurn};
    !matches!(kind, BareFill | BareOutline | Contact | Jump | SharpBend | SharpTurn)
}
