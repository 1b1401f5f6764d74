//! A whole REXS file as a gearbox file with the scenes of its pairs: shafts, bearings, gears, stages and a load case.

use std::{collections::BTreeMap, path::Path};

use super::{
    RexsError, RexsPair,
    document::{Model, parsed, reference},
    frame::placed,
    left::left,
    pair::{case_remark, stages},
    planetary::body_of,
    train::{Train, sides},
    writer::{FROM, Writer},
};
use crate::{SceneError, gearbox::Gearbox};

/// A gearbox from a REXS file: the text of the gearbox file, and the scenes that it names.
#[derive(Debug, Clone)]
pub struct RexsGearbox {
    /// The gearbox file.
    pub text: String,
    /// File name and text of the scene of each stage, and the pair from which it was made.
    pub scenes: Vec<(String, String, RexsPair)>,
    /// Remarks for the user.
    pub remarks: Vec<String>,
}

/// Parts of a kind at the most, as in a gearbox file.
const PARTS: usize = 100;

/// The gearbox of a REXS file under load case `case`, counted from 1. Scenes are named after `stem`. `None` if no stage
/// of the file is on shafts: then it contains only pairs.
///
/// # Errors
/// [`RexsError`] if a part cannot be used, because the result would be a different gearbox.
pub fn read_gearbox(text: &str, stem: &str, case: usize) -> Result<Option<RexsGearbox>, RexsError> {
    let document = parsed(text)?;
    let model = Model::of(&document)?;
    model.choose(case)?;
    let mut train = Train::of(&model)?;
    if train.stages.is_empty() {
        return Ok(None);
    }
    whole(&model, &train)?;
    train.balance();
    let shafts = train.shafts.iter().map(|s| body_of(&model, s)).collect::<Result<Vec<_>, _>>()?;
    let lengths: Vec<f64> = shafts.iter().map(|s| s.sections.iter().map(|x| x[0]).sum()).collect();
    let places = placed(&model, &train.shafts, &lengths)?;
    let mut writer = Writer { model: &model, train, shafts, places, names: BTreeMap::new(), text: String::new() };
    let mut remarks: Vec<String> = case_remark(&model).into_iter().collect();
    writer.head();
    writer.shafts();
    remarks.extend(writer.bearings()?);
    writer.gears()?;
    writer.planets()?;
    let scenes = writer.meshes(stem)?;
    remarks.extend(writer.loads()?);
    let untaken = left(&model);
    if !untaken.is_empty() {
        remarks.push(format!("not taken of the file:\n  {}", untaken.join("\n  ")));
    }
    Ok(Some(RexsGearbox { text: writer.text, scenes, remarks }))
}

/// Checks that the file has nothing which a gearbox file cannot say and without which it would be another gearbox.
fn whole<'a>(model: &Model<'a>, train: &Train<'_, 'a>) -> Result<(), RexsError> {
    let hint = || "take a pair alone with `--stage N`".to_owned();
    let bearings = model.relations("side").count();
    let most = [train.shafts.len(), train.stages.len(), train.loads.len(), bearings].into_iter().max().unwrap_or(0);
    if most > PARTS {
        let what =
            format!("has {most} shafts, bearings, stages or loads: a gearbox file has {PARTS} of a kind at the most");
        return Err(RexsError::Unfit { part: "the file".into(), what, hint: hint() });
    }
    for kind in ["bevel_stage", "worm_stage"] {
        if let Some(part) = model.parts(kind, "stage").next() {
            let what = format!("is a `{kind}`: a gearbox file has stages of cylindrical gears");
            return Err(RexsError::Unfit { part: part.named(), what, hint: hint() });
        }
    }
    for relation in model.relations("side") {
        let is_coupling = ["coupling", "switchable_coupling"].iter().any(|k| model.refers(relation, "assembly", k));
        let sides = sides(relation, train);
        let own = reference(relation, "assembly").and_then(|id| model.part("coupling", id));
        if let Some(part) = own.filter(|_| is_coupling && !sides.is_empty() && train.planetary.is_none()) {
            let what = "is a coupling on a shaft with gears: a gearbox file has none".into();
            return Err(RexsError::Unfit { part: part.named(), what, hint: hint() });
        }
    }
    let copies = train.planetary.as_ref().map(|own| own.pass_over_copies(model)).unwrap_or_default();
    let is_copy = |id: &str| copies.contains(id);
    if let Some(planetary) = &train.planetary {
        let planet = planetary.planets.first().and_then(|own| train.shafts.iter().position(|s| s.id == own.id));
        if let Some(link) = train.stages.iter().find(|link| !link.shafts.iter().any(|s| Some(*s) == planet)) {
            let part =
                link.stage.and_then(|id| model.part("stage", id)).map_or_else(|| "a stage".into(), |p| p.named());
            let what =
                "is beside a planetary stage: parallel shafts do not stand still in the frame of its carrier".into();
            return Err(RexsError::Unfit { part, what, hint: "export the planetary stage alone".into() });
        }
    }
    for (i, relation) in stages(model).into_iter().enumerate() {
        for role in ["gear_1", "gear_2"] {
            let id = reference(relation, role).ok_or(RexsError::Gear { stage: i + 1, role })?;
            let part = model.part("gear", id).ok_or(RexsError::Gear { stage: i + 1, role })?;
            // Gears of the other planets are copies of the first one's.
            if is_copy(id) {
                continue;
            }
            if !train.gears.contains_key(id) {
                return Err(RexsError::Unfit { part: part.named(), what: "is on no shaft".into(), hint: hint() });
            }
        }
    }
    Ok(())
}

impl RexsGearbox {
    /// Checks the texts as the gearbox that will be read from `file`.
    ///
    /// # Errors
    /// [`SceneError`]; [`RexsGearbox::blamed`] gives its cause in the REXS file.
    pub fn check(&self, file: &Path) -> Result<Gearbox, SceneError> {
        let beside: Vec<_> = self.scenes.iter().map(|(name, text, _)| (name.clone(), text.clone())).collect();
        let whole = Gearbox::parse_beside(&self.text, file, &beside)?;
        whole.meshes.iter().try_for_each(|mesh| mesh.scene.gear_pair().map(|_| ()))?;
        Ok(whole)
    }

    /// The error in the REXS file that corresponds to an error in the gearbox file or one of its scenes; `None` if it
    /// concerns no value from the REXS file.
    pub fn blamed(&self, error: &SceneError) -> Option<RexsError> {
        let crate::Place::Line(line) = error.place()? else { return None };
        let name = line.file.file_name()?.to_str()?;
        if let Some((_, text, pair)) = self.scenes.iter().find(|(file, ..)| file == name) {
            return pair.blamed(text, error);
        }
        let lines: Vec<&str> = self.text.lines().take(line.number).collect();
        let part = lines.iter().rev().find_map(|l| l.strip_prefix(FROM))?;
        let hint = error.hint().map_or_else(String::new, |hint| format!(": {hint}"));
        let hint = format!("correct it in the file, or take it out{hint}");
        Some(RexsError::Unfit { part: format!("{part}:"), what: error.without_place(), hint })
    }
}
