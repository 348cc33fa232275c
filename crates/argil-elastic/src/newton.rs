//! Newton's method with a guarded line search.

use glam::DVec2;

use crate::guard::Guard;
use crate::neighbours::{Neighbours, Reach};
use crate::objective::{Objective, State, Tether};
use crate::path::{Path, Relaxed, Stop};
use crate::rod::{FIXED, Rod};
use crate::system::NormalSystem;
use crate::{ElasticError, ElasticOptions};

/// Sufficient decrease: share of the decrease that the gradient promises (Armijo).
const SUFFICIENT: f64 = 1e-4;

/// Damping at the start, what a failed and a successful step multiply it by, and its least value, in units of w.
const DAMPING: f64 = 1e-3;
const DAMPING_UP: f64 = 10.0;
const DAMPING_DOWN: f64 = 0.3;
const LEAST_DAMPING: f64 = 1e-6;

/// Trials within one iteration before it counts as stuck.
const ATTEMPTS: usize = 20;

/// Smallest share of an unobstructed step that is tried before the damping is raised instead.
const LEAST_SHARE: f64 = 0.25;

/// Part of its step below which an offending vertex is left where it is: six halvings.
const LEAST_PART: f64 = 1.0 / 64.0;

/// Vertices to either side of an offending edge whose step is cut with it, so that no kink is left there.
const CUT_ALONG: usize = 2;

/// Part of its step that a vertex is asked for next if the step took it from between two strands to the other side.
const AT_CREASE: f64 = 0.1;

/// How Sec. 3.4 is read; the readings share the energies, the system and the descent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reading {
    /// Discs about the anchors of carriers, and a guarded line search.
    Mended,
    /// Every free vertex held along its normal, no guard.
    Literal,
}

/// Relaxes paths one after the other in the same memory.
///
/// [`relax`](crate::relax) does the same with fresh memory. Results do not depend on what was relaxed before.
///
/// # Example
/// ```
/// use argil_elastic::{DVec2, ElasticOptions, ElasticSolver, Path};
/// let mut solver = ElasticSolver::new();
/// for height in [2.0, 3.0] {
///     // A wall, and a strand with a corner that closes the path.
///     let points = [(0.0, 0.0), (0.0, -5.0), (6.0, -5.0), (6.0, 0.0), (3.0, height)].map(DVec2::from);
///     let path = Path { points: &points, fixed: &[true, true, true, true, false], carriers: &[], clear_of: None, felt: &[] };
///     let relaxed = solver.relax(&path, &ElasticOptions::for_width(1.5))?;
///     assert!(relaxed.points[4].y < height);
/// }
/// # Ok::<(), argil_elastic::ElasticError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct ElasticSolver {
    rod: Rod,
    neighbours: Neighbours,
    current: State,
    trial: State,
    memory: Steps,
    system: NormalSystem,
    tethers: Vec<Tether>,
    felt: Vec<u32>,
}

/// Everything that one relaxation only reads.
struct Task<'a> {
    objective: Objective<'a>,
    guard: Option<Guard<'a>>,
    reach: Reach,
    options: &'a ElasticOptions,
}

impl ElasticSolver {
    /// A solver without memory of its own yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Relaxes one path; see [`relax`](crate::relax).
    ///
    /// # Errors
    /// As [`relax`](crate::relax).
    pub fn relax(&mut self, path: &Path<'_>, options: &ElasticOptions) -> Result<Relaxed, ElasticError> {
        self.relax_as(Reading::Mended, path, options)
    }

