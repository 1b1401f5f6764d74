//! Facts of a gearbox, as `summary.json` has them.

use std::f64::consts::TAU;

use analysis::accuracy::Accuracy;
use analysis::gearbox::{BearingLoad, GearboxResult, MeshResult, RollingLoad, RootBending, VibrationResult};
use analysis::pair_rating::RatingHeadline;
use answer::keyed;
use described::Key;
use gearbox::{
    BoltForce, LoadSharing, PlanetShare,
    rolling_bearing::{ElementLoad, RollingElements},
};
use geometry::GearPair;
use scene::gearbox::{Gearbox, GearboxGear, GearboxPlanets, GearboxVibration, PlanetMesh};
use serde::Serialize;
use serde_json::{Map, Value};

use super::{
    branch::BranchSummary,
    motion::{MotionSummary, summary},
    swing_words::{bearing_peaks, first_modes, holders, mesh_peaks},
};

described::described! {
    /// Everything known of a gearbox but its rows and its headline; names of keys bear the units.
    #[derive(Serialize)]
    struct GearboxSummary<'a> {
        /// shafts, in the order of the file
        shafts: Vec<ShaftSummary<'a>>,
        /// meshes, in the order of the file
        meshes: Vec<MeshSummary<'a>>,
        /// root stress of the gears that a mesh knows it of; missing without `root_stress = true` in the scene of a mesh
        #[serde(skip_serializing_if = "Vec::is_empty")]
        root_stress: Vec<RootSummary<'a>>,
        /// bearings, in the order of the file
        bearings: Vec<BearingSummary<'a>>,
        /// bolts of the gears that have some, at rest; missing without
        #[serde(skip_serializing_if = "Vec::is_empty")]
        bolts: Vec<BoltsSummary<'a>>,
        /// outputs, in the order of the torques
        outputs: Vec<OutputSummary>,
        /// how planets share the load of each mesh that they have in common; missing without `[[planets]]`
        #[serde(skip_serializing_if = "Vec::is_empty")]
        planets: Vec<PlanetsSummary<'a>>,
        /// number of positions
        positions: usize,
        /// bounds of the numbers; missing without `[accuracy]`
        #[serde(skip_serializing_if = "Option::is_none")]
        accuracy: Option<&'a Accuracy>,
        /// motion; `null` at rest alone
        motion: Option<MotionSummary<'a>>,
        /// periodic motions over the speed; missing where none are asked for
        #[serde(skip_serializing_if = "Option::is_none")]
        branch: Option<BranchSummary<'a>>,
        /// vibration; missing where none is asked for
        #[serde(skip_serializing_if = "Option::is_none")]
        vibration: Option<VibrationSummary<'a>>,
    }

    /// A shaft.
    #[derive(Serialize)]
    struct ShaftSummary<'a> {
        /// name of the shaft
        name: &'a str,
        /// revolutions of the shaft for one revolution of the input, negative against it
        ratio: f64,
    }

    /// A mesh over all positions.
    #[derive(Serialize)]
    struct MeshSummary<'a> {
        /// name of the mesh
        name: &'a str,
        /// total contact ratio of the pair as it runs
        eps_gamma: f64,
        /// centre distance
        centre_distance_mm: f64,
        /// width over which both gears have flanks
        common_face_width_mm: f64,
        /// height of the wheel's mid-face over the pinion's
        mid_face_offset_mm: f64,
        /// slices over the face width
        slices: usize,
        /// mean sum of the normal forces
        mean_normal_force_n: f64,
        /// mean static transmission error
        mean_ste_um: f64,
        /// peak to peak of the static transmission error
        peak_to_peak_ste_um: f64,
        /// mean misalignment in the plane of action, over the common face width
        misalignment_in_plane_um: f64,
        /// mean misalignment across the plane of action, over the common face width
        misalignment_across_um: f64,
        /// K_Hbeta of the solved distribution of the load
        face_load_factor: Option<f64>,
        /// largest contact pressure
        max_pressure_mpa: f64,
        /// ratings of the pair under the torque and at the speed that it has here; missing without `[rating]`
        #[serde(skip_serializing_if = "Option::is_none")]
        rating: Option<&'a RatingHeadline>,
        /// angle by which the wheel has to be set against its key where the train closes a ring, so that all flanks touch; 0 otherwise
        timing_deg: f64,
    }

    /// Root fillets on one side of the teeth of a gear, over all positions and meshes of the gear.
    #[derive(Serialize)]
    struct RootSummary<'a> {
        /// name of the gear
        gear: &'a str,
        /// side of the teeth: left is the counter-clockwise one, seen from +z
        side: &'static str,
        /// largest first principal stress, tension
        max_root_stress_mpa: f64,
        /// estimated distance of that from an infinitely fine mesh
        estimated_error_percent: f64,
        /// smallest third principal stress at that place: compression below 0
        min_root_stress_mpa: f64,
        /// difference of both
        root_stress_range_mpa: f64,
        /// R: smallest over largest stress; `null` without tension
        root_stress_ratio: Option<f64>,
    }

    /// A mesh that planets have in common, over all positions.
    #[derive(Serialize)]
    struct PlanetsSummary<'a> {
        /// name of the first shaft of the planets
        planets: &'a str,
        /// name of the mesh in the file
        mesh: &'a str,
        /// K_gamma: the largest share of a planet over that of an even load; `null` without load
        load_sharing_factor: Option<f64>,
        /// angle of each planet from the first one about +z
        angles_deg: Vec<f64>,
        /// mean share of each planet in the load of all; empty without load
        mean_load_share: Vec<f64>,
        /// smallest share of each planet
        min_load_share: Vec<f64>,
        /// largest share of each planet
        max_load_share: Vec<f64>,
        /// largest angle of each planet's axis from its nominal direction, at its gear in this mesh
        max_tilt_urad: Vec<f64>,
    }

    /// A bearing over all positions.
    #[derive(Serialize)]
    struct BearingSummary<'a> {
        /// name of the bearing
        name: &'a str,
        /// mean force on the shaft: x, y, z in common axes
        mean_force_n: [f64; 3],
        /// mean moment on the shaft: x, y, z in common axes
        mean_moment_nmm: [f64; 3],
        /// largest tilt of the shaft against the seat
        max_tilt_urad: f64,
        /// rolling elements; missing for a bearing that is given by its stiffness
        #[serde(skip_serializing_if = "Option::is_none")]
        rolling: Option<RollingSummary>,
    }

    /// Bolts of a gear over all positions.
    #[derive(Serialize)]
    pub(super) struct BoltsSummary<'a> {
        /// name of the gear
        pub gear: &'a str,
        /// mean force of each bolt that presses the gear along the radius, with `preload_n`, from the first one on
        pub mean_radial_forces_n: Vec<f64>,
        /// largest of the forces along the radius
        pub max_radial_force_n: f64,
        /// least of them; below 0 a bolt pulls
        pub min_radial_force_n: f64,
        /// largest force along the circumference
        pub max_tangential_force_n: f64,
        /// largest force along the axis
        pub max_axial_force_n: f64,
        /// largest number of bolts that have lifted off at once
        pub max_open_bolts: usize,
    }

    /// Rolling elements of a bearing over all positions.
    #[derive(Serialize)]
    struct RollingSummary {
        /// rolling elements of a row, as stated, or estimated from the catalogue's values
        elements_per_row: usize,
        /// diameter of a rolling element
        element_diameter_mm: f64,
        /// length of a roller; `null` of balls
        element_length_mm: Option<f64>,
        /// pitch diameter
        pitch_diameter_mm: f64,
        /// whether the internal geometry is estimated from bore, outer diameter and static rating or width
        is_estimated: bool,
        /// C_0, basic static radial load rating of ISO 76, by the rolling elements
        static_rating_kn: f64,
        /// C, basic dynamic radial load rating of ISO 281, stated or estimated; missing without `dynamic_rating_kn` and `designation`
        #[serde(skip_serializing_if = "Option::is_none")]
        dynamic_rating_kn: Option<f64>,
        /// whether the dynamic rating is estimated
        is_rating_estimated: bool,
        /// S_0 of ISO 76 at the largest pressure of a rolling element; `null` without load
        static_safety: Option<f64>,
        /// rolling elements of all rows
        elements: usize,
        /// smallest number of loaded rolling elements
        min_loaded_elements: usize,
        /// largest number of loaded rolling elements
        max_loaded_elements: usize,
        /// rolling elements whose force is not zero in the mean of all positions: from the first to the last of them, past no larger gap
        load_zone_deg: f64,
        /// angle of each rolling element from +x towards +y, row by row
        element_angles_deg: Vec<f64>,
        /// mean force of each of them over all positions, along its contact angle: of a row at an angle they sum up to more than the radial force
        element_mean_forces_n: Vec<f64>,
        /// force on the most loaded rolling element
        max_element_force_n: f64,
        /// contact pressure of the most loaded rolling element; a remark tells of more than the static rating of ISO 76, 4200 MPa of balls and 4000 MPa of rollers
        max_hertz_pressure_mpa: f64,
        /// mean tangent stiffness, which vibration and motion have: five rows for x, y, z and the rotations about x and y, in N/mm, N/rad and N, N mm/rad
        stiffness_n_mm_rad: [[f64; 5]; 5],
        /// life under the load spectrum, by the sum of Miner: modified with `contamination_factor`; missing without `spectrum`
        #[serde(skip_serializing_if = "Option::is_none")]
        spectrum_life_h: Option<f64>,
        /// power that the bearing loses in an oil bath; missing without `viscosity_mm2_per_s`
        #[serde(skip_serializing_if = "Option::is_none")]
        loss_w: Option<f64>,
        /// life at 90 % reliability; missing without `dynamic_rating_kn` or `designation`, and without load
        #[serde(skip_serializing_if = "Option::is_none")]
        life: Option<LifeSummary>,
    }

    /// Life of a rolling bearing at 90 % reliability.
    #[derive(Serialize)]
    struct LifeSummary {
        /// L_10r, basic reference rating life of ISO/TS 16281, millions of turns of the shaft
        basic_life_million_turns: f64,
        /// L_10r at the speed of the shaft
        basic_life_h: f64,
        /// P_ref: radial load that has the same life by the catalogue's formula
        equivalent_load_n: f64,
        /// P_ref over the dynamic rating C
        load_over_rating: f64,
        /// life with oil and dirt, a_ISO L_10r; missing without `contamination_factor`, and where the oil is thinner than ISO 281 covers
        #[serde(skip_serializing_if = "Option::is_none")]
        modified_life_h: Option<f64>,
        /// a_ISO of ISO 281
        #[serde(skip_serializing_if = "Option::is_none")]
        life_modification_factor: Option<f64>,
        /// kappa: viscosity of the oil over the one that the speed asks for
        #[serde(skip_serializing_if = "Option::is_none")]
        viscosity_ratio: Option<f64>,
        /// C_u: load below which raceways do not tire under the best conditions
        #[serde(skip_serializing_if = "Option::is_none")]
        fatigue_limit_n: Option<f64>,
    }

    /// An output over all positions.
    #[derive(Serialize)]
    struct OutputSummary {
        /// mean lag behind the nominal rotation
        mean_lag_urad: f64,
        /// peak to peak of the lag: the transmission error from input to output
        peak_to_peak_lag_urad: f64,
    }

    /// Vibration.
    #[derive(Serialize)]
    struct VibrationSummary<'a> {
        /// smallest and largest speed of the input that were asked for
        input_rpm: [f64; 2],
        /// damping ratio that was asked for
        damping_ratio: f64,
        /// modes at the lowest speed
        modes: Vec<ModeSummary>,
        /// number of modes that the answers are made of
        modes_kept: usize,
        /// frequency at rest up to which no mode is left out
        modes_up_to_hz: f64,
        /// number of rows of `crossings.csv`
        crossings: usize,
        /// meshes, in the order of the file
        meshes: Vec<MeshVibration>,
        /// bearings, in the order of the file
        bearings: Vec<BearingVibration>,
        /// gears, in the order of the file
        gears: Vec<GearMass<'a>>,
    }

    /// A mode.
    #[derive(Serialize)]
    struct ModeSummary {
        /// natural frequency, undamped
        frequency_hz: f64,
        /// parts with a tenth or more of the strain energy
        strain: String,
        /// parts with a tenth or more of the kinetic energy
        kinetic: String,
    }

    /// A mesh that vibrates.
    #[derive(Serialize)]
    struct MeshVibration {
        /// name of the mesh
        name: String,
        /// mean stiffness along the normal, by the rotation of the pinion
        mean_mesh_stiffness_n_per_um: f64,
        /// single-sided amplitudes of the mesh orders of the loaded transmission error
        ste_amplitude_um: Vec<f64>,
        /// largest root mean square of the dynamic normal force over all speeds
        largest_dynamic_force_rms_n: f64,
        /// speed of the input there
        at_input_rpm: f64,
    }

    /// A bearing that vibrates.
    #[derive(Serialize)]
    struct BearingVibration {
        /// name of the bearing
        name: String,
        /// largest root mean square of the force on the housing over all speeds
        largest_housing_force_rms_n: f64,
        /// speed of the input there
        at_input_rpm: f64,
    }

    /// Mass of a gear.
    #[derive(Serialize)]
    struct GearMass<'a> {
        /// name of the gear
        name: &'a str,
        /// mass, stated or of the mesh
        mass_kg: f64,
        /// moment of inertia about a transverse axis, stated or of the mesh
        transverse_inertia_kg_m2: f64,
        /// moment of inertia about the axis, stated or of the mesh
        polar_inertia_kg_m2: f64,
        /// elastic modes that vibrate; 0 of a gear that is rigid beside its teeth
        elastic_modes: usize,
        /// highest frequency of these modes; `null` of a rigid gear
        highest_elastic_mode_hz: Option<f64>,
    }
}

