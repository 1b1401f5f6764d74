//! Who may ask this machine, and when is it answered?
//!
//! The page of [`live`] for a browser on this machine alone: moves come in, are solved on threads of their own, and are
//! answered.
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

mod guard;
mod listen;
mod queue;
mod reply;
mod routes;
mod server;
mod visit;
mod workers;

pub use server::{ServeError, Server, Stop};
