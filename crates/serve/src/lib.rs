//! How does a person try a pair or a gearbox by hand?
//!
//! A page on this machine alone: the scene as a form, sliders for load and micro-geometry, and what the pair or the
//! gearbox at rest makes of them, within the time of a move. Everything is computed here, by the same [`analysis`] that runs a scene;
//! the page draws, with the scripts of a report.
//!
//! | module | what it does |
//! |---|---|
//! | `server` | takes requests on the loopback address until it is told to stop |
//! | `guard` | who may ask: token, host, origin |
//! | `routes` | which address is what |
//! | `reply` | answers with the headers that keep a page to itself |
//! | `listen` | takes connections and answers their requests |
//! | `visit` | how many connections there may be, and how long each may take |
//! | `queue` | the latest move of a page wins, and no page waits for another |
//! | `workers` | threads that solve moves |
//! | `session` | a scene with its changes, solved, as the page takes it |
//! | `gearbox` | a gearbox at rest, as the page takes it |
//! | `outcome` | what is shown of a solved document |
//! | `scene_text` | keys of a scene's text changed one by one; keys that a complaint is about |
//! | `sliders` | what is moved by hand, and within which ends |
//! | `form` | all keys of a scene at rest, from the schema |
//! | `page` | the page itself |

mod fault;
mod form;
mod gearbox;
mod guard;
mod listen;
mod outcome;
mod page;
mod queue;
mod reply;
mod routes;
mod scene_text;
mod server;
mod session;
mod sliders;
mod visit;
mod workers;

pub use server::{ServeError, Server, Stop};
pub use session::Limits;
