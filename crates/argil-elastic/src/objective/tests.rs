//! The assembled gradient and Hessian against finite differences of the energy, and the step against a dense solver.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use super::*;
use crate::Path;

/// Signed distance to the line y = −1: a field without curvature, so that its Hessian model is exact.
struct Floor;

impl Clearance for Floor {
    fn distance(&self, p: DVec2) -> (f64, DVec2) {
        (p.y + 1.0, DVec2::Y)
    }
}

/// A path and everything an objective borrows. Width 1, so that millimetres are widths.
struct Bench {
    points: Vec<DVec2>,
    rod: Rod,
    options: ElasticOptions,
    tethers: Vec<Tether>,
    felt: Vec<u32>,
}

impl Bench {
    fn new(candidate: &[DVec2], fixed: &[bool], options: ElasticOptions) -> Self {
        let path = Path { points: candidate, fixed, carriers: &[], clear_of: None, felt: &[] };
        let mut rod = Rod::default();
        rod.lay(&path, candidate);
        let felt = rod.free.clone();
        Self { points: candidate.to_vec(), rod, options, tethers: Vec::new(), felt }
    }

    fn with<T>(&self, run: impl FnOnce(&Objective<'_>) -> T) -> T {
        run(&Objective {
            rod: &self.rod,
            options: &self.options,
            envelope: self.options.envelope,
            tethers: &self.tethers,
            clear_of: Some(&Floor),
            felt: &self.felt,
        })
    }

    fn state(&self, points: &[DVec2]) -> State {
        self.with(|objective| {
            let mut state = State::default();
            state.start(points, 1.0);
            let mut neighbours = Neighbours::default();
            neighbours.cover(&self.rod, points, &objective.repulsion_reach());
            objective.evaluate(&mut state, &neighbours);
            state
        })
    }

    fn system(&self, points: &[DVec2]) -> NormalSystem {
        let mut system = NormalSystem::default();
        system.start(&self.rod);
        self.with(|objective| objective.assemble(&self.state(points), &mut system));
        system
    }

    fn gradient(&self, points: &[DVec2]) -> DVector<f64> {
        DVector::from_iterator(
            2 * self.rod.free.len(),
            self.system(points).gradient.iter().flat_map(|g| [g.x, g.y]),
        )
    }

    /// Every unknown moved both ways.
    fn differences<T>(&self, h: f64, f: impl Fn(&[DVec2]) -> T) -> Vec<(T, T)> {
        let moved = |v: u32, by: DVec2| {
            let mut points = self.points.clone();
            points[v as usize] += by;
            f(&points)
        };
        let unknowns = self.rod.free.iter().flat_map(|&v| [(v, DVec2::X), (v, DVec2::Y)]);
        unknowns.map(|(v, axis)| (moved(v, axis * h), moved(v, axis * -h))).collect()
    }

    fn assert_gradient(&self) -> Result<(), TestCaseError> {
        let h = 1e-6;
        let exact = self.gradient(&self.points);
        let scale = 1.0 + exact.amax() + self.state(&self.points).energy;
        for (k, (up, down)) in self.differences(h, |p| self.state(p).energy).into_iter().enumerate() {
            let slope = (up - down) / (2.0 * h);
            prop_assert!((slope - exact[k]).abs() <= 1e-5 * scale, "unknown {k}: {slope} and {}", exact[k]);
        }
        Ok(())
    }

    fn differenced_hessian(&self) -> DMatrix<f64> {
        let h = 1e-6;
        let columns: Vec<_> = self.differences(h, |p| self.gradient(p));
        let columns: Vec<_> = columns.into_iter().map(|(up, down)| (up - down) / (2.0 * h)).collect();
        DMatrix::from_columns(&columns)
    }

    fn assert_hessian(&self) -> Result<(), TestCaseError> {
        let (model, differences) = (self.system(&self.points).dense(), self.differenced_hessian());
        let worst = (&model - &differences).amax();
        prop_assert!(worst <= 1e-4 * (1.0 + model.amax()), "off by {worst}");
        Ok(())
    }
}

/// All weights zero.
fn nothing() -> ElasticOptions {
    ElasticOptions {
        length: 0.0,
        bend: 0.0,
        deviation: 0.0,
        clearance: 0.0,
        repulsion: 0.0,
        ..ElasticOptions::for_width(1.0)
    }
}

/// Zigzags that go out and come back some 0.6 w apart, the first two vertices fixed.
fn candidates() -> impl Strategy<Value = (Vec<DVec2>, Vec<bool>)> {
    (prop::collection::vec((-0.1..0.1_f64, -0.1..0.1_f64), 16), 0..3_usize).prop_map(|(wobble, fixed)| {
        let n = wobble.len();
        let place = |k: usize| if k < n / 2 { (k as f64, 0.0) } else { ((n - 1 - k) as f64, 0.6) };
        let points = wobble.iter().enumerate().map(|(k, w)| DVec2::from(place(k)) * 0.7 + DVec2::from(*w));
        (points.collect(), (0..n).map(|k| k < fixed).collect())
    })
}

/// The candidate a little stretched, so that edges are longer than their target (or shorter, for a factor under 1).
fn stretched(bench: &mut Bench, factor: f64) {
    for p in &mut bench.points {
        *p *= factor;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn tension_is_exact_where_it_pulls((points, fixed) in candidates(), factor in 1.0..1.4_f64) {
        let mut bench = Bench::new(&points, &fixed, ElasticOptions { length: 10.0, ..nothing() });
        stretched(&mut bench, factor);
        bench.assert_gradient()?;
        bench.assert_hessian()?;
    }

    #[test]
    fn compressed_tension_keeps_an_exact_gradient((points, fixed) in candidates(), factor in 0.5..0.85_f64) {
        let mut bench = Bench::new(&points, &fixed, ElasticOptions { length: 10.0, ..nothing() });
        stretched(&mut bench, factor);
        bench.assert_gradient()?;
        // Projected: the exact Hessian lies below the model.
        let rest = bench.system(&bench.points).dense() - bench.differenced_hessian();
        prop_assert!(rest.symmetric_eigenvalues().min() >= -1e-3);
    }

    #[test]
    fn bending_is_gauss_newton((points, fixed) in candidates()) {
        let bench = Bench::new(&points, &fixed, ElasticOptions { bend: 0.7, ..nothing() });
        bench.assert_gradient()?;
        // 2 Σ (d r_v) (d r_v)ᵀ with r_v = √weight · tan(θ_v / 2), differenced here on its own.
        let residuals = |x: &[DVec2]| {
            DVector::from_iterator(bench.rod.free.len(), bench.rod.free.iter().map(|&v| {
                let v = v as usize;
                let (a, b) = (bench.rod.previous(v), bench.rod.next(v));
                let angle = (x[v] - x[a]).angle_to(x[b] - x[v]);
                let weight = 0.7 * 2.0 / (bench.rod.rest[a] + bench.rod.rest[v]);
                weight.sqrt() * (0.5 * angle).tan()
            }))
        };
        let h = 1e-6;
        let columns: Vec<_> = bench.differences(h, residuals).into_iter().map(|(up, down)| (up - down) / (2.0 * h)).collect();
        let jacobian = DMatrix::from_columns(&columns);
        let gauss_newton = jacobian.transpose() * &jacobian * 2.0;
        let model = bench.system(&bench.points).dense();
        prop_assert!((&model - &gauss_newton).amax() <= 1e-4 * (1.0 + model.amax()));
    }

    #[test]
    fn clearance_is_exact_in_a_flat_field((points, fixed) in candidates()) {
        let bench = Bench::new(&points, &fixed, ElasticOptions { clearance: 0.2, ..nothing() });
        bench.assert_gradient()?;
        bench.assert_hessian()?;
    }

    #[test]
    fn tethers_are_exact((points, fixed) in candidates(), x in -0.2..0.2_f64, y in -0.2..0.2_f64, normal in any::<bool>()) {
        let mut bench = Bench::new(&points, &fixed, ElasticOptions { deviation: 0.01, ..nothing() });
        let along = normal.then(|| DVec2::from_angle(5.0 * x));
        bench.tethers = bench.rod.free.iter().step_by(2)
            .map(|&vertex| Tether { vertex, anchor: points[vertex as usize] + DVec2::new(x, y), along })
            .collect();
        // Every tethered vertex twice: several anchors a vertex are allowed.
        bench.tethers.extend(bench.tethers.clone().iter().map(|t| Tether { anchor: t.anchor - DVec2::splat(0.02), ..*t }));
        bench.assert_gradient()?;
        bench.assert_hessian()?;
    }

    #[test]
    fn repulsion_between_strands_has_an_exact_gradient((points, fixed) in candidates()) {
        let bench = Bench::new(&points, &fixed, ElasticOptions { repulsion: 1.5, ..nothing() });
        prop_assume!(bench.state(&points).energy > 0.0);
        // The nearest edge may change within the difference; the energy has a kink there, which nobody can difference.
        let same = bench.differences(1e-6, |p| bench.state(p).contacts.iter().map(|c| c.edge).collect::<Vec<_>>());
        prop_assume!(same.iter().all(|(up, down)| up == down));
        bench.assert_gradient()?;
    }

    #[test]
    fn repulsion_from_a_straight_wall_is_exact(heights in prop::collection::vec(0.1..0.9_f64, 5)) {
        let mut points = vec![DVec2::new(-9.0, 0.0), DVec2::new(9.0, 0.0), DVec2::new(9.0, 5.0)];
        points.extend(heights.iter().enumerate().map(|(k, h)| DVec2::new(3.0 - k as f64, *h)));
        points.push(DVec2::new(-9.0, 5.0));
        let fixed: Vec<bool> = (0..points.len()).map(|k| !(3..8).contains(&k)).collect();
        let bench = Bench::new(&points, &fixed, ElasticOptions { repulsion: 1.5, ..nothing() });
        prop_assert_eq!(bench.state(&points).contacts.len(), 5);
        bench.assert_gradient()?;
        bench.assert_hessian()?;
    }

    #[test]
    fn the_step_is_that_of_a_dense_solver((points, fixed) in candidates(), reach in 3..17_usize) {
        // From three vertices, where all blocks coincide, to a whole ring; free ones only or with fixed ones.
        let points = &points[..reach.min(points.len())];
        let mut bench = Bench::new(points, &fixed[..points.len()], ElasticOptions::for_width(1.0));
        prop_assume!(!bench.rod.free.is_empty());
        bench.tethers = bench.rod.free.iter().step_by(3)
            .map(|&vertex| Tether { vertex, anchor: points[vertex as usize] + DVec2::splat(0.1), along: None })
            .collect();
        let mut system = bench.system(points);
        let mut step = vec![DVec2::ZERO; bench.rod.free.len()];
        let damping = |b: usize| if b == 1 { 0.5 } else { 1e-3 };
        prop_assert!(system.solve(&mut step, damping));
        let mut dense = system.dense();
        (0..dense.nrows()).for_each(|row| dense[(row, row)] += damping(row / 2));
        prop_assert!(dense.clone().symmetric_eigenvalues().min() >= 0.9e-3);
        let oracle = dense.cholesky().unwrap().solve(&-bench.gradient(points));
        for (k, s) in step.iter().enumerate() {
            let scale = 1e-9 * (1.0 + oracle.amax());
            prop_assert!((s.x - oracle[2 * k]).abs() <= scale && (s.y - oracle[2 * k + 1]).abs() <= scale);
        }
    }
}
