//! Closed curves of beads, with what each stretch is for.

use argil_curve::{DVec2, Segment};

/// What a stretch of a fill is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Bead {
    /// Part of this wall, counted from the outline.
    Wall(usize),
    /// Part of a ring inside of the walls.
    Fill,
    /// The leg of a joint, or a detour into a place that would stay bare.
    Joint,
}

impl Bead {
    pub(crate) fn of_ring(wall: Option<usize>) -> Self {
        wall.map_or(Self::Fill, Self::Wall)
    }
}

/// A closed curve of beads that does not cross itself.
///
/// # Example
/// ```
/// use argil_fill::{Bead, FillCurve, FillOptions, Joint, fill};
/// use geo_types::Rect;
/// let tile = Rect::new((0.0, 0.0), (12.0, 9.0)).to_polygon().into();
/// let filled = fill(&tile, &[], &FillOptions::for_width(1.5), &[])?;
/// let curve: &FillCurve = &filled.curves[0];
/// assert!((curve.length() - filled.figures.length).abs() < 1e-9);
/// assert!(curve.beads.contains(&Bead::Joint));
/// // Each of the joints lies in the tile.
/// let inside = |joint: &Joint| (0.0..12.0).contains(&joint.middle().x) && (0.0..9.0).contains(&joint.middle().y);
/// assert!(filled.joints.iter().all(inside));
/// # Ok::<(), argil_fill::FillError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FillCurve {
    /// The vertices in mm, without repeating the first at the end.
    pub points: Vec<DVec2>,
    /// What the stretch from vertex k to vertex k + 1 is; the last one leads back to vertex 0.
    pub beads: Vec<Bead>,
    /// How wide the bead of each stretch is, as a share of the width: 1, or where [`FillOptions::flow`](crate::FillOptions::flow) allows it
    /// and the stretch is no wall, what it has room for.
    pub flow: Vec<f64>,
}

impl FillCurve {
    /// Length of all stretches, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        crate::ring::perimeter(&self.points)
    }

    /// The stretches, each with what it is for.
    pub(crate) fn stretches(&self) -> impl Iterator<Item = (Segment, Bead)> + '_ {
        let n = self.points.len();
        (0..n).map(move |k| (Segment::new(self.points[k], self.points[(k + 1) % n]), self.beads[k]))
    }

    /// Adds a vertex and what begins there; one in the same place as the last replaces what begins there.
    pub(crate) fn push(&mut self, point: DVec2, bead: Bead) {
        match (self.points.last(), self.beads.last_mut()) {
            (Some(&last), Some(kind)) if last == point => *kind = bead,
            _ => {
                self.points.push(point);
                self.beads.push(bead);
            }
        }
    }

    /// Drops the last vertices where they repeat the first.
    pub(crate) fn close(&mut self) {
        while self.points.len() > 1 && self.points.first() == self.points.last() {
            self.points.pop();
            self.beads.pop();
        }
    }
}
