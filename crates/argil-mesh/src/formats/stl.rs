use crate::formats::words::Words;
use crate::{Mesh, MeshError, Remark, Soup};

const HEADER: usize = 84;
const RECORD: usize = 50;

/// A welded mesh from the bytes of an STL file, binary or text, a unit of which is a millimetre.
///
/// # Errors
/// Those of [`stl`], and of [`Mesh::new`].
///
/// # Complexity
/// O(n log n) in the triangles.
///
/// # Example
/// ```
/// use argil_mesh::{read_stl, MeshError};
/// let mut bytes = vec![0; 84];
/// bytes[80] = 2; // declares two triangles and holds none
/// assert_eq!(read_stl(&bytes), Err(MeshError::Truncated { declared: 2, present: 0, extra: 0 }));
/// ```
pub fn read_stl(bytes: &[u8]) -> Result<Mesh, MeshError> {
    stl(bytes)?.welded().map(|(mesh, _)| mesh)
}

/// The triangles of an STL file, binary or text.
///
/// A file whose length fits the triangle count at byte 80 is binary, whatever its header says:
/// many binary files begin with `solid`. Otherwise a file that begins with `solid` and
/// goes on as text is read as text. A text file may hold several solids; all
/// become one soup. Lines end with a line feed, a carriage return or both. Stored normals are ignored: the corners'
/// order tells the outside, and exporters leave normals zero or undefined.
///
/// A binary file in which more whole triangles follow than its header declares is read to its end, which is a
/// [`Remark::Count`]; so is one that declares the largest number there is.
///
/// # Errors
/// Every fault is a [`MeshError`]; a file is never read in part.
///
/// # Complexity
/// Linear in the length of the file.
pub fn stl(bytes: &[u8]) -> Result<Soup, MeshError> {
    if bytes.is_empty() {
        return Err(MeshError::Empty);
    }
    let declared = bytes.get(80..HEADER).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    let body = bytes.get(HEADER..).unwrap_or_default();
    let (present, extra) = ((body.len() / RECORD) as u64, (body.len() % RECORD) as u64);
    match declared {
        Some(count) if extra == 0 && u64::from(count) == present => binary(body, None),
        _ if is_text(bytes) => text(bytes),
        Some(count) if extra == 0 && (u64::from(count) < present || (count == u32::MAX && present > 0)) => {
            binary(body, Some(Remark::Count { declared: count.into(), present }))
        }
        Some(count) => Err(MeshError::Truncated { declared: count.into(), present, extra }),
        None => Err(MeshError::Unreadable { line: 0, expected: "an STL header of 84 bytes, or `solid`" }),
    }
}

/// Whether the length of the file is that of a binary STL with as many triangles as its header declares.
pub(crate) fn is_whole_binary(bytes: &[u8]) -> bool {
    let declared = bytes.get(80..HEADER).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    declared.is_some_and(|count| (bytes.len() - HEADER) as u64 == u64::from(count) * RECORD as u64)
}

/// Binary bodies hold zero bytes (small exponents, the attribute words), text never does.
fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let begins = start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    begins && !bytes.iter().take(64 * RECORD).any(|&byte| byte == 0)
}

/// Records of a normal, three corners and two bytes that nobody needs.
fn binary(body: &[u8], remark: Option<Remark>) -> Result<Soup, MeshError> {
    let mut soup = Soup { remarks: remark.into_iter().collect(), ..Soup::default() };
    soup.vertices.reserve_exact(3 * (body.len() / RECORD));
    soup.triangles.reserve_exact(body.len() / RECORD);
    for record in body.chunks_exact(RECORD) {
        let mut corners = [[0.0; 3]; 3];
        for (value, bytes) in corners.iter_mut().flatten().zip(record[12..].chunks_exact(4)) {
            *value = f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]).into();
        }
        soup.push(corners)?;
    }
    Ok(soup)
}

/// Reads text word by word, since line breaks within a facet are as common as the standard layout.
///
/// A file may go on after an `endsolid`, and normals that are not numbers do not matter.
fn text(bytes: &[u8]) -> Result<Soup, MeshError> {
    let mut soup = Soup::default();
    let mut words = Words::new(bytes);
    let mut solids = 0;
    loop {
        match words.next() {
            None if solids > 0 => return Ok(soup),
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
