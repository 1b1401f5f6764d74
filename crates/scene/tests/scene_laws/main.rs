//! What a scene or another document says, and how mistakes in it are reported.

mod bore;
mod builder;
mod documents_in_documents;
mod gearbox;
mod gearbox_bearings;
mod internal;
mod places;
mod planets;
mod rating;
mod rexs_planets;
