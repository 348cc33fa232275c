//! Relaxation of a wall with excursions, by the number of free vertices, and what a sparse library takes to factorise
//! twenty matrices like those of its steps.

use std::hint::black_box;

use argil_benches::{DVec2, Excursions, WIDTH};
use argil_elastic::{Carrier, Clearance, ElasticOptions, ElasticSolver, Path};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Par, Side};

#[derive(Debug)]
struct Disc(f64);

impl Clearance for Disc {
    fn distance(&self, p: DVec2) -> (f64, DVec2) {
        (p.length() - self.0, p.normalize_or_zero())
    }
}

fn elastic(c: &mut Criterion) {
    let mut group = c.benchmark_group("elastic");
    group.sample_size(20);
    let options = ElasticOptions::for_width(WIDTH);
    let mut solver = ElasticSolver::new();
    for excursions in [4, 16, 64] {
        let made = Excursions::new(excursions, 1);
        let free = made.fixed.iter().filter(|fixed| !**fixed).count();
        let felt: Vec<bool> = made.fixed.iter().map(|fixed| !fixed).collect();
        let carriers: Vec<Carrier> =
            made.carriers.iter().map(|&(vertex, anchor)| Carrier { vertex, anchor }).collect();
        let disc = Disc(made.radius);
        let path = Path {
            points: &made.points,
            fixed: &made.fixed,
            carriers: &carriers,
            clear_of: Some(&disc),
            felt: &felt,
        };
        group.throughput(Throughput::Elements(free as u64));
        group.bench_function(BenchmarkId::new("relax", free), |b| {
            b.iter(|| solver.relax(black_box(&path), &options).expect("the path keeps to its envelopes"));
        });
    }
    group.finish();
}

/// Matrices of two unknowns a vertex, each coupled with all of the two vertices before it.
fn twenty_factorisations(c: &mut Criterion) {
    let mut group = c.benchmark_group("elastic");
    group.sample_size(20);
    for free in [196_usize, 784, 3136] {
        let entry = |row: usize, column: usize| if row == column { 20.0 } else { -1.0 };
        let upper = (0..2 * free).flat_map(|column| {
            let first = (2 * (column / 2)).saturating_sub(4);
            (first..=column).map(move |row| Triplet::new(row, column, entry(row, column)))
        });
        let matrix =
            SparseColMat::<usize, f64>::try_new_from_triplets(2 * free, 2 * free, &upper.collect::<Vec<_>>())
                .expect("the entries are within the matrix");
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(
            matrix.symbolic(),
            Side::Upper,
            SymmetricOrdering::Identity,
            parameters,
        )
        .expect("there is memory for a few thousand unknowns");
        let mut factor = vec![0.0; symbolic.len_val()];
        let mut memory =
            MemBuffer::new(symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()));
        group.bench_function(BenchmarkId::new("faer, 20 factorisations", free), |b| {
            b.iter(|| {
                for _ in 0..20 {
                    let stack = MemStack::new(&mut memory);
                    let (matrix, settings) = (black_box(matrix.as_ref()), Default::default());
                    let done = symbolic.factorize_numeric_llt(
                        &mut factor,
                        matrix,
                        Side::Upper,
                        settings,
                        Par::Seq,
                        stack,
                        Default::default(),
                    );
                    done.expect("the diagonal outweighs the rest of each row");
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, elastic, twenty_factorisations);
criterion_main!(benches);
