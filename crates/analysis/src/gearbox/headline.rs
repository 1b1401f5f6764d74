//! Values by which a gearbox is judged, varied and compared.

use described::Key;
use gearbox::LoadSharing;
use rating::SpectrumRating;
use scene::gearbox::{Gearbox, MeshModel};
use serde_json::{Map, Value, json};

use crate::{motion::RunUpHeadline, pair_rating::RatingHeadline, run_up::RunUpTorque};

use super::{
    BearingLife, BearingLoad, GearboxBranchResult, GearboxMotionResult, GearboxResult, MeshResult, OutputResult, Rates,
    RollingLoad, RootBending, VibrationResult,
};

/// What a number is of, and how it is read off; of meshes and bearings by their place in the file.
#[derive(Clone, Copy)]
enum Of {
    Whole(fn(&GearboxResult) -> f64),
    Meshes(fn(&MeshResult) -> Option<f64>),
    Gears(fn(&RootBending) -> Option<f64>),
    Outputs(fn(&OutputResult) -> f64),
    Bearings(fn(&BearingLoad) -> f64),
    Planets(fn(&LoadSharing) -> Option<f64>),
    PlanetTilts(fn(&[f64]) -> f64),
    MeshesRated(fn(&RatingHeadline) -> Option<f64>),
    BearingsRated(fn(&BearingLife) -> Option<f64>),
    BearingsLosing(fn(&RollingLoad) -> Option<f64>),
    BearingsRolling(fn(&RollingLoad) -> Option<f64>),
    BearingsUnderSpectrum(fn(&RollingLoad) -> Option<f64>),
    MeshesUnderSpectrum(fn(&SpectrumRating) -> f64),
    Efficient,
    MeshesVibrating(fn(&VibrationResult, usize) -> f64),
    BearingsVibrating(fn(&VibrationResult, usize) -> f64),
    RunUp(fn(RunUpTorque) -> f64),
    MeshesMoving(fn(&GearboxMotionResult, usize) -> f64),
    MeshesPressed(fn(&GearboxMotionResult, usize) -> f64),
    MeshesOverSpeed(fn(&RunUpHeadline) -> f64),
    BearingsMoving(fn(&GearboxMotionResult, usize) -> f64),
    Branch(fn(&GearboxBranchResult) -> f64),
    MeshesOnBranch(fn(&GearboxBranchResult, usize) -> f64),
}

/// A number of the headline.
struct Number {
    key: Key,
    of: Of,
}

const fn one(name: &'static str, meaning: &'static str, of: fn(&GearboxResult) -> f64) -> Number {
    Number { key: Key::new(name, "f64", meaning), of: Of::Whole(of) }
}

const fn list(name: &'static str, meaning: &'static str, of: Of) -> Number {
    Number { key: Key::new(name, "Vec<f64>", meaning), of }
}

