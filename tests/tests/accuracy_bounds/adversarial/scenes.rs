//! The table: what is asked, and what is true.

use std::path::Path;

use scene::{Scene, SceneBuilder};

use super::body::{Pocket, write_webbed};

/// A scene built so that the estimate should fail.
#[derive(Debug, Clone)]
pub struct Adversary {
    pub name: &'static str,
    pub scene: Scene,
    /// Whether the bounds have to hold.
    pub inside: bool,
    /// What is said not to be covered.
    pub said: Option<&'static str>,
    /// Mean and peak-to-peak STE of the finer run, um; `None` where the ladder has no mesh of that body.
    pub exact: Option<[f64; 2]>,
}

/// 24/31 teeth, five modules wide.
fn pair() -> SceneBuilder {
    of_teeth([24, 31], 15.0)
}

fn of_teeth([pinion, wheel]: [u32; 2], helix_deg: f64) -> SceneBuilder {
    let base = Scene::builder().pinion(pinion, helix_deg).wheel(wheel).normal_module_mm(3.0).face_width_mm(15.0);
    base.torque_nm(200.0)
        .set("analysis.model", "reduced")
        .set("analysis.positions_per_cycle", 16)
        .set("accuracy.mean_ste", "50 %")
}

/// Keys of both gears.
fn both<T: Clone + Into<scene::Value>>(mut builder: SceneBuilder, keys: &[(&str, T)]) -> SceneBuilder {
    for gear in ["pinion", "wheel"] {
        for (key, value) in keys {
            builder = builder.set(&format!("{gear}.{key}"), value.clone());
        }
    }
    builder
}

/// Elements along the profile, the fillet, across the tooth, along the face, in the rim.
fn meshed(builder: SceneBuilder, order: i64, counts: [i64; 5]) -> SceneBuilder {
    let [profile, fillet, thickness, face, rim] = counts;
    both(
        builder,
        &[
            ("mesher.order", order),
            ("mesher.elements_profile", profile),
            ("mesher.elements_fillet", fillet),
            ("mesher.elements_thickness", thickness),
            ("mesher.elements_face", face),
            ("mesher.elements_rim", rim),
        ],
    )
}

/// A rim of so many modules below the root circle of either gear of [`pair`].
fn rims(builder: SceneBuilder, modules: f64) -> SceneBuilder {
    let bore = |teeth: f64| 6.0 * (0.5 * teeth / 15f64.to_radians().cos() - 1.25 - modules);
    builder.set("pinion.bore_diameter_mm", bore(24.0)).set("wheel.bore_diameter_mm", bore(31.0))
}

/// The default pair of `meshes/`.
fn of_meshes(helix_deg: f64) -> SceneBuilder {
    of_teeth([30, 30], helix_deg)
        .face_width_mm(20.0)
        .set("pinion.thickness_allowance_mm", 0.05)
        .set("wheel.thickness_allowance_mm", 0.05)
        .torque_nm(150.0)
        .relative_to(&testing::meshes_folder())
}

/// Mean and peak to peak have to lie inside of their bounds.
fn inside(name: &'static str, builder: SceneBuilder, exact: [f64; 2]) -> Adversary {
    one(name, builder, None, Some(exact))
}

/// The result has to say that it is not covered.
fn beyond(name: &'static str, builder: SceneBuilder, said: &'static str, exact: [f64; 2]) -> Adversary {
    one(name, builder, Some(said), Some(exact))
}

fn one(name: &'static str, builder: SceneBuilder, said: Option<&'static str>, exact: Option<[f64; 2]>) -> Adversary {
    let scene = builder.set("name", name).build().unwrap_or_else(|e| panic!("{name}: {e}"));
    Adversary { name, scene, inside: said.is_none(), said, exact }
}

impl Adversary {
    /// It says that it is not covered as well.
    fn and_says(self, said: &'static str) -> Self {
        Self { said: Some(said), ..self }
    }
}

