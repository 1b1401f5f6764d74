//! Rejects scenes that no real gear pair corresponds to, before the solution, and names the unit that was probably
//! intended.

use answer::digits;
use geometry::GearPair;
use scene::{GearScene, Scene, units::in_another_unit};

use super::{
    estimate::LoadEstimate,
    flanks::tip_left,
    limits::{DEFLECTION_BOUND, PRESSURE_BOUND},
};
use crate::{AnalysisError, error::place_in, loaded_pair::LoadedPair, refused::Refusal};

/// Deflection in modules that is refused before the work, thrice that which fails after it: an estimate is no result.
const MODULES: f64 = 1.0;
/// Pressure over E* likewise.
const PRESSURE: f64 = 0.5;
/// Deflection in modules, and pressure over E*, of a scene that makes sense.
const USUAL: [f64; 2] = [0.1, 0.05];

/// Consequence of an impossible scene, and its likely cause.
#[derive(Debug, Clone, PartialEq)]
pub struct Beyond {
    /// Keys that may be wrong, the most likely first.
    pub keys: Vec<String>,
    /// Consequence of the value.
    pub said: String,
    /// Hint: what to write instead.
    pub hint: String,
    /// Whether the torque was probably given in N mm.
    pub in_n_mm: bool,
}

/// Rejects a pair whose load deflects teeth by their own size, whose micro-geometry leaves no tooth, or with bolts that open.
///
/// # Errors
/// [`AnalysisError::Refused`] at the key that is probably wrong.
pub fn refuse(scene: &Scene, pair: &GearPair) -> Result<(), AnalysisError> {
    let opens = |gear: &GearScene| gear.bore.bolts.is_some_and(|bolts| bolts.opens);
    if let Some((whose, _)) = ["pinion", "wheel"].into_iter().zip(scene.gears()).find(|(_, gear)| opens(gear)) {
        let what = format!("the bolts of the {whose} open, and a pair by itself has no such bolts");
        let hint = "run a gearbox with this pair as a `[[mesh]]`, or leave `opens` and `preload_n` out";
        return Err(AnalysisError::from(Refusal::input(what, hint))
            .at(place_in(scene, &[&format!("{whose}.bore.bolts.opens")])));
    }
    let Some(found) = no_tip(scene, pair).or_else(|| beyond(scene, pair)) else { return Ok(()) };
    let keys: Vec<&str> = found.keys.iter().map(String::as_str).collect();
    Err(AnalysisError::from(Refusal::input(found.said, found.hint)).at(place_in(scene, &keys)))
}

/// A load that deflects the teeth by their own size; `None` if it does not.
pub fn beyond(scene: &Scene, pair: &GearPair) -> Option<Beyond> {
    above(scene, pair, [MODULES, PRESSURE])
}

/// A load whose result is likely to fail its checks of size, in words; `None` of others and of those that are refused.
pub(super) fn doubtful(scene: &Scene, pair: &GearPair) -> Option<answer::Remark> {
    let found = above(scene, pair, [DEFLECTION_BOUND, PRESSURE_BOUND])?;
    let Beyond { said, hint, .. } = found;
    beyond(scene, pair).is_none().then(|| crate::remark::doubtful_load(said, DEFLECTION_BOUND, hint))
}

/// A load that bends the teeth by more modules, or presses them with more times E*, than these.
fn above(scene: &Scene, pair: &GearPair, [modules, pressure]: [f64; 2]) -> Option<Beyond> {
    let found = LoadEstimate::of(&LoadedPair::of(scene, pair));
    if found.modules <= modules && found.pressure_over_modulus <= pressure {
        return None;
    }
    let said = format!(
        "{} N m would bend the teeth by {}, {} modules, and press them with {} times their modulus (ISO 6336-1 and Hertz)",
        digits(scene.operation.torque_nm),
        length(found.deflection_mm),
        digits(found.modules),
        digits(found.pressure_over_modulus),
    );
    let causes = [modulus(scene), width(scene), torque(scene)];
    let cured = causes.into_iter().flatten().find(|cause| cause.cures());
    Some(match cured {
        Some(Cause { keys, hint, in_n_mm, .. }) => Beyond { keys, said, hint, in_n_mm },
        None => {
            let fit = scene.operation.torque_nm * usual_share(&found);
            let hint = format!(
                "at {} N m the teeth of this pair would bend by a tenth of a module or less: lower `torque_nm`, or look at \
                 module, face width and `young_mpa`",
                digits(fit)
            );
            Beyond { keys: vec!["operation.torque_nm".to_owned()], said, hint, in_n_mm: false }
        }
    })
}

