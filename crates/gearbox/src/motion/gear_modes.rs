//! Elastic modes of gears in motion, as coordinates in addition to those of shafts. Theory (62), (93b).
//!
//! ```text
//! P = q + L D(theta) x:   T = x.' (M - L'L) x./2 + P.' P./2,   V = V_contact(x, q) + q' Omega^2 q/2,   q = P - L D(theta) x
//! ```
//! q are amplitudes in the gear's own frame, which is at angle theta; x are displacements of its disc. The effect of
//! the rotation of D on velocities, and Coriolis forces on the modes, are smaller by W / omega than the terms that are
//! kept. They are neglected, as for a single pair.

use std::sync::Arc;

use dynamics::GearVibration;
use integrate::Forces;
use nalgebra::{DMatrix, DVector, Dyn, OMatrix, U12};
use reduction::GearModes;

use super::{MovingMesh, ReducedBodies, free_coordinates::FreeCoordinates};
use crate::{Assembly, ElasticBody, GearMesh, GearboxError, Train};

/// Turn of a gear's own frame between two of its meshes, rad, that is none.
const SAME: f64 = 1e-9;

/// A gear whose modes move.
#[derive(Debug, Clone)]
struct MovingGear {
    modes: Arc<GearModes>,
    disc: usize,
    /// Angle of its own frame from the common axes with the input at its start, rad, and turns of it a turn of the input.
    angle: f64,
    ratio: f64,
    /// Angle from tooth to tooth, rad.
    pitch: f64,
    /// Largest displacement of a flank by one unit of each mode, t^(-1/2).
    sizes: Vec<f64>,
    squares: DVector<f64>,
    /// 2 zeta omega.
    dampers: DVector<f64>,
}

/// A gear of a mesh: its number among those with modes, and R of q_mesh = R q, the turn into the frame that the mesh has of it.
type OfMesh = (usize, Option<DMatrix<f64>>);

/// Gears whose modes move, and what the coordinates z do to them.
#[derive(Debug, Clone, Default)]
pub(super) struct MovingGears {
    gears: Vec<MovingGear>,
    /// Both gears of each mesh that has modes.
    of_meshes: Vec<Option<[OfMesh; 2]>>,
    /// Displacements of the disc, 6 x n, and P, m x n, of each gear by the deviations z.
    discs: Vec<DMatrix<f64>>,
    own: Vec<DMatrix<f64>>,
    /// First of its coordinates among z.
    first: Vec<usize>,
}

impl MovingGears {
    /// All gears with modes in any mesh.
    ///
    /// # Errors
    /// [`GearboxError::NoModes`] for a gear that has modes in only one of its meshes, and for a gear without rotating
    /// patterns that is at different angles in two of them; [`GearboxError::LessThanModes`].
    pub fn new(
        assembly: &Assembly,
        (meshes, train): (&[GearMesh], &Train),
        elements: &[Box<dyn MovingMesh>],
    ) -> Result<Self, GearboxError> {
        let mut all = Self::default();
        let cycles = train.cycles(0.0);
        let discs = &assembly.structure().discs;
        for (i, (mesh, element)) in meshes.iter().zip(elements).enumerate() {
            let Some(kept) = element.modes() else {
                all.of_meshes.push(None);
                continue;
            };
            let direction = train.meshing()[i].direction;
            let angles = element.gear_angles(cycles[i]).map(|own| own + direction);
            let pitches = [&mesh.pair.pinion, &mesh.pair.wheel].map(|gear| gear.pitch_angle().abs());
            let mut both = Vec::new();
            let mut sizes = element.mode_sizes();
            let stand = angles.into_iter().zip(pitches);
            for ((disc, GearVibration { modes, damping_ratio }), (angle, pitch)) in
                mesh.discs.into_iter().zip(kept).zip(stand)
            {
                let rest = sizes.split_off(modes.count().min(sizes.len()));
                let own = std::mem::replace(&mut sizes, rest);
                match all.gears.iter().position(|gear| gear.disc == disc) {
                    Some(known) => both.push((known, all.seen_from(known, angle, &discs[disc].name)?)),
                    None => {
                        let body = ElasticBody::new(disc, &modes, angle);
                        body.check(&discs[disc].name, discs[disc].inertia())?;
                        let squares = DVector::from_column_slice(modes.squares());
                        let dampers = squares.map(|s| 2.0 * damping_ratio * s.sqrt());
                        let ratio = train.ratios()[discs[disc].shaft];
                        all.gears.push(MovingGear { modes, disc, angle, ratio, pitch, sizes: own, squares, dampers });
                        both.push((all.gears.len() - 1, None));
                    }
                }
            }
            all.of_meshes.push(both.try_into().ok());
        }
        // A gear keeps its modes in all of its meshes, or in none.
        let lone = meshes.iter().zip(&all.of_meshes).filter(|(_, own)| own.is_none());
        let known = |disc: &usize| all.gears.iter().any(|gear| gear.disc == *disc);
        if let Some(disc) = lone.flat_map(|(mesh, _)| mesh.discs).find(known) {
            let gear = discs[disc].name.clone();
            return Err(GearboxError::NoModes { gear, said: "it keeps them in one of its meshes alone" });
        }
        Ok(all)
    }

