//! A page whose tables are replaced and whose text is kept.

use std::fs;
use std::path::Path;

use crate::Outcome;

/// A table of text.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    head: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn new(head: &[&'static str]) -> Self {
        Self { head: head.to_vec(), rows: Vec::new() }
    }

    /// Adds a row; one that is short gets empty cells.
    pub(crate) fn row(&mut self, mut cells: Vec<String>) {
        cells.resize(self.head.len(), String::new());
        self.rows.push(cells);
    }

    /// As Markdown, the first column to the left and the others to the right.
    fn markdown(&self) -> String {
        let line = |cells: &[&str]| format!("| {} |\n", cells.join(" | "));
        let mut text = line(&self.head);
        text.push_str(&format!("|---|{}\n", "--:|".repeat(self.head.len().saturating_sub(1))));
        for row in &self.rows {
            text.push_str(&line(&row.iter().map(String::as_str).collect::<Vec<_>>()));
        }
        text
    }
}

/// A page in Markdown, in which `<!-- table NAME -->` and `<!-- end -->` enclose each table.
#[derive(Debug)]
pub(crate) struct Document {
    text: String,
}

impl Document {
    pub(crate) fn read(path: &Path) -> Outcome<Self> {
        Ok(Self { text: fs::read_to_string(path)? })
    }

    /// Puts a table where the page has a place for it. One without a row leaves what is there.
    pub(crate) fn put(&mut self, name: &str, table: &Table) {
        let opening = format!("<!-- table {name} -->\n");
        let Some(begin) = self.text.find(&opening).map(|at| at + opening.len()) else { return };
        let Some(length) = self.text[begin..].find("<!-- end -->") else { return };
        if !table.rows.is_empty() {
            self.text.replace_range(begin..begin + length, &table.markdown());
        }
    }

    pub(crate) fn write(&self, path: &Path) -> Outcome<()> {
        Ok(fs::write(path, &self.text)?)
    }
}
