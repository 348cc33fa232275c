//! The nozzle's way, line by line.

use std::fmt;

use argil_strand::{Role, Step};

use crate::arc_fit::{FittedArc, longest_arc};
use crate::number::Grid;
use crate::{Extrusion, Gcode};

/// A move that is due to be written: where it ends, and the E that it is worth, in steps of the E grid.
#[derive(Clone, Copy)]
struct Due {
    to: [i64; 3],
    pushed: i64,
    /// mm/s.
    speed: f64,
}

/// Where the nozzle is on the grid, and what has been pushed out.
pub(crate) struct Pen<'p, 'f> {
    gcode: &'p Gcode<'p>,
    out: &'p mut fmt::Formatter<'f>,
    at: [i64; 3],
    /// Moves of one role on one layer that wait to be seen as arcs; they begin at `from`.
    run: Vec<Due>,
    from: [i64; 3],
    /// E that the strand so far is worth, exactly.
    due: f64,
    /// E given to moves so far, in steps of the E grid.
    paid: i64,
    /// Of it, written since the last G92, for absolute E.
    written: i64,
    role: Option<Role>,
    layer: usize,
    feed: Option<i64>,
}

impl<'p, 'f> Pen<'p, 'f> {
    pub(crate) fn new(gcode: &'p Gcode<'p>, out: &'p mut fmt::Formatter<'f>) -> Self {
        let (run, at) = (Vec::new(), [0; 3]);
        Self {
            gcode,
            out,
            at,
            run,
            from: at,
            due: 0.0,
            paid: 0,
            written: 0,
            role: None,
            layer: 0,
            feed: None,
        }
    }

    /// The point on the grid; `Gcode::new` has seen that it exists.
    fn on_grid(&self, point: [f64; 3]) -> [i64; 3] {
        point.map(|value| self.gcode.grid.step(value).unwrap_or(0))
    }

    /// Speed in mm/min on a grid of three decimals, when it differs from that of the move before.
    fn feed(&mut self, mm_per_s: f64) -> fmt::Result {
        let grid = Grid::new(3);
        let steps = grid.step(mm_per_s * 60.0);
        if steps != self.feed {
            self.feed = steps;
            write!(self.out, " F{}", grid.text(steps.unwrap_or(0)))?;
        }
        Ok(())
    }

    /// The only moves without E: above the bed, over to the start, down to it.
    pub(crate) fn approach(&mut self, start: [f64; 3]) -> fmt::Result {
        let (grid, settings) = (self.gcode.grid, self.gcode.settings);
        self.at = self.on_grid(start);
        self.from = self.at;
        let [x, y, z] = self.at.map(|steps| grid.text(steps));
        let above = grid.text(self.on_grid([0.0, 0.0, start[2] + settings.lift])[2]);
        write!(self.out, "G1 Z{above}")?;
        self.feed(settings.approach_feed)?;
        writeln!(self.out, "\nG1 X{x} Y{y}\nG1 Z{z}")
    }

    pub(crate) fn open_layer(&mut self, position: usize) -> fmt::Result {
        self.flush()?;
        self.layer = position;
        let layer = &self.gcode.strand.layers()[position];
        let [z, height, width] =
            self.on_grid([layer.z, layer.height, layer.width]).map(|s| self.gcode.grid.text(s));
        writeln!(
            self.out,
            ";LAYER_CHANGE\n;Z:{z}\n;HEIGHT:{height}\n;LAYER:{}\n;WIDTH:{width}",
            layer.index
        )?;
        let counts = !matches!(self.gcode.settings.extrusion, Extrusion::Constant { .. });
        if counts && !self.gcode.settings.relative_e && position > 0 {
            self.written = 0;
            writeln!(self.out, "G92 E0")?;
        }
        Ok(())
    }

    /// Lays a step, or passes over its end where grid or E cannot tell it from where the nozzle is. What it is worth
    /// is then owed to the next move. A cycle's ends must be met (`exactly`), so that it stays closed.
    pub(crate) fn lay(&mut self, step: &Step, exactly: bool) -> fmt::Result {
        let (e_grid, settings) = (self.gcode.e_grid, self.gcode.settings);
        self.due += step.length() * settings.bead.area(step.width, step.height) / settings.paste_per_e();
        let to = self.on_grid(step.to.to_array());
        let owed = e_grid.step(self.due).unwrap_or(self.paid) - self.paid;
        let unpaid = owed < 1 && !matches!(settings.extrusion, Extrusion::Constant { .. });
        if to == self.at || (unpaid && !exactly) {
            return Ok(());
        }
        if self.role != Some(step.role) {
            self.flush()?;
            self.role = Some(step.role);
            writeln!(self.out, ";TYPE:{}", settings.names.name(step.role))?;
        }
        let pushed = owed.max(1);
        self.paid += pushed;
        self.run.push(Due { to, pushed, speed: settings.speed_of(self.gcode.strand, step) });
        // On a level layer arcs are flat; without arcs nothing is gained by waiting.
        if settings.arc_tolerance.is_none() || (to[2] != self.at[2] && !self.rises()) {
            self.flush()?;
        }
        self.at = to;
        Ok(())
    }

