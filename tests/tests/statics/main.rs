//! The loaded pair at rest: laws, CalculiX, published values, any contact ratio.

mod both_flanks;
mod calculix;
mod contact_ratio;
mod corner_contact;
mod face_load;
mod face_widths;
mod given_poses;
mod gmsh_meshes;
mod laws_of_statics;
mod online;
mod phase_independence;
mod published_pairs;
mod slices;
mod starts_alike;
mod tooth_change;
