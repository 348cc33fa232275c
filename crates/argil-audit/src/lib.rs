//! Measures any g-code file against its model by geometry alone.
