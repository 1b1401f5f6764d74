//! Small models that failure modes need beside gears.

pub(crate) mod active_set;
pub(crate) mod bar;
pub(crate) mod block;
pub(crate) mod contact_patch;
pub(crate) mod rebound;
