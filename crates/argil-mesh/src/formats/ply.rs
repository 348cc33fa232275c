//! PLY: a header that says what follows, and numbers as text or in binary.

use crate::formats::words::Words;
use crate::{MeshError, Soup};

/// The most properties that elements may have together: more are no model.
const MOST_PROPERTIES: usize = 4096;

/// The triangles of a PLY file: text, or binary with the least or the greatest byte first.
///
/// Elements `vertex` (with `x`, `y`, `z`) and `face` (with a list `vertex_indices` or `vertex_index`) are read, in any order; all
/// others are skipped. A face with more than three corners becomes a fan. PLY has no units.
///
/// # Errors
/// [`MeshError::Unreadable`] where the file does not follow its header, with the line where it is text, and
/// [`MeshError::Unsupported`] for triangle strips.
///
/// # Complexity
/// Linear in the length of the file, whatever its header declares.
///
/// # Example
/// ```
/// let text = b"ply
/// format ascii 1.0
/// element vertex 3
/// property float x
/// property float y
/// property float z
/// element face 1
/// property list uchar int vertex_indices
/// end_header
/// 0 0 0
/// 9 0 0
/// 0 9 0
/// 3 0 1 2
/// ";
/// assert_eq!(argil_mesh::ply(text)?.triangles, [[0, 1, 2]]);
/// # Ok::<(), argil_mesh::MeshError>(())
/// ```
pub fn ply(bytes: &[u8]) -> Result<Soup, MeshError> {
    if bytes.is_empty() {
        return Err(MeshError::Empty);
    }
    let (header, words) = Header::read(bytes)?;
    if header.elements.iter().any(|element| element.kind == ElementKind::Strips) {
        return Err(MeshError::Unsupported { what: "triangle strips: export triangles".to_owned() });
    }
    match header.encoding {
        Encoding::Text => header.soup(&mut Text { words }),
        Encoding::LeastFirst => header.soup(&mut Binary { rest: words.rest_of_text(), swaps: false }),
        Encoding::GreatestFirst => header.soup(&mut Binary { rest: words.rest_of_text(), swaps: true }),
    }
}

#[derive(Clone, Copy)]
enum Encoding {
    Text,
    LeastFirst,
    GreatestFirst,
}

#[derive(Clone, Copy, PartialEq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }
}

#[derive(Clone, Copy, PartialEq)]
enum ElementKind {
    Vertices,
    Faces,
    Strips,
    Other,
}

#[derive(Clone, Copy)]
enum Use {
    /// A coordinate of a vertex.
    Axis(usize),
    /// The corners of a face.
    Corners,
    Skipped,
}

struct Property {
    scalar: Scalar,
    /// The type of the count, where the property is a list.
    count: Option<Scalar>,
    is_for: Use,
}

struct Element {
    kind: ElementKind,
    count: u64,
    properties: Vec<Property>,
}

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
}

impl Header {
    fn read(bytes: &[u8]) -> Result<(Self, Words<'_>), MeshError> {
        let mut words = Words::new(bytes);
        words.next_line();
        if words.next_on_line() != Some(b"ply") {
            return Err(words.expected("`ply`"));
        }
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut properties = 0;
        loop {
            if !words.next_line() {
                return Err(words.expected("`end_header`"));
            }
            let Some(word) = words.next_on_line() else { continue };
            match word {
                b"format" => encoding = Some(read_encoding(&mut words)?),
                b"element" => elements.push(read_element(&mut words)?),
                b"property" => {
                    properties += 1;
                    let Some(element) = elements.last_mut().filter(|_| properties <= MOST_PROPERTIES) else {
                        return Err(words
                            .expected("an element before its properties, and no more than 4096 of these"));
                    };
                    element.properties.push(read_property(&mut words, element.kind)?);
                }
                b"end_header" => break,
                b"comment" | b"obj_info" => {}
                _ => return Err(words.expected("`element`, `property`, `comment` or `end_header`")),
            }
        }
        let encoding = encoding.ok_or(words.expected("a line with the `format`"))?;
        Ok((Self { encoding, elements }, words))
    }

