//! Laws of what `in_motion::flanks` keeps to itself.

use dynamics::{Extremes, ToothChanges};

use super::*;

fn course() -> FlankCourse {
    let extremes = Extremes { least_force: Some(1.0), largest_force: 100.0, ..Extremes::default() };
    FlankCourse { contact_losses: 0, coast_contacts: 0, extremes, changes: ToothChanges::default(), reach: 0.0 }
}

/// Rows on both sides count, with the smaller force; the bound of what they leave out is told beyond a hundredth of the
/// peak to peak, and a gap beyond the backlash where no coast flanks are.
#[test]
fn flanks_without_room_are_told() {
    let scene = Scene::default_scene().unwrap();
    let pair = scene.gear_pair().unwrap();
    let mut both = BothFlanks::default();
    [[100.0, 0.0], [30.0, 50.0], [40.0, 20.0], [0.0, 70.0]].into_iter().for_each(|row| both.push(row));
    let told = |gap: f64, coast: bool, peak_to_peak_um: f64| {
        let extremes = Extremes { largest_gap: gap, ..course().extremes };
        let flanks = FlankCertificate::new(&FlankCourse { extremes, ..course() }, both, 3e5);
        assert_eq!((flanks.rows_on_both_flanks, flanks.flank_coupling_bound_um), (2, 0.1));
        let mesh = MeshInMotion {
            scene: &scene,
            pair: &pair,
            flanks: &flanks,
            has_coast_flanks: coast,
            errors_um: [4.0, 6.0],
            peak_to_peak_um,
            force_n: 100.0,
            pressure_mpa: None,
        };
        mesh.remarks().iter().map(|r| r.code()).collect::<Vec<_>>()
    };
    let beyond = 1.01 * pair.backlash() + 1e-3;
    assert_eq!(told(0.0, true, 11.0), [""; 0]);
    assert_eq!(told(0.0, true, 9.0), ["both_flanks_press"]);
    assert_eq!(told(beyond, true, 11.0), [""; 0]);
    assert_eq!(told(beyond, false, 11.0), ["gap_beyond_backlash"]);
    // Flanks that touch have no gap, whatever the last digits of the backlash say.
    let room = pair.backlash() * pair.base_helix_angle().cos();
    assert_eq!(told(room + 1e-9, false, 11.0), [""; 0]);
}
