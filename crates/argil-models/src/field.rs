//! Signed distance fields: bodies as functions of a point.

use std::fmt;
use std::sync::Arc;

use glam::{DVec2, DVec3};

/// A body as the signed distance of any point to its surface: negative inside, mm.
///
/// Unions, cuts and blends of bodies are then arithmetic on numbers. The distance of a combined body is exact near its
/// surface and a lower bound farther off, which is all that meshing needs. Copies share the function.
///
/// # Example
/// ```
/// use argil_models::{DVec3, Field};
/// let ball = Field::sphere(DVec3::ZERO, 5.0);
/// let dumb_bell = ball.clone().union(ball.translated(DVec3::X * 20.0));
/// assert_eq!(dumb_bell.distance(DVec3::X * 20.0), -5.0);
/// assert_eq!(dumb_bell.distance(DVec3::X * 10.0), 5.0);
/// ```
///
/// A mug: a thing with a foot, a hollow and a handle, cut off at the rim.
/// ```
/// use argil_models::{DVec3, Field};
/// let [inner, outer] = [18.0, 20.0].map(|radius| Field::cylinder(DVec3::ZERO.truncate(), radius, 0.0, 50.0));
/// let foot = Field::rounded_box(DVec3::new(-12.0, -12.0, -4.0), DVec3::new(12.0, 12.0, 1.0), 0.5);
/// let handle = Field::torus(DVec3::new(20.0, 0.0, 20.0), DVec3::Y, 10.0, 3.0).without(outer.clone());
/// let spout = Field::limb(&[(DVec3::new(-19.0, 0.0, 30.0), 2.0), (DVec3::new(-28.0, 0.0, 44.0), 1.5)]);
/// let below_the_rim = Field::half_space(DVec3::Z * 40.0, DVec3::Z);
/// let parts = [outer, foot, handle, spout].into_iter().fold(Field::empty(), Field::union);
/// let mug = parts.carved(inner.clone().translated(DVec3::Z * 3.0), 0.5).common(below_the_rim);
/// let is_clay = |x: f64, z: f64| mug.distance(DVec3::new(x, 0.0, z)) < 0.0;
/// assert!(is_clay(19.0, 20.0) && is_clay(30.0, 20.0) && is_clay(0.0, -2.0) && is_clay(-22.0, 34.5));
/// assert!(!is_clay(0.0, 20.0) && !is_clay(24.0, 20.0) && !is_clay(19.0, 41.0));
/// // A tube with its handle on the other side.
/// let pipe = Field::tube((18.0, 20.0), (0.0, 40.0), 0.5).union(mug.turned(std::f64::consts::PI));
/// assert!(pipe.distance(DVec3::new(-30.0, 0.0, 20.0)) < 0.0);
/// // All that is none of the hollow.
/// assert!(inner.inverted().distance(DVec3::Z) > 0.0);
/// ```
#[derive(Clone)]
pub struct Field {
    distance: Arc<dyn Fn(DVec3) -> f64 + Send + Sync>,
}

impl fmt::Debug for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Field")
    }
}

impl Field {
    /// A body given by a function of one's own.
    #[must_use]
    pub fn new(distance: impl Fn(DVec3) -> f64 + Send + Sync + 'static) -> Self {
        Self { distance: Arc::new(distance) }
    }

    /// Nothing at all: the neutral element of [`Field::union`].
    #[must_use]
    pub fn empty() -> Self {
        Self::new(|_| f64::INFINITY)
    }

    /// Signed distance of a point to the surface, mm; negative inside.
    #[must_use]
    pub fn distance(&self, point: DVec3) -> f64 {
        (self.distance)(point)
    }

    /// A ball.
    #[must_use]
    pub fn sphere(centre: DVec3, radius: f64) -> Self {
        Self::new(move |p| p.distance(centre) - radius)
    }

