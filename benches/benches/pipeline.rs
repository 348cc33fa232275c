//! Whole plans of bundled models, from the mesh to the strand.

use std::hint::black_box;

use argil::{Planner, Settings};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

fn pipeline(c: &mut Criterion) {
    let mut group = c.benchmark_group("pipeline");
    group.sample_size(10);
    for name in argil_models::names() {
        let solid = argil_models::by_name(name).expect("a bundled model");
        let mesh = argil::mesh::read_stl(&solid.to_stl()).expect("a bundled model is a mesh");
        group.bench_with_input(BenchmarkId::new("plan", name), &mesh, |b, mesh| {
            b.iter(|| {
                Planner::default()
                    .plan(black_box(mesh), &Settings::default())
                    .expect("a bundled model has a plan")
            });
        });
    }
    group.finish();
}

criterion_group!(benches, pipeline);
criterion_main!(benches);
