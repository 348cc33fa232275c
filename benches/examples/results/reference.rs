//! What others measured, and what no plan can go below.

use argil_audit::Report;

use crate::document::Table;

/// Names of the models that are looked for.
pub(crate) const NAMES: [&str; 18] = [
    "bunny",
    "gargoyle",
    "thinker",
    "two-cats",
    "wrestlers-ugolino",
    "spire-made",
    "legs-a",
    "arms-v",
    "arch",
    "cat-concrete",
    "castle",
    "vase-antique",
    "bowl",
    "teapot",
    "vase-twist",
    "broken-stool",
    "cura-testmodel",
    "spire-branches16",
];

/// Figures of others for one model: ratios, and transfers of the two slicers.
struct Others {
    name: &'static str,
    /// Table 1 of the paper, on its own meshes.
    paper: &'static str,
    /// A Python prototype of the method.
    prototype: &'static str,
    /// `CuraEngine` 4.13 and `PrusaSlicer` 2.5 with supports: ratio, transfers.
    cura: (f64, usize),
    prusa: (f64, usize),
    /// Estimates of what no plan goes below: by the support rule alone, and with tips that retract by as much as a U-turn of
    /// one bead can, 0.64 w a layer.
    bounds: Option<(f64, f64)>,
}

const OTHERS: [Others; 6] = [
    Others {
        name: "bunny",
        paper: "0.26",
        prototype: "0.67",
        cura: (1.07, 646),
        prusa: (0.88, 485),
        bounds: Some((0.06, 0.08)),
    },
    Others {
        name: "gargoyle",
        paper: "1.4",
        prototype: "0.42",
        cura: (1.96, 1042),
        prusa: (1.68, 766),
        bounds: Some((0.14, 0.18)),
    },
    Others {
        name: "thinker",
        paper: "1.0",
        prototype: "0.38",
        cura: (0.82, 729),
        prusa: (0.71, 554),
        bounds: Some((0.07, 0.08)),
    },
    Others {
        name: "two-cats",
        paper: "1.0",
        prototype: "0.26, not sound",
        cura: (0.46, 1080),
        prusa: (0.49, 1217),
        bounds: None,
    },
    Others {
        name: "wrestlers-ugolino",
        paper: "1.3",
        prototype: "0.50",
        cura: (0.56, 785),
        prusa: (0.49, 530),
        bounds: None,
    },
    Others {
        name: "spire-made",
        paper: "0.75",
        prototype: "0.36",
        cura: (0.0, 341),
        prusa: (0.0, 338),
        bounds: Some((0.19, 0.32)),
    },
];

/// The ratios of one wall beside those of others.
pub(crate) fn beside(one_wall: &[(String, Report)]) -> Table {
    let mut table = Table::new(&[
        "model",
        "argil",
        "paper",
        "prototype",
        "CuraEngine: ratio, transfers",
        "PrusaSlicer: ratio, transfers",
        "bound by the rule",
        "bound by U-turns",
    ]);
    for others in &OTHERS {
        let Some((_, report)) = one_wall.iter().find(|(name, _)| name == others.name) else { continue };
        let slicer = |(ratio, transfers): (f64, usize)| format!("{ratio:.2}, {transfers}");
        let bound = |pick: fn((f64, f64)) -> f64| {
            others.bounds.map_or("–".to_owned(), |bounds| format!("{:.2}", pick(bounds)))
        };
        table.row(vec![
            others.name.to_owned(),
            format!("{:.3}", report.figures.material_ratio),
            others.paper.to_owned(),
            others.prototype.to_owned(),
            slicer(others.cura),
            slicer(others.prusa),
            bound(|bounds| bounds.0),
            bound(|bounds| bounds.1),
        ]);
    }
    table
}
