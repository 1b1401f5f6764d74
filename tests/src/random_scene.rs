//! Scenes of random pairs over the documented ranges, the same in every run.

use std::f64::consts::PI;

use geometry::GearPair;
use scene::{Scene, SceneBuilder, SceneError};
use testing::Random;

/// Draws that are tried for one scene: some have pointed teeth, undercut roots or too short a path of contact.
const DRAWS: usize = 1000;
/// Contact ratio below which teeth do not hand over.
const LEAST_CONTACT_RATIO: f64 = 1.05;

/// Seed from which on loads are light as well, and flanks as they are ground.
pub const AS_GROUND: u64 = 100;
/// Seed from which on a pinion turns in a ring.
pub const RINGS: u64 = 1000;
/// Hertz pressures from there on, MPa.
const GROUND_PRESSURES: [f64; 2] = [200.0, 1800.0];
/// Amounts of what is ground off a flank beside tip relief: name, um, and whether it has a sign.
const GROUND: [(&str, [f64; 2], bool); 4] = [
    ("profile_crowning_um", [1.0, 8.0], false),
    ("lead_crowning_um", [1.0, 20.0], false),
    ("lead_slope_um", [1.0, 10.0], true),
    ("profile_slope_um", [1.0, 6.0], true),
];
/// End reliefs: um, and share of the face width.
const END_RELIEF: [[f64; 2]; 2] = [[3.0, 20.0], [0.05, 0.25]];

/// Scene number `index` of a seed: z 12..120, beta 0..40 deg, b/m_n 3..25, x -0.4..0.8, alpha_n 15..28 deg, m_n 1..8 mm,
/// rims of 0.8 modules to solid bodies, half of the pairs with tip relief, crowning or misalignment, Hertz pressure at
/// the pitch point 500..1800 MPa. From [`AS_GROUND`] on pressures begin at 200 MPa, and flanks are as they are ground: either
/// gear with its own tip relief, crownings, slopes and end reliefs. From [`RINGS`] on pairs are internal, with flanks as those of
/// the first seeds: pinions of 12..60 teeth in rings of 12..100 teeth more, beta 0..30 deg, b/m_n 3..10, addenda of 0.75..1 modules, rims of
/// the ring of 1.2..10 modules.
///
/// # Panics
/// When a thousand draws make no pair, which no seed does.
pub fn random_scene(seed: u64, index: u64) -> Scene {
    // Far apart: sequences of neighbouring seeds are the same but for one step.
    let mut random = Random::new(seed.wrapping_mul(0x5851_f42d_4c95_7f2d) ^ index.wrapping_mul(0xd134_2543_de82_ef95));
    let drawn = (0..DRAWS).find_map(|_| {
        let draw = Draw::new(&mut random);
        match seed {
            0..AS_GROUND => draw.scene(index),
            AS_GROUND..RINGS => draw.with_ground_flanks(&mut random).scene(index),
            _ => draw.in_a_ring(&mut random).scene(index),
        }
    });
    drawn.unwrap_or_else(|| panic!("seed {seed}, index {index}: no pair in {DRAWS} draws"))
}

/// Numbers of a pair that may not exist.
#[derive(Debug)]
struct Draw {
    teeth: [u32; 2],
    helix_angle_deg: f64,
    module: f64,
    width: f64,
    shift: [f64; 2],
    pressure_angle_deg: f64,
    /// Radial thickness of the body below the root, modules.
    rim: [f64; 2],
    /// Tip relief (um a mm of module) and where on the path from form to tip circle it begins.
    relief: Option<[f64; 2]>,
    /// um.
    crowning: Option<f64>,
    /// um over the face width.
    misalignment: Option<f64>,
    pressure_mpa: f64,
    /// Addendum of an internal pair, modules.
    ring_addendum: Option<f64>,
    /// What is ground off the flanks of pinion and wheel beside the others.
    ground: Vec<(String, f64)>,
}

impl Draw {
    fn new(random: &mut Random) -> Self {
        let log = |r: &mut Random, low: f64, high: f64| r.between(low.ln(), high.ln()).exp();
        let some = |r: &mut Random, share: f64| r.between(0.0, 1.0) < share;
        let teeth = [(); 2].map(|()| log(random, 12.0, 121.0) as u32);
        let helix_angle_deg = if some(random, 0.2) { 0.0 } else { random.between(0.0, 40.0) };
        let module = log(random, 1.0, 8.0);
        let width = module * log(random, 3.0, 25.0);
        let shift = [(); 2].map(|()| random.between(-0.4, 0.8));
        let pressure_angle_deg = random.between(15.0, 28.0);
        let rim = [(); 2].map(|()| log(random, 0.8, 20.0));
        let relief = some(random, 0.5).then(|| [random.between(1.0, 10.0), random.between(0.4, 0.85)]);
        let crowning = some(random, 0.5).then(|| random.between(1.0, 20.0));
        let misalignment = some(random, 0.5).then(|| random.between(-20.0, 20.0));
        let pressure_mpa = random.between(500.0, 1800.0);
        Self {
            teeth,
            helix_angle_deg,
            module,
            width,
            shift,
            pressure_angle_deg,
            rim,
            relief,
            crowning,
            misalignment,
            pressure_mpa,
            ring_addendum: None,
            ground: Vec::new(),
        }
    }

