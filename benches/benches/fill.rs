//! Whole layers filled: a disc, a comb of narrow teeth, a plate with twenty holes, and 60 by 40 beads as a tile and as a crescent.

use std::f64::consts::TAU;
use std::hint::black_box;

use argil_fill::{FillOptions, fill};
use criterion::{Criterion, criterion_group, criterion_main};
use geo_types::{Coord, LineString, MultiPolygon, Polygon};

fn circle(x: f64, y: f64, radius: f64) -> LineString<f64> {
    let corner = |k: u32| {
        let angle = f64::from(k) * TAU / 64.0;
        Coord { x: x + radius * angle.cos(), y: y + radius * angle.sin() }
    };
    LineString((0..64).map(corner).collect())
}

fn corners(points: &[(f64, f64)]) -> LineString<f64> {
    LineString(points.iter().copied().map(Coord::from).collect())
}

fn comb() -> Polygon<f64> {
    let mut edge = vec![(0.0, 0.0), (40.0, 0.0)];
    for tooth in (0..5).rev() {
        let x = 8.0 * f64::from(tooth);
        edge.extend([(x + 8.0, 6.0), (x + 4.5, 6.0), (x + 4.5, 26.0), (x, 26.0), (x, 6.0)]);
    }
    edge.remove(edge.len() - 1);
    Polygon::new(corners(&edge), Vec::new())
}

fn plate() -> Polygon<f64> {
    let edge = corners(&[(0.0, 0.0), (60.0, 0.0), (60.0, 50.0), (0.0, 50.0)]);
    let holes = (0..20).map(|k| circle(6.0 + 12.0 * f64::from(k % 5), 6.0 + 12.5 * f64::from(k / 5), 2.9));
    Polygon::new(edge, holes.collect())
}

fn tile() -> Polygon<f64> {
    Polygon::new(corners(&[(0.0, 0.0), (90.0, 0.0), (90.0, 60.0), (0.0, 60.0)]), Vec::new())
}

/// Between an arc of a large circle and one of a smaller, with sharp tips.
fn crescent() -> Polygon<f64> {
    let arc = |radius: f64, from: f64, to: f64, x: f64| {
        (0..96).map(move |k| {
            let angle = from + (to - from) * f64::from(k) / 96.0;
            (x + radius * angle.cos(), radius * angle.sin())
        })
    };
    let outer = arc(45.0, 0.2 * TAU, 0.8 * TAU, 0.0);
    // The inner arc runs back between the same two tips.
    let tip = (45.0 * (0.2 * TAU).cos(), 45.0 * (0.2 * TAU).sin());
    let centre = tip.0 + 10.0;
    let (radius, half) = (tip.1.hypot(10.0), tip.1.atan2(-10.0));
    let inner = arc(radius, TAU - half, half, centre);
    Polygon::new(corners(&outer.chain(inner).collect::<Vec<_>>()), Vec::new())
}

fn fills(c: &mut Criterion) {
    let mut group = c.benchmark_group("fill");
    group.sample_size(20);
    let shapes = [
        ("disc", Polygon::new(circle(0.0, 0.0, 15.0), Vec::new())),
        ("comb", comb()),
        ("plate", plate()),
        ("tile", tile()),
        ("crescent", crescent()),
    ];
    for (name, shape) in shapes {
        let region = MultiPolygon(vec![shape]);
        group.bench_function(name, |b| {
            b.iter(|| fill(black_box(&region), &[], &FillOptions::default(), &[]));
        });
    }
    group.finish();
}

criterion_group!(benches, fills);
criterion_main!(benches);
