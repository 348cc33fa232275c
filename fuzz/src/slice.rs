use argil_curve::{ClosedCurve, self_crossings};
use argil_slice::mesh::Mesh;
use argil_slice::{Layer, SliceSettings};

use crate::Draw;

/// Most bodies of an input: each adds some hundred layers' worth of contours at most.
const MOST_BODIES: usize = 6;

/// Most loose triangles of an input.
const MOST_TRIANGLES: usize = 40;

/// Slices boxes, prisms and loose triangles: walls are simple loops on the grid, nested as they say.
pub fn slice(bytes: &[u8]) {
    let mut draw = Draw::new(bytes);
    let width = 1.5;
    let layer_height = [0.5, 0.4, 1.0, 0.75][draw.below(4)];
    let settings =
        SliceSettings { layer_height, width, walls: 1 + draw.below(3), ..SliceSettings::default() };
    let mut soup = Soup::default();
    if draw.flag() {
        soup.loose(&mut draw);
    } else {
        for _ in 0..MOST_BODIES {
            if draw.is_empty() {
                break;
            }
            soup.body(&mut draw);
        }
    }
    let Ok(mesh) = Mesh::new(soup.vertices, soup.triangles) else { return };
    let Ok(layers) = argil_slice::slice(&mesh, &settings) else { return };
    for (index, layer) in layers.iter().enumerate() {
        assert_eq!(layer.index, index);
        is_sound(layer, &settings);
    }
    assert!(layers.windows(2).all(|pair| pair[0].print_z < pair[1].print_z));
}

fn is_sound(layer: &Layer, settings: &SliceSettings) {
    for (number, wall) in layer.walls.iter().enumerate() {
        let place = format!("loop {number} of layer {}", layer.index);
        for p in &wall.points {
            let steps = *p / settings.grid;
            assert!((steps - steps.round()).abs().max_element() < 1e-3, "{place}: {p} is off the grid");
        }
        let curve = ClosedCurve::new(wall.points.clone()).expect("a wall is a curve");
        assert!(wall.points.len() > 2, "{place} encloses nothing");
        assert_eq!(curve.signed_area() < 0.0, wall.hole, "{place} runs the wrong way round");
        assert!(self_crossings(&wall.points).is_empty(), "{place} crosses itself");
        let around = wall.parent.map(|parent| layer.walls[parent].depth + 1);
        assert_eq!(wall.depth, around.unwrap_or(0), "{place} is not as deep as its parent has it");
        if let Some(parent) = wall.parent {
            let parent = ClosedCurve::new(layer.walls[parent].points.clone()).expect("a wall is a curve");
            assert!(parent.contains(wall.points[0]), "{place} is outside of its parent");
        }
    }
    assert!(layer.losses.iter().all(|loss| loss.layer() == layer.index && loss.at().is_finite()));
}

#[derive(Default)]
struct Soup {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// Triangles that belong to nothing.
    fn loose(&mut self, draw: &mut Draw<'_>) {
        for _ in 0..MOST_TRIANGLES {
            if draw.is_empty() {
                return;
            }
            let first = self.vertices.len() as u32;
            for _ in 0..3 {
                let p = draw.point(15.0);
                self.vertices.push([p.x, p.y, draw.within(0.0, 12.0)]);
            }
            self.triangles.push([first, first + 1, first + 2]);
        }
    }

    /// A prism or a pyramid over a star-shaped base, turned inside out at times; bodies overlap as they like.
    fn body(&mut self, draw: &mut Draw<'_>) {
        let corners = 3 + draw.below(8) as u32;
        let centre = draw.point(12.0);
        let low = draw.within(0.0, 4.0);
        let high = low + draw.within(0.1, 10.0);
        let taper = [1.0, 1.0, 0.5, 0.0][draw.below(4)];
        let inside_out = draw.byte() > 223;
        let first = self.vertices.len() as u32;
        let radii: Vec<f64> = (0..corners).map(|_| draw.within(0.2, 10.0)).collect();
        for (z, factor) in [(low, 1.0), (high, taper)] {
            for (k, radius) in radii.iter().enumerate() {
                let angle = std::f64::consts::TAU * k as f64 / f64::from(corners);
                let p = centre + radius * factor * argil_curve::DVec2::from_angle(angle);
                self.vertices.push([p.x, p.y, z]);
            }
        }
        let middles = first + 2 * corners;
        self.vertices.extend([[centre.x, centre.y, low], [centre.x, centre.y, high]]);
        for k in 0..corners {
            let (a, b) = (first + k, first + (k + 1) % corners);
            let (c, d) = (a + corners, b + corners);
            let mut sides = vec![[a, b, c], [b, d, c], [middles, b, a], [middles + 1, c, d]];
            if taper == 0.0 {
                // The top is one point; the mesh must not have to weld it.
                sides = vec![[a, b, middles + 1], [middles, b, a]];
            }
            if inside_out {
                sides.iter_mut().for_each(|side| side.swap(0, 1));
            }
            self.triangles.extend(sides);
        }
    }
}
