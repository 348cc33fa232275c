//! Support detection alone, on the paths of another slicer's g-code: which stretches hang in the air, and where?

use std::error::Error;

use argil::curve::{ClosedCurve, SegmentIndex};
use argil::gcode::{Move, read_gcode};
use argil::support::{Criterion, Placement, place_supports, unsupported_spans};

/// A file as a slicer may have written it: a square tube of three layers that grows 1.2 mm to the right on the last.
fn file() -> String {
    let mut text = String::from("; made elsewhere\nG90\nM83\n");
    for (layer, right) in [20.0, 20.0, 21.2].into_iter().enumerate() {
        let z = 0.5 * (layer + 1) as f64;
        text.push_str(&format!(";LAYER:{layer}\nG0 X0 Y0 Z{z}\n;TYPE:WALL-OUTER\n"));
        for (x, y) in [(right, 0.0), (right, 20.0), (0.0, 20.0), (0.0, 0.0)] {
            text.push_str(&format!("G1 X{x} Y{y} E.8\n"));
        }
    }
    text
}

/// The closed path of a layer: where its extruding moves lead.
fn path(moves: &[Move], layer: i64) -> Result<ClosedCurve, argil::curve::CurveError> {
    let laid = moves.iter().filter(|step| step.layer == Some(layer) && step.extruded > 0.0);
    ClosedCurve::new(laid.map(|step| (step.to[0], step.to[1]).into()).collect())
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let program = read_gcode(&file());
    let width = 1.5;
    let criterion = Criterion::for_width(width);
    let mut hanging = Vec::new();
    for layer in 1..3 {
        let (below, above) = (path(&program.moves, layer - 1)?, path(&program.moves, layer)?);
        let below = SegmentIndex::of_curves([&below], width);
        for span in unsupported_spans(&above, &below, &criterion) {
            hanging.push((layer, span.length, above.point_at(span.start + 0.5 * span.length)));
        }
    }
    // The side that has moved out, with the ends of the two beside it.
    let [(2, length, middle)] = hanging[..] else { return Err(format!("{hanging:?}").into()) };
    assert!(
        length > 20.0 && (middle.x - 21.2).abs() < 1e-9 && (middle.y - 10.0).abs() < 0.5,
        "{length} mm at {middle}"
    );

    // The fewest points that the layer below would have to pass to hold it.
    let (below, above) = (path(&program.moves, 1)?, path(&program.moves, 2)?);
    let points =
        place_supports(&above, &SegmentIndex::of_curves([&below], width), &Placement::for_width(width));
    assert!((5..=15).contains(&points.len()), "{} points", points.len());
    Ok(())
}
