//! Which files are read, and how does a file or a folder come to be whole?
//!
//! Everything that this program reads for a user or writes for one goes through here.
//!
//! | what | how |
//! |---|---|
//! | [`read_regular_file`], [`read_regular_text`], [`open_regular_file`] | regular files alone, up to a size that the kind of file may have ([`most`]) |
//! | [`write_file`], [`write_new_file`] | one file: written beside its place, synchronised, renamed |
//! | [`WorkFolder`] | the folder beside a target in which it grows; those of killed processes go with the next run |
//! | [`Lock`] | a file that one run uses at a time |
//! | [`Place`], [`Located`] | where something was said or happened, once, around an error that says what |
//! | [`hold_still`] | what a process does that is stopped: nothing half written is left |

mod located;
mod lock;
pub mod most;
mod partial;
mod place;
mod read;
mod sync;
mod work_folder;
mod write;

pub use located::{Line, Located, Place};
pub use lock::Lock;
pub use partial::{Partial, hold_still};
pub use read::{no_text, open_regular_file, read_regular_file, read_regular_text, regular};
pub use work_folder::{Judge, Kind, Scratch, WorkFolder, is_left_over, is_work_folder, stranger, take_away_left_overs};
pub use write::{behind_links, write_file, write_new_file};