    /// Writes the moves that wait: the longest arc that begins where the nozzle is, or else one straight move, and so
    /// on to the end.
    fn flush(&mut self) -> fmt::Result {
        let run = std::mem::take(&mut self.run);
        let tolerance = self.gcode.settings.arc_tolerance.map(|mm| self.gcode.grid.units(mm));
        let mut points: Vec<[i64; 2]> = Vec::new();
        if tolerance.is_some() {
            let ends = run.iter().map(|due| [due.to[0], due.to[1]]);
            points = std::iter::once([self.from[0], self.from[1]]).chain(ends).collect();
        }
        let mut done = 0;
        while done < run.len() {
            let arc =
                tolerance.and_then(|tolerance| self.arc(points.get(done..)?, run.get(done..)?, tolerance));
            let moves = arc.map_or(1, |arc| arc.moves);
            self.write(&run[done..done + moves], arc)?;
            done += moves;
        }
        self.run = run;
        self.run.clear();
        Ok(())
    }

    fn rises(&self) -> bool {
        !self.gcode.strand.rises(self.layer).is_empty()
    }

    /// The longest arc at the beginning of a run, along which z and E grow evenly: machines know no other arcs.
    fn arc(&self, points: &[[i64; 2]], run: &[Due], tolerance: f64) -> Option<FittedArc> {
        let mut most = points.len();
        loop {
            let arc = longest_arc(points.get(..most)?, tolerance)?;
            if !self.rises() || grow_evenly(self.from, &run[..arc.moves], tolerance) {
                return Some(arc);
            }
            most = arc.moves / 2 + 1;
        }
    }

    /// Writes some moves as one.
    fn write(&mut self, moves: &[Due], arc: Option<FittedArc>) -> fmt::Result {
        let (grid, e_grid, settings) = (self.gcode.grid, self.gcode.e_grid, self.gcode.settings);
        let Some(&Due { to, speed, .. }) = moves.last() else { return Ok(()) };
        let pushed: i64 = moves.iter().map(|due| due.pushed).sum();
        self.written += pushed;
        let code = match arc {
            None => "G1",
            Some(arc) if arc.clockwise => "G2",
            Some(_) => "G3",
        };
        write!(self.out, "{code} X{} Y{}", grid.text(to[0]), grid.text(to[1]))?;
        if to[2] != self.from[2] {
            write!(self.out, " Z{}", grid.text(to[2]))?;
        }
        if let Some(FittedArc { centre: [i, j], .. }) = arc {
            write!(self.out, " I{} J{}", grid.text(i), grid.text(j))?;
        }
        if !matches!(settings.extrusion, Extrusion::Constant { .. }) {
            let e = if settings.relative_e { pushed } else { self.written };
            write!(self.out, " E{}", e_grid.text(e))?;
        }
        self.feed(speed)?;
        self.from = to;
        writeln!(self.out)
    }

    /// On along the last cycle without E, as far as the nozzle is to be wiped.
    fn wipe(&mut self) -> fmt::Result {
        let (grid, mut left) = (self.gcode.grid, self.gcode.settings.wipe);
        let cycle = self.gcode.strand.polyline(self.layer);
        for pair in cycle.windows(2) {
            let length = pair[0].distance(pair[1]);
            if left <= 0.0 {
                break;
            }
            let to = if left < length { pair[0].lerp(pair[1], left / length) } else { pair[1] };
            left -= length;
            let [x, y, _] = self.on_grid([to.x, to.y, 0.0]);
            if [x, y] != [self.at[0], self.at[1]] {
                writeln!(self.out, "G1 X{} Y{}", grid.text(x), grid.text(y))?;
                (self.at[0], self.at[1]) = (x, y);
            }
        }
        Ok(())
    }

    /// Straight up from the last point, or from where the nozzle has been wiped.
    pub(crate) fn leave(&mut self) -> fmt::Result {
        self.flush()?;
        self.wipe()?;
        let (grid, settings) = (self.gcode.grid, self.gcode.settings);
        let lift = grid.step(settings.lift).unwrap_or(0);
        write!(self.out, "G1 Z{}", grid.text(self.at[2].saturating_add(lift)))?;
        self.feed(settings.approach_feed)?;
        writeln!(self.out)
    }
}

/// Share of an arc's E by which that of its moves may be ahead or behind, and the steps of the E grid that rounding adds.
const UNEVEN: (f64, f64) = (0.02, 2.0);

/// Whether z and E of moves that an arc is to stand for grow in proportion to the way.
fn grow_evenly(from: [i64; 3], moves: &[Due], tolerance: f64) -> bool {
    let mut at = from;
    let (mut way, mut pushed) = (0.0, 0);
    let mut reached = Vec::with_capacity(moves.len());
    for due in moves {
        way += ((due.to[0] - at[0]) as f64).hypot((due.to[1] - at[1]) as f64);
        pushed += due.pushed;
        at = due.to;
        reached.push((way, (at[2] - from[2]) as f64, pushed as f64));
    }
    let Some(&(length, rise, paste)) = reached.last() else { return true };
    reached.iter().all(|&(way, z, e)| {
        let share = way / length.max(f64::MIN_POSITIVE);
        (z - share * rise).abs() <= tolerance
            && (e - share * paste).abs() <= UNEVEN.0 * paste + UNEVEN.1 * moves.len() as f64
    })
}
