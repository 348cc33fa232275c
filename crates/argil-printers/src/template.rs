//! Code with names in braces.

use crate::ProfileError;

/// Puts values in the place of names in braces: `G1 Z{safe_z}`. Doubled braces stand for themselves. In comments, from a
/// semicolon to the line's end, braces mean the same.
///
/// # Errors
/// A name that is not among the values, or a brace without its other half.
///
/// # Example
/// ```
/// use argil_printers::render;
/// let values = [("safe_z", "12.5".to_owned())];
/// assert_eq!(render("G1 Z{safe_z} ; {{high}}", &values)?, "G1 Z12.5 ; {high}");
/// assert!(render("G1 Z{height}", &values).unwrap_err().to_string().contains("safe_z"));
/// # Ok::<(), argil_printers::ProfileError>(())
/// ```
pub fn render(template: &str, values: &[(&str, String)]) -> Result<String, ProfileError> {
    let mut text = String::with_capacity(template.len());
    let mut rest = template;
    while let Some(at) = rest.find(['{', '}']) {
        let (before, brace) = rest.split_at(at);
        text.push_str(before);
        let open = || ProfileError::Brace { at: brace.lines().next().unwrap_or_default().to_owned() };
        if brace.starts_with("{{") || brace.starts_with("}}") {
            // It begins with two braces, each one byte long.
            text.push_str(&brace[..1]);
            rest = &brace[2..];
            continue;
        }
        let inside = brace.strip_prefix('{').ok_or_else(open)?;
        let (name, after) = inside.split_once('}').ok_or_else(open)?;
        let value = values.iter().find(|(known, _)| *known == name.trim()).ok_or_else(|| {
            let known: Vec<String> = values.iter().map(|(known, _)| format!("{{{known}}}")).collect();
            ProfileError::Variable { name: name.to_owned(), known: known.join(", ") }
        })?;
        text.push_str(&value.1);
        rest = after;
    }
    text.push_str(rest);
    Ok(text)
}
