//! From planned cycles to the strand.

use argil_slice::Layer;
use argil_strand::{Move, Role, Strand, StrandLayer, SupportSource};

use crate::descent::PlannedLayer;
use crate::opening::Opened;
use crate::precedence::Precedence;
use crate::skirt::Ground;
use crate::spiral::{Lie, aligned, spiral};
use crate::stages::Seam;
use crate::starts::opened_layers;
use crate::{Climb, PlanError, Settings, SkirtLaid};

/// A strand, and what is to be told of it.
pub(crate) struct Climbed {
    pub(crate) strand: Strand,
    /// How each layer lies; empty where no spiral was asked for.
    pub(crate) lies: Vec<Lie>,
    pub(crate) skirt: Option<SkirtLaid>,
    /// How much of each layer's outer walls is laid ahead of the others, where an order is asked for.
    pub(crate) ahead: Vec<Option<f64>>,
}

impl Climbed {
    /// How far the strand goes from the end of one layer to the start of the next at most, mm in the plane.
    pub(crate) fn longest_step(&self) -> f64 {
        let steps = self.strand.steps().filter(|step| step.role == Role::Seam);
        steps.map(|step| step.from.truncate().distance(step.to.truncate())).fold(0.0, f64::max)
    }
}

/// Joins the cycles, planned for these slices, by a chain of starts, with skirt and spiral as asked for. Where they are not `checked`, the starts stay where
/// the seam stage wants them.
pub(crate) fn climbed(
    (layers, slices): (&[PlannedLayer], &[Layer]),
    seam: &mut impl Seam,
    settings: &Settings,
    checked: bool,
) -> Result<Climbed, PlanError> {
    if !settings.spiral {
        return joined((layers, slices), seam, settings, checked);
    }
    let level = joined((&aligned(layers, settings)?, slices), seam, settings, checked)?;
    let (strand, lies) = spiral(level.strand, settings)?;
    if lies.iter().any(|lie| lie.climb != Climb::Step) {
        return Ok(Climbed { strand, lies, ..level });
    }
    // Where no layer rises at all, starts are hidden as they are in level layers.
    let level = joined((layers, slices), seam, &Settings { spiral: false, ..*settings }, checked)?;
    Ok(Climbed { lies, ..level })
}

/// The cycles as one strand of level layers, with its skirt.
fn joined(
    (layers, slices): (&[PlannedLayer], &[Layer]),
    seam: &mut impl Seam,
    settings: &Settings,
    checked: bool,
) -> Result<Climbed, PlanError> {
    let around = |skirt| Ground::new(&layers.first()?.curve, skirt, settings.width);
    let ground = settings.skirt.as_ref().and_then(around);
    let opened = match opened_layers((layers, slices), seam, settings, checked, ground.as_ref()) {
        // No chain begins in sight of the skirt: the part comes first.
        Err(_) if ground.is_some() => opened_layers((layers, slices), seam, settings, checked, None)?,
        opened => opened?,
    };
    let skirt =
        ground.zip(opened.first()).and_then(|(ground, (begin, _))| ground.moves(*begin, settings.grid));
    let ahead = |((layer, slice), (begin, _)): ((&PlannedLayer, &Layer), &Opened)| {
        Precedence::of(layer, slice, settings).map(|order| order.laid_ahead(*begin))
    };
    let ahead = layers.iter().zip(slices).zip(&opened).map(ahead).collect();
    let mut start = opened.first().map(|(begin, _)| *begin).unwrap_or_default();
    let mut laid = None;
    let mut leads = vec![Vec::new(); opened.len()];
    for (lead, (begin, _)) in leads.iter_mut().zip(&opened).skip(1) {
        lead.push(Move { to: *begin, role: Role::Seam });
    }
    if let (Some((begin, moves, told)), Some(lead)) = (skirt, leads.first_mut()) {
        (start, *lead, laid) = (begin, moves, Some(told));
    }
    let mut strand_layers = Vec::with_capacity(layers.len());
    for ((layer, (_, cycle)), mut moves) in layers.iter().zip(opened).zip(leads) {
        moves.extend(cycle);
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
    Ok(Climbed { strand: Strand::new(start, strand_layers)?, lies: Vec::new(), skirt: laid, ahead })
}
