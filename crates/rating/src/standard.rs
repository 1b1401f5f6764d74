//! The standard's rating of a pair: load factors, pitting, bending. ISO 6336-1, -2, -3.

use std::f64::consts::PI;

use serde::Serialize;

use crate::{
    BendingFactors, Deviations, DynamicFactor, DynamicLoad, Edition, FlankFactors, FlankSurface, Lubricant, Material,
    Outside, PairGeometry, PittingFactors, RatingError, RootFactors, RunningIn, StressLife, TransverseLoad, bending,
    bending_curve, dynamic_factor, error::positive, face_load_factor_bending, mean_stress_factor, pitting_curve,
    pitting_factors, transverse_load_factors,
};

/// Stiffness of the mesh, N/(mm um).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeshStiffness {
    /// c', single stiffness.
    pub single: f64,
    /// c_gamma_alpha, mesh stiffness.
    pub mesh: f64,
}

/// Load factors that are known from elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenFactors {
    /// K_A, application factor.
    pub application: f64,
    /// K_Hbeta, face load factor of the flank.
    pub face_load: f64,
    /// K_V; `None`: method B.
    pub dynamic: Option<f64>,
    /// K_Halpha and K_Falpha; `None`: method B.
    pub transverse: Option<f64>,
}

/// What is rated of one gear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearInput<'a> {
    /// Material of the gear.
    pub material: &'a Material,
    /// Density, kg/m^3.
    pub density: f64,
    /// Root of its teeth.
    pub root: RootFactors,
    /// R_z of the flank, um.
    pub flank_roughness_um: f64,
    /// R_z of the root, um.
    pub root_roughness_um: f64,
    /// Load on the flank that is loaded less over that of the other, 0 to 1.
    pub reversed_load_ratio: f64,
    /// Times that a tooth is loaded in a turn of the gear.
    pub meshes_per_turn: f64,
}

/// What a rating depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RatingInput<'a> {
    /// Edition of the standard.
    pub edition: Edition,
    /// Geometry.
    pub geometry: PairGeometry,
    /// Factors of the nominal contact stress.
    pub flank: FlankFactors,
    /// Stiffness of the mesh.
    pub stiffness: MeshStiffness,
    /// Pinion and wheel.
    pub gears: [GearInput<'a>; 2],
    /// Oil.
    pub lubricant: &'a Lubricant,
    /// Deviations of the teeth.
    pub deviations: Deviations,
    /// Tip relief that counts in K_V, um; `None`: that of running in.
    pub tip_relief_um: Option<f64>,
    /// F_t, nominal tangential force on the reference circle, N.
    pub tangential_force: f64,
    /// Speed of the pinion, 1/min.
    pub pinion_speed_rpm: f64,
    /// Load factors that are known.
    pub factors: GivenFactors,
    /// Required life, h.
    pub life_h: f64,
    /// Whether some pits are allowed.
    pub limited_pitting: bool,
    /// Z_NT and Y_NT at 1e10 cycles.
    pub long_life: f64,
}

impl RatingInput<'_> {
    /// C_a, tip relief that counts, um: the stated one, or what running in leaves, the mean of both gears' C_ay = 1.5 um + (sigma_Hlim/97 - 18.45)^2/18. Source: ISO 6336-1, clause 6.
    pub(crate) fn tip_relief(&self) -> f64 {
        let of = |m: &Material| (m.contact_limit_mpa / 97.0 - 18.45).powi(2) / 18.0 + 1.5;
        self.tip_relief_um.unwrap_or_else(|| 0.5 * self.gears.iter().map(|g| of(g.material)).sum::<f64>())
    }
}

