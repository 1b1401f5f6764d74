//! Reasons for which a file is not a valid record.

/// The bytes are not the requested record.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// A file of another kind.
    #[error("is no reduced gear")]
    Foreign,
    /// Written by another version of the program.
    #[error("has format version {found}, this program has {}", super::RECORD_VERSION)]
    OtherVersion {
        /// Version in the file.
        found: u32,
    },
    /// The record belongs to another gear.
    #[error("belongs to another gear, material or reduction")]
    OtherGear,
    /// The file is shorter or longer than its header says.
    #[error("has {found} bytes of {wanted}")]
    WrongLength {
        /// Number of bytes found.
        found: u64,
        /// Number of bytes given in the header.
        wanted: u64,
    },
    /// The file cannot be read.
    #[error("cannot be read: {what}")]
    Unreadable {
        /// Message of the operating system.
        what: String,
    },
    /// The checksum does not match the bytes.
    #[error("is damaged: its checksum is wrong")]
    Damaged,
    /// The checksum matches, but the lists are inconsistent.
    #[error("is damaged at byte {at}: {what}")]
    Inconsistent {
        /// Position in the file.
        at: usize,
        /// What is wrong at this position.
        what: &'static str,
    },
}

impl RecordError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        Some("nothing: the gear is reduced again and the file replaced".into())
    }
}
