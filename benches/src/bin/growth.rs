//! How the work of one layer's paths grows with the number of support points.
//!
//! ```text
//! growth [--sizes 200,400,…] [--seed N] [--rounds N]     times by size, and their slopes on logarithmic scales
//! growth --layer T [--seed N] [--matrix | --on-demand]   one cold layer in a process of its own, as a line of JSON
//! ```
//!
//! `--spacing MM`, for both, puts the graph's Steiner points further apart than six millimetres, or nearer.
//!
//! Layers are made from the seed. Times are the least of the rounds, in milliseconds of one thread, and of the processor
//! where they are long enough for that to be known: other programs do not count. The tour's budget is the default one. A layer by itself also says the most memory that the process ever had, its making included.

use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::process::ExitCode;
use std::time::Instant;
use std::{env, fs, io};

use argil_benches::{Lengths, MixedLayer};
use argil_graph::{Distances, PathGraph};
use argil_tour::{Tour, TourOptions, TourSolver};
use serde_json::json;

/// How many nearest points are candidates, besides those whose cells touch.
const NEAREST: usize = 5;

/// Up to this many milliseconds work is likely done before another program gets its turn.
const SHORT: f64 = 20.0;

/// The sizes of the table.
const SIZES: [usize; 7] = [200, 400, 800, 1600, 3200, 6400, 10_000];

/// What is timed, in the order of the columns, and the slope that is the goal where there is one.
const COLUMNS: [(&str, Option<f64>); 8] = [
    ("build", None),
    ("order", None),
    ("both", Some(1.2)),
    ("matrix", Some(2.1)),
    ("labels", None),
    ("candidates", Some(1.15)),
    ("search", Some(1.3)),
    ("search, labels", Some(1.3)),
];

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing can be done if even this fails.
            drop(writeln!(io::stderr(), "growth: {error}"));
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let (mut sizes, mut seed, mut rounds) = (SIZES.to_vec(), 1, 3);
    let (mut layer, mut most_bytes) = (None, PathGraph::MOST_MATRIX_BYTES);
    let mut spacing = None;
    let mut words = env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} wants a value"));
        match word.as_str() {
            "--sizes" => sizes = value()?.split(',').map(str::parse).collect::<Result<_, _>>()?,
            "--seed" => seed = value()?.parse()?,
            "--rounds" => rounds = value()?.parse::<usize>()?.max(1),
            "--spacing" => spacing = Some(value()?.parse::<f64>()?),
            "--layer" => layer = Some(value()?.parse()?),
            "--matrix" => most_bytes = usize::MAX,
            "--on-demand" => most_bytes = 0,
            other => return Err(format!("{other} is not understood").into()),
        }
    }
    if spacing.is_some_and(|spacing| spacing.is_nan() || spacing < 0.1) {
        return Err("--spacing is a tenth of a millimetre at least".into());
    }
    let made = |terminals: usize| {
        let mut layer = MixedLayer::new(terminals, seed);
        layer.spacing = spacing.unwrap_or(layer.spacing);
        layer
    };
    match layer {
        Some(terminals) => one_layer(&made(terminals), most_bytes),
        None => table(&sizes, made, rounds),
    }
}

fn tour(distances: &Distances<'_>, candidates: &[Vec<u32>]) -> Tour {
    let options = TourOptions { neighbours: 0, ..TourOptions::default() };
    TourSolver::new().solve(&Lengths(distances), candidates, None, &options)
}

/// The support points of a graph in the order that suits its distances.
fn arranged(graph: &PathGraph, terminals: usize) -> Vec<u32> {
    let mut among: Vec<u32> = (0..terminals).map(|k| graph.terminal(k)).collect();
    graph.arrange(&mut among);
    among
}

/// How long some work took, in milliseconds: on the clock where it was short, on the processor where it was long.
fn milliseconds<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let (start, busy) = (Instant::now(), on_processor());
    let done = black_box(work());
    let clock = start.elapsed().as_secs_f64() * 1e3;
    let time = match (busy, on_processor()) {
        (Some(before), Some(after)) if clock > SHORT => clock.min(after - before),
        _ => clock,
    };
    (time, done)
}

/// Milliseconds that this thread has run, where the system tells; some four behind at most.
fn on_processor() -> Option<f64> {
    let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds / 1e6)
}

