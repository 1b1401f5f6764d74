//! Isotropic linear elastic material.

use crate::FemError;

/// Isotropic linear elastic material; the fields are checked by [`Material::new`].
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Material {
    young: f64,
    poisson: f64,
    density: f64,
}

impl Material {
    /// Case-hardened steel, the material of most gears: 206 GPa, 0.3, 7850 kg/m^3.
    pub const STEEL: Self = Self { young: 2.06e5, poisson: 0.3, density: 7.85e-9 };

    /// A material from Young's modulus (MPa), Poisson's ratio and density (t/mm^3).
    ///
    /// Displacement elements lock as nu approaches 1/2, so nu >= 0.4999 is an error.
    ///
    /// # Errors
    /// [`FemError::YoungNotPositive`], [`FemError::PoissonOutOfRange`], [`FemError::DensityNotPositive`].
    ///
    /// # Example
    /// ```
    /// let plastic = fem::Material::new(2800.0, 0.38, 1.41e-9)?;
    /// assert!(fem::Material::new(2800.0, 0.5, 1.41e-9).is_err());
    /// # assert_eq!(plastic.young_mpa(), 2800.0);
    /// # Ok::<(), fem::FemError>(())
    /// ```
    pub fn new(young_mpa: f64, poisson: f64, density_t_per_mm3: f64) -> Result<Self, FemError> {
        if !(young_mpa > 0.0 && young_mpa.is_finite()) {
            return Err(FemError::YoungNotPositive { young_mpa });
        }
        if !(poisson > -1.0 && poisson < 0.4999) {
            return Err(FemError::PoissonOutOfRange { poisson });
        }
        if !(density_t_per_mm3 > 0.0 && density_t_per_mm3.is_finite()) {
            return Err(FemError::DensityNotPositive { density_t_per_mm3 });
        }
        Ok(Self { young: young_mpa, poisson, density: density_t_per_mm3 })
    }

    /// Young's modulus E, MPa.
    pub const fn young_mpa(&self) -> f64 {
        self.young
    }

    /// Poisson's ratio nu.
    pub const fn poisson(&self) -> f64 {
        self.poisson
    }

    /// Density, t/mm^3.
    pub const fn density_t_per_mm3(&self) -> f64 {
        self.density
    }

    /// Lame's constants, MPa: lambda = E nu / ((1+nu)(1-2nu)), mu = E / (2(1+nu)).
    pub(crate) fn lame_mpa(&self) -> (f64, f64) {
        let Self { young: e, poisson: nu, .. } = *self;
        (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)))
    }

    /// Stress for a given strain, MPa.
    ///
    /// ```text
    /// sigma = lambda tr(epsilon) I + 2 mu epsilon
    /// ```
    /// Components xx, yy, zz, xy, yz, zx; shear strains are engineering strains (gamma = 2 epsilon).
    pub fn stress_mpa(&self, strain: [f64; 6]) -> [f64; 6] {
        let (lambda, mu) = self.lame_mpa();
        let pressure = lambda * (strain[0] + strain[1] + strain[2]);
        std::array::from_fn(|k| if k < 3 { pressure + 2.0 * mu * strain[k] } else { mu * strain[k] })
    }
}

impl Default for Material {
    fn default() -> Self {
        Self::STEEL
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniaxial_stress_stretches_by_e_and_thins_by_nu() {
        let (e, nu) = (Material::STEEL.young_mpa(), Material::STEEL.poisson());
        let stress = Material::STEEL.stress_mpa([1.0 / e, -nu / e, -nu / e, 0.0, 0.0, 0.0]);
        for (k, value) in stress.into_iter().enumerate() {
            assert!((value - f64::from(u8::from(k == 0))).abs() < 1e-14, "{stress:?}");
        }
    }

    #[test]
    fn strain_is_the_compliance_matrix_times_stress() {
        let (e, nu) = (Material::STEEL.young_mpa(), Material::STEEL.poisson());
        let strain = [1.0, -2.0, 0.5, 3.0, -1.0, 0.25];
        let stress = Material::STEEL.stress_mpa(strain);
        for (k, value) in strain.into_iter().enumerate() {
            // eps_i = (sigma_i - nu (sigma_j + sigma_k)) / E, gamma = 2 (1 + nu) tau / E
            let others: f64 = stress[..3].iter().sum::<f64>() - stress[k];
            let found = if k < 3 { (stress[k] - nu * others) / e } else { 2.0 * (1.0 + nu) * stress[k] / e };
            assert!((found - value).abs() < 1e-14, "{k}: {found} of {value}");
        }
    }

    #[test]
    fn impossible_materials_are_refused() {
        assert!(Material::new(f64::NAN, 0.3, 1e-9).is_err());
        assert!(Material::new(0.0, 0.3, 1e-9).is_err());
        assert!(Material::new(1.0, 0.4999, 1e-9).is_err());
        assert!(Material::new(1.0, -1.0, 1e-9).is_err());
        assert!(Material::new(1.0, f64::NAN, 1e-9).is_err());
        assert!(Material::new(1.0, 0.3, 0.0).is_err());
        assert!(Material::new(1.0, 0.49, 1e-9).is_ok());
    }
}
