//! The strand, its layers and moves.

use glam::{DVec2, DVec3};

use crate::{BeadShape, LayerSummary, Role, RoleLengths};

/// How far the last point of a layer may lie from its first one and still close the cycle, mm. Planners copy the
/// point, so any real distance is a gap; the allowance is for a coordinate that went through decimal text.
const CLOSED_WITHIN: f64 = 1e-9;

/// One straight stretch of bead, from wherever the strand has got to, to `to`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Move {
    /// Where the stretch ends, mm.
    pub to: DVec2,
    /// What it is laid for.
    pub role: Role,
}

/// A place where the layer's path supports the layer above.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SupportSource {
    /// The support point on this layer, mm.
    pub at: DVec2,
    /// The points of the path above that it holds, mm.
    pub needs: Vec<DVec2>,
}

/// One layer of the strand: a closed cycle at one height.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StrandLayer {
    /// The layer's number in the slicing of the part. It rises from layer to layer and may skip numbers.
    pub index: usize,
    /// Height of the top of the bead above the bed, mm: where the nozzle's mouth is.
    pub z: f64,
    /// Height of the bead, mm.
    pub height: f64,
    /// Width of the bead, mm.
    pub width: f64,
    /// The stretches in the order of laying. The lowest layer starts at [`Strand::start`]; every other one begins
    /// with a [`Role::Seam`] step that rises from the end of the layer below.
    pub moves: Vec<Move>,
    /// Where this layer supports the one above, for reports and pictures.
    #[cfg_attr(feature = "serde", serde(default))]
    pub supports: Vec<SupportSource>,
}

/// Why layers do not make a strand.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StrandError {
    /// There is no layer, so nothing is laid.
    #[error("a strand needs at least one layer")]
    NoLayers,
    /// A number is infinite or not a number.
    #[error("layer {layer}: {what} is not finite")]
    NotFinite {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Which number it is.
        what: &'static str,
    },
    /// A bead without a positive height and width.
    #[error("layer {layer}: a bead of {width} mm by {height} mm cannot be laid")]
    NoBead {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Width of the bead, mm.
        width: f64,
        /// Height of the bead, mm.
        height: f64,
    },
    /// A layer lies no higher than the one below.
    #[error("layer {layer}: z = {z} mm is not above the layer below at {below} mm")]
    NotRising {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Its z, mm.
        z: f64,
        /// The z of the layer below, mm.
        below: f64,
    },
    /// A layer's number is not higher than that of the one below.
    #[error("layer {layer}: number {index} is not above {below}, the number of the layer below")]
    NumberNotRising {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Its number.
        index: usize,
        /// The number of the layer below.
        below: usize,
    },
    /// A layer above the lowest does not begin with a seam step.
    #[error("layer {layer}: the first move is not the seam step from the layer below")]
    NoSeamStep {
        /// Position of the layer, counted from the lowest.
        layer: usize,
    },
    /// A layer has no move besides its seam step.
    #[error("layer {layer}: nothing is laid on it")]
    NoMoves {
        /// Position of the layer, counted from the lowest.
        layer: usize,
    },
    /// A layer does not end where it began.
    #[error("layer {layer}: the cycle is open by {gap} mm")]
    Open {
        /// Position of the layer, counted from the lowest.
        layer: usize,
        /// Distance from its last point to its first, mm.
        gap: f64,
    },
}

/// One stretch of the strand in space, as a machine moves.
///
/// # Example
/// ```
/// use argil_strand::{DVec3, Role, Step};
/// let step = Step { layer: 1, from: DVec3::new(0.0, 0.0, 0.5), to: DVec3::new(0.0, 0.0, 1.0), role: Role::Seam };
/// assert_eq!(step.length(), 0.5); // straight up
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Step {
    /// Position of the layer it belongs to, counted from the lowest.
    pub layer: usize,
    /// Where it begins, mm.
    pub from: DVec3,
    /// Where it ends, mm.
    pub to: DVec3,
    /// What it is laid for.
    pub role: Role,
}

impl Step {
    /// Length in space, mm; a seam step's rise counts.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.from.distance(self.to)
    }
}

/// One unbroken polyline of beads from the bed to the top: the plan of a whole print.
///
/// The crate's introduction says how the layers hang together and why no second polyline can be expressed.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked"))]
pub struct Strand {
    start: DVec2,
    layers: Vec<StrandLayer>,
}

