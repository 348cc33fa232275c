//! From planned cycles to the strand.

use argil_strand::{Move, Role, Strand, StrandLayer, SupportSource};

use crate::descent::PlannedLayer;
use crate::stages::Seam;
use crate::starts::opened_layers;
use crate::{PlanError, Settings};

/// Joins the cycles by a chain of starts. Where they are not `checked`, the starts stay where the seam stage wants them.
pub(crate) fn strand(
    layers: &[PlannedLayer],
    seam: &mut impl Seam,
    settings: &Settings,
    checked: bool,
) -> Result<Strand, PlanError> {
    let mut strand_layers = Vec::with_capacity(layers.len());
    let mut first = None;
    for (layer, (begin, mut moves)) in layers.iter().zip(opened_layers(layers, seam, settings, checked)?) {
        match first {
            None => first = Some(begin),
            Some(_) => moves.insert(0, Move { to: begin, role: Role::Seam }),
        }
        let supports =
            layer.supports.iter().map(|s| SupportSource { at: s.position, needs: s.needs.clone() }).collect();
        strand_layers.push(StrandLayer {
            index: layer.report.index,
            z: layer.z,
            height: settings.layer_height,
            width: settings.width,
            moves,
            supports,
        });
    }
    Ok(Strand::new(first.unwrap_or_default(), strand_layers)?)
}
