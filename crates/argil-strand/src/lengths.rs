//! Lengths and volumes by role.

use crate::Role;

/// Length in mm laid in each role.
///
/// # Example
/// ```
/// use argil_strand::{Role, RoleLengths};
/// let mut lengths = RoleLengths::default();
/// lengths.add(Role::Wall, 12.0);
/// lengths.add(Role::Support, 3.0);
/// assert_eq!((lengths.model(), lengths.non_model(), lengths.total()), (12.0, 3.0, 15.0));
/// assert_eq!(lengths.of(Role::Seam), 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RoleLengths {
    by_role: [f64; Role::ALL.len()],
}

impl RoleLengths {
    /// Length in mm laid in one role.
    #[must_use]
    pub fn of(&self, role: Role) -> f64 {
        self.by_role[role.position()]
    }

    /// Length in mm over all roles.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.by_role.iter().sum()
    }

    /// Length in mm of what stays in the part.
    #[must_use]
    pub fn model(&self) -> f64 {
        Role::ALL.into_iter().filter(|role| role.is_model()).map(|role| self.of(role)).sum()
    }

    /// Length in mm of what is cut away after printing.
    #[must_use]
    pub fn non_model(&self) -> f64 {
        Role::ALL.into_iter().filter(|role| !role.is_model()).map(|role| self.of(role)).sum()
    }

    /// Adds a length in mm to a role.
    pub fn add(&mut self, role: Role, length: f64) {
        self.by_role[role.position()] += length;
    }
}

/// What one layer holds, for tables and reports.
///
/// # Example
/// ```
/// use argil_strand::{BeadShape, DVec2, LayerSummary, Move, Role, Strand, StrandLayer, SupportSource};
/// let square = [(9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (0.0, 0.0)].map(|at| Move { to: at.into(), role: Role::Wall });
/// let held = SupportSource { at: DVec2::new(4.0, 0.0), needs: vec![DVec2::new(4.0, -0.3)] };
/// let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves: square.to_vec(), supports: vec![held] };
/// let strand = Strand::new(DVec2::ZERO, vec![layer.clone()])?;
/// let lowest: LayerSummary = strand.summaries()[0];
/// assert_eq!((lowest.moves, lowest.supports, lowest.lengths.of(Role::Wall)), (4, 1, 36.0));
/// assert_eq!(strand.volume_as(BeadShape::Box), 36.0 * 1.5 * 0.5);
/// assert_eq!(strand.into_layers(), [layer]);
/// # Ok::<(), argil_strand::StrandError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct LayerSummary {
    /// The layer's own number, as in [`StrandLayer::index`](crate::StrandLayer::index).
    pub index: usize,
    /// Height of the top of the bead above the bed, mm.
    pub z: f64,
    /// Moves of the layer, the seam step included.
    pub moves: usize,
    /// Support points that the layer's path passes for the layer above.
    pub supports: usize,
    /// Length by role, mm; the seam step is counted with the layer that it leads to.
    pub lengths: RoleLengths,
    /// Paste of the layer, mm³, with rounded beads.
    pub volume: f64,
}
