//! The page that says where to cut: the audit's contact ledger with what to do about each cause.

use argil::Plan;
use argil_audit::{ContactCause, ContactPlace, Report};
use argil_preview::{CleaningStyle, CutPlace, cleaning_html};

use crate::preview_page::short_name;

/// The guide of a plan, from the contacts that its audit found.
pub(crate) fn cleaning_page(model: &str, plan: &Plan, audit: &Report) -> String {
    let places: Vec<CutPlace> = audit.contacts.iter().map(place).collect();
    let style = CleaningStyle { title: short_name(model).to_owned(), ..CleaningStyle::default() };
    cleaning_html(&plan.strand, &places, &style)
}

fn place(contact: &ContactPlace) -> CutPlace {
    CutPlace {
        cause: contact.cause.name().to_owned(),
        advice: advice(contact.cause).to_owned(),
        at_roots: contact.cause == ContactCause::Root,
        first_layer: usize::try_from(contact.first_layer).unwrap_or(0),
        last_layer: usize::try_from(contact.last_layer).unwrap_or(0),
        at: [contact.at.x, contact.at.y].into(),
        length: contact.length,
    }
}

/// What a cause asks of the hand that holds the blade.
fn advice(cause: ContactCause) -> &'static str {
    match cause {
        ContactCause::Root => "Cut across the strand along the wall: here it leaves the model or joins it.",
        ContactCause::Enclosed => {
            "The model is all round: cut what leads there, then take it out from above, or leave it in."
        }
        ContactCause::Overhang => {
            "It carries the wall that juts out above: draw a thin blade along the wall, below that edge."
        }
        ContactCause::Narrow => {
            "It lies between two parts of the model: saw it loose with a wire from the open end."
        }
        _ => "It runs along the wall: draw a blade along between the two.",
    }
}
