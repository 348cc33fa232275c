//! Triangulated free space between walls, with exact shortest paths and distances.
