//! Where the files of a result go.

use std::io::Write;

use crate::StoreError;

/// Takes the files of one result by name: a folder, an archive, or memory.
pub trait ResultFiles {
    /// Takes a whole file.
    ///
    /// # Errors
    /// When the system refuses.
    fn write(&self, name: &str, content: &[u8]) -> Result<(), StoreError>;

    /// Begins a file that is written bit by bit.
    ///
    /// # Errors
    /// When the system refuses.
    fn create(&self, name: &str) -> Result<Box<dyn Write + '_>, StoreError>;
}
