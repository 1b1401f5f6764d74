//! Keys by which a static run is differentiated.

use toml::Spanned;

use super::Checked;
use crate::{GearScene, Kind, Method, Model, Scene, SceneError, schema::RawScene, source::Source};

/// Keys at the most: each costs a tenth of the run or so.
const MOST: usize = 100;

/// What has derivatives, and by what.
pub(super) fn check(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    of_flanks(s, raw, scene)?;
    let Some(words) = raw.output.derivatives.as_ref().filter(|list| !list.is_empty()) else { return Ok(()) };
    let refuse = |word: &Spanned<String>, what: &str, advice: &str| Err(s.conflict(&word.span(), what, advice));
    let first = &words[0];
    if words.len() > MOST {
        return refuse(first, &format!("derivatives by {} keys", words.len()), &format!("name {MOST} at the most"));
    }
    if scene.analysis.kind != Kind::Static || scene.analysis.model != Model::Reduced || !scene.accuracy.is_none() {
        let advice = "leave `derivatives` out, or use `kind = \"static\"` and `model = \"reduced\"` without [accuracy]";
        return refuse(first, "no other model than the reduced one at rest has derivatives", advice);
    }
    if scene.contact.method != Method::Slice || scene.operation.torque_nm == 0.0 {
        let advice = "leave `derivatives` out, or use `method = \"slice\"` and a torque above 0";
        return refuse(first, "only loaded contact of slices has derivatives", advice);
    }
    words.iter().try_for_each(|word| of_key(s, scene, word))
}

fn of_key(s: &Source<'_>, scene: &Scene, word: &Spanned<String>) -> Checked<()> {
    let key = word.get_ref();
    let wrong = |what: String, advice: &str| Err(s.conflict(&word.span(), what, advice));
    if !Scene::is_design_key(key) {
        let advice = "name keys of [pinion.modification], [wheel.modification] or [pair.misalignment], with dots";
        return wrong(format!("there is no derivative by `{key}`"), advice);
    }
    let Some(value) = scene.number_at(key) else {
        let advice = "give it a number first: where a relief begins there is one once the relief has its start";
        return wrong(format!("`{key}` has no number in this scene"), advice);
    };
    match scene.with_number(key, value + Scene::design_step(key)) {
        Ok(moved) if moved.pinion == scene.pinion && moved.wheel == scene.wheel && moved.pair == scene.pair => {
            wrong(format!("`{key}` changes nothing"), "name a key of the flanks that the torque presses")
        }
        Ok(_) => Ok(()),
        Err(SceneError::OutOfRange { .. } | SceneError::Geometry { .. }) => Ok(()),
        Err(e) => wrong(format!("there is no derivative by `{key}`: {e}"), "see `derivatives` in docs/scene.md"),
    }
}

/// Where orders have causes on the flanks: they are found by derivatives.
fn of_flanks(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let Some(word) = raw.output.flank_orders.as_ref().filter(|own| *own.get_ref()) else { return Ok(()) };
    let refuse = |what: &str, advice: &str| Err(s.conflict(&word.span(), what, advice));
    let solved = scene.analysis.kind == Kind::Static && scene.analysis.model == Model::Reduced;
    if !solved || !scene.accuracy.is_none() || scene.contact.method != Method::Slice || scene.operation.torque_nm == 0.0
    {
        let advice = "leave it out, or use `kind = \"static\"`, `model = \"reduced\"`, `method = \"slice\"`, a torque above 0 and no [accuracy]";
        return refuse("`flank_orders` needs loaded contact of slices of the reduced model at rest", advice);
    }
    let deviates = |gear: &GearScene| {
        gear.modification.drive.topography.is_some()
            || gear.pitch_errors_file.is_some()
            || !gear.pitch_errors_um.is_empty()
    };
    if ![&scene.pinion, &scene.wheel].into_iter().any(deviates) {
        let what = "`flank_orders` needs flanks or teeth that deviate: no gear has a topography or pitch errors";
        return refuse(what, "name a `topography` or `pitch_errors_file`, or leave `flank_orders` out");
    }
    Ok(())
}