    /// A rod with round ends from one point to another, as thick at each end as its radius there says.
    ///
    /// The radius runs linearly along the axis, so a rod that tapers is a little thicker across its surface than the
    /// exact distance would have it: less than 2 % up to a taper of 0.2 mm a mm.
    #[must_use]
    pub fn rod(from: (DVec3, f64), to: (DVec3, f64)) -> Self {
        let ((a, thick), (b, thin)) = (from, to);
        let axis = b - a;
        let square = axis.length_squared();
        Self::new(move |p| {
            let t = if square > 0.0 { ((p - a).dot(axis) / square).clamp(0.0, 1.0) } else { 0.0 };
            p.distance(a + axis * t) - (thick + (thin - thick) * t)
        })
    }

    /// Rods of one piece along a line of points, each with its radius.
    #[must_use]
    pub fn limb(joints: &[(DVec3, f64)]) -> Self {
        match joints {
            [] => Self::empty(),
            &[(centre, radius)] => Self::sphere(centre, radius),
            _ => joints.windows(2).map(|pair| Self::rod(pair[0], pair[1])).fold(Self::empty(), Self::union),
        }
    }

    /// An upright cylinder over `centre` in the plane, from one height to another, mm.
    #[must_use]
    pub fn cylinder(centre: DVec2, radius: f64, low: f64, high: f64) -> Self {
        Self::new(move |p| {
            let across = p.truncate().distance(centre) - radius;
            let along = (p.z - high).max(low - p.z);
            across.max(0.0).hypot(along.max(0.0)) + across.max(along).min(0.0)
        })
    }

    /// A box between two corners whose edges are rounded by a radius, mm.
    #[must_use]
    pub fn rounded_box(low: DVec3, high: DVec3, radius: f64) -> Self {
        let centre = (low + high) / 2.0;
        let half = (high - low) / 2.0 - DVec3::splat(radius);
        Self::new(move |p| {
            let off = (p - centre).abs() - half;
            off.max(DVec3::ZERO).length() + off.max_element().min(0.0) - radius
        })
    }

    /// An upright tube about the z axis between two radii and two heights, its edges rounded by a radius, mm.
    #[must_use]
    pub fn tube(radii: (f64, f64), heights: (f64, f64), rounding: f64) -> Self {
        let middle = DVec2::new(radii.0 + radii.1, heights.0 + heights.1) / 2.0;
        let half = DVec2::new(radii.1 - radii.0, heights.1 - heights.0) / 2.0 - DVec2::splat(rounding);
        Self::new(move |p| {
            let off = (DVec2::new(p.truncate().length(), p.z) - middle).abs() - half;
            off.max(DVec2::ZERO).length() + off.max_element().min(0.0) - rounding
        })
    }

    /// A ring of round section about an axis through `centre`; `axis` need not be of unit length.
    #[must_use]
    pub fn torus(centre: DVec3, axis: DVec3, ring: f64, section: f64) -> Self {
        let axis = axis.normalize_or(DVec3::Z);
        Self::new(move |p| {
            let off = p - centre;
            let along = off.dot(axis);
            let across = (off - axis * along).length() - ring;
            across.hypot(along) - section
        })
    }

    /// Everything on the far side of a plane: below it as seen along `normal`.
    #[must_use]
    pub fn half_space(point: DVec3, normal: DVec3) -> Self {
        let normal = normal.normalize_or(DVec3::Z);
        Self::new(move |p| (p - point).dot(normal))
    }

    /// Both bodies.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self::new(move |p| self.distance(p).min(other.distance(p)))
    }

    /// Both bodies, with a fillet of about `reach` mm where they meet (the quadratic smooth minimum).
    #[must_use]
    pub fn blended(self, other: Self, reach: f64) -> Self {
        if reach.is_nan() || reach <= 0.0 {
            return self.union(other);
        }
        Self::new(move |p| {
            let (a, b) = (self.distance(p), other.distance(p));
            let overlap = (reach - (a - b).abs()).max(0.0) / reach;
            a.min(b) - overlap * overlap * reach / 4.0
        })
    }

    /// What both bodies share.
    #[must_use]
    pub fn common(self, other: Self) -> Self {
        Self::new(move |p| self.distance(p).max(other.distance(p)))
    }

    /// This body without the other.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        Self::new(move |p| self.distance(p).max(-other.distance(p)))
    }

    /// This body without the other, with the edge of the cut rounded by about `reach` mm (the quadratic smooth
    /// maximum).
    #[must_use]
    pub fn carved(self, other: Self, reach: f64) -> Self {
        self.inverted().blended(other, reach).inverted()
    }

    /// All that the body is not.
    #[must_use]
    pub fn inverted(self) -> Self {
        Self::new(move |p| -self.distance(p))
    }

    /// The body moved by a vector, mm.
    #[must_use]
    pub fn translated(self, by: DVec3) -> Self {
        Self::new(move |p| self.distance(p - by))
    }

    /// The body turned about the z axis, counter-clockwise by an angle in radians.
    #[must_use]
    pub fn turned(self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self::new(move |p| self.distance(DVec3::new(cos * p.x + sin * p.y, cos * p.y - sin * p.x, p.z)))
    }
}

