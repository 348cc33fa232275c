//! One start point a layer, so that the strand climbs in short steps that cross nothing.
