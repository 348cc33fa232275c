//! The contact ledger: where the strand touches the model's outside, over which layers and why. A guide for cleaning.

use crate::contact::Touch;
use argil_curve::{DVec2, Segment, SegmentIndex};

/// In w: touches of neighbouring layers that come this near are one place.
const ONE_PLACE: f64 = 1.0;

/// Why the strand touches the model.
///
/// # Example
/// ```
/// use argil_audit::ContactCause;
/// assert_eq!(ContactCause::Narrow.name(), "between two parts");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ContactCause {
    /// The strand leaves or joins the wall here, as it must somewhere.
    Root,
    /// It lies in a hole of the layer's outline, with the model all round.
    Enclosed,
    /// It holds a wall of the next layer that juts out by less than one bead: no room was left between the two.
    Overhang,
    /// It runs between two parts of the model less than two beads apart, or along both sides of a fold.
    Narrow,
    /// It holds strand of the next layer that lies as near to the model, or nothing at all.
    Passing,
}

impl ContactCause {
    /// The name used in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Root => "root",
            Self::Enclosed => "enclosed",
            Self::Overhang => "below an overhang",
            Self::Narrow => "between two parts",
            Self::Passing => "passing by",
        }
    }
}

/// A place where non-model strand lies within one bead of the model's wall, outside of the model.
///
/// # Example
/// ```
/// use argil_audit::{AuditSettings, ContactCause, ContactPlace, audit, gcode::read_gcode, mesh::Mesh};
/// let plate = Mesh::cuboid([0.0; 3], [20.0, 20.0, 0.5])?;
/// // A strand that leaves the wall, and comes back to it one bead farther on.
/// let lap = "M83\nG0 X.75 Y.75 Z.5\n;LAYER:0\nG1 X19.25 E1\nG1 Y9 E1\n;TYPE:SUPPORT\nG1 X30 E1\nG1 Y10.5 E1\nG1 X19.25 E1\n";
/// let rest = ";TYPE:WALL-OUTER\nG1 Y19.25 E1\nG1 X.75 E1\nG1 Y.75 E1\n";
/// let report = audit(&read_gcode(&format!("{lap}{rest}")), &plate, &AuditSettings::default())?;
/// let place: ContactPlace = report.contacts[0];
/// assert_eq!((place.cause, place.layer), (ContactCause::Root, 0));
/// assert_eq!(report.contacts_by_cause()[0].0, ContactCause::Root);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactPlace {
    /// Why it is there.
    pub cause: ContactCause,
    /// The lowest of its layers, by the file's own number.
    pub first_layer: i64,
    /// The highest of its layers.
    pub last_layer: i64,
    /// A point of the strand that touches, mm: the middle of the touch that is nearest to the mean of all.
    pub at: DVec2,
    /// The layer of that point, by the file's own number.
    pub layer: i64,
    /// Length of strand that touches, over all its layers, mm.
    pub length: f64,
}

/// Gathers the touches of layer after layer into places.
#[derive(Debug, Default)]
pub(crate) struct Ledger {
    places: Vec<Place>,
    /// The touches of the layer before: where, and the place that each belongs to.
    before: Vec<(Touch, usize)>,
    before_layer: Option<i64>,
}

#[derive(Debug)]
struct Place {
    /// The place that this one has become part of, or itself.
    part_of: usize,
    cause: ContactCause,
    first: i64,
    last: i64,
    length: f64,
    /// Sum of places by length, mm².
    moment: DVec2,
    /// The middle of each touch, and its layer.
    touches: Vec<(DVec2, i64)>,
}

impl Place {
    /// The touch that is nearest to the mean; of several the first.
    fn middle(&self) -> (DVec2, i64) {
        let mean = self.moment / self.length.max(f64::MIN_POSITIVE);
        let nearer = |a: (DVec2, i64), b: (DVec2, i64)| {
            if b.0.distance_squared(mean) < a.0.distance_squared(mean) { b } else { a }
        };
        self.touches.iter().copied().reduce(nearer).unwrap_or((mean, self.first))
    }
}

