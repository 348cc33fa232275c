use crate::{Mesh, MeshError};
use std::io::Cursor;

const HEADER: usize = 84;
const RECORD: usize = 50;

/// A welded mesh from the bytes of an STL file, binary or text.
///
/// A file whose length fits the triangle count at byte 80 is binary, whatever its header says:
/// many binary files begin with `solid`. Otherwise a file that begins with `solid` and
/// goes on as text is read as text. A text file may hold several solids; all
/// become one mesh. Stored normals are ignored: the corners' order tells the outside, and
/// exporters leave normals zero or undefined.
///
/// # Errors
/// Every fault is a [`MeshError`]; a file is never read in part.
///
/// # Complexity
/// Linear in the length of the file.
///
/// # Example
/// ```
/// use argil_mesh::{read_stl, MeshError};
/// let mut bytes = vec![0; 84];
/// bytes[80] = 2; // declares two triangles and holds none
/// assert_eq!(read_stl(&bytes), Err(MeshError::Truncated { declared: 2, present: 0, extra: 0 }));
/// ```
pub fn read_stl(bytes: &[u8]) -> Result<Mesh, MeshError> {
    if bytes.is_empty() {
        return Err(MeshError::Empty);
    }
    let declared = bytes.get(80..HEADER).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    let body = bytes.len().saturating_sub(HEADER);
    match declared {
        Some(count) if body as u64 == u64::from(count) * RECORD as u64 => binary(bytes),
        _ if is_text(bytes) => text(bytes),
        Some(count) => Err(MeshError::Truncated {
            declared: count.into(),
            present: (body / RECORD) as u64,
            extra: (body % RECORD) as u64,
        }),
        None => Err(MeshError::Unreadable { line: 0, expected: "an STL header of 84 bytes, or `solid`" }),
    }
}

/// Binary bodies hold zero bytes (small exponents, the attribute words), text never does.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let begins = start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    begins && !bytes.iter().take(64 * RECORD).any(|&byte| byte == 0)
}

fn binary(bytes: &[u8]) -> Result<Mesh, MeshError> {
    // The reader takes a header that begins with `solid` for text, so it gets a blank one.
    let mut blank = bytes.to_vec();
    blank[..80].fill(b' ');
    let unreadable = MeshError::Unreadable { line: 0, expected: "a binary STL body" };
    let mut reader = Cursor::new(blank);
    let triangles = stl_io::create_stl_reader(&mut reader).map_err(|_| unreadable.clone())?;
    let mut soup = Soup::default();
    for triangle in triangles {
        let triangle = triangle.map_err(|_| unreadable.clone())?;
        soup.push(triangle.vertices.map(|vertex| vertex.0.map(f64::from)))?;
    }
    soup.into_mesh()
}

/// Reads text word by word, since line breaks within a facet are as common as the standard layout.
///
/// `stl_io` would stop at the first `endsolid` and lose every further body, and it refuses
/// facets whose normal is not a number although nobody needs it.
fn text(bytes: &[u8]) -> Result<Mesh, MeshError> {
    let mut soup = Soup::default();
    let mut words = Words { lines: bytes.split(|&byte| byte == b'\n'), line: 0, rest: &[] };
    let mut solids = 0;
    loop {
        match words.next() {
            None if solids > 0 => return soup.into_mesh(),
            Some(word) if word.eq_ignore_ascii_case(b"solid") => words.skip_line(),
            _ => return Err(words.expected("`solid`")),
        }
        solids += 1;
        loop {
            let word = words.next().ok_or(words.expected("`facet` or `endsolid`"))?;
            if word.eq_ignore_ascii_case(b"endsolid") {
                words.skip_line();
                break;
            }
            if !word.eq_ignore_ascii_case(b"facet") {
                return Err(words.expected("`facet` or `endsolid`"));
            }
            words.keyword(b"normal", "`normal`")?;
            for _ in 0..3 {
                words.number()?;
            }
            words.keyword(b"outer", "`outer loop`")?;
            words.keyword(b"loop", "`outer loop`")?;
            let mut corners = [[0.0; 3]; 3];
            for corner in &mut corners {
                words.keyword(b"vertex", "`vertex`")?;
                for value in corner.iter_mut() {
                    *value = words.number()?;
                }
            }
            words.keyword(b"endloop", "`endloop`")?;
            words.keyword(b"endfacet", "`endfacet`")?;
            soup.push(corners)?;
        }
    }
}

struct Words<'a, L> {
    lines: L,
    line: usize,
    rest: &'a [u8],
}

impl<'a, L: Iterator<Item = &'a [u8]>> Words<'a, L> {
    fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            self.rest = self.rest.trim_ascii();
            if !self.rest.is_empty() {
                let end = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
                let (word, rest) = self.rest.split_at(end);
                self.rest = rest;
                return Some(word);
            }
            self.rest = self.lines.next()?;
            self.line += 1;
        }
    }

    /// The rest of a `solid` or `endsolid` line is a free name, in any encoding.
    fn skip_line(&mut self) {
        self.rest = &[];
    }

    fn expected(&self, expected: &'static str) -> MeshError {
        MeshError::Unreadable { line: self.line, expected }
    }

    fn keyword(&mut self, keyword: &[u8], name: &'static str) -> Result<(), MeshError> {
        match self.next() {
            Some(word) if word.eq_ignore_ascii_case(keyword) => Ok(()),
            _ => Err(self.expected(name)),
        }
    }

    /// Not-a-number and infinity are numbers here; where they matter they are refused as such.
    fn number(&mut self) -> Result<f64, MeshError> {
        let word = self.next().and_then(|word| std::str::from_utf8(word).ok());
        word.and_then(|word| word.parse().ok()).ok_or(self.expected("a number"))
    }
}

/// Triangles that share nothing yet.
#[derive(Default)]
struct Soup {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Soup {
    fn push(&mut self, corners: [[f64; 3]; 3]) -> Result<(), MeshError> {
        let first = u32::try_from(self.vertices.len() + 3)
            .map_err(|_| MeshError::TooMany { count: self.vertices.len() + 3 })?
            - 3;
        self.vertices.extend(corners);
        self.triangles.push([first, first + 1, first + 2]);
        Ok(())
    }

    fn into_mesh(self) -> Result<Mesh, MeshError> {
        Mesh::new(self.vertices, self.triangles)
    }
}
