//! Plans with one part left out at a time, by stages that change what theirs are given.

use argil::curve::{ClosedCurve, DVec2, SegmentIndex};
use argil::elastic::{ElasticError, ElasticOptions, ElasticSolver, Path};
use argil::route::{Cycle, LayerInput, RouteError, RouteSettings, Router};
use argil::stages::{BestChain, PlaneSlices, PulledTaut, Route, SlopedSafeguard, Smooth, Support, Tauten};
use argil::support::{Placement, SupportPoint, place_supports};
use argil::taut::SlackPath;
use argil::{Planner, Settings};

use crate::document::Table;
use crate::measure::{settings, told, verdict};
use crate::{Model, Outcome};

/// The models that ablations are made on.
pub(crate) const MODELS: [&str; 5] = ["bunny", "gargoyle", "thinker", "two-cats", "spire-made"];

/// What is left out.
#[derive(Clone, Copy, Default)]
struct Part {
    name: &'static str,
    support: Option<fn(&mut Placement)>,
    route: Option<fn(&mut RouteSettings)>,
    smooth: Option<fn(&mut ElasticOptions)>,
    /// Candidates are taken as they are.
    rough: bool,
    /// Smoothed paths keep their slack.
    slack: bool,
    /// Layers are neither checked nor repaired.
    unchecked: bool,
}

/// All, then each part left out.
fn parts() -> Vec<Part> {
    let part = |name| Part { name, ..Part::default() };
    vec![
        part("nothing left out"),
        Part { route: Some(|r| r.relaxations = 0), ..part("tours over discs") },
        Part { route: Some(|r| r.root_cost = 0.0), ..part("cost of roots") },
        Part { route: Some(|r| r.coherence = 1.0), ..part("coherence discount") },
        Part { route: Some(|r| r.wall_penalty = 0.0), ..part("penalty near walls") },
        Part { support: Some(|p| p.held = 0.0), ..part("held length") },
        Part {
            smooth: Some(|o| {
                let paper = ElasticOptions::for_width(o.width);
                (o.target_ratio, o.bend) = (0.9, paper.bend);
            }),
            ..part("tension beyond the paper's")
        },
        Part { smooth: Some(|o| o.clearance = 0.0), ..part("clearance") },
        Part { smooth: Some(|o| o.repulsion = 0.0), ..part("repulsion") },
        Part { rough: true, ..part("smoothing") },
        Part { slack: true, ..part("pulling taut") },
        Part { rough: true, slack: true, ..part("smoothing and pulling taut") },
        Part { unchecked: true, ..part("check and repair") },
    ]
}

struct Placed(Part);

impl Support for Placed {
    fn points(
        &mut self,
        above: &ClosedCurve,
        walls: &SegmentIndex,
        settings: &Settings,
    ) -> Vec<SupportPoint> {
        let mut placement = settings.support();
        self.0.support.iter().for_each(|change| change(&mut placement));
        place_supports(above, walls, &placement)
    }
}

struct Routed(Part);

impl Route for Routed {
    fn cycle(&mut self, layer: &LayerInput<'_>, settings: &Settings) -> Result<Cycle, RouteError> {
        let mut routing = settings.routing();
        self.0.route.iter().for_each(|change| change(&mut routing));
        Router::new(routing)?.cycle(layer)
    }
}

struct Smoothed(Part, ElasticSolver);

impl Smooth for Smoothed {
    fn points(&mut self, path: &Path<'_>, settings: &Settings) -> Result<Vec<DVec2>, ElasticError> {
        if self.0.rough {
            return Ok(path.points.to_vec());
        }
        let mut options = settings.smoothing();
        self.0.smooth.iter().for_each(|change| change(&mut options));
        Ok(self.1.relax(path, &options)?.points)
    }
}

struct Tautened(Part);

impl Tauten for Tautened {
    fn points(&mut self, path: &SlackPath<'_>, settings: &Settings) -> Vec<DVec2> {
        if self.0.slack { path.points.to_vec() } else { PulledTaut.points(path, settings) }
    }
}

/// One row a part, one column a model: ratio, and what the audit finds short.
pub(crate) fn table(models: &[&Model]) -> Outcome<Table> {
    let names = MODELS.into_iter().filter(|name| models.iter().any(|model| model.name == *name));
    let head: Vec<&'static str> = std::iter::once("left out").chain(names).collect();
    let mut table = Table::new(&head);
    if models.is_empty() {
        return Ok(table);
    }
    for part in parts() {
        let mut row = vec![part.name.to_owned()];
        for name in &head[1..] {
            let Some(model) = models.iter().find(|model| model.name == *name) else { continue };
            eprintln!("{name} without {}", part.name);
            let mut planner = Planner {
                slice: PlaneSlices,
                safeguard: SlopedSafeguard,
                support: Placed(part),
                route: Routed(part),
                smooth: Smoothed(part, ElasticSolver::default()),
                taut: Tautened(part),
                seam: BestChain,
                checked: !part.unchecked,
            };
            let plan = planner.plan(&model.mesh, &settings(1));
            row.push(match told(plan, &model.mesh, 1)? {
                Ok((_, _, report)) => {
                    let ratio = report.figures.material_ratio;
                    if report.is_sound() {
                        format!("{ratio:.3}")
                    } else {
                        format!("{ratio:.3}; {}", verdict(&report))
                    }
                }
                Err(failure) => format!("no plan: {failure}"),
            });
        }
        table.row(row);
    }
    Ok(table)
}
