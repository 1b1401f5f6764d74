//! Reference cases and laws of gear geometry.

use std::f64::consts::PI;

use geometry::{Gear, GearData, GearPair, GeometryError, Side, Vec3};

fn pair(z: [u32; 2], m: f64, beta_deg: f64, b: f64, x: [f64; 2], a: Option<f64>) -> GearPair {
    let gear = |i: usize| {
        let helix = if i == 0 { beta_deg } else { -beta_deg };
        Gear::new(GearData {
            teeth: z[i],
            normal_module: m,
            helix_angle: helix.to_radians(),
            face_width: b,
            profile_shift: x[i],
            thickness_allowance: 0.0,
            bore_diameter: 0.5 * m * f64::from(z[i]),
            ..GearData::default()
        })
        .unwrap()
    };
    GearPair::new(gear(0), gear(1), a).unwrap()
}

fn default_pair() -> GearPair {
    let pinion = Gear::new(GearData::default()).unwrap();
    let wheel = Gear::new(GearData { helix_angle: -GearData::default().helix_angle, ..GearData::default() }).unwrap();
    GearPair::new(pinion, wheel, None).unwrap()
}

/// ISO/TR 6336-30 example 1 and FZG H701, seeds 001 and 004: contact ratios and line lengths of validation.md.
#[test]
fn published_pairs() {
    let iso = pair([17, 103], 8.0, 15.8, 100.0, [0.145, 0.0], Some(500.0));
    let close = |what: &str, value: f64, wanted: f64, tolerance: f64| {
        assert!((value - wanted).abs() <= tolerance * wanted.abs(), "{what}: {value}, not {wanted}");
    };
    close("a_t", iso.pinion.transverse_pressure_angle().to_degrees(), 20.7197, 3e-6);
    close("b_b", iso.base_helix_angle().to_degrees(), 14.8245, 4e-6);
    close("a_wt", iso.working_pressure_angle().to_degrees(), 21.0661, 3e-6);
    close("eps_beta", iso.overlap_ratio(), 1.0834, 1e-4);
    let seed4 = pair([30, 90], 3.0, 10.0, 60.0, [0.0, 0.0], None);
    close("eps_alpha", seed4.transverse_contact_ratio(), 1.708, 5e-4);
    close("eps_beta", seed4.overlap_ratio(), 1.106, 5e-4);
    close("mean length", seed4.mean_contact_line_length(), 103.9, 1e-3);
    let lengths: Vec<f64> = (0..512)
        .map(|i| seed4.contact_line_length(Side::Left, f64::from(i) / 512.0 * seed4.pinion.pitch_angle()))
        .collect();
    close("least length", lengths.iter().copied().fold(f64::MAX, f64::min), 99.8, 1e-3);
    close("largest length", lengths.iter().copied().fold(0.0, f64::max), 105.6, 1e-3);
    let seed1 = pair([41, 30], 25.0, 14.0, 350.0, [0.0, 0.0], None);
    close("mean length", seed1.mean_contact_line_length(), 581.1, 2e-4);
    close("eps_gamma", seed1.total_contact_ratio(), 2.695, 3e-4);
    let spur = pair([62, 62], 2.0, 0.0, 20.0, [0.0, 0.0], None);
    close("eps_alpha", spur.transverse_contact_ratio(), 1.78978, 3e-6);
    let c14 = pair([16, 24], 4.5, 0.0, 14.0, [0.1817, 0.1715], Some(91.5));
    close("eps_alpha", c14.transverse_contact_ratio(), 1.46, 0.02);
}

/// The pair of the finite-element reference: centre distance, contact ratio, and the pinion angles of its positions.
#[test]
fn default_pair_stands_where_the_reference_stands() {
    let pair = default_pair();
    assert!((pair.centre_distance() - 95.775999).abs() < 1e-6, "a = {}", pair.centre_distance());
    assert!((pair.total_contact_ratio() - 2.2454).abs() < 5e-5, "eps_gamma = {}", pair.total_contact_ratio());
    let half_pitch_back = pair.middle_angle(Side::Left) - 0.5 * pair.pinion.pitch_angle();
    assert!((half_pitch_back + 0.15652407712393415).abs() < 1e-9, "theta(s = 0) = {half_pitch_back}");
}

