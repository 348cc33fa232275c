//! Rust source as items: as much of its grammar as public signatures need.

/// An item: its attributes, what stands before its body or end, and the body.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    pub(crate) attributes: Vec<String>,
    pub(crate) head: String,
    pub(crate) body: Option<String>,
}

/// The items of a file, or of a body.
pub(crate) fn items(code: &str) -> Vec<Item> {
    let code: Vec<char> = code.chars().collect();
    let (mut found, mut attributes, mut at) = (Vec::new(), Vec::new(), 0);
    while at < code.len() {
        if code[at].is_whitespace() {
            at += 1;
        } else if code[at] == '#' {
            let open = (at..code.len()).find(|&k| code[k] == '[').expect("an attribute has brackets");
            let end = closing(&code, open);
            let inner = code[at..open].contains(&'!');
            if !inner {
                attributes.push(spaced(&code[at..end]));
            }
            at = end;
        } else {
            let (head, body, end) = one(&code, at);
            found.push(Item { attributes: std::mem::take(&mut attributes), head, body });
            at = end;
        }
    }
    found
}

/// The parts of a list between commas, without their attributes.
pub(crate) fn parts(list: &str) -> Vec<String> {
    let code: Vec<char> = list.chars().collect();
    let (mut found, mut at, mut start) = (Vec::new(), 0, 0);
    while at < code.len() {
        match code[at] {
            // An attribute is no part of what is told.
            '#' if code.get(at + 1) == Some(&'[') => {
                at = closing(&code, at + 1);
                start = at;
                continue;
            }
            '(' | '[' | '{' => {
                at = closing(&code, at);
                continue;
            }
            // Types with several parameters have commas of their own.
            '<' => at = angle(&code, at) - 1,
            ',' => {
                found.push(spaced(&code[start..at]));
                start = at + 1;
            }
            _ => {}
        }
        at += 1;
    }
    found.push(spaced(&code[start..]));
    found.retain(|part| !part.is_empty());
    found
}

/// One item from `at` on, and where it ends.
fn one(code: &[char], at: usize) -> (String, Option<String>, usize) {
    let word: String = code[at..].iter().take(24).collect();
    let word = word.strip_prefix("pub ").unwrap_or(&word);
    let valued = ["use ", "static ", "type "].iter().any(|kind| word.starts_with(kind))
        || (word.starts_with("const ") && !word.starts_with("const fn"));
    let mut k = at;
    while k < code.len() {
        match code[k] {
            '(' | '[' => k = closing(code, k),
            ';' => return (spaced(&code[at..k]), None, k + 1),
            // A variant or a field of a list that is read as items.
            '{' if valued => k = closing(code, k),
            '{' => {
                let end = closing(code, k);
                let body = code[k + 1..end - 1].iter().collect();
                return (spaced(&code[at..k]), Some(body), end);
            }
            _ => k += 1,
        }
    }
    (spaced(&code[at..]), None, code.len())
}

/// The index behind the bracket that closes the one at `open`.
fn closing(code: &[char], open: usize) -> usize {
    let mut depth = 0;
    for (k, c) in code.iter().enumerate().skip(open) {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return k + 1;
        }
    }
    code.len()
}

/// The index behind the angle bracket that closes the one at `open`; that of an arrow closes none.
pub(crate) fn angle(code: &[char], open: usize) -> usize {
    let mut depth = 0;
    for (k, c) in code.iter().enumerate().skip(open) {
        match c {
            '<' => depth += 1,
            '>' if k == 0 || !['-', '='].contains(&code[k - 1]) => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return k + 1;
        }
    }
    code.len()
}

/// One line of it, with one space wherever there was any, and none that only a broken line needs.
fn spaced(code: &[char]) -> String {
    let text: String = code.iter().collect();
    let words: Vec<&str> = text.split_whitespace().collect();
    let line = words.join(" ");
    let broken =
        [("( ", "("), (", )", ")"), (" )", ")"), ("< ", "<"), (", >", ">"), (", }", " }"), (",}", " }")];
    broken.iter().fold(line, |line, (from, to)| line.replace(from, to))
}

/// The source without comments, and with nothing in its literals but plain words.
pub(crate) fn bare(source: &str) -> String {
    let code: Vec<char> = source.chars().collect();
    let starts = |k: usize, word: &str| word.chars().enumerate().all(|(j, c)| code.get(k + j) == Some(&c));
    let (mut out, mut k) = (String::with_capacity(source.len()), 0);
    while k < code.len() {
        let raw = ["r\"", "r#\"", "r##\""].into_iter().find(|open| starts(k, open));
        let word_before = k > 0 && (code[k - 1].is_alphanumeric() || code[k - 1] == '_');
        if starts(k, "//") {
            k = (k..code.len()).find(|&j| code[j] == '\n').unwrap_or(code.len());
        } else if let (Some(open), false) = (raw, word_before) {
            let close = format!("\"{}", "#".repeat(open.len() - 2));
            k = (k + open.len()..code.len()).find(|&j| starts(j, &close)).unwrap_or(code.len()) + close.len();
            out.push_str("\"\"");
        } else if code[k] == '"' {
            let from = k + 1;
            k = from;
            while k < code.len() && code[k] != '"' {
                k += if code[k] == '\\' { 2 } else { 1 };
            }
            let inner = &code[from..k.min(code.len())];
            k += 1;
            // Names of features are kept, and nothing that would be read as code.
            let plain = inner.iter().all(|c| c.is_alphanumeric() || *c == '-');
            out.push('"');
            out.extend(inner.iter().filter(|_| plain));
            out.push('"');
        } else if code[k] == '\'' && (starts(k + 1, "\\") || starts(k + 2, "'")) {
            // The quote itself may be the escaped one.
            k = (k + 3..code.len()).find(|&j| code[j] == '\'' || starts(k + 2, "'")).map_or(
                code.len(),
                |j| {
                    if starts(k + 2, "'") { k + 3 } else { j + 1 }
                },
            );
            out.push_str("''");
        } else {
            out.push(code[k]);
            k += 1;
        }
    }
    out
}