impl Ledger {
    /// Takes in a layer's touches. Those near a touch of the layer before with the same cause go to its place; places
    /// that meet so become one.
    ///
    /// # Complexity
    /// Near linear in the points of both layers' touches.
    pub(crate) fn layer(&mut self, number: i64, touches: Vec<Touch>, width: f64) {
        if self.before_layer.is_none_or(|before| before.checked_add(1) != Some(number)) {
            self.before.clear();
        }
        let mut segments = Vec::new();
        let mut owner = Vec::new();
        for (touch, place) in &self.before {
            let spans = touch.points.windows(2).map(|e| Segment::new(e[0], e[1]));
            let alone = touch.points.first().map(|&p| Segment::new(p, p));
            segments.extend(spans.chain(alone));
            owner.resize(segments.len(), (touch.cause, *place));
        }
        let index = SegmentIndex::new(segments, 0.75 * width);
        let mut now = Vec::with_capacity(touches.len());
        for touch in touches {
            let mut place = None;
            for &point in &touch.points {
                let around = Segment::new(point, point);
                index.for_each_near(around, ONE_PLACE * width, |k, segment| {
                    let (cause, other) = owner[k];
                    if cause == touch.cause && segment.distance(point) <= ONE_PLACE * width {
                        let other = self.places.whole(other);
                        place = Some(place.map_or(other, |place| self.places.joined(place, other)));
                    }
                });
            }
            let place = place.unwrap_or_else(|| self.places.opened(touch.cause, number));
            let entry = &mut self.places[place];
            entry.last = number;
            entry.length += touch.length;
            entry.moment += touch.length * touch.middle;
            entry.touches.push((touch.middle, number));
            now.push((touch, place));
        }
        self.before = now;
        self.before_layer = Some(number);
    }

    /// All places, the lowest first.
    pub(crate) fn finished(self) -> Vec<ContactPlace> {
        let whole = self.places.iter().enumerate().filter(|(k, place)| place.part_of == *k);
        let mut places: Vec<ContactPlace> = whole
            .map(|(_, place)| {
                let (at, layer) = place.middle();
                ContactPlace {
                    cause: place.cause,
                    first_layer: place.first,
                    last_layer: place.last,
                    at,
                    layer,
                    length: place.length,
                }
            })
            .collect();
        places.sort_by_key(|place| (place.first_layer, place.last_layer, place.cause));
        places
    }
}

/// Places that may become part of one another: a forest of sets, each named by its lowest index.
trait Sets {
    fn whole(&self, place: usize) -> usize;
    fn joined(&mut self, a: usize, b: usize) -> usize;
    fn opened(&mut self, cause: ContactCause, layer: i64) -> usize;
}

impl Sets for Vec<Place> {
    fn whole(&self, mut place: usize) -> usize {
        while self[place].part_of != place {
            place = self[place].part_of;
        }
        place
    }

    fn joined(&mut self, a: usize, b: usize) -> usize {
        let (a, b) = (self.whole(a), self.whole(b));
        let (keeps, goes) = (a.min(b), a.max(b));
        if keeps != goes {
            let (first, last) = (self[goes].first, self[goes].last);
            let (length, moment) = (self[goes].length, self[goes].moment);
            let mut touches = std::mem::take(&mut self[goes].touches);
            self[goes].part_of = keeps;
            let whole = &mut self[keeps];
            whole.first = whole.first.min(first);
            whole.last = whole.last.max(last);
            whole.length += length;
            whole.moment += moment;
            whole.touches.append(&mut touches);
        }
        keeps
    }

    fn opened(&mut self, cause: ContactCause, layer: i64) -> usize {
        let place = self.len();
        let (length, moment) = (0.0, DVec2::ZERO);
        self.push(Place {
            part_of: place,
            cause,
            first: layer,
            last: layer,
            length,
            moment,
            touches: Vec::new(),
        });
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touch(cause: ContactCause, from: (f64, f64), to: (f64, f64)) -> Touch {
        let points = vec![DVec2::from(from), DVec2::from(to)];
        Touch { cause, middle: 0.5 * (points[0] + points[1]), length: points[0].distance(points[1]), points }
    }

    #[test]
    fn touches_above_one_another_are_one_place() {
        use ContactCause::{Passing, Root};
        let mut ledger = Ledger::default();
        ledger.layer(
            3,
            vec![touch(Passing, (0.0, 0.0), (2.0, 0.0)), touch(Passing, (9.0, 0.0), (9.0, 4.0))],
            1.5,
        );
        ledger.layer(
            4,
            vec![touch(Passing, (2.5, 0.0), (8.0, 0.0)), touch(Root, (0.0, 0.0), (1.0, 0.0))],
            1.5,
        );
        // What is bridged by the layer above becomes one, the root stays by itself; a gap of a layer ends a place.
        ledger.layer(6, vec![touch(Passing, (2.5, 0.0), (4.5, 0.0))], 1.5);
        let places = ledger.finished();
        let told: Vec<_> = places.iter().map(|p| (p.cause, p.first_layer, p.last_layer, p.length)).collect();
        assert_eq!(told, [(Passing, 3, 4, 11.5), (Root, 4, 4, 1.0), (Passing, 6, 6, 2.0)]);
        // The mean is at (5.8, 0.7), off all three; the nearest of them is told.
        assert_eq!((places[0].at, places[0].layer), (DVec2::new(5.25, 0.0), 4));
    }
}