/// Objects of the summary with their keys.
pub(super) const OBJECTS: [(&str, &[Key]); 15] = [
    ("the summary of a gearbox", GearboxSummary::KEYS),
    ("shafts", ShaftSummary::KEYS),
    ("meshes, a gearbox", MeshSummary::KEYS),
    ("root_stress, a gearbox", RootSummary::KEYS),
    ("planets", PlanetsSummary::KEYS),
    ("bearings, a gearbox", BearingSummary::KEYS),
    ("rolling", RollingSummary::KEYS),
    ("bolts", BoltsSummary::KEYS),
    ("life", LifeSummary::KEYS),
    ("outputs, a gearbox", OutputSummary::KEYS),
    ("vibration", VibrationSummary::KEYS),
    ("modes, vibration", ModeSummary::KEYS),
    ("meshes, vibration", MeshVibration::KEYS),
    ("bearings, vibration", BearingVibration::KEYS),
    ("gears, vibration", GearMass::KEYS),
];

/// Everything known of a gearbox but its rows and its headline.
pub(super) fn info(file: &Gearbox, result: &GearboxResult) -> Map<String, Value> {
    let ratios = file.shafts.iter().zip(&result.ratios_in_space);
    let outputs = result.outputs.iter();
    keyed(&GearboxSummary {
        accuracy: result.accuracy.as_ref(),
        shafts: ratios.map(|(shaft, ratio)| ShaftSummary { name: &shaft.name, ratio: *ratio }).collect(),
        meshes: result.meshes.iter().zip(&result.pairs).map(|(m, pair)| mesh(m, pair)).collect(),
        root_stress: roots(file, result),
        bearings: result.bearings.iter().map(bearing).collect(),
        bolts: bolts(file, result),
        outputs: outputs
            .map(|o| OutputSummary { mean_lag_urad: 1e6 * o.mean, peak_to_peak_lag_urad: 1e6 * o.peak_to_peak })
            .collect(),
        planets: file.meshes_of_planets().zip(result.planets.iter().zip(&result.planet_tilts)).map(planets).collect(),
        positions: result.positions.len(),
        motion: summary(file, result),
        branch: result.branch.as_ref().map(|own| BranchSummary::new(result, own)),
        vibration: file.vibration.as_ref().zip(result.vibration.as_ref()).map(|own| vibration(file, own)),
    })
}

