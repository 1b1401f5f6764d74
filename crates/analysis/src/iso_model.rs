//! The model `iso`: ISO 6336-1 stiffness, load distributed evenly over the analytic contact lines. No mesh. Theory
//! (24).

use crate::remark;
use std::f64::consts::PI;

use answer::keyed;
use contact::Wrench;
use geometry::{ContactLine, GearPair, Vec3};
use ltca::{Certificate, PairResult, StaticHistory, StaticPosition};
use lumped::{
    LumpedError,
    iso::{body_compliance, mean_transmission_error_um},
};

use scene::Scene;
use serde::Serialize;

use crate::{AnalysisError, facts::RunInfo, iso_root, loaded_pair::LoadedPair};

described::described! {
    /// Facts that only the model `iso` has, after ISO 6336-1.
    #[derive(Debug, Serialize)]
    pub(crate) struct IsoFacts {
        /// c'_th, theoretical single stiffness
        iso_c_th_n_per_mm_um: f64,
        /// c', single stiffness
        iso_c_single_n_per_mm_um: f64,
        /// c_gamma_alpha, mean mesh stiffness for the transmission error
        iso_c_gamma_alpha_n_per_mm_um: f64,
        /// c_gamma_beta, mean mesh stiffness for the face load
        iso_c_gamma_beta_n_per_mm_um: f64,
        /// mean transmission error of the standard: the load over c_gamma_alpha, without a mesh cycle
        iso_mean_ste_closed_form_um: f64,
        /// transmission error by which the axial force bends the bodies of pinion and wheel ([theory](theory.md), equation 24a); no part of the standard, included in `ste_um`
        axial_bending_ste_um: [f64; 2],
    }
}

impl IsoFacts {
    /// The facts that the summary has for any pair.
    pub fn of_run(&self, scene: &Scene, pair: &GearPair) -> RunInfo {
        RunInfo { model: keyed(self), ..RunInfo::of_pair(scene, pair) }
    }
}

/// Solves the scene in closed form.
///
/// ```text
/// F_bt = T / r_b (driven gear),  te(s) = F_bt [L_mean / (b c_gamma_alpha L(s)) + c_1 + c_2],  F_k = F_bn L_k / L
/// ```
/// c_1 and c_2, by which the axial force bends the bodies, are no part of ISO 6336-1 and stand beside its values.
///
/// # Errors
/// [`AnalysisError::Lumped`] where ISO 6336-1 does not hold.
pub(crate) fn solve(scene: &Scene, pair: &GearPair) -> Result<(StaticHistory, IsoFacts), AnalysisError> {
    let loaded = LoadedPair::of(scene, pair);
    let base_force = loaded.base_force();
    let fail = |source: LumpedError| AnalysisError::from(source).of_part("model \"iso\"").in_file(&scene.file);
    let iso = loaded.iso_stiffness().map_err(fail)?;
    let bodies = bodies(&loaded);
    let mesh = Mesh::new(&loaded, iso.c_mesh, bodies.iter().sum());
    let per_cycle = scene.analysis.positions_per_cycle;
    let positions = (0..u64::from(per_cycle) * u64::from(scene.analysis.cycles))
        .map(|index| {
            let phase = (index % u64::from(per_cycle)) as f64 / f64::from(per_cycle);
            let cycle = index / u64::from(per_cycle);
            position(&loaded, mesh, cycle, phase)
        })
        .collect();

    let mean_te = mean_transmission_error_um(&iso, base_force, pair.face_width());
    let facts = IsoFacts {
        iso_c_th_n_per_mm_um: iso.c_theoretical,
        iso_c_single_n_per_mm_um: iso.c_single,
        iso_c_gamma_alpha_n_per_mm_um: iso.c_mesh,
        iso_c_gamma_beta_n_per_mm_um: iso.c_mesh_beta,
        iso_mean_ste_closed_form_um: mean_te,
        axial_bending_ste_um: bodies.map(|c| 1e3 * base_force * c),
    };
    let bending = 1e3 * base_force * mesh.bodies;
    let mut remarks = vec![remark::iso_model(bending)];
    remarks.extend(doubts(pair, bending / mean_te));
    remarks.extend(iso_root::remark(&loaded));
    Ok((StaticHistory { positions, remarks, ..StaticHistory::default() }, facts))
}

