//! Procedural solids that show what strictly continuous printing has to cope with.
