//! A static gearbox as the start of its motion: plan, mean stiffness, damping and elements of its meshes.

use std::{f64::consts::TAU, sync::Arc};

use answer::Remark;
use dynamics::{MeshResonance, RigidBody, Speed};
use gearbox::{
    GearMesh, GearboxError, GearboxPosition, Meshing, Operation, Structure, Train, Vector12,
    motion::{ContactSpring, GearVibration, MapRequest, MotionPlan, MovingMesh},
};
use integrate::Settle;
use reduction::GearModes;
use scene::gearbox::{Gearbox, GearboxDamping, GearboxDrive, GearboxMotion, MeshModel};

use super::{meshes::ReducedMesh, swings::GearModesOfDiscs};
use crate::{
    AnalysisError, GearCache, Progress,
    motion::{Elasticity, OF_GEARBOX, QuasiStatic},
};

/// Error with which a map is taken, over that aimed at.
const WORST: f64 = 10.0;
/// Phases of a cycle at which the contact is looked at for its mean stiffness.
const PHASES: usize = 32;

/// A mesh in motion; of a map its error over the mean approach, beside the most with which it is taken.
pub(super) type MadeMesh = (Box<dyn MovingMesh>, Option<[f64; 2]>);

/// What is known of the gearbox at rest when its motion begins.
pub(super) struct AtRest<'a> {
    pub file: &'a Gearbox,
    pub structure: &'a Structure,
    /// The structure with springs in place of rolling elements.
    pub linear: &'a Structure,
    pub meshes: &'a [GearMesh],
    pub operation: &'a Operation,
    pub train: &'a Train,
    pub reduced: &'a [ReducedMesh],
    pub positions: &'a [GearboxPosition],
    /// Positions with the load on the coast flanks, where maps of these are made; else none.
    pub on_coast: &'a [GearboxPosition],
    /// Elastic modes of the gears that move with the meshes.
    pub modes: &'a GearModesOfDiscs,
    /// Lowest elastic frequency of both gears of each mesh, bore held and flanks free, Hz; none where nothing moves.
    pub lowest_hz: &'a [[f64; 2]],
    /// Keeps maps of the contact between runs.
    pub cache: &'a dyn GearCache,
}

