//! Sheets: surfaces without thickness, whose sections are themselves the paths of walls.

use crate::SliceSettings;
use crate::chain::OpenChain;
use crate::layer::Loss;
use crate::region::{dilation, inset, parity_region, swept};
use crate::thin::HALF_LANE;
use crate::wall::{Walls, walls_along};
use geo::{Area, BooleanOps};
use geo_types::MultiPolygon;
use glam::DVec2;

/// Regions smaller than this, in square millimetres, are rounding errors of the cut.
const LEAST_AREA: f64 = 1e-6;

/// How far from the wall a line inside of it ends, in w: the wall's bead covers that.
const SLIT: f64 = 0.1;

/// Smaller spurs are ends of lines that meet the wall from inside, in w².
const LEAST_SPUR: f64 = 0.004;

/// How far arcs may cut their corners, in w.
const CHORD: f64 = 0.003;

/// What a plane cuts out of a sheet.
pub(crate) struct SheetSection<'a> {
    pub(crate) layer: usize,
    pub(crate) contours: &'a [Vec<DVec2>],
    /// Contours with two sides and nothing between.
    pub(crate) doubled: &'a [Vec<DVec2>],
    pub(crate) open: &'a [OpenChain],
}

/// The walls along a sheet, what they go round, and that with half a bead more all round: what is solid, or inside.
pub(crate) struct Sheet {
    pub(crate) outline: MultiPolygon<f64>,
    pub(crate) walls: Walls,
}

impl SheetSection<'_> {
    /// Closed sections are walls as they are. Open ones are printed there and back, two lanes in one bead: where one lies outside of all closed
    /// ones it is a loop or, if it meets one, a spur of it; where one lies inside it is a loop that ends a little before the wall.
    pub(crate) fn sheet(&self, settings: &SliceSettings) -> Sheet {
        let width = settings.width;
        let closed = parity_region(self.contours, LEAST_AREA);
        let opened = self.open.iter().map(|chain| chain.points.clone());
        let lines: Vec<Vec<DVec2>> =
            opened.chain(self.doubled.iter().cloned()).filter(|line| line.len() > 1).collect();
        let (mut region, mut slits) = (closed, MultiPolygon(Vec::new()));
        for line in &lines {
            let lanes = swept(std::slice::from_ref(line), HALF_LANE * width);
            let sticks_out = lanes
                .difference(&region)
                .iter()
                .any(|spur| spur.unsigned_area() > LEAST_SPUR * width * width);
            slits = slits.union(&lanes.intersection(&inset(&region, SLIT * width, CHORD * width)));
            if sticks_out {
                // What is joined overlaps: the kernel may leave a gap between what only touches.
                region = region.union(&lanes.difference(&inset(&region, 0.5 * SLIT * width, CHORD * width)));
            }
        }
        let mut walls = walls_along(self.layer, &region, &slits, settings);
        let there_and_back = lines.iter().filter_map(|line| {
            let length = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            Some(Loss::OpenSheet { layer: self.layer, at: *line.get(line.len() / 2)?, length })
        });
        walls.losses.extend(there_and_back);
        Sheet { outline: dilation(&region, 0.5 * width, CHORD * width), walls }
    }
}