    pub(crate) fn relax_as(
        &mut self,
        reading: Reading,
        path: &Path<'_>,
        options: &ElasticOptions,
    ) -> Result<Relaxed, ElasticError> {
        options.check()?;
        path.check()?;
        self.current.start(path.points, options.width);
        self.rod.lay(path, &self.current.scaled);
        self.tie(reading, path, options)?;
        if path.points.len() < 3 || self.rod.free.is_empty() {
            return Ok(Relaxed {
                points: path.points.to_vec(),
                energy_before: 0.0,
                energy_after: 0.0,
                iterations: 0,
                stop: Stop::Converged,
            });
        }
        self.trial.start(path.points, options.width);
        self.neighbours.forget();
        self.memory.start(&self.rod);
        self.system.start(&self.rod);

        let Self { rod, neighbours, current, trial, memory, system, tethers, felt } = self;
        let guard = Guard { rod, candidate: path.points, touch: options.touch * options.width };
        let guard = (reading == Reading::Mended).then_some(guard);
        let objective = Objective {
            rod,
            options,
            envelope: options.envelope / options.width,
            tethers,
            clear_of: path.clear_of,
            felt,
        };
        let reach = Reach { touch: guard.map(|_| options.touch), ..objective.repulsion_reach() };
        let task = Task { objective, guard, reach, options };
        let mut descent = Descent { task, neighbours, current, trial, memory };
        let (energy_before, iterations, stop) = descent.run(system);
        Ok(Relaxed {
            points: self.current.points.clone(),
            energy_before,
            energy_after: self.current.energy,
            iterations,
            stop,
        })
    }

    /// Lists the tethers and the vertices that feel the field.
    fn tie(
        &mut self,
        reading: Reading,
        path: &Path<'_>,
        options: &ElasticOptions,
    ) -> Result<(), ElasticError> {
        let rod = &self.rod;
        let scaled = &self.current.scaled;
        self.felt.clear();
        let felt = |v: &u32| path.felt.get(*v as usize).copied().unwrap_or(false);
        self.felt.extend(rod.free.iter().copied().filter(felt));
        self.tethers.clear();
        match reading {
            Reading::Mended => {
                let tether = |c: &crate::Carrier| Tether {
                    vertex: c.vertex as u32,
                    anchor: c.anchor / options.width,
                    along: None,
                };
                self.tethers.extend(path.carriers.iter().map(tether));
            }
            Reading::Literal => self.tethers.extend(rod.free.iter().map(|&vertex| {
                let v = vertex as usize;
                let tangent = |from: usize, to: usize| (scaled[to] - scaled[from]).normalize_or_zero();
                let normal = (tangent(rod.previous(v), v) + tangent(v, rod.next(v))).perp();
                Tether { vertex, anchor: scaled[v], along: Some(normal.normalize_or_zero()) }
            })),
        }
        let envelope = options.envelope / options.width;
        let broken = self.tethers.iter().position(|t| !t.holds(scaled, envelope));
        if let Some(carrier) = broken {
            let Some(c) = path.carriers.get(carrier) else { return Ok(()) };
            return Err(ElasticError::CarrierOutside {
                carrier,
                vertex: c.vertex,
                distance: path.points[c.vertex].distance(c.anchor),
                envelope: options.envelope,
            });
        }
        // A carrier that cannot move is no energy, only a condition that has now been checked.
        self.tethers.retain(|t| rod.number[t.vertex as usize] != FIXED);
        Ok(())
    }
}

/// One relaxation under way.
struct Descent<'a> {
    task: Task<'a>,
    neighbours: &'a mut Neighbours,
    current: &'a mut State,
    trial: &'a mut State,
    memory: &'a mut Steps,
}

/// What became of one iteration.
enum Advance {
    Stepped,
    /// The Newton step was within the tolerance.
    Settled {
        stepped: bool,
    },
    Stuck,
}

/// What a trial turned out to be.
enum Verdict {
    /// Enough lower; it is now the current position.
    Lower,
    /// Evaluated, and not low enough.
    NotLower,
    /// Not evaluated: what is left of the step leads uphill.
    Uphill,
}