impl AtRest<'_> {
    /// Plan of the integration of its motion.
    pub fn plan(&self, asked: &GearboxMotion) -> MotionPlan {
        MotionPlan {
            scheme: asked.scheme,
            cycles: u64::from(asked.cycles),
            steps_per_cycle: u64::from(asked.steps_per_cycle),
            steps_per_row: u64::from(asked.steps_per_row),
            tolerance: asked.error_tolerance,
            stop_at_events: asked.stop_at_events,
            settle: asked.settle.map(|(tolerance, most)| Settle { tolerance, most: u64::from(most) }),
            shoots: asked.shoots,
        }
    }

    /// Length of a step, s; for a ramp the longest step, at the lowest speed.
    pub fn step(&self, asked: &GearboxMotion) -> f64 {
        let slowest = asked.speed_rpm.min(asked.to_speed_rpm.unwrap_or(asked.speed_rpm)) * TAU / 60.0;
        1.0 / (self.fastest(slowest) * f64::from(asked.steps_per_cycle))
    }

    /// Given speed of the input: constant, or a ramp over its given duration, otherwise over all cycles.
    pub fn nominal(&self, asked: &GearboxMotion) -> Speed {
        let from = asked.speed_rpm * TAU / 60.0;
        let Some(to_rpm) = asked.to_speed_rpm else { return Speed::Constant(from) };
        let to = to_rpm * TAU / 60.0;
        // The mean speed of the smooth step is that of both ends.
        let turned = f64::from(asked.cycles) / self.fastest(1.0);
        let duration = asked.duration.unwrap_or(turned / (0.5 * (from + to)));
        Speed::Ramp { from, to, start: 0.0, duration }
    }

    /// Torque of all loads, referred to the input by the numbers of teeth, N mm.
    pub fn load_at_input(&self) -> f64 {
        let shaft = |disc: usize| self.structure.discs[disc].shaft;
        self.operation.torques.iter().map(|t| t.torque * self.train.ratios()[shaft(t.disc)]).sum()
    }

    /// Displacements of a mesh at all positions.
    pub fn stands(&self, mesh: usize) -> Vec<Vector12> {
        stands(self.positions, mesh)
    }

    pub fn spring(&self, mesh: usize) -> Result<ContactSpring, GearboxError> {
        let stands = self.stands(mesh);
        let about = stands.iter().sum::<Vector12>() / stands.len().max(1) as f64;
        let named = |source| GearboxError::AtMesh { mesh: self.meshes[mesh].name.clone(), source: Box::new(source) };
        let own = &self.meshes[mesh];
        let alike = GearMesh { pair: own.pair.without_pitch_errors(), ..own.clone() };
        let mut exact = self.reduced[mesh].exact(&alike).map_err(named)?;
        if alike.pair == own.pair {
            return ContactSpring::of(&mut exact, &about, PHASES).map_err(named);
        }
        let force =
            self.positions.iter().map(|p| p.meshes[mesh].normal_force).sum::<f64>() / stands.len().max(1) as f64;
        ContactSpring::under(&mut exact, &about, force, PHASES).map_err(named)
    }

    /// Mean torque of a mesh on its driven gear, N mm, without sign.
    pub fn torque(&self, mesh: usize) -> f64 {
        let driven = self.reduced[mesh].options.driven();
        let all = self.positions.iter().map(|p| p.meshes[mesh].moment[driven][2]);
        (all.sum::<f64>() / self.positions.len().max(1) as f64).abs()
    }

    /// A mesh through its own static cycle, under its mean torque and with its axes in their mean positions.
    pub fn cycle(&self, mesh: usize) -> Result<QuasiStatic, AnalysisError> {
        let about = self.stands(mesh).iter().sum::<Vector12>() / self.positions.len().max(1) as f64;
        self.reduced[mesh].cycle(&self.meshes[mesh], self.torque(mesh), &about, self.file.positions_per_cycle)
    }

    /// Damping along the normal, N s/mm: that of the contact lines, or that of the damping ratio of both gears
    /// vibrating against each other.
    ///
    /// ```text
    /// c = 2 zeta sqrt(k m_e),   1/m_e = cos^2 b_b (r_b1^2/J_1 + r_b2^2/J_2)
    /// ```
    /// J is the inertia of a gear, with all parts on its shaft if that is held; it is infinite if a held shaft keeps
    /// the speed of the input.
    pub fn damping(&self, mesh: usize, bodies: &[RigidBody], cycle: &QuasiStatic, asked: &GearboxMotion) -> f64 {
        let ratio = match asked.mesh_damping {
            GearboxDamping::Ratio(ratio) => ratio,
            GearboxDamping::PerLength(per_length) => return per_length * cycle.line_length,
        };
        let mobility = self.mobility(mesh, bodies, asked);
        if mobility.is_finite() { 2.0 * ratio * (self.normal_stiffness(mesh, cycle) / mobility).sqrt() } else { 0.0 }
    }

    /// Resonance of both gears of a mesh vibrating against each other on its mean stiffness, with a damper along the
    /// normal (N s/mm).
    ///
    /// ```text
    /// f = sqrt(k / m_e) / (2 pi),   zeta = c / (2 sqrt(k m_e))
    /// ```
    pub fn resonance(
        &self,
        mesh: usize,
        bodies: &[RigidBody],
        (cycle, damping): (&QuasiStatic, f64),
        asked: &GearboxMotion,
    ) -> MeshResonance {
        let (stiffness, mobility) = (self.normal_stiffness(mesh, cycle), self.mobility(mesh, bodies, asked));
        MeshResonance {
            hz: (stiffness * mobility).sqrt() / TAU,
            damping: 0.5 * damping * (mobility / stiffness).sqrt(),
        }
    }

    /// Mean stiffness of a mesh along the normal, N/mm.
    fn normal_stiffness(&self, mesh: usize, cycle: &QuasiStatic) -> f64 {
        cycle.stiffness / self.meshes[mesh].pair.base_helix_angle().cos().powi(2)
    }

    /// 1/m_e of both gears turning against each other along the normal, 1/t.
    fn mobility(&self, mesh: usize, bodies: &[RigidBody], asked: &GearboxMotion) -> f64 {
        let inertia = |gear: usize| {
            let (file, shaft) = (self.file, self.file.gears[gear].shaft);
            if !file.shafts[shaft].held {
                return bodies[gear].polar_inertia;
            }
            if asked.drive == GearboxDrive::Speed && shaft == file.input.shaft {
                return f64::INFINITY;
            }
            let gears = file.gears.iter().zip(bodies).filter(|(own, _)| own.shaft == shaft);
            let machines = file.torques.iter().filter(|own| own.shaft == shaft).map(|own| own.inertia);
            let input = if shaft == file.input.shaft { file.input.inertia } else { 0.0 };
            gears.map(|(_, body)| body.polar_inertia).sum::<f64>() + machines.sum::<f64>() + input
        };
        let pair = &self.meshes[mesh].pair;
        let lever = [&pair.pinion, &pair.wheel].map(|g| g.base_radius() * pair.base_helix_angle().cos());
        let turns = |i: usize| lever[i] * lever[i] / inertia(self.file.meshes[mesh].gears[i]);
        turns(0) + turns(1)
    }

    /// Effects of elasticity that are neglected for the gears of a mesh with the static cycle `cycle`.
    ///
    /// # Errors
    /// [`AnalysisError::Statistics`] if the transmission error is not a finite number.
    pub fn elasticity(&self, mesh: usize, cycle: &QuasiStatic) -> Result<Elasticity, AnalysisError> {
        let kept = self.meshes[mesh].discs.map(|disc| self.modes.get(disc).cloned().flatten());
        let lowest = self.lowest_hz.get(mesh).copied().unwrap_or([f64::INFINITY; 2]);
        Elasticity::of((&self.reduced[mesh].scene, OF_GEARBOX), lowest, cycle, self.vibrating(kept))
    }

    /// Modes of both gears of a mesh with their damping.
    fn vibrating(&self, kept: [Option<Arc<GearModes>>; 2]) -> Option<[GearVibration; 2]> {
        let damping_ratio = self.file.modes.map_or(0.0, |asked| asked.damping_ratio);
        match kept.map(|modes| modes.map(|modes| GearVibration { modes, damping_ratio })) {
            [Some(a), Some(b)] => Some([a, b]),
            _ => None,
        }
    }

    /// A mesh in motion; for a map also its error relative to the mean approach, and the largest permitted error.
    pub fn element(
        &self,
        mesh: usize,
        asked: &GearboxMotion,
        (spring, cycle, damping): (&ContactSpring, &QuasiStatic, f64),
        (progress, remarks): (&dyn Progress, &mut Vec<Remark>),
    ) -> Result<MadeMesh, GearboxError> {
        let (own, meshing): (&GearMesh, &Meshing) = (&self.meshes[mesh], &self.train.meshing()[mesh]);
        // Shared over the mean length of the contact lines.
        let per_length = if cycle.line_length > 0.0 { damping / cycle.line_length } else { 0.0 };
        let alike = || {
            let wrong = [&own.pair.pinion, &own.pair.wheel].iter().any(|g| g.has_own_teeth());
            let what =
                "pitch errors or flanks by tooth: the contact comes back after whole turns, not after a mesh cycle";
            if wrong { Err(GearboxError::Unmapped { what }) } else { Ok(()) }
        };
        Ok(match asked.mesh {
            MeshModel::Exact => {
                let moving = self.reduced[mesh].moving(own, per_length)?;
                let kept = own.discs.map(|disc| self.modes.get(disc).cloned().flatten());
                let moving = match self.vibrating(kept) {
                    Some(modes) => moving.with_modes(modes)?,
                    None => moving,
                };
                (Box::new(moving), None)
            }
            MeshModel::Spring => {
                alike()?;
                (Box::new(spring.mesh(own, meshing)?.with_damping(damping)), None)
            }
            MeshModel::Mapped => {
                let held = |gear: usize| self.file.shafts[self.file.gears[gear].shaft].held;
                let driven = [&own.pair.pinion, &own.pair.wheel][self.reduced[mesh].options.driven()];
                let lever = driven.base_radius().abs() * own.pair.base_helix_angle().cos();
                let request = MapRequest {
                    stands: self.stands(mesh),
                    coast_stands: stands(self.on_coast, mesh),
                    tilts: !self.file.meshes[mesh].gears.into_iter().all(held),
                    mean_force: self.torque(mesh) / lever,
                    overload: asked.map_overload,
                    tolerance: asked.map_tolerance,
                    worst: (WORST * asked.map_tolerance).min(0.5),
                };
                let map = self.reduced[mesh].map(own, &request, (self.cache, progress, remarks))?;
                let error = [map.error(), request.worst];
                (Box::new(map.with_damping(per_length)), Some(error))
            }
        })
    }

    /// Highest mesh frequency, Hz.
    pub fn fastest(&self, speed: f64) -> f64 {
        self.cycles_per_turn().into_iter().map(|cycles| cycles * speed).fold(0.0, f64::max)
    }

    /// Mesh cycles of each mesh per radian of the input.
    pub fn cycles_per_turn(&self) -> Vec<f64> {
        let (a, b) = (self.train.cycles(0.0), self.train.cycles(1.0));
        a.iter().zip(&b).map(|(a, b)| (b - a).abs()).collect()
    }
}

/// Displacements of a mesh at positions.
fn stands(positions: &[GearboxPosition], mesh: usize) -> Vec<Vector12> {
    positions.iter().map(|p| Vector12::from(p.meshes[mesh].displacements)).collect()
}
