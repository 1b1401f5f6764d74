//! Numbers of slices and face elements of a scene: chosen if it does not give them, judged if it does.

use crate::remark;
use answer::Remark;
use contact::{ContactOptions, Method};
use geometry::GearPair;
use ltca::{SliceCount, SpringErrors, StaticOptions, slice_errors, slices_needed};
use serde::Serialize;

use scene::{Model, Scene, StiffnessFrom};

use crate::{flank_orders::misplaced_orders, loaded_pair::LoadedPair, options, waves::short_waves};

/// Key of the number of slices.
const SLICES: &str = "contact.slices";
/// A stated count is remarked on from this many times on what a chosen one may be off by.
const COARSE: f64 = 2.0;
/// So is a stated number of face elements that is this many times smaller than the chosen one.
const FEW: u32 = 3;

described::described! {
    /// How fine a pair's contact is made along the face, as the summary says it.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct Resolution {
        /// slices over the face width; `null` for contact points
        pub slices: Option<usize>,
        /// whether the program chose them
        pub slices_chosen: bool,
        /// slices that the program would choose
        pub slices_that_would_do: Option<usize>,
        /// error of a row of springs over the same gaps with these slices: of mean, peak to peak, largest line load ([theory](theory.md), equation 21c)
        pub slice_error_percent: Option<[f64; 3]>,
        /// elements along the face of pinion and wheel; `null` for a mesh that was read, and for a rigid gear
        pub face_elements: [Option<u32>; 2],
        /// elements along the face that the program would choose; `null` for a rigid gear
        pub face_elements_that_would_do: [Option<u32>; 2],
    }
}

/// Whether a model cuts contact into slices, or is fed by one that does.
fn is_sliced(scene: &Scene) -> bool {
    let model = scene.analysis.model;
    let feeds = scene.mesh.as_ref().is_some_and(|m| m.stiffness_from == StiffnessFrom::Reduced);
    (model.has_reduced_gears() || matches!(model, Model::Auto | Model::Full | Model::Impact) || feeds)
        && scene.contact.slices.is_some()
}

/// The scene with the slices that its width, load and micro-geometry need, unless the scene gives their number: in its
/// text, or by a value of `contact.slices` that is not the default.
pub fn with_slices(scene: Scene) -> Scene {
    with_slices_by(scene, slices_needed)
}

/// The same by what says how many slices a pair needs.
pub(crate) fn with_slices_by(mut scene: Scene, needed: impl FnOnce(&GearPair, &StaticOptions) -> SliceCount) -> Scene {
    if is_sliced(&scene) && scene.place_of(&[SLICES]).is_none() {
        // A pair that cannot be made is complained about where it is made.
        if let Ok(pair) = scene.gear_pair()
            && scene.contact.slices == Some(ContactOptions::new(&pair).slices as u32)
        {
            scene.contact.slices = Some(needed(&pair, &options(&scene, &pair)).count as u32);
        }
    }
    scene
}

/// Resolution of the contact of a pair that is computed with `options`, with remarks for the user.
pub fn resolution(scene: &Scene, pair: &GearPair, options: &StaticOptions) -> (Resolution, Vec<Remark>) {
    let sliced = options.contact.method == Method::Slice;
    let slices_chosen = sliced && scene.place_of(&[SLICES]).is_none();
    let needed = sliced.then(|| slices_needed(pair, options));
    let errors = needed.map(|needed| {
        if needed.count == options.contact.slices {
            needed.errors
        } else {
            slice_errors(pair, options, options.contact.slices)
        }
    });
    let (face_elements, would_do) = face_elements(scene);
    let mut said = Vec::new();
    if let (Some(needed), Some(errors), false) = (needed, errors, slices_chosen) {
        said.extend(few_slices(options.contact.slices, needed.count, &errors));
    }
    said.extend(few_elements(face_elements, would_do));
    said.extend(waves(scene, pair, options));
    let resolution = Resolution {
        slices: sliced.then_some(options.contact.slices),
        slices_chosen,
        slices_that_would_do: needed.map(|n| n.count),
        slice_error_percent: errors.map(|e| [e.mean, e.swing, e.peak].map(|x| 100.0 * x)),
        face_elements,
        face_elements_that_would_do: would_do,
    };
    (resolution, said)
}

/// What a user should hear of how fine the contact is: of [`resolution`] its words alone, without the cost of what it
/// says of chosen slices.
pub(crate) fn resolution_remarks(scene: &Scene, pair: &GearPair, options: &StaticOptions) -> Vec<Remark> {
    if options.contact.method == Method::Slice && scene.place_of(&[SLICES]).is_some() {
        return resolution(scene, pair, options).1;
    }
    let (face_elements, would_do) = face_elements(scene);
    let mut said = few_elements(face_elements, would_do);
    said.extend(waves(scene, pair, options));
    said
}

/// What a user should hear of waves on the flanks.
fn waves(scene: &Scene, pair: &GearPair, options: &StaticOptions) -> Vec<Remark> {
    let mut said = short_waves(&LoadedPair::of(scene, pair), options);
    if scene.output.flank_orders {
        said.extend(misplaced_orders(scene, pair));
    }
    said
}

/// Elements along the face of pinion and wheel, and how many the program would choose.
fn face_elements(scene: &Scene) -> ([Option<u32>; 2], [Option<u32>; 2]) {
    let elastic = scene.analysis.model != Model::Impact;
    let face_elements = scene.gears().map(|gear| gear.mesher.filter(|_| elastic).map(|m| m.elements_face));
    let would_do = scene.gears().map(|gear| {
        let order = gear.mesher.map_or(2, |m| m.order);
        elastic.then(|| scene.face_elements(gear, order))
    });
    (face_elements, would_do)
}

fn few_elements(face_elements: [Option<u32>; 2], would_do: [Option<u32>; 2]) -> Vec<Remark> {
    let mut said = Vec::new();
    for (i, whose) in ["pinion", "wheel"].into_iter().enumerate() {
        if let (Some(few), Some(enough)) = (face_elements[i], would_do[i])
            && FEW * few < enough
        {
            said.push(remark::few_face_elements(whose, few, enough));
        }
    }
    said
}

fn few_slices(stated: usize, enough: usize, errors: &SpringErrors) -> Option<Remark> {
    (stated < enough && errors.exceed(COARSE)).then(|| too_few_slices(stated, enough, errors))
}

fn too_few_slices(stated: usize, enough: usize, errors: &SpringErrors) -> Remark {
    let [mean, swing, peak] = [errors.mean, errors.swing, errors.peak].map(|x| 100.0 * x);
    remark::few_slices(stated, mean, swing, peak, enough)
}