/// Meshes that are coarse where it matters, bodies that the ladder does not know, models without slices; files go into
/// `folder`.
pub fn meshes_and_models(folder: &Path) -> Vec<Adversary> {
    vec![
        inside("one element across a thin rim", meshed(rims(pair(), 1.0), 2, [8, 2, 4, 9, 1]), [11.2286, 4.2034]),
        inside("fine along the profile alone", meshed(pair(), 2, [12, 2, 2, 3, 1]), [16.9975, 4.7704]),
        inside("fine along the face alone", meshed(pair(), 2, [1, 2, 2, 20, 1]), [16.9975, 4.7704]),
        inside("one element each way", meshed(pair(), 2, [1, 2, 2, 1, 1]), [16.9975, 4.7704]),
        inside("linear elements", meshed(pair(), 1, [2, 2, 2, 4, 2]), [16.9975, 4.7704]),
        inside(
            "hex8 meshes of Gmsh",
            of_meshes(20.0).set("pinion.mesh", "coarse_hex8_pinion.msh").set("wheel.mesh", "coarse_hex8_wheel.msh"),
            [9.4284, 1.1614],
        ),
        inside("seven teeth with free cuts", both(pair(), &[("mesher.sector_teeth", 7)]), [18.6967, 4.6428]),
        one("gears with webs", webbed(folder), Some("another body"), None),
        inside("pressed points", meshed(pair(), 2, [3, 2, 2, 4, 2]).set("contact.method", "nodal"), [16.9975, 4.7704]),
        inside("the formula of ISO", rims(pair(), 1.0).set("analysis.model", "iso"), [11.2286, 4.2034]),
    ]
}

/// Contact at edges and on spikes, few slices, few positions; files go into `folder`.
pub fn flanks_and_resolution(folder: &Path) -> Vec<Adversary> {
    vec![
        inside("contact at one end", pair().set("pair.misalignment.in_plane_of_action_um", 100.0), [-28.4219, 15.6630])
            .and_says("a misalignment"),
        beyond(
            "contact of tip corners",
            of_teeth([24, 31], 0.0).torque_nm(700.0),
            "a Hertz pressure",
            [51.8905, 23.1767],
        ),
        inside(
            "tips that stand out",
            both(pair(), &[("modification.tip_relief_um", -30.0), ("modification.tip_relief_start_roll_deg", 28.0)]),
            [9.3873, 4.9491],
        )
        .and_says("a tip relief"),
        inside("ends that stand out", both(pair(), &[("modification.lead_crowning_um", -30.0)]), [-15.7379, 5.5206])
            .and_says("a lead crowning"),
        beyond("spikes between slices", spiked(folder), "topographies", [16.8052, 4.7796]),
        beyond(
            "a tooth that leads",
            pair().set("pinion.pitch_errors_um", vec![20.0; 12].into_iter().chain(vec![0.0; 12]).collect::<Vec<_>>()),
            "pitch errors",
            [1.2834, 8.9736],
        ),
        beyond(
            "huge crowning on eight slices",
            pair().set("pinion.modification.lead_crowning_um", 100.0).set("contact.slices", 8),
            "slices: the calibration",
            [29.8975, 11.4349],
        ),
        beyond(
            "four slices on a wide face",
            of_teeth([24, 31], 30.0).face_width_mm(30.0).torque_nm(400.0).set("contact.slices", 4),
            "slices: the calibration",
            [18.3767, 1.5774],
        ),
        inside(
            "eight positions, contact ratio near one",
            of_teeth([13, 14], 0.0)
                .torque_nm(100.0)
                .set("pair.normal_pressure_angle_deg", 27.0)
                .set("analysis.positions_per_cycle", 8),
            [19.1415, 8.1582],
        ),
        beyond(
            "seven positions",
            pair().set("analysis.positions_per_cycle", 7),
            "positions a cycle",
            [16.9970, 4.7704],
        ),
        beyond("two positions", pair().set("analysis.positions_per_cycle", 2), "positions a cycle", [16.9846, 4.7704]),
    ]
}