fn roots<'a>(file: &'a Gearbox, result: &GearboxResult) -> Vec<RootSummary<'a>> {
    let of_gear = |(gear, both): (&'a GearboxGear, &Option<[RootBending; 2]>)| {
        let one = |own: RootBending| RootSummary {
            gear: &gear.name,
            side: own.side.name(),
            max_root_stress_mpa: own.largest,
            estimated_error_percent: own.error_percent,
            min_root_stress_mpa: own.least,
            root_stress_range_mpa: own.range(),
            root_stress_ratio: own.ratio(),
        };
        both.map(|both| both.map(one)).into_iter().flatten()
    };
    file.gears.iter().zip(&result.root_bending).flat_map(of_gear).collect()
}

/// Bolts of all gears that have some.
pub(super) fn bolts<'a>(file: &'a Gearbox, result: &GearboxResult) -> Vec<BoltsSummary<'a>> {
    let of_gear = |(i, gear): (usize, &'a GearboxGear)| {
        let all: Vec<&Vec<BoltForce>> = result.positions.iter().filter_map(|p| p.bolts.get(i)).collect();
        let count = all.first().map_or(0, |bolts| bolts.len());
        let each = || all.iter().flat_map(|bolts| bolts.iter());
        let most = |of: fn(&BoltForce) -> f64| each().map(of).fold(f64::NEG_INFINITY, f64::max);
        let mean = |k: usize| all.iter().map(|bolts| bolts[k].radial).sum::<f64>() / all.len() as f64;
        (count > 0).then(|| BoltsSummary {
            gear: &gear.name,
            mean_radial_forces_n: (0..count).map(mean).collect(),
            max_radial_force_n: most(|own| own.radial),
            min_radial_force_n: -most(|own| -own.radial),
            max_tangential_force_n: most(|own| own.tangential.abs()),
            max_axial_force_n: most(|own| own.axial.abs()),
            max_open_bolts: all.iter().map(|bolts| bolts.iter().filter(|own| own.open).count()).max().unwrap_or(0),
        })
    };
    file.gears.iter().enumerate().filter_map(of_gear).collect()
}