/// Transverse contact ratio below which ISO 6336-1 wants less stiffness than its formula and gives no figure.
const LEAST_CONTACT_RATIO: f64 = 1.2;
/// Bending of the bodies over ISO's transmission error from which on the bodies are what counts. Up to 0.8 was held
/// against finite elements of solid discs.
const MUCH_BENDING: f64 = 0.5;

/// Where the formulas are used outside of what they were held against.
fn doubts(pair: &GearPair, bending: f64) -> Vec<answer::Remark> {
    let ratio = pair.transverse_contact_ratio();
    let low = (ratio < LEAST_CONTACT_RATIO).then(|| remark::iso_low_contact_ratio(ratio, LEAST_CONTACT_RATIO));
    let soft = (bending > MUCH_BENDING).then(|| remark::iso_soft_bodies(100.0 * bending));
    low.into_iter().chain(soft).collect()
}

/// What the axial force adds on the line of action by bending the bodies of pinion and wheel, mm/N.
pub(crate) fn bodies(loaded: &LoadedPair<'_>) -> [f64; 2] {
    body_compliance(loaded.pair, loaded.young(), loaded.poisson())
}

/// What deflects under the load, and what all positions have in common.
#[derive(Debug, Clone, Copy)]
struct Mesh {
    /// F_bt, N.
    base_force: f64,
    /// F_bn, N.
    normal_force: f64,
    /// Stiffness of the teeth along the line of action per length of contact line, N/mm^2.
    teeth_per_length: f64,
    /// Compliance of both bodies along the line of action, mm/N.
    bodies: f64,
    /// Angle of the pinion (rad) with pair 0 in the middle of its path.
    middle_angle: f64,
    /// T, a sin a_wt, mm, and cos b_b.
    tangents: f64,
    cos: f64,
}

impl Mesh {
    /// Mesh of teeth of mean stiffness `c_mesh`, N/(mm um), on bodies.
    fn new(loaded: &LoadedPair<'_>, c_mesh: f64, bodies: f64) -> Self {
        let (pair, base_force) = (loaded.pair, loaded.base_force());
        let cos = pair.base_helix_angle().cos();
        Self {
            base_force,
            normal_force: base_force / cos,
            teeth_per_length: 1e3 * c_mesh * pair.face_width() / pair.mean_contact_line_length(),
            bodies,
            middle_angle: pair.middle_angle(loaded.side()),
            tangents: pair.tangent_length(),
            cos,
        }
    }
}

