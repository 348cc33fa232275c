//! Which spans of a deposition path hang in the air, and the fewest points that hold them.
