//! What must hold of every strand, measured on the strand itself and not on its g-code.

use argil::curve::{ClosedCurve, Segment, SegmentIndex, self_crossings};
use argil::slice::Layer;
use argil::strand::{Move, Role, Strand};
use argil::support::unsupported_spans;
use argil::{Plan, Settings};

/// The longest step from layer to layer, in w: half a bead's width and some, so that the two beads touch.
const STEP: f64 = 0.8;

/// Every departure of a plan from what must hold, as text with its layer; `layers` are those it was made from.
pub(crate) fn departures(plan: &Plan, layers: &[Layer], settings: &Settings) -> Vec<String> {
    let strand = &plan.strand;
    let mut found = Vec::new();
    for (position, layer) in strand.layers().iter().enumerate() {
        let mut depart = |what: String| found.push(format!("layer {}: {what}", layer.index));
        let cycle = strand.polyline(position);
        if cycle.first() != cycle.last() || cycle.len() < 3 {
            depart("it is not closed".to_owned());
        }
        let crossings = self_crossings(&cycle[1..]);
        if let Some(first) = crossings.first() {
            depart(format!("{} crossings, the first at {}", crossings.len(), first.point));
        }
        walls(strand, position, &layers[layer.index], settings).into_iter().for_each(&mut depart);
        if position > 0 {
            climb(strand, position, settings).into_iter().for_each(&mut depart);
        }
    }
    found.extend(count(plan, layers, settings));
    found
}

/// One layer of strand for every layer up to the last with a wall, each at its height.
fn count(plan: &Plan, layers: &[Layer], settings: &Settings) -> Vec<String> {
    let top = layers.iter().rposition(|layer| !layer.walls.is_empty());
    let indices: Vec<usize> = plan.strand.layers().iter().map(|layer| layer.index).collect();
    let mut found = Vec::new();
    if indices != (0..top.map_or(0, |top| top + 1)).collect::<Vec<_>>() {
        found.push(format!("the layers are {indices:?}"));
    }
    for layer in plan.strand.layers() {
        if (layer.z - layers[layer.index].print_z).abs() > settings.grid {
            found.push(format!("layer {}: printed at {} mm", layer.index, layer.z));
        }
    }
    found
}

/// Walls that the layer lacks, and wall strand that is no wall.
fn walls(strand: &Strand, position: usize, layer: &Layer, settings: &Settings) -> Vec<String> {
    let cycle = strand.polyline(position);
    let laid: Vec<Segment> = cycle
        .windows(2)
        .zip(strand.cycle(position))
        .filter(|(_, Move { role, .. })| *role == Role::Wall)
        .map(|(ends, _)| Segment::new(ends[0], ends[1]))
        .collect();
    let wanted: Vec<Segment> = layer
        .walls
        .iter()
        .flat_map(|wall| {
            let next = wall.points.iter().cycle().skip(1);
            wall.points.iter().zip(next).map(|(&a, &b)| Segment::new(a, b))
        })
        .collect();
    let total = |segments: &[Segment]| segments.iter().map(Segment::length).sum::<f64>();
    let mut found = Vec::new();
    // A start that is put on the grid beside a wall makes it longer by less than a step of the grid.
    if (total(&laid) - total(&wanted)).abs() > 1e-6 * total(&wanted) + settings.grid {
        found.push(format!("{} mm of wall, wanted are {} mm", total(&laid), total(&wanted)));
    }
    // Equal lengths could still be elsewhere. A place where the strand leaves stands two steps of the grid
    // beside its wall, and is rounded.
    let index = SegmentIndex::new(laid, settings.width);
    let is_bare = |p| index.nearest_within(p, 3.0 * settings.grid).is_none();
    let missed = wanted.iter().find(|s| [0.0, 0.5].iter().any(|&t| is_bare(s.point_at(t))));
    if let Some(segment) = missed {
        found.push(format!("the wall from {} to {} is not laid", segment.start, segment.end));
    }
    found
}

/// What is wrong between a layer and the one below: what hangs, and how the strand gets up.
fn climb(strand: &Strand, position: usize, settings: &Settings) -> Vec<String> {
    let mut found = Vec::new();
    let curve = |k: usize| ClosedCurve::new(strand.polyline(k)).expect("a layer is a closed curve");
    let below = SegmentIndex::of_curves([&curve(position - 1)], settings.width);
    let criterion = settings.criterion();
    for span in unsupported_spans(&curve(position), &below, &criterion) {
        found.push(format!("{} mm hang from {}", span.length, curve(position).point_at(span.start)));
    }
    let ends = strand.polyline(position - 1).last().copied().zip(strand.seam(position));
    let (end, start) = ends.expect("both layers have points");
    let (step, held) = (end.distance(start), below.distance(start));
    if step > STEP * settings.width {
        found.push(format!("a step of {step} mm from {end} to {start}"));
    }
    if held > criterion.across {
        found.push(format!("it begins at {start}, {held} mm from what is below"));
    }
    found
}
