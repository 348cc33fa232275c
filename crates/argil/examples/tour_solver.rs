//! Another solver of tours in argil's planner: the nearest stop next, then turned round piece by piece.
//!
//! What it gives is checked like argil's own, so that a poor solver costs strand and never soundness.

use std::error::Error;

use argil::route::{Metric, TourDistances, TourOptions, Tours};
use argil::stages::ExcursionsBy;
use argil::{Planner, Settings};
use argil_audit::{AuditSettings, audit, gcode::read_gcode};

/// Always on to the nearest stop that is left, then 2-opt until nothing is gained.
struct NearestThenTurned;

impl Tours for NearestThenTurned {
    fn order(&self, distances: &TourDistances, _: Option<&[usize]>, _: &TourOptions) -> Vec<usize> {
        let n = distances.nodes();
        let mut left: Vec<usize> = (0..n).collect();
        let mut order: Vec<usize> = Vec::with_capacity(n);
        while !left.is_empty() {
            let far = |stop: usize| order.last().map_or(0.0, |&here| distances.distance(here, stop));
            let nearest = (0..left.len()).min_by(|&a, &b| far(left[a]).total_cmp(&far(left[b])));
            let next = left.remove(nearest.unwrap_or_default());
            order.push(next);
        }
        let d = |order: &[usize], a: usize, b: usize| distances.distance(order[a % n], order[b % n]);
        while let Some((from, to)) =
            (1..n).flat_map(|from| (from + 1..n).map(move |to| (from, to))).find(|&(a, b)| {
                d(&order, a - 1, b) + d(&order, a, b + 1) + 1e-9 < d(&order, a - 1, a) + d(&order, b, b + 1)
            })
        {
            order[from..=to].reverse();
        }
        order
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mesh = argil::mesh::read_stl(&argil_models::by_name("columns").ok_or("no such model")?.to_stl())?;
    let settings = Settings::for_width(2.5);
    let own = Planner::default();
    let mut planner = Planner {
        route: ExcursionsBy(NearestThenTurned),
        slice: own.slice,
        safeguard: own.safeguard,
        support: own.support,
        smooth: own.smooth,
        taut: own.taut,
        seam: own.seam,
        checked: own.checked,
    };
    let plan = planner.plan(&mesh, &settings)?;

    let text = argil::gcode::write_gcode(&plan.strand, &argil::gcode::GcodeSettings::default())?;
    let report = audit(&read_gcode(&text), &mesh, &AuditSettings::for_width(settings.width))?;
    assert!(report.is_sound(), "{report}");
    Ok(())
}
