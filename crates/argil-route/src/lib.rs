//! One layer: walls and support points into one closed cycle that never crosses itself.
