//! Facts about a run that the writers need in addition to its scene and history.

use geometry::{GearPair, GeometrySheet};
use scene::Scene;
use serde::Serialize;
use serde_json::{Map, Value};

use crate::{
    AnalysisError,
    accuracy::Accuracy,
    certificate::{self, Checks},
    error::in_scene,
    gears, iso_root,
    loaded_pair::LoadedPair,
    nominal_pressure::{NominalPressure, nominal_pressure},
};
pub use crate::{
    gears::GeometryFacts,
    iso_root::{IsoGearRoot, IsoRootStress},
    resolution::Resolution,
};

described::described! {
    /// What a run was made of and what it cost.
    #[derive(Debug, Clone, Default, Serialize)]
    pub struct RunInfo {
        /// geometry of the pair
        pub geometry: GeometryFacts,
        /// numbers that drawings ask for
        #[serde(skip_serializing_if = "Option::is_none")]
        pub geometry_sheet: Option<GeometrySheet>,
        /// pressure of nominal flanks under the scene's torque
        #[serde(skip_serializing_if = "Option::is_none")]
        pub nominal_pressure: Option<NominalPressure>,
        /// meshes of pinion and wheel; empty for a model without meshes
        pub meshes: Vec<MeshFacts>,
        /// degrees of freedom of pinion and wheel before reduction
        pub dof_before: [usize; 2],
        /// degrees of freedom of pinion and wheel that the analysis carries
        pub dof_after: [usize; 2],
        /// reduction of pinion and wheel: `cyclic sector` or `general`; empty without reduction
        pub reduction: Vec<&'static str>,
        /// teeth of the window at the end
        pub window_teeth: Option<u32>,
        /// contact points of the window, or slices: those of a pair times the pairs
        pub contact_points: Option<usize>,
        /// resolution of contact and meshes along the face; missing for a model without meshes
        #[serde(skip_serializing_if = "Option::is_none")]
        pub resolution: Option<Resolution>,
        /// time from the start of the program to the first solved position
        #[serde(skip_serializing_if = "Option::is_none")]
        pub first_result_s: Option<f64>,
        /// nominal root stress after ISO 6336-3:2019, method B ([theory](theory.md), equation 23a), from the scene's torque, without load factors; missing where the standard has no value
        #[serde(skip_serializing_if = "Option::is_none")]
        pub iso_root_stress: Option<IsoRootStress>,
        /// bounds of the headline numbers, where the scene has `[accuracy]`, and of a pair at rest like those of the calibration
        #[serde(skip_serializing_if = "Option::is_none")]
        pub accuracy: Option<Accuracy>,
        /// what must hold of the result
        #[serde(flatten)]
        pub certificate: Checks,
        /// numbers that only this model has
        #[serde(skip_serializing_if = "serde_json::Map::is_empty")]
        pub model: Map<String, Value>,
    }
}

impl RunInfo {
    /// Facts that follow from the pair and its nominal load alone.
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

    /// Whether the result passes its checks and meets the requested accuracy.
    ///
    /// # Errors
    /// [`AnalysisError::Certificate`]; [`AnalysisError::Refused`] for a result that is less accurate than requested.
    pub fn verdict(&self, scene: &Scene) -> Result<(), AnalysisError> {
        certificate::verdict(&self.certificate, scene)?;
        self.accuracy.as_ref().map_or(Ok(()), Accuracy::verdict).map_err(in_scene(scene))
    }
}

described::described! {
    /// Where a mesh comes from and how large it is.
    #[derive(Debug, Clone, Default, Serialize)]
    pub struct MeshFacts {
        /// file as the scene names it, or `built-in mesher`; and whether a sector was repeated
        pub source: String,
        /// number of nodes; of a repeated sector those of the whole gear
        pub nodes: usize,
        /// number of volume elements; of a repeated sector those of the whole gear
        pub elements: usize,
        /// kinds of elements with their numbers, as `hex8 1200`
        pub kinds: Vec<String>,
    }
}
