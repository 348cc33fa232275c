//! The audit itself: every measure, layer by layer.

use crate::closure::face;
use crate::coherence::Stretches;
use crate::contact::Touch;
use crate::cycle::{CycleStart, Path, cycle_start, layers};
use crate::ledger::{ContactCause, Ledger};
use crate::motion::{Motion, motions};
use crate::section::Sections;
use crate::settings::Tolerance;
use crate::strand::{Piece, pieces};
use crate::support::Beads;
use crate::wanted::{Side, Wanted, segment_index};
use crate::{AuditError, AuditSettings, Figures, Finding, FindingKind, Report};
use crate::{bead, closure, contact, coverage, crossings, crowding, motion, passage, rise, support, turns};
use argil_curve::{DVec2, SegmentIndex};
use argil_gcode::Program;
use argil_slice::mesh::Mesh;
use argil_slice::{Layer, SliceSettings, slice};
use geo::{MultiPolygon, Translate};
use std::collections::{BTreeMap, BTreeSet};

/// Samples a layer may have: a kilometre of path at the usual step. More is a mistaken coordinate.
const MOST_SAMPLES: f64 = 1e7;

/// Measures the print that `program` makes against the model in `mesh`, by geometry alone.
///
/// The first layer of the file is compared with the mesh cut at half a layer above its lowest point, and so
/// on upwards. Nothing is known of how the file was made. Beads are taken to lie along the moves, with the
/// width of the settings, whatever the file extrudes. What is wrong with the print is in the report.
///
/// # Errors
/// [`AuditError`] for settings that are no lengths, for a program that lays no clay or has coordinates beyond
/// measure, and for a mesh that cannot be cut.
///
/// # Complexity
/// Near linear in the length of the path by the step, plus the polygon operations on each layer's beads.
///
/// # Example
/// ```
/// use argil_audit::{AuditError, AuditSettings, audit, gcode::read_gcode, mesh::Mesh};
/// let sides = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
/// let corners = vec![[0.0; 3], [40.0, 0.0, 0.0], [0.0, 40.0, 0.0], [0.0, 0.0, 40.0]];
/// let tetrahedron = Mesh::new(corners, sides)?;
/// let line = read_gcode("M83\nG0 X1 Y1 Z.5\n;LAYER:0\nG1 X30 E9\n");
/// let report = audit(&line, &tetrahedron, &AuditSettings::default())?;
/// assert!((report.figures.path_mm - 29.0).abs() < 1e-9 && report.figures.layers == 1);
/// assert!(!report.is_sound());
/// let nothing = audit(&read_gcode("G28"), &tetrahedron, &AuditSettings::default());
/// assert!(matches!(nothing, Err(AuditError::NothingExtruded)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn audit(program: &Program, mesh: &Mesh, settings: &AuditSettings) -> Result<Report, AuditError> {
    settings.checked()?;
    let motions = motions(program, settings.layer_height);
    let printed = layers(&motions);
    let Some((&lowest, _)) = printed.first_key_value() else { return Err(AuditError::NothingExtruded) };
    let outlines = outlines(mesh, settings)?;

    let mut audit = Audit {
        settings,
        tolerance: Tolerance::for_width(settings.tolerance_width),
        figures: Figures { mesh_layers: outlines.len(), ..Figures::default() },
        findings: unreadable_lines(program),
        tally: Tally::default(),
        ledger: Ledger::default(),
        below: None,
    };
    audit.continuity(&motions, &printed);
    // One layer of the file for each of the mesh, and any more that the file has.
    let of_mesh = (0..outlines.len()).map(|n| lowest.saturating_add_unsigned(n as u64));
    let numbers: BTreeSet<i64> = of_mesh.chain(printed.keys().copied()).collect();
    let empty = Outline { plane: f64::NEG_INFINITY, region: MultiPolygon::new(Vec::new()), section: None };
    let mut sections = Sections::new(mesh);
    for number in numbers {
        let place = usize::try_from(number.saturating_sub(lowest)).ok();
        let outline = place.and_then(|n| outlines.get(n)).unwrap_or(&empty);
        let paths = printed.get(&number).map_or(&[][..], Vec::as_slice);
        let [dx, dy] = settings.offset;
        let mut cuts = sections.at(outline.plane);
        cuts.iter_mut().for_each(|cut| *cut += DVec2::new(dx, dy));
        let wanted =
            Wanted::new((&outline.region, outline.section.as_ref()), &cuts, settings, &audit.tolerance);
        audit.layer(number, place, &wanted, paths)?;
        for region in place.map(|place| to_close(&outlines, place, settings)).into_iter().flatten() {
            audit.closure(number, &region, &wanted, paths);
        }
    }
    audit.close_below(None);
    Ok(audit.finished())
}

