use std::collections::BTreeMap;

use quick_xml::Reader;
use quick_xml::events::Event;

use crate::formats::model_part::{Instance, ModelPart};
use crate::formats::package::{Package, broken};
use crate::formats::transform::Transform;
use crate::{MeshError, Remark, Soup};

/// How deep objects may consist of objects.
const DEEPEST: usize = 64;

/// The most triangles that a build may come to: components may use objects any number of times.
const MOST_TRIANGLES: usize = 50_000_000;

/// The most objects that a build may come to, empty ones included.
const MOST_INSTANCES: usize = 1_000_000;

/// Where the model part is if the package does not say.
const USUAL: &str = "3D/3dmodel.model";

/// The triangles of a 3MF file: the items of its build in their places.
///
/// Objects may consist of others, also in other parts of the package. Supports and aids of other programs (objects of another
/// type than `model`) are left out with a [`Remark::Aids`]. Mirrored objects keep their outside. The unit is that of the model.
/// What a part unpacks to is limited, and so is what components come to, so that no small file fills the memory.
///
/// # Errors
/// [`MeshError::Package`] where the file does not follow the format, with part and place; [`MeshError::Unpacked`] for parts that
/// unpack to too much, [`MeshError::Unsupported`] for extensions that the file says it cannot be read without.
///
/// # Complexity
/// Linear in the size of the parts, unpacked, and in the triangles of the build.
///
/// # Example
/// ```
/// use argil_mesh::{MeshError, three_mf};
/// // A 3MF file is a package of compressed parts, and not its XML alone.
/// assert!(matches!(three_mf(b"<model/>"), Err(MeshError::Package { .. })));
/// ```
pub fn three_mf(bytes: &[u8]) -> Result<Soup, MeshError> {
    if bytes.is_empty() {
        return Err(MeshError::Empty);
    }
    let mut package = Package::open(bytes)?;
    let root = root(&mut package)?;
    let mut build = Build { package, parts: BTreeMap::new(), soup: Soup::default(), aids: 0, instances: 0 };
    build.load(&root)?;
    let Some(part) = build.parts.get(&root) else { return Err(broken(&root, "a part of the package")) };
    let (unit, items) = (part.unit, part.items.clone());
    for item in &items {
        build.add(&root, item, &Transform::IDENTITY, 0)?;
    }
    let mut soup = build.soup;
    // In millimetres while it is put together, since parts may have units of their own.
    soup.vertices.iter_mut().flatten().for_each(|value| *value /= unit.millimetres());
    soup.unit = Some(unit);
    if build.aids > 0 {
        soup.remarks.push(Remark::Aids { count: build.aids });
    }
    Ok(soup)
}

/// The name of the model part that the package is about.
fn root(package: &mut Package<'_>) -> Result<String, MeshError> {
    let Some(text) = package.part("_rels/.rels")? else { return Ok(USUAL.to_owned()) };
    let mut reader = Reader::from_str(&text);
    loop {
        match reader.read_event().map_err(|_| broken("_rels/.rels", "well-formed XML"))? {
            Event::Start(element) | Event::Empty(element)
                if element.local_name().as_ref() == "Relationship" =>
            {
                let get =
                    |name: &str| element.try_get_attribute(name).ok().flatten().map(|found| found.value);
                if get("Type").is_some_and(|kind| kind.ends_with("/3dmodel")) {
                    let target = get("Target").unwrap_or_default();
                    return Ok(target.trim_start_matches('/').to_owned());
                }
            }
            Event::Eof => return Ok(USUAL.to_owned()),
            _ => {}
        }
    }
}

/// A build as it grows, in millimetres.
struct Build<'a> {
    package: Package<'a>,
    /// The model parts read so far, by name.
    parts: BTreeMap<String, ModelPart>,
    soup: Soup,
    /// Objects that are not part of the model.
    aids: usize,
    instances: usize,
}

impl Build<'_> {
    fn load(&mut self, path: &str) -> Result<(), MeshError> {
        if !self.parts.contains_key(path) {
            let text = self.package.part(path)?.ok_or_else(|| broken(path, "a part of the package"))?;
            self.parts.insert(path.to_owned(), ModelPart::parse(path, &text)?);
        }
        Ok(())
    }

    /// Adds an object that is named in the part `user`, with all that it consists of.
    fn add(
        &mut self,
        user: &str,
        instance: &Instance,
        outer: &Transform,
        depth: usize,
    ) -> Result<(), MeshError> {
        let path = instance.path.as_deref().unwrap_or(user);
        let factor = self.parts.get(user).map_or(1.0, |part| part.unit.millimetres());
        self.load(path)?;
        self.instances += 1;
        if depth > DEEPEST || self.instances > MOST_INSTANCES {
            return Err(broken(path, "objects that consist of at most 1,000,000 others, 64 deep"));
        }
        let transform = instance.transform.with_shift_times(factor).then(outer);
        let missing = || broken(path, "an object of every id that is used");
        let part = self.parts.get(path).ok_or_else(missing)?;
        let object = part.objects.get(&instance.object).ok_or_else(missing)?;
        if !object.is_printed {
            self.aids += 1;
            return Ok(());
        }
        let first = self.soup.vertices.len();
        let count = first + object.vertices.len();
        if u32::try_from(count).is_err()
            || self.soup.triangles.len() + object.triangles.len() > MOST_TRIANGLES
        {
            return Err(MeshError::TooMany { count: count.max(3 * MOST_TRIANGLES) });
        }
        let factor = part.unit.millimetres();
        let place = |vertex: &[f64; 3]| transform.apply(vertex.map(|value| value * factor));
        self.soup.vertices.extend(object.vertices.iter().map(place));
        for corners in &object.triangles {
            if let Some(&vertex) = corners.iter().find(|&&corner| corner as usize >= object.vertices.len()) {
                return Err(MeshError::NoSuchVertex { triangle: self.soup.triangles.len(), vertex });
            }
            let [a, b, c] = corners.map(|corner| first as u32 + corner);
            self.soup.triangles.push(if transform.mirrors() { [a, c, b] } else { [a, b, c] });
        }
        let (path, components) = (path.to_owned(), object.components.clone());
        for component in &components {
            self.add(&path, component, &transform, depth + 1)?;
        }
        Ok(())
    }
}
