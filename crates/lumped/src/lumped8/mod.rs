//! Eight coordinates: x, y, z, theta of each gear, with backlash and friction (seed 004).
//!
//! ```text
//! M_p x_p'' + C_px x_p' + K_px x_p = +F_f          M_g x_g'' + C_gx x_g' + K_gx x_g = -F_f
//! M_p y_p'' + C_py y_p' + K_py y_p = -F_y          M_g y_g'' + C_gy y_g' + K_gy y_g = +F_y
//! M_p z_p'' + C_pz z_p' + K_pz z_p = -F_z          M_g z_g'' + C_gz z_g' + K_gz z_g = +F_z
//! J_p theta_p'' = T_p + T_pf - F_y r_b             J_g theta_g'' = T_g + T_gf - F_y R_b
//! delta_y = y_p + r_b theta_p - (y_g - R_b theta_g)
//! ```
//! x across the line of action, y along it (the way the driven gear is pushed), z along the axes; p drives, g is
//! driven. Both angles count in the *driver's* sense, so that the load T_g turns the driven gear the positive way and
//! the transmission error is r_b theta_p + R_b theta_g.
//!
//! What is printed otherwise, and why it is not followed:
//!
//! * (6c) with (15b): delta_y holds +R_b theta_g, so the mesh turns the driven gear by -F_y R_b and the load by +T_g;
//!   printed is +F_y R_b - T_g, which with (6c) is a negative stiffness.
//! * (2c) in (7b): the axial error has the other sign. delta_z = z_p - z_g - tan(beta) delta_y must be without force
//!   when the unloaded pair follows its error, delta_y = e_y.
//! * m_e: see [`crate::LumpedPair::reduced_mass`]; the phase under a fluctuating speed: see [`crate::MeshClock`]; (18)
//!   in dimensionless form: a law of this crate (`dimensionless.rs` of its tests).
//! * (2a), the error across the line of action, enters no equation.
//!
//! And what is not a misprint, but wrong by statics: see [`MeshLaw::Projected`].

mod mechanism;
mod mesh_law;
mod parameters;

pub use mechanism::Motion8;
pub use mesh_law::MeshLaw;
pub use parameters::{Lumped8, Support8};