fn one_layer(layer: &MixedLayer, most_bytes: usize) -> Result<(), Box<dyn Error>> {
    let terminals = layer.terminals.len();
    let (build_ms, graph) = milliseconds(|| layer.graph());
    let graph = graph?;
    let (order_ms, among) = milliseconds(|| arranged(&graph, terminals));
    let (distances_ms, distances) = milliseconds(|| graph.distances_within(&among, most_bytes));
    let (candidates_ms, candidates) = milliseconds(|| graph.nearby(&among, NEAREST));
    let (tour_ms, tour) = milliseconds(|| tour(&distances, &candidates));
    let line = json!({
        "T": terminals,
        "V": graph.vertex_count(),
        "on_demand": matches!(distances, Distances::OnDemand(_)),
        "build_ms": build_ms,
        "order_ms": order_ms,
        "distances_ms": distances_ms,
        "candidates_ms": candidates_ms,
        "tour_ms": tour_ms,
        "cold_ms": build_ms + order_ms + distances_ms + candidates_ms + tour_ms,
        "tour_mm": tour.length,
        "peak_mb": peak_megabytes(),
    });
    writeln!(io::stdout(), "{line}")?;
    Ok(())
}

/// The most memory that this process ever had resident, where the system tells.
fn peak_megabytes() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kibibytes * 1024.0 / 1e6)
}

fn table(sizes: &[usize], made: impl Fn(usize) -> MixedLayer, rounds: usize) -> Result<(), Box<dyn Error>> {
    let mut out = io::stdout().lock();
    writeln!(out, "| T | V | {} | tour, labels to matrix |", COLUMNS.map(|column| column.0).join(" | "))?;
    writeln!(out, "|--:|--:|{}--:|", "--:|".repeat(COLUMNS.len()))?;
    let mut rows: Vec<(f64, [f64; COLUMNS.len()])> = Vec::new();
    for &terminals in sizes {
        let layer = made(terminals);
        let mut least = [f64::INFINITY; COLUMNS.len()];
        let (mut vertices, mut ratio) = (0, f64::NAN);
        for _ in 0..rounds {
            let (build, graph) = milliseconds(|| layer.graph());
            let graph = graph?;
            vertices = graph.vertex_count();
            let (order, among) = milliseconds(|| arranged(&graph, terminals));
            let (demand, labels) = milliseconds(|| graph.distances_within(&among, 0));
            let (nearby, candidates) = milliseconds(|| graph.nearby(&among, NEAREST));
            let (by_labels, without) = milliseconds(|| tour(&labels, &candidates));
            let (stored, matrix) = milliseconds(|| graph.distances_within(&among, usize::MAX));
            let (by_matrix, with) = milliseconds(|| tour(&matrix, &candidates));
            ratio = without.length / with.length;
            let now = [build, order, build + order, stored, demand, nearby, by_matrix, by_labels];
            least.iter_mut().zip(now).for_each(|(least, now)| *least = least.min(now));
        }
        let cells = least.map(|time| format!("{time:.2}")).join(" | ");
        writeln!(out, "| {terminals} | {vertices} | {cells} | {ratio:.5} |")?;
        rows.push((terminals as f64, least));
    }
    let slopes: Vec<f64> =
        (0..COLUMNS.len()).map(|k| slope(rows.iter().map(|row| (row.0, row.1[k])))).collect();
    let cells: Vec<String> = slopes.iter().map(|slope| format!("{slope:.2}")).collect();
    writeln!(out, "| slope | | {} | |", cells.join(" | "))?;
    let goals = COLUMNS.map(|column| column.1.map_or(String::new(), |goal| format!("≤ {goal}")));
    writeln!(out, "| goal | | {} | |", goals.join(" | "))?;
    Ok(())
}

/// The slope of the straight line that fits the points best on two logarithmic scales.
fn slope(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let logs: Vec<(f64, f64)> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let (mean_x, mean_y) =
        logs.iter().fold((0.0, 0.0), |sum, log| (sum.0 + log.0 / count, sum.1 + log.1 / count));
    let (along, across) = logs
        .iter()
        .fold((0.0, 0.0), |sum, &(x, y)| (sum.0 + (x - mean_x).powi(2), sum.1 + (x - mean_x) * (y - mean_y)));
    across / along
}
