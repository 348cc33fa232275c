//! The knobs of the route stage.

use argil_tour::TourOptions;

use crate::RouteError;

/// How a layer is routed. Lengths are in mm unless they say *in w*, the bead width.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RouteSettings {
    /// Bead width w, mm. Everything else scales with it.
    pub width: f64,
    /// `ε_across`, mm: an edge this near to the path above counts as coherent with it.
    pub across: f64,
    /// `α_D` of section 3.3: factor on the weight of coherent edges. Lower keeps the routing of the layer
    /// above longer, at the price of length.
    pub coherence: f64,
    /// How much dearer a path is that runs within one bead of a wall: the weight is multiplied by
    /// 1 + `wall_penalty` · (1 − d/w). Not in the paper; it keeps strands off the visible face.
    pub wall_penalty: f64,
    /// What a root costs, in w of strand: two legs whose first half bead lies in the wall's own bead, the
    /// scar that they leave, and the U-turn at the far end. Fewer and longer excursions with a higher value.
    pub root_cost: f64,
    /// What the square of an excursion's length costs beside the length, in 1/w: a long one has one tip to die from as a short one
    /// has, and lives as many layers longer. Excursions are shorter and more with a higher value.
    pub length_cost: f64,
    /// How many times its length the detour of a tour through all walls counts that it makes for demands: it has no tip to
    /// die from, so that it lives on through the layers below. With 1 a cup kept rings of half its own length between its walls,
    /// with 2 a sixth of it in excursions that soon die; with 3 no ring stays round the wing
    /// of a gargoyle.
    pub ring_cost: f64,
    /// Least distance along a wall between two attachments, in w, in particular between one inside and
    /// one outside: closer ones would drive the strand straight through the wall.
    pub attachment_gap: f64,
    /// Radius, in mm, within which a demand may move about each of its anchors.
    pub slack: f64,
    /// How often the demands are moved towards the tours and the tours planned again.
    pub relaxations: usize,
    /// Demands keep at least this distance from walls, in w, when they move.
    pub wall_keep: f64,
    /// Share of its length that a hop between two near demands counts when walls are joined: it has to
    /// be printed anyway.
    pub reuse: f64,
    /// Longest such hop, in w.
    pub reuse_reach: f64,
    /// Distance of a lane from the doubled edge it came from, in w; halved where lanes would cross.
    pub lane: f64,
    /// Spacing of Steiner points along walls and safeguards, in w.
    pub steiner_step: f64,
    /// Longest stretch of free strand without a vertex, in w.
    pub spacing: f64,
    /// All coordinates are rounded to this grid, mm: that of the output.
    pub grid: f64,
    /// How tours are searched.
    pub tour: TourOptions,
}

impl RouteSettings {
    /// The settings that serve clay at bead width `width`; see the fields for their reasons.
    #[must_use]
    pub fn for_width(width: f64) -> Self {
        Self {
            width,
            across: 0.3 * width,
            coherence: 0.9,
            wall_penalty: 2.0,
            root_cost: 2.5,
            length_cost: 0.015,
            ring_cost: 3.0,
            attachment_gap: 5.0 / 3.0,
            slack: 0.9 * 0.65 * 0.3 * width,
            relaxations: 1,
            wall_keep: 0.8 / 1.5,
            reuse: 0.3,
            reuse_reach: 2.2,
            lane: 0.2 / 1.5,
            steiner_step: 1.0,
            spacing: 0.5,
            grid: 1e-4,
            tour: TourOptions::default(),
        }
    }

    /// Refuses values that no plan can be made with.
    pub(crate) fn check(&self) -> Result<(), RouteError> {
        let positive = [
            ("width", self.width),
            ("across", self.across),
            ("coherence", self.coherence),
            ("attachment_gap", self.attachment_gap),
            ("steiner_step", self.steiner_step),
            ("spacing", self.spacing),
            ("grid", self.grid),
        ];
        for (name, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(RouteError::Setting { name, value, expected: "positive and finite" });
            }
        }
        let at_least_zero = [
            ("wall_penalty", self.wall_penalty),
            ("root_cost", self.root_cost),
            ("length_cost", self.length_cost),
            ("ring_cost", self.ring_cost),
            ("slack", self.slack),
            ("wall_keep", self.wall_keep),
            ("reuse", self.reuse),
            ("reuse_reach", self.reuse_reach),
            ("lane", self.lane),
        ];
        for (name, value) in at_least_zero {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(RouteError::Setting { name, value, expected: "at least zero and finite" });
            }
        }
        Ok(())
    }
}

impl Default for RouteSettings {
    /// Clay at a bead width of 1.5 mm, as in the paper.
    fn default() -> Self {
        Self::for_width(1.5)
    }
}
