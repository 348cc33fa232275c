//! Beads of fill as wide as the room that they have.
//!
//! Lanes that hold water lie closer than a bead is wide, and where rings meet they lie closer or farther apart. With beads of one width clay
//! heaps up in the one place and is missing in the other. Across a lane, each side has half of the way to the next lane, or what the next
//! wall's bead leaves of it, as wide as that always is; where nothing is near, half a bead.

use argil_curve::{DVec2, Segment, SegmentIndex};
use argil_strand::{Move, Role, Strand, StrandError};

/// The narrowest and the widest bead, in w: what a pump follows from one lane to the next.
const LIMITS: [f64; 2] = [0.75, 1.33];

/// What is farther off than this, in w, is no neighbour: no bead reaches half of the way there.
const NEAR: f64 = 1.5;

/// Rooms are taken this often along a lane, in w.
const STEP: f64 = 0.5;

/// The most places that one stretch is asked in.
const MOST_PLACES: f64 = 64.0;

/// Rooms are evened out over so much of the path to either side, in w: paste does not follow faster.
const EVEN: f64 = 1.0;

/// Widths are rounded to this, in w: what is less cannot be told from none.
const UNIT: f64 = 0.01;

/// The strand with the widths of its fill set, for a bead so many mm wide.
///
/// # Errors
/// Those of a strand's shape; what is built here has none.
///
/// # Complexity
/// O(n · m) for n moves of fill and m moves near each.
pub(crate) fn roomy(strand: Strand, width: f64) -> Result<Strand, StrandError> {
    let is_fill = |step: &Move| step.role == Role::Fill;
    let of_layer = |k: usize| {
        let moves = &strand.layers()[k].moves;
        if !moves.iter().any(is_fill) {
            return Vec::new();
        }
        let lead = moves.len() - strand.cycle(k).len();
        let points = strand.polyline(k);
        let sides: Vec<Segment> = points.windows(2).map(|pair| Segment::new(pair[0], pair[1])).collect();
        let shares = Layer::new(&sides, strand.cycle(k), width).shares();
        let widths: Vec<f64> =
            std::iter::repeat_n(1.0, lead).chain(shares).map(|share| share * width).collect();
        if widths.iter().all(|&of| of == width) { Vec::new() } else { widths }
    };
    let widths = (0..strand.layers().len()).map(of_layer).collect();
    strand.of_widths(widths)
}

/// The cycle of a layer.
struct Layer<'a> {
    moves: &'a [Move],
    index: SegmentIndex,
    width: f64,
}

impl<'a> Layer<'a> {
    fn new(sides: &[Segment], moves: &'a [Move], width: f64) -> Self {
        Self { moves, index: SegmentIndex::new(sides.to_vec(), width), width }
    }

    /// The width of each move's bead, in w.
    fn shares(&self) -> Vec<f64> {
        let sides = self.index.segments();
        let rooms: Vec<Option<[f64; 2]>> =
            (0..self.moves.len()).map(|k| self.is_fill(k).then(|| self.room(k))).collect();
        let even = |k: usize| {
            let Some(own) = rooms[k] else { return 1.0 };
            let mut length = sides[k].length();
            let mut area = own.map(|side| side * length);
            for neighbours in
                [&mut (0..k).rev() as &mut dyn Iterator<Item = usize>, &mut (k + 1..rooms.len())]
            {
                let mut gone = 0.0;
                for other in neighbours {
                    let left = EVEN * self.width - gone;
                    let Some(room) = rooms[other].filter(|_| left > 0.0) else { break };
                    let more = sides[other].length().min(left);
                    gone += more;
                    length += more;
                    area = [area[0] + room[0] * more, area[1] + room[1] * more];
                }
            }
            let [left, right] = area.map(|side| side / (length * self.width));
            // More than a bead only where either side has room for it.
            let share = if left + right <= 1.0 { left + right } else { (2.0 * left.min(right)).max(1.0) };
            let [least, most] = LIMITS;
            if share.is_finite() { (share.clamp(least, most) / UNIT).round() * UNIT } else { 1.0 }
        };
        (0..self.moves.len()).map(even).collect()
    }

    fn is_fill(&self, k: usize) -> bool {
        self.moves[k].role == Role::Fill
    }

