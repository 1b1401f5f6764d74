//! Files that grow with a motion and are taken up again where a checkpoint left them.

use std::{
    fs::{File, OpenOptions},
    io::{BufRead, BufReader, BufWriter, Read, Write},
    path::{Path, PathBuf},
};

use serde::{Deserialize, Serialize};

use super::CheckpointError;
use columns::ColumnsError;

use crate::StoreError;

/// What a checkpoint keeps of a file of rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Kept {
    /// Length.
    bytes: u64,
    /// BLAKE3 of so many bytes, hexadecimal.
    blake3: String,
}

/// A regular file, open: a pipe would have no beginning.
fn opened(path: &Path) -> std::io::Result<File> {
    files::regular(&std::fs::metadata(path)?)?;
    File::open(path)
}

impl Kept {
    /// The file as far as it was kept.
    ///
    /// # Errors
    /// When it cannot be opened.
    pub(super) fn reader(&self, path: &Path) -> Result<impl BufRead, StoreError> {
        let file = opened(path).map_err(|cause| ColumnsError::Read { file: path.to_owned(), cause })?;
        Ok(BufReader::new(file.take(self.bytes)))
    }
}

/// The digest so far of a file of rows, when it begins with what was kept of it.
///
/// # Errors
/// [`CheckpointError::Damaged`] when it does not.
pub(super) fn digested(path: &Path, kept: &Kept) -> Result<blake3::Hasher, CheckpointError> {
    let mut digest = blake3::Hasher::new();
    let read = opened(path).and_then(|file| digest.update_reader(file.take(kept.bytes)).map(|_| ()));
    let what = match read {
        Err(e) => format!("cannot be read: {e}"),
        Ok(()) if digest.count() < kept.bytes => "is shorter than its checkpoint says".into(),
        Ok(()) if digest.finalize().to_hex().as_str() != kept.blake3 => {
            "is not as its checkpoint left it: changed or damaged".into()
        }
        Ok(()) => return Ok(digest),
    };
    Err(CheckpointError::Damaged { file: path.to_owned(), what })
}

/// A file that grows and can be taken up again.
#[derive(Debug)]
pub(super) struct Growing {
    path: PathBuf,
    file: BufWriter<File>,
    bytes: u64,
    digest: blake3::Hasher,
    failed: Option<std::io::Error>,
}

impl Growing {
    pub fn new(path: PathBuf, header: &str) -> Result<Self, StoreError> {
        let file = File::create(&path).map_err(|cause| StoreError::Write { file: path.clone(), cause })?;
        let mut new = Self { file: BufWriter::new(file), path, bytes: 0, digest: blake3::Hasher::new(), failed: None };
        new.push(header);
        Ok(new)
    }

    /// Cut to what its digest is of, what came after a checkpoint being written anew.
    pub fn resume(path: PathBuf, digest: blake3::Hasher) -> Result<Self, StoreError> {
        let bytes = digest.count();
        let open = || -> std::io::Result<File> {
            let file = OpenOptions::new().append(true).open(&path)?;
            file.set_len(bytes)?;
            Ok(file)
        };
        let file = open().map_err(|cause| StoreError::Write { file: path.clone(), cause })?;
        Ok(Self { file: BufWriter::new(file), path, bytes, digest, failed: None })
    }

    /// A failure is kept for the next flush: rows come from the midst of a computation.
    pub fn push(&mut self, text: &str) {
        self.bytes += text.len() as u64;
        self.digest.update(text.as_bytes());
        if let Err(e) = self.file.write_all(text.as_bytes()) {
            self.failed.get_or_insert(e);
        }
    }

    pub fn flush(&mut self) -> Result<Kept, StoreError> {
        // On the disk before a checkpoint says that it is there.
        let written = |file: &mut BufWriter<File>| file.flush().and_then(|()| file.get_ref().sync_data());
        match self.failed.take().or_else(|| written(&mut self.file).err()) {
            None => Ok(Kept { bytes: self.bytes, blake3: self.digest.finalize().to_hex().to_string() }),
            Some(cause) => Err(StoreError::Write { file: self.path.clone(), cause }),
        }
    }
}