/// Mean over a cycle is eps_alpha b / cos(b_b); with an integer overlap ratio the length does not vary at all.
#[test]
fn contact_line_length_has_its_mean_and_its_constant_case() {
    let pair = default_pair();
    let n = 4096;
    for side in [Side::Left, Side::Right] {
        let mean = (0..n)
            .map(|i| pair.contact_line_length(side, f64::from(i) / f64::from(n) * pair.pinion.pitch_angle()))
            .sum::<f64>()
            / f64::from(n);
        assert!((mean - pair.mean_contact_line_length()).abs() < 1e-3, "{mean}");
    }
    let b_b = pair.base_helix_angle();
    let width = pair.transverse_base_pitch() / b_b.tan();
    let of = |beta: f64| Gear::new(GearData { helix_angle: beta, face_width: width, ..GearData::default() }).unwrap();
    let beta = GearData::default().helix_angle;
    let pair = GearPair::new(of(beta), of(-beta), None).unwrap();
    for i in 0..64 {
        let length = pair.contact_line_length(Side::Left, f64::from(i) * 0.01);
        assert!((length - pair.mean_contact_line_length()).abs() < 1e-9 * length, "{length}");
    }
}

/// Normal = cross product of the tangents, tangents = differences, foot point = the point it was made from.
#[test]
fn flank_surface_is_consistent() {
    for beta in [-0.6, 0.0, 0.35] {
        let gear = Gear::new(GearData { helix_angle: beta, ..GearData::default() }).unwrap();
        for (side, tooth) in [(Side::Left, 0), (Side::Right, 0), (Side::Left, 17), (Side::Right, -4)] {
            let flank = gear.flank_of(side, tooth);
            for (u, z) in [(0.25, -9.0), (0.4, 0.0), (0.53, 8.0)] {
                let [du, dz] = flank.tangents(u, z);
                let h = 1e-6;
                let by_u = (flank.point(u + h, z) - flank.point(u - h, z)) / (2.0 * h);
                let by_z = (flank.point(u, z + h) - flank.point(u, z - h)) / (2.0 * h);
                assert!((du - by_u).norm() < 1e-7 && (dz - by_z).norm() < 1e-7, "tangents at {u}, {z}");
                let n = flank.normal(u, z);
                assert!(n.dot(&du).abs() < 1e-12 && n.dot(&dz).abs() < 1e-12, "normal at {u}, {z}");
                let inside = flank.point(u, z) - 0.1 * n;
                let mid = tooth.rem_euclid(30) as f64 * gear.pitch_angle() + gear.twist() * z;
                let off = |p: &Vec3| (p.y * mid.cos() - p.x * mid.sin()).abs();
                assert!(off(&inside) < off(&flank.point(u, z)), "normal points out of the tooth");
                for d in [-0.3, -1e-3, 0.0, 0.02, 0.5] {
                    let foot = flank.locate(&(flank.point(u, z) + d * n)).unwrap();
                    assert!((foot.distance - d).abs() < 1e-12, "{d} {}", foot.distance);
                    assert!((foot.roll - u).abs() < 1e-12 && (foot.z - z).abs() < 1e-12, "{foot:?}");
                }
                // Curvature: the normal turns by ds / rho along the profile.
                let turned = (flank.normal(u + h, z) - flank.normal(u - h, z)) / (2.0 * h);
                let curvature = turned.dot(&du) / du.norm_squared();
                assert!((curvature - flank.curvatures(u)[0]).abs() < 1e-7, "{curvature}");
            }
        }
    }
}

