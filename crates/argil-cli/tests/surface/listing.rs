//! What a crate shows: its public items, by name, as their source has them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::source::{Item, angle, bare, items, parts};

/// The lines of a crate's surface. A name has its definition first, then its functions, then the traits that it implements.
pub(crate) fn listing(folder: &Path) -> String {
    let mut surface = Surface::default();
    let root = folder.join("src/lib.rs");
    surface.exports(&parsed(&root), "");
    surface.module(&root, &root.with_file_name(""), "");
    let lines = surface.lines.into_values().flatten();
    lines.flat_map(|(_, text)| text.into_iter().chain([String::new()])).collect::<Vec<_>>().join("\n")
}

#[derive(Default)]
struct Surface {
    /// What is exported from a private module: name to the path that it has outside.
    exported: BTreeMap<String, String>,
    modules: BTreeSet<String>,
    lines: BTreeMap<String, BTreeSet<(u8, Vec<String>)>>,
}

fn parsed(file: &Path) -> Vec<Item> {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let tested =
        |item: &Item| item.attributes.iter().any(|a| a.contains("cfg(test)") || a.contains("cfg(doctest)"));
    items(&bare(&text)).into_iter().filter(|item| !tested(item)).collect()
}

/// The attributes that a user notices.
fn noticed(item: &Item) -> String {
    let told = ["#[must_use", "#[non_exhaustive", "#[derive", "#[cfg_attr", "#[cfg(feature", "#[deprecated"];
    let shown = item.attributes.iter().filter(|a| told.iter().any(|word| a.starts_with(word)));
    shown.map(|attribute| format!("{attribute} ")).collect()
}

/// The first identifier of a text.
fn name(text: &str) -> String {
    text.chars().skip_while(|c| !c.is_alphabetic()).take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

/// What follows a word in the head of an item.
fn after<'a>(head: &'a str, word: &str) -> Option<&'a str> {
    head.split_once(word).map(|(_, rest)| rest)
}

/// The head of an `impl` without its own parameters.
fn without_parameters(head: &str) -> String {
    let code: Vec<char> = head.chars().skip("impl".len()).collect();
    let from = if code.first() == Some(&'<') { angle(&code, 0) } else { 0 };
    code[from..].iter().collect::<String>().trim().to_owned()
}

impl Surface {
    /// What a `lib.rs` or a public module gives on.
    fn exports(&mut self, items: &[Item], path: &str) {
        for item in items {
            let Some(used) = item.head.strip_prefix("pub use ") else { continue };
            let (module, list) = match used.split_once('{') {
                Some((module, list)) => (module, list.trim_end_matches(['}', ' '])),
                None => used.rsplit_once("::").map_or(("", used), |(module, one)| (module, one)),
            };
            if module.starts_with("argil_") || used.starts_with("argil_") || used.starts_with("glam") {
                self.add(used, 0, vec![item.head.clone()]);
                continue;
            }
            for part in parts(list) {
                self.exported.insert(name(&part), format!("{path}{part}"));
            }
        }
    }

    fn add(&mut self, key: &str, rank: u8, text: Vec<String>) {
        self.lines.entry(key.to_owned()).or_default().insert((rank, text));
    }

    /// The path of a name outside, if it has one: that of its export, or that of the public module it stands in.
    fn path(&self, name: &str, public: &str) -> Option<String> {
        let whole = format!("{public}{name}");
        let known = self.exported.get(name).cloned();
        known.or_else(|| (!public.is_empty() && self.modules.contains(&whole)).then_some(whole))
    }

    /// The items of a file and of the modules below it. `public` is the path of a public module, or empty.
    fn module(&mut self, file: &Path, below: &Path, public: &str) {
        let found = parsed(file);
        for item in found.iter().filter(|item| !public.is_empty() && item.head.starts_with("pub ")) {
            let kind = ["struct ", "enum ", "trait ", "fn ", "const ", "type "]
                .into_iter()
                .find_map(|k| after(&item.head, k));
            self.modules.extend(kind.map(|rest| format!("{public}{}", name(rest))));
        }
        for item in &found {
            if let Some(module) = after(&item.head, "mod ").filter(|_| item.body.is_none()) {
                let inner = submodule(below, module);
                let path =
                    if item.head.starts_with("pub ") { format!("{public}{module}::") } else { String::new() };
                if !path.is_empty() {
                    self.exports(&parsed(&inner), &path);
                }
                self.module(&inner, &below.join(module), &path);
            } else if item.head.starts_with("impl") {
                self.implementation(item, public);
            } else if item.head.starts_with("pub ") {
                self.definition(item, public);
            }
        }
    }

    fn definition(&mut self, item: &Item, public: &str) {
        let kinds = ["fn ", "struct ", "enum ", "trait ", "const ", "static ", "type "];
        let Some((kind, rest)) = kinds
            .into_iter()
            .filter_map(|k| Some((k, after(&item.head, k)?)))
            .min_by_key(|(_, rest)| std::cmp::Reverse(rest.len()))
        else {
            return;
        };
        let Some(path) = self.path(&name(rest), public) else { return };
        let valued = ["const ", "static ", "type "].contains(&kind);
        let head = if valued { unvalued(&item.head) } else { item.head.clone() };
        let module = path.rsplit_once("::").map_or(String::new(), |(module, _)| format!("{module}: "));
        let mut text = vec![format!("{module}{}{head}", noticed(item))];
        let body = item.body.as_deref().unwrap_or_default();
        match kind {
            "struct " => {
                let fields = parts(body).into_iter().filter(|field| field.starts_with("pub "));
                text.extend(fields.map(|field| format!("    {field}")));
            }
            "enum " => text
                .extend(parts(body).into_iter().map(|variant| format!("    {}", inner_attributes(&variant)))),
            "trait " => {
                text.extend(items(body).iter().map(|inner| format!("    {}{}", noticed(inner), inner.head)));
            }
            _ => {}
        }
        self.add(&path, 0, text);
    }

    fn implementation(&mut self, item: &Item, public: &str) {
        let whole = without_parameters(&item.head);
        let (of, subject) = match whole.split_once(" for ") {
            Some((of, subject)) => (Some(of), subject.to_owned()),
            None => (None, whole),
        };
        let Some(path) = self.path(&name(&subject), public) else { return };
        if of.is_some() {
            self.add(&path, 2, vec![format!("{}{}", noticed(item), item.head)]);
            return;
        }
        for inner in items(item.body.as_deref().unwrap_or_default()) {
            if inner.head.starts_with("pub ") {
                let head = unvalued(inner.head.trim_start_matches("pub "));
                self.add(&path, 1, vec![format!("{}{path}: {head}", noticed(&inner))]);
            }
        }
    }
}

/// The head of a constant without its value; that of anything else as it is.
fn unvalued(head: &str) -> String {
    let valued = ["const ", "pub const ", "static ", "pub static ", "type ", "pub type "];
    let is = valued.iter().any(|word| head.starts_with(word)) && !head.contains("const fn ");
    head.split(" = ").next().filter(|_| is).unwrap_or(head).to_owned()
}

/// A variant without the attributes of its fields.
fn inner_attributes(variant: &str) -> String {
    let mut text = variant.to_owned();
    while let Some(from) = text.find("#[") {
        let end = text[from..].find(']').map_or(text.len(), |k| from + k + 1);
        text.replace_range(from..end, "");
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace("( ", "(")
}

fn submodule(below: &Path, module: &str) -> PathBuf {
    let flat = below.join(format!("{module}.rs"));
    if flat.is_file() { flat } else { below.join(module).join("mod.rs") }
}
