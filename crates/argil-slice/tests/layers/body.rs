//! Bodies that the tests cut.

use std::f64::consts::TAU;

use argil_slice::mesh::{Mesh, Soup};
use glam::DVec2;
use proptest::prelude::*;

/// Vertices and outward triangles of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct Body {
    pub(crate) vertices: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Body {
    pub(crate) fn ring(radii: &[f64], at: [f64; 2], z: f64) -> Vec<[f64; 3]> {
        let step = TAU / radii.len() as f64;
        let place = |(k, r): (usize, &f64)| {
            [at[0] + r * (step * k as f64).cos(), at[1] + r * (step * k as f64).sin(), z]
        };
        radii.iter().enumerate().map(place).collect()
    }

    /// A prism whose base is star-shaped about `at`, scaled by `taper` at the top.
    pub(crate) fn prism(radii: &[f64], at: [f64; 2], z: [f64; 2], taper: f64) -> Self {
        let n = radii.len() as u32;
        let top: Vec<f64> = radii.iter().map(|r| r * taper).collect();
        let mut vertices = Self::ring(radii, at, z[0]);
        vertices.extend(Self::ring(&top, at, z[1]));
        vertices.extend([[at[0], at[1], z[0]], [at[0], at[1], z[1]]]);
        let sides = |k: u32| {
            let next = (k + 1) % n;
            [[k, next, n + k], [next, n + next, n + k], [2 * n, next, k], [2 * n + 1, n + k, n + next]]
        };
        Self { vertices, triangles: (0..n).flat_map(sides).collect() }
    }

    /// A ring-shaped prism: the outer radii less a wall.
    pub(crate) fn tube(radii: &[f64], wall: f64, z: [f64; 2]) -> Self {
        let inner: Vec<f64> = radii.iter().map(|r| r - wall).collect();
        Self::hollow(radii, &inner, [0.0; 2], z)
    }

    /// A prism with another one, whose base is star-shaped about `at`, taken out of it; both bases have as many corners.
    pub(crate) fn hollow(radii: &[f64], inner: &[f64], at: [f64; 2], z: [f64; 2]) -> Self {
        let n = radii.len() as u32;
        let rings = [(radii, [0.0; 2], z[0]), (radii, [0.0; 2], z[1]), (inner, at, z[0]), (inner, at, z[1])];
        let vertices = rings.into_iter().flat_map(|(radii, at, z)| Self::ring(radii, at, z)).collect();
        let quad = |a: u32, b: u32, c: u32, d: u32| [[a, b, c], [a, c, d]];
        let sides = |k: u32| {
            let next = (k + 1) % n;
            [
                quad(k, next, n + next, n + k),
                quad(2 * n + next, 2 * n + k, 3 * n + k, 3 * n + next),
                quad(n + k, n + next, 3 * n + next, 3 * n + k),
                quad(next, k, 2 * n + k, 2 * n + next),
            ]
        };
        Self { vertices, triangles: (0..n).flat_map(sides).flatten().collect() }
    }

    /// A prism over a convex base.
    pub(crate) fn extruded(base: &[DVec2], z: [f64; 2]) -> Self {
        let n = base.len() as u32;
        let vertices = z.iter().flat_map(|&z| base.iter().map(move |p| [p.x, p.y, z])).collect();
        let sides = (0..n).flat_map(|k| {
            let next = (k + 1) % n;
            [[k, next, n + k], [next, n + next, n + k]]
        });
        let ends = (1..n - 1).flat_map(|k| [[0, k + 1, k], [n, n + k, n + k + 1]]);
        Self { vertices, triangles: sides.chain(ends).collect() }
    }

    pub(crate) fn cuboid(low: [f64; 3], high: [f64; 3]) -> Self {
        let Soup { vertices, triangles, .. } = Soup::cuboid(low, high);
        Self { vertices, triangles }
    }

    pub(crate) fn and(mut self, other: Self) -> Self {
        let first = self.vertices.len() as u32;
        self.vertices.extend(other.vertices);
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|k| k + first)));
        self
    }

    pub(crate) fn inverted(mut self) -> Self {
        self.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
        self
    }

    pub(crate) fn mesh(&self) -> Mesh {
        Mesh::new(self.vertices.clone(), self.triangles.clone()).expect("the meshes made here are valid")
    }
}

/// The radii of a star-shaped body.
pub(crate) fn star() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(1.0..12.0_f64, 5..30)
}
