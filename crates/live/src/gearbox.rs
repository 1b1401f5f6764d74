//! A gearbox at rest, as the page takes it.

use std::collections::BTreeMap;

use analysis::{
    AnalysisError, Context, GearCache, Interest,
    gearbox::{GearboxResult, MeshResult},
    solve,
};
use answer::shown_units;
use report::{
    charts::{FieldMap, LineChart, contact_pattern_maps},
    gearbox_files::gearbox_charts,
};
use scene::gearbox::Gearbox;

use crate::{fault::Fault, outcome::Outcome, scene_text::flat};

/// A gearbox as it was solved, and the time that took, ms.
pub(crate) struct SolvedGearbox {
    file: Gearbox,
    result: GearboxResult,
    solve_ms: f64,
    /// What the document asks for beside rest, in words.
    left_out: Option<String>,
}

/// Solves a gearbox at rest on the gears that are kept; `None` where nobody waits for it any more.
///
/// # Errors
/// What is wrong with it, or why it has no equilibrium.
pub(crate) fn solved(
    text: &str,
    file: &Gearbox,
    cache: &dyn GearCache,
    mut interest: Interest<'_>,
) -> Result<Option<SolvedGearbox>, Fault> {
    let mut at_rest = file.clone();
    let tasks = [
        ("[vibration]", at_rest.vibration.take().is_some()),
        ("[motion]", at_rest.motion.take().is_some() | at_rest.branch.take().is_some()),
        ("[modes]", at_rest.modes.take().is_some()),
    ];
    let asked: Vec<&str> = tasks.into_iter().filter_map(|(table, is_there)| is_there.then_some(table)).collect();
    let left_out = (!asked.is_empty())
        .then(|| format!("this page shows the gearbox at rest; `ale-gear run` takes {} as well", asked.join(", ")));
    let answered = solve(&at_rest, Context::new(&mut interest).with_cache(cache)).and_then(|ending| ending.finished());
    match answered {
        Ok(result) => Ok(Some(SolvedGearbox { file: at_rest, result, solve_ms: 0.0, left_out })),
        Err(AnalysisError::Cancelled) => Ok(None),
        Err(e) => Err(Fault::of_analysis(text, &e)),
    }
}

/// All keys of the scenes of its meshes, defaults filled in.
pub(crate) fn effective(file: &Gearbox) -> BTreeMap<String, String> {
    let of_mesh = |(i, text): (usize, String)| {
        flat(&text).into_iter().map(move |(key, value)| (format!("mesh.{i}.scene.{key}"), value))
    };
    file.meshes.iter().map(|mesh| mesh.scene.to_toml()).enumerate().flat_map(of_mesh).collect()
}

impl SolvedGearbox {
    /// With the time that its solution took, ms.
    pub fn within(self, solve_ms: f64) -> Self {
        Self { solve_ms, ..self }
    }

    /// What is shown of it.
    pub fn outcome(&self) -> Outcome<'_> {
        let Self { file, result, solve_ms, left_out } = self;
        let remarks = result.remarks.iter().map(|said| shown_units(&said.to_string()));
        let of_mesh = |mesh: &MeshResult| {
            let maps = mesh.patterns.as_ref().map(contact_pattern_maps).into_iter().flatten();
            let named = |map: FieldMap<'static>| FieldMap { title: format!("{}. {}", mesh.name, map.title), ..map };
            maps.map(named).collect::<Vec<_>>()
        };
        let maps = result.meshes.iter().flat_map(of_mesh);
        Outcome {
            name: &file.name,
            solve_ms: *solve_ms,
            headline: result.headline(),
            glance: glance(file, result),
            charts: gearbox_charts(file, result).iter().map(LineChart::plot).collect(),
            maps: maps.collect(),
            view: None,
            remarks: left_out.iter().cloned().chain(remarks).collect(),
        }
    }
}

/// The numbers that a hand follows: the load over the faces first.
fn glance(file: &Gearbox, result: &GearboxResult) -> Vec<[String; 2]> {
    let of_mesh = |mesh: &MeshResult| {
        let factor = mesh.face_load_factor.map(|factor| ("K_Hbeta", format!("{factor:.3}")));
        let others = [
            ("misaligned by", format!("{:.1} um", 1e3 * mesh.misalignment[0])),
            ("peak-to-peak STE", format!("{:.3} um", 1e3 * mesh.transmission_error[1])),
            ("largest pressure", format!("{:.0} MPa", mesh.max_pressure)),
        ];
        let name = mesh.name.clone();
        factor.into_iter().chain(others).map(move |(what, value)| [format!("{name}: {what}"), shown_units(&value)])
    };
    let hardest =
        result.bearings.iter().map(|bearing| (bearing, bearing.force.iter().map(|f| f * f).sum::<f64>().sqrt()));
    let hardest = hardest.max_by(|(_, a), (_, b)| a.total_cmp(b));
    let bearing =
        hardest.map(|(bearing, force)| [format!("largest bearing force ({})", bearing.name), format!("{force:.0} N")]);
    let lag = |(output, own): (&scene::gearbox::GearboxTorque, f64)| {
        [format!("{} lags by", file.shafts[output.shaft].name), shown_units(&format!("{:.1} urad", 1e6 * own))]
    };
    let lags = file.torques.iter().zip(result.outputs.iter().map(|own| own.mean)).map(lag);
    result.meshes.iter().flat_map(of_mesh).chain(bearing).chain(lags).collect()
}
