//! Stiffness and error over the mesh cycle: given, from the reduced model of the same scene, or from ISO 6336.
//!
//! Scenes and files count a mesh cycle like the reduced model: pair 0 is in the middle of its path at phase 1/2. Lumped
//! pairs have it there at phase 0, so their contact lines are shifted by half a cycle.

use answer::Remark;
use std::sync::Arc;

use ::lumped::{Fourier, LumpedError, MeshCycle, PlaneOfAction};
use geometry::GearPair;
use ltca::StaticPosition;
use scene::{
    AccuracyScene, Analysis, BearingScene, ContactScene, Flanks, GearScene, Kind, Law, MeshScene, Model, Operation,
    OutputScene, Reduction, Scene, StiffnessFrom,
};

use super::elastic_pair::ElasticPair;
use crate::{
    AnalysisError, GearCache, NoSink, Observer, contact_maps::without_speed, error::in_scene, iso_model,
    loaded_pair::LoadedPair, static_certificate, statics::CycleAnalysis,
};

/// Stiffness and error over the mesh cycle in the phase of scenes, with remarks of their making.
#[derive(Debug, Clone)]
pub(crate) struct MeshExcitation {
    pub cycle: MeshCycle,
    pub remarks: Vec<Remark>,
}

/// Makes the excitation of scene after scene.
pub(crate) struct ExcitationSource<'a> {
    observer: &'a mut dyn Observer,
    cache: &'a dyn GearCache,
    /// What the reduced model gave last, by the scene that it was solved for: scenes that differ in speed only share
    /// it.
    last: Option<(Scene, MeshExcitation)>,
    /// Gears that are elastic in motion, as they were made last, by the scene that they were made for.
    last_pair: Option<(Scene, Arc<ElasticPair>)>,
}

impl<'a> ExcitationSource<'a> {
    pub fn new(observer: &'a mut dyn Observer, cache: &'a dyn GearCache) -> Self {
        Self { observer, cache, last: None, last_pair: None }
    }

    /// The cycle of a scene, on the transverse line of action.
    ///
    /// # Errors
    /// [`AnalysisError::Lumped`] if ISO 6336-1 does not cover the pair; the errors of the reduced model.
    pub fn of(
        &mut self,
        scene: &Scene,
        mesh: &MeshScene,
        pair: &GearPair,
        plane: &PlaneOfAction,
    ) -> Result<MeshExcitation, AnalysisError> {
        let complain = in_scene::<LumpedError>(scene);
        let [cosine, sine] = mesh.error();
        let error = Fourier { mean: 0.0, cosine, sine };
        match mesh.stiffness_from {
            StiffnessFrom::Series => {
                let along_normal = Fourier {
                    mean: mesh.stiffness_n_per_um.unwrap_or(0.0),
                    cosine: mesh.stiffness_cos_n_per_um.clone(),
                    sine: mesh.stiffness_sin_n_per_um.clone(),
                };
                let stiffness = along_normal.scaled(1e3 * projection(scene, pair));
                Ok(MeshExcitation { cycle: MeshCycle::new(stiffness, error), remarks: Vec::new() })
            }
            StiffnessFrom::Iso => {
                let loaded = LoadedPair::of(scene, pair);
                let iso = loaded.iso_stiffness().map_err(complain)?;
                let bodies: f64 = iso_model::bodies(&loaded).iter().sum();
                let mean = 1.0 / (1.0 / (1e3 * iso.c_mesh * pair.face_width()) + bodies);
                let own = MeshCycle::by_contact_lines(plane, mean).map_err(complain)?;
                Ok(MeshExcitation { cycle: MeshCycle { error, ..half_a_cycle_on(&own) }, remarks: Vec::new() })
            }
            StiffnessFrom::Reduced => self.of_reduced_model(scene, pair),
        }
    }

    /// The reduced gears of a scene, with a map of their contact if the model uses one.
    ///
    /// # Errors
    /// The errors of the reduced gears and of the map.
    pub fn elastic_pair(&mut self, scene: &Scene) -> Result<Arc<ElasticPair>, AnalysisError> {
        let same = without_speed(scene);
        if let Some((_, gears)) = self.last_pair.as_ref().filter(|(known, _)| *known == same) {
            return Ok(Arc::clone(gears));
        }
        let gears = Arc::new(ElasticPair::make(scene, self.cache, self.observer)?);
        self.last_pair = Some((same, Arc::clone(&gears)));
        Ok(gears)
    }

