//! Laws of the crate `reduction`.

mod bolts;
mod bore;
mod common;
mod cyclic;
mod elastic_bore;
mod holes;
mod modes;
mod record;
mod several_windows;
mod spin;
mod stress_modes;
