//! Polygons in files: a list of polygons, each a list of rings, the outer one first, each a list of `[x, y]`, like paths.

use geo_types::{Coord, LineString, MultiPolygon, Polygon};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

type Ring = Vec<[f64; 2]>;

pub(crate) fn serialize<S: Serializer>(region: &MultiPolygon<f64>, to: S) -> Result<S::Ok, S::Error> {
    let ring = |ring: &LineString<f64>| ring.coords().map(|c| [c.x, c.y]).collect::<Ring>();
    let polygon = |p: &Polygon<f64>| -> Vec<Ring> {
        std::iter::once(p.exterior()).chain(p.interiors()).map(ring).collect()
    };
    region.iter().map(polygon).collect::<Vec<_>>().serialize(to)
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<MultiPolygon<f64>, D::Error> {
    let ring = |ring: Ring| ring.into_iter().map(|[x, y]| Coord { x, y }).collect::<LineString<f64>>();
    let polygons = Vec::<Vec<Ring>>::deserialize(from)?.into_iter().map(|polygon| {
        let mut rings = polygon.into_iter().map(ring);
        let exterior = rings.next().unwrap_or_else(|| LineString(Vec::new()));
        Polygon::new(exterior, rings.collect())
    });
    Ok(polygons.collect())
}