/// Gears beyond the ranges of the calibration, or at their end.
pub fn beyond_ranges() -> Vec<Adversary> {
    vec![
        beyond(
            "a pressure angle of 32 degrees",
            pair()
                .set("pair.normal_pressure_angle_deg", 32.0)
                .set("pair.addendum_coefficient", 0.8)
                .set("pair.dedendum_coefficient", 1.0),
            "pressure angle",
            [17.1721, 1.6904],
        ),
        beyond(
            "a rim of 0.3 modules",
            meshed(rims(pair(), 0.3), 2, [4, 4, 4, 6, 1]),
            "rim of the pinion",
            [9.3348, 3.8039],
        ),
        beyond("a helix angle of 50 degrees", of_teeth([24, 31], 50.0), "a helix angle", [48.5640, 1.5190]),
        beyond("next to no load", pair().torque_nm(0.5), "a Hertz pressure", [0.0522, 0.0247]),
        beyond(
            "a wheel of plastic",
            pair().torque_nm(5.0).set("wheel.material.young_mpa", 3000.0).set("wheel.material.poisson", 0.45),
            "a Hertz pressure",
            [13.8545, 5.5086],
        ),
        inside("next to incompressible", pair().set("material.poisson", 0.45), [16.7121, 4.6113]).and_says("Poisson"),
        beyond(
            "a pinion of eight teeth",
            of_teeth([8, 150], 15.0).set("pinion.profile_shift", 0.5),
            "teeth of the wheel",
            [6.4134, 1.5763],
        ),
        beyond("a narrow face", pair().face_width_mm(5.0).torque_nm(70.0), "b/m_n", [26.0406, 9.1639]),
        inside(
            "long teeth",
            pair()
                .set("pair.addendum_coefficient", 1.3)
                .set("pair.dedendum_coefficient", 1.55)
                .set("pair.root_radius_coefficient", 0.2),
            [17.6430, 1.1008],
        )
        .and_says("a basic rack"),
    ]
}

/// Hub, web of a fifth of the width and rim.
fn webbed(folder: &Path) -> SceneBuilder {
    let plain = of_teeth([30, 40], 15.0).build().unwrap();
    let pair = plain.gear_pair().unwrap();
    let files = ["pinion.msh", "wheel.msh"].map(|name| folder.join(name));
    for (gear, file) in [&pair.pinion, &pair.wheel].into_iter().zip(&files) {
        let [bore, root] = [0.5 * gear.data().bore_diameter, gear.root_radius()];
        let pocket = Pocket { from: bore + 0.25 * (root - bore), to: root - 3.0, half_web: 2.6 };
        write_webbed(gear, pocket, file);
    }
    let [pinion, wheel] = files.map(|file| file.display().to_string());
    of_teeth([30, 40], 15.0).set("pinion.mesh", pinion).set("wheel.mesh", wheel)
}

/// Bumps of 20 um, half a millimetre wide, between the slices and on few contact lines.
fn spiked(folder: &Path) -> SceneBuilder {
    let spikes = [(3, 10), (9, 4), (14, 21)];
    let (rows, columns) = (20, 30);
    let at = |k: usize, count: usize, from: f64, to: f64| from + (to - from) * k as f64 / (count - 1) as f64;
    let mut text = String::from("roll_deg");
    (0..columns).for_each(|c| text.push_str(&format!(", {:.3}", at(c, columns, -7.2, 7.2))));
    for r in 0..rows {
        text.push_str(&format!("\n{:.3}", at(r, rows, 10.0, 32.0)));
        for c in 0..columns {
            text.push_str(if spikes.contains(&(r, c)) { ", -20" } else { ", 0" });
        }
    }
    let file = folder.join("spikes.csv");
    std::fs::write(&file, text).unwrap();
    pair().set("pinion.modification.topography", file.display().to_string())
}
