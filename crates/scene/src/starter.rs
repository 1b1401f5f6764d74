//! Starter scene, as written by `ale-gear init`.

use std::fmt::Write;

use geometry::GeometryError;

use crate::{Driver, Kind, Scene, SceneError, Sense};

/// Material of a gear, if given.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Steel {
    /// Young's modulus, MPa.
    pub young_mpa: Option<f64>,
    /// Poisson's ratio.
    pub poisson: Option<f64>,
    /// Density, kg/m^3.
    pub density_kg_m3: Option<f64>,
}

/// The basic values of a pair; the rest of the scene has defaults.
#[derive(Debug, Clone, PartialEq)]
pub struct Starter {
    /// Title of the case.
    pub name: String,
    /// Numbers of teeth of pinion and wheel, negative for a ring.
    pub teeth: [i32; 2],
    /// Normal module, mm.
    pub module_mm: f64,
    /// The pinion's helix angle, degrees, right hand positive.
    pub helix_deg: f64,
    /// Face width of gears without a width of their own, mm.
    pub face_width_mm: f64,
    /// Own face widths of pinion and wheel, mm.
    pub own_face_width_mm: [Option<f64>; 2],
    /// Height of the wheel's mid-face above the pinion's, mm; `None`: 0.
    pub mid_face_offset_mm: Option<f64>,
    /// Torque on the driven gear, N m.
    pub torque_nm: f64,
    /// Speed of the driver, 1/min.
    pub speed_rpm: f64,
    /// Profile shift coefficients of pinion and wheel.
    pub profile_shift: [f64; 2],
    /// Working centre distance, mm; `None`: the distance without backlash that follows from the profile shifts.
    pub centre_distance_mm: Option<f64>,
    /// Normal pressure angle, degrees; `None`: 20.
    pub pressure_angle_deg: Option<f64>,
    /// Tip diameters of pinion and wheel, mm; `None`: from addendum and profile shift.
    pub tip_diameter_mm: [Option<f64>; 2],
    /// Bores of pinion and wheel, mm; `None`: 55 % of the reference diameters.
    pub bore_diameter_mm: [Option<f64>; 2],
    /// Thinning of each tooth of pinion and wheel, mm; `None`: 1.5 % of the module.
    pub thickness_allowance_mm: [Option<f64>; 2],
    /// Materials of pinion and wheel.
    pub steel: [Steel; 2],
    /// Dedendum of the basic rack divided by the module; `None`: 1.25.
    pub dedendum_coefficient: Option<f64>,
    /// Tip radius of the basic rack divided by the module; `None`: 0.38.
    pub root_radius_coefficient: Option<f64>,
    /// Driving gear.
    pub driver: Driver,
    /// Sense of rotation of the pinion, seen from +z.
    pub rotation: Sense,
    /// Kind of analysis: equilibrium at every position, or motion in time.
    pub kind: Kind,
}

/// The default pair of this repository, whatever its torque.
impl Default for Starter {
    fn default() -> Self {
        Self {
            name: String::new(),
            teeth: [30, 30],
            module_mm: 3.0,
            helix_deg: 20.0,
            face_width_mm: 20.0,
            own_face_width_mm: [None, None],
            mid_face_offset_mm: None,
            torque_nm: 150.0,
            speed_rpm: 1000.0,
            profile_shift: [0.0, 0.0],
            centre_distance_mm: None,
            pressure_angle_deg: None,
            tip_diameter_mm: [None, None],
            bore_diameter_mm: [None, None],
            thickness_allowance_mm: [None, None],
            steel: [Steel::default(); 2],
            dedendum_coefficient: None,
            root_radius_coefficient: None,
            driver: Driver::Pinion,
            rotation: Sense::Ccw,
            kind: Kind::Static,
        }
    }
}

/// Thinning of each tooth over the module: a little backlash, as real gears have.
const THINNING: f64 = 0.015;

