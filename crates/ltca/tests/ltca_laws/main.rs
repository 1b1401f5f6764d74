//! Laws of the loaded pair at rest: equilibrium, CalculiX, published values, any contact ratio; modified, crowned and misaligned
//! flanks; root stress.

mod both_flanks;
mod calculix;
mod contact_ratio;
mod corner_contact;
mod crowning;
mod elastic_bores;
mod face_widths;
mod given_poses;
mod gmsh_meshes;
mod harris_map;
mod internal_pairs;
mod joined;
mod kept_tables;
mod kinematic;
mod laws_of_statics;
mod modified;
mod online;
mod phase_independence;
mod published_pairs;
mod root_stress;
mod root_stress_calculix;
mod root_stress_pairs;
mod sensitivity;
mod slices;
mod starts_alike;
mod tooth_change;
mod waves;
mod wide_gears;
mod width_and_crowning;