/// The model's outline on each layer, in the file's coordinates.
fn outlines(mesh: &Mesh, settings: &AuditSettings) -> Result<Vec<Outline>, AuditError> {
    // The slicer's own walls are none of the audit's business: it makes its own, in another way.
    let cuts = SliceSettings {
        layer_height: settings.layer_height,
        width: settings.width,
        grid: SliceSettings::default().grid.min(0.001 * settings.width),
        walls: 1,
        surface: settings.surface,
        ..SliceSettings::default()
    };
    let [dx, dy] = settings.offset;
    let outline = |layer: Layer| Outline {
        plane: layer.cut_z,
        region: layer.outline.translate(dx, dy),
        section: settings.surface.then(|| layer.walled.translate(dx, dy)),
    };
    Ok(slice(mesh, &cuts)?.into_iter().map(outline).collect())
}

/// The model on a layer's plane.
struct Outline {
    /// Height of the plane, mm.
    plane: f64,
    region: MultiPolygon<f64>,
    /// What the section of a sheet goes round.
    section: Option<MultiPolygon<f64>>,
}

/// What of a layer is to be closed: a floor whole, else its faces above and below.
fn to_close(outlines: &[Outline], place: usize, settings: &AuditSettings) -> Vec<MultiPolygon<f64>> {
    let region =
        |place: Option<usize>| place.and_then(|place| outlines.get(place)).map(|outline| &outline.region);
    let none = MultiPolygon::new(Vec::new());
    match region(Some(place)) {
        Some(own) if place < settings.floor => vec![own.clone()],
        Some(own) if settings.skin => [Some(place + 1), place.checked_sub(1)]
            .map(|other| face(own, region(other).unwrap_or(&none), settings.width))
            .to_vec(),
        _ => Vec::new(),
    }
}

fn unreadable_lines(program: &Program) -> Vec<Finding> {
    let layer_at = |line: usize| {
        let before = program.moves.partition_point(|m| m.line < line);
        before.checked_sub(1).and_then(|k| program.moves[k].layer).unwrap_or(-1)
    };
    let lines = program.bad_lines.iter().map(|bad| bad.line);
    lines
        .map(|line| Finding {
            kind: FindingKind::UnreadableLine,
            layer: layer_at(line),
            at: None,
            measure: line as f64,
        })
        .collect()
}

/// Sums that are divided by one another at the end. Lengths in mm, areas in mm².
#[derive(Debug, Default)]
struct Tally {
    wanted: f64,
    missed: f64,
    outline: f64,
    uncovered: f64,
    closed: f64,
    open: f64,
    contact: f64,
    contact_outside: f64,
    crowded: f64,
    roots: usize,
    laid: f64,
    swept: f64,
    wall_laid: f64,
    wall_swept: f64,
    followed: f64,
    coherence: f64,
    apart: f64,
    jumped: f64,
}

/// The highest layer so far that has a path: what the next one stands on.
#[derive(Debug)]
struct Below {
    number: i64,
    beads: Beads,
    end: DVec2,
    free: Stretches,
    touches: Vec<Touch>,
}

/// The layer over the one that is looked back on.
struct Above<'a> {
    number: i64,
    wanted: &'a Wanted,
    paths: &'a [Path],
    pieces: &'a [Vec<Piece>],
}

