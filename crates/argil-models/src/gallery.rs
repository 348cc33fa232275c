//! The models: each shows one thing that strictly continuous printing has to cope with.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::{Bounds, Field, Solid, mesh_of};

/// Size of a grid cell, mm: fine enough that a column of 6 mm is round within 0.05 mm, coarse enough that a model
/// stays below 65,000 triangles.
const CELL: f64 = 1.0;

/// A model's name with what makes it.
type Entry = (&'static str, fn() -> Solid);

const GALLERY: [Entry; 8] = [
    ("spire", spire),
    ("table", table),
    ("cup", cup),
    ("columns", columns),
    ("arch", arch),
    ("nested-rings", nested_rings),
    ("hanging-island", hanging_island),
    ("cactus", cactus),
];

/// The names of all models, for [`by_name`].
///
/// # Example
/// ```
/// use argil_models::{Solid, by_name, names};
/// for name in names() {
///     let solid: Solid = by_name(name).expect("a model of that name");
///     assert!(solid.is_closed() && solid.volume() > 0.0);
/// }
/// ```
pub fn names() -> impl Iterator<Item = &'static str> {
    GALLERY.into_iter().map(|(name, _)| name)
}

/// The model of a name; `None` when there is none.
///
/// ```
/// assert_eq!(argil_models::by_name("arch"), Some(argil_models::arch()));
/// assert_eq!(argil_models::by_name("teapot"), None);
/// ```
#[must_use]
pub fn by_name(name: &str) -> Option<Solid> {
    GALLERY.into_iter().find(|(known, _)| *known == name).map(|(_, make)| make())
}

/// Meshes a model that stands on z = 0 within `reach` mm of the z axis and below `top`.
fn standing(body: &Field, reach: f64, top: f64) -> Solid {
    let bounds = Bounds { min: DVec3::new(-reach, -reach, 0.0), max: DVec3::new(reach, reach, top) };
    // The boxes and the cell are constants of this file that span a grid, which the tests of every model see.
    mesh_of(body, bounds, CELL).unwrap_or_default()
}

/// The point at a radius and an angle about the z axis, at a height; mm and radians.
fn polar(radius: f64, angle: f64, z: f64) -> DVec3 {
    DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
}

/// Six leaning, slightly twisted columns, tapering from 8.4 mm to 6 mm, that merge at about 60 % of the height of
/// 40 mm: six islands on most layers, which a strand must join and a nozzle would have to hop between.
#[must_use]
pub fn spire() -> Solid {
    const STEPS: usize = 12;
    let body = (0..6).fold(Field::empty(), |body, k| {
        let joints: Vec<(DVec3, f64)> = (0..=STEPS)
            .map(|step| {
                let t = step as f64 / STEPS as f64;
                // The feet begin below the bed, so that they are cut at full width.
                let z = -4.0 + 41.0 * t;
                let radius = 14.5 * (1.0 - t).powf(0.7) + 0.2;
                let angle = TAU / 6.0 * f64::from(k) + 0.9 * t;
                (polar(radius, angle, z), 4.2 - 1.2 * t)
            })
            .collect();
        body.blended(Field::limb(&joints), 1.6)
    });
    standing(&body, 21.0, 41.0)
}

/// A plate on four legs: the legs are islands, and the outline of the plate begins in mid-air between them.
#[must_use]
pub fn table() -> Solid {
    let plate = Field::rounded_box(DVec3::new(-17.0, -13.0, 25.0), DVec3::new(17.0, 13.0, 29.5), 1.8);
    let legs = [(-12.5, -8.5), (12.5, -8.5), (12.5, 8.5), (-12.5, 8.5)].map(|(x, y)| {
        let foot = (DVec3::new(x * 1.08, y * 1.08, -3.5), 3.1);
        Field::rod(foot, (DVec3::new(x, y, 24.5), 3.6))
    });
    standing(&legs.into_iter().fold(plate, |body, leg| body.blended(leg, 2.0)), 20.0, 32.0)
}