/// Conjugate flanks touch everywhere on the contact line, at any angle, on either side, with opposite normals.
#[test]
fn flanks_are_conjugate() {
    let pair = pair([17, 29], 3.0, 25.0, 20.0, [0.2, -0.1], Some(76.7));
    for side in [Side::Left, Side::Right] {
        for i in 0..40 {
            let theta1 = -0.3 + 0.017 * f64::from(i);
            let theta2 = pair.wheel_angle(side, theta1);
            for line in pair.contact_lines(side, theta1) {
                let flank1 = pair.pinion.flank_of(side, line.tooth);
                let flank2 = pair.wheel.flank_of(side, -line.tooth);
                for f in [0.01, 0.5, 0.99] {
                    let z = line.z[0] + f * (line.z[1] - line.z[0]);
                    let u = pair.path_coordinate(side, theta1, line.tooth, z) / pair.pinion.base_radius();
                    let turn =
                        |v: Vec3, t: f64| Vec3::new(v.x * t.cos() - v.y * t.sin(), v.x * t.sin() + v.y * t.cos(), v.z);
                    let world = turn(flank1.point(u, z), theta1);
                    let foot =
                        flank2.locate(&turn(world - Vec3::new(pair.centre_distance(), 0.0, 0.0), -theta2)).unwrap();
                    assert!(foot.distance.abs() < 1e-11, "gap {} at z = {z}, tooth {}", foot.distance, line.tooth);
                    let opposite = turn(flank1.normal(u, z), theta1) + turn(flank2.normal(foot.roll, foot.z), theta2);
                    assert!(opposite.norm() < 1e-11, "normals {opposite}");
                }
            }
        }
    }
}

/// A point on the base circle is on the flank, wherever round-off or the last digits of a file have put it; a tenth of a
/// per cent below there is no flank.
#[test]
fn the_flank_begins_on_its_base_circle() {
    for helix_deg in [0.0f64, 25.0] {
        let gear = Gear::new(GearData {
            teeth: 17,
            helix_angle: helix_deg.to_radians(),
            bore_diameter: 20.0,
            ..GearData::default()
        });
        let gear = gear.unwrap();
        for (side, tooth) in [(Side::Left, 0), (Side::Right, 5), (Side::Left, -3)] {
            let flank = gear.flank_of(side, tooth);
            for z in [-5.0, 0.0, 7.3] {
                let start = flank.point(0.0, z);
                for off in [0.0, 1e-16, -1e-16, 3e-16, -3e-16, 1e-12, -1e-12, -1e-9, -1e-7, 1e-7] {
                    let p = Vec3::new(start.x * (1.0 + off), start.y * (1.0 + off), z);
                    let foot = flank.locate(&p).unwrap_or_else(|| panic!("{side:?} {tooth}, off by {off}"));
                    assert!(
                        foot.distance.abs() < 1e-6 && foot.roll.abs() < 1e-3 && foot.roll >= 0.0,
                        "{off}: {foot:?}"
                    );
                }
                assert!(flank.locate(&Vec3::new(start.x * 0.999, start.y * 0.999, z)).is_none());
            }
        }
    }
}

/// The fillet meets the involute with a common point, and a common tangent unless the tooth is undercut.
#[test]
fn fillet_joins_the_involute() {
    for (z, x, beta) in
        [(30, 0.0, 0.35), (17, 0.145, 0.2), (8, 0.0, 0.0), (12, -0.2, 0.3), (200, 0.5, 0.0), (13, 0.3, 0.6)]
    {
        let data = GearData {
            teeth: z,
            profile_shift: x,
            helix_angle: beta,
            bore_diameter: 1.5 * f64::from(z),
            thickness_allowance: 0.02,
            ..GearData::default()
        };
        let gear = Gear::new(data).unwrap();
        let p = gear.profile();
        let (r, angle) = p.fillet(1.0);
        assert!((r - p.radius(p.roll_form())).abs() < 1e-9 * r, "z {z}: radius {r} and {}", p.radius(p.roll_form()));
        assert!((angle - p.half_angle(p.roll_form())).abs() < 1e-9, "z {z}: angle {angle}");
        assert!((p.fillet(0.0).0 - gear.root_radius()).abs() < 1e-9, "z {z}: root");
        if !p.is_undercut() {
            let (r0, a0) = p.fillet(1.0 - 1e-5);
            let u0 = p.roll_form() + 1e-5;
            let fillet_slope = (angle - a0) * r / (r - r0);
            let involute_slope = (p.half_angle(u0) - angle) * r / (p.radius(u0) - r);
            assert!((fillet_slope - involute_slope).abs() < 2e-3, "z {z}: {fillet_slope} and {involute_slope}");
        }
    }
}

