//! Tables of a scene for the cheaper models of the pair: one each, and one for the mesh.

mod check;
mod impact;
mod model_tables;
mod shaft;
mod without_effect;

pub(super) use check::Rung;
pub(super) use model_tables::{ModelTables, model_tables, table};
pub(super) use shaft::shaft;
pub(super) use without_effect::{check_free_coordinates, check_in_time, check_tables};

use crate::schema::SupportScene;

impl SupportScene {
    /// Stiffnesses along and about x, y, z.
    pub fn stiffnesses(&self) -> [f64; 6] {
        [
            self.stiffness_x_n_per_mm,
            self.stiffness_y_n_per_mm,
            self.stiffness_z_n_per_mm,
            self.stiffness_rx_nmm_per_rad,
            self.stiffness_ry_nmm_per_rad,
            self.stiffness_rz_nmm_per_rad,
        ]
    }

    /// Damping along and about x, y, z.
    pub fn dampings(&self) -> [f64; 6] {
        [
            self.damping_x_ns_per_mm,
            self.damping_y_ns_per_mm,
            self.damping_z_ns_per_mm,
            self.damping_rx_nmms_per_rad,
            self.damping_ry_nmms_per_rad,
            self.damping_rz_nmms_per_rad,
        ]
    }
}
