//! Reading a model from STL bytes and cutting it into layers with one and with three walls.

use std::hint::black_box;

use argil_slice::{SliceSettings, slice};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

fn slices(c: &mut Criterion) {
    let mut group = c.benchmark_group("slice");
    group.sample_size(10);
    for name in ["spire", "cup", "nested-rings"] {
        let bytes = argil_models::by_name(name).expect("a bundled model").to_stl();
        let mesh = argil_mesh::read_stl(&bytes).expect("a bundled model is a mesh");
        group.bench_with_input(BenchmarkId::new("read", name), &bytes, |b, bytes| {
            b.iter(|| argil_mesh::read_stl(black_box(bytes)));
        });
        for walls in [1, 3] {
            let settings = SliceSettings { walls, ..SliceSettings::default() };
            group.bench_with_input(BenchmarkId::new(format!("{walls} walls"), name), &mesh, |b, mesh| {
                b.iter(|| slice(black_box(mesh), &settings));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, slices);
criterion_main!(benches);