    /// The room to the left and to the right of a stretch of fill, mm, in the mean over its length.
    fn room(&self, k: usize) -> [f64; 2] {
        let side = self.index.segments()[k];
        let normal = (side.end - side.start).normalize_or_zero().perp();
        let places = (side.length() / (STEP * self.width)).ceil().clamp(1.0, MOST_PLACES);
        let at = |n: usize| side.point_at((n as f64 + 0.5) / places);
        let mean = |towards: DVec2| {
            (0..places as usize).map(|n| self.room_at(at(n), towards, k)).sum::<f64>() / places
        };
        [mean(normal), mean(-normal)]
    }

    /// The room on one side of a place of a stretch, mm.
    fn room_at(&self, at: DVec2, towards: DVec2, own: usize) -> f64 {
        let [_, most] = LIMITS;
        let reach = NEAR * self.width;
        let ray = Segment::new(at, at + reach * towards);
        let mut room: Option<f64> = None;
        self.index.for_each_near(ray, 0.0, |k, other| {
            if k == own {
                return;
            }
            if let Some(share) = met(ray, other) {
                let way = share * reach;
                let left = if self.is_fill(k) { 0.5 * way } else { way - 0.5 * self.width };
                room = Some(room.map_or(left, |least| least.min(left)));
            }
        });
        room.unwrap_or(0.5 * self.width).clamp(0.0, 0.5 * most * self.width)
    }
}

/// Where a ray meets a stretch, as a share of the ray.
fn met(ray: Segment, other: Segment) -> Option<f64> {
    let (along, across) = (ray.end - ray.start, other.end - other.start);
    let turn = along.perp_dot(across);
    let between = other.start - ray.start;
    let (share, place) = (between.perp_dot(across) / turn, between.perp_dot(along) / turn);
    ((0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&place)).then_some(share)
}

#[cfg(test)]
mod tests {
    use super::roomy;
    use argil_strand::{DVec2, Move, Role, Strand, StrandLayer};

    /// A wall round lanes of fill so far apart, which begins beside them.
    fn comb(pitch: f64) -> Strand {
        let fill = |x: f64, y: f64| Move { to: DVec2::new(x, y), role: Role::Fill };
        let wall = |x: f64, y: f64| Move { to: DVec2::new(x, y), role: Role::Wall };
        let mut moves: Vec<Move> = (0..6)
            .flat_map(|n| {
                let (y, ends) = (pitch * f64::from(n), if n % 2 == 0 { [0.0, 30.0] } else { [30.0, 0.0] });
                ends.map(|x| fill(x, y))
            })
            .skip(1)
            .collect();
        moves.extend([wall(-9.0, 5.0 * pitch), wall(-9.0, 0.0), wall(0.0, 0.0)]);
        let layer = StrandLayer { index: 0, z: 0.5, height: 0.5, width: 1.0, moves, supports: vec![] };
        Strand::new(DVec2::ZERO, vec![layer]).unwrap()
    }

    fn inner_widths(pitch: f64) -> Vec<f64> {
        let strand = roomy(comb(pitch), 1.0).unwrap();
        let long = strand.steps().filter(|step| step.role == Role::Fill && step.length() > 20.0);
        let widths: Vec<f64> = long.map(|step| step.width).collect();
        widths[1..widths.len() - 1].to_vec()
    }

    #[test]
    fn lanes_are_as_wide_as_they_lie_apart() {
        for (pitch, width) in [(0.8, 0.8), (1.0, 1.0), (1.2, 1.2), (0.5, 0.75), (1.33, 1.33)] {
            let widths = inner_widths(pitch);
            assert_eq!(widths.len(), 4);
            assert!(widths.iter().all(|of| (of - width).abs() < 0.03), "{pitch}: {widths:?}");
        }
    }

    #[test]
    fn where_nothing_is_near_beads_are_whole() {
        assert!(inner_widths(3.0).iter().all(|&of| of == 1.0));
    }

    #[test]
    fn walls_keep_their_width() {
        let strand = roomy(comb(0.8), 1.0).unwrap();
        assert!(strand.steps().filter(|step| step.role == Role::Wall).all(|step| step.width == 1.0));
    }
}
