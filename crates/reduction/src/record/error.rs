//! Why a file is no record.

/// The bytes are not the record that was asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// Another kind of file.
    #[error("is no reduced gear")]
    Foreign,
    /// Written by another version of the program.
    #[error("has format version {found}, this program has {}", super::RECORD_VERSION)]
    OtherVersion {
        /// Version in the file.
        found: u32,
    },
    /// A record of another gear.
    #[error("belongs to another gear, material or reduction")]
    OtherGear,
    /// Shorter or longer than it says.
    #[error("has {found} bytes of {wanted}")]
    WrongLength {
        /// Bytes there.
        found: u64,
        /// Bytes that the header announces.
        wanted: u64,
    },
    /// The bytes do not come.
    #[error("cannot be read: {what}")]
    Unreadable {
        /// What the system says.
        what: String,
    },
    /// The checksum does not fit the bytes.
    #[error("is damaged: its checksum is wrong")]
    Damaged,
    /// The checksum fits, but the lists do not fit together.
    #[error("is damaged at byte {at}: {what}")]
    Inconsistent {
        /// Place in the file.
        at: usize,
        /// What is wrong there.
        what: &'static str,
    },
}

impl RecordError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        Some("nothing: the gear is reduced again and the file replaced".into())
    }
}
