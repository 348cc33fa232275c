//! Closed curves and segment sets: arc length, distances, held spans, crossings.
