//! One model part of a 3MF package: its objects and what is to be built of them.

use std::collections::BTreeMap;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::formats::transform::Transform;
use crate::{MeshError, Unit};

/// Extensions that a part may require: they change neither where triangles are nor which are printed, or are followed here.
const KNOWN_EXTENSIONS: [&str; 3] = [
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
];

/// An object that is used in another object or in the build.
#[derive(Clone, Debug)]
pub(crate) struct Instance {
    /// Another part than that of the user, without a slash before its name.
    pub(crate) path: Option<String>,
    pub(crate) object: u32,
    pub(crate) transform: Transform,
}

#[derive(Debug, Default)]
pub(crate) struct Object {
    /// Whether it is part of the model, and not a support or an aid of another program.
    pub(crate) is_printed: bool,
    pub(crate) vertices: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) components: Vec<Instance>,
}

#[derive(Debug)]
pub(crate) struct ModelPart {
    pub(crate) unit: Unit,
    pub(crate) objects: BTreeMap<u32, Object>,
    pub(crate) items: Vec<Instance>,
}

impl ModelPart {
    /// Reads the elements of the core specification, whatever their prefix; all others are left out.
    pub(crate) fn parse(name: &str, text: &str) -> Result<Self, MeshError> {
        let mut part = Self { unit: Unit::Millimetre, objects: BTreeMap::new(), items: Vec::new() };
        let mut reader = Reader::from_str(text);
        let mut open: Option<(u32, Object)> = None;
        let mut is_model = false;
        loop {
            let position = reader.buffer_position();
            let wrong =
                |expected: &'static str| MeshError::Package { part: name.to_owned(), position, expected };
            let event = reader.read_event().map_err(|_| wrong("well-formed XML"))?;
            let (element, is_empty) = match &event {
                Event::Start(element) => (element, false),
                Event::Empty(element) => (element, true),
                Event::End(element) => {
                    if element.local_name().as_ref() == "object" {
                        part.objects.extend(open.take());
                    }
                    continue;
                }
                Event::Eof => break,
                _ => continue,
            };
            let attributes = Attributes(element);
            match (element.local_name().as_ref(), &mut open) {
                ("model", _) => {
                    is_model = true;
                    part.unit = attributes.unit().ok_or_else(|| wrong("a unit of the specification"))?;
                    attributes.check_extensions()?;
                }
                ("object", _) => {
                    let id = attributes.index("id").ok_or_else(|| wrong("an object with an id"))?;
                    let is_printed = attributes.get("type").is_none_or(|kind| kind == "model");
                    let object = Object { is_printed, ..Object::default() };
                    if is_empty {
                        part.objects.insert(id, object);
                    } else {
                        open = Some((id, object));
                    }
                }
                ("vertex", Some((_, object))) => {
                    let place = ["x", "y", "z"].map(|axis| attributes.number(axis));
                    let [Some(x), Some(y), Some(z)] = place else {
                        return Err(wrong("a vertex with x, y and z"));
                    };
                    object.vertices.push([x, y, z]);
                }
                ("triangle", Some((_, object))) => {
                    let corners = ["v1", "v2", "v3"].map(|corner| attributes.index(corner));
                    let [Some(a), Some(b), Some(c)] = corners else {
                        return Err(wrong("a triangle with v1, v2 and v3"));
                    };
                    object.triangles.push([a, b, c]);
                }
                ("component", Some((_, object))) => {
                    let instance = attributes
                        .instance()
                        .ok_or_else(|| wrong("a component with objectid and transform"))?;
                    object.components.push(instance);
                }
                ("item", None) => {
                    let instance =
                        attributes.instance().ok_or_else(|| wrong("an item with objectid and transform"))?;
                    part.items.push(instance);
                }
                _ => {}
            }
        }
        if is_model {
            Ok(part)
        } else {
            Err(MeshError::Package { part: name.to_owned(), position: 0, expected: "a model" })
        }
    }
}

/// The attributes of an element by name.
struct Attributes<'e, 'x>(&'e BytesStart<'x>);

impl Attributes<'_, '_> {
    fn get(&self, name: &str) -> Option<String> {
        let found = self.0.try_get_attribute(name).ok().flatten();
        found.map(|attribute| attribute.value.into_owned())
    }

    fn number(&self, name: &str) -> Option<f64> {
        let found = self.0.try_get_attribute(name).ok().flatten()?;
        found.value.trim().parse().ok()
    }

    fn index(&self, name: &str) -> Option<u32> {
        let found = self.0.try_get_attribute(name).ok().flatten()?;
        found.value.trim().parse().ok()
    }

    fn unit(&self) -> Option<Unit> {
        Some(match self.get("unit").as_deref() {
            None | Some("millimeter") => Unit::Millimetre,
            Some("micron") => Unit::Micron,
            Some("centimeter") => Unit::Centimetre,
            Some("inch") => Unit::Inch,
            Some("foot") => Unit::Foot,
            Some("meter") => Unit::Metre,
            Some(_) => return None,
        })
    }

    /// An object that is named here; the part that it is in may be named under any prefix.
    fn instance(&self) -> Option<Instance> {
        let transform = match self.get("transform") {
            Some(text) => Transform::parse(&text)?,
            None => Transform::IDENTITY,
        };
        let mut attributes = self.0.attributes();
        let mut known = attributes.with_checks(false).filter_map(Result::ok);
        let path = known.find(|attribute| attribute.key.local_name().as_ref() == "path");
        let path = path.map(|attribute| attribute.value.trim_start_matches('/').to_owned());
        Some(Instance { path, object: self.index("objectid")?, transform })
    }

    /// Refuses what says of itself that it cannot be read by those who do not know an extension.
    fn check_extensions(&self) -> Result<(), MeshError> {
        for prefix in self.get("requiredextensions").unwrap_or_default().split_ascii_whitespace() {
            let namespace = self.get(&format!("xmlns:{prefix}")).unwrap_or_default();
            if !KNOWN_EXTENSIONS.contains(&namespace.as_str()) {
                return Err(MeshError::Unsupported {
                    what: format!("the 3MF extension {namespace}: export plain triangles"),
                });
            }
        }
        Ok(())
    }
}
