//! A mesh into closed outlines, wall loops and their containment tree, layer by layer.