impl Starter {
    /// The pair with tips as short as a ring and its pinion need to clear each other, if no tip diameters are given.
    #[must_use]
    pub fn with_tips_that_pass(&self) -> Self {
        let mut own = self.clone();
        while own.teeth[1] < 0 {
            let file = "pair.toml";
            let found = Scene::parse(&own.text(file), file.as_ref()).and_then(|scene| scene.gear_pair());
            let Err(SceneError::Geometry { source, .. }) = found else { break };
            let shorter = match *source {
                GeometryError::Trochoid { pinion_tip_mm, .. } => pinion_tip_mm.map(|tip| (0, tip)),
                GeometryError::Involute { ring_tip_mm, .. } => ring_tip_mm.map(|tip| (1, tip)),
                _ => None,
            };
            match shorter {
                Some((gear, tip)) if own.tip_diameter_mm[gear].is_none() => {
                    own.tip_diameter_mm[gear] = Some(tip.abs());
                }
                _ => break,
            }
        }
        own
    }

    /// The scene with a comment on every line. A line that begins with `# ` and contains `key = value` can be activated
    /// by removing the `# `; of two such keys that exclude each other, only one.
    pub fn text(&self, file: &str) -> String {
        let name = if self.name.is_empty() {
            let kind = if self.helix_deg == 0.0 { "spur" } else { "helical" };
            let [pinion, wheel] = self.teeth;
            if wheel < 0 { format!("{kind}-{pinion}-in-{}", -wheel) } else { format!("{kind}-{pinion}x{wheel}") }
        } else {
            self.name.clone()
        };
        let mut t = String::new();
        // Writing to a String cannot fail.
        let _ = write!(
            t,
            "# Written by `ale-gear init`. Run it, then open out/report.html in a browser:\n\
             #   ale-gear run {file} --out out\n\
             # Every key has its unit in its name. All keys, ranges and defaults: docs/scene.md or `ale-gear print schema`.\n\
             # What is commented out stands at its default, or is an example.\n\
             name = {}\n\n",
            toml::Value::String(name)
        );
        self.gears(&mut t);
        self.pair_and_load(&mut t);
        t.push_str(match self.kind {
            Kind::Static => STATIC,
            Kind::Dynamic => DYNAMIC,
        });
        t
    }

    /// Thinning of each tooth of a gear that states none, mm.
    pub(crate) fn thinning_mm(&self) -> f64 {
        (1e3 * THINNING * self.module_mm).round().max(1.0) / 1e3
    }

    fn gears(&self, t: &mut String) {
        let thinning = self.thinning_mm();
        for (i, table) in ["pinion", "wheel"].into_iter().enumerate() {
            let _ = write!(t, "[{table}]\nteeth = {}\n", self.teeth[i]);
            if i == 0 {
                let _ = writeln!(
                    t,
                    "helix_angle_deg = {:?}           # right hand positive; the wheel's follows",
                    self.helix_deg
                );
            }
            let _ = write!(
                t,
                "profile_shift = {:?}\n\
                 thickness_allowance_mm = {:?}   # thinning of each tooth, which makes the backlash\n",
                self.profile_shift[i],
                self.thickness_allowance_mm[i].unwrap_or(thinning)
            );
            let _ = match self.bore_diameter_mm[i] {
                Some(bore) => writeln!(t, "bore_diameter_mm = {bore:?}"),
                None if self.teeth[i] < 0 => {
                    writeln!(t, "# bore_diameter_mm = {:?}         # its outside, which holds it", self.outside(i))
                }
                None => writeln!(
                    t,
                    "# bore_diameter_mm = {:?}         # default: 55 % of the reference diameter",
                    self.bore(i)
                ),
            };
            if let Some(width) = self.own_face_width_mm[i] {
                let _ = writeln!(t, "face_width_mm = {width:?}");
            }
            if let Some(tip) = self.tip_diameter_mm[i] {
                let why = if self.teeth[1] < 0 { "      # short enough to pass the mating gear" } else { "" };
                let _ = writeln!(t, "tip_diameter_mm = {tip:?}{why}");
            }
            if i == 0 {
                t.push_str("# mesh = \"pinion.msh\"             # a Gmsh mesh instead of the built-in mesher\n");
                t.push_str(MODIFICATION);
            }
            self.material(t, table, i);
            t.push('\n');
        }
    }