fn planets<'a>(
    ((own, mesh), (sharing, tilts)): ((&'a GearboxPlanets, &'a PlanetMesh), (&LoadSharing, &Vec<f64>)),
) -> PlanetsSummary<'a> {
    let share = |of: fn(&PlanetShare) -> f64| sharing.planets.iter().map(of).collect();
    PlanetsSummary {
        planets: &own.name,
        mesh: &mesh.name,
        load_sharing_factor: sharing.factor,
        angles_deg: own.angles.iter().map(|angle| angle.to_degrees()).collect(),
        mean_load_share: share(|s| s.mean),
        min_load_share: share(|s| s.least),
        max_load_share: share(|s| s.largest),
        max_tilt_urad: tilts.iter().map(|tilt| 1e6 * tilt).collect(),
    }
}

fn bearing(load: &BearingLoad) -> BearingSummary<'_> {
    BearingSummary {
        name: &load.name,
        mean_force_n: load.force,
        mean_moment_nmm: load.moment,
        max_tilt_urad: 1e6 * load.tilt,
        rolling: load.rolling.as_ref().map(rolling),
    }
}

fn rolling(load: &RollingLoad) -> RollingSummary {
    let (elements_per_row, element_diameter_mm, element_length_mm, pitch_diameter_mm) = match &load.elements {
        RollingElements::Balls(b) => (b.elements, b.diameter, None, b.pitch_diameter),
        RollingElements::Rollers(r) => (r.elements, r.diameter, Some(r.length), r.pitch_diameter),
    };
    RollingSummary {
        elements_per_row,
        element_diameter_mm,
        element_length_mm,
        pitch_diameter_mm,
        is_estimated: load.is_estimated,
        static_rating_kn: 1e-3 * load.ratings.0,
        dynamic_rating_kn: load.ratings.1.map(|rating| 1e-3 * rating),
        is_rating_estimated: load.is_rating_estimated,
        static_safety: load.static_safety,
        elements: load.count,
        min_loaded_elements: load.loaded[0],
        max_loaded_elements: load.loaded[1],
        load_zone_deg: ElementLoad::zone(&load.zone).to_degrees(),
        element_angles_deg: load.zone.iter().map(|own| own.angle.to_degrees()).collect(),
        element_mean_forces_n: load.zone.iter().map(|own| own.force).collect(),
        max_element_force_n: load.element_force,
        max_hertz_pressure_mpa: load.pressure,
        stiffness_n_mm_rad: load.stiffness,
        spectrum_life_h: load.spectrum_life_h,
        loss_w: load.loss_w,
        life: load.life.map(|life| LifeSummary {
            basic_life_million_turns: life.million_turns,
            basic_life_h: life.hours,
            equivalent_load_n: life.equivalent_load,
            load_over_rating: life.over_rating,
            modified_life_h: life.modified_hours(),
            life_modification_factor: life.modification.map(|own| own.factor),
            viscosity_ratio: life.modification.map(|own| own.viscosity_ratio),
            fatigue_limit_n: life.modification.map(|own| own.fatigue_limit),
        }),
    }
}

