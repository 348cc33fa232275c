//! The regions of a layer: free space between a wall and the walls directly inside it.

use argil_curve::{ClosedCurve, DVec2};

use crate::{RouteError, Wall};

/// The free space inside one wall (or outside of all), with what lies in it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Region {
    /// The wall around it; `None` for the unbounded region.
    pub outer: Option<usize>,
    /// The walls directly inside it.
    pub children: Vec<usize>,
    /// The demands that lie in it.
    pub demands: Vec<usize>,
}

/// Splits a layer into its regions: the unbounded one first, then one a wall, largest wall first.
///
/// A demand belongs to the region of the deepest wall that contains it (nested support, section 3.3).
/// Regions without demands and children are left out, except that they matter to nobody.
///
/// # Errors
/// [`RouteError::Parent`] when a parent does not exist or parents form a ring, [`RouteError::Wall`] when there is not one
/// curve a wall.
///
/// # Complexity
/// O(walls · demands · points of a wall).
///
/// # Example
/// ```
/// use argil_route::{ClosedCurve, DVec2, Region, Wall, regions};
/// let outer = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)].map(DVec2::from);
/// let hole = [(3.0, 3.0), (3.0, 6.0), (6.0, 6.0), (6.0, 3.0)].map(DVec2::from);
/// let walls = [Wall { points: &outer, parent: None }, Wall { points: &hole, parent: Some(0) }];
/// let curves = [ClosedCurve::new(outer.to_vec())?, ClosedCurve::new(hole.to_vec())?];
/// let found = regions(&walls, &curves, &[DVec2::splat(4.5)])?;
/// // All round, between the two, and in the hole.
/// assert_eq!(found.iter().map(|region| region.outer).collect::<Vec<_>>(), [None, Some(0), Some(1)]);
/// assert_eq!(found[2], Region { outer: Some(1), children: vec![], demands: vec![0] });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn regions(
    walls: &[Wall<'_>],
    curves: &[ClosedCurve],
    demands: &[DVec2],
) -> Result<Vec<Region>, RouteError> {
    if curves.len() != walls.len() {
        return Err(RouteError::Wall { wall: curves.len().min(walls.len()) });
    }
    let depth = depths(walls)?;
    let mut deepest_first: Vec<usize> = (0..walls.len()).collect();
    deepest_first.sort_by_key(|&w| (std::cmp::Reverse(depth[w]), w));
    let mut largest_first: Vec<usize> = (0..walls.len()).collect();
    largest_first.sort_by(|&a, &b| {
        curves[b].signed_area().abs().total_cmp(&curves[a].signed_area().abs()).then(a.cmp(&b))
    });

    let mut all = vec![Region { outer: None, children: Vec::new(), demands: Vec::new() }];
    let mut region_of = vec![0; walls.len()];
    for &wall in &largest_first {
        region_of[wall] = all.len();
        all.push(Region { outer: Some(wall), children: Vec::new(), demands: Vec::new() });
    }
    for &wall in &largest_first {
        let home = walls[wall].parent.map_or(0, |parent| region_of[parent]);
        all[home].children.push(wall);
    }
    for (index, &point) in demands.iter().enumerate() {
        let home = deepest_first.iter().find(|&&wall| curves[wall].contains(point));
        all[home.map_or(0, |&wall| region_of[wall])].demands.push(index);
    }
    all.retain(|region| !(region.children.is_empty() && region.demands.is_empty()));
    Ok(all)
}

/// How many walls lie around each wall.
fn depths(walls: &[Wall<'_>]) -> Result<Vec<usize>, RouteError> {
    (0..walls.len())
        .map(|wall| {
            let (mut depth, mut at) = (0, wall);
            while let Some(parent) = walls[at].parent {
                if parent >= walls.len() || depth > walls.len() {
                    return Err(RouteError::Parent { wall });
                }
                depth += 1;
                at = parent;
            }
            Ok(depth)
        })
        .collect()
}
