//! Bearings whose seats are in other shafts, and shafts that do not rotate: carriers and their pins. Theory (79c).

use nalgebra::{Matrix6, Vector3};

use crate::{Bearing, GearboxError, SeatError, Structure};

/// Distance between two axes that is none: round-off of their places, mm.
const ONE_AXIS: f64 = 1e-9;

impl Structure {
    /// Whether a shaft does not rotate.
    pub fn stands(&self, shaft: usize) -> bool {
        self.standing.contains(&shaft)
    }

    /// Whether bearings can hold the turn of a shaft: it stands, or is fixed in space.
    pub(crate) fn can_hold_turn(&self, shaft: usize) -> bool {
        self.stands(shaft) || self.fixed == Some(shaft)
    }

    /// Place of a bearing from the origin of the shaft that its seat is part of, mm; `None` in the housing.
    pub(crate) fn seat(&self, bearing: &Bearing) -> Option<[f64; 3]> {
        let [outer, own] = [bearing.outer?, bearing.shaft].map(|shaft| self.shafts.get(shaft));
        let (outer, own) = (outer?.origin, own?.origin);
        Some([own[0] - outer[0], own[1] - outer[1], own[2] + bearing.position - outer[2]])
    }

    /// How far the seats of a shaft stand from their nominal places, mm, in the mean of its bearings: with those of the shafts
    /// that they are part of, through at most so many.
    pub(crate) fn seat_offset(&self, shaft: usize, through: usize) -> Vector3<f64> {
        let own = || self.bearings.iter().filter(|b| b.shaft == shaft);
        let of = |b: &Bearing| {
            let outer = b.outer.filter(|_| through > 0);
            b.offset + outer.map_or_else(Vector3::zeros, |outer| self.seat_offset(outer, through - 1))
        };
        own().map(of).sum::<Vector3<f64>>() / own().count().max(1) as f64
    }

    /// Checks bearings between shafts, and that bearings hold the turn of every shaft that stands.
    pub(crate) fn check_seats(&self) -> Result<(), GearboxError> {
        let name = |shaft: usize| self.shafts[shaft].name.clone();
        for bearing in &self.bearings {
            let Some(outer) = bearing.outer else { continue };
            self.has_shaft(&bearing.name, outer)?;
            let part = bearing.name.clone();
            if outer == bearing.shaft {
                return Err(SeatError::Itself { bearing: part, shaft: name(outer) }.into());
            }
            let Some([x, y, z]) = self.seat(bearing) else { continue };
            if x.hypot(y) > ONE_AXIS && !self.stands(outer) {
                return Err(SeatError::Turns { bearing: part, shaft: name(outer), arm_mm: x.hypot(y) }.into());
            }
            // A rigid body has room for it wherever it is.
            if !self.shafts[outer].pieces.is_empty() {
                self.on_shaft(&part, outer, z)?;
            }
        }
        for &shaft in self.standing.iter().chain(&self.fixed) {
            self.has_shaft("what stands", shaft)?;
            // Beside a fixed shaft the meshes may hold the turn of the carrier: all are looked at together.
            if self.fixed.is_some_and(|fixed| fixed != shaft) {
                continue;
            }
            let holds = |b: &&Bearing| (b.shaft == shaft || b.outer == Some(shaft)) && b.stiffness[(5, 5)] > 0.0;
            if !self.bearings.iter().any(|b| holds(&b)) {
                return Err(SeatError::Free { shaft: name(shaft) }.into());
            }
        }
        Ok(())
    }

    /// Checks that a part is on a shaft that turns.
    pub(crate) fn turns(&self, part: &str, disc: usize) -> Result<(), GearboxError> {
        let shaft = self.discs[disc].shaft;
        if !self.stands(shaft) {
            return Ok(());
        }
        Err(SeatError::Stands { part: part.into(), shaft: self.shafts[shaft].name.clone() }.into())
    }

    /// Checks that a torque or the input is on a shaft that turns in space.
    pub(crate) fn turns_in_space(&self, part: &str, disc: usize) -> Result<(), GearboxError> {
        let shaft = self.discs[disc].shaft;
        match self.fixed {
            None => self.turns(part, disc),
            Some(fixed) if fixed == shaft => {
                Err(SeatError::Fixed { part: part.into(), shaft: self.shafts[shaft].name.clone() }.into())
            }
            Some(_) => Ok(()),
        }
    }

    /// Checks that no shaft that is held stands, or has a bearing in common with another one.
    pub(crate) fn check_held_seats(&self, held: &[usize]) -> Result<(), GearboxError> {
        let held = |shaft: usize| held.contains(&shaft);
        let name = |shaft: usize| self.shafts[shaft].name.clone();
        if let Some(&shaft) = self.standing.iter().chain(&self.fixed).find(|shaft| held(**shaft)) {
            return Err(SeatError::Nothing { shaft: name(shaft) }.into());
        }
        for bearing in &self.bearings {
            let Some(outer) = bearing.outer else { continue };
            if let Some(shaft) = [bearing.shaft, outer].into_iter().find(|shaft| held(*shaft)) {
                return Err(SeatError::Held { bearing: bearing.name.clone(), shaft: name(shaft) }.into());
            }
        }
        Ok(())
    }
}

/// Displacements and turns at a place (mm) from where a rigid body's six coordinates are.
///
/// ```text
/// u_place = u + turn x r,   turn_place = turn
/// ```
pub(crate) fn rigid([x, y, z]: [f64; 3]) -> Matrix6<f64> {
    let mut moves = Matrix6::identity();
    let arm = [(0, 4, z), (0, 5, -y), (1, 3, -z), (1, 5, x), (2, 3, y), (2, 4, -x)];
    arm.into_iter().for_each(|(i, j, r)| moves[(i, j)] = r);
    moves
}

/// J of six coordinates: (x, y) to (-y, x), and tilts likewise.
pub(crate) fn quarter() -> Matrix6<f64> {
    let mut all = Matrix6::zeros();
    for at in [0, 3] {
        (all[(at, at + 1)], all[(at + 1, at)]) = (-1.0, 1.0);
    }
    all
}
