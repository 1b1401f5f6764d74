//! How does a person try a pair or a gearbox by hand?
//!
//! A page with the scene as a form, sliders for load and micro-geometry, and what the pair or the gearbox at rest makes of
//! them, within the time of a move. Moves are answered by the same [`analysis`] that runs a scene; the page draws, with the
//! scripts of a report. `serve` carries moves and answers to a browser on the same machine; `browser` answers them inside of
//! it.
//!
//! | module | what it does |
//! |---|---|
//! | `session` | a scene with its changes, solved, as the page takes it |
//! | `gearbox` | a gearbox at rest, as the page takes it |
//! | `outcome` | what is shown of a solved document |
//! | `fault` | what is wrong, and beside which keys it stands |
//! | `scene_text` | keys of a scene's text changed one by one; keys that a complaint is about |
//! | `sliders` | what is moved by hand, and within which ends |
//! | `form` | all keys of a scene at rest, from the schema |
//! | `page` | the page itself |

mod fault;
mod form;
mod gearbox;
mod outcome;
pub mod page;
mod scene_text;
mod session;
mod sliders;

pub use fault::Fault;
pub use session::{Change, Machine, Session, Taken};
