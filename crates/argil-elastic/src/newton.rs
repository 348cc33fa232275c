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

/// How often a step is halved, then how often the damping is raised, before the search gives up.
const HALVINGS: usize = 8;
const DAMPINGS: usize = 6;

/// How often a single vertex's step is halved for the guard's sake before the vertex stays where it is.
const LOCAL_HALVINGS: u8 = 6;

/// Vertices to either side of an offending edge whose step is cut with it, so that no kink is left there.
const CUT_ALONG: usize = 2;

/// Rounds of local cuts within one trial step.
const ROUNDS: usize = 24;

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
#[derive(Debug, Default)]
pub struct ElasticSolver {
    rod: Rod,
    neighbours: Neighbours,
    current: State,
    trial: State,
    step: Vec<DVec2>,
    cuts: Vec<u8>,
    cut_in_round: Vec<bool>,
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
        self.step.clear();
        self.step.resize(self.rod.free.len(), DVec2::ZERO);
        let mut system = NormalSystem::new(&self.rod)?;

        let Self { rod, neighbours, current, trial, step, cuts, cut_in_round, tethers, felt } = self;
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
        let mut descent = Descent { task, neighbours, current, trial, step, cuts, cut_in_round };
        let (energy_before, iterations, stop) = descent.run(&mut system);
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
    /// Newton step of every free vertex, in w.
    step: &'a mut Vec<DVec2>,
    /// How often the step of every vertex of the path has been halved in this trial.
    cuts: &'a mut Vec<u8>,
    cut_in_round: &'a mut Vec<bool>,
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
        let mut damping = DAMPING;
        for iteration in 0..self.task.options.max_iterations {
            self.task.objective.assemble(self.current, system);
            let mut in_matrix = 0.0;
            let mut moved = None;
            for _ in 0..DAMPINGS {
                system.damp(damping - in_matrix);
                in_matrix = damping;
                if system.solve(self.step) {
                    let longest = self.step.iter().map(|s| s.abs().max_element()).fold(0.0, f64::max);
                    if longest <= self.task.options.tolerance {
                        let taken = self.search(system, 1.0, 1);
                        return (before, iteration + usize::from(taken.is_some()), Stop::Converged);
                    }
                    moved = self.search(system, (self.task.options.max_step / longest).min(1.0), HALVINGS);
                    if moved.is_some() {
                        break;
                    }
                }
                damping *= DAMPING_UP;
            }
            let Some(moved) = moved else { return (before, iteration, Stop::NoProgress) };
            if moved <= self.task.options.tolerance {
                return (before, iteration + 1, Stop::NoProgress);
            }
            damping = (damping * DAMPING_DOWN).max(LEAST_DAMPING);
        }
        (before, self.task.options.max_iterations, Stop::IterationCap)
    }

    /// Takes the longest acceptable part of the step, at most `share` of it; gives the largest change of a coordinate.
    ///
    /// A trial is first cut back locally until it crosses, touches and leaves nothing; if its energy is then too
    /// high, the whole of it is halved. One tight place thus never holds up the rest of the layer.
    fn search(&mut self, system: &NormalSystem, share: f64, halvings: usize) -> Option<f64> {
        let mut share = share;
        self.cuts.clear();
        self.cuts.resize(self.task.objective.rod.len(), 0);
        for _ in 0..halvings {
            if self.cut_back(share) {
                self.task.objective.evaluate(self.trial, self.neighbours);
                let mut promised = 0.0;
                let mut longest = 0.0_f64;
                for (&v, gradient) in self.task.objective.rod.free.iter().zip(&system.gradient) {
                    let moved = self.trial.scaled[v as usize] - self.current.scaled[v as usize];
                    promised += gradient.dot(moved);
                    longest = longest.max(moved.abs().max_element());
                }
                if self.trial.energy <= self.current.energy + SUFFICIENT * promised.min(0.0) && longest > 0.0 {
                    std::mem::swap(self.current, self.trial);
                    return Some(longest);
                }
            }
            share *= 0.5;
        }
        None
    }

    /// Places the trial, cutting the steps of offending vertices until nothing offends; `false` if that fails.
    fn cut_back(&mut self, share: f64) -> bool {
        let rod = self.task.objective.rod;
        for _ in 0..ROUNDS {
            self.place(share);
            self.cut_in_round.clear();
            self.cut_in_round.resize(rod.len(), false);
            let mut offended = false;
            let marks = &mut *self.cut_in_round;
            let mut mark = |first: usize, count: usize| {
                offended = true;
                let mut v = first;
                for _ in 0..CUT_ALONG {
                    v = rod.previous(v);
                }
                for _ in 0..count + 2 * CUT_ALONG {
                    marks[v] = true;
                    v = rod.next(v);
                }
            };
            for tether in self.task.objective.broken(&self.trial.scaled) {
                mark(tether.vertex as usize, 1);
            }
            if let Some(guard) = &self.task.guard {
                self.neighbours.cover(rod, &self.trial.scaled, &self.task.reach);
                guard.offenders(&self.trial.points, self.neighbours, |edge, other| {
                    mark(edge, 2);
                    mark(other, 2);
                });
            }
            if !offended {
                self.neighbours.cover(rod, &self.trial.scaled, &self.task.reach);
                return true;
            }
            for (cuts, marked) in self.cuts.iter_mut().zip(&*self.cut_in_round) {
                if *marked {
                    *cuts = (*cuts + 1).min(LOCAL_HALVINGS + 1);
                }
            }
        }
        false
    }

    /// Moves the trial to the current position plus a share of the step, each vertex by its own part of it.
    fn place(&mut self, share: f64) {
        let width = self.task.options.width;
        for (&v, step) in self.task.objective.rod.free.iter().zip(&*self.step) {
            let v = v as usize;
            let cuts = self.cuts[v];
            let point = if cuts > LOCAL_HALVINGS {
                self.current.points[v]
            } else {
                self.current.points[v] + *step * (share * width * 0.5_f64.powi(i32::from(cuts)))
            };
            self.trial.points[v] = point;
            self.trial.scaled[v] = point / width;
        }
    }
}
