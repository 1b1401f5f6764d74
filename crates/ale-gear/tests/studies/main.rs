//! Many runs as one: studies, sweeps, charts, comparisons, cheaper models.

mod chart;
mod compare;
mod envelope;
mod gearboxes;
mod ladder;
mod optimise;
mod parts;
mod study;
mod sweep;
#[path = "../util/mod.rs"]
mod util;
mod vary;