/// What is known about the step of every free vertex, by its number.
#[derive(Clone, Debug, Default)]
struct Steps {
    /// Newton step, in w.
    step: Vec<DVec2>,
    /// Which part of its step a vertex takes in this trial.
    part: Vec<f64>,
    /// Damping of single vertices, on top of the common one.
    stiffness: Vec<f64>,
    /// Damping of all vertices.
    damping: f64,
    /// Vertices of the path that offended in this round.
    marked: Vec<bool>,
}

impl Steps {
    fn start(&mut self, rod: &Rod) {
        let unknowns = rod.free.len();
        self.step.clear();
        self.step.resize(unknowns, DVec2::ZERO);
        self.part.clear();
        self.part.resize(unknowns, 1.0);
        self.stiffness.clear();
        self.stiffness.resize(unknowns, 0.0);
        self.damping = DAMPING;
        self.marked.clear();
        self.marked.resize(rod.len(), false);
    }

    /// After a success, lets go of what is held.
    fn relent(&mut self) {
        self.damping = (self.damping * DAMPING_DOWN).max(LEAST_DAMPING);
        for stiffness in &mut self.stiffness {
            let less = *stiffness * DAMPING_DOWN;
            *stiffness = if less < DAMPING { 0.0 } else { less };
        }
    }

    /// Stiffens every vertex that could not take its whole step: taken alone, it would then ask for the part it took.
    fn stiffen(&mut self, system: &NormalSystem, share: f64) {
        for (b, (&part, stiffness)) in self.part.iter().zip(&mut self.stiffness).enumerate() {
            if part < share {
                let held = system.stiffness(b);
                *stiffness = (held + *stiffness) * (share / part.max(LEAST_PART)) - held;
            }
        }
    }
}