/// What may have been meant.
struct Cause {
    keys: Vec<String>,
    hint: String,
    in_n_mm: bool,
    /// The scene as it was meant.
    scene: Scene,
}

impl Cause {
    /// Whether the scene makes sense this way.
    fn cures(&self) -> bool {
        let Ok(pair) = self.scene.gear_pair() else { return false };
        let found = LoadEstimate::of(&LoadedPair::of(&self.scene, &pair));
        found.modules < USUAL[0] && found.pressure_over_modulus < USUAL[1]
    }
}

/// Moduli in GPa.
fn modulus(scene: &Scene) -> Option<Cause> {
    let mut meant = scene.clone();
    let (mut keys, mut said) = (Vec::new(), None);
    for (table, gear) in [("pinion", &mut meant.pinion), ("wheel", &mut meant.wheel)] {
        let own = gear.material.young_mpa;
        // Between that of soft plastics and of tungsten in GPa.
        let Some(other) = in_another_unit("young_mpa", own, |x| (1e3..1e6).contains(&x)).filter(|_| own < 1e3) else {
            continue;
        };
        gear.material.young_mpa = other.value;
        keys.push(format!("{table}.material.young_mpa"));
        said.get_or_insert(other);
    }
    let said = said?;
    keys.push("material.young_mpa".to_owned());
    let hint = format!("{}: write `young_mpa = {}`", said.said, said.value);
    Some(Cause { keys, hint, in_n_mm: false, scene: meant })
}

/// A face width in m.
fn width(scene: &Scene) -> Option<Cause> {
    let mut meant = scene.clone();
    let module = scene.pair.normal_module_mm;
    let other = in_another_unit("face_width_mm", scene.pair.face_width_mm, |x| (module..100.0 * module).contains(&x))?;
    meant.pair.face_width_mm = other.value;
    for gear in [&mut meant.pinion, &mut meant.wheel] {
        gear.face_width_mm = gear.face_width_mm.map(|_| other.value);
    }
    let keys = ["pair.face_width_mm", "pinion.face_width_mm", "wheel.face_width_mm"].map(str::to_owned).to_vec();
    let hint = format!("{}: write `face_width_mm = {}`", other.said, other.value);
    Some(Cause { keys, hint, in_n_mm: false, scene: meant })
}

/// A torque in N mm.
fn torque(scene: &Scene) -> Option<Cause> {
    let mut meant = scene.clone();
    let other = in_another_unit("torque_nm", scene.operation.torque_nm, |x| x > 0.0)?;
    meant.operation.torque_nm = other.value;
    let hint = format!("{}: write `torque_nm = {}`", other.said, other.value);
    Some(Cause { keys: vec!["operation.torque_nm".to_owned()], hint, in_n_mm: true, scene: meant })
}

/// Share of the load that bends and presses the teeth as usual: pressure goes with its root.
fn usual_share(found: &LoadEstimate) -> f64 {
    (USUAL[0] / found.modules).min((USUAL[1] / found.pressure_over_modulus).powi(2))
}

/// Micro-geometry that leaves no tip.
fn no_tip(scene: &Scene, pair: &GearPair) -> Option<Beyond> {
    let gears = [("pinion", &scene.pinion, &pair.pinion), ("wheel", &scene.wheel, &pair.wheel)];
    let (table, gear, _) = gears.into_iter().find(|(_, _, exact)| tip_left(exact) <= 0.0)?;
    let amounts = [gear.modification.drive.largest_amount(), gear.modification.coast.largest_amount()];
    let (key, amount) = amounts.into_iter().flatten().reduce(|a, b| if b.1.abs() > a.1.abs() { b } else { a })?;
    let places = ["modification.drive", "modification.coast", "modification"];
    let keys = places.map(|place| format!("{table}.{place}.{key}")).to_vec();
    let usual = 20.0 * scene.pair.normal_module_mm;
    Some(Beyond {
        keys,
        said: format!("{} um off both flanks of the {table} leave nothing of its tips", digits(amount)),
        hint: format!("amounts are in um; some {} um are usual at this module", digits(usual)),
        in_n_mm: false,
    })
}

/// A length with its unit.
fn length(mm: f64) -> String {
    if mm < 1.0 { format!("{} um", digits(1e3 * mm)) } else { format!("{} mm", digits(mm)) }
}
