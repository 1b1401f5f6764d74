//! Writes the numbers of a mesh file, as text or as bytes.

use std::io::Write as _;

/// Numbers as text or as bytes.
pub(super) struct Out {
    pub(super) bytes: Vec<u8>,
    pub(super) binary: bool,
}

impl Out {
    pub(super) fn line(&mut self, text: &str) {
        self.bytes.extend_from_slice(text.as_bytes());
        self.bytes.push(b'\n');
    }

    pub(super) fn header(&mut self, version: &str) {
        self.line(&format!("$MeshFormat\n{version} {} 8", i32::from(self.binary)));
        if self.binary {
            self.ints(&[1]);
            self.bytes.push(b'\n');
        }
        self.line("$EndMeshFormat");
    }

    /// End mark; binary data has no line end of its own.
    pub(super) fn end(&mut self, mark: &str) {
        if self.binary {
            self.bytes.push(b'\n');
        }
        self.line(mark);
    }

    /// End of a line of text.
    pub(super) fn new_line(&mut self) {
        if !self.binary {
            // Numbers end with a blank.
            self.bytes.pop();
            self.bytes.push(b'\n');
        }
    }

    fn text(&mut self, value: impl std::fmt::Display) {
        // Writing into a vector cannot fail.
        let _ = write!(self.bytes, "{value} ");
    }

    pub(super) fn ints(&mut self, values: &[i32]) {
        for &value in values {
            if self.binary { self.bytes.extend_from_slice(&value.to_le_bytes()) } else { self.text(value) }
        }
    }

    pub(super) fn sizes(&mut self, values: &[u64]) {
        for &value in values {
            if self.binary { self.bytes.extend_from_slice(&value.to_le_bytes()) } else { self.text(value) }
        }
    }

    /// The shortest digits that give the same number back.
    pub(super) fn real(&mut self, value: f64) {
        if self.binary {
            self.bytes.extend_from_slice(&value.to_le_bytes());
        } else {
            let _ = write!(self.bytes, "{value:?} ");
        }
    }

    /// A line of numbers.
    pub(super) fn reals(&mut self, values: &[f64]) {
        values.iter().for_each(|&v| self.real(v));
        self.new_line();
    }

    /// Header of a run of elements of one type, in binary.
    pub(super) fn run_22(&mut self, code: i32, count: usize) {
        if self.binary && count > 0 {
            self.ints(&[code, count as i32, 2]);
        }
    }
}
