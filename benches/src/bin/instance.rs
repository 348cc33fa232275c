//! Plans the tour of one layer from a file, and prints one line of JSON with what it took.
//!
//! ```text
//! instance LAYER.json [--warm PREVIOUS.json] [--kicks PER_NODE | --budget-ms MS]
//!          [--seed N] [--seeds N] [--rounds N] [--best UM] [--matrix-mb MB] [--compare]
//! instance --make T [--seed N]
//! ```
//!
//! The second prints such a file of T support points, made from the seed.
//!
//! Times are the least of some rounds, in milliseconds of one thread. `--warm` starts from the tour of another layer,
//! whose own search is not timed. `--kicks` is the search's budget a node; `--budget-ms` chooses it so that candidates
//! and tour take about that long here. `--seeds` repeats the tour with that many seeds and adds mean and longest.
//! `--matrix-mb` is the largest matrix of distances, 256 MB by default; beyond it they are made on demand.
//! `--best` adds the excess over a known length; `--compare` measures petgraph's Dijkstra and one with a plain heap beside it.

use std::error::Error;
use std::hint::black_box;
use std::io::Write;
use std::process::ExitCode;
use std::time::Instant;
use std::{env, fs, io};

use argil_benches::{Instance, Lengths, Rows, by_heap, by_petgraph, petgraph_of};
use argil_graph::{DistanceMatrix, Distances, PathGraph};
use argil_tour::{Metric, Tour, TourOptions, TourSolver};
use serde_json::{Map, Value, json};

/// How many nearest terminals are candidates, besides those whose cells touch.
const NEAREST: usize = 5;

/// With no more terminals than this the search finds the nearest in a matrix sooner than the graph does.
const MOST_SCANNED: usize = 1_000;

/// Kicks a node for the tour above, which is there before the layer is begun.
const KICKS_ABOVE: f64 = 40.0;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing can be done if even this fails.
            drop(writeln!(io::stderr(), "instance: {error}"));
            ExitCode::FAILURE
        }
    }
}

/// What the command line asks for.
struct Arguments {
    layer: String,
    make: Option<usize>,
    warm: Option<String>,
    kicks: Option<f64>,
    budget_ms: Option<f64>,
    seed: u64,
    seeds: u64,
    rounds: usize,
    best: Option<f64>,
    most_bytes: usize,
    compare: bool,
}

impl Arguments {
    fn read(mut words: impl Iterator<Item = String>) -> Result<Self, Box<dyn Error>> {
        let mut read = Self {
            layer: String::new(),
            make: None,
            warm: None,
            kicks: None,
            budget_ms: None,
            seed: 0,
            seeds: 1,
            rounds: 5,
            best: None,
            most_bytes: PathGraph::MOST_MATRIX_BYTES,
            compare: false,
        };
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{word} wants a value"));
            match word.as_str() {
                "--make" => read.make = Some(value()?.parse()?),
                "--warm" => read.warm = Some(value()?),
                "--kicks" => read.kicks = Some(value()?.parse()?),
                "--budget-ms" => read.budget_ms = Some(value()?.parse()?),
                "--seed" => read.seed = value()?.parse()?,
                "--seeds" => read.seeds = value()?.parse::<u64>()?.max(1),
                "--rounds" => read.rounds = value()?.parse::<usize>()?.max(1),
                "--best" => read.best = Some(value()?.parse()?),
                "--matrix-mb" => read.most_bytes = value()?.parse::<usize>()?.saturating_mul(1_000_000),
                "--compare" => read.compare = true,
                layer if read.layer.is_empty() && !layer.starts_with("--") => read.layer = word,
                other => return Err(format!("{other} is not understood").into()),
            }
        }
        if read.layer.is_empty() && read.make.is_none() {
            return Err("which layer? Give the path of its JSON".into());
        }
        Ok(read)
    }

    fn options(&self) -> TourOptions {
        let plain = TourOptions { neighbours: 0, seed: self.seed, ..TourOptions::default() };
        with_all_kicks(self.kicks.unwrap_or(plain.kicks_per_node), &plain)
    }
}

/// The options with so many kicks a node, all of which are spent.
fn with_all_kicks(kicks_per_node: f64, options: &TourOptions) -> TourOptions {
    TourOptions { kicks_per_node, patience_per_node: kicks_per_node, ..*options }
}

/// The least time of some rounds in milliseconds, and what the last one gave.
fn timed<T>(rounds: usize, mut work: impl FnMut() -> T) -> (f64, Option<T>) {
    let (mut least, mut last) = (f64::INFINITY, None);
    for _ in 0..rounds {
        let start = Instant::now();
        let done = black_box(work());
        least = least.min(start.elapsed().as_secs_f64() * 1e3);
        last = Some(done);
    }
    (least, last)
}