    /// Turn of a known gear's amplitudes to the frame at `angle`.
    fn seen_from(&self, known: usize, angle: f64, name: &str) -> Result<Option<DMatrix<f64>>, GearboxError> {
        let gear = &self.gears[known];
        let by = angle - gear.angle;
        let whole = (by / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        if (by - whole).abs() < SAME {
            return Ok(None);
        }
        let no_modes = || GearboxError::NoModes { gear: name.into(), said: "it stands otherwise in two meshes" };
        Ok(Some(gear.modes.standing().ok_or_else(no_modes)?.turned(by)))
    }

    /// The gears with their positions among the coordinates of the bodies and of the motion.
    pub fn placed(mut self, assembly: &Assembly, bodies: &ReducedBodies, free: &FreeCoordinates) -> Self {
        let deviations = free.of_deviations();
        for (g, gear) in self.gears.iter().enumerate() {
            let (disc, modes) = (bodies.of_node(assembly.disc(gear.disc).unwrap_or(0)), bodies.of_gear(g));
            self.discs.push(deviations.rows(disc, 6).into_owned());
            self.first.push(free.first_of_gears + modes.start - bodies.of_gear(0).start);
            self.own.push(deviations.rows_range(modes).into_owned());
        }
        self
    }

    /// Transforms the n coordinates z for the same motion continued with the input rotated by an angle (rad) after
    /// which all gears have rotated by whole teeth. Amplitudes in the gears' own frames rotate; all other coordinates
    /// stay the same.
    ///
    /// # Errors
    /// [`GearboxError::ModesWithoutPeriod`] for a gear that is not condensed by sectors.
    pub fn turned(&self, input: f64, n: usize, assembly: &Assembly) -> Result<DMatrix<f64>, GearboxError> {
        let mut all = DMatrix::identity(n, n);
        for (gear, first) in self.gears.iter().zip(&self.first) {
            let teeth = (gear.ratio * input / gear.pitch).round() as i64;
            let name = || assembly.structure().discs[gear.disc].name.clone();
            let own =
                gear.modes.turned_by_teeth(teeth).ok_or_else(|| GearboxError::ModesWithoutPeriod { gear: name() })?;
            all.view_mut((*first, *first), own.shape()).copy_from(&own);
        }
        Ok(all)
    }

    /// Disc and modes of each gear, in the order of their coordinates.
    pub fn modes(&self) -> impl Iterator<Item = (usize, &GearModes)> {
        self.gears.iter().map(|gear| (gear.disc, &*gear.modes))
    }

    /// Whether no gear has modes.
    pub fn is_empty(&self) -> bool {
        self.gears.is_empty()
    }

    /// A of q = A z of a gear with the input at an angle, m x n.
    fn map(&self, g: usize, angle: f64) -> DMatrix<f64> {
        let gear = &self.gears[g];
        &self.own[g] - gear.modes.coupling_at(gear.angle + gear.ratio * angle) * &self.discs[g]
    }

    /// dA/d(angle of the input) of a gear, m x n.
    fn map_rate(&self, g: usize, angle: f64) -> DMatrix<f64> {
        let gear = &self.gears[g];
        gear.modes.coupling_rate_at(gear.angle + gear.ratio * angle) * &self.discs[g] * -gear.ratio
    }

    /// Map from the coordinates z to the amplitudes of both gears of a mesh, in the form that the mesh uses: (m_1 +
    /// m_2) x n. `None` for a mesh without modes.
    pub fn map_of(&self, mesh: usize, angle: f64) -> Option<DMatrix<f64>> {
        self.stacked(mesh, |g| self.map(g, angle))
    }

    /// Derivative of this map by the angle of the input.
    pub fn map_rate_of(&self, mesh: usize, angle: f64) -> Option<DMatrix<f64>> {
        self.stacked(mesh, |g| self.map_rate(g, angle))
    }

    fn stacked(&self, mesh: usize, of: impl Fn(usize) -> DMatrix<f64>) -> Option<DMatrix<f64>> {
        let both = self.of_meshes.get(mesh)?.as_ref()?.each_ref().map(|(g, turn)| match turn {
            Some(turn) => turn * of(*g),
            None => of(*g),
        });
        let [rows, columns] = [both[0].nrows() + both[1].nrows(), both[0].ncols()];
        let mut all = DMatrix::zeros(rows, columns);
        all.rows_mut(0, both[0].nrows()).copy_from(&both[0]);
        all.rows_mut(both[0].nrows(), both[1].nrows()).copy_from(&both[1]);
        Some(all)
    }

    /// Adds the forces of the modes alone with the input at `angle` (rad). `given` (rad/s) is the part of its speed
    /// that is not a coordinate; `turn` is the index of the coordinate of the input's rotation, if that is free.
    pub fn add(&self, [angle, given]: [f64; 2], [z, v]: [&DVector<f64>; 2], turn: Option<usize>, out: &mut Forces) {
        for (g, gear) in self.gears.iter().enumerate() {
            let map = self.map(g, angle);
            let (q, rate) = (&map * z, &map * v);
            let (elastic, damped) = (-gear.squares.component_mul(&q), gear.dampers.component_mul(&rate));
            out.conservative += map.tr_mul(&elastic);
            out.other -= map.tr_mul(&damped);
            out.dissipated += damped.dot(&rate);
            let along = elastic.dot(&(self.map_rate(g, angle) * z));
            if let Some(i) = turn {
                out.conservative[i] += along;
            }
            out.parametric -= along * given;
            if out.tangents {
                let of = |values: &DVector<f64>| map.tr_mul(&(DMatrix::from_diagonal(values) * &map));
                out.stiffness += of(&gear.squares);
                out.damping += of(&gear.dampers);
            }
        }
    }

    /// Elastic energy of the modes alone, N mm.
    pub fn energy(&self, angle: f64, z: &DVector<f64>) -> f64 {
        let of = |(g, gear): (usize, &MovingGear)| {
            let q = self.map(g, angle) * z;
            0.5 * q.dot(&gear.squares.component_mul(&q))
        };
        self.gears.iter().enumerate().map(of).sum()
    }

    /// Stiffness of the modes alone, n x n.
    pub fn stiffness(&self, angle: f64, n: usize) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(n, n);
        for (g, gear) in self.gears.iter().enumerate() {
            let map = self.map(g, angle);
            all += map.tr_mul(&(DMatrix::from_diagonal(&gear.squares) * &map));
        }
        all
    }

