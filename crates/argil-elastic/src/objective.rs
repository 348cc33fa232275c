//! The sum of the energies over a path: its value, and its gradient and Hessian model for a Newton step.

use glam::{DMat2, DVec2};

use crate::energies::{Jet, barrier, bend, clear, repel, stretch};
use crate::neighbours::{Neighbours, Reach, nearest_parameter};
use crate::rod::Rod;
use crate::system::NormalSystem;
use crate::{Clearance, ElasticOptions};

/// Shortest length by which anything is divided, in w.
const TINY: f64 = 1e-9;

/// Share of the way to the rim of its envelope that a vertex goes in one step.
const APPROACH: f64 = 0.9;

/// A vertex that must stay near a point, in w.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tether {
    pub(crate) vertex: u32,
    pub(crate) anchor: DVec2,
    /// `None` measures the distance to the anchor, a direction only the deviation along it.
    pub(crate) along: Option<DVec2>,
}

impl Tether {
    /// Whether its vertex is inside the envelope (in w).
    pub(crate) fn holds(&self, points: &[DVec2], envelope: f64) -> bool {
        barrier(1.0, envelope, self.deviation(points).length_squared()).is_some()
    }

    /// The share of `step` that uses up at most [`APPROACH`] of the room left to the rim of the envelope.
    ///
    /// The barrier is felt only close to the rim, so that a Newton step from further inside does not know of it.
    pub(crate) fn reach(&self, points: &[DVec2], step: DVec2, envelope: f64) -> f64 {
        let (start, step) = (self.deviation(points), self.along.map_or(step, |n| step.dot(n) * n));
        let distance = start.length();
        let limit = distance + APPROACH * (envelope - distance);
        // |start + t step|² = limit², the larger root; the product of the roots is negative, so one is positive.
        let (a, b, c) = (step.length_squared(), start.dot(step), distance * distance - limit * limit);
        let root = (b * b - a * c).max(0.0).sqrt();
        if a + 2.0 * b + c <= 0.0 {
            1.0
        } else if b > 0.0 {
            -c / (b + root)
        } else {
            (root - b) / a
        }
    }

    fn deviation(&self, points: &[DVec2]) -> DVec2 {
        let whole = points[self.vertex as usize] - self.anchor;
        self.along.map_or(whole, |direction| whole.dot(direction) * direction)
    }
}

/// A free vertex and the nearest place of another strand, in w.
#[derive(Clone, Copy, Debug)]
struct Contact {
    vertex: u32,
    edge: u32,
    /// Where on the edge the nearest place is.
    at: f64,
    /// From there to the vertex.
    away: DVec2,
    weight: f64,
}

/// One position of the path with everything that was looked up for it.
#[derive(Clone, Debug, Default)]
pub(crate) struct State {
    /// In mm: what is returned, and what crossings and envelopes are judged by.
    pub(crate) points: Vec<DVec2>,
    /// The same in w: what the energies see.
    pub(crate) scaled: Vec<DVec2>,
    /// Infinite outside an envelope.
    pub(crate) energy: f64,
    contacts: Vec<Contact>,
    /// Distance in w and gradient for every feeling vertex.
    clearances: Vec<(f64, DVec2)>,
}

impl State {
    /// Begins at the given points.
    pub(crate) fn start(&mut self, points: &[DVec2], width: f64) {
        self.points.clear();
        self.points.extend_from_slice(points);
        self.scaled.clear();
        self.scaled.extend(points.iter().map(|&p| p / width));
    }
}

/// The energy of a path.
pub(crate) struct Objective<'a> {
    pub(crate) rod: &'a Rod,
    pub(crate) options: &'a ElasticOptions,
    /// The envelope in w.
    pub(crate) envelope: f64,
    pub(crate) tethers: &'a [Tether],
    pub(crate) clear_of: Option<&'a dyn Clearance>,
    /// Free vertices that feel the clearance.
    pub(crate) felt: &'a [u32],
}