described::described! {
    /// Rating of one gear; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct GearRating {
        /// name of the material
        pub material: String,
        /// N_L over `life_h`
        pub load_cycles: f64,
        /// sigma_H
        pub contact_stress_mpa: f64,
        /// sigma_HG
        pub contact_stress_limit_mpa: f64,
        /// S_H
        pub pitting_safety: f64,
        /// life at which S_H is 1, the line of life drawn on beyond 1e10 cycles; `null` where it has no end (`long_life_factor = 1`)
        pub pitting_life_h: f64,
        /// Z_B or Z_D (2019: f_ZCa is 1)
        pub single_contact_factor: f64,
        /// Z_NT
        pub pitting_life_factor: f64,
        /// factors of the pitting stress limit
        #[serde(flatten)]
        pub pitting: PittingFactors,
        /// sigma_F0
        pub nominal_root_stress_mpa: f64,
        /// sigma_F
        pub root_stress_mpa: f64,
        /// sigma_FG
        pub root_stress_limit_mpa: f64,
        /// S_F
        pub bending_safety: f64,
        /// life at which S_F is 1, the line of life drawn on beyond 1e10 cycles; `null` where it has no end (`long_life_factor = 1`)
        pub bending_life_h: f64,
        /// Y_F
        pub form_factor: f64,
        /// Y_S
        pub stress_correction_factor: f64,
        /// Y_beta
        pub helix_factor: f64,
        /// Y_B
        pub rim_thickness_factor: f64,
        /// Y_DT
        pub deep_tooth_factor: f64,
        /// Y_NT
        pub bending_life_factor: f64,
        /// factors of the bending stress limit
        #[serde(flatten)]
        pub bending: BendingFactors,
        /// Bearable contact stress over load cycles.
        #[serde(skip)]
        pub pitting_curve: StressLife,
        /// Bearable root stress over load cycles.
        #[serde(skip)]
        pub bending_curve: StressLife,
    }
}

described::described! {
    /// The standard's rating of a pair; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct StandardRating {
        /// edition of ISO 6336
        pub edition: Edition,
        /// F_t on the reference circle
        pub tangential_force_n: f64,
        /// v on the reference circle
        pub line_speed_m_per_s: f64,
        /// K_A
        pub application_factor: f64,
        /// K_V
        pub dynamic_factor: f64,
        /// N, speed over the resonance speed
        pub resonance_ratio: f64,
        /// n_E1, resonance speed of the pinion
        pub resonance_speed_rpm: f64,
        /// K_Hbeta
        pub face_load_factor: f64,
        /// K_Fbeta
        pub face_load_factor_bending: f64,
        /// K_Halpha
        pub transverse_load_factor: f64,
        /// K_Falpha
        pub transverse_load_factor_bending: f64,
        /// Z_H
        pub zone_factor: f64,
        /// Z_E
        pub elasticity_factor: f64,
        /// Z_eps
        pub contact_ratio_factor: f64,
        /// Z_beta
        pub helix_angle_factor: f64,
        /// sigma_H0
        pub nominal_contact_stress_mpa: f64,
        /// rating of the pinion
        pub pinion: GearRating,
        /// rating of the wheel
        pub wheel: GearRating,
        /// numbers that the standard does not cover; each is a remark as well
        pub outside: Vec<Outside>,
    }
}

impl StandardRating {
    /// Pinion and wheel.
    pub fn gears(&self) -> [&GearRating; 2] {
        [&self.pinion, &self.wheel]
    }
}