    /// The part of P for which no gear deforms when the other coordinates z move, in the rows of P, n x n.
    pub fn undeformed(&self, angle: f64, n: usize) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(n, n);
        for (g, first) in self.first.iter().enumerate() {
            let own = &self.own[g] - self.map(g, angle);
            all.rows_mut(*first, own.nrows()).copy_from(&own);
        }
        all
    }

    /// Forces -(L D)' f of a mesh's `on_modes` and of the modes' own stiffness and dampers on the discs: disc index and
    /// force, common axes. `on_modes` are forces on the amplitudes, mesh by mesh.
    pub fn on_discs(
        &self,
        angle: f64,
        [z, v]: [&DVector<f64>; 2],
        on_modes: &[Option<DVector<f64>>],
    ) -> Vec<(usize, DVector<f64>)> {
        let of = |(g, gear): (usize, &MovingGear)| {
            let map = self.map(g, angle);
            let mut force = -gear.squares.component_mul(&(&map * z)) - gear.dampers.component_mul(&(&map * v));
            for (both, found) in self.of_meshes.iter().zip(on_modes) {
                let (Some(both), Some(found)) = (both, found) else { continue };
                let mut at = 0;
                for (own, turn) in both {
                    let count = self.gears[*own].modes.count();
                    if *own == g {
                        let part = found.rows(at, count);
                        match turn {
                            Some(turn) => force += turn.tr_mul(&part),
                            None => force += part,
                        }
                    }
                    at += count;
                }
            }
            (gear.disc, -gear.modes.coupling_at(gear.angle + gear.ratio * angle).tr_mul(&force))
        };
        self.gears.iter().enumerate().map(of).collect()
    }

    /// Indices of the coordinates z that are modes, each with its magnitude for a displacement of `length` (mm) at the
    /// flanks.
    pub fn sizes(&self, length: f64) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.gears.iter().zip(&self.first).flat_map(move |(gear, first)| {
            gear.sizes.iter().enumerate().map(move |(j, size)| (first + j, length / size))
        })
    }
}

/// Stiffness K of displacements and amplitudes of a mesh for the coordinates z: Y' K Y, Y the rows of both.
pub(super) fn with_modes(
    to_gears: &OMatrix<f64, U12, Dyn>,
    map: &DMatrix<f64>,
    stiffness: &DMatrix<f64>,
) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(12 + map.nrows(), map.ncols());
    all.rows_mut(0, 12).copy_from(to_gears);
    all.rows_mut(12, map.nrows()).copy_from(map);
    all.tr_mul(&(stiffness * &all))
}