/// A cup with a wall of about 4 mm, a solid floor and a handle: a hole within the outline, and an overhang at its side.
#[must_use]
pub fn cup() -> Solid {
    let outside = Field::rod((DVec3::Z * -11.0, 11.5), (DVec3::Z * 46.0, 16.0));
    let hollow = Field::rod((DVec3::Z * 12.0, 8.3), (DVec3::Z * 46.0, 11.9));
    let handle = Field::torus(DVec3::new(15.0, 0.0, 17.0), DVec3::Y, 8.0, 2.6);
    let rim = Field::half_space(DVec3::Z * 32.0, DVec3::Z);
    let body = outside.blended(handle, 1.5).carved(rim.inverted(), 1.5).carved(hollow, 1.5);
    standing(&body, 27.0, 34.0)
}

/// Two separate columns, one upright and one leaning: one strand must serve both without a hop.
#[must_use]
pub fn columns() -> Solid {
    let upright = Field::rod((DVec3::new(-9.0, 0.0, -6.0), 5.2), (DVec3::new(-9.0, 0.0, 27.0), 4.0));
    let leaning = Field::rod((DVec3::new(8.0, -4.0, -6.0), 5.2), (DVec3::new(14.0, 5.0, 23.0), 4.0));
    standing(&upright.union(leaning), 20.0, 33.0)
}

/// An arch: two islands that grow together, with an underside that nothing supports at its crown.
#[must_use]
pub fn arch() -> Solid {
    let joints: Vec<(DVec3, f64)> = (0..=24)
        .map(|k| {
            let angle = PI * f64::from(k) / 24.0;
            (DVec3::new(14.0 * angle.cos(), 0.0, 16.0 + 14.0 * angle.sin()), 4.2)
        })
        .collect();
    let leg = |x: f64| Field::rod((DVec3::new(x * 1.1, 0.0, -5.0), 4.8), (DVec3::new(x, 0.0, 16.0), 4.2));
    standing(&Field::limb(&joints).union(leg(14.0)).union(leg(-14.0)), 22.0, 36.0)
}

/// A ring within a ring and a column in the middle: islands in holes in islands.
#[must_use]
pub fn nested_rings() -> Solid {
    // The lower edges are rounded well below the bed.
    let ring = |inner: f64, outer: f64, top: f64| Field::tube((inner, outer), (-5.0, top), 1.2);
    let column = Field::rod((DVec3::Z * -5.0, 2.8), (DVec3::Z * 23.0, 2.6));
    standing(&ring(13.8, 18.2, 18.0).union(ring(6.4, 10.6, 21.0)).union(column), 20.0, 28.0)
}

/// A post with an arm from which a stalactite hangs: a body that begins in mid-air, where no path is below.
#[must_use]
pub fn hanging_island() -> Solid {
    let post = Field::rod((DVec3::new(-11.0, 0.0, -6.0), 5.4), (DVec3::new(-11.0, 0.0, 28.0), 4.2));
    let arm = Field::rod((DVec3::new(-11.0, 0.0, 28.0), 4.2), (DVec3::new(12.0, 0.0, 30.0), 3.6));
    let stalactite = Field::rod((DVec3::new(12.0, 0.0, 30.0), 4.4), (DVec3::new(12.0, 2.0, 14.0), 2.2));
    standing(&post.blended(arm, 2.5).blended(stalactite, 2.5), 20.0, 37.0)
}

/// A trunk with tapering fins and with twigs 2 mm thick: thinner than a bead of 2.5 mm, and partly than one of 1.5 mm.
#[must_use]
pub fn cactus() -> Solid {
    let trunk = Field::rod((DVec3::Z * -7.0, 5.6), (DVec3::Z * 24.0, 4.2));
    let fins = (0..3).fold(Field::empty(), |fins, k| {
        let block = Field::rounded_box(DVec3::new(0.0, -9.0, -6.0), DVec3::new(12.0, 9.0, 15.0), 0.8);
        let side =
            |sign: f64| Field::half_space(DVec3::new(12.0, 0.8 * sign, 0.0), DVec3::new(0.12, sign, 0.0));
        fins.union(block.common(side(1.0)).common(side(-1.0)).turned(TAU * f64::from(k) / 3.0))
    });
    let twigs = (0..5).fold(Field::empty(), |twigs, k| {
        let angle = TAU * (f64::from(k) + 0.25) / 5.0;
        let joints = [
            (polar(3.0, angle, 15.0), 1.0),
            (polar(10.0, angle, 23.0), 1.0),
            (polar(10.5, angle, 32.0), 1.0),
        ];
        twigs.union(Field::limb(&joints))
    });
    standing(&trunk.union(fins).union(twigs), 18.0, 36.0)
}
