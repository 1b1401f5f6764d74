//! Root stress: against CalculiX, across tooth changes, over meshes.

mod root_stress;
mod root_stress_calculix;
mod root_stress_pairs;
