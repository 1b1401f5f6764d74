//! Which gear a scene calls pinion is a name: with both exchanged every model has the same answer.

use analysis::{StaticAnalysis, lumped::LumpedAnalysis, motion::MotionAnalysis, results::static_headline};
use scene::{Scene, SceneBuilder};

/// What belongs to a gear, whatever it is called.
struct GearOf {
    teeth: u32,
    shift: f64,
    allowance_mm: f64,
    crowning_um: f64,
    bearing: f64,
}

const SMALL: GearOf = GearOf { teeth: 18, shift: 0.3, allowance_mm: 0.05, crowning_um: 3.0, bearing: 1e5 };
const LARGE: GearOf = GearOf { teeth: 31, shift: -0.1, allowance_mm: 0.04, crowning_um: 0.0, bearing: 2e5 };

/// The pair with its small gear driving, which is the pinion, or with exchanged names the wheel. Seen along the same
/// axis it turns the same way.
fn pair(exchanged: bool) -> SceneBuilder {
    let [first, second] = if exchanged { [LARGE, SMALL] } else { [SMALL, LARGE] };
    let helix = if exchanged { -14.0 } else { 14.0 };
    let base = Scene::builder().pinion(first.teeth, helix).wheel(second.teeth).normal_module_mm(2.5);
    let mut scene = base.face_width_mm(15.0).torque_nm(100.0).set("operation.speed_rpm", 1500.0);
    if exchanged {
        scene = scene.set("operation.driver", "wheel").set("operation.rotation", "cw");
    }
    for (name, gear) in [("pinion", &first), ("wheel", &second)] {
        scene = scene.set(&format!("{name}.profile_shift"), gear.shift);
        scene = scene.set(&format!("{name}.thickness_allowance_mm"), gear.allowance_mm);
    }
    scene
}

/// With meshes, and crowning of the small gear.
fn meshed(exchanged: bool) -> SceneBuilder {
    let mut scene = pair(exchanged).set("contact.slices", 24).set("analysis.positions_per_cycle", 8);
    for (name, gear) in [("pinion", exchanged), ("wheel", !exchanged)].map(|(n, e)| (n, if e { LARGE } else { SMALL }))
    {
        let counts = [("order", 1), ("elements_profile", 3), ("elements_fillet", 2), ("elements_thickness", 2)];
        for (key, value) in counts.iter().chain(&[("elements_face", 4), ("elements_rim", 2)]) {
            scene = scene.set(&format!("{name}.mesher.{key}"), *value);
        }
        scene = scene.set(&format!("{name}.modification.lead_crowning_um"), gear.crowning_um);
    }
    scene
}

/// In motion.
fn moving(scene: SceneBuilder, model: &str) -> Scene {
    let steady = scene.set("analysis.kind", "dynamic").set("analysis.model", model).set("motion.run", "steady");
    let steps = steady.set("motion.steps_per_mesh_cycle", 32).set("motion.warm_up_cycles", 200);
    built(steps.set("motion.periodic_tolerance", 1e-4))
}

fn built(scene: SceneBuilder) -> Scene {
    scene.build().unwrap_or_else(|e| panic!("{e}"))
}

/// Largest relative difference of both columns of numbers.
fn apart<const N: usize>(model: &str, of: impl Fn(bool) -> [f64; N], allowed: f64) {
    let [as_named, exchanged] = [of(false), of(true)];
    for (i, (a, b)) in as_named.iter().zip(&exchanged).enumerate() {
        assert!((a / b - 1.0).abs() < allowed, "{model}, number {i}: {a}, with exchanged names {b}");
    }
}

fn at_rest(scene: &Scene) -> [f64; 4] {
    let history = StaticAnalysis::new(scene).solve().unwrap_or_else(|e| panic!("{e}")).history;
    let h = static_headline(scene, &history).unwrap();
    [h.mean_ste_um, h.peak_to_peak_ste_um, h.mean_normal_force_n, h.max_pressure_mpa]
}

/// Closed forms to round-off.
#[test]
fn closed_forms_have_no_names() {
    apart("iso", |e| at_rest(&built(pair(e).set("analysis.model", "iso"))), 1e-10);
    let sheet = |e| {
        let pair = built(pair(e)).gear_pair().unwrap();
        let s = pair.sheet();
        [s.tooth_loss_factor, s.eps_alpha, s.radial_backlash_mm]
    };
    apart("geometry sheet", sheet, 1e-12);
    let nominal = |e| {
        let scene = built(pair(e));
        let pressure = analysis::facts::RunInfo::of_pair(&scene, &scene.gear_pair().unwrap()).nominal_pressure.unwrap();
        [pressure.iso_contact_stress_mpa, pressure.normal_force_n]
    };
    apart("ISO 6336-2", nominal, 1e-12);
}

/// Elastic gears: the flanks are cut into slices at heights of the pinion, so that names change what is between them: a
/// few 1e-5 of the mean, 2e-4 of what it varies by.
#[test]
fn elastic_gears_have_no_names() {
    for flanks in ["driving", "both"] {
        apart(&format!("reduced, {flanks}"), |e| at_rest(&built(meshed(e).set("contact.flanks", flanks))), 3e-4);
    }
    apart(
        "full",
        |e| at_rest(&built(meshed(e).set("analysis.model", "full").set("analysis.positions_per_cycle", 2))),
        3e-4,
    );
    let reduced = |e| {
        let scene = moving(meshed(e).set("motion.mesh_damping_ratio", 0.08), "reduced");
        let h = MotionAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{e}")).headline;
        [h.mean_dte_um, h.peak_to_peak_dte_um, h.mean_ste_um]
    };
    apart("reduced in motion", reduced, 1e-3);
}

fn lumped(scene: &Scene) -> [f64; 3] {
    let h = LumpedAnalysis::new(scene).solve().unwrap_or_else(|e| panic!("{e}")).headline;
    [h.mean_dte_um, h.peak_to_peak_dte_um, h.mean_ste_um.unwrap()]
}

/// Models with few coordinates: rigid flanks are searched from the pinion's, maps are good to some 1e-4 of the deflection,
/// the others are formulas.
#[test]
fn models_with_few_coordinates_have_no_names() {
    apart("mapped", |e| lumped(&moving(meshed(e).set("motion.mesh_damping_ratio", 0.08), "mapped")), 2e-3);
    apart("impact", |e| lumped(&moving(pair(e).set("contact.slices", 24), "impact")), 2e-3);
    let formula = |e: bool, model: &str| {
        let mut scene = pair(e).set("mesh.stiffness_from", "iso").set("motion.method", "energy");
        for (name, gear) in [("pinion", e), ("wheel", !e)].map(|(n, l)| (n, if l { LARGE } else { SMALL })) {
            for (axis, share) in [("x", 1.0), ("y", 1.3), ("z", 0.7)] {
                scene = scene.set(&format!("{name}.bearing.stiffness_{axis}_n_per_mm"), share * gear.bearing);
            }
            if model == "lumped12" {
                for axis in ["rx", "ry"] {
                    scene = scene.set(&format!("{name}.bearing.stiffness_{axis}_nmm_per_rad"), 2e3 * gear.bearing);
                }
            }
        }
        let damped = if model == "lumped8" { scene.set("motion.mesh_damping_ratio", 0.06) } else { scene };
        lumped(&moving(damped, model))
    };
    for model in ["lumped8", "lumped12"] {
        apart(model, |e| formula(e, model), 1e-6);
    }
}
