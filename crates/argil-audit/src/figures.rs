//! The figures of a print.

/// A figure's value.
///
/// # Example
/// ```
/// use argil_audit::Amount;
/// assert_eq!((Amount::Count(3).value(), Amount::Measure(0.5).value()), (3.0, 0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// How many.
    Count(usize),
    /// How much, in the unit that the figure's name or documentation tells.
    Measure(f64),
}

impl Amount {
    /// The value as a number.
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::Count(count) => count as f64,
            Self::Measure(measure) => measure,
        }
    }
}

macro_rules! figures {
    ($($(#[$docs:meta])* $name:ident: $amount:ident($type:ty),)*) => {
        /// What the audit measures. Lengths in mm; "wall length" is the length of wall path that the model
        /// asks for.
        #[derive(Clone, Debug, Default, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
        #[non_exhaustive]
        pub struct Figures {
            $($(#[$docs])* pub $name: $type,)*
            /// Material a millimetre, in the file's unit of E: the median over moves. `None` if no move is
            /// long enough to tell.
            pub flow_per_mm_median: Option<f64>,
            /// The same, first and ninety-ninth percentile.
            pub flow_per_mm_p01_p99: Option<[f64; 2]>,
        }

        impl Figures {
            /// Every figure under its name, the flow last.
            #[must_use]
            pub fn entries(&self) -> Vec<(&'static str, Amount)> {
                let mut entries = vec![$((stringify!($name), Amount::$amount(self.$name)),)*];
                let [low, high] = self.flow_per_mm_p01_p99.map_or([None; 2], |flow| flow.map(Some));
                let flow = [
                    ("flow_per_mm_median", self.flow_per_mm_median),
                    ("flow_per_mm_p01", low),
                    ("flow_per_mm_p99", high),
                ];
                entries.extend(flow.into_iter().filter_map(|(name, v)| Some((name, Amount::Measure(v?)))));
                entries
            }
        }
    };
}

figures! {
    /// Lines that the reader could not make sense of.
    bad_lines: Count(usize),
    /// Runs of moves in the plane that lay no clay, between the first and the last bead.
    transfer_moves: Count(usize),
    /// Their length.
    transfer_mm: Measure(f64),
    /// Moves that draw material back.
    retractions: Count(usize),
    /// Moves that go down.
    z_down_moves: Count(usize),
    /// The most that the nozzle rises within one bead width of its path: a layer's height where layers lie level, less where they
    /// rise along their cycles.
    steepest_rise_mm: Measure(f64),
    /// Layers with a path.
    layers: Count(usize),
    /// The most paths in a layer; 1 in a continuous print.
    paths_per_layer_max: Count(usize),
    /// Layers that fit into the height of the mesh.
    mesh_layers: Count(usize),
    /// The last layer of the model that has a wall, counted from 1.
    wanted_layers: Count(usize),
    /// Layers whose end does not come back to their beginning.
    open_layers: Count(usize),
    /// The longest step from the end of a layer to the beginning of the next.
    seam_gap_max_mm: Measure(f64),
    /// Layers that begin with nothing below.
    seam_starts_unsupported: Count(usize),
    /// Length of all paths.
    path_mm: Measure(f64),
    /// Of it, on a wall path.
    model_mm: Measure(f64),
    /// Of it, fill.
    fill_mm: Measure(f64),
    /// Of it, neither: what is broken off.
    nonmodel_mm: Measure(f64),
    /// Non-model length by wall length.
    material_ratio: Measure(f64),
    /// Share of the wall length without a bead.
    model_missed_fraction: Measure(f64),
    /// Wall loops of which more than 2/3 w is missing.
    model_missed_layers: Count(usize),
    /// Share of the outline that no bead reaches: thin features.
    contour_uncovered_fraction: Measure(f64),
    /// Area of floors and faces that are to be closed and that a bead inside of the model can reach, mm².
    closed_mm2: Measure(f64),
    /// Share of it that lies farther than half a bead from the middle of every bead.
    closed_bare_fraction: Measure(f64),
    /// The greatest distance of a place of it from the middle of a bead, in bead widths.
    closed_farthest_widths: Measure(f64),
    /// Stretches longer than the longest bridge with nothing below.
    unsupported_spans: Count(usize),
    /// Their length.
    unsupported_mm: Measure(f64),
    /// Their share of all paths.
    unsupported_fraction: Measure(f64),
    /// The longest of them.
    worst_unsupported_span_mm: Measure(f64),
    /// Places where a path goes through itself.
    self_crossings: Count(usize),
    /// Places where a path goes through the wall.
    wall_crossings: Count(usize),
    /// Non-model strand inside of the model.
    inside_model_mm: Measure(f64),
    /// Non-model strand within one bead of the wall, by wall length.
    contact_per_model_mm: Measure(f64),
    /// The same outside of the model and further than 4/3 w from where the strand leaves or joins the wall:
    /// what cleaning means.
    contact_outside_apart_from_roots: Measure(f64),
    /// Places where the strand leaves or joins the wall, a metre of wall.
    roots_per_model_m: Measure(f64),
    /// Clay laid on clay, as mm of bead, by wall length.
    doubled_per_model_mm: Measure(f64),
    /// Strands closer than one bead apart from roots, as share of all paths.
    overdeposit_apart_from_roots: Measure(f64),
    /// Clay laid on clay as a share of all clay; it flatters wasteful prints.
    overdeposit: Measure(f64),
    /// The same for the walls that the model asks for, by themselves: no print of it can be better.
    overdeposit_of_bare_model: Measure(f64),
    /// Turns of non-model strand by more than 135°.
    sharp_turns_nonmodel: Count(usize),
    /// Places where non-model strand turns by more than 135° within half a bead of its length, at one vertex or
    /// several.
    sharp_bends_nonmodel: Count(usize),
    /// Mean distance from the non-model strand of a layer to the nearest strand of any kind in the next layer up.
    coherence_mm: Measure(f64),
    /// The same in bead widths: strand that stands on itself like a wall has little of it.
    coherence_widths: Measure(f64),
    /// Share of the non-model strand below the last layer that is farther than one bead from all strand of the next.
    apart_from_above_fraction: Measure(f64),
    /// Of that share, what has no reason: its stretch, from wall to wall, holds nothing that the walls do not hold, and
    /// joins no two walls.
    jumps_fraction: Measure(f64),
}