fn position(loaded: &LoadedPair<'_>, mesh: Mesh, cycle: u64, phase: f64) -> StaticPosition {
    let (pair, side) = (loaded.pair, loaded.side());
    let sense = loaded.sense.sign() as f64;
    let pinion_angle = (cycle as f64 + phase - 0.5) * pair.pinion.pitch_angle();
    let turned = mesh.middle_angle + sense * pinion_angle;
    let along = pair.path_coordinates(side, turned);
    let lines = pair.contact_lines(side, turned);
    let length: f64 = lines.iter().map(|line| line.length).sum();
    let (base_force, normal_force) = (mesh.base_force, mesh.normal_force);
    let stiffness = 1.0 / (1.0 / (mesh.teeth_per_length * length) + mesh.bodies);

    let mut wrench = [Wrench::default(); 2];
    let mut pairs = Vec::with_capacity(lines.len());
    let mut sliding_work = 0.0;
    for line in &lines {
        let force = normal_force * line.length / length;
        push(&mut wrench, loaded, (turned, &along), line, force);
        sliding_work += force * pair.mean_sliding(side, turned, line);
        // Pairs are numbered in the sense of rotation, teeth counter-clockwise.
        let number = line.tooth * sense as i64;
        pairs.push(PairResult {
            pair: number,
            pinion_tooth: wrap(line.tooth, pair.pinion.teeth()),
            wheel_tooth: wrap(-line.tooth, pair.wheel.teeth()),
            normal_force: force,
            max_pressure: pressure(
                mesh,
                loaded.compliance(),
                line.z.map(|z| along(line.tooth, z)),
                normal_force / length,
            ),
            contact_line_length: line.length,
            geometric_line_length: line.length,
            points_in_contact: 1,
            slices: Vec::new(),
            gap_rates: Vec::new(),
        });
    }
    pairs.sort_by_key(|p| p.pair);
    let transmission_error = base_force / stiffness;
    StaticPosition {
        pinion_angle,
        mesh_phase: phase,
        transmission_error,
        kinematic_transmission_error: 0.0, // unmodified flanks
        secant_stiffness: stiffness,
        tangent_stiffness: stiffness,
        contact_line_length: length,
        geometric_line_length: length,
        max_pressure: pairs.iter().map(|p| p.max_pressure).fold(0.0, f64::max),
        pairs,
        wrench,
        root_stress: Default::default(),
        root_fields: Default::default(),
        friction_work: 0.0,
        sliding_work,
        strain_energy: 0.5 * base_force * transmission_error,
        tooth_changes: 0, // there is no window that could slide
        certificate: certificate(loaded, &wrench),
    }
}

/// Adds a line's force, at its middle, to both gears.
fn push(
    wrench: &mut [Wrench; 2],
    loaded: &LoadedPair<'_>,
    (turned, along): (f64, &impl Fn(i64, f64) -> f64),
    line: &ContactLine,
    force: f64,
) {
    let (pair, side) = (loaded.pair, loaded.side());
    let z = 0.5 * (line.z[0] + line.z[1]);
    let roll = along(line.tooth, z) / pair.pinion.base_radius();
    let flank = pair.pinion.flank_of(side, line.tooth);
    let turn = nalgebra::Rotation3::from_axis_angle(&Vec3::z_axis(), turned);
    let point = turn * flank.point(roll, z);
    let on_wheel = force * (turn * flank.normal(roll, z));
    let arms = [point, point - Vec3::new(pair.centre_distance(), 0.0, pair.mid_face_offset())];
    for ((wrench, arm), force) in wrench.iter_mut().zip(arms).zip([-on_wheel, on_wheel]) {
        let moment = arm.cross(&force);
        for k in 0..3 {
            wrench.force[k] += force[k];
            wrench.moment[k] += moment[k];
        }
    }
}

/// Hertz pressure at the end of the line where the flanks are more curved, MPa.
///
/// `p0 = sqrt(F' E* / (pi rho_n))`, `rho_n = xi (T - xi) / (T cos b_b)`, `1/E* = sum (1 - nu^2)/E`.
fn pressure(mesh: Mesh, compliance: f64, ends: [f64; 2], line_load: f64) -> f64 {
    let (total, cos) = (mesh.tangents, mesh.cos);
    let radius = ends.map(|xi| xi * (total - xi) / (total * cos)).into_iter().fold(f64::INFINITY, f64::min);
    (line_load / (PI * compliance * radius)).sqrt()
}

fn certificate(loaded: &LoadedPair<'_>, wrench: &[Wrench; 2]) -> Certificate {
    let (driven, applied) = (loaded.driver.driven(), loaded.torque);
    let largest = wrench[0].force.iter().map(|f| f.abs()).fold(0.0, f64::max);
    let sum = (0..3).map(|k| (wrench[0].force[k] + wrench[1].force[k]).abs()).fold(0.0, f64::max);
    Certificate {
        torque_residual: (wrench[driven].moment[2].abs() - applied).abs() / applied,
        action_reaction_residual: sum / largest,
        ..Certificate::default()
    }
}

fn wrap(tooth: i64, teeth: u32) -> u32 {
    tooth.rem_euclid(i64::from(teeth)) as u32
}
