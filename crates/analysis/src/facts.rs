//! What the writers need to know of a run beside its scene and its history.

use geometry::{GearPair, GeometrySheet};
use scene::Scene;
use serde::Serialize;

use crate::{
    AnalysisError,
    accuracy::Accuracy,
    certificate::{self, Checks},
    error::in_scene,
    gears, iso_root,
    loaded_pair::LoadedPair,
    nominal_pressure::{NominalPressure, nominal_pressure},
    refused::{Blame, Refusal},
};
pub use crate::{
    gears::GeometryFacts,
    iso_root::{IsoGearRoot, IsoRootStress},
    resolution::Resolution,
};

/// What a run was made of and what it cost.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Facts {
    /// Geometry of the pair.
    pub geometry: GeometryFacts,
    /// What a geometry sheet says of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub geometry_sheet: Option<GeometrySheet>,
    /// Nominal pressure of its flanks under the scene's torque.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nominal_pressure: Option<NominalPressure>,
    /// Meshes of pinion and wheel; empty for a model without meshes.
    pub meshes: Vec<MeshFacts>,
    /// Degrees of freedom of pinion and wheel before reduction.
    pub dof_before: [usize; 2],
    /// Degrees of freedom of pinion and wheel that the analysis carries.
    pub dof_after: [usize; 2],
    /// Which way pinion and wheel were condensed: `cyclic sector` or `general`; empty for a model without reduction.
    pub reduction: Vec<&'static str>,
    /// Teeth in the window at the end.
    pub window_teeth: Option<u32>,
    /// Contact points of the window.
    pub contact_points: Option<usize>,
    /// How fine contact and meshes are along the face; `None` for a model without meshes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<Resolution>,
    /// Wall time from the start of the program to the first solved position, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_result_s: Option<f64>,
    /// Nominal root stress after ISO 6336-3; `None` where the standard has no value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iso_root_stress: Option<IsoRootStress>,
    /// How exact the headline numbers are; `None` where nothing was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Accuracy>,
    /// What must hold of the result.
    #[serde(flatten)]
    pub certificate: Checks,
    /// What only one model knows, by key with unit.
    #[serde(skip_serializing_if = "serde_json::Map::is_empty")]
    pub model: serde_json::Map<String, serde_json::Value>,
}

impl Facts {
    /// What follows from the pair and its nominal load alone.
    pub fn of_pair(scene: &Scene, pair: &GearPair) -> Self {
        let loaded = LoadedPair::of(scene, pair);
        Self {
            geometry: gears::geometry_facts(pair),
            geometry_sheet: Some(pair.sheet()),
            nominal_pressure: Some(nominal_pressure(&loaded)),
            iso_root_stress: iso_root::root_stress(&loaded).ok(),
            ..Self::default()
        }
    }

    /// Whether the result holds and is as exact as was asked.
    ///
    /// # Errors
    /// [`AnalysisError::Certificate`]; [`AnalysisError::Refused`] of a result less exact than asked.
    pub fn verdict(&self, scene: &Scene) -> Result<(), AnalysisError> {
        certificate::verdict(&self.certificate, scene)?;
        let missed = self.accuracy.iter().flat_map(Accuracy::missed);
        let missed: Vec<String> = missed.map(|b| format!("{} is {}", b.quantity.key(), b.words())).collect();
        if missed.is_empty() {
            return Ok(());
        }
        let what = format!("the accuracy asked for is not kept: {}", missed.join(", "));
        let hint = Some("ask for less, or see `accuracy` in summary.json for what the bounds are made of".to_owned());
        Err(in_scene(scene)(Refusal { what, hint, blame: Blame::Inexact }))
    }
}

/// Where a mesh comes from and how large it is.
#[derive(Debug, Clone, Default, Serialize)]
pub struct MeshFacts {
    /// File as the scene names it, or `built-in mesher`; and whether a sector was repeated.
    pub source: String,
    /// Number of nodes; of a repeated sector, those of the whole gear, as with the elements.
    pub nodes: usize,
    /// Number of volume elements.
    pub elements: usize,
    /// Kinds of elements with their numbers, as `hex8 1200`.
    pub kinds: Vec<String>,
}
