//! Parallel projection of layers onto the paper.

use argil_strand::DVec2;

/// A view from afar: a direction round the part and a height above the horizon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    /// To the right on the paper.
    right: DVec2,
    /// Away from the eye, in the plane of a layer.
    away: DVec2,
    sin: f64,
    cos: f64,
    scale: f64,
}

impl Projection {
    /// Angles in degrees, scale in pixels to the millimetre.
    pub(crate) fn new(azimuth: f64, elevation: f64, scale: f64) -> Self {
        let (sin, cos) = azimuth.to_radians().sin_cos();
        let right = DVec2::new(cos, sin);
        let (rise, flat) = elevation.to_radians().sin_cos();
        Self { right, away: right.perp(), sin: rise, cos: flat, scale }
    }

    /// Where a point at a height falls on the paper, pixels, y down.
    pub(crate) fn place(&self, p: DVec2, z: f64) -> DVec2 {
        DVec2::new(self.right.dot(p), -(self.sin * self.away.dot(p) + self.cos * z)) * self.scale
    }

    /// The point of the plane at height `plane` that falls on the paper where `p` does at height `z`.
    pub(crate) fn onto(&self, p: DVec2, z: f64, plane: f64) -> DVec2 {
        // The view is never quite level, so the sine is not 0.
        p + self.away * ((z - plane) * self.cos / self.sin)
    }

    /// The six numbers of the SVG matrix that lays a plane at height z onto the paper.
    ///
    /// A stroke drawn through it is a ribbon that lies flat in that plane, as wide as it looks from the eye in every
    /// direction.
    pub(crate) fn matrix(&self, z: f64) -> [f64; 6] {
        let (x, y, origin) =
            (self.place(DVec2::X, 0.0), self.place(DVec2::Y, 0.0), self.place(DVec2::ZERO, z));
        [x.x, x.y, y.x, y.y, origin.x, origin.y]
    }

    /// How much light the side of a bead has that faces the eye, 0 to 1, by the direction of the bead. The light comes
    /// from the left and a little from the front. The less of its side a bead shows, the nearer the light is to a half,
    /// so that it does not leap where the one side comes to face the eye instead of the other.
    pub(crate) fn light(&self, along: DVec2) -> f64 {
        let side = along.try_normalize().unwrap_or(self.right).perp();
        let facing = -side.dot(self.away);
        0.5 + 0.5 * facing * side.dot(self.right * -0.8 - self.away * 0.6)
    }
}

#[cfg(test)]
mod tests {
    use super::Projection;
    use argil_strand::DVec2;

    #[test]
    fn right_goes_right_and_up_goes_up() {
        let view = Projection::new(0.0, 30.0, 2.0);
        assert!((view.place(DVec2::X, 0.0) - DVec2::X * 2.0).length() < 1e-12);
        assert!(view.place(DVec2::ZERO, 1.0).y < 0.0);
        assert!(view.place(DVec2::Y, 0.0).y < 0.0);
    }

    #[test]
    fn a_point_above_a_plane_has_its_place_in_it() {
        let view = Projection::new(33.0, 41.0, 7.0);
        let p = DVec2::new(3.0, -8.0);
        assert!((view.place(view.onto(p, 12.5, 12.0), 12.0) - view.place(p, 12.5)).length() < 1e-9);
        assert_eq!(view.onto(p, 12.0, 12.0), p);
    }

    #[test]
    fn the_matrix_places_as_the_projection_does() {
        let view = Projection::new(33.0, 41.0, 7.0);
        let [a, b, c, d, e, f] = view.matrix(12.0);
        let p = DVec2::new(3.0, -8.0);
        let through = DVec2::new(a * p.x + c * p.y + e, b * p.x + d * p.y + f);
        assert!((through - view.place(p, 12.0)).length() < 1e-9);
    }

    #[test]
    fn the_left_is_lit_and_both_directions_of_laying_look_alike() {
        let view = Projection::new(0.0, 30.0, 1.0);
        let (left, right) = (DVec2::new(1.0, -1.0), DVec2::new(1.0, 1.0));
        assert!(view.light(left) > view.light(right));
        assert!((view.light(left) - view.light(-left)).abs() < 1e-12);
        assert!((0.0..=1.0).contains(&view.light(DVec2::ZERO)));
    }
}