    fn material(&self, t: &mut String, table: &str, i: usize) {
        let Steel { young_mpa, poisson, density_kg_m3 } = self.steel[i];
        let stated = [("young_mpa", young_mpa), ("poisson", poisson), ("density_kg_m3", density_kg_m3)];
        if stated.iter().any(|(_, value)| value.is_some()) {
            let _ = writeln!(t, "[{table}.material]");
        }
        for (key, value) in stated.into_iter().filter_map(|(key, value)| Some((key, value?))) {
            let _ = writeln!(t, "{key} = {value:?}");
        }
    }

    /// Outside of a ring with a rim of four modules, in whole mm.
    fn outside(&self, i: usize) -> f64 {
        let reference = f64::from(self.teeth[i].abs()) * self.module_mm / self.helix_deg.to_radians().cos();
        (reference + 11.0 * self.module_mm).ceil()
    }

    /// Half of the reference diameter in whole mm, or as it is where that is too coarse.
    fn bore(&self, i: usize) -> f64 {
        let half = 0.5 * f64::from(self.teeth[i]) * self.module_mm / self.helix_deg.to_radians().cos();
        if half >= 10.0 { half.round() } else { (1e3 * half).round() / 1e3 }
    }

    fn pair_and_load(&self, t: &mut String) {
        let _ =
            write!(t, "[pair]\nnormal_module_mm = {:?}\nface_width_mm = {:?}\n", self.module_mm, self.face_width_mm);
        let _ = match self.mid_face_offset_mm {
            Some(offset) => writeln!(t, "mid_face_offset_mm = {offset:?}"),
            None => writeln!(t, "# mid_face_offset_mm = 0.5        # of the wheel over the pinion, along +z"),
        };
        let _ = match self.pressure_angle_deg {
            Some(angle) => writeln!(t, "normal_pressure_angle_deg = {angle:?}"),
            None => writeln!(t, "# normal_pressure_angle_deg = 20.0"),
        };
        let _ = match self.centre_distance_mm {
            Some(a) => writeln!(t, "centre_distance_mm = {a:?}"),
            None => {
                writeln!(
                    t,
                    "# the centre distance follows from the profile shifts; `centre_distance_mm` states another"
                )
            }
        };
        let rack = [
            ("dedendum_coefficient", self.dedendum_coefficient),
            ("root_radius_coefficient", self.root_radius_coefficient),
        ];
        for (key, value) in rack.into_iter().filter_map(|(key, value)| Some((key, value?))) {
            let _ = writeln!(t, "{key} = {value:?}");
        }
        t.push_str("\n[operation]\n");
        t.push_str(match self.driver {
            Driver::Pinion => "# driver = \"pinion\"               # or \"wheel\"\n",
            Driver::Wheel => "driver = \"wheel\"\n",
        });
        t.push_str(match self.rotation {
            Sense::Ccw => "# rotation = \"ccw\"                # of the pinion, seen from +z; or \"cw\"\n",
            Sense::Cw => "rotation = \"cw\"                  # of the pinion, seen from +z\n",
        });
        let _ = write!(
            t,
            "torque_nm = {:?}                # on the driven gear\n\
             speed_rpm = {:?}               # of the driver\n\n",
            self.torque_nm, self.speed_rpm
        );
    }
}

const MODIFICATION: &str = "\
# [pinion.modification]           # micro-geometry: material removed, um
# lead_crowning_um = 5.0
# profile_crowning_um = 3.0
";

const STATIC: &str = "\
[analysis]
kind = \"static\"                   # equilibrium at every position of the mesh cycle
# model = \"reduced\"               # or \"iso\" (no mesh, at once), \"full\" (every degree of freedom)
# positions_per_cycle = 32
# cycles = 1

[output]
# root_stress = true              # stress in the root fillets
# vtu = true                      # ParaView files
";

const DYNAMIC: &str = "\
[analysis]
kind = \"dynamic\"                  # motion in time
# cycles = 8                      # mesh cycles that are written after the motion has settled

[motion]
# run = \"steady\"                  # until it repeats itself; or \"span\", \"ramp\", \"sweep\", \"shooting\"
# steps_per_mesh_cycle = 64
# mesh_damping_ratio = 0.05