/// Without thinning there is no backlash at the nominal centre distance; thinning E a gear opens 2 E cos(a_n) /
/// cos(b_b) normal to the flank, that is 2 E cos(a_t)/cos(b) in the transverse section.
#[test]
fn backlash_is_what_thinning_leaves() {
    assert!(pair([20, 41], 2.0, 12.0, 10.0, [0.3, 0.2], None).backlash().abs() < 1e-11);
    let pair = default_pair();
    let gear = &pair.pinion;
    let wanted = 2.0 * 0.05 / gear.data().helix_angle.cos() * gear.transverse_pressure_angle().cos();
    assert!((pair.backlash() - wanted).abs() < 1e-12, "{} {wanted}", pair.backlash());
}

/// Nonsense is named.
#[test]
fn impossible_gears_are_refused() {
    let with = |change: &dyn Fn(&mut GearData)| {
        let mut data = GearData::default();
        change(&mut data);
        Gear::new(data)
    };
    assert!(matches!(with(&|d| d.normal_module = f64::NAN), Err(GeometryError::OutOfRange { .. })));
    assert!(matches!(with(&|d| d.profile_shift = 2.5), Err(GeometryError::PointedTooth { .. })));
    assert!(matches!(with(&|d| d.root_radius_coefficient = 0.6), Err(GeometryError::RootRadius { .. })));
    assert!(matches!(with(&|d| d.bore_diameter = 90.0), Err(GeometryError::Bore { .. })));
    let gear = |beta: f64| with(&|d| d.helix_angle = beta).unwrap();
    assert!(matches!(GearPair::new(gear(0.3), gear(0.3), None), Err(GeometryError::Mismatch { .. })));
    assert!(matches!(GearPair::new(gear(0.3), gear(-0.3), Some(94.0)), Err(GeometryError::Jammed { .. })));
    assert!(matches!(GearPair::new(gear(0.3), gear(-0.3), Some(80.0)), Err(GeometryError::CentreDistance { .. })));
    assert!(matches!(
        GearPair::new(gear(0.3), gear(-0.3), Some(101.0)),
        Err(GeometryError::NoContact { .. } | GeometryError::ContactRatio { .. })
    ));
}

/// The fillet's tangent is the derivative of its points, from the root land (square to the centre line of the space) to
/// the form circle, for helical, spur and undercut gears.
#[test]
fn fillet_tangent_is_the_derivative_of_the_fillet() {
    let data = GearData::default();
    for data in [
        data.clone(),
        GearData { helix_angle: 0.0, ..data.clone() },
        GearData { teeth: 10, helix_angle: 0.0, bore_diameter: 10.0, ..data.clone() },
        GearData { helix_angle: -0.5, profile_shift: 0.4, ..data },
    ] {
        let (z, profile) = (data.teeth, *Gear::new(data).unwrap().profile());
        let point = |t: f64| {
            let (r, angle) = profile.fillet(t);
            [r * angle.cos(), r * angle.sin()]
        };
        assert!((profile.fillet_tangent(0.0) - (0.5 * PI - profile.fillet(0.0).1)).abs() < 1e-12);
        for t in [0.1, 0.3, 0.5, 0.7, 0.9, 0.99] {
            let ([x0, y0], [x1, y1]) = (point(t - 1e-6), point(t + 1e-6));
            let by_difference = (y0 - y1).atan2(x1 - x0);
            let angle = profile.fillet_tangent(t);
            assert!((angle - by_difference).abs() < 1e-6, "z {z}, t = {t}: {angle} rad, not {by_difference}");
            assert!((profile.fillet_at_tangent(angle) - t).abs() < 1e-9, "z {z}, t = {t}");
        }
        assert_eq!(profile.fillet_at_tangent(-1.0), 1.0);
    }
}
