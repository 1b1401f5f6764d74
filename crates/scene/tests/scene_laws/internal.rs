//! Scenes of internal pairs.

use std::path::Path;

use scene::{Scene, SceneError};

/// A pinion of 20 teeth in a ring, with more lines of the pinion, the pair and the wheel.
fn read(teeth: &str, pair: &str, wheel: &str) -> Result<Scene, SceneError> {
    let text = format!(
        "[pinion]\nteeth = 20\nhelix_angle_deg = 15.0\nprofile_shift = 0.3\n\n[pair]\nnormal_module_mm = 3.0\n\
         face_width_mm = 15.0\naddendum_coefficient = 0.85\n{pair}\n\n[operation]\ntorque_nm = 100.0\n\n[wheel]\nteeth = {teeth}\n{wheel}\n"
    );
    Scene::parse(&text, Path::new("ring.toml"))
}

/// Negative teeth make a ring of the pinion's hand, with ISO's signs in its geometry, a stated default tool and an outside eight modules above its root; lengths may have the standard's sign or none.
#[test]
fn negative_teeth_make_a_ring() {
    let scene = read("-52", "", "").unwrap_or_else(|e| panic!("{e}"));
    let pair = scene.gear_pair().unwrap_or_else(|e| panic!("{e}"));
    let ring = &pair.wheel;
    assert!(pair.is_internal() && pair.centre_distance() < 0.0);
    assert_eq!(scene.wheel.helix_angle_deg, 15.0);
    assert_eq!(ring.signed_teeth(), -52.0);
    assert!((0.5 * ring.data().bore_diameter - ring.root_radius() + 12.0).abs() < 1e-9);
    let shaper = scene.wheel.shaper.unwrap();
    assert!(shaper.teeth >= 17 && shaper.profile_shift == 0.0 && shaper.tip_rounding_coefficient <= 0.38);
    let distance = -pair.centre_distance();
    let tip = -2.0 * ring.tip_radius();
    for sign in [1.0, -1.0] {
        let same = read(
            "-52",
            &format!("centre_distance_mm = {:?}", sign * distance),
            &format!("tip_diameter_mm = {:?}\nbore_diameter_mm = {:?}", sign * tip, sign * 200.0),
        );
        let other = same.unwrap_or_else(|e| panic!("{e}")).gear_pair().unwrap_or_else(|e| panic!("{e}"));
        assert!((other.centre_distance() - pair.centre_distance()).abs() < 1e-9);
        assert!((other.wheel.tip_radius() - ring.tip_radius()).abs() < 1e-9);
        assert_eq!(other.wheel.data().bore_diameter, -200.0);
    }
    let stated = "[wheel.shaper]\nteeth = 26\nprofile_shift = 0.1\ntip_rounding_coefficient = 0.2";
    let stated = read("-52", "", stated).unwrap_or_else(|e| panic!("{e}"));
    let data = stated.gear_pair().unwrap_or_else(|e| panic!("{e}")).wheel.data().clone();
    let shaper = data.shaper.unwrap();
    assert_eq!((shaper.teeth, shaper.profile_shift, data.root_radius_coefficient), (26, 0.1, 0.2));
}

/// What a ring has not, and what only a ring has, is refused where it stands.
#[test]
fn what_rings_have_not_is_refused() {
    let refused = |scene: Result<Scene, SceneError>, words: &[&str]| {
        let error = match scene {
            Err(error) => error,
            Ok(scene) => scene.gear_pair().map(|_| ()).unwrap_err(),
        };
        let said = format!("{error} {}", error.hint().unwrap_or_default());
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
    };
    refused(read("52", "", "[wheel.shaper]\nteeth = 20"), &["`shaper` makes internal gears"]);
    let bounds = "[accuracy]\nrms_dte = \"10 %\"\n[drive]\nby = \"speed\"\n[analysis]\nkind = \"dynamic\"";
    refused(read("-52", "", bounds), &["\"auto\"", "does not know internal gears in motion"]);
    let reduced = format!("{bounds}\nmodel = \"reduced\"");
    refused(read("-52", "", &reduced), &["bounds", "in motion are those of external pairs"]);
    assert!(read("-52", "", "[accuracy]\nmean_ste = \"1 %\"").unwrap_or_else(|e| panic!("{e}")).is_auto());
    refused(read("-52", "", "[analysis]\nkind = \"dynamic\"\nmodel = \"impact\""), &["does not know internal gears"]);
    refused(read("-4", "", ""), &["5 .. 2000"]);
    refused(read("-52", "", "helix_angle_deg = -15.0"), &["do not mesh"]);
    refused(read("-24", "", ""), &["tip diameter", "base diameter"]);
}

/// What is written of a ring is read as the same ring: with its sign, its tool and its lengths.
#[test]
fn a_ring_is_written_as_it_is_read() {
    for stated in ["", "[wheel.shaper]\nteeth = 26\nprofile_shift = 0.1\ntip_rounding_coefficient = 0.2"] {
        let scene = read("-52", "", stated).unwrap_or_else(|e| panic!("{e}"));
        let text = scene.to_toml();
        assert!(text.contains("teeth = -52"), "{text}");
        let again = Scene::parse(&text, Path::new("ring.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!(again.gear_pair().unwrap(), scene.gear_pair().unwrap());
        assert_eq!(again.number_at("wheel.teeth"), Some(-52.0));
    }
}
