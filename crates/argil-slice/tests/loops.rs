//! Layers of loops from elsewhere: what contains what is found again.

use argil_curve::DVec2;
use argil_slice::Layer;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const GRID: f64 = 1e-4;

/// A square of 2 `half` mm about a point, counter-clockwise.
fn square(middle: DVec2, half: f64) -> Vec<DVec2> {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|c| middle + half * DVec2::from(c)).to_vec()
}

fn turns_left(points: &[DVec2]) -> bool {
    (0..points.len()).map(|k| points[k].perp_dot(points[(k + 1) % points.len()])).sum::<f64>() > 0.0
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    /// Stacks of squares side by side, in any order and turned any way, are put together as they were made.
    #[test]
    fn nesting_is_found_again(
        depths in prop::collection::vec(1_usize..6, 1..5),
        keys in prop::collection::vec((any::<u32>(), any::<bool>()), 30),
    ) {
        // Each square with the stack it is from and how many lie around it.
        let mut made: Vec<(usize, usize, Vec<DVec2>)> = Vec::new();
        for (stack, &depth) in depths.iter().enumerate() {
            let middle = DVec2::new(50.0 * stack as f64, 7.0);
            made.extend((0..depth).map(|around| (stack, around, square(middle, 20.0 - 3.0 * around as f64))));
        }
        let mut order: Vec<usize> = (0..made.len()).collect();
        order.sort_by_key(|&k| (keys[k].0, k));
        let made: Vec<_> = order.iter().map(|&k| made[k].clone()).collect();
        let loops: Vec<Vec<DVec2>> = made
            .iter()
            .zip(&keys)
            .map(|((.., points), (_, turned))| {
                if *turned { points.iter().rev().copied().collect() } else { points.clone() }
            })
            .collect();

        let layer = Layer::of_loops(3, 2.0, 0.5, &loops, GRID);
        prop_assert_eq!((layer.index, layer.cut_z, layer.print_z), (3, 1.75, 2.0));
        prop_assert_eq!(layer.walls.len(), made.len());
        for (wall, (stack, around, points)) in layer.walls.iter().zip(&made) {
            prop_assert_eq!((wall.depth, wall.hole), (*around, around % 2 == 1));
            prop_assert_eq!(turns_left(&wall.points), !wall.hole);
            prop_assert!(wall.points.iter().all(|p| points.iter().any(|q| p.distance(*q) < GRID)));
            let parent = wall.parent.map(|parent| (made[parent].0, made[parent].1));
            prop_assert_eq!(parent, around.checked_sub(1).map(|around| (*stack, around)));
        }
        let holes: usize = layer.outline.0.iter().map(|polygon| polygon.interiors().len()).sum();
        prop_assert_eq!(layer.outline.0.len() + holes, made.len());
    }

    /// Whatever comes is kept, and nothing panics.
    #[test]
    fn loops_that_are_none_are_kept(
        loops in prop::collection::vec(prop::collection::vec((any::<f64>(), any::<f64>()), 0..5), 0..4),
        grid in any::<f64>(),
    ) {
        let loops: Vec<Vec<DVec2>> = loops.into_iter().map(|l| l.into_iter().map(DVec2::from).collect()).collect();
        let layer = Layer::of_loops(0, 1.0, 1.0, &loops, grid);
        prop_assert_eq!(layer.walls.len(), loops.len());
        prop_assert!(layer.walls.iter().zip(&loops).all(|(wall, given)| wall.points.len() == given.len()));
    }
}
