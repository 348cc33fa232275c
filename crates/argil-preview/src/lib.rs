//! Pictures of a strand: SVG layers and a PNG overview.
