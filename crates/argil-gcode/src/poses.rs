//! A strand as a table of poses, for robot cells.

use std::fmt;

use argil_strand::Strand;

use crate::{GcodeError, GcodeSettings};

/// A strand as comma-separated values, written when it is displayed: one pose a line, in the order of laying.
///
/// Robot controllers differ too much for one program to suit them all, so this is what a cell's own script needs to
/// make one. The first line names the columns: `n` counts poses from 0; `layer` is the layer's number and `role` what
/// the stretch that ends here is laid for (empty at the first pose); `x_mm`, `y_mm`, `z_mm` is the nozzle's mouth;
/// `ax`, `ay`, `az` the direction in which it points, a unit vector, straight down throughout; `speed_mm_s` the speed
/// on the way here; `flow_mm3_s` the paste on the way here, 0 at the first pose; `width_mm` and `height_mm` the bead.
///
/// # Example
/// ```
/// # use argil_gcode::strand::{DVec2, Move, Role, Strand, StrandLayer};
/// use argil_gcode::{GcodeSettings, Poses};
/// # let moves = [(9.0, 0.0), (0.0, 9.0), (0.0, 0.0)].map(|(x, y)| Move { to: DVec2::new(x, y), role: Role::Wall });
/// # let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.5, moves: moves.to_vec(), supports: vec![] };
/// # let strand = Strand::new(DVec2::ZERO, vec![layer]).unwrap();
/// let settings = GcodeSettings { first_layer_feed: 10.0, ..GcodeSettings::default() };
/// let table = Poses::new(&strand, &settings)?.to_string();
/// let rows: Vec<&str> = table.lines().collect();
/// assert_eq!(rows.len(), 5);
/// assert!(rows[2].starts_with("1,0,wall,9,0,0.5,0,0,-1,10,"));
/// # Ok::<(), argil_gcode::GcodeError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Poses<'a> {
    strand: &'a Strand,
    settings: &'a GcodeSettings,
}

impl<'a> Poses<'a> {
    /// Of the settings, speeds and the cross-section of the bead count.
    ///
    /// # Errors
    /// A setting that makes no sense.
    pub fn new(strand: &'a Strand, settings: &'a GcodeSettings) -> Result<Self, GcodeError> {
        settings.check()?;
        Ok(Self { strand, settings })
    }
}

/// A number to the ten-thousandth.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding 0 turns -0 into 0; what is too large to have decimals is written as it is.
        let rounded = (self.0 * 1e4).round() / 1e4 + 0.0;
        write!(f, "{}", if rounded.is_finite() { rounded } else { self.0 })
    }
}

impl fmt::Display for Poses<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "n,layer,role,x_mm,y_mm,z_mm,ax,ay,az,speed_mm_s,flow_mm3_s,width_mm,height_mm")?;
        for (k, step) in self.strand.steps().enumerate() {
            let layer = &self.strand.layers()[step.layer];
            let bead = (step.width, step.height);
            if k == 0 {
                row(f, 0, layer.index, "", step.from.to_array(), [self.settings.approach_feed, 0.0], bead)?;
            }
            let speed = self.settings.speed_of(self.strand, &step);
            let flow = speed * self.settings.bead.area(step.width, step.height);
            row(f, k + 1, layer.index, step.role.name(), step.to.to_array(), [speed, flow], bead)?;
        }
        Ok(())
    }
}

fn row(
    f: &mut fmt::Formatter<'_>,
    number: usize,
    layer: usize,
    role: &str,
    place: [f64; 3],
    pace: [f64; 2],
    bead: (f64, f64),
) -> fmt::Result {
    let ([x, y, z], [speed, flow]) = (place.map(Short), pace.map(Short));
    let (width, height) = (Short(bead.0), Short(bead.1));
    writeln!(f, "{number},{layer},{role},{x},{y},{z},0,0,-1,{speed},{flow},{width},{height}")
}