/// All distances, in the memory of a matrix that is there already, or on demand where a matrix would be too large.
fn distances<'g>(
    graph: &'g PathGraph,
    among: &[u32],
    mut kept: DistanceMatrix,
    most_bytes: usize,
) -> Distances<'g> {
    if among.len().pow(2) * size_of::<f64>() > most_bytes {
        return graph.distances_within(among, most_bytes);
    }
    graph.distances_into(among, &mut kept);
    Distances::Matrix(kept)
}

fn matrix_of(distances: Distances<'_>) -> DistanceMatrix {
    match distances {
        Distances::Matrix(matrix) => matrix,
        _ => DistanceMatrix::default(),
    }
}

/// Candidates and tour with no thought of time.
fn tour_of(graph: &PathGraph, among: &[u32], start: Option<&[usize]>, options: &TourOptions) -> Tour {
    let candidates = graph.nearby(among, NEAREST);
    let mut solver = TourSolver::new();
    match graph.distances_within(among, PathGraph::MOST_MATRIX_BYTES) {
        Distances::Matrix(matrix) => solver.solve(&Rows(&matrix), &candidates, start, options),
        distances => solver.solve(&Lengths(&distances), &candidates, start, options),
    }
}

/// The kicks a node with which `work` takes about `budget_ms`.
fn within(budget_ms: f64, mut work: impl FnMut(f64) -> f64) -> f64 {
    let (without, with) = (work(0.0), work(2.0));
    let a_kick = ((with - without) / 2.0).max(1e-6);
    let mut kicks = ((budget_ms - without) / a_kick).max(0.0);
    // Later kicks change less and cost less or more than the first; a few corrections settle that.
    for _ in 0..3 {
        let took = work(kicks);
        if took > without {
            kicks *= ((budget_ms - without) / (took - without)).clamp(0.0, 2.0);
        }
    }
    kicks
}

fn run() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::read(env::args().skip(1))?;
    if let Some(terminals) = arguments.make {
        let made = Instance::made(terminals, arguments.seed)?;
        writeln!(io::stdout(), "{}", serde_json::to_string(&made)?)?;
        return Ok(());
    }
    let read = |path: &String| -> Result<Instance, Box<dyn Error>> {
        let text = fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?;
        Instance::from_json(&text).map_err(|error| format!("{path}: {error}").into())
    };
    let mut layer = read(&arguments.layer)?;
    let graph = layer.graph()?;
    let named = layer.terminals.clone();
    let unordered = graph.clone();
    graph.arrange(&mut layer.terminals);
    let among = &layer.terminals;
    let mut found = Map::new();
    found.insert("name".into(), json!(layer.name));
    found.insert("T".into(), json!(among.len()));
    found.insert("V".into(), json!(graph.vertex_count()));

    let rounds = arguments.rounds;
    let mut order_ms = f64::INFINITY;
    let mut again = named.clone();
    // A planner keeps its matrix from layer to layer.
    let mut kept = DistanceMatrix::default();
    let most_bytes = arguments.most_bytes;
    let (both_ms, _) = timed(rounds, || {
        // A graph keeps its order, so that every round has a graph of its own; copying it is not timed.
        let fresh = unordered.clone();
        let start = Instant::now();
        fresh.arrange(&mut again);
        let ordered = start.elapsed().as_secs_f64() * 1e3;
        order_ms = order_ms.min(ordered);
        kept = matrix_of(distances(&fresh, among, std::mem::take(&mut kept), most_bytes));
    });
    let (distances_ms, _) = timed(rounds, || {
        kept = matrix_of(distances(&graph, among, std::mem::take(&mut kept), most_bytes));
    });
    let distances = distances(&graph, among, kept, most_bytes);
    let row_sum = |k: usize| (0..among.len()).map(|j| distances.get(k, j)).sum::<f64>();
    let sum: f64 = (0..among.len()).map(row_sum).sum();
    found.insert("on_demand".into(), json!(matches!(distances, Distances::OnDemand(_))));
    found.insert("order_ms".into(), json!(order_ms));
    found.insert("distances_ms".into(), json!(distances_ms));
    found.insert("order_and_distances_ms".into(), json!(both_ms));
    found.insert("distances_sum_um".into(), json!(sum));
    if arguments.compare {
        compare(&graph, among, &distances, order_ms + distances_ms, &mut found);
    }

    let warm = match &arguments.warm {
        Some(path) => {
            let above = read(path)?;
            let options =
                with_all_kicks(KICKS_ABOVE, &TourOptions { neighbours: 0, ..TourOptions::default() });
            let tour = tour_of(&above.graph()?, &above.terminals, None, &options);
            Some((above, tour))
        }
        None => None,
    };
    let (start_ms, start) =
        timed(rounds, || warm.as_ref().map(|(above, tour)| layer.order_of(above, &tour.order)));
    let start = start.flatten();
    if start.is_some() {
        found.insert("start_ms".into(), json!(start_ms));
    }
    let in_matrix = among.len() <= MOST_SCANNED && matches!(distances, Distances::Matrix(_));
    let (candidates_ms, candidates) =
        timed(rounds, || graph.nearby(among, if in_matrix { 0 } else { NEAREST }));
    found.insert("candidates_ms".into(), json!(candidates_ms));
    let mut search = Search {
        candidates: candidates.unwrap_or_default(),
        start,
        options: TourOptions { neighbours: if in_matrix { NEAREST } else { 0 }, ..arguments.options() },
        before_ms: candidates_ms + start_ms,
        solver: TourSolver::new(),
    };
    match &distances {
        Distances::Matrix(matrix) => search.run(&Rows(matrix), &arguments, &mut found),
        distances => search.run(&Lengths(distances), &arguments, &mut found),
    }
    writeln!(io::stdout(), "{}", Value::Object(found))?;
    Ok(())
}

