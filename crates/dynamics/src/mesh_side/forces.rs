//! Forces of one side, with their derivatives.

use contact::{ContactError, Wrench, slice::EvaluationLevel};
use geometry::GearPair;
use nalgebra::{DMatrix, DVector, SMatrix};

use super::{MeshSide, Placed};
use crate::{COORDINATES, Displacement, elastic_displacement::ElasticDisplacement};

/// Forces of one side on the twelve coordinates.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SideForce {
    /// Normal forces: N, N mm. What does the work of the coordinates: turns have the moment about the gear's own axis ([`Placed`]).
    pub normal: Displacement,
    /// Friction.
    pub friction: Displacement,
    /// -d(normal + friction)/dd.
    pub stiffness: SMatrix<f64, 12, 12>,
    /// Forces on the normal modes and their tangents; none without modes.
    pub modal: Option<ModalForce>,
}

/// Forces on the modes of both gears, N t^(-1/2).
#[derive(Debug, Clone, PartialEq)]
pub struct ModalForce {
    /// Normal forces, m entries.
    pub normal: DVector<f64>,
    /// Friction forces, m entries.
    pub friction: DVector<f64>,
    /// -d(forces)/d(d, q), (12 + m) x (12 + m), if requested.
    pub stiffness: Option<DMatrix<f64>>,
}

impl ModalForce {
    /// Adds the forces of the other side.
    pub(crate) fn add(&mut self, other: &Self) {
        self.normal += &other.normal;
        self.friction += &other.friction;
        if let (Some(all), Some(own)) = (&mut self.stiffness, &other.stiffness) {
            *all += own;
        }
    }
}

/// Contact of both sides at one place and displacement.
#[derive(Debug, Clone)]
pub(crate) struct SideContacts {
    /// Mesh cycles, and displacement.
    pub at: (f64, ElasticDisplacement),
    pub driving: SideForce,
    pub coast: Option<SideForce>,
    /// Whether stiffness is among what was asked for.
    pub tangents: bool,
}

impl MeshSide {
    /// Strain energy of contact with the gears displaced and deformed, N mm. It overwrites the last
    /// evaluation.
    pub fn energy(&mut self, pair: &GearPair, cycles: f64, at: &ElasticDisplacement) -> Result<f64, ContactError> {
        let poses = self.poses(pair, cycles, &at.d);
        self.contact.deform(at.q.as_slice());
        self.contact.evaluate_near(&poses, EvaluationLevel::Energy)?;
        Ok(self.contact.strain_energy())
    }

    /// Contact with the gears displaced and deformed; without `tangents` the stiffness is undefined.
    pub fn evaluate(
        &mut self,
        pair: &GearPair,
        cycles: f64,
        at: &ElasticDisplacement,
        tangents: bool,
    ) -> Result<SideForce, ContactError> {
        let placed = self.placed(pair, cycles, &at.d);
        self.contact.deform(at.q.as_slice());
        let level = if tangents { EvaluationLevel::Tangent } else { EvaluationLevel::Forces };
        let force = self.contact.evaluate_near(&placed.poses, level)?;
        let all = placed.generalised(vector(&force.wrench));
        let mut stiffness = SMatrix::from_fn(|i, j| -force.tangent[i][j]);
        if tangents {
            stiffness = placed.generalised_slope(stiffness);
        }
        let friction = self.friction(&placed);
        let modal = self.contact.modal().map(|modal| {
            let (forces, n) = (modal.forces(), 2 * COORDINATES + modal.count());
            ModalForce {
                normal: DVector::from_column_slice(&forces.normal),
                friction: DVector::from_column_slice(&forces.friction),
                stiffness: tangents.then(|| {
                    let common = -DMatrix::from_row_slice(n, n, &forces.tangent);
                    let Some(g) = &placed.work else { return common };
                    let mut whole = DMatrix::identity(n, n);
                    whole.view_mut((0, 0), (2 * COORDINATES, 2 * COORDINATES)).copy_from(g);
                    &whole * common * whole.transpose()
                }),
            }
        });
        Ok(SideForce { normal: all - friction, friction, stiffness, modal })
    }

    /// Deepest overlap of the flanks at the position of the last evaluation, deformed only by the kept modes, mm;
    /// negative if they are apart. With modes it overwrites the last evaluation.
    pub fn overlap(&mut self, pair: &GearPair, cycles: f64, at: &ElasticDisplacement) -> f64 {
        // Where flanks overlap the deepest place is among the rows.
        let deepest = self.contact.rows().iter().fold(f64::MIN, |m, row| m.max(-row.gap));
        if deepest > 0.0 {
            return deepest;
        }
        let poses = self.poses(pair, cycles, &at.d);
        self.contact.deform(at.q.as_slice());
        self.contact.overlap(&poses)
    }

    /// Friction alone, from the rows of the last evaluation.
    fn friction(&self, placed: &Placed) -> Displacement {
        let mut sum = Displacement::zeros();
        if self.options.contact.friction == 0.0 {
            return sum;
        }
        for (row, &f) in self.contact.rows().iter().zip(self.contact.solver().forces()) {
            let force = f * (row.traction - row.normal);
            for (g, sign) in [1.0, -1.0].into_iter().enumerate() {
                let arm = row.position - placed.poses[g].translation.vector;
                let moment = arm.cross(&force);
                for i in 0..3 {
                    sum[COORDINATES * g + i] += sign * force[i];
                    sum[COORDINATES * g + 3 + i] += sign * moment[i];
                }
            }
        }
        placed.generalised(sum)
    }
}

/// Forces and moments of both gears as one vector.
fn vector(wrench: &[Wrench; 2]) -> Displacement {
    Displacement::from_fn(|i, _| {
        let w = &wrench[i / COORDINATES];
        if i % COORDINATES < 3 { w.force[i % 3] } else { w.moment[i % 3] }
    })
}