#[derive(Debug)]
struct Audit<'a> {
    settings: &'a AuditSettings,
    tolerance: Tolerance,
    figures: Figures,
    findings: Vec<Finding>,
    tally: Tally,
    ledger: Ledger,
    below: Option<Below>,
}

impl Audit<'_> {
    fn find(&mut self, kind: FindingKind, layer: i64, at: Option<DVec2>, measure: f64) {
        self.findings.push(Finding { kind, layer, at, measure });
    }

    fn continuity(&mut self, motions: &[Motion], printed: &BTreeMap<i64, Vec<Path>>) {
        let continuity = motion::measure(motions, &mut self.findings);
        let f = &mut self.figures;
        f.bad_lines = self.findings.iter().filter(|found| found.kind == FindingKind::UnreadableLine).count();
        f.transfer_moves = continuity.transfers;
        f.transfer_mm = continuity.transfer_length;
        f.retractions = continuity.retractions;
        f.z_down_moves = continuity.moves_down;
        f.steepest_rise_mm = rise::steepest(motions, self.settings.width);
        f.flow_per_mm_median = continuity.flow.map(|[median, ..]| median);
        f.flow_per_mm_p01_p99 = continuity.flow.map(|[_, low, high]| [low, high]);
        f.layers = printed.len();
        f.paths_per_layer_max = printed.values().map(Vec::len).max().unwrap_or(0);
    }

    fn layer(
        &mut self,
        number: i64,
        place: Option<usize>,
        wanted: &Wanted,
        paths: &[Path],
    ) -> Result<(), AuditError> {
        let width = self.settings.width;
        self.affordable(wanted, paths)?;
        if let (Some(place), false) = (place, wanted.walls.is_empty()) {
            self.figures.wanted_layers = self.figures.wanted_layers.max(place + 1);
        }
        let laid = Beads::new(paths, width, self.settings.layer_height);
        self.coverage(number, wanted, &laid.index, paths.is_empty());
        let Some(start) = cycle_start(paths, &self.tolerance) else { return Ok(()) };

        let measured: Vec<Vec<Piece>> =
            paths.iter().map(|path| pieces(path, wanted, self.settings.step, &self.tolerance)).collect();
        let mut touches = Vec::new();
        for (k, (path, pieces)) in paths.iter().zip(&measured).enumerate() {
            let whole = start.closed && paths.len() == 1;
            let step_up = if k == 0 { start.step_up } else { 0.0 };
            touches.append(&mut self.path(number, path, pieces, wanted, step_up, whole));
        }
        self.close_below(Some(&Above { number, wanted, paths, pieces: &measured }));
        self.tally.wall_laid += wanted.wall_clay.0;
        self.tally.wall_swept += wanted.wall_clay.1;
        let crossings = crossings::crossings(paths, &start, &self.tolerance);
        self.figures.self_crossings += crossings.len();
        for at in crossings {
            self.find(FindingKind::SelfCrossing, number, Some(at), 1.0);
        }
        let end = paths.last().and_then(|path| path.points.last()).copied().unwrap_or(start.at);
        self.seam(number, paths.len(), &start, end);
        let free =
            Stretches::new(measured.iter().map(Vec::as_slice), |p| wanted.wall_at(p), self.settings.width);
        self.below = Some(Below { number, beads: laid, end, free, touches });
        Ok(())
    }

    /// What can be said of a layer only when the next one up is known: how its strand follows, and why it touches.
    fn close_below(&mut self, above: Option<&Above<'_>>) {
        let AuditSettings { width, across, .. } = *self.settings;
        let held = across + self.tolerance.held;
        let Some(below) = &mut self.below else { return };
        let number = below.number;
        let mut touches = std::mem::take(&mut below.touches);
        if let Some(above) = above.filter(|above| number.checked_add(1) == Some(above.number)) {
            for touch in &mut touches {
                let may_be = matches!(touch.cause, ContactCause::Passing | ContactCause::Narrow);
                if may_be && touch.is_mostly(|p| above.wanted.has_wall_within(p, held)) {
                    touch.cause = ContactCause::Overhang;
                }
            }
            let pieces = above.pieces.iter().map(Vec::as_slice);
            let lines = above.paths.iter().map(|path| path.points.as_slice());
            let coherence = below.free.against(pieces, lines, held, width);
            self.tally.followed += coherence.length;
            self.tally.coherence += coherence.moment;
            self.tally.apart += coherence.apart;
            self.tally.jumped += coherence.jumped;
            for (at, length) in coherence.jumps {
                self.find(FindingKind::Jump, number, Some(at), length);
            }
        }
        self.ledger.layer(number, touches, width);
    }

    /// A coordinate gone wrong must not fill the memory with samples.
    fn affordable(&self, wanted: &Wanted, paths: &[Path]) -> Result<(), AuditError> {
        let path: f64 = paths.iter().map(|path| length(&path.points)).sum();
        let rings: f64 = wanted.outlines.iter().chain(&wanted.walls).map(|ring| length(ring)).sum();
        for (length, step) in [(path, self.settings.step), (rings, self.tolerance.outline_step)] {
            if length.is_nan() || length > MOST_SAMPLES * step {
                return Err(AuditError::TooLong { length, step });
            }
        }
        Ok(())
    }

    fn coverage(&mut self, number: i64, wanted: &Wanted, laid: &SegmentIndex, is_missing: bool) {
        let coverage = coverage::measure(wanted, laid, self.settings.width, &self.tolerance);
        self.tally.wanted += coverage.wanted;
        self.tally.missed += coverage.missed;
        self.tally.outline += coverage.outline;
        self.tally.uncovered += coverage.uncovered;
        self.figures.model_missed_layers += coverage.missed_loops;
        if is_missing && coverage.wanted > 0.0 {
            self.find(FindingKind::MissingLayer, number, None, coverage.wanted);
        } else {
            for (at, length) in coverage.bare {
                self.find(FindingKind::BareOutline, number, Some(at), length);
            }
            for (at, length) in coverage.stretches {
                self.find(FindingKind::MissedWall, number, Some(at), length);
            }
        }
    }

    /// What of a region that is to be closed lies open.
    fn closure(&mut self, number: i64, region: &MultiPolygon<f64>, wanted: &Wanted, paths: &[Path]) {
        let width = self.settings.width;
        let laid = segment_index(paths.iter().map(|path| path.points.as_slice()), width);
        let closure = closure::measure(region, wanted, &laid, width);
        self.tally.closed += closure.wanted;
        self.tally.open += closure.bare;
        let farthest = &mut self.figures.closed_farthest_widths;
        *farthest = farthest.max(closure.farthest / width);
        for (at, distance) in closure.open {
            self.find(FindingKind::BareFill, number, Some(at), distance);
        }
    }

    /// Everything that is measured along one path; what of it touches the model outside.
    fn path(
        &mut self,
        number: i64,
        path: &Path,
        pieces: &[Piece],
        wanted: &Wanted,
        step_up: f64,
        whole: bool,
    ) -> Vec<Touch> {
        let AuditSettings { width, across, along, step, .. } = *self.settings;
        let t = self.tolerance;
        if pieces.is_empty() {
            return Vec::new();
        }
        let sum =
            |of: &dyn Fn(&Piece) -> bool| -> f64 { pieces.iter().filter(|p| of(p)).map(|p| p.length).sum() };
        let all = sum(&|_| true);
        self.figures.path_mm += all;
        self.figures.model_mm += sum(&|p| p.is_model);
        self.figures.fill_mm += sum(&|p| p.is_fill && !p.is_model);
        self.figures.nonmodel_mm += sum(&|p| p.is_nonmodel());
        self.figures.inside_model_mm += sum(&|p| p.is_nonmodel() && p.side == Side::Inside);

        let contact = contact::measure(pieces, wanted, width, t.root);
        self.tally.roots += contact.roots;
        self.tally.contact += contact.touching;
        self.tally.contact_outside += contact.outside;
        for (at, length) in contact.stretches {
            self.find(FindingKind::Contact, number, Some(at), length);
        }
        let stride = crowding::stride(t.outline_step / step);
        self.tally.crowded += crowding::crowded(pieces, &contact.apart, width, stride);

        let passages = passage::passages(pieces, t.passage);
        self.figures.wall_crossings += passages.len();
        for at in passages {
            self.find(FindingKind::WallCrossing, number, Some(at), 1.0);
        }
        let turns = turns::turns(&path.points, wanted, &t);
        for (at, angle) in turns::sharp_turns(&turns) {
            self.figures.sharp_turns_nonmodel += 1;
            self.find(FindingKind::SharpTurn, number, Some(at), angle);
        }
        for (at, angle) in turns::sharp_bends(&turns, width) {
            self.figures.sharp_bends_nonmodel += 1;
            self.find(FindingKind::SharpBend, number, Some(at), angle);
        }
        if let Some(below) = &self.below {
            let bridge = along + 2.0 * step;
            let hanging = support::hanging(pieces, &below.beads, across + t.held, bridge, step_up, whole);
            self.figures.unsupported_spans += hanging.len();
            for (at, length) in hanging {
                self.figures.unsupported_mm += length;
                self.figures.worst_unsupported_span_mm = self.figures.worst_unsupported_span_mm.max(length);
                self.find(FindingKind::UnsupportedSpan, number, Some(at), length);
            }
        }
        self.tally.laid += all * width;
        self.tally.swept += bead::swept_area(&path.points, width);
        contact.touches
    }

    /// How the layer closes and how it follows the one below.
    fn seam(&mut self, number: i64, paths: usize, start: &CycleStart, end: DVec2) {
        if paths > 1 {
            self.find(FindingKind::ManyPaths, number, None, paths as f64);
        }
        if !start.closed {
            self.figures.open_layers += 1;
            self.find(FindingKind::OpenLayer, number, Some(end), end.distance(start.at));
        }
        let Some(below) = &self.below else { return };
        let gap = start.at.distance(below.end);
        let beside = below.beads.index.distance(start.at);
        self.figures.seam_gap_max_mm = self.figures.seam_gap_max_mm.max(gap);
        if gap > self.tolerance.seam {
            self.find(FindingKind::SeamGap, number, Some(start.at), gap);
        }
        if beside > self.settings.across + self.tolerance.start_held {
            self.figures.seam_starts_unsupported += 1;
            self.find(FindingKind::UnsupportedStart, number, Some(start.at), beside);
        }
    }

    fn finished(self) -> Report {
        let Self { settings, mut figures, findings, tally, ledger, .. } = self;
        let share = |part: f64, whole: f64| part / whole.max(1e-9);
        figures.material_ratio = share(figures.nonmodel_mm, tally.wanted);
        figures.model_missed_fraction = share(tally.missed, tally.wanted);
        figures.contour_uncovered_fraction = share(tally.uncovered, tally.outline);
        figures.closed_mm2 = tally.closed;
        figures.closed_bare_fraction = share(tally.open, tally.closed);
        figures.unsupported_fraction = share(figures.unsupported_mm, figures.path_mm);
        figures.contact_per_model_mm = share(tally.contact, tally.wanted);
        figures.contact_outside_apart_from_roots = share(tally.contact_outside, tally.wanted);
        figures.roots_per_model_m = share(1000.0 * tally.roots as f64, tally.wanted);
        figures.doubled_per_model_mm = share((tally.laid - tally.swept) / settings.width, tally.wanted);
        figures.overdeposit_apart_from_roots = share(tally.crowded, figures.path_mm);
        figures.overdeposit = 1.0 - share(tally.swept, tally.laid);
        figures.overdeposit_of_bare_model = 1.0 - share(tally.wall_swept, tally.wall_laid);
        figures.coherence_mm = share(tally.coherence, tally.followed);
        figures.coherence_widths = figures.coherence_mm / settings.width;
        figures.apart_from_above_fraction = share(tally.apart, tally.followed);
        figures.jumps_fraction = share(tally.jumped, tally.followed);
        Report { settings: *settings, figures, findings, contacts: ledger.finished() }
    }
}

fn length(points: &[DVec2]) -> f64 {
    points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}
