//! Round sections, solid or hollow.

use std::f64::consts::PI;

use crate::{FemError, Material};

/// A round section of a shaft, solid or hollow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamSection {
    outer: f64,
    inner: f64,
    material: Material,
}

impl BeamSection {
    /// A section with outer and inner diameter, mm; inner diameter 0: solid.
    ///
    /// # Errors
    /// [`FemError::Section`] unless 0 <= inner < outer.
    pub fn new(outer: f64, inner: f64, material: Material) -> Result<Self, FemError> {
        if outer.is_finite() && inner >= 0.0 && inner < outer {
            Ok(Self { outer, inner, material })
        } else {
            Err(FemError::Section { outer_mm: outer, inner_mm: inner })
        }
    }

    /// Outer diameter, mm.
    pub fn outer(&self) -> f64 {
        self.outer
    }

    /// Material of the shaft.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// A = pi (D^2 - d^2) / 4, mm^2.
    pub fn area(&self) -> f64 {
        0.25 * PI * (self.outer.powi(2) - self.inner.powi(2))
    }

    /// I = pi (D^4 - d^4) / 64, mm^4.
    pub(crate) fn second_moment(&self) -> f64 {
        PI / 64.0 * (self.outer.powi(4) - self.inner.powi(4))
    }

    /// I_p = 2 I, mm^4.
    pub(crate) fn polar_moment(&self) -> f64 {
        2.0 * self.second_moment()
    }

    /// Bending stiffness E I, N mm^2.
    pub fn bending_stiffness(&self) -> f64 {
        self.material.young_mpa() * self.second_moment()
    }

    /// Torsional stiffness G I_p, N mm^2.
    pub fn torsional_stiffness(&self) -> f64 {
        self.material.lame_mpa().1 * self.polar_moment()
    }

    /// Axial stiffness E A, N.
    pub fn axial_stiffness(&self) -> f64 {
        self.material.young_mpa() * self.area()
    }

    /// Shear stiffness kappa G A, N.
    ///
    /// ```text
    /// kappa = 6 (1+nu) (1+m^2)^2 / [(7+6 nu) (1+m^2)^2 + (20+12 nu) m^2],   m = d/D
    /// ```
    /// Source: G. R. Cowper, J. Appl. Mech. 33 (1966) 335.
    pub fn shear_stiffness(&self) -> f64 {
        let (nu, m2) = (self.material.poisson(), (self.inner / self.outer).powi(2));
        let square = (1.0 + m2).powi(2);
        let kappa = 6.0 * (1.0 + nu) * square / ((7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * m2);
        kappa * self.material.lame_mpa().1 * self.area()
    }

    /// Mass per length rho A, t/mm.
    pub fn mass_per_length(&self) -> f64 {
        self.material.density_t_per_mm3() * self.area()
    }

    /// Mass moment of inertia about a diameter per length, rho I, t mm. About the axis it is twice as large.
    pub fn inertia_per_length(&self) -> f64 {
        self.material.density_t_per_mm3() * self.second_moment()
    }
}
