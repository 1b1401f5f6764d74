//! Starter file of a planetary stage, as written by `ale-gear init` for three numbers of teeth.

use std::{f64::consts::PI, fmt::Write, path::Path};

use geometry::{GearPair, involute};

use super::Gearbox;
use crate::{Scene, SceneError, Starter};

/// What of a stage stands in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StageHeld {
    /// The ring: the sun drives, the carrier takes the load.
    #[default]
    Ring,
    /// The carrier: the sun drives, the ring takes the load.
    Carrier,
}

/// The basic values of a planetary stage; shafts and bearings follow from the size of the gears.
#[derive(Debug, Clone, PartialEq)]
pub struct StageStarter {
    /// Sun and planet: teeth, module, helix angle of the sun, face width, profile shifts, centre distance; the torque is that on
    /// the driven member.
    pub pair: Starter,
    /// Number of teeth of the ring, negative.
    pub ring_teeth: i32,
    /// Number of planets.
    pub planets: usize,
    /// What stands in space.
    pub held: StageHeld,
}

/// Stiffness of bearings of sun, ring and planets per face width, N/mm^2: about twice that of teeth of steel.
const BEARING: f64 = 3e4;
/// The same of a carrier's bearings, and of a pin's seats in its plates.
const CARRIER: f64 = 5e4;
const PLATE: f64 = 1e5;

impl StageStarter {
    /// The gearbox file.
    ///
    /// ```text
    /// cos a_wt = (d_b1 + d_b2)/(2 a),   x_1 + x_2 = (z_1 + z_2) (inv a_wt - inv a_t)/(2 tan a_n)      planet 1, ring 2: z_2, a < 0
    /// ```
    /// Source: ISO 21771, 4.2; the ring's profile shift is the one without backlash at the distance of sun and planet.
    ///
    /// # Errors
    /// [`SceneError`] where gears or planets do not fit each other.
    pub fn text(&self, file: &str) -> Result<String, SceneError> {
        let sun = self.sun_scene();
        let inner = pair_of(&sun)?;
        let distance = inner.centre_distance();
        let (ring, outer) = self.ring_scene(&inner)?;
        let text = self.whole(file, [&sun, &ring], [&inner, &outer], distance);
        Gearbox::parse(&text, Path::new(file))?;
        Ok(text)
    }

    fn sun_scene(&self) -> Starter {
        Starter { name: "sun and planet".into(), torque_nm: self.sun_torque_nm(), ..self.pair.clone() }
    }

    /// Planet and ring beside a pair of sun and planet.
    fn ring_scene(&self, inner: &GearPair) -> Result<(Starter, GearPair), SceneError> {
        let [_, planet] = self.pair.teeth;
        let data = inner.wheel.data();
        let (z, normal) = (f64::from(planet + self.ring_teeth), data.normal_pressure_angle);
        let transverse = inner.wheel.transverse_pressure_angle();
        let module = 2.0 * inner.wheel.reference_radius() / f64::from(planet);
        let working = (0.5 * z * module * transverse.cos() / -inner.centre_distance()).clamp(-1.0, 1.0).acos();
        let sum = z * (involute(working) - involute(transverse)) / (2.0 * normal.tan());
        // Digits of a drawing, not of arithmetic.
        let shift = (1e9 * (sum - self.pair.profile_shift[1])).round() / 1e9;
        let ring = Starter {
            name: "planet and ring".into(),
            teeth: [planet, self.ring_teeth],
            helix_deg: -self.pair.helix_deg,
            profile_shift: [self.pair.profile_shift[1], shift],
            centre_distance_mm: Some(inner.centre_distance()),
            torque_nm: self.sun_torque_nm() * f64::from(-self.ring_teeth) / f64::from(self.pair.teeth[0]),
            ..self.pair.clone()
        };
        let ring = ring.with_tips_that_pass();
        let outer = pair_of(&ring)?;
        Ok((ring, outer))
    }

    /// Torque of the planets of one mesh on the sun, N m.
    fn sun_torque_nm(&self) -> f64 {
        let [sun, ring] = [f64::from(self.pair.teeth[0]), f64::from(-self.ring_teeth)];
        match self.held {
            StageHeld::Ring => self.pair.torque_nm * sun / (sun + ring),
            StageHeld::Carrier => self.pair.torque_nm * sun / ring,
        }
    }

    /// Angles of the planets, degrees: equal, or the nearest at which teeth meet gaps.
    fn angles_deg(&self) -> Vec<f64> {
        let grid = f64::from(self.pair.teeth[0] - self.ring_teeth);
        (0..self.planets).map(|n| 360.0 * (n as f64 * grid / self.planets as f64).round() / grid).collect()
    }

