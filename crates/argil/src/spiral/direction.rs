//! Which way round the layers of a spiral go.

use argil_curve::{ClosedCurve, Segment, SegmentIndex};

use crate::PlanError;
use crate::descent::PlannedLayer;
use crate::settings::Settings;

/// The layers, each running the way that the one below runs where one lies on the other. A cycle is as sound backwards, but one that runs against
/// the one below is at its end where that began: no bead between them has a turn's height.
///
/// # Errors
/// None that a cycle of a plan can cause: it is a curve in both directions.
pub(crate) fn aligned(layers: &[PlannedLayer], settings: &Settings) -> Result<Vec<PlannedLayer>, PlanError> {
    let mut aligned: Vec<PlannedLayer> = Vec::with_capacity(layers.len());
    for layer in layers {
        let against = aligned.last().is_some_and(|below| runs_against(&layer.curve, &below.curve, settings));
        let way = if against { backwards(layer) } else { Ok(layer.clone()) };
        aligned.push(way.map_err(|fault| PlanError::Layer {
            layer: layer.report.index,
            near: layer.curve.points().first().copied().unwrap_or_default(),
            fault: fault.into(),
        })?);
    }
    Ok(aligned)
}

/// Whether the greater part of a cycle runs against what it lies on.
fn runs_against(cycle: &ClosedCurve, below: &ClosedCurve, settings: &Settings) -> bool {
    let index = SegmentIndex::of_curves([below], settings.width);
    let across = settings.criterion().across;
    let along = |side: Segment| {
        let Some(nearest) = index.nearest_within(side.point_at(0.5), across) else { return 0.0 };
        let Some(under) = index.segments().get(nearest.index) else { return 0.0 };
        (side.end - side.start).dot((under.end - under.start).normalize_or_zero())
    };
    cycle.segments().map(along).sum::<f64>() < 0.0
}

/// The same layer the other way round.
fn backwards(layer: &PlannedLayer) -> Result<PlannedLayer, argil_curve::CurveError> {
    let n = layer.curve.segment_count();
    let points = layer.curve.points().iter().rev().copied().collect();
    let last = layer.curve.arc_of(n - 1);
    let curve = ClosedCurve::new(points)?;
    // The side behind a point is now the one before it.
    let side = |k: usize| (2 * n - 2 - k) % n;
    Ok(PlannedLayer {
        foothold: curve.wrapped(last - layer.foothold),
        curve,
        legs: (0..n).map(|k| layer.legs[side(k)]).collect(),
        fill: (0..n).map(|k| layer.fill[side(k)]).collect(),
        ..layer.clone()
    })
}