impl Objective<'_> {
    /// What the neighbour lists have to contain for this energy.
    pub(crate) fn repulsion_reach(&self) -> Reach {
        let repulsion = (self.options.repulsion > 0.0).then_some(1.0);
        Reach { repulsion, skip: self.options.repulsion_skip, touch: None }
    }

    /// Looks up contacts and clearances of the state's positions and sums the energy.
    ///
    /// The neighbour lists must cover the positions.
    pub(crate) fn evaluate(&self, state: &mut State, neighbours: &Neighbours) {
        self.find_contacts(state, neighbours);
        state.clearances.clear();
        if let Some(field) = self.clear_of {
            for &v in self.felt {
                let (distance, gradient) = field.distance(state.points[v as usize]);
                let known = distance.is_finite() && gradient.is_finite();
                let distance = if known { distance / self.options.width } else { f64::INFINITY };
                state.clearances.push((distance, if known { gradient } else { DVec2::ZERO }));
            }
        }
        let x = &state.scaled;
        let mut energy = 0.0;
        for &k in &self.rod.edges {
            energy += self.stretch(x, k as usize).0.value;
        }
        for &v in &self.rod.free {
            energy += self.bend(x, v as usize).0.value;
        }
        for tether in self.tethers {
            energy += self.tether(x, tether).0.map_or(f64::INFINITY, |jet| jet.value);
        }
        for &(distance, _) in &state.clearances {
            energy += self.clear(distance).value;
        }
        for contact in &state.contacts {
            energy += repel(contact.weight, contact.away.length()).value;
        }
        state.energy = if energy.is_nan() { f64::INFINITY } else { energy };
    }

    /// Free vertices that are repelled from one side in the one state and from the other in the other.
    ///
    /// Half-way between two strands the energy has a crease, which no quadratic model knows of.
    pub(crate) fn tossed<'s>(&'s self, from: &'s State, to: &'s State) -> impl Iterator<Item = usize> + 's {
        let mut others = to.contacts.iter().peekable();
        from.contacts.iter().filter_map(move |contact| {
            // Both lists are in the order of the path.
            while others.next_if(|other| other.vertex < contact.vertex).is_some() {}
            let other = others.next_if(|other| other.vertex == contact.vertex)?;
            let turned = other.edge != contact.edge && contact.away.dot(other.away) < 0.0;
            turned.then(|| self.rod.number[contact.vertex as usize] as usize)
        })
    }

    /// Fills the system with gradient and Hessian model at an evaluated state.
    pub(crate) fn assemble(&self, state: &State, system: &mut NormalSystem) {
        system.clear();
        let x = &state.scaled;
        for &k in &self.rod.edges {
            let (jet, direction, length) = self.stretch(x, k as usize);
            // Across the edge the exact curvature is slope / length, negative for a compressed edge: projected away.
            let along = outer(direction, direction) * jet.curvature;
            let across = outer(direction.perp(), direction.perp()) * (jet.slope.max(0.0) / length);
            let ends = [k as usize, self.rod.next(k as usize)];
            let slope = direction * jet.slope;
            self.add(system, &ends, &[-slope, slope], |i, j| {
                if i == j { along + across } else { -(along + across) }
            });
        }
        for &v in &self.rod.free {
            let v = v as usize;
            let (jet, turning) = self.bend(x, v);
            let vertices = [self.rod.previous(v), v, self.rod.next(v)];
            let slopes = turning.map(|t| t * jet.slope);
            self.add(system, &vertices, &slopes, |i, j| outer(turning[i], turning[j]) * jet.curvature);
        }
        for tether in self.tethers {
            if let (Some(jet), deviation) = self.tether(x, tether) {
                let round = tether.along.map_or(DMat2::IDENTITY, |direction| outer(direction, direction));
                let block = round * (2.0 * jet.slope) + outer(deviation, deviation) * (4.0 * jet.curvature);
                self.add(system, &[tether.vertex as usize], &[deviation * (2.0 * jet.slope)], |_, _| block);
            }
        }
        for (&v, &(distance, gradient)) in self.felt.iter().zip(&state.clearances) {
            let jet = self.clear(distance);
            let block = outer(gradient, gradient) * jet.curvature;
            self.add(system, &[v as usize], &[gradient * jet.slope], |_, _| block);
        }
        for contact in &state.contacts {
            self.assemble_contact(contact, system);
        }
    }

    /// Adds one contact: the force on all three vertices, curvature on their own blocks only.
    ///
    /// The blocks that would couple the two strands are left out: they change from step to step, and the pattern of
    /// the matrix must not. Twice the diagonal blocks are an upper bound of the whole (|a − b|² ≤ 2 |a|² + 2 |b|²),
    /// so that two strands pushing each other do not overshoot. Against a wall nothing is left out or doubled.
    fn assemble_contact(&self, contact: &Contact, system: &mut NormalSystem) {
        let distance = contact.away.length();
        if distance < TINY {
            return;
        }
        let jet = repel(contact.weight, distance);
        let direction = contact.away / distance;
        let edge = contact.edge as usize;
        let ends = [(edge, 1.0 - contact.at), (self.rod.next(edge), contact.at)];
        let opposed = ends.iter().any(|&(v, share)| self.rod.is_free(v) && share > 0.0);
        let curvature =
            outer(direction, direction) * if opposed { 2.0 * jet.curvature } else { jet.curvature };
        for (v, share) in [(contact.vertex as usize, 1.0), (ends[0].0, -ends[0].1), (ends[1].0, -ends[1].1)] {
            self.add(system, &[v], &[direction * (jet.slope * share)], |_, _| curvature * (share * share));
        }
    }

    /// Adds one term to those rows and columns that belong to free vertices.
    fn add<const N: usize>(
        &self,
        system: &mut NormalSystem,
        vertices: &[usize; N],
        gradient: &[DVec2; N],
        block: impl Fn(usize, usize) -> DMat2,
    ) {
        for (i, &v) in vertices.iter().enumerate() {
            if !self.rod.is_free(v) {
                continue;
            }
            let row = self.rod.number[v] as usize;
            system.gradient[row] += gradient[i];
            system.add_own(row, block(i, i));
            for (j, &w) in vertices.iter().enumerate().skip(i + 1) {
                if self.rod.is_free(w) {
                    system.add_coupling(row, self.rod.number[w] as usize, block(i, j));
                }
            }
        }
    }

    /// Eq. 2 of edge `k`, its direction and its length.
    fn stretch(&self, x: &[DVec2], k: usize) -> (Jet, DVec2, f64) {
        let edge = x[self.rod.next(k)] - x[k];
        let length = edge.length().max(TINY);
        let target = self.options.target_ratio * self.rod.rest[k];
        (stretch(self.options.length, target, length), edge / length, length)
    }

    /// Eq. 3 at vertex `v`, and the derivative of the turning angle by the previous, this and the next vertex.
    fn bend(&self, x: &[DVec2], v: usize) -> (Jet, [DVec2; 3]) {
        let before = self.rod.previous(v);
        let (first, second) = (x[v] - x[before], x[self.rod.next(v)] - x[v]);
        let (first_length, second_length) = (first.length().max(TINY), second.length().max(TINY));
        let (t, u) = (first / first_length, second / second_length);
        let weight = self.options.bend * 2.0 / (self.rod.rest[before] + self.rod.rest[v]);
        let jet = bend(weight, t.dot(u), t.perp_dot(u));
        let (by_previous, by_next) = (t.perp() / first_length, u.perp() / second_length);
        (jet, [by_previous, -by_previous - by_next, by_next])
    }

    /// Eq. 6 of a tether (`None` outside its envelope) and its deviation.
    fn tether(&self, x: &[DVec2], tether: &Tether) -> (Option<Jet>, DVec2) {
        let deviation = tether.deviation(x);
        (barrier(self.options.deviation, self.envelope, deviation.length_squared()), deviation)
    }

    fn clear(&self, distance: f64) -> Jet {
        clear(self.options.clearance, self.options.sharpness, self.options.clear_distance, distance)
    }

    /// Finds for every free vertex the nearest place of the path, nearer than w, that is far enough along it.
    ///
    /// Two free strands see each other, each vertex of either the edges of the other, so such a contact counts
    /// half; a wall has no vertices that look back, and counts in full. Every strand then feels the same force
    /// from a wall as from another strand, and all of it is the gradient of one energy.
    fn find_contacts(&self, state: &mut State, neighbours: &Neighbours) {
        state.contacts.clear();
        if self.options.repulsion == 0.0 {
            return;
        }
        let x = &state.scaled;
        for (place, &vertex) in self.rod.edges.iter().enumerate() {
            let p = x[vertex as usize];
            let mut nearest = 1.0;
            let mut best = None;
            // An edge is named after its first vertex, so that this meets every free vertex once.
            for opposite in neighbours.opposite(place) {
                let edge = opposite.edge as usize;
                let (a, b) = (x[edge], x[self.rod.next(edge)]);
                let at = nearest_parameter(p, a, b).clamp(opposite.from, opposite.to);
                let away = p - a.lerp(b, at);
                let square = away.length_squared();
                // Ties go to the edge listed first, which is the same on every run.
                if square < nearest {
                    nearest = square;
                    best = Some((opposite.edge, at, away));
                }
            }
            if let Some((edge, at, away)) = best {
                let ends = [edge as usize, self.rod.next(edge as usize)];
                let free_ends = ends.iter().filter(|&&v| self.rod.is_free(v)).count();
                let weight = self.options.repulsion * (1.0 - 0.25 * free_ends as f64);
                state.contacts.push(Contact { vertex, edge, at, away, weight });
            }
        }
    }
}

/// The matrix a bᵀ.
fn outer(a: DVec2, b: DVec2) -> DMat2 {
    DMat2::from_cols(a * b.x, a * b.y)
}

#[cfg(test)]
mod tests;