/// Rates a pair for pitting and tooth root bending.
///
/// ```text
/// sigma_H0 = Z_H Z_E Z_eps Z_beta sqrt[F_t/(d_1 b) (u + 1)/u],   sigma_H = Z_B,D sigma_H0 sqrt(K_A K_V K_Hbeta K_Halpha),   S_H = sigma_HG/sigma_H
/// sigma_F0 = F_t/(b m_n) Y_F Y_S Y_beta Y_B Y_DT,               sigma_F = sigma_F0 K_A K_V K_Fbeta K_Falpha,              S_F = sigma_FG/sigma_F
/// ```
/// u is negative of an internal pair. Source: ISO 6336-2, clause 5; ISO 6336-3, clause 5.
///
/// # Errors
/// [`RatingError`] where a number has no meaning for a formula.
pub fn standard_rating(input: &RatingInput<'_>) -> Result<StandardRating, RatingError> {
    const LOAD: &str = "ISO 6336-1";
    let geometry = input.geometry.checked()?;
    let force = positive("the tangential force in N", input.tangential_force, LOAD)?;
    let speed_rpm = positive("the speed of the pinion in 1/min", input.pinion_speed_rpm, LOAD)?;
    positive("the required life in h", input.life_h, LOAD)?;
    let (b, d) = (geometry.face_width, geometry.reference_diameter);
    let speed = PI / 60_000.0 * d[0] * speed_rpm;
    let materials = input.gears.map(|g| g.material);
    let run_in = RunningIn::new(input.deviations, materials, speed);
    let k_a = input.factors.application;
    let vibration = vibration(input, run_in, force, speed_rpm);
    let k_v = input.factors.dynamic.unwrap_or(vibration.dynamic_factor);
    let k_hb = input.factors.face_load;
    let k_fb = face_load_factor_bending(k_hb, b, [0, 1].map(|i| geometry.tooth_height(i)));
    let transverse = TransverseLoad {
        eps_alpha: geometry.eps_alpha,
        eps_gamma: geometry.eps_gamma(),
        mesh_stiffness: input.stiffness.mesh,
        deviation_um: input.deviations.base_pitch_um.max(input.deviations.profile_form_um) - run_in.base_pitch_um,
        line_load: force * k_a * k_v * k_hb / b,
        contact_ratio_factor: input.flank.contact_ratio,
    };
    let [k_ha, k_fa] = input.factors.transverse.map_or_else(|| transverse_load_factors(&transverse), |k| [k; 2]);
    let u = geometry.ratio();
    let flank = &input.flank;
    let nominal_contact =
        flank.zone * flank.elasticity * flank.contact_ratio * flank.helix * (force / (d[0] * b) * (u + 1.0) / u).sqrt();
    let load = LoadFactors { flank: k_a * k_v * k_hb * k_ha, root: k_a * k_v * k_fb * k_fa };
    let surface = FlankSurface {
        viscosity_40c: input.lubricant.viscosity_40c_mm2_per_s,
        speed,
        roughness_um: input.gears.map(|g| g.flank_roughness_um),
        relative_radius: geometry.pitch_relative_radius(),
        ratio: u.abs().max(1.0 / u.abs()),
    };
    let rated = |gear: usize| gear_rating(input, gear, nominal_contact, load, &surface);
    Ok(StandardRating {
        edition: input.edition,
        tangential_force_n: force,
        line_speed_m_per_s: speed,
        application_factor: k_a,
        dynamic_factor: k_v,
        resonance_ratio: vibration.resonance_ratio,
        resonance_speed_rpm: vibration.resonance_speed_rpm,
        face_load_factor: k_hb,
        face_load_factor_bending: k_fb,
        transverse_load_factor: k_ha,
        transverse_load_factor_bending: k_fa,
        zone_factor: flank.zone,
        elasticity_factor: flank.elasticity,
        contact_ratio_factor: flank.contact_ratio,
        helix_angle_factor: flank.helix,
        nominal_contact_stress_mpa: nominal_contact,
        pinion: rated(0)?,
        wheel: rated(1)?,
        outside: outside(input, speed),
    })
}

/// Products of the load factors.
#[derive(Debug, Clone, Copy)]
struct LoadFactors {
    /// K_A K_V K_Hbeta K_Halpha.
    flank: f64,
    /// K_A K_V K_Fbeta K_Falpha.
    root: f64,
}

fn vibration(input: &RatingInput<'_>, run_in: RunningIn, force: f64, speed_rpm: f64) -> DynamicFactor {
    let geometry = &input.geometry;
    let mass = [0, 1].map(|i| geometry.relative_mass(i, input.gears[i].density));
    dynamic_factor(&DynamicLoad {
        teeth: geometry.teeth[0],
        speed_rpm,
        line_load: force * input.factors.application / geometry.face_width,
        eps_gamma: geometry.eps_gamma(),
        single_stiffness: input.stiffness.single,
        mesh_stiffness: input.stiffness.mesh,
        reduced_mass: mass[0] * mass[1] / (mass[0] + mass[1]),
        base_pitch_um: input.deviations.base_pitch_um - run_in.base_pitch_um,
        profile_form_um: input.deviations.profile_form_um - run_in.profile_form_um,
        tip_relief_um: input.deviations.is_fine.then(|| input.tip_relief()),
    })
}

