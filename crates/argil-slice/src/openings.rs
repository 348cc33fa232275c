use crate::{Layer, Loss, SliceError};

/// Refuses layers whose outlines a hole of the mesh leaves open, naming the worst place.
///
/// [`slice`](crate::slice) leaves open pieces out and reports them as [`Loss::OpenOutline`]; a print of such layers lacks what
/// they would have bounded. With `strict`, layers are refused as well whose outlines could be closed
/// ([`Loss::ClosedGap`]), or that several bodies have in common ([`Loss::Overlap`]).
///
/// # Errors
/// [`SliceError::InsideOut`] and [`SliceError::Open`] or, if all could be closed, [`SliceError::Gap`] and [`SliceError::Overlap`].
///
/// # Complexity
/// Linear in the number of losses.
///
/// # Example
/// ```
/// use argil_slice::{SliceError, SliceSettings, check_closed, mesh::Mesh, slice};
/// // A tetrahedron of which one side is missing.
/// let corners = vec![[0.0; 3], [9.0, 0.0, 0.0], [0.0, 9.0, 0.0], [0.0, 0.0, 9.0]];
/// let mesh = Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3]]).unwrap();
/// let layers = slice(&mesh, &SliceSettings::default())?;
/// assert_eq!(check_closed(&layers, false), Ok(()));
/// assert!(matches!(check_closed(&layers, true), Err(SliceError::Gap { layer: 0, .. })));
/// # Ok::<(), SliceError>(())
/// ```
pub fn check_closed(layers: &[Layer], strict: bool) -> Result<(), SliceError> {
    let losses = || layers.iter().flat_map(|layer| &layer.losses);
    let inside_out = losses().filter_map(|loss| match *loss {
        Loss::InsideOut { layer, at, area } => Some((area, layer, at)),
        _ => None,
    });
    if let Some(((area, layer, at), count)) = greatest(inside_out, |place| place.0) {
        return Err(SliceError::InsideOut { layer, at, area, others: count - 1 });
    }
    let open = losses().filter_map(|loss| match *loss {
        Loss::OpenOutline { layer, at, length, gap } => Some((length, layer, at, gap)),
        _ => None,
    });
    if let Some(((length, layer, at, gap), count)) = greatest(open, |piece| piece.0) {
        return Err(SliceError::Open { layer, at, length, gap, others: count - 1 });
    }
    let closed = losses().filter(|_| strict).filter_map(|loss| match *loss {
        Loss::ClosedGap { layer, at, gap } => Some((gap, layer, at)),
        _ => None,
    });
    if let Some(((gap, layer, at), count)) = greatest(closed, |gap| gap.0) {
        return Err(SliceError::Gap { layer, at, gap, others: count - 1 });
    }
    let common = losses().filter(|_| strict).filter_map(|loss| match *loss {
        Loss::Overlap { layer, at, area } => Some((area, layer, at)),
        _ => None,
    });
    match greatest(common, |place| place.0) {
        Some(((area, layer, at), count)) => Err(SliceError::Overlap { layer, at, area, others: count - 1 }),
        None => Ok(()),
    }
}

/// The first of the greatest, and how many there are in all.
fn greatest<T>(places: impl Iterator<Item = T>, measure: impl Fn(&T) -> f64) -> Option<(T, usize)> {
    let mut count = 0;
    let greatest =
        places.inspect(|_| count += 1).reduce(|a, b| if measure(&b) > measure(&a) { b } else { a });
    greatest.map(|greatest| (greatest, count))
}
