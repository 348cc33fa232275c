use crate::EdgeTable;

const NONE: u32 = u32::MAX;

/// Triangles of which none is there again without need.
pub(crate) struct Distinct {
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Dropped since another one was there before.
    pub(crate) duplicates: Vec<[u32; 3]>,
    /// Dropped since they lie between two bodies, which meet without them.
    pub(crate) inner: Vec<[u32; 3]>,
}

/// Drops triangles whose three corners another one has as well.
///
/// Of those wound alike one stays, and so does one where more are wound one way than the other. Two cases are told apart by what is
/// around, along the rim of the patch that such faces form. Along the rim of a face that two bodies have in common an even number
/// of other triangles meet: if the bodies lie on both sides of it, they close without it and both copies go; if they
/// lie on the same side, each needs its own and both copies stay. Along the rim of a face that a program wrote twice, or for
/// both of its sides, an odd number meets, or none at all.
///
/// # Complexity
/// O(n log n) in the triangles.
pub(crate) fn distinct(vertex_count: usize, triangles: Vec<[u32; 3]>) -> Distinct {
    let mut sorted: Vec<([u32; 3], u32)> = triangles
        .iter()
        .enumerate()
        .map(|(index, corners)| {
            let mut key = *corners;
            key.sort_unstable();
            (key, index as u32)
        })
        .collect();
    sorted.sort_unstable();
    let mut found = Distinct { triangles: Vec::new(), duplicates: Vec::new(), inner: Vec::new() };
    let mut dropped = vec![false; triangles.len()];
    let (mut two_sided, mut doubled) = (Vec::new(), Vec::new());
    for group in sorted.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        let is_even = |&&(_, index): &&([u32; 3], u32)| runs_up(triangles[index as usize]);
        let even = group.iter().filter(is_even).count();
        let odd = group.len() - even;
        let keeps_even = even > odd || (even == odd && runs_up(triangles[group[0].1 as usize]));
        let mut alike =
            group.iter().map(|pair| pair.1).filter(|&k| runs_up(triangles[k as usize]) == keeps_even);
        let kept = alike.next().unwrap_or(NONE);
        match even.abs_diff(odd) {
            0 => two_sided.push(kept),
            1 => {}
            _ => doubled.push((kept, alike.next().unwrap_or(NONE))),
        }
        for &(_, index) in group.iter().filter(|&&(_, index)| index != kept) {
            dropped[index as usize] = true;
        }
    }
    if !dropped.contains(&true) {
        return Distinct { triangles, ..found };
    }
    let edges = EdgeTable::new(vertex_count, &triangles);
    let inner = in_common(&edges, &dropped, &two_sided);
    let firsts: Vec<u32> = doubled.iter().map(|pair| pair.0).collect();
    let common = in_common(&edges, &dropped, &firsts);
    for (first, second) in doubled {
        dropped[second as usize] = !common[first as usize];
    }
    for (corners, (is_dropped, is_inner)) in triangles.into_iter().zip(dropped.into_iter().zip(inner)) {
        match (is_dropped, is_inner) {
            (_, true) => found.inner.push(corners),
            (true, _) => found.duplicates.push(corners),
            _ => found.triangles.push(corners),
        }
    }
    found
}

/// Whether the corners are an even permutation of their order.
fn runs_up([a, b, c]: [u32; 3]) -> bool {
    !((a < b) ^ (b < c) ^ (c < a))
}

/// Which of some faces two bodies have in common, by the patches that they form where they share edges.
fn in_common(edges: &EdgeTable, dropped: &[bool], faces: &[u32]) -> Vec<bool> {
    let mut common = vec![false; dropped.len()];
    if faces.is_empty() {
        return common;
    }
    let mut is_face = vec![false; dropped.len()];
    faces.iter().for_each(|&face| is_face[face as usize] = true);
    let mut others = vec![0_u32; edges.ends().len()];
    let mut faces_of: Vec<Vec<u32>> = vec![Vec::new(); edges.ends().len()];
    for (triangle, sides) in edges.of_triangles().iter().enumerate().filter(|&(k, _)| !dropped[k]) {
        for &side in sides {
            if is_face[triangle] {
                faces_of[side as usize].push(triangle as u32);
            } else {
                others[side as usize] += 1;
            }
        }
    }
    let mut met = vec![false; dropped.len()];
    for &first in faces {
        if std::mem::replace(&mut met[first as usize], true) {
            continue;
        }
        let mut patch = vec![first];
        let (mut even, mut odd) = (0_usize, 0_usize);
        let mut done = 0;
        while let Some(&face) = patch.get(done) {
            done += 1;
            for &side in &edges.of_triangles()[face as usize] {
                match others[side as usize] {
                    0 => {}
                    count if count % 2 == 0 => even += 1,
                    _ => odd += 1,
                }
                for &next in &faces_of[side as usize] {
                    if !std::mem::replace(&mut met[next as usize], true) {
                        patch.push(next);
                    }
                }
            }
        }
        if even > odd {
            patch.iter().for_each(|&face| common[face as usize] = true);
        }
    }
    common
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two tetrahedra on the two sides of the face 0 1 2.
    const TWINS: [[u32; 3]; 8] =
        [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0], [2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 0, 4]];

    #[test]
    fn a_face_between_two_bodies_goes() {
        let found = distinct(5, TWINS.to_vec());
        assert_eq!(found.triangles.len(), 6);
        assert_eq!((found.duplicates.len(), found.inner.len()), (1, 1));
    }

    #[test]
    fn of_a_body_written_for_both_sides_one_side_stays() {
        let outside = &TWINS[..4];
        let inside = outside.iter().map(|&[a, b, c]| [a, c, b]);
        let found = distinct(4, outside.iter().copied().chain(inside).collect());
        assert_eq!(found.triangles, outside);
        assert_eq!((found.duplicates.len(), found.inner.len()), (4, 0));
        // The same with one face only.
        let found = distinct(4, [outside, &[[0, 2, 1]]].concat());
        assert_eq!((found.triangles.len(), found.inner.len()), (4, 0));
    }

    #[test]
    fn a_face_that_two_bodies_have_on_the_same_side_stays_twice() {
        // Two tetrahedra of different height over the same base.
        let base = [[0, 2, 1], [0, 2, 1]];
        let sides = |top: u32| [[0, 1, top], [1, 2, top], [2, 0, top]];
        let all = [&base[..], &sides(3), &sides(4)].concat();
        let found = distinct(5, all.clone());
        assert_eq!(found.triangles, all);
        assert!(found.duplicates.is_empty() && found.inner.is_empty());
    }

    #[test]
    fn what_is_there_three_times_stays_once_as_most_are_wound() {
        let found = distinct(4, vec![[0, 2, 1], [0, 1, 2], [1, 2, 0]]);
        assert_eq!(found.triangles, [[0, 1, 2]]);
        assert_eq!(found.duplicates.len(), 2);
    }
}
