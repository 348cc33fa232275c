//! The strand, its layers and moves.

use glam::{DVec2, DVec3};

use crate::{BeadShape, LayerSummary, Rise, Role, RoleLengths, StrandError};

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

/// One layer of the strand: a closed cycle, at one height unless the strand [rises](Strand::risen) along it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StrandLayer {
    /// The layer's number in the slicing of the part. It rises from layer to layer and may skip numbers.
    pub index: usize,
    /// Height of the top of the bead above the bed, mm: where the nozzle's mouth is. Of a layer that rises, where it would be if
    /// it lay level.
    pub z: f64,
    /// Height of the bead, mm; of a layer that rises, what it would be if it lay level.
    pub height: f64,
    /// Width of the bead, mm, but for moves to which [another](Strand::of_widths) is given.
    pub width: f64,
    /// The stretches in the order of laying. The lowest layer starts at [`Strand::start`], perhaps with a [`Role::Skirt`] that leads
    /// to its cycle; every other one begins with a [`Role::Seam`] step that rises from the end of the layer below.
    pub moves: Vec<Move>,
    /// Where this layer supports the one above, for reports and pictures.
    #[cfg_attr(feature = "serde", serde(default))]
    pub supports: Vec<SupportSource>,
}

/// One stretch of the strand in space, as a machine moves.
///
/// # Example
/// ```
/// use argil_strand::{DVec3, Role, Step};
/// let [from, to] = [0.5, 1.0].map(|z| DVec3::new(0.0, 0.0, z));
/// let step = Step { layer: 1, from, to, role: Role::Seam, width: 1.5, height: 0.5 };
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
    /// Width of the bead, mm.
    pub width: f64,
    /// Height of the bead, mm.
    pub height: f64,
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
    /// For each layer one for each of its moves, or none if it lies level; empty where all do.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    rises: Vec<Vec<Rise>>,
    /// For each layer one for each of its moves, mm, or none if all are as wide as the layer says; empty where all layers are so.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    widths: Vec<Vec<f64>>,
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
        Ok(Self { start, layers, rises: Vec::new(), widths: Vec::new() })
    }

    /// The same strand with some of its layers rising along their cycles, as in a spiral: for each layer the z and the bead's height of
    /// each of its moves, or nothing where the layer lies level. What rises before is forgotten.
    ///
    /// # Errors
    /// [`StrandError::RiseCount`] where there are too few or too many, or any for the lowest layer; [`StrandError::NotFinite`];
    /// [`StrandError::NoBead`] for a height below 0; [`StrandError::Falling`] where the strand would go down, also from a layer to the
    /// next.
    ///
    /// # Complexity
    /// O(n) in the number of moves.
    ///
    /// # Example
    /// ```
    /// # use argil_strand::{DVec2, Move, Rise, Role, Strand, StrandLayer};
    /// # let there = Move { to: DVec2::new(4.0, 0.0), role: Role::Wall };
    /// # let back = Move { to: DVec2::ZERO, role: Role::Wall };
    /// # let seam = Move { to: DVec2::ZERO, role: Role::Seam };
    /// # let layer = |index, z, moves| StrandLayer { index, z, height: 0.5, width: 1.5, moves, supports: vec![] };
    /// # let layers = vec![layer(0, 0.5, vec![there, back]), layer(1, 1.0, vec![seam, there, back])];
    /// let level = Strand::new(DVec2::ZERO, layers)?;
    /// let climb = [(0.5, 0.0), (0.75, 0.125), (1.0, 0.375)].map(|(z, height)| Rise { z, height });
    /// let spiral = level.clone().risen(vec![vec![], climb.to_vec()])?;
    /// assert!(spiral.steps().all(|step| step.to.z >= step.from.z));
    /// assert!(spiral.volume() < level.volume());
    /// assert_eq!((spiral.rises(0).len(), spiral.rises(1).len()), (0, 3));
    /// # Ok::<(), argil_strand::StrandError>(())
    /// ```
    pub fn risen(self, rises: Vec<Vec<Rise>>) -> Result<Self, StrandError> {
        check_rises(&self.layers, &rises)?;
        let rises = if rises.iter().all(Vec::is_empty) { Vec::new() } else { rises };
        Ok(Self { rises, ..self })
    }

    /// How a layer rises: one for each of its moves. Empty for a layer that lies level, and above the uppermost.
    #[must_use]
    pub fn rises(&self, layer: usize) -> &[Rise] {
        self.rises.get(layer).map_or(&[], Vec::as_slice)
    }

    /// The same strand with beads of other widths than their layer's: for each layer the width in mm of each of its moves, or nothing
    /// where all are as wide as the layer says. What was given before is forgotten.
    ///
    /// # Errors
    /// [`StrandError::WidthCount`] where there are too few or too many; [`StrandError::NoBead`] for one that is not positive;
    /// [`StrandError::NotFinite`].
    ///
    /// # Complexity
    /// O(n) in the number of moves.
    ///
    /// # Example
    /// ```
    /// # use argil_strand::{DVec2, Move, Role, Strand, StrandLayer};
    /// # let there = Move { to: DVec2::new(4.0, 0.0), role: Role::Fill };
    /// # let back = Move { to: DVec2::ZERO, role: Role::Fill };
    /// # let floor = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves: vec![there, back], supports: vec![] };
    /// let whole = Strand::new(DVec2::ZERO, vec![floor])?;
    /// let slender = whole.clone().of_widths(vec![vec![1.5, 1.2]])?;
    /// assert_eq!(slender.steps().map(|step| step.width).collect::<Vec<_>>(), [1.5, 1.2]);
    /// assert!(slender.volume() < whole.volume());
    /// assert!(slender.widths(0) == [1.5, 1.2] && whole.widths(0).is_empty());
    /// # Ok::<(), argil_strand::StrandError>(())
    /// ```
    pub fn of_widths(self, widths: Vec<Vec<f64>>) -> Result<Self, StrandError> {
        check_widths(&self.layers, &widths)?;
        let widths = if widths.iter().all(Vec::is_empty) { Vec::new() } else { widths };
        Ok(Self { widths, ..self })
    }

    /// The widths of a layer's beads, mm: one for each of its moves. Empty where all are as wide as the layer says, and above the uppermost.
    #[must_use]
    pub fn widths(&self, layer: usize) -> &[f64] {
        self.widths.get(layer).map_or(&[], Vec::as_slice)
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
        lead(layer, moves).checked_sub(1).map_or(Some(self.start), |last| moves.get(last).map(|step| step.to))
    }

    /// The moves of a layer's cycle, without the skirt or the seam step that leads to it. Empty above the uppermost layer.
    #[must_use]
    pub fn cycle(&self, layer: usize) -> &[Move] {
        let moves = self.layers.get(layer).map_or(&[][..], |layer| &layer.moves);
        moves.get(lead(layer, moves)..).unwrap_or(&[])
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
            .flat_map(|(k, layer)| {
                let level = Rise { z: layer.z, height: layer.height };
                let rises = self.rises(k);
                let lies = move |n: usize| rises.get(n).copied().unwrap_or(level);
                let widths = self.widths(k);
                let wide = move |n: usize| widths.get(n).copied().unwrap_or(layer.width);
                layer.moves.iter().enumerate().map(move |(n, to)| (k, lies(n), wide(n), to))
            })
            .map(move |(layer, Rise { z, height }, width, step)| {
                let from = at;
                at = step.to.extend(z);
                Step { layer, from, to: at, role: step.role, width, height }
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
        self.steps().map(|step| step.length() * shape.area(step.width, step.height)).sum()
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
        for step in self.steps() {
            let summary = &mut summaries[step.layer];
            summary.lengths.add(step.role, step.length());
            summary.volume += step.length() * BeadShape::Rounded.area(step.width, step.height);
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

/// How many moves of a layer lead to its cycle: the skirt of the lowest, the seam step of any other.
fn lead(layer: usize, moves: &[Move]) -> usize {
    if layer == 0 { moves.iter().take_while(|step| step.role == Role::Skirt).count() } else { 1 }
}

/// A seam step where one belongs, skirt nowhere else than it may, and a cycle that ends where it began.
fn check_cycle(k: usize, start: DVec2, layer: &StrandLayer) -> Result<(), StrandError> {
    let (to_seam, cycle) = layer.moves.split_at(lead(k, &layer.moves).min(layer.moves.len()));
    let seam = match to_seam.last() {
        None if k > 0 => return Err(StrandError::NoMoves { layer: k }),
        None => start,
        Some(step) if k == 0 || step.role == Role::Seam => step.to,
        Some(_) => return Err(StrandError::NoSeamStep { layer: k }),
    };
    if cycle.iter().any(|step| step.role == Role::Skirt) {
        return Err(StrandError::Skirt { layer: k });
    }
    let end = cycle.last().ok_or(StrandError::NoMoves { layer: k })?.to;
    let gap = end.distance(seam);
    if gap <= CLOSED_WITHIN { Ok(()) } else { Err(StrandError::Open { layer: k, gap }) }
}

/// A rise for each move of a layer that rises, and none that goes down.
fn check_rises(layers: &[StrandLayer], rises: &[Vec<Rise>]) -> Result<(), StrandError> {
    if !rises.is_empty() && rises.len() != layers.len() {
        let layer = rises.len().min(layers.len());
        return Err(StrandError::RiseCount { layer, given: rises.len(), wanted: layers.len() });
    }
    let mut at = f64::NEG_INFINITY;
    for (k, (layer, rises)) in layers.iter().zip(rises).enumerate() {
        let wanted = if k == 0 { 0 } else { layer.moves.len() };
        if !rises.is_empty() && rises.len() != wanted {
            return Err(StrandError::RiseCount { layer: k, given: rises.len(), wanted });
        }
        let level = Rise { z: layer.z, height: layer.height };
        for &Rise { z, height } in if rises.is_empty() { std::slice::from_ref(&level) } else { rises } {
            if !(z.is_finite() && height.is_finite()) {
                return Err(StrandError::NotFinite { layer: k, what: "a rise" });
            }
            if height < 0.0 {
                return Err(StrandError::NoBead { layer: k, width: layer.width, height });
            }
            if z < at {
                return Err(StrandError::Falling { layer: k, from: at, to: z });
            }
            at = z;
        }
    }
    Ok(())
}

/// A width for each move of a layer that has any, all of them positive.
fn check_widths(layers: &[StrandLayer], widths: &[Vec<f64>]) -> Result<(), StrandError> {
    if !widths.is_empty() && widths.len() != layers.len() {
        let layer = widths.len().min(layers.len());
        return Err(StrandError::WidthCount { layer, given: widths.len(), wanted: layers.len() });
    }
    for (k, (layer, widths)) in layers.iter().zip(widths).enumerate() {
        let wanted = layer.moves.len();
        if !widths.is_empty() && widths.len() != wanted {
            return Err(StrandError::WidthCount { layer: k, given: widths.len(), wanted });
        }
        if !widths.iter().all(|width| width.is_finite()) {
            return Err(StrandError::NotFinite { layer: k, what: "the width of a bead" });
        }
        if let Some(&width) = widths.iter().find(|&&width| width <= 0.0) {
            return Err(StrandError::NoBead { layer: k, width, height: layer.height });
        }
    }
    Ok(())
}

/// What a file may hold before the strand's shape is checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Unchecked {
    start: DVec2,
    layers: Vec<StrandLayer>,
    #[serde(default)]
    rises: Vec<Vec<Rise>>,
    #[serde(default)]
    widths: Vec<Vec<f64>>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for Strand {
    type Error = StrandError;

    fn try_from(unchecked: Unchecked) -> Result<Self, StrandError> {
        Strand::new(unchecked.start, unchecked.layers)?.risen(unchecked.rises)?.of_widths(unchecked.widths)
    }
}
