//! Single files that a command is told to write: of what is there only a file of the same kind is replaced.

use std::{fs::File, io::Read, path::Path};

use crate::error::CommandError;

/// Kinds of files that commands write by a name of the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    /// A mesh in a format of Gmsh.
    Mesh,
    /// A REXS file.
    Rexs,
    /// A page of a result.
    Page,
}

/// Bytes at the beginning of a file by which its kind is known.
const BEGINNING: u64 = 1024;

impl Target {
    /// Whether the command may write there: nothing is, nothing but an empty file, or a file of this kind.
    ///
    /// # Errors
    /// Exit status 2 with the words of the command line, `-o` or `--rexs`, that named the file.
    pub(super) fn check(self, word: &str, path: &Path) -> Result<(), CommandError> {
        let is_file = std::fs::metadata(path).is_ok_and(|found| found.is_file());
        let mut begins = Vec::new();
        // What cannot be read is told by the writer.
        let read = is_file.then(|| File::open(path).and_then(|file| file.take(BEGINNING).read_to_end(&mut begins)));
        if !matches!(read, Some(Ok(_))) || begins.is_empty() || self.is_begun_by(&String::from_utf8_lossy(&begins)) {
            return Ok(());
        }
        Err(CommandError::input(
            format_args!("{word} {}: exists and is not a {}", path.display(), self.name()),
            Some("give the name of a new file, or take that one away".into()),
        ))
    }

    fn is_begun_by(self, text: &str) -> bool {
        match self {
            Self::Mesh => text.starts_with("$MeshFormat"),
            Self::Rexs => text.trim_start().starts_with('<') && text.contains("<model"),
            Self::Page => text.starts_with("<!DOCTYPE html>") && text.contains("ale-gear"),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Mesh => "mesh of Gmsh",
            Self::Rexs => "REXS file",
            Self::Page => "report of this program",
        }
    }
}
