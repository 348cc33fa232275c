//! Triangle meshes from the bytes of STL files: weld, check, orient, place.
