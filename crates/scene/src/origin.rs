//! Where files are searched.

use std::{
    borrow::Cow,
    io,
    path::{Path, PathBuf},
};

/// Where a scene and the files that it names stand.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Origin {
    /// In files.
    #[default]
    Disk,
    /// In the program.
    Program,
}

/// Files of the default scene, as it names them.
const FILES: [(&str, &[u8]); 2] = [
    ("../meshes/coarse_hex20_pinion.msh", include_bytes!("../../../meshes/coarse_hex20_pinion.msh")),
    ("../meshes/coarse_hex20_wheel.msh", include_bytes!("../../../meshes/coarse_hex20_wheel.msh")),
];

/// The bytes of a file of the program.
pub(crate) fn in_program(path: &Path) -> Option<&'static [u8]> {
    FILES.iter().find(|(name, _)| Path::new(name) == path).map(|(_, bytes)| *bytes)
}

impl Origin {
    /// The bytes of the file with the name `path` in a document at `document`, at most `most` bytes.
    ///
    /// # Errors
    /// The error of the operating system; [`io::ErrorKind::InvalidInput`] for folders, devices and named pipes.
    pub fn read(self, document: &Path, path: &Path, most: u64) -> io::Result<Cow<'static, [u8]>> {
        match self {
            Self::Disk => files::read_regular_file(&resolved(document, path), most).map(Cow::Owned),
            Self::Program => in_program(path).map(Cow::Borrowed).ok_or(io::ErrorKind::NotFound.into()),
        }
    }
}

/// A path in a document as seen from here.
pub(crate) fn resolved(document: &Path, path: &Path) -> PathBuf {
    document.parent().map_or_else(|| path.to_owned(), |folder| folder.join(path))
}
