//! The gears, and the data common to both.

use mesh::{Bolts, FaceResolution, Foundation, MeshError};

use crate::{
    Scene,
    schema::{BoreScene, GearScene, MisalignmentScene, PairScene},
};

impl BoreScene {
    /// Whether the whole bore is rigid.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// The springs of an elastic bore.
    ///
    /// # Errors
    /// As [`Foundation::new`].
    pub fn foundation(&self) -> Result<Foundation, MeshError> {
        let bolts = self.bolts.map(|bolts| Bolts {
            count: bolts.count,
            first_angle: bolts.first_angle_deg.to_radians(),
            width: bolts.width_mm,
            heights: bolts.over_mm,
            stiffness: [bolts.radial_n_per_mm, bolts.tangential_n_per_mm, bolts.axial_n_per_mm],
            opens_beyond: bolts.opens.then_some(bolts.preload_n),
        });
        Foundation::new([self.radial_n_per_mm3, self.tangential_n_per_mm3, self.axial_n_per_mm3], bolts)
    }
}

impl Scene {
    /// Whether a gear stands on bolts that open.
    pub fn has_opening_bolts(&self) -> bool {
        self.gears().iter().any(|gear| gear.bore.bolts.is_some_and(|bolts| bolts.opens))
    }
}

impl MisalignmentScene {
    /// Whether the axes are parallel.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

impl GearScene {
    /// Number of teeth as a scene file states it: negative of an internal gear.
    pub(crate) fn signed_teeth(&self) -> i64 {
        if self.is_internal() { -i64::from(self.teeth) } else { i64::from(self.teeth) }
    }

    /// Whether the gear is a ring.
    pub fn is_internal(&self) -> bool {
        self.shaper.is_some()
    }

    /// Helix angle, rad.
    pub fn helix_angle(&self) -> f64 {
        self.helix_angle_deg.to_radians()
    }

    /// Face width, mm: the gear's own, otherwise that of the pair.
    pub fn width_mm(&self, pair: &PairScene) -> f64 {
        self.face_width_mm.unwrap_or(pair.face_width_mm)
    }
}

impl PairScene {
    /// Range of heights, measured from the pinion's mid-face, in which gears with given face widths (mm) both have
    /// flanks, mm. The first value is above the second if they pass each other.
    pub fn common_face_mm(&self, [pinion, wheel]: [f64; 2]) -> [f64; 2] {
        let offset = self.mid_face_offset_mm.unwrap_or(0.0);
        [(-0.5 * pinion).max(offset - 0.5 * wheel), (0.5 * pinion).min(offset + 0.5 * wheel)]
    }

    /// Elements along the face that a mesh of this order asks for on a gear of a width (mm), with root stress or without.
    pub(crate) fn face_elements(&self, width_mm: f64, order: u32, root_stress: bool) -> u32 {
        let resolution = if root_stress { FaceResolution::RootStress } else { FaceResolution::Contact };
        mesh::face_elements(width_mm, self.normal_module_mm, order, resolution)
    }
}
