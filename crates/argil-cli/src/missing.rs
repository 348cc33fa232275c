//! Which losses of a plan are findings: parts of the model that are missing from its print, and that somebody would miss.

use argil::slice::Loss;

/// A part that is missing counts from this area on, in w²: what a piece of bead covers that is as long as it is wide.
const LEAST_AREA: f64 = 1.0;

/// Two islands that vanish in neighbouring layers are of one part if they are this near to each other, in w.
const SAME_PART: f64 = 1.0;

/// An island of a layer that gets no wall.
struct Island {
    loss: usize,
    layer: usize,
    at: [f64; 2],
    area: f64,
}

/// For each loss, whether it is a finding: outline or wall that a bead could have printed is left out, or the part that
/// it belongs to is larger than w². The part of an island that vanishes is that of all islands over it and below it; of an outline
/// that gets its wall and lacks a branch, only what is missing of one layer counts, since an upright sharp edge lacks a
/// little in all of them.
///
/// # Complexity
/// O(n log n) in the losses, as long as islands of a layer lie a bead from each other.
pub(crate) fn findings(losses: &[Loss], width: f64) -> Vec<bool> {
    let least = LEAST_AREA * width * width;
    let mut found: Vec<bool> = losses
        .iter()
        .map(|loss| match *loss {
            Loss::OpenOutline { .. } | Loss::Unsound { .. } => true,
            Loss::Branch { area, .. } => area > least,
            _ => false,
        })
        .collect();
    let mut islands: Vec<Island> = losses
        .iter()
        .enumerate()
        .filter_map(|(loss, lost)| match *lost {
            Loss::Vanished { layer, at, area } => Some(Island { loss, layer, at: [at.x, at.y], area }),
            _ => None,
        })
        .collect();
    islands.sort_by(|a, b| a.layer.cmp(&b.layer).then(a.at[0].total_cmp(&b.at[0])));
    let parts = parts(&islands, SAME_PART * width);
    let mut areas = vec![0.0; islands.len()];
    for (island, &part) in islands.iter().zip(&parts) {
        areas[part] += island.area;
    }
    for (island, &part) in islands.iter().zip(&parts) {
        found[island.loss] = areas[part] > least;
    }
    found
}

/// For each island, sorted by layer and x, the number of its part: that of the part's first island.
fn parts(islands: &[Island], reach: f64) -> Vec<usize> {
    let mut part: Vec<usize> = (0..islands.len()).collect();
    for (k, island) in islands.iter().enumerate() {
        let Some(below) = island.layer.checked_sub(1) else { continue };
        let earlier = &islands[..k];
        let begin =
            earlier.partition_point(|other| (other.layer, other.at[0]).lt(&(below, island.at[0] - reach)));
        let near = (begin..k).take_while(|&other| {
            islands[other].layer == below && islands[other].at[0] <= island.at[0] + reach
        });
        for other in near {
            let [dx, dy] = [0, 1].map(|axis| islands[other].at[axis] - island.at[axis]);
            if dx.hypot(dy) <= reach {
                join(&mut part, other, k);
            }
        }
    }
    (0..islands.len()).map(|k| first(&part, k)).collect()
}

/// The first island of a part, to which each of its islands leads over earlier ones.
fn first(part: &[usize], mut island: usize) -> usize {
    while part[island] != island {
        island = part[island];
    }
    island
}

/// Makes the parts of two islands one.
fn join(part: &mut [usize], a: usize, b: usize) {
    let (a, b) = (first(part, a), first(part, b));
    let root = a.min(b);
    part[a.max(b)] = root;
}

#[cfg(test)]
mod tests {
    use super::*;
    use argil::slice::DVec2;

    fn island(layer: usize, x: f64, area: f64) -> Loss {
        Loss::Vanished { layer, at: DVec2::new(x, 0.0), area }
    }

    #[test]
    fn one_layer_larger_than_a_bead_is_wide() {
        let branch = |area| Loss::Branch { layer: 0, at: DVec2::ZERO, area };
        let losses = [island(0, 0.0, 4.1), island(3, 0.0, 3.9), branch(4.1), branch(3.9)];
        assert_eq!(findings(&losses, 2.0), [true, false, true, false]);
    }

    #[test]
    fn layers_of_one_part_count_together() {
        // A pin that leans by half a bead a layer, and specks: one in each second layer, and some far from each other.
        let pin = (0..10).map(|n| island(n, n as f64, 0.5));
        let specks = (0..10)
            .map(|n| island(2 * n, 90.0, 0.5))
            .chain((0..10).map(|n| island(n, -9.0 * n as f64 - 50.0, 0.5)));
        let losses: Vec<Loss> = specks.chain(pin).collect();
        let found = findings(&losses, 2.0);
        assert!(
            found[..20].iter().all(|found| !found) && found[20..].iter().all(|&found| found),
            "{found:?}"
        );
    }

    #[test]
    fn parts_that_meet_further_up_are_one() {
        // The legs of an arch, told from the top down: each by itself is small.
        let legs = (0..3).rev().flat_map(|n| [island(n, n as f64, 0.7), island(n, 4.0 - n as f64, 0.7)]);
        let losses: Vec<Loss> = legs.collect();
        assert_eq!(findings(&losses, 2.0), [true; 6]);
        assert_eq!(findings(&losses[2..], 2.0), [false; 4]);
    }

    #[test]
    fn a_sharp_edge_that_lacks_a_little_in_every_layer_is_none() {
        let losses: Vec<Loss> =
            (0..99).map(|layer| Loss::Branch { layer, at: DVec2::ZERO, area: 0.5 }).collect();
        assert_eq!(findings(&losses, 2.0), vec![false; 99]);
    }

    #[test]
    fn outlines_and_walls_that_are_left_out_always_count() {
        let open = Loss::OpenOutline { layer: 0, at: DVec2::ZERO, length: 1e-3, gap: 9.0 };
        let unsound = Loss::Unsound { layer: 0, at: DVec2::ZERO, length: 1e-3 };
        let narrow = Loss::Narrow { layer: 0, at: DVec2::ZERO, length: 99.0 };
        assert_eq!(findings(&[open, unsound, narrow], 2.0), [true, true, false]);
    }
}