/// Every number once; those of meshes, outputs and bearings are lists in the order of the file.
const NUMBERS: [Number; 47] = [
    one("mean_input_torque_nm", "mean torque that holds the input, about +z", |r| 1e-3 * r.input_torque),
    list(
        "mean_ste_um",
        "mean static transmission error of each mesh",
        Of::Meshes(|m| Some(1e3 * m.transmission_error[0])),
    ),
    list(
        "peak_to_peak_ste_um",
        "peak to peak of the static transmission error of each mesh",
        Of::Meshes(|m| Some(1e3 * m.transmission_error[1])),
    ),
    list(
        "misalignment_in_plane_um",
        "mean misalignment of each mesh in the plane of action, over the common face width",
        Of::Meshes(|m| Some(1e3 * m.misalignment[0])),
    ),
    list(
        "face_load_factor",
        "K_Hbeta of each mesh from the solved distribution of the load, over all positions",
        Of::Meshes(|m| m.face_load_factor),
    ),
    list("max_pressure_mpa", "largest contact pressure of each mesh", Of::Meshes(|m| Some(m.max_pressure))),
    list(
        "max_root_stress_mpa",
        "largest tension in the root fillets of each gear, in all its meshes; with `root_stress = true` in the scene of a mesh, `null` of a gear without",
        Of::Gears(|g| Some(g.largest)),
    ),
    list(
        "root_stress_range_mpa",
        "largest minus smallest root stress of each gear at the place of the largest tension; with `root_stress = true`",
        Of::Gears(|g| Some(g.range())),
    ),
    list(
        "root_stress_ratio",
        "R of each gear: smallest over largest root stress at the place of the largest tension, near -1.2 of idlers and planets; with `root_stress = true`",
        Of::Gears(RootBending::ratio),
    ),
    list(
        "peak_to_peak_lag_urad",
        "peak to peak of the lag of each output: the transmission error from input to output",
        Of::Outputs(|o| 1e6 * o.peak_to_peak),
    ),
    list(
        "mean_bearing_force_n",
        "size of the mean force of each bearing",
        Of::Bearings(|b| b.force[0].hypot(b.force[1]).hypot(b.force[2])),
    ),
    list(
        "load_sharing_factor",
        "K_gamma of each mesh that planets have in common, in the order of the file: the largest share of a planet over that of an even load, over all positions; with `[[planets]]`",
        Of::Planets(|p| p.factor),
    ),
    list(
        "max_planet_tilt_urad",
        "largest angle of a planet's axis from its nominal direction, of the gears of each mesh that planets have in common, in the order of the file; with `[[planets]]`",
        Of::PlanetTilts(|all| 1e6 * all.iter().copied().fold(0.0, f64::max)),
    ),
    list(
        "least_pitting_safety",
        "smaller S_H of both gears of each mesh; with `[rating]`, `null` of a mesh without one",
        Of::MeshesRated(|r| Some(r.least_pitting_safety)),
    ),
    list(
        "least_bending_safety",
        "smaller S_F of both gears of each mesh; with `[rating]`",
        Of::MeshesRated(|r| Some(r.least_bending_safety)),
    ),
    list(
        "pitting_utilisation",
        "1 over the smaller S_H of each mesh, for goals and limits of `ale-gear optimise`; with `[rating]`",
        Of::MeshesRated(|r| Some(r.pitting_utilisation)),
    ),
    list(
        "bending_utilisation",
        "1 over the smaller S_F of each mesh; with `[rating]`",
        Of::MeshesRated(|r| Some(r.bending_utilisation)),
    ),
    list(
        "least_scuffing_safety",
        "least safety against scuffing of each mesh; with `[rating]`, `null` of a mesh without `scuffing`",
        Of::MeshesRated(|r| r.least_scuffing_safety),
    ),
    list(
        "mesh_loss_w",
        "power that the teeth of each mesh lose by sliding in their oil; with `[rating]`, `null` of a mesh without `oil_temperature_c`",
        Of::MeshesRated(|r| r.mesh_loss.map(|loss| loss.mesh_loss_w)),
    ),
    list(
        "bearing_loss_w",
        "power that each bearing loses in an oil bath; with `viscosity_mm2_per_s`, `null` of a bearing of a stiffness",
        Of::BearingsLosing(|r| r.loss_w),
    ),
    Number {
        key: Key::new(
            "efficiency",
            "f64",
            "output power over input power by the losses of meshes and rolling bearings; where every loaded mesh has one",
        ),
        of: Of::Efficient,
    },
    list(
        "bearing_static_safety",
        "S_0 of ISO 76 of each bearing, from the pressure of its most loaded rolling element; `null` of a bearing of a stiffness or without load",
        Of::BearingsRolling(|r| r.static_safety),
    ),
    list(
        "bearing_life_h",
        "modified life of each bearing, the basic one without `contamination_factor`; with `[rating]`, `null` of a bearing without `dynamic_rating_kn` or `designation`",
        Of::BearingsRated(BearingLife::rated_hours),
    ),
    list(
        "bearing_spectrum_life_h",
        "life of each bearing under the load spectrum, modified with `contamination_factor`, else basic; with `spectrum`, `null` of a bearing without `dynamic_rating_kn` or `designation`, and of one that does not tire",
        Of::BearingsUnderSpectrum(|r| r.spectrum_life_h),
    ),
    list(
        "pitting_damage",
        "larger Miner's sum for pitting of both gears of each mesh under the load spectrum; with `spectrum`",
        Of::MeshesUnderSpectrum(|s| s.pinion.pitting_damage.max(s.wheel.pitting_damage)),
    ),
    list(
        "bending_damage",
        "larger Miner's sum for tooth root breakage of both gears of each mesh under the load spectrum; with `spectrum`",
        Of::MeshesUnderSpectrum(|s| s.pinion.bending_damage.max(s.wheel.bending_damage)),
    ),
    list(
        "bearing_load_over_rating",
        "equivalent load of each bearing over its dynamic rating; with `[rating]`",
        Of::BearingsRated(|l| Some(l.over_rating)),
    ),
    list(
        "largest_dynamic_force_rms_n",
        "largest root mean square over all speeds of the dynamic normal force of each mesh; with `[vibration]`",
        Of::MeshesVibrating(|s, i| s.peak(|rms| rms.mesh_forces[i]).unwrap_or_default().1),
    ),
    list(
        "largest_housing_force_rms_n",
        "largest root mean square over all speeds of the force of each bearing on the housing; with `[vibration]`",
        Of::BearingsVibrating(|s, i| s.peak(|rms| rms.bearing_forces[i]).unwrap_or_default().1),
    ),
    list(
        "peak_to_peak_dte_um",
        "largest minus smallest dynamic transmission error of a mesh cycle of each mesh, averaged over its cycles; with `to_speed_rpm` the largest of a cycle; with `[motion]`",
        Of::MeshesMoving(|m, i| m.reached.meshes[i].peak_to_peak_dte_um),
    ),
    list(
        "min_dte_um",
        "smallest dynamic transmission error of each mesh over all rows; with `[motion]`",
        Of::MeshesMoving(|m, i| m.reached.meshes[i].dte_um.least),
    ),
    list(
        "max_dte_um",
        "largest dynamic transmission error of each mesh over all rows; with `[motion]`",
        Of::MeshesMoving(|m, i| m.reached.meshes[i].dte_um.largest),
    ),
    list(
        "min_normal_force_n",
        "smallest sum of the normal forces on the driving flanks of each mesh over all rows, damping included; with `[motion]`",
        Of::MeshesMoving(|m, i| m.reached.meshes[i].normal_force.least),
    ),
    list(
        "max_normal_force_n",
        "largest sum of the normal forces on the driving flanks of each mesh over all rows, damping included; with `[motion]`",
        Of::MeshesMoving(|m, i| m.reached.meshes[i].normal_force.largest),
    ),
    list(
        "max_coast_normal_force_n",
        "largest sum of the normal forces on the coast flanks of each mesh over all rows, damping included; with `[motion]`",
        Of::MeshesMoving(|m, i| m.reached.meshes[i].coast_normal_force),
    ),
    list(
        "max_dynamic_pressure_mpa",
        "largest contact pressure of each mesh over all rows, on driving or coast flanks; with `[motion]` and `mesh = \"exact\"`",
        Of::MeshesPressed(|m, i| m.reached.meshes[i].max_pressure),
    ),
    list(
        "max_radial_bearing_force_n",
        "largest radial force of each bearing over all rows; with `[motion]`",
        Of::BearingsMoving(|m, i| m.reached.radial_force[i].largest),
    ),
    list(
        "run_up_resonance_rpm",
        "speed of the input at the largest peak to peak of the dynamic transmission error of a cycle of each mesh; with `to_speed_rpm`",
        Of::MeshesOverSpeed(|h| h.peak_to_peak_dte_um.driver_speed_rpm),
    ),
    list(
        "run_up_max_force_rpm",
        "speed of the input at the largest sum of the normal forces on the driving flanks of each mesh; with `to_speed_rpm`",
        Of::MeshesOverSpeed(|h| h.normal_force_n.driver_speed_rpm),
    ),
    Number {
        key: Key::new("run_up_s", "f64", "duration of the run-up; with `to_speed_rpm`"),
        of: Of::RunUp(|r| r.duration),
    },
    Number {
        key: Key::new(
            "run_up_inertia_torque_nm",
            "f64",
            "largest torque at the input that accelerates all but its own shaft, beside that of the load; with `to_speed_rpm`",
        ),
        of: Of::RunUp(|r| 1e-3 * r.inertia),
    },
    Number {
        key: Key::new("run_up_load_torque_nm", "f64", "torque of the loads at the input; with `to_speed_rpm`"),
        of: Of::RunUp(|r| 1e-3 * r.load),
    },
    Number {
        key: Key::new(
            "branch_folds",
            "f64",
            "number of folds of the branch over the speed; with `run = \"continuation\"`",
        ),
        of: Of::Branch(|b| b.figures.folds.len() as f64),
    },
    Number {
        key: Key::new(
            "branch_unstable",
            "f64",
            "number of unstable motions of the branch; with `run = \"continuation\"`",
        ),
        of: Of::Branch(|b| b.figures.unstable as f64),
    },
    list(
        "branch_peak_to_peak_dte_um",
        "largest peak to peak of the dynamic transmission error of each mesh along the branch; with `run = \"continuation\"`",
        Of::MeshesOnBranch(|b, i| b.largest(i).map_or(f64::NAN, |p| p.peak_to_peak_dte_um)),
    ),
    list(
        "branch_resonance_rpm",
        "speed of the input at that peak to peak; with `run = \"continuation\"`",
        Of::MeshesOnBranch(|b, i| b.largest(i).map_or(f64::NAN, |p| p.value)),
    ),
    list(
        "branch_max_normal_force_n",
        "largest normal force of each mesh along the branch; with `run = \"continuation\"`",
        Of::MeshesOnBranch(|b, i| b.points.iter().map(|p| p[i].max_normal_force_n).fold(0.0, f64::max)),
    ),
];