fn vibration<'a>(file: &'a Gearbox, (asked, swings): (&GearboxVibration, &VibrationResult)) -> VibrationSummary<'a> {
    let modes = first_modes(swings).iter().map(|mode| ModeSummary {
        frequency_hz: mode.frequency / TAU,
        strain: holders(file, &mode.energy.strain),
        kinetic: holders(file, &mode.energy.kinetic),
    });
    let meshes = mesh_peaks(file, swings).into_iter().enumerate().map(|(i, peak)| MeshVibration {
        name: peak.name,
        mean_mesh_stiffness_n_per_um: 1e-3 * swings.mesh_stiffness[i],
        ste_amplitude_um: swings.transmission_error[i].iter().map(|x| 1e3 * x).collect(),
        largest_dynamic_force_rms_n: peak.force_n,
        at_input_rpm: peak.input_rpm,
    });
    let bearings = bearing_peaks(file, swings).into_iter().map(|peak| BearingVibration {
        name: peak.name,
        largest_housing_force_rms_n: peak.force_n,
        at_input_rpm: peak.input_rpm,
    });
    let gears = file.gears.iter().zip(&swings.gears).zip(&swings.gear_modes).map(|((gear, body), modes)| GearMass {
        elastic_modes: modes.as_ref().map_or(0, |own| own.frequencies_hz.len()),
        highest_elastic_mode_hz: modes.as_ref().and_then(|own| own.frequencies_hz.last().copied()),
        name: &gear.name,
        mass_kg: 1e3 * body.mass,
        transverse_inertia_kg_m2: 1e-3 * body.transverse_inertia,
        polar_inertia_kg_m2: 1e-3 * body.polar_inertia,
    });
    VibrationSummary {
        input_rpm: asked.speeds_rpm,
        damping_ratio: asked.damping_ratio,
        modes: modes.collect(),
        modes_kept: swings.modes_kept,
        modes_up_to_hz: swings.modes_up_to_hz,
        crossings: swings.campbell.diagram.resonances.len(),
        meshes: meshes.collect(),
        bearings: bearings.collect(),
        gears: gears.collect(),
    }
}

fn mesh<'a>(m: &'a MeshResult, pair: &GearPair) -> MeshSummary<'a> {
    MeshSummary {
        name: &m.name,
        eps_gamma: pair.total_contact_ratio(),
        centre_distance_mm: pair.centre_distance(),
        common_face_width_mm: pair.face_width(),
        mid_face_offset_mm: pair.mid_face_offset(),
        slices: m.slices,
        mean_normal_force_n: m.normal_force,
        mean_ste_um: 1e3 * m.transmission_error[0],
        peak_to_peak_ste_um: 1e3 * m.transmission_error[1],
        misalignment_in_plane_um: 1e3 * m.misalignment[0],
        misalignment_across_um: 1e3 * m.misalignment[1],
        face_load_factor: m.face_load_factor,
        max_pressure_mpa: m.max_pressure,
        rating: m.rating.as_ref(),
        timing_deg: m.timing.to_degrees(),
    }
}
