//! Gears of two face widths and mid-faces at two heights.

use geometry::{Gear, GearData, GearPair, GeometryError, Side};

fn pair(beta_deg: f64, widths: [f64; 2]) -> GearPair {
    let gear = |i: usize| {
        let helix = if i == 0 { beta_deg } else { -beta_deg };
        Gear::new(GearData {
            teeth: [13, 41][i],
            helix_angle: helix.to_radians(),
            face_width: widths[i],
            profile_shift: [0.4, -0.2][i],
            bore_diameter: 10.0,
            ..GearData::default()
        })
        .unwrap()
    };
    GearPair::new(gear(0), gear(1), None).unwrap()
}

/// An offset moves end faces and no teeth: contact lines are those of a long wheel, cut at the common face, and the
/// wheel's teeth stand at every height where they stood.
#[test]
fn an_offset_cuts_the_wheel_to_other_end_faces() {
    for beta in [-35.0, 15.0] {
        let long = pair(beta, [26.0, 80.0]);
        for offset in [-11.0, 0.5, 7.25] {
            let cut = pair(beta, [26.0, 20.0]).with_mid_face_offset(offset).unwrap();
            let [low, high] = cut.common_face();
            assert_eq!([low, high], [(offset - 10.0f64).max(-13.0), (offset + 10.0f64).min(13.0)]);
            for side in [Side::Left, Side::Right] {
                for i in 0..7 {
                    let angle = cut.middle_angle(side) + 0.03 * f64::from(i - 3);
                    let [whole, lines] = [&long, &cut].map(|p| p.contact_lines(side, angle));
                    for line in lines {
                        let of_long = whole.iter().find(|l| l.tooth == line.tooth).unwrap();
                        let wanted = [of_long.z[0].max(low), of_long.z[1].min(high)];
                        let off = (line.z[0] - wanted[0]).abs() + (line.z[1] - wanted[1]).abs();
                        assert!(off < 1e-9, "{beta} deg, offset {offset}: {:?}, not {wanted:?}", line.z);
                    }
                    // Tooth 0 of the wheel at a height z: angle at its mid-face and twist from there.
                    let z = 3.0;
                    let [a, b] =
                        [&long, &cut].map(|p| p.wheel_angle(side, angle) + p.wheel.twist() * (z - p.mid_face_offset()));
                    assert!((a - b).abs() < 1e-12, "{beta} deg, offset {offset}: the tooth at {a} and {b} rad");
                }
            }
        }
    }
}

/// In the middle of the cycle tooth 0 stands in the middle of its path in the middle of the common face.
#[test]
fn the_cycle_is_counted_in_the_middle_of_the_common_face() {
    let pair = pair(25.0, [26.0, 20.0]).with_mid_face_offset(6.0).unwrap();
    let [start, end] = pair.path_of_contact();
    assert_eq!(pair.common_middle(), [4.5, -1.5]);
    for side in [Side::Left, Side::Right] {
        let xi = pair.path_coordinate(side, pair.middle_angle(side), 0, 4.5);
        assert!((xi - 0.5 * (start + end)).abs() < 1e-12, "{side:?}: {xi} mm of {start} .. {end}");
    }
}

/// What follows from the width follows from the common one.
#[test]
fn ratios_and_lengths_are_of_the_common_face() {
    let narrow = pair(25.0, [12.5, 12.5]);
    let pair = pair(25.0, [26.0, 20.0]).with_mid_face_offset(10.5).unwrap();
    assert_eq!(pair.face_width(), 12.5);
    assert_eq!(pair.overlap_ratio(), narrow.overlap_ratio());
    assert_eq!(pair.mean_contact_line_length(), narrow.mean_contact_line_length());
    let sheet = pair.sheet();
    assert_eq!((sheet.common_face_width_mm, sheet.mid_face_offset_mm), (12.5, 10.5));
    assert_eq!([sheet.pinion.face_width_mm, sheet.wheel.face_width_mm], [26.0, 20.0]);
    // The mean of the length over a cycle, summed.
    let (side, count) = (Side::Right, 4000);
    let at = |i: u32| pair.contact_line_length(side, pair.pinion.pitch_angle() * f64::from(i) / f64::from(count));
    let mean = (0..count).map(at).sum::<f64>() / f64::from(count);
    assert!((mean / pair.mean_contact_line_length() - 1.0).abs() < 1e-6, "{mean} mm");
}

/// Faces that pass each other are refused with both of them; so is an overlap on which the teeth lose each other.
#[test]
fn faces_that_do_not_meet_are_refused() {
    for offset in [23.0, -23.0, 40.0] {
        let error = pair(0.0, [26.0, 20.0]).with_mid_face_offset(offset).unwrap_err();
        assert!(matches!(error, GeometryError::FacesApart { .. }), "{offset}: {error}");
        assert!(error.to_string().contains("-13.0000 to 13.0000"), "{error}");
        assert!(error.hint().is_some_and(|hint| hint.contains("23.0000 mm")), "{error:?}");
    }
    for offset in [f64::NAN, f64::INFINITY] {
        let error = pair(0.0, [26.0, 20.0]).with_mid_face_offset(offset).unwrap_err();
        assert!(matches!(error, GeometryError::OutOfRange { .. }), "{offset}: {error}");
    }
    assert!(pair(0.0, [26.0, 20.0]).with_mid_face_offset(22.999).is_ok());
}