impl Strand {
    /// Joins layers, lowest first, to a strand that begins at `start` on the lowest one.
    ///
    /// # Errors
    /// Any departure from the strand's shape, with the position of the layer where it is seen first: see
    /// [`StrandError`].
    ///
    /// # Complexity
    /// O(n) in the number of moves; nothing is copied.
    ///
    /// # Example
    /// ```
    /// use argil_strand::{DVec2, Move, Role, Strand, StrandError, StrandLayer};
    /// let open = StrandLayer {
    ///     index: 0, z: 0.5, height: 0.5, width: 1.5, supports: vec![],
    ///     moves: vec![Move { to: DVec2::new(10.0, 0.0), role: Role::Wall }],
    /// };
    /// assert_eq!(Strand::new(DVec2::ZERO, vec![open]), Err(StrandError::Open { layer: 0, gap: 10.0 }));
    /// ```
    pub fn new(start: DVec2, layers: Vec<StrandLayer>) -> Result<Self, StrandError> {
        if layers.is_empty() {
            return Err(StrandError::NoLayers);
        }
        if !start.is_finite() {
            return Err(StrandError::NotFinite { layer: 0, what: "the start" });
        }
        for (k, layer) in layers.iter().enumerate() {
            check_numbers(k, layer)?;
            if let Some(below) = k.checked_sub(1).map(|b| &layers[b]) {
                if layer.z <= below.z {
                    return Err(StrandError::NotRising { layer: k, z: layer.z, below: below.z });
                }
                if layer.index <= below.index {
                    return Err(StrandError::NumberNotRising {
                        layer: k,
                        index: layer.index,
                        below: below.index,
                    });
                }
            }
            check_cycle(k, start, layer)?;
        }
        Ok(Self { start, layers })
    }

    /// Where the strand begins, mm: the first point of the lowest layer.
    #[must_use]
    pub fn start(&self) -> DVec2 {
        self.start
    }

    /// Where the strand ends, mm: the last point of the uppermost layer.
    #[must_use]
    pub fn end(&self) -> DVec2 {
        self.layers.last().and_then(|layer| layer.moves.last()).map_or(self.start, |last| last.to)
    }

    /// The layers, lowest first.
    #[must_use]
    pub fn layers(&self) -> &[StrandLayer] {
        &self.layers
    }

    /// The layers, without copying them.
    #[must_use]
    pub fn into_layers(self) -> Vec<StrandLayer> {
        self.layers
    }

    /// Where the cycle of a layer begins and ends, mm: its seam. `None` above the uppermost layer.
    #[must_use]
    pub fn seam(&self, layer: usize) -> Option<DVec2> {
        let moves = &self.layers.get(layer)?.moves;
        if layer == 0 { Some(self.start) } else { moves.first().map(|step| step.to) }
    }

    /// The moves of a layer's cycle, without the seam step that leads to it. Empty above the uppermost layer.
    #[must_use]
    pub fn cycle(&self, layer: usize) -> &[Move] {
        let moves = self.layers.get(layer).map_or(&[][..], |layer| &layer.moves);
        if layer == 0 { moves } else { moves.get(1..).unwrap_or(&[]) }
    }

    /// The layer's cycle as points, mm, its start point included, so that the last equals the first. Empty above
    /// the uppermost layer.
    ///
    /// # Complexity
    /// O(n) in the number of the layer's moves.
    #[must_use]
    pub fn polyline(&self, layer: usize) -> Vec<DVec2> {
        self.seam(layer).into_iter().chain(self.cycle(layer).iter().map(|step| step.to)).collect()
    }

