//! An elastic foundation under the bore of a gear. Theory (13d).

use crate::{Bolts, Face, Mesh, MeshError, SpringPoint, spring_point::along_cylinder};

/// Springs between the faces of a bore and the cross-section of the shaft: all around, and at places of the gear.
///
/// ```text
/// t = -D u,   D = k_r e_r e_r' + k_t e_t e_t' + k_a e_z e_z'
/// K_ij = integral of N_i N_j D dA                                    over the held faces
/// ```
/// | name | unit | meaning |
/// |---|---|---|
/// | t | MPa | traction on the bore |
/// | u | mm | displacement of the bore in the gear's own frame, which moves with the shaft |
/// | k_r, k_t, k_a | N/mm^3 | stiffness per area along the radius, along the circumference, along the axis |
/// | N | 1 | shape functions of the faces |
///
/// The springs push and pull alike: the shaft has neither clearance nor a side without load. As k grows, the bore becomes
/// a rigid one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foundation {
    all_around: [f64; 3],
    bolts: Option<Bolts>,
}

/// Bolts from which on no motion of a gear that only they hold is left to how wide they are.
const FEWEST_BOLTS: u32 = 3;

impl Foundation {
    /// Radial, tangential and axial stiffness per area all around, N/mm^3, 0 where nothing holds, and what holds at places.
    /// Tangential and axial springs hold every motion of a body; without either of them one is left free.
    ///
    /// # Errors
    /// [`MeshError::FreeBore`] if the gear could turn or move along its axis; [`MeshError::FewBolts`] if only one or two
    /// places hold it so; [`MeshError::BadFoundation`] for a stiffness that is negative or not finite, [`MeshError::BadPreload`]
    /// for such a force; [`MeshError::NothingOpens`] for bolts that open and have no stiffness along the radius.
    pub fn new(all_around: [f64; 3], bolts: Option<Bolts>) -> Result<Self, MeshError> {
        let at_places = bolts.map_or([0.0; 3], |bolts| bolts.stiffness);
        if let Some(&found) = all_around.iter().chain(&at_places).find(|k| !k.is_finite() || **k < 0.0) {
            return Err(MeshError::BadFoundation { found });
        }
        if let Some((preload, bolts)) = bolts.and_then(|bolts| Some((bolts.opens_beyond?, bolts))) {
            if !preload.is_finite() || preload < 0.0 {
                return Err(MeshError::BadPreload { found: preload });
            }
            if bolts.stiffness[0] == 0.0 {
                return Err(MeshError::NothingOpens);
            }
        }
        let holds = |axis: usize| all_around[axis] + at_places[axis] > 0.0;
        match (holds(1), holds(2)) {
            (true, true) => {}
            (false, _) => return Err(MeshError::FreeBore { motion: "turn about its axis", missing: "tangential" }),
            (true, false) => return Err(MeshError::FreeBore { motion: "move along its axis", missing: "axial" }),
        }
        let alone = all_around[1] * all_around[2] == 0.0;
        match bolts {
            Some(bolts) if alone && bolts.count < FEWEST_BOLTS => {
                Err(MeshError::FewBolts { count: bolts.count, fewest: FEWEST_BOLTS })
            }
            _ => Ok(Self { all_around, bolts }),
        }
    }

    /// Whether every tooth is held alike.
    pub fn is_cyclic(&self) -> bool {
        self.bolts.is_none()
    }

    /// Stiffness all around, N/mm^3.
    pub fn all_around(&self) -> [f64; 3] {
        self.all_around
    }

    /// The bolts.
    pub fn bolts(&self) -> Option<Bolts> {
        self.bolts
    }

    /// The springs under some faces of a gear; of bolts that open those that do not.
    ///
    /// # Errors
    /// [`MeshError::BoltOffBore`] if a bolt reaches beyond the faces.
    pub fn springs(&self, mesh: &Mesh, faces: &[Face]) -> Result<Vec<SpringPoint>, MeshError> {
        let mut all = Vec::new();
        if self.all_around.iter().any(|k| *k > 0.0) {
            for face in faces {
                let spring = |point: crate::face_area::AreaPoint| SpringPoint {
                    face: *face,
                    shape: point.shape,
                    stiffness: point.area * along_cylinder(self.all_around, point.position),
                };
                all.extend(face.area_points(mesh).map(spring));
            }
        }
        if let Some(bolts) = self.bolts {
            all.extend(bolts.points(mesh, faces, (1, 0.0))?.into_iter().map(|point| point.spring));
        }
        Ok(all)
    }
}