[drive]
# by = \"speed\"                    # or \"torque\": then its speed is free

[pinion.body]
# added_inertia_kg_m2 = 0.01      # of motor or load on the same axis

[wheel.body]
# added_inertia_kg_m2 = 0.01
";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    fn read(text: &str) -> Scene {
        Scene::parse(text, "a.toml".as_ref()).unwrap_or_else(|e| panic!("{e}\n{text}"))
    }

    /// The text is a scene of a running pair that says what was asked for.
    #[test]
    fn a_starter_is_a_scene_that_runs_as_it_is() {
        for kind in [Kind::Static, Kind::Dynamic] {
            let asked = Starter {
                name: "a \"quoted\" name".into(),
                teeth: [23, 41],
                module_mm: 2.5,
                helix_deg: -15.0,
                face_width_mm: 18.0,
                torque_nm: 80.0,
                speed_rpm: 1500.0,
                profile_shift: [0.3, 0.1],
                centre_distance_mm: Some(84.0),
                pressure_angle_deg: Some(20.0),
                tip_diameter_mm: [None, Some(111.9)],
                bore_diameter_mm: [Some(25.0), None],
                thickness_allowance_mm: [None, Some(0.05)],
                steel: [Steel::default(), Steel { poisson: Some(0.29), ..Steel::default() }],
                dedendum_coefficient: Some(1.2),
                root_radius_coefficient: Some(0.3),
                driver: Driver::Wheel,
                rotation: Sense::Cw,
                own_face_width_mm: [Some(20.0), None],
                mid_face_offset_mm: Some(0.5),
                kind,
            };
            let scene = read(&asked.text("a.toml"));
            assert_eq!((scene.name.as_str(), scene.analysis.kind), ("a \"quoted\" name", kind));
            assert_eq!([scene.pinion.teeth, scene.wheel.teeth], [23, 41]);
            assert_eq!(scene.wheel.helix_angle_deg, 15.0);
            assert_eq!([scene.pinion.profile_shift, scene.wheel.profile_shift], [0.3, 0.1]);
            assert_eq!((scene.pair.normal_module_mm, scene.pair.face_width_mm), (2.5, 18.0));
            assert_eq!((scene.face_widths_mm(), scene.pair.mid_face_offset_mm), ([20.0, 18.0], Some(0.5)));
            assert_eq!((scene.pair.centre_distance_mm, scene.operation.torque_nm), (Some(84.0), 80.0));
            assert_eq!(scene.operation.speed_rpm, 1500.0);
            assert_eq!((scene.operation.driver, scene.operation.rotation), (Driver::Wheel, Sense::Cw));
            assert_eq!((scene.pinion.bore_diameter_mm, scene.wheel.thickness_allowance_mm), (25.0, 0.05));
            assert_eq!((scene.wheel.material.poisson, scene.pinion.material.poisson), (0.29, 0.3));
            assert_eq!((scene.pair.dedendum_coefficient, scene.pair.root_radius_coefficient), (1.2, 0.3));
            assert!(scene.gear_pair().is_ok());
        }
    }

    /// Every line that is commented out may be taken in.
    #[test]
    fn what_is_commented_out_is_right_as_well() {
        for kind in [Kind::Static, Kind::Dynamic] {
            let text = Starter { kind, ..Starter::default() }.text("a.toml");
            let lines: Vec<&str> = text.lines().collect();
            let mut taken = 0;
            for (i, line) in lines.iter().enumerate() {
                // A mesh would have to be there.
                let Some(key) = line.strip_prefix("# ").filter(|l| l.contains(" = ") && !l.starts_with("mesh")) else {
                    continue;
                };
                let mut changed = lines.clone();
                changed[i] = key;
                // Keys of the table that is commented out with them.
                let table = (0..i).rev().find(|&j| lines[j].trim_start_matches("# ").starts_with('['));
                if let Some(j) = table {
                    changed[j] = lines[j].trim_start_matches("# ");
                }
                read(&changed.join("\n"));
                taken += 1;
            }
            assert!(taken >= 10, "{taken} lines only");
        }
    }
}
