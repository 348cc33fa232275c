//! A strand into g-code, and g-code of any slicer back into moves.
