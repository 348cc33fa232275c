use crate::formats::words::Words;
use crate::{MeshError, Soup};

/// The triangles of a Wavefront OBJ file.
///
/// Positions (`v`) and faces (`f`) are read, with indices from either end; a face with more corners becomes a
/// fan, which cuts as the face does as long as it is flat. All objects and groups become one soup. Normals, textures, materials, lines and
/// points do not matter and are left out. OBJ has no units.
///
/// # Errors
/// [`MeshError::Unreadable`] with the line for what is no number or names no position, and [`MeshError::Unsupported`] for
/// curves and surfaces given by formulas.
///
/// # Complexity
/// Linear in the length of the file.
///
/// # Example
/// ```
/// let text = b"v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nf 1/1/1 2/2/1 3/3/1 -1/4/1\n";
/// let soup = argil_mesh::obj(text)?;
/// assert_eq!(soup.triangles, [[0, 1, 2], [0, 2, 3]]);
/// # Ok::<(), argil_mesh::MeshError>(())
/// ```
pub fn obj(bytes: &[u8]) -> Result<Soup, MeshError> {
    if bytes.is_empty() {
        return Err(MeshError::Empty);
    }
    let mut soup = Soup::default();
    let mut words = Words::new(bytes);
    while words.next_line() {
        let Some(word) = words.next_on_line() else { continue };
        match word {
            b"v" => {
                let mut place = [0.0; 3];
                for value in &mut place {
                    let word = words.next_on_line();
                    *value = words.parsed(word)?;
                }
                soup.vertices.push(place);
            }
            b"f" | b"fo" => face(&mut words, &mut soup)?,
            b"curv" | b"curv2" | b"surf" | b"cstype" => {
                return Err(MeshError::Unsupported {
                    what: "curves and surfaces given by formulas: export triangles".to_owned(),
                });
            }
            _ => {}
        }
    }
    Ok(soup)
}

/// A face as a fan about its first corner; it may go on after a line that ends with a backslash.
fn face(words: &mut Words<'_>, soup: &mut Soup) -> Result<(), MeshError> {
    const CORNER: &str = "the number of a position that was given before";
    let mut fan: Option<(u32, Option<u32>)> = None;
    let mut count = 0;
    while let Some(word) = words.next_on_line() {
        if word == b"\\" {
            if !words.next_line() {
                break;
            }
            continue;
        }
        let index = word.split(|&byte| byte == b'/').next().unwrap_or_default();
        let index = std::str::from_utf8(index).ok().and_then(|text| text.parse::<i64>().ok());
        let known = soup.vertices.len() as i64;
        let corner = match index {
            Some(index @ 1..) if index <= known => index - 1,
            Some(index @ ..=-1) if index >= -known => known + index,
            _ => return Err(words.expected(CORNER)),
        };
        let corner = u32::try_from(corner).map_err(|_| MeshError::TooMany { count: soup.vertices.len() })?;
        count += 1;
        fan = match fan {
            None => Some((corner, None)),
            Some((first, None)) => Some((first, Some(corner))),
            Some((first, Some(last))) => {
                soup.triangles.push([first, last, corner]);
                Some((first, Some(corner)))
            }
        };
    }
    if count < 3 { Err(words.expected("a face of at least three corners")) } else { Ok(()) }
}