    /// A pinion in a ring, with the flanks and the load of these gears.
    fn in_a_ring(self, random: &mut Random) -> Self {
        let log = |r: &mut Random, low: f64, high: f64| r.between(low.ln(), high.ln()).exp();
        let pinion = log(random, 12.0, 61.0) as u32;
        Self {
            teeth: [pinion, pinion + log(random, 12.0, 101.0) as u32],
            helix_angle_deg: 0.75 * self.helix_angle_deg,
            width: self.module * log(random, 3.0, 10.0),
            shift: [random.between(-0.2, 0.6), random.between(-0.3, 0.4)],
            rim: [self.rim[0], log(random, 1.2, 10.0)],
            ring_addendum: Some(random.between(0.75, 1.0)),
            ..self
        }
    }

    /// The same gears under any load, with flanks as they are ground.
    fn with_ground_flanks(mut self, random: &mut Random) -> Self {
        let some = |r: &mut Random, share: f64| r.between(0.0, 1.0) < share;
        let [low, high] = GROUND_PRESSURES;
        self.pressure_mpa = random.between(low.ln(), high.ln()).exp();
        self.crowning = None;
        for gear in ["pinion", "wheel"] {
            for (name, [low, high], signed) in GROUND {
                let (taken, amount) = (some(random, 0.25), random.between(low, high));
                let sign = if signed && some(random, 0.5) { -1.0 } else { 1.0 };
                if taken {
                    self.ground.push((format!("{gear}.modification.{name}"), sign * amount));
                }
            }
            let [amount, share] = END_RELIEF.map(|[low, high]| random.between(low, high));
            if some(random, 0.25) {
                for end in ["lower", "upper"] {
                    let key = format!("{gear}.modification.end_relief_{end}");
                    self.ground.push((format!("{key}_um"), amount));
                    self.ground.push((format!("{key}_length_mm"), share * self.width));
                }
            }
        }
        self
    }

    /// The scene; `None` where there is no such pair.
    fn scene(&self, index: u64) -> Option<Scene> {
        let plain = self.builder(1.0).build().ok()?;
        let pair = plain.gear_pair().ok()?;
        if pair.transverse_contact_ratio() < LEAST_CONTACT_RATIO || pair.pinion.profile().is_undercut() {
            return None;
        }
        self.loaded(&pair, index).ok()
    }

    fn builder(&self, torque_nm: f64) -> SceneBuilder {
        let cos = self.helix_angle_deg.to_radians().cos();
        let bore = |i: usize| {
            let root = self.module * (0.5 * f64::from(self.teeth[i]) / cos + self.shift[i] - 1.25);
            2.0 * (root - self.rim[i] * self.module).max(0.25 * root)
        };
        let scene = Scene::builder()
            .pinion(self.teeth[0], self.helix_angle_deg)
            .wheel(self.teeth[1])
            .normal_module_mm(self.module)
            .face_width_mm(self.width)
            .torque_nm(torque_nm)
            .set("pair.normal_pressure_angle_deg", self.pressure_angle_deg)
            .set("pinion.profile_shift", self.shift[0])
            .set("wheel.profile_shift", self.shift[1])
            .set("pinion.bore_diameter_mm", bore(0))
            .set("wheel.bore_diameter_mm", bore(1));
        let Some(addendum) = self.ring_addendum else { return scene };
        let root = self.module * (0.5 * f64::from(self.teeth[1]) / cos - self.shift[1] + 1.25);
        scene
            .set("wheel.teeth", -i64::from(self.teeth[1]))
            .set("wheel.bore_diameter_mm", 2.0 * (root + self.rim[1] * self.module))
            .set("pair.addendum_coefficient", addendum)
    }

    fn loaded(&self, pair: &GearPair, index: u64) -> Result<Scene, SceneError> {
        let mut scene =
            self.builder(1e-3 * torque_of_pressure(pair, self.pressure_mpa)).set("name", format!("pair {index}"));
        if let Some([amount, start]) = self.relief {
            for (gear, whose) in [(&pair.pinion, "pinion"), (&pair.wheel, "wheel")] {
                let flank = gear.flank(geometry::Side::Left);
                let roll = flank.roll_form + start * (flank.roll_tip - flank.roll_form);
                scene = scene
                    .set(&format!("{whose}.modification.tip_relief_um"), amount * self.module)
                    .set(&format!("{whose}.modification.tip_relief_start_roll_deg"), roll.to_degrees());
            }
        }
        if let Some(crowning) = self.crowning {
            scene = scene.set("pinion.modification.lead_crowning_um", crowning);
        }
        if let Some(misalignment) = self.misalignment {
            scene = scene.set("pair.misalignment.in_plane_of_action_um", misalignment);
        }
        for (key, amount) in &self.ground {
            scene = scene.set(key, *amount);
        }
        scene.build()
    }
}

/// Torque on the wheel (N mm) at which Hertz gives the pressure on lines of mean length, curved as at the pitch point,
/// of gears of steel.
pub fn torque_of_pressure(pair: &GearPair, pressure_mpa: f64) -> f64 {
    let (young, poisson) = (2.06e5, 0.3f64);
    let contact_modulus = young / (2.0 * (1.0 - poisson.powi(2)));
    let [r1, r2] = pair.working_radii().map(|r| r * pair.working_pressure_angle().sin());
    let radius = r1 * r2 / ((r1 + r2) * pair.base_helix_angle().cos());
    let line_load = pressure_mpa.powi(2) * PI * radius / contact_modulus;
    line_load * pair.mean_contact_line_length() * pair.base_helix_angle().cos() * pair.wheel.base_radius().abs()
}