#[cfg(test)]
mod tests {
    use super::Field;
    use glam::{DVec2, DVec3};

    #[test]
    fn distances_are_those_of_the_bodies() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} is not {b}");
        let at = DVec3::new;
        near(Field::cylinder(DVec2::ZERO, 2.0, 0.0, 10.0).distance(at(5.0, 0.0, 14.0)), 5.0);
        near(Field::cylinder(DVec2::ZERO, 2.0, 0.0, 10.0).distance(at(0.0, 0.0, 9.0)), -1.0);
        near(Field::rounded_box(DVec3::ZERO, DVec3::splat(10.0), 2.0).distance(at(13.0, 5.0, 5.0)), 3.0);
        near(Field::rounded_box(DVec3::ZERO, DVec3::splat(10.0), 2.0).distance(DVec3::splat(5.0)), -5.0);
        near(Field::tube((5.0, 9.0), (0.0, 20.0), 1.0).distance(at(0.0, 7.0, 10.0)), -2.0);
        near(Field::tube((5.0, 9.0), (0.0, 20.0), 1.0).distance(at(0.0, 0.0, 10.0)), 5.0);
        near(Field::torus(DVec3::ZERO, DVec3::Z * 3.0, 8.0, 2.0).distance(at(0.0, 8.0, 5.0)), 3.0);
        near(Field::rod((DVec3::ZERO, 3.0), (DVec3::Z * 10.0, 1.0)).distance(at(4.0, 0.0, 5.0)), 2.0);
        near(Field::rod((DVec3::ZERO, 3.0), (DVec3::ZERO, 3.0)).distance(at(4.0, 0.0, 0.0)), 1.0);
        near(Field::half_space(DVec3::Z, DVec3::Z).distance(DVec3::ZERO), -1.0);
        near(
            Field::sphere(DVec3::X * 5.0, 1.0).turned(std::f64::consts::FRAC_PI_2).distance(DVec3::Y * 5.0),
            -1.0,
        );
        assert_eq!(Field::limb(&[]).distance(DVec3::ZERO), f64::INFINITY);
    }

    #[test]
    fn a_blend_only_adds_and_only_near_both() {
        let (a, b) = (Field::sphere(DVec3::ZERO, 5.0), Field::sphere(DVec3::X * 8.0, 5.0));
        let blend = a.clone().blended(b.clone(), 3.0);
        let plain = a.union(b);
        let seam = DVec3::new(4.0, 3.5, 0.0);
        assert!(blend.distance(seam) < plain.distance(seam));
        assert_eq!(blend.distance(DVec3::X * -9.0), plain.distance(DVec3::X * -9.0));
    }

    #[test]
    fn carving_takes_a_little_more_than_cutting() {
        let (ball, plane) = (Field::sphere(DVec3::ZERO, 5.0), Field::half_space(DVec3::ZERO, DVec3::Z));
        let (cut, carved) = (ball.clone().without(plane.clone()), ball.carved(plane, 2.0));
        let edge = DVec3::new(4.9, 0.0, 0.1);
        assert!(cut.distance(edge) < 0.0 && carved.distance(edge) > 0.0);
        assert_eq!(carved.distance(DVec3::Z * 4.5), cut.distance(DVec3::Z * 4.5));
    }
}