    fn soup(&self, values: &mut impl Values) -> Result<Soup, MeshError> {
        let mut soup = Soup::default();
        let mut corners = Vec::new();
        for element in self.elements.iter().filter(|element| !element.properties.is_empty()) {
            for _ in 0..element.count {
                let mut place = [0.0; 3];
                corners.clear();
                for property in &element.properties {
                    let length = match property.count {
                        Some(count) => whole(values, count)?,
                        None => 1,
                    };
                    for _ in 0..length {
                        match property.is_for {
                            Use::Axis(axis) => place[axis] = values.next(property.scalar)?,
                            Use::Corners => corners.push(whole(values, property.scalar)?),
                            Use::Skipped => drop(values.next(property.scalar)?),
                        }
                    }
                }
                match element.kind {
                    ElementKind::Vertices => soup.vertices.push(place),
                    ElementKind::Faces if corners.len() >= 3 => {
                        // There are three corners at least.
                        soup.triangles
                            .extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
                    }
                    _ => {}
                }
            }
        }
        Ok(soup)
    }
}

fn read_encoding(words: &mut Words<'_>) -> Result<Encoding, MeshError> {
    match words.next_on_line() {
        Some(b"ascii") => Ok(Encoding::Text),
        Some(b"binary_little_endian") => Ok(Encoding::LeastFirst),
        Some(b"binary_big_endian") => Ok(Encoding::GreatestFirst),
        _ => Err(words.expected("`ascii`, `binary_little_endian` or `binary_big_endian`")),
    }
}

fn read_element(words: &mut Words<'_>) -> Result<Element, MeshError> {
    let kind = match words.next_on_line() {
        Some(b"vertex") => ElementKind::Vertices,
        Some(b"face") => ElementKind::Faces,
        Some(b"tristrips") => ElementKind::Strips,
        _ => ElementKind::Other,
    };
    let count = words.next_on_line().and_then(|word| std::str::from_utf8(word).ok());
    let count = count.and_then(|word| word.parse().ok()).ok_or(words.expected("the number of elements"))?;
    Ok(Element { kind, count, properties: Vec::new() })
}

fn read_property(words: &mut Words<'_>, of: ElementKind) -> Result<Property, MeshError> {
    const TYPE: &str = "the type of a property";
    let first = words.next_on_line();
    let (count, scalar) = if first == Some(b"list") {
        let count = words.next_on_line().and_then(Scalar::of).ok_or(words.expected(TYPE))?;
        (Some(count), words.next_on_line())
    } else {
        (None, first)
    };
    let scalar = scalar.and_then(Scalar::of).ok_or(words.expected(TYPE))?;
    let name = words.next_on_line().ok_or(words.expected("the name of a property"))?;
    let is_for = match (of, count.is_some(), name) {
        (ElementKind::Vertices, false, b"x") => Use::Axis(0),
        (ElementKind::Vertices, false, b"y") => Use::Axis(1),
        (ElementKind::Vertices, false, b"z") => Use::Axis(2),
        (ElementKind::Faces, true, b"vertex_indices" | b"vertex_index") => Use::Corners,
        _ => Use::Skipped,
    };
    Ok(Property { scalar, count, is_for })
}

/// A count or an index.
fn whole(values: &mut impl Values, scalar: Scalar) -> Result<u32, MeshError> {
    let value = values.next(scalar)?;
    let is_whole = value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0;
    if is_whole { Ok(value as u32) } else { Err(values.expected("a whole number that is not negative")) }
}

/// Numbers one after the other.
trait Values {
    fn next(&mut self, scalar: Scalar) -> Result<f64, MeshError>;
    fn expected(&self, expected: &'static str) -> MeshError;
}

struct Text<'a> {
    words: Words<'a>,
}

impl Values for Text<'_> {
    fn next(&mut self, _: Scalar) -> Result<f64, MeshError> {
        self.words.number()
    }

    fn expected(&self, expected: &'static str) -> MeshError {
        self.words.expected(expected)
    }
}

struct Binary<'a> {
    rest: &'a [u8],
    /// Whether the greatest byte comes first.
    swaps: bool,
}

impl Binary<'_> {
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], MeshError> {
        let Some((bytes, rest)) = self.rest.split_first_chunk::<N>() else {
            return Err(self.expected("as many numbers as the header declares"));
        };
        self.rest = rest;
        let mut bytes = *bytes;
        if self.swaps {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl Values for Binary<'_> {
    fn next(&mut self, scalar: Scalar) -> Result<f64, MeshError> {
        Ok(match scalar {
            Scalar::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Scalar::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Scalar::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Scalar::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Scalar::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Scalar::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Scalar::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Scalar::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }

    fn expected(&self, expected: &'static str) -> MeshError {
        MeshError::Unreadable { line: 0, expected }
    }
}