fn gear_rating(
    input: &RatingInput<'_>,
    gear: usize,
    nominal_contact: f64,
    load: LoadFactors,
    surface: &FlankSurface,
) -> Result<GearRating, RatingError> {
    let (geometry, own) = (&input.geometry, &input.gears[gear]);
    let turns = [1.0, 1.0 / geometry.ratio().abs()][gear] * input.pinion_speed_rpm * own.meshes_per_turn;
    let cycles = 60.0 * turns * input.life_h;
    let hours = |curve: &StressLife, stress: f64| curve.cycles_at(stress) / (60.0 * turns);

    let pitting = pitting_factors(surface, input.gears.map(|g| g.material), gear);
    let curve = pitting_curve(own.material, &pitting, input.limited_pitting, input.long_life).ok_or_else(|| {
        let quantity = "the bearable contact stress in MPa";
        let value = own.material.contact_limit_mpa * pitting.product();
        RatingError::OutOfRange { quantity, value, clause: "ISO 6336-2", allowed: "a positive number" }
    })?;
    let single_contact = input.flank.single_contact[gear];
    let contact = single_contact * nominal_contact * load.flank.sqrt();
    let contact_limit = curve.stress_at(cycles);

    let root = &own.root;
    let mean_stress = mean_stress_factor(own.material, root.stress_correction, own.reversed_load_ratio);
    let module = geometry.normal_module;
    let factors = BendingFactors::new(own.material, root.notch, own.root_roughness_um, module, mean_stress)?;
    let root_curve = bending_curve(own.material, &factors, input.long_life)?;
    let helix = bending::helix_factor(input.edition, geometry.helix_angle, geometry.eps_beta);
    let form = root.form_factor(input.edition);
    let shape = form * root.stress_correction * helix * root.rim * root.deep_tooth;
    let nominal_root = input.tangential_force / (geometry.face_width * module) * shape;
    let root_stress = nominal_root * load.root;
    let root_limit = root_curve.stress_at(cycles);
    let reference = own.material.contact_limit_mpa * pitting.product();
    let root_reference = 2.0 * own.material.root_limit_mpa * factors.product();
    Ok(GearRating {
        material: own.material.name.clone(),
        load_cycles: cycles,
        contact_stress_mpa: contact,
        contact_stress_limit_mpa: contact_limit,
        pitting_safety: contact_limit / contact,
        pitting_life_h: hours(&curve, contact),
        single_contact_factor: single_contact,
        pitting_life_factor: contact_limit / reference,
        pitting,
        nominal_root_stress_mpa: nominal_root,
        root_stress_mpa: root_stress,
        root_stress_limit_mpa: root_limit,
        bending_safety: root_limit / root_stress,
        bending_life_h: hours(&root_curve, root_stress),
        form_factor: form,
        stress_correction_factor: root.stress_correction,
        helix_factor: helix,
        rim_thickness_factor: root.rim,
        deep_tooth_factor: root.deep_tooth,
        bending_life_factor: root_limit / root_reference,
        bending: factors,
        pitting_curve: curve,
        bending_curve: root_curve,
    })
}

/// What the standard does not cover.
fn outside(input: &RatingInput<'_>, speed: f64) -> Vec<Outside> {
    let geometry = &input.geometry;
    let degrees = geometry.helix_angle.to_degrees();
    let alpha = geometry.normal_pressure_angle.to_degrees();
    let oil = input.lubricant.viscosity_40c_mm2_per_s;
    let [one, two] = input.gears.map(|g| g.flank_roughness_um);
    let rough = 0.5 * (one + two) * (10.0 / geometry.pitch_relative_radius()).cbrt();
    let inf = f64::INFINITY;
    // Without the overlap of a helix Z_B is known for one or two pairs in mesh alone.
    let most = if geometry.eps_beta < 1.0 { 2.0 } else { inf };
    [
        Outside::unless("the helix angle in degrees", degrees, [0.0, 30.0], "0 .. 30", "ISO 6336-1, clause 4"),
        Outside::unless("the pressure angle in degrees", alpha, [15.0, 25.0], "15 .. 25", "ISO 6336-1, clause 4"),
        Outside::unless(
            "the transverse contact ratio",
            geometry.eps_alpha,
            [1.0, 2.5],
            "1 .. 2.5",
            "ISO 6336-1, clause 4",
        ),
        Outside::unless("the viscosity at 40 C in mm^2/s", oil, [50.0, 500.0], "50 .. 500", "ISO 6336-2, Z_L"),
        Outside::unless("R_z10 of the flanks in um", rough, [1.0, 16.0], "1 .. 16", "ISO 6336-2, Z_R"),
        Outside::unless("the line speed in m/s", speed, [0.0, 50.0], "up to 50", "ISO 6336-2, Z_V"),
        Outside::unless("the transverse contact ratio", geometry.eps_alpha, [1.0, most], "1 .. 2", "ISO 6336-2, Z_B"),
    ]
    .into_iter()
    .flatten()
    .collect()
}
