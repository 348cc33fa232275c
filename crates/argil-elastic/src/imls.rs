//! The paper's implicit distance to the safeguard (Eq. 4), for comparison with an exact one.

use glam::DVec2;

use crate::{Clearance, ElasticError};

/// Implicit moving least squares over the vertices of the safeguard: Eq. 4, after Öztireli, Guennebaud and Gross,
/// "Feature Preserving Point Set Surfaces based on Non-Linear Kernel Regression" (2009),
/// <https://doi.org/10.1111/j.1467-8659.2009.01388.x>.
///
/// `f(y) = Σ n_k · (y − x_k) φ_k(y) / Σ φ_k(y)` with `φ_k(y) = exp(−|y − x_k|² / radius²)`. The paper names neither
/// the kernel nor its radius, and much hangs on it: a radius of two bead widths gives wrong signs near concave parts, one
/// below the vertex spacing ripples, and any Gaussian underflows to 0/0 some 27 radii away. Take about the spacing
/// of the vertices, or better an exact signed distance; this type exists so that the two can be compared.
#[derive(Clone, Debug, PartialEq)]
pub struct ImlsField {
    vertices: Vec<DVec2>,
    normals: Vec<DVec2>,
    radius: f64,
}

impl ImlsField {
    /// A field about closed polylines, outer ones counter-clockwise and holes clockwise, in mm.
    ///
    /// A vertex normal is the direction between the normals of its two edges. Without any vertex the field is
    /// infinitely far from everywhere.
    ///
    /// # Errors
    /// If the radius is not positive or a vertex not finite (counted through all polylines).
    ///
    /// # Example
    /// ```
    /// use argil_elastic::{Clearance, DVec2, ImlsField};
    /// let circle: Vec<DVec2> = (0..60).map(|k| DVec2::from_angle(f64::from(k) * 0.1047) * 10.0).collect();
    /// let field = ImlsField::new([circle.as_slice()], 1.0)?;
    /// let (distance, gradient) = field.distance(DVec2::new(12.0, 0.0));
    /// assert!((distance - 2.0).abs() < 0.1 && gradient.x > 0.9);
    /// # Ok::<(), argil_elastic::ElasticError>(())
    /// ```
    pub fn new<'a>(
        polylines: impl IntoIterator<Item = &'a [DVec2]>,
        radius: f64,
    ) -> Result<Self, ElasticError> {
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(ElasticError::BadOption {
                option: "radius",
                value: radius,
                expected: "finite and positive",
            });
        }
        let mut field = Self { vertices: Vec::new(), normals: Vec::new(), radius };
        for line in polylines {
            let n = line.len();
            for (k, &vertex) in line.iter().enumerate() {
                if !vertex.is_finite() {
                    return Err(ElasticError::PointNotFinite { vertex: field.vertices.len() });
                }
                let before = (vertex - line[(k + n - 1) % n]).normalize_or_zero();
                let after = (line[(k + 1) % n] - vertex).normalize_or_zero();
                field.vertices.push(vertex);
                field.normals.push(-(before + after).perp().normalize_or_zero());
            }
        }
        Ok(field)
    }

    /// The nearest vertex and its signed distance, where all weights have underflown.
    fn nearest(&self, p: DVec2) -> (f64, DVec2) {
        let by_distance = |a: &usize, b: &usize| {
            p.distance_squared(self.vertices[*a]).total_cmp(&p.distance_squared(self.vertices[*b]))
        };
        match (0..self.vertices.len()).min_by(by_distance) {
            Some(k) => {
                let away = p - self.vertices[k];
                let side = if away.dot(self.normals[k]) < 0.0 { -1.0 } else { 1.0 };
                (side * away.length(), side * away.normalize_or_zero())
            }
            None => (f64::INFINITY, DVec2::ZERO),
        }
    }
}

impl Clearance for ImlsField {
    /// Eq. 4 and its exact gradient, which is not quite of unit length since f is not quite a distance.
    ///
    /// # Complexity
    /// Linear in the number of vertices.
    fn distance(&self, p: DVec2) -> (f64, DVec2) {
        let per_square = 1.0 / (self.radius * self.radius);
        let (mut weights, mut heights) = (0.0, 0.0);
        let (mut weight_slope, mut height_slope) = (DVec2::ZERO, DVec2::ZERO);
        for (&vertex, &normal) in self.vertices.iter().zip(&self.normals) {
            let away = p - vertex;
            let weight = (-away.length_squared() * per_square).exp();
            let slope = away * (-2.0 * per_square * weight);
            let height = normal.dot(away);
            weights += weight;
            weight_slope += slope;
            heights += weight * height;
            height_slope += normal * weight + slope * height;
        }
        if weights < f64::MIN_POSITIVE {
            return self.nearest(p);
        }
        let value = heights / weights;
        (value, (height_slope - weight_slope * value) / weights)
    }
}
