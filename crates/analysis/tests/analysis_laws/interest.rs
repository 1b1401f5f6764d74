//! Who loses interest in a scene gets nothing, soon; who comes next gets what a fresh start gives.

use std::sync::atomic::{AtomicUsize, Ordering};

use analysis::{
    AnalysisError, Interest, NoCache, RemarksAtRest, RestRequest, SharedGears, SharedModels, solve_at_rest,
};
use ltca::StaticHistory;
use scene::Scene;

fn small(more: &str) -> Scene {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let text = format!(
        "[pinion]\nteeth = 30\nhelix_angle_deg = 20.0\n{mesher}[wheel]\nteeth = 31\n{mesher}[pair]\nnormal_module_mm = 3.0\n\
         face_width_mm = 20.0\n[operation]\ntorque_nm = 150.0\n[analysis]\npositions_per_cycle = 4\n{more}"
    );
    Scene::parse(&text, "a.toml".as_ref()).unwrap()
}

/// Interest in the gears that is lost after so many questions, and how many there were.
fn lost_after(models: &SharedModels<'_>, scene: &Scene, questions: usize) -> (bool, usize) {
    let asked = AtomicUsize::new(0);
    let gears = || asked.fetch_add(1, Ordering::SeqCst) < questions;
    let interest = Interest { gears: &gears, positions: &|| true };
    let solved = match solve_at_rest(
        scene,
        models,
        RestRequest { interest, ..RestRequest::to_the_end(RemarksAtRest::Collected) },
    ) {
        Ok(_) => true,
        Err(AnalysisError::Cancelled) => false,
        Err(e) => panic!("{e}"),
    };
    (solved, asked.into_inner())
}

fn to_the_end(models: &SharedModels<'_>, scene: &Scene) -> StaticHistory {
    solve_at_rest(scene, models, RestRequest::to_the_end(RemarksAtRest::Skipped)).unwrap().history
}

/// By the sector and by one factor of the whole gear.
#[test]
fn a_reduction_ends_at_the_step_at_which_nobody_wants_it() {
    for way in ["", "reduction = \"general\"\n"] {
        let scene = small(way);
        let (fresh, all) = lost_after(&SharedModels::new(&NoCache), &scene, usize::MAX);
        assert!(fresh && all >= 6, "{all} questions in a reduction {way:?}");
        let wanted = to_the_end(&SharedModels::new(&NoCache), &scene);
        for questions in 0..all {
            let models = SharedModels::new(&NoCache);
            let (solved, asked) = lost_after(&models, &scene, questions);
            assert!(!solved, "solved all the same after {questions} of {all} questions");
            // Pinion and wheel are reduced side by side: each may ask once more.
            assert!(asked <= questions + 2, "{asked} questions, {questions} were answered with yes");
            if questions % 5 == 0 {
                let again = to_the_end(&models, &scene);
                assert_eq!(again.positions, wanted.positions, "after {questions} questions");
            }
        }
        let models = SharedModels::new(&NoCache);
        models.reduce(&scene).unwrap();
        assert_eq!(lost_after(&models, &scene, 0), (true, 0), "gears that are there ask nobody");
    }
}

#[test]
fn scenes_on_the_same_gears_are_alike() {
    let of = |text: &str| SharedGears::of(&small(text));
    assert_eq!(of(""), of("[contact]\nfriction = 0.05\n[pair.misalignment]\nin_plane_of_action_um = 3.0\n"));
    assert_eq!(of(""), of("[contact]\nslices = 24\n"));
    assert_ne!(of(""), of("reduction = \"general\"\n"));
    assert_ne!(of(""), of("model = \"iso\"\n"));
}