impl GearboxResult {
    /// The headline of `summary.json`; units are in the names. Values of a vibration or a motion are included if the
    /// file requests one.
    pub fn headline(&self) -> Value {
        let meshes = 0..self.meshes.len();
        let bearings = 0..self.bearings.len();
        let value = |of: Of| -> Option<Value> {
            Some(match of {
                Of::Whole(own) => json!(own(self)),
                Of::Meshes(own) => self.meshes.iter().map(own).collect(),
                Of::Gears(own) => {
                    let of = |fillets: &Option<[RootBending; 2]>| fillets.as_ref().and_then(|[worst, _]| own(worst));
                    let some = self.root_bending.iter().any(Option::is_some);
                    some.then(|| self.root_bending.iter().map(of).collect())?
                }
                Of::Outputs(own) => self.outputs.iter().map(own).collect(),
                Of::Bearings(own) => self.bearings.iter().map(own).collect(),
                Of::Planets(own) => (!self.planets.is_empty()).then(|| self.planets.iter().map(own).collect())?,
                Of::PlanetTilts(own) => {
                    let all = &self.planet_tilts;
                    (!all.is_empty()).then(|| all.iter().map(|tilts| own(tilts)).collect())?
                }
                Of::MeshesRated(own) => {
                    let of = |m: &MeshResult| m.rating.as_ref().and_then(own);
                    self.rates.meshes.then(|| self.meshes.iter().map(of).collect())?
                }
                Of::Efficient => self.rates.efficiency.then(|| json!(self.efficiency()))?,
                Of::BearingsLosing(own) => {
                    let of = |b: &BearingLoad| b.rolling.as_ref().and_then(own);
                    self.rates.bearing_losses.then(|| self.bearings.iter().map(of).collect())?
                }
                Of::BearingsRolling(own) => {
                    let of = |b: &BearingLoad| b.rolling.as_ref().and_then(own);
                    let some = self.bearings.iter().any(|b| b.rolling.is_some());
                    some.then(|| self.bearings.iter().map(of).collect())?
                }
                Of::BearingsUnderSpectrum(own) => {
                    let of = |b: &BearingLoad| b.rolling.as_ref().and_then(own);
                    let asked = self.rates.spectrum && self.rates.lives;
                    asked.then(|| self.bearings.iter().map(of).collect())?
                }
                Of::MeshesUnderSpectrum(own) => {
                    let of = |m: &MeshResult| m.rating.as_ref()?.spectrum.as_ref().map(own);
                    let asked = self.rates.spectrum && self.rates.meshes;
                    asked.then(|| self.meshes.iter().map(of).collect())?
                }
                Of::BearingsRated(own) => {
                    let of = |b: &BearingLoad| b.rolling.as_ref().and_then(|r| r.life.as_ref()).and_then(own);
                    self.rates.lives.then(|| self.bearings.iter().map(of).collect())?
                }
                Of::MeshesVibrating(own) => {
                    self.vibration.as_ref().map(|s| meshes.clone().map(|i| own(s, i)).collect())?
                }
                Of::BearingsVibrating(own) => {
                    self.vibration.as_ref().map(|s| bearings.clone().map(|i| own(s, i)).collect())?
                }
                Of::RunUp(own) => json!(own(self.motion.as_ref()?.run_up?)),
                Of::MeshesMoving(own) => self.motion.as_ref().map(|m| meshes.clone().map(|i| own(m, i)).collect())?,
                Of::MeshesOverSpeed(own) => {
                    let all = &self.motion.as_ref().filter(|m| m.run_up.is_some())?.run_ups;
                    all.iter().map(|of| of.headline().as_ref().map(own)).collect()
                }
                Of::MeshesPressed(own) => {
                    let solved = self.motion.as_ref().filter(|m| m.knows_pressure)?;
                    meshes.clone().map(|i| own(solved, i)).collect()
                }
                Of::Branch(own) => json!(own(self.branch.as_ref()?)),
                Of::MeshesOnBranch(own) => self.branch.as_ref().map(|b| meshes.clone().map(|i| own(b, i)).collect())?,
                Of::BearingsMoving(own) => {
                    self.motion.as_ref().map(|m| bearings.clone().map(|i| own(m, i)).collect())?
                }
            })
        };
        NUMBERS.iter().filter_map(|n| Some((n.key.name.to_owned(), value(n.of)?))).collect::<Map<_, _>>().into()
    }