/// What a search for a tour begins with.
struct Search {
    candidates: Vec<Vec<u32>>,
    start: Option<Vec<usize>>,
    options: TourOptions,
    /// What candidates and start took, ms.
    before_ms: f64,
    solver: TourSolver,
}

impl Search {
    fn solve<M: Metric>(&mut self, metric: &M, options: &TourOptions) -> Tour {
        self.solver.solve(metric, &self.candidates, self.start.as_deref(), options)
    }

    /// Searches as the command line asks for, and adds what was found.
    fn run<M: Metric>(&mut self, metric: &M, arguments: &Arguments, found: &mut Map<String, Value>) {
        let rounds = arguments.rounds;
        let mut options = self.options;
        if let Some(budget) = arguments.budget_ms {
            let kicks = within(budget - self.before_ms, |kicks| {
                timed(rounds, || self.solve(metric, &with_all_kicks(kicks, &options))).0
            });
            options = with_all_kicks(kicks, &options);
        }
        let (tour_ms, tour) = timed(rounds, || self.solve(metric, &options).length);
        found.insert("tour_ms".into(), json!(tour_ms));
        found.insert("kicks_per_node".into(), json!(options.kicks_per_node));
        found.insert("tour_um".into(), json!(tour));
        let excess = |length: f64| arguments.best.map(|best| json!(100.0 * (length / best - 1.0)));
        found.extend(tour.and_then(excess).map(|value| ("excess_percent".into(), value)));
        if arguments.seeds > 1 {
            let lengths: Vec<f64> = (0..arguments.seeds)
                .map(|seed| {
                    self.solve(metric, &TourOptions { seed: arguments.seed + seed, ..options }).length
                })
                .collect();
            let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
            let longest = lengths.iter().copied().fold(0.0, f64::max);
            found.insert("tour_um_mean".into(), json!(mean));
            found.insert("tour_um_longest".into(), json!(longest));
            found.extend(excess(mean).map(|value| ("excess_percent_mean".into(), value)));
            found.extend(excess(longest).map(|value| ("excess_percent_longest".into(), value)));
        }
    }
}

/// The same distances by one search a terminal, and how much longer that takes.
fn compare(
    graph: &PathGraph,
    among: &[u32],
    distances: &Distances<'_>,
    ours: f64,
    found: &mut Map<String, Value>,
) {
    let other = petgraph_of(graph);
    let (petgraph_ms, by_petgraph) = timed(1, || by_petgraph(&other, among));
    let (heap_ms, by_heap) = timed(1, || by_heap(graph, among));
    let same = |others: Option<Vec<f64>>| {
        others.is_some_and(|others| {
            let ours = (0..among.len()).flat_map(|i| (0..among.len()).map(move |j| distances.get(i, j)));
            ours.zip(&others).all(|(a, b)| a.to_bits() == b.to_bits())
        })
    };
    found.insert("petgraph_ms".into(), json!(petgraph_ms));
    found.insert("petgraph_ratio".into(), json!(petgraph_ms / ours));
    found.insert("heap_ms".into(), json!(heap_ms));
    found.insert("heap_ratio".into(), json!(heap_ms / ours));
    found.insert("same_to_the_bit".into(), json!(same(by_petgraph) && same(by_heap)));
}