impl Descent<'_> {
    /// Iterates to the end; gives the first energy, the steps taken and why it ended.
    fn run(&mut self, system: &mut NormalSystem) -> (f64, usize, Stop) {
        self.neighbours.cover(self.task.objective.rod, &self.current.scaled, &self.task.reach);
        self.task.objective.evaluate(self.current, self.neighbours);
        let before = self.current.energy;
        if !before.is_finite() {
            return (before, 0, Stop::NoProgress);
        }
        for iteration in 0..self.task.options.max_iterations {
            self.task.objective.assemble(self.current, system);
            match self.advance(system) {
                Advance::Stepped => {}
                Advance::Settled { stepped } => {
                    return (before, iteration + usize::from(stepped), Stop::Converged);
                }
                Advance::Stuck => return (before, iteration, Stop::NoProgress),
            }
        }
        (before, self.task.options.max_iterations, Stop::IterationCap)
    }

    /// Solves for a step and takes what can be taken of it.
    ///
    /// A vertex whose step has to be cut pulls at neighbours that were to move with it, and the rest of the step may
    /// then lead uphill. In that case the vertex is stiffened so much that the next solution asks of it what it can
    /// do, and the others go along. Only a step that nothing obstructs and that still fails is damped as a whole.
    fn advance(&mut self, system: &mut NormalSystem) -> Advance {
        let tolerance = self.task.options.tolerance;
        let mut share = 1.0;
        for attempt in 0..ATTEMPTS {
            let Steps { step, stiffness, damping, .. } = &mut *self.memory;
            let longest = |step: &[DVec2]| step.iter().map(|s| s.length()).fold(0.0, f64::max);
            let mut solved = system.solve(step, |b| *damping + stiffness[b]);
            let held = *damping > DAMPING || stiffness.iter().any(|&s| s > 0.0);
            if solved && attempt == 0 && held && longest(step) <= tolerance {
                // A path that is only held still has not settled.
                stiffness.fill(0.0);
                *damping = DAMPING;
                solved = system.solve(step, |_| DAMPING);
            }
            if !solved {
                *damping *= DAMPING_UP;
                continue;
            }
            let settled = attempt == 0 && longest(step) <= tolerance;
            let mut obstructed = self.place_within_bounds(share);
            match self.descend(system) {
                Verdict::Lower if settled => return Advance::Settled { stepped: true },
                Verdict::Lower => {
                    self.memory.relent();
                    return Advance::Stepped;
                }
                _ if settled => return Advance::Settled { stepped: false },
                Verdict::Uphill => {}
                Verdict::NotLower => {
                    for b in self.task.objective.tossed(self.current, self.trial) {
                        self.memory.part[b] *= AT_CREASE;
                        obstructed = true;
                    }
                }
            }
            if obstructed {
                self.memory.stiffen(system, share);
            } else if share > LEAST_SHARE {
                share *= 0.5;
            } else {
                share = 1.0;
                self.memory.damping *= DAMPING_UP * DAMPING_UP;
            }
        }
        Advance::Stuck
    }

    /// Makes the trial the current position if its energy is low enough (Armijo).
    fn descend(&mut self, system: &NormalSystem) -> Verdict {
        let rod = self.task.objective.rod;
        let change = |v: u32| self.trial.scaled[v as usize] - self.current.scaled[v as usize];
        let promised: f64 = rod.free.iter().zip(&system.gradient).map(|(&v, g)| g.dot(change(v))).sum();
        if promised >= 0.0 {
            return Verdict::Uphill;
        }
        self.task.objective.evaluate(self.trial, self.neighbours);
        if self.trial.energy > self.current.energy + SUFFICIENT * promised {
            return Verdict::NotLower;
        }
        std::mem::swap(self.current, self.trial);
        Verdict::Lower
    }

    /// Places the trial at `share` of the step, less where a vertex would go too far, leave its envelope, cross or
    /// touch; tells whether there was such a vertex.
    ///
    /// The neighbour lists cover the trial afterwards.
    fn place_within_bounds(&mut self, share: f64) -> bool {
        let rod = self.task.objective.rod;
        let cap = self.task.options.max_step;
        for (part, step) in self.memory.part.iter_mut().zip(&self.memory.step) {
            *part = share.min(cap / step.length());
        }
        for tether in self.task.objective.tethers {
            let b = rod.number[tether.vertex as usize] as usize;
            let room = tether.reach(&self.current.scaled, self.memory.step[b], self.task.objective.envelope);
            self.memory.part[b] = self.memory.part[b].min(room);
        }
        self.place();
        self.neighbours.cover(rod, &self.trial.scaled, &self.task.reach);
        if let Some(guard) = self.task.guard {
            // Every round at least halves a step that is not yet zero, and a path at rest offends nowhere: this ends.
            while self.mark_offenders(&guard) {
                for (part, &v) in self.memory.part.iter_mut().zip(&rod.free) {
                    if self.memory.marked[v as usize] {
                        *part = if *part > LEAST_PART { 0.5 * *part } else { 0.0 };
                    }
                }
                self.place();
                self.neighbours.cover(rod, &self.trial.scaled, &self.task.reach);
            }
        }
        self.memory.part.iter().any(|&part| part < share)
    }

    /// Marks the vertices of edges that cross or touch in the trial, and some to either side; tells whether any do.
    fn mark_offenders(&mut self, guard: &Guard<'_>) -> bool {
        let rod = self.task.objective.rod;
        let marked = &mut self.memory.marked;
        marked.fill(false);
        let mut any = false;
        guard.offenders(&self.trial.points, self.neighbours, |edge, other| {
            any = true;
            for first in [edge, other] {
                let mut v = rod.previous(rod.previous(first));
                for _ in 0..2 + 2 * CUT_ALONG {
                    marked[v] = true;
                    v = rod.next(v);
                }
            }
        });
        any
    }

    /// Moves the trial to the current position plus every vertex's part of its step.
    fn place(&mut self) {
        let width = self.task.options.width;
        let steps = self.memory.step.iter().zip(&self.memory.part);
        for (&v, (step, part)) in self.task.objective.rod.free.iter().zip(steps) {
            let v = v as usize;
            let point = self.current.points[v] + *step * (part * width);
            self.trial.points[v] = point;
            self.trial.scaled[v] = point / width;
        }
    }
}
