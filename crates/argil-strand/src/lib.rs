//! The strand as data: one unbroken polyline of beads, layer above layer, each with its role.
