//! Reading position in the bytes of a mesh file; reads numbers as text or as bytes.

use std::path::Path;

use super::error::{FilePosition, MshError, MshProblem};

/// Reads a file front to back. Nothing here panics on any input.
#[derive(Debug, Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Whether numbers are little-endian bytes instead of text.
    pub binary: bool,
    /// Section being read, for messages.
    pub section: String,
    path: &'a Path,
}

impl<'a> Cursor<'a> {
    pub fn new(bytes: &'a [u8], path: &'a Path) -> Self {
        // Some editors put a byte-order mark before text.
        let at = if bytes.starts_with(&[0xEF, 0xBB, 0xBF]) { 3 } else { 0 };
        Self { bytes, at, binary: false, section: "start of file".into(), path }
    }

    /// Offset of the next byte.
    pub fn offset(&self) -> usize {
        self.at
    }

    /// Size of the file in bytes.
    pub fn length(&self) -> u64 {
        self.bytes.len() as u64
    }

    /// Error at the current position.
    pub fn error(&self, problem: MshProblem) -> MshError {
        self.error_at(self.at, problem)
    }

    /// Error at an earlier position.
    pub fn error_at(&self, offset: usize, problem: MshProblem) -> MshError {
        let offset = offset.min(self.bytes.len());
        let place = if self.binary {
            FilePosition::Byte(offset)
        } else {
            FilePosition::Line(1 + self.bytes[..offset].iter().filter(|&&b| b == b'\n').count())
        };
        MshError { path: self.path.to_owned(), section: self.section.clone(), place, problem }
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// Error: `expected` does not stand here.
    fn unexpected(&self, expected: &str) -> MshError {
        let found = match self.rest() {
            [] => "the end of the file".to_owned(),
            [b'\n', ..] | [b'\r', b'\n', ..] => "the end of the line".to_owned(),
            rest if self.binary && !rest[0].is_ascii_graphic() => format!("byte 0x{:02x}", rest[0]),
            rest => {
                let word = rest.split(u8::is_ascii_whitespace).next().unwrap_or_default();
                // Control characters would speak to the terminal.
                format!("`{}`", String::from_utf8_lossy(&word[..word.len().min(40)]).escape_debug())
            }
        };
        self.error(MshProblem::Syntax { expected: expected.to_owned(), found })
    }

    /// Rejects a count of items of at least `least` bytes each if the file is too short for it.
    pub fn check_room(&self, what: &'static str, declared: u64, least: usize) -> Result<usize, MshError> {
        // The last thing of a text file may lack its separator: one byte of grace.
        let room = (self.rest().len() as u64 + 1) / least.max(1) as u64;
        match usize::try_from(declared) {
            Ok(count) if declared <= room => Ok(count),
            _ => Err(self.error(MshProblem::TooMany { what, declared, room })),
        }
    }

    /// Skips blanks and line ends.
    pub fn skip_space(&mut self) {
        self.at += self.rest().iter().take_while(|b| b.is_ascii_whitespace()).count();
    }

    /// Skips blanks and one line end, `\n` or `\r\n`, before binary data or a text line.
    pub fn line_end(&mut self) -> Result<(), MshError> {
        while let [b' ' | b'\t' | b'\r', ..] = self.rest() {
            self.at += 1;
        }
        match self.rest() {
            [] => Ok(()),
            [b'\n', ..] => {
                self.at += 1;
                Ok(())
            }
            _ => Err(self.unexpected("the end of the line")),
        }
    }

    /// Start of a line of a record; does nothing in binary files.
    pub fn record_start(&mut self) {
        if !self.binary {
            self.skip_space();
        }
    }

    /// End of a line of a record; does nothing in binary files.
    pub fn record_end(&mut self) -> Result<(), MshError> {
        if self.binary { Ok(()) } else { self.line_end() }
    }

    /// The next word of the present line.
    fn word(&mut self, expected: &str) -> Result<&'a [u8], MshError> {
        while let [b' ' | b'\t', ..] = self.rest() {
            self.at += 1;
        }
        let rest = self.rest();
        let length = rest.iter().take_while(|b| !b.is_ascii_whitespace()).count();
        if length == 0 {
            return Err(self.unexpected(expected));
        }
        self.at += length;
        Ok(&rest[..length])
    }

    /// The next word of the current line as a number written in text, also in a binary file.
    pub fn text<T: std::str::FromStr>(&mut self, expected: &str) -> Result<T, MshError> {
        let start = self.at;
        let word = self.word(expected)?;
        match std::str::from_utf8(word).ok().and_then(|w| w.parse().ok()) {
            Some(value) => Ok(value),
            None => {
                self.at = start + self.bytes[start..].iter().take_while(|b| **b == b' ').count();
                Err(self.unexpected(expected))
            }
        }
    }

