//! Words of a text, line by line.

use crate::MeshError;

/// The words of a text in which lines end with a line feed, a carriage return or both.
pub(crate) struct Words<'a> {
    /// What follows the current line.
    text: &'a [u8],
    line: usize,
    /// What is left of the current line.
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        Self { text, line: 0, rest: &[] }
    }

    /// The next word, on whatever line.
    pub(crate) fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.next_on_line() {
                return Some(word);
            }
            if !self.next_line() {
                return None;
            }
        }
    }

    /// The next word of the current line.
    pub(crate) fn next_on_line(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest.trim_ascii_start();
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    /// Goes on to the next line; false at the end of the text.
    pub(crate) fn next_line(&mut self) -> bool {
        if self.text.is_empty() {
            return false;
        }
        let end =
            self.text.iter().position(|&byte| byte == b'\n' || byte == b'\r').unwrap_or(self.text.len());
        let (line, text) = self.text.split_at(end);
        self.rest = line;
        self.text = match text {
            [b'\r', b'\n', text @ ..] | [_, text @ ..] => text,
            [] => text,
        };
        self.line += 1;
        true
    }

    /// Leaves out the rest of the line: that of `solid` is a free name, in any encoding.
    pub(crate) fn skip_line(&mut self) {
        self.rest = &[];
    }

    /// Everything after the current line.
    pub(crate) fn rest_of_text(&self) -> &'a [u8] {
        self.text
    }

    pub(crate) fn expected(&self, expected: &'static str) -> MeshError {
        MeshError::Unreadable { line: self.line, expected }
    }

    pub(crate) fn keyword(&mut self, keyword: &[u8], name: &'static str) -> Result<(), MeshError> {
        match self.next() {
            Some(word) if word.eq_ignore_ascii_case(keyword) => Ok(()),
            _ => Err(self.expected(name)),
        }
    }

    /// Not-a-number and infinity are numbers here; where they matter they are refused as such.
    pub(crate) fn number(&mut self) -> Result<f64, MeshError> {
        let word = self.next();
        self.parsed(word)
    }

    pub(crate) fn parsed(&self, word: Option<&[u8]>) -> Result<f64, MeshError> {
        let word = word.and_then(|word| std::str::from_utf8(word).ok());
        word.and_then(|word| word.parse().ok()).ok_or(self.expected("a number"))
    }
}
