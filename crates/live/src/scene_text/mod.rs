//! The text of a scene: its keys one by one, and which of them a complaint is about.

mod complaint;
mod edit;

pub(crate) use complaint::keys_of;
pub(crate) use edit::{changed, flat};