    fn raw<const N: usize>(&mut self, expected: &str) -> Result<[u8; N], MshError> {
        match self.rest().first_chunk::<N>() {
            Some(chunk) => {
                self.at += N;
                Ok(*chunk)
            }
            None => {
                self.at = self.bytes.len();
                Err(self.unexpected(expected))
            }
        }
    }

    /// A signed integer: text, or 4 bytes.
    pub fn int(&mut self, expected: &str) -> Result<i64, MshError> {
        if self.binary { Ok(i32::from_le_bytes(self.raw(expected)?).into()) } else { self.text(expected) }
    }

    /// An integer of 4 bytes that must not be negative: counts and tags of format 2.2.
    pub fn natural(&mut self, expected: &str) -> Result<u64, MshError> {
        if !self.binary {
            return self.text(expected);
        }
        let start = self.at;
        let value = self.int(expected)?;
        u64::try_from(value).map_err(|_| {
            let (expected, found) = (expected.to_owned(), value.to_string());
            self.error_at(start, MshProblem::Syntax { expected, found })
        })
    }

    /// Reads `count` non-negative integers of 4 bytes each and appends them to `into`.
    pub fn naturals(&mut self, count: usize, expected: &str, into: &mut Vec<u64>) -> Result<(), MshError> {
        into.reserve(count);
        if self.binary
            && let Some((numbers, [])) = self.rest().get(..4 * count).map(<[u8]>::as_chunks::<4>)
        {
            let before = into.len();
            into.extend(numbers.iter().map(|bytes| u64::from(u32::from_le_bytes(*bytes))));
            if into[before..].iter().all(|value| i32::try_from(*value).is_ok()) {
                self.at += 4 * count;
                return Ok(());
            }
            into.truncate(before);
        }
        // One by one, to where it goes wrong.
        (0..count).try_for_each(|_| self.natural(expected).map(|value| into.push(value)))
    }

    /// An unsigned integer: text, or 8 bytes. Counts and tags of format 4.1.
    pub fn size(&mut self, expected: &str) -> Result<u64, MshError> {
        if self.binary { Ok(u64::from_le_bytes(self.raw(expected)?)) } else { self.text(expected) }
    }

    /// A floating-point number: text, or 8 bytes.
    pub fn real(&mut self, expected: &str) -> Result<f64, MshError> {
        if self.binary { Ok(f64::from_le_bytes(self.raw(expected)?)) } else { self.text(expected) }
    }

    /// A word in double quotes. Bytes that are not UTF-8 become the replacement character.
    pub fn quoted(&mut self, expected: &str) -> Result<String, MshError> {
        while let [b' ' | b'\t', ..] = self.rest() {
            self.at += 1;
        }
        if let [b'"', rest @ ..] = self.rest() {
            let line = rest.split(|&b| b == b'\n').next().unwrap_or_default();
            // The name ends at the last quote of its line: names may hold quotes.
            if let Some(length) = line.iter().rposition(|&b| b == b'"') {
                self.at += length + 2;
                return Ok(String::from_utf8_lossy(&line[..length]).into_owned());
            }
        }
        Err(self.unexpected(expected))
    }

    /// Opens the next section and returns its name with `$`, or `None` at the end of the file.
    pub fn open_section(&mut self) -> Result<Option<String>, MshError> {
        self.skip_space();
        if self.rest().is_empty() {
            return Ok(None);
        }
        if self.rest()[0] != b'$' {
            return Err(self.unexpected("a section such as $Nodes"));
        }
        let start = self.at;
        let word = self.word("a section")?;
        let name = String::from_utf8_lossy(word).into_owned();
        if name.starts_with("$End") || name.len() > 64 {
            self.at = start;
            return Err(self.unexpected("a section such as $Nodes"));
        }
        self.section = name.clone();
        self.line_end()?;
        Ok(Some(name))
    }

    /// The section's name in its end mark: `$EndNodes` of `$Nodes`.
    fn end_mark(&self) -> String {
        format!("$End{}", self.section.trim_start_matches('$'))
    }

    /// Reads the end mark of the current section.
    pub fn close_section(&mut self) -> Result<(), MshError> {
        let expected = self.end_mark();
        self.skip_space();
        let start = self.at;
        let found = self.word(&expected)?;
        if found != expected.as_bytes() {
            self.at = start;
            return Err(self.unexpected(&expected));
        }
        Ok(())
    }

    /// Skips a section that is not used.
    pub fn skip_section(&mut self) -> Result<(), MshError> {
        let expected = self.end_mark();
        let start = self.at;
        match self.rest().windows(expected.len()).position(|w| w == expected.as_bytes()) {
            Some(position) => {
                self.at += position;
                self.close_section()
            }
            None => {
                let found = "the end of the file".to_owned();
                Err(self.error_at(start, MshProblem::Syntax { expected, found }))
            }
        }
    }
}