    /// Keys of the headline before anything is solved, each with the number of values in its list; `None`: a single
    /// value.
    pub fn headline_keys(file: &Gearbox) -> Vec<(&'static str, Option<usize>)> {
        let rates = Rates::of(file);
        let (vibrates, moves) = (file.vibration.is_some(), file.motion.is_some());
        let of_planets = file.meshes_of_planets().count();
        let count = |of: Of| match of {
            Of::Whole(_) => Some(None),
            Of::Meshes(_) => Some(Some(file.meshes.len())),
            Of::Gears(_) => {
                let some = file.meshes.iter().any(|m| m.scene.output.root_stress);
                some.then_some(Some(file.gears.len()))
            }
            Of::Outputs(_) => Some(Some(file.torques.len())),
            Of::Bearings(_) => Some(Some(file.bearings.len())),
            Of::Planets(_) | Of::PlanetTilts(_) => (of_planets > 0).then_some(Some(of_planets)),
            Of::MeshesRated(_) => rates.meshes.then_some(Some(file.meshes.len())),
            Of::Efficient => rates.efficiency.then_some(None),
            Of::BearingsRolling(_) => {
                let some = file.bearings.iter().any(|b| b.rolling.is_some());
                some.then_some(Some(file.bearings.len()))
            }
            Of::BearingsLosing(_) => rates.bearing_losses.then_some(Some(file.bearings.len())),
            Of::BearingsUnderSpectrum(_) => (rates.spectrum && rates.lives).then_some(Some(file.bearings.len())),
            Of::MeshesUnderSpectrum(_) => (rates.spectrum && rates.meshes).then_some(Some(file.meshes.len())),
            Of::BearingsRated(_) => rates.lives.then_some(Some(file.bearings.len())),
            Of::MeshesVibrating(_) => vibrates.then_some(Some(file.meshes.len())),
            Of::BearingsVibrating(_) => vibrates.then_some(Some(file.bearings.len())),
            Of::RunUp(_) => file.motion.as_ref().and_then(|m| m.to_speed_rpm).map(|_| None),
            Of::MeshesMoving(_) => moves.then_some(Some(file.meshes.len())),
            Of::MeshesOverSpeed(_) => {
                let led = file.motion.as_ref().is_some_and(|m| m.to_speed_rpm.is_some());
                led.then_some(Some(file.meshes.len()))
            }
            Of::MeshesPressed(_) => {
                let solved = file.motion.as_ref().is_some_and(|m| m.mesh == MeshModel::Exact);
                solved.then_some(Some(file.meshes.len()))
            }
            Of::Branch(_) => file.branch.map(|_| None),
            Of::MeshesOnBranch(_) => file.branch.map(|_| Some(file.meshes.len())),
            Of::BearingsMoving(_) => moves.then_some(Some(file.bearings.len())),
        };
        NUMBERS.iter().filter_map(|n| Some((n.key.name, count(n.of)?))).collect()
    }

    /// Keys of all values that a headline may contain.
    pub fn number_keys() -> Vec<Key> {
        NUMBERS.iter().map(|n| n.key).collect()
    }

    /// Whether a value of the headline, given by its key, belongs to the vibration, to the motion, to the branch over
    /// the speed, or to the load spectrum.
    pub fn asks_for(key: &str) -> [bool; 4] {
        let of = NUMBERS.iter().find(|n| n.key.name == key).map(|n| n.of);
        [
            matches!(of, Some(Of::MeshesVibrating(_) | Of::BearingsVibrating(_))),
            matches!(
                of,
                Some(
                    Of::MeshesMoving(_)
                        | Of::MeshesPressed(_)
                        | Of::BearingsMoving(_)
                        | Of::RunUp(_)
                        | Of::MeshesOverSpeed(_)
                )
            ),
            matches!(of, Some(Of::Branch(_) | Of::MeshesOnBranch(_))),
            matches!(of, Some(Of::BearingsUnderSpectrum(_) | Of::MeshesUnderSpectrum(_))),
        ]
    }
}
