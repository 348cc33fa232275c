//! Relaxation of a wall with excursions, by the number of free vertices.

use std::hint::black_box;

use argil_benches::{DVec2, Excursions, WIDTH};
use argil_elastic::{Carrier, Clearance, ElasticOptions, ElasticSolver, Path};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

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

criterion_group!(benches, elastic);
criterion_main!(benches);
