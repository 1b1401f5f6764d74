//! Inertia in the frame of a carrier that turns in space. Theory (86b), (86c).

use fem::Condensation;
use nalgebra::{DMatrix, DVector, Matrix6, SymmetricEigen, Vector6};

use crate::{Assembly, GearboxError, Structure, shafts_in_shafts::quarter};

/// Eigenvalue of a stiffness whose diagonal is 1, up to which it is round-off.
const NOTHING: f64 = 1e-12;

/// What a frame that turns at W adds to mass, gyroscopic matrix and stiffness of an assembly in space, theory (86b):
///
/// ```text
/// q = R(W t) p,  R' = W J R:   M p'' + (2 W M J + G) p' + (K + W^2 (M J^2 + K_p) + W G J + W C_s J) p = R' f
/// ```
/// J turns displacements, tilts and the patterns of elastic gears by a right angle about z. G is that of speeds in space, C_s the
/// damping of bearings in space. K_p is what the centrifugal forces on planets do in seats that turn with their carrier.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TurningFrame {
    /// J.
    turn: DMatrix<f64>,
    /// 2 M J, t, t mm, t mm^2; skew-symmetric.
    pub coriolis: DMatrix<f64>,
    /// M J^2 + K_p, t, t mm, t mm^2; symmetric.
    pub pull: DMatrix<f64>,
    /// C_s J, N s/mm, N s, N mm s; zero without dampers in space.
    pub dragged: Option<DMatrix<f64>>,
}

impl Structure {
    /// Speed of the frame of the carrier by those of all shafts in space, rad/s about +z; 0 where no shaft is fixed in space.
    pub(crate) fn frame_speed(&self, speeds: &[f64]) -> Result<f64, GearboxError> {
        let turning = self.standing.iter().filter(|_| self.fixed.is_some());
        let mut all = turning.filter_map(|&shaft| Some((shaft, *speeds.get(shaft)?)));
        let Some((_, frame)) = all.next() else { return Ok(0.0) };
        match all.find(|(_, speed)| (speed - frame).abs() > 1e-9 * frame.abs()) {
            Some((shaft, value)) => {
                let part = self.shafts[shaft].name.clone();
                Err(GearboxError::OutOfRange {
                    part,
                    quantity: "speed that is not that of the carrier's frame, rad/s",
                    value,
                })
            }
            None => Ok(frame),
        }
    }
}

impl TurningFrame {
    /// Of an assembly with a shaft that is fixed in space, and this mass; `None` of others.
    pub fn of(assembly: &Assembly, mass: &DMatrix<f64>) -> Result<Option<Self>, GearboxError> {
        if assembly.structure().fixed.is_none() {
            return Ok(None);
        }
        let turn = assembly.quarter_turn();
        let moved = mass * &turn;
        let coriolis = &moved - moved.transpose();
        let pull = &moved * &turn;
        let mut pull = 0.5 * (&pull + pull.transpose());
        add_pressed_seats(assembly, &bent(assembly, &(mass * assembly.places_of_axes()))?, &mut pull);
        let dampers = assembly.damping_in_space();
        let dragged = (dampers.amax() > 0.0).then(|| dampers * &turn);
        Ok(Some(Self { turn, coriolis, pull, dragged }))
    }

    /// G J of a gyroscopic matrix; symmetric.
    pub fn tilted(&self, gyroscopic: &DMatrix<f64>) -> DMatrix<f64> {
        let own = gyroscopic * &self.turn;
        0.5 * (&own + own.transpose())
    }
}

/// Displacements of all coordinates under forces that bearings alone hold; what they do not hold is not moved. Meshes are left
/// out: they would take their share with them where they turn.
fn bent(assembly: &Assembly, force: &DVector<f64>) -> Result<DVector<f64>, GearboxError> {
    let stiffness = assembly.stiffness_without_meshes();
    let kept: Vec<usize> = assembly.seat_nodes().into_iter().flat_map(|(node, _)| node..node + 6).collect();
    let condensation = Condensation::new(&stiffness, &kept)?;
    let (k, f) = (condensation.of(&stiffness), condensation.map.tr_mul(force));
    let scale = k.diagonal().map(|own| if own > 0.0 { own.sqrt().recip() } else { 0.0 });
    let scaled = DMatrix::from_fn(kept.len(), kept.len(), |i, j| scale[i] * 0.5 * (k[(i, j)] + k[(j, i)]) * scale[j]);
    let found = SymmetricEigen::new(scaled);
    let mut along = found.eigenvectors.tr_mul(&f.component_mul(&scale));
    along.iter_mut().zip(&found.eigenvalues).for_each(|(x, held)| *x = if *held > NOTHING { *x / held } else { 0.0 });
    Ok(&condensation.map * (found.eigenvectors * along).component_mul(&scale))
}

/// Adds K_p: bearings that centrifugal forces press at unit speed, `bent` the displacements by these. The seat turns by d with
/// its carrier, about whose axis it is at r. To the second order the energy is, with v the displacement of the bearing in the
/// axes of its seat and g = k v under the centrifugal forces,
///
/// ```text
/// -d (k J v) . E q - d g . J (E q)_(d = 0) - d^2 g . r/2
/// ```
fn add_pressed_seats(assembly: &Assembly, bent: &DVector<f64>, all: &mut DMatrix<f64>) {
    let structure = assembly.structure();
    let quarter = quarter();
    for (i, bearing) in structure.bearings.iter().enumerate().filter(|(_, own)| structure.seat_turns(own)) {
        let Some([x, y, _]) = structure.seat(bearing) else { continue };
        let ends: Vec<(usize, &Matrix6<f64>)> = assembly.bearing_ends(i).collect();
        let [_, (seat, _)] = ends[..] else { continue };
        let v: Vector6<f64> = ends.iter().map(|(at, own)| *own * bent.fixed_rows::<6>(*at)).sum();
        let stiffness = 0.5 * (bearing.stiffness + bearing.stiffness.transpose());
        let force = stiffness * v;
        let turn = seat + 5;
        // Energy d (c . q): a row and a column.
        let mut along = |at: usize, share: f64| {
            all[(turn, at)] += share;
            all[(at, turn)] += share;
        };
        let (first, second) = (stiffness * quarter * v, quarter.tr_mul(&force));
        for (at, own) in &ends {
            let [by_slope, by_force] = [own.tr_mul(&first), own.tr_mul(&second)];
            for k in 0..6 {
                along(at + k, -by_slope[k] - if at + k == turn { 0.0 } else { by_force[k] });
            }
        }
        all[(turn, turn)] -= force[0] * x + force[1] * y;
    }
}