    fn whole(&self, file: &str, scenes: [&Starter; 2], pairs: [&GearPair; 2], distance: f64) -> String {
        let b = self.pair.face_width_mm;
        let [sun, planet] = [&pairs[0].pinion, &pairs[0].wheel].map(|g| 2.0 * g.reference_radius());
        let outside = whole_mm(2.0 * pairs[1].wheel.reference_radius().abs() + 11.0 * self.pair.module_mm);
        let [sun_bore, planet_bore] = [0.5 * sun, 0.5 * planet].map(whole_mm);
        let (pin, hub) = (whole_mm(0.5 * planet_bore), whole_mm(0.65 * planet_bore));
        let (held_ring, title) = match self.held {
            StageHeld::Ring => (true, "ring fixed"),
            StageHeld::Carrier => (false, "carrier fixed"),
        };
        let [zs, zp, zr] = [self.pair.teeth[0], self.pair.teeth[1], self.ring_teeth];
        let name = match self.pair.name.as_str() {
            "" => format!("planetary stage {zs}/{zp}/{zr}, {title}"),
            own => own.to_owned(),
        };
        let mut t = format!(
            "# Written by `ale-gear init`. Run it, then open out/report.html in a browser:\n\
             #   ale-gear run {file} --out out\n\
             # All is seen from the carrier, in whose frame the axes stand still. Gears are as asked for; shafts and the\n\
             # stiffness of bearings follow from their size: put yours in their place. All keys: docs/scene.md.\n\
             name = {}\n",
            toml::Value::String(name)
        );
        let mut shaft = |name: &str, keys: &str, [x, z]: [f64; 2], sections: &[[f64; 3]]| {
            let z = digits(z);
            let _ = write!(t, "\n[[shaft]]\nname = \"{name}\"\n{keys}origin_mm = [{x:?}, 0.0, {z:?}]\n");
            for [length, outer, inner] in sections {
                let length = digits(*length);
                let _ = write!(t, "[[shaft.section]]\nlength_mm = {length:?}\nouter_diameter_mm = {outer:?}\n");
                if *inner > 0.0 {
                    let _ = writeln!(t, "inner_diameter_mm = {inner:?}");
                }
            }
        };
        let stands = "stands = true\n";
        shaft("sun", "", [0.0, -3.5 * b], &[[4.0 * b, sun_bore, 0.0]]);
        shaft("planet", "", [distance, -0.7 * b], &[[1.4 * b, planet_bore, hub]]);
        shaft("pin", stands, [distance, -1.3 * b], &[[2.6 * b, pin, 0.0]]);
        let cage = [0.7, 0.5].map(|times| whole_mm(2.0 * distance + times * planet));
        let neck = [3.0, 1.5].map(|times| whole_mm(times * sun_bore));
        let plates = [[1.8 * b, neck[0], neck[1]], [2.6 * b, cage[0], cage[1]]];
        shaft("carrier", stands, [0.0, -3.1 * b], &plates);
        let fixed = if held_ring { "fixed = true                        # its bearing holds its torque\n" } else { "" };
        let end = [0.3, 0.15].map(|times| whole_mm(times * outside));
        let rim = whole_mm(1.1 * outside);
        let drum = [[2.0 * b, rim, outside], [0.75 * b, rim, end[1]], [3.0 * b, end[0], end[1]]];
        shaft("ring", fixed, [0.0, -0.5 * b], &drum);
        let angles: Vec<String> = self.angles_deg().iter().map(|angle| format!("{angle:?}")).collect();
        let _ = write!(
            t,
            "\n[[planets]]\nshafts = [\"planet\", \"pin\"]\naround = \"carrier\"\ncount = {}\n\
             angles_deg = [{}]    # multiples of 360/({zs} + {}): teeth meet gaps\n\
             # tangential_errors_um = [{}]\n",
            self.planets,
            angles.join(", "),
            -zr,
            (0..self.planets).map(|n| if n == 0 { "10.0" } else { "0.0" }).collect::<Vec<_>>().join(", "),
        );
        let mut bearing = |name: &str, on: &str, at: f64, stiffness: [f64; 2], more: &str| {
            let ([k, axial], at) = (stiffness.map(|k| (k * b).round()), digits(at));
            let _ = write!(
                t,
                "\n[[bearing]]\nname = \"{name}\"\n{on}position_mm = {at:?}\nstiffness_n_per_mm = [{k:?}, {k:?}, {axial:?}]\n{more}"
            );
        };
        let tilt = format!("tilt_stiffness_nm_per_rad = [{0:?}, {0:?}]\n", 12.5 * b.powi(3));
        let turn = |per: f64| format!("turn_stiffness_nm_per_rad = {:?}\n", per * b.powi(3));
        let third = BEARING / 3.0;
        bearing("sun a", "shaft = \"sun\"\n", 0.25 * b, [BEARING, third], "");
        bearing("sun b", "shaft = \"sun\"\n", 2.0 * b, [BEARING, 0.0], "");
        let on_pin = "shaft = \"planet\"\nin_shaft = \"pin\"\n";
        bearing("needles a", on_pin, 0.25 * b, [BEARING, third], "");
        bearing("needles b", on_pin, 1.15 * b, [BEARING, 0.0], "");
        let in_plate = "shaft = \"pin\"\nin_shaft = \"carrier\"\n";
        bearing("plate a", in_plate, 0.2 * b, [PLATE, PLATE], &format!("{tilt}{}", turn(12.5)));
        bearing("plate b", in_plate, 2.4 * b, [PLATE, 0.0], &tilt);
        let of_carrier = if held_ring { String::new() } else { turn(1250.0) };
        bearing("carrier a", "shaft = \"carrier\"\n", 0.3 * b, [CARRIER, CARRIER / 3.0], &of_carrier);
        bearing("carrier b", "shaft = \"carrier\"\n", 1.5 * b, [CARRIER, 0.0], "");
        let of_ring = if held_ring { turn(1250.0) } else { String::new() };
        bearing("ring a", "shaft = \"ring\"\n", 3.25 * b, [CARRIER, CARRIER / 3.0], &of_ring);
        bearing("ring b", "shaft = \"ring\"\n", 5.5 * b, [CARRIER, 0.0], "");
        for (name, at) in [("sun", 3.5 * b), ("planet", 0.7 * b), ("ring", 0.5 * b)] {
            let at = digits(at);
            let _ = write!(t, "\n[[gear]]\nname = \"{name}\"\nshaft = \"{name}\"\nposition_mm = {at:?}\n");
        }
        let bores = [[sun_bore, planet_bore], [planet_bore, outside]];
        let tips = scenes[1].tip_diameter_mm;
        for (i, scene) in scenes.into_iter().enumerate() {
            let [one, two] = [["sun", "planet"], ["planet", "ring"]][i];
            let _ = write!(t, "\n[[mesh]]\nname = \"{one}, {two}\"\npinion = \"{one}\"\nwheel = \"{two}\"\n");
            if i == 1 {
                t.push_str("timing = \"touching\"                 # planets touch as their pins stand\n");
            }
            // The planet is one gear in both meshes.
            let tip = [[None, tips[0]], tips][i];
            mesh_scene(&mut t, scene, bores[i], tip);
        }
        let (loaded, turns) = if held_ring { ("carrier", 0.0) } else { ("ring", digits(5.75 * b)) };
        let _ = write!(
            t,
            "\n[input]\nshaft = \"sun\"\nposition_mm = 0.0\n\n[[torque]]\nshaft = \"{loaded}\"\nposition_mm = {turns:?}\ntorque_nm = {:?}\n\n\
             [analysis]\npositions_per_cycle = 8\n\n\
             # [rating]                      # for meshes with [mesh.scene.rating] and bearings by `designation`\n\
             # speed_rpm = {:?}              # of the sun\n",
            self.pair.torque_nm, self.pair.speed_rpm
        );
        t
    }
}