    /// Tangent stiffness and transmission error of the quasi-static cycle.
    fn of_reduced_model(&mut self, scene: &Scene, pair: &GearPair) -> Result<MeshExcitation, AnalysisError> {
        let at_rest = static_scene(scene);
        if let Some((_, excitation)) = self.last.as_ref().filter(|(known, _)| *known == at_rest) {
            return Ok(excitation.clone());
        }
        let solved = CycleAnalysis::new(&at_rest)
            .with_slices_of_scene()
            .with_cache(self.cache)
            .solve_into(self.observer, &mut NoSink)?;
        // Nothing is fed by what does not hold.
        crate::certificate::verdict(&static_certificate(scene, &solved.history.positions), scene)?;
        let column = |f: fn(&StaticPosition) -> f64| solved.history.positions.iter().map(f).collect::<Vec<f64>>();
        let cycle = MeshCycle::fed(
            &column(|p| p.tangent_stiffness),
            &column(|p| p.contact_line_length),
            &column(|p| p.transmission_error),
            LoadedPair::of(scene, pair).base_force(),
        )
        .map_err(in_scene(scene))?;
        let excitation = MeshExcitation { cycle, remarks: solved.history.remarks };
        self.last = Some((at_rest, excitation.clone()));
        Ok(excitation)
    }
}

/// k on the transverse line of action over K_n along the normal: cos^2 b_b, or cos b_b where a law projects the
/// stiffness alone.
fn projection(scene: &Scene, pair: &GearPair) -> f64 {
    let cos = pair.base_helix_angle().cos();
    match scene.lumped8 {
        Some(lumped8) if lumped8.law == Law::Projected => cos,
        _ => cos * cos,
    }
}

/// Scene of a quasi-static analysis of the reduced model: friction is the cheaper model's own.
pub(crate) fn static_scene(scene: &Scene) -> Scene {
    let without_body =
        |gear: &GearScene| GearScene { body: None, bearing: BearingScene::default(), shaft: None, ..gear.clone() };
    Scene {
        pinion: without_body(&scene.pinion),
        wheel: without_body(&scene.wheel),
        // As speed goes to zero, whatever it is.
        operation: Operation { speed_rpm: 1000.0, ..scene.operation },
        set: Vec::new(),
        contact: ContactScene { friction: 0.0, flanks: Flanks::Driving, ..scene.contact },
        drive: None,
        load: None,
        motion: None,
        accuracy: AccuracyScene::default(),
        modes: None,
        mesh: None,
        lumped8: None,
        lumped12: None,
        shaft18: None,
        analysis: Analysis {
            kind: Kind::Static,
            model: Model::Reduced,
            reduction: Some(Reduction::Auto),
            cycles: 1,
            ..scene.analysis
        },
        output: OutputScene { root_stress: false, contact_lines: false, vtu: false, ..scene.output.clone() },
        ..scene.clone()
    }
}

/// From the phase of scenes to that of lumped pairs, or back: odd orders change sign.
pub(super) fn half_a_cycle_on(cycle: &MeshCycle) -> MeshCycle {
    let turned =
        |list: &[f64]| -> Vec<f64> { list.iter().enumerate().map(|(i, x)| if i % 2 == 0 { -x } else { *x }).collect() };
    let on = |f: &Fourier| Fourier { mean: f.mean, cosine: turned(&f.cosine), sine: turned(&f.sine) };
    MeshCycle { stiffness: on(&cycle.stiffness), error: on(&cycle.error), length: cycle.length.as_ref().map(on) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// f(phi + pi), and twice is where it was.
    #[test]
    fn half_a_cycle_is_half_a_turn_of_the_angle() {
        let f = Fourier { mean: 2.0, cosine: vec![0.3, 0.1, -0.2], sine: vec![0.4, -0.5] };
        let cycle = MeshCycle { stiffness: f.clone(), error: f.clone(), length: Some(f.clone()) };
        let on = half_a_cycle_on(&cycle);
        for k in 0..7 {
            let phi = 0.9 * f64::from(k);
            let off = (on.stiffness.at(phi) - f.at(phi + std::f64::consts::PI)).abs();
            assert!(off < 1e-14, "off by {off} at {phi} rad");
        }
        assert_eq!(half_a_cycle_on(&on), cycle);
    }
}
