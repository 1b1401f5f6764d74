//! Oil at work: how it gets to the flanks, how warm it is, and by how much it lowers friction. ISO/TS 6336-20, -21, -22.

use serde::Serialize;

use crate::{Lubricant, LubricantBase, RatingError, error::positive};

/// How oil gets to the flanks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LubricationMethod {
    /// Gears dip into the oil.
    Dip,
    /// Oil is sprayed into the mesh.
    Spray,
    /// The mesh runs in the oil.
    Submerged,
}

impl LubricationMethod {
    /// X_S, lubrication factor of the bulk temperature: 1 (dip), 1.2 (spray), 0.2 (submerged). Source: ISO/TS 6336-20, bulk temperature.
    pub fn factor(self) -> f64 {
        match self {
            Self::Dip => 1.0,
            Self::Spray => 1.2,
            Self::Submerged => 0.2,
        }
    }
}

/// The lubricated surfaces of a pair.
#[derive(Debug, Clone, PartialEq)]
pub struct Lubrication {
    /// The oil.
    pub lubricant: Lubricant,
    /// theta_oil, temperature of the oil before the mesh, C.
    pub oil_temperature_c: f64,
    /// How it gets to the flanks.
    pub method: LubricationMethod,
    /// R_a of the flanks of pinion and wheel, um.
    pub roughness_ra_um: [f64; 2],
}

impl Lubrication {
    /// These surfaces where every number has a meaning.
    ///
    /// # Errors
    /// [`RatingError::OutOfRange`].
    pub fn checked(&self) -> Result<&Self, RatingError> {
        const CLAUSE: &str = "ISO/TS 6336-20";
        for roughness in self.roughness_ra_um {
            positive("a roughness R_a of the flanks in um", roughness, CLAUSE)?;
        }
        positive("the viscosity at the oil temperature in mPa s", self.viscosity_mpa_s(), CLAUSE)?;
        Ok(self)
    }

    /// eta_oil, dynamic viscosity at the oil temperature, mPa s.
    pub fn viscosity_mpa_s(&self) -> f64 {
        self.lubricant.dynamic_viscosity(self.oil_temperature_c)
    }

    /// Effective roughness R_a = (R_a1 + R_a2)/2, um.
    pub fn roughness_um(&self) -> f64 {
        0.5 * (self.roughness_ra_um[0] + self.roughness_ra_um[1])
    }

    /// X_L of the integral temperature: 1 (mineral), 0.8 (polyalphaolefin), 0.7 (polyglycol). Source: ISO/TS 6336-21, lubricant factor.
    pub fn base_factor(&self) -> f64 {
        match self.lubricant.base {
            LubricantBase::Mineral => 1.0,
            LubricantBase::Polyalphaolefin => 0.8,
            LubricantBase::Polyglycol => 0.7,
        }
    }

    /// `X_L eta_oil^-0.05`: lubricant factor of the flash temperature. Source: ISO/TS 6336-20, lubricant factor.
    pub fn lubricant_factor(&self) -> f64 {
        self.base_factor() * self.viscosity_mpa_s().powf(-0.05)
    }
}