/// A pair in `[mesh.scene]`.
fn mesh_scene(t: &mut String, scene: &Starter, bores: [f64; 2], tips: [Option<f64>; 2]) {
    let thinning = scene.thinning_mm();
    for (i, gear) in ["pinion", "wheel"].into_iter().enumerate() {
        let _ = write!(t, "[mesh.scene.{gear}]\nteeth = {}\n", scene.teeth[i]);
        if i == 0 {
            let _ = writeln!(t, "helix_angle_deg = {:?}", scene.helix_deg);
        }
        let _ = write!(
            t,
            "profile_shift = {:?}\nbore_diameter_mm = {:?}\nthickness_allowance_mm = {thinning:?}\n",
            scene.profile_shift[i], bores[i]
        );
        if let Some(tip) = tips[i] {
            let _ = writeln!(t, "tip_diameter_mm = {tip:?}      # short enough to pass the mating gear");
        }
    }
    let _ = write!(
        t,
        "[mesh.scene.pair]\nnormal_module_mm = {:?}\nface_width_mm = {:?}\n",
        scene.module_mm, scene.face_width_mm
    );
    if let Some(a) = scene.centre_distance_mm {
        let _ = writeln!(t, "centre_distance_mm = {a:?}");
    }
    let _ = write!(t, "[mesh.scene.operation]\ntorque_nm = {:?}\n", scene.torque_nm);
}

fn pair_of(starter: &Starter) -> Result<GearPair, SceneError> {
    let file = "stage.toml";
    Scene::parse(&starter.text(file), Path::new(file))?.gear_pair()
}

/// A length without what arithmetic leaves behind a nanometre.
fn digits(length: f64) -> f64 {
    (1e6 * length).round() / 1e6
}

/// Whole mm, or three digits of what is small.
fn whole_mm(length: f64) -> f64 {
    if length >= 10.0 { length.round() } else { (1e3 * length).round() / 1e3 }
}

impl StageStarter {
    /// Largest number of planets whose tips stay apart at equal angles.
    ///
    /// ```text
    /// 2 a sin(pi/N) > d_a
    /// ```
    ///
    /// # Errors
    /// [`SceneError`] where sun and planet are no pair.
    pub fn most_planets(&self) -> Result<usize, SceneError> {
        let pair = pair_of(&self.sun_scene())?;
        let share = (pair.wheel.tip_radius() / pair.centre_distance()).min(1.0);
        Ok((PI / share.asin()).floor() as usize)
    }
}
