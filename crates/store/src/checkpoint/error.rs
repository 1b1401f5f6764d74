//! Why a run cannot go on from a checkpoint.

use std::{io, path::PathBuf};

/// Why a run cannot go on from a checkpoint, and which file says so.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// A file that the scene names has other content than when the checkpoint was written.
    #[error("{}: is not the file that the checkpoint was written with", file.display())]
    OtherFile {
        /// The file.
        file: PathBuf,
    },
    /// The checkpoint belongs to something else.
    #[error("{}: the checkpoint belongs to {what}", scene.display())]
    Foreign {
        /// The scene.
        scene: PathBuf,
        /// To what.
        what: String,
    },
    /// Another run uses the folder.
    #[error("{}: another run writes its checkpoints there", folder.display())]
    InUse {
        /// The folder.
        folder: PathBuf,
    },
    /// A file, or a folder that was not made for checkpoints.
    #[error("{}: is there, and was not made by this program for checkpoints", folder.display())]
    NotOurs {
        /// The folder.
        folder: PathBuf,
    },
    /// There is no checkpoint.
    #[error("{}: there is no checkpoint: {cause}", file.display())]
    None {
        /// The file that should be there.
        file: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A file of the checkpoint is not as it was written.
    #[error("{}: {what}", file.display())]
    Damaged {
        /// The file.
        file: PathBuf,
        /// In what way.
        what: String,
    },
}

impl CheckpointError {
    /// What to do next.
    pub fn hint(&self) -> Option<String> {
        let beginning = "run without `--resume` to start from the beginning";
        let said = match self {
            Self::OtherFile { .. } => format!("put that one back, or {beginning}"),
            Self::Foreign { .. } => {
                format!("go on with what it belongs to, give another `--out`, or {beginning}")
            }
            Self::Damaged { .. } => beginning.to_owned(),
            Self::InUse { .. } => "wait for its end, or give another `--out`".to_owned(),
            Self::NotOurs { .. } => "checkpoints of a run go there: give another `--out`, or move it away".to_owned(),
            Self::None { .. } => {
                "a run that has come to its end leaves none; `--resume` goes on from one with `checkpoint_every_cycles` or `--stop-after-cycles` into the same folder"
                    .to_owned()
            }
        };
        Some(said)
    }
}
