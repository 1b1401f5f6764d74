//! Mesh force from the relative displacement of the flanks, transverse and axial.

use geometry::GearPair;
use integrate::Forces;
use serde::{Deserialize, Serialize};

use crate::DeadZone;

/// How the mesh stiffness along the normal becomes a transverse and an axial force.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MeshLaw {
    /// One spring along the flanks' normal.
    ///
    /// ```text
    /// delta_n = delta_y cos b - (z_p - z_g) sin b,   F_n = K_n f(delta_n - e_n; b_n) + C_n (delta_n' - e_n'),   F_y = F_n cos b,   F_z = -F_n sin b
    /// ```
    /// with K_n = k / cos^2 b: F_a = F_t tan b_b, and every force has its reaction.
    #[default]
    Normal,
    /// Two springs with projected stiffness, as seed 004 prints (7a, 7b).
    ///
    /// ```text
    /// F_y = K_n cos b f(delta_y - e_y; b_n cos b) + C_n cos b (delta_y' - e_y')
    /// F_z = K_n sin b f(delta_z - e_z; b_n sin b) + C_n sin b (delta_z' - e_z'),   delta_z = z_p - z_g - delta_y tan b
    /// ```
    /// with K_n = k / cos b. Stiffness and displacement are both projected: with z held, F_z = F_y tan^2 b, short of
    /// the F_y tan b of statics by tan b (5.7 times at 10 degrees). And F_z moves the gears along their axes without
    /// loading the line of action in return: the linear matrix is not symmetric, and the axial force does work out of
    /// nothing, which the ledger books as supplied.
    Projected,
}

impl MeshLaw {
    /// Half backlash b_n along the normal (mm) that gives a pair its backlash j along the transverse line of action:
    /// j/2 cos b_b, or j/2 / cos b_b where the clearance is projected.
    pub fn half_backlash(self, pair: &GearPair) -> f64 {
        let (half, cos) = (0.5 * pair.backlash().max(0.0), pair.base_helix_angle().cos());
        match self {
            Self::Normal => half * cos,
            Self::Projected => half / cos,
        }
    }
}

/// One spring and damper of the mesh: a displacement that is linear in the coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spring {
    /// delta = jacobian . q.
    pub jacobian: [f64; 8],
    /// Coordinates that the force acts on: f = -(K f(delta - e) + C (delta' - e')) action.
    pub action: [f64; 8],
    /// K at this time, N/mm.
    pub stiffness: f64,
    /// C, N s/mm.
    pub damping: f64,
    /// e and its rate, mm and mm/s.
    pub error: [f64; 2],
    pub zone: DeadZone,
}

/// A spring at a state.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpringForce {
    pub elastic: f64,
    pub viscous: f64,
    /// Slope of the elastic force, N/mm.
    pub slope: f64,
    pub potential: f64,
    pub touching: bool,
    pub rate: f64,
}

impl SpringForce {
    pub fn total(&self) -> f64 {
        self.elastic + self.viscous
    }
}

impl Spring {
    pub fn at(&self, q: &[f64], v: &[f64]) -> SpringForce {
        let along = |x: &[f64]| self.jacobian.iter().zip(x).map(|(j, x)| j * x).sum::<f64>();
        let beyond = self.zone.at(along(q) - self.error[0]);
        let rate = along(v);
        SpringForce {
            elastic: self.stiffness * beyond.value,
            viscous: self.damping * (rate - self.error[1]),
            slope: self.stiffness * beyond.slope,
            potential: self.stiffness * beyond.potential(),
            touching: beyond.slope > 0.0,
            rate,
        }
    }

    /// Whether the force acts along its own displacement and so has a potential.
    pub fn is_reciprocal(&self) -> bool {
        self.action == self.jacobian
    }

    /// Force, tangents and powers at velocities `v`.
    pub fn add(&self, force: &SpringForce, v: &[f64], out: &mut Forces) {
        let elastic = if self.is_reciprocal() { &mut out.conservative } else { &mut out.other };
        let mut acting = 0.0;
        for i in 0..8 {
            elastic[i] -= self.action[i] * force.elastic;
            acting += self.action[i] * v[i];
        }
        for i in 0..8 {
            out.other[i] -= self.action[i] * force.viscous;
            for j in 0..8 {
                out.stiffness[(i, j)] += self.action[i] * force.slope * self.jacobian[j];
                out.damping[(i, j)] += self.action[i] * self.damping * self.jacobian[j];
            }
        }
        if self.is_reciprocal() {
            // The damper takes C (delta' - e')^2; what it gives to the error's motion comes from outside.
            out.dissipated += force.viscous * (force.rate - self.error[1]);
            out.supplied -= force.viscous * self.error[1];
        } else {
            out.supplied -= force.total() * acting;
        }
    }
}