    /// Every stretch of the strand in the order of laying, in space. Each begins where the one before ended.
    ///
    /// # Example
    /// ```
    /// # use argil_strand::{DVec2, Move, Role, Strand, StrandLayer};
    /// # let there = Move { to: DVec2::new(4.0, 0.0), role: Role::Wall };
    /// # let back = Move { to: DVec2::ZERO, role: Role::Wall };
    /// # let seam = Move { to: DVec2::ZERO, role: Role::Seam };
    /// # let layer = |index, z, moves| StrandLayer { index, z, height: 0.5, width: 1.5, moves, supports: vec![] };
    /// # let layers = vec![layer(0, 0.5, vec![there, back]), layer(1, 1.0, vec![seam, there, back])];
    /// # let strand = Strand::new(DVec2::ZERO, layers)?;
    /// let steps: Vec<_> = strand.steps().collect();
    /// assert!(steps.windows(2).all(|pair| pair[0].to == pair[1].from));
    /// # Ok::<(), argil_strand::StrandError>(())
    /// ```
    pub fn steps(&self) -> impl Iterator<Item = Step> + '_ {
        let bed = self.layers.first().map_or(0.0, |layer| layer.z);
        let mut at = self.start.extend(bed);
        self.layers
            .iter()
            .enumerate()
            .flat_map(|(k, layer)| layer.moves.iter().map(move |to| (k, layer.z, to)))
            .map(move |(layer, z, step)| {
                let from = at;
                at = step.to.extend(z);
                Step { layer, from, to: at, role: step.role }
            })
    }

    /// Length of the whole strand, mm, in space: the rise of seam steps counts.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.lengths().total()
    }

    /// Length laid in one role, mm.
    #[must_use]
    pub fn length_of(&self, role: Role) -> f64 {
        self.lengths().of(role)
    }

    /// Length laid in each role, mm.
    #[must_use]
    pub fn lengths(&self) -> RoleLengths {
        let mut lengths = RoleLengths::default();
        self.steps().for_each(|step| lengths.add(step.role, step.length()));
        lengths
    }

    /// Paste in the strand, mm³, with rounded beads.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.volume_as(BeadShape::Rounded)
    }

    /// Paste in the strand, mm³, with beads of the given shape.
    #[must_use]
    pub fn volume_as(&self, shape: BeadShape) -> f64 {
        let area: Vec<f64> = self.layers.iter().map(|layer| shape.area(layer.width, layer.height)).collect();
        self.steps().map(|step| step.length() * area[step.layer]).sum()
    }

    /// What each layer holds, lowest first.
    ///
    /// # Complexity
    /// O(n) in the number of moves, for all layers together.
    #[must_use]
    pub fn summaries(&self) -> Vec<LayerSummary> {
        let mut summaries: Vec<LayerSummary> = self
            .layers
            .iter()
            .map(|layer| LayerSummary {
                index: layer.index,
                z: layer.z,
                moves: layer.moves.len(),
                supports: layer.supports.len(),
                lengths: RoleLengths::default(),
                volume: 0.0,
            })
            .collect();
        self.steps().for_each(|step| summaries[step.layer].lengths.add(step.role, step.length()));
        for (summary, layer) in summaries.iter_mut().zip(&self.layers) {
            summary.volume = summary.lengths.total() * BeadShape::Rounded.area(layer.width, layer.height);
        }
        summaries
    }
}

/// Finite numbers and a bead that exists.
fn check_numbers(k: usize, layer: &StrandLayer) -> Result<(), StrandError> {
    let not_finite = |what| Err(StrandError::NotFinite { layer: k, what });
    if !layer.z.is_finite() {
        return not_finite("z");
    }
    if !(layer.width.is_finite() && layer.height.is_finite()) {
        return not_finite("the bead's size");
    }
    if layer.width <= 0.0 || layer.height <= 0.0 {
        return Err(StrandError::NoBead { layer: k, width: layer.width, height: layer.height });
    }
    if !layer.moves.iter().all(|step| step.to.is_finite()) {
        return not_finite("a move");
    }
    if !layer
        .supports
        .iter()
        .all(|source| source.at.is_finite() && source.needs.iter().all(|p| p.is_finite()))
    {
        return not_finite("a support point");
    }
    Ok(())
}

/// A seam step where one belongs, and a cycle that ends where it began.
fn check_cycle(k: usize, start: DVec2, layer: &StrandLayer) -> Result<(), StrandError> {
    let (seam, cycle) = match layer.moves.split_first() {
        None => return Err(StrandError::NoMoves { layer: k }),
        Some(_) if k == 0 => (start, &layer.moves[..]),
        Some((step, cycle)) if step.role == Role::Seam => (step.to, cycle),
        Some(_) => return Err(StrandError::NoSeamStep { layer: k }),
    };
    let end = cycle.last().ok_or(StrandError::NoMoves { layer: k })?.to;
    let gap = end.distance(seam);
    if gap <= CLOSED_WITHIN { Ok(()) } else { Err(StrandError::Open { layer: k, gap }) }
}

/// What a file may hold before the strand's shape is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Unchecked {
    start: DVec2,
    layers: Vec<StrandLayer>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for Strand {
    type Error = StrandError;

    fn try_from(unchecked: Unchecked) -> Result<Self, StrandError> {
        Strand::new(unchecked.start, unchecked.layers)
    }
}
