//! The geometry sheet against books, published pairs and what its numbers mean.

use geometry::{Gear, GearData, GearPair, GearSheet, GeometrySheet};

fn pair(z: [u32; 2], m: f64, beta_deg: f64, b: f64, x: [f64; 2], a: Option<f64>, tips: [Option<f64>; 2]) -> GearPair {
    let gear = |i: usize| {
        let helix = if i == 0 { beta_deg } else { -beta_deg };
        Gear::new(GearData {
            teeth: z[i],
            normal_module: m,
            helix_angle: helix.to_radians(),
            face_width: b,
            profile_shift: x[i],
            thickness_allowance: 0.0,
            tip_diameter: tips[i],
            bore_diameter: 0.5 * m * f64::from(z[i]),
            ..GearData::default()
        })
        .unwrap()
    };
    GearPair::new(gear(0), gear(1), a).unwrap()
}

fn close(what: &str, value: f64, wanted: f64, tolerance: f64) {
    assert!((value - wanted).abs() <= tolerance, "{what}: {value}, not {wanted}");
}

/// Base tangent lengths over k teeth of spur gears without shift, m 1 mm, 20 deg, from tables of machine elements.
#[test]
fn spans_are_those_of_the_tables() {
    for (z, k, length) in [(20, 3, 7.6604), (30, 4, 10.7526), (40, 5, 13.8448), (60, 7, 20.0292)] {
        let sheet = pair([z, z], 1.0, 0.0, 10.0, [0.0; 2], None, [None; 2]).sheet();
        let span = sheet.pinion.span.unwrap();
        assert_eq!(span.teeth, k, "z {z}");
        close("W_k", span.length_mm, length, 2e-4);
    }
}

/// FZG C14: pitch diameters and path of contact as published (AB 6.14, AC 9.68, AD 13.28, AE 19.43 mm, 1 % as in
/// docs/validation.md); its tips are not shortened for that path.
#[test]
fn the_fzg_pair_has_its_published_diameters() {
    let sheet = pair([16, 24], 4.5, 0.0, 14.0, [0.1817, 0.1715], Some(91.5), [None; 2]).sheet();
    close("d_w1", sheet.pinion.working_pitch_diameter_mm, 73.2, 1e-9);
    close("d_w2", sheet.wheel.working_pitch_diameter_mm, 109.8, 1e-9);
    for (name, wanted) in [('B', 6.14), ('C', 9.68), ('D', 13.28), ('E', 19.43)] {
        let point = sheet.points.iter().find(|p| p.name == name).unwrap();
        close(&format!("A{name}"), point.from_start_mm, wanted, 0.01 * wanted);
    }
    close("eps_alpha", sheet.eps_alpha, 1.46, 0.01);
}

/// ISO/TR 6336-30, example 1: the angles and ratios that are printed.
#[test]
fn the_iso_pair_has_its_printed_values() {
    let sheet = pair([17, 103], 8.0, 15.8, 100.0, [0.145, 0.0], Some(500.0), [None; 2]).sheet();
    close("a_t", sheet.transverse_pressure_angle_deg, 20.7197, 1e-4);
    close("b_b", sheet.base_helix_angle_deg, 14.8245, 1e-4);
    close("a_wt", sheet.working_pressure_angle_deg, 21.0661, 1e-4);
    close("eps_beta", sheet.eps_beta, 1.0834, 1e-4);
}

fn sheets() -> Vec<(GearPair, GeometrySheet)> {
    let all = [
        pair([16, 24], 4.5, 0.0, 14.0, [0.1817, 0.1715], Some(91.5), [None; 2]),
        pair([30, 30], 3.0, 20.0, 20.0, [0.0; 2], None, [None; 2]),
        pair([17, 103], 8.0, -15.8, 100.0, [0.145, 0.0], Some(500.0), [None; 2]),
        pair([25, 61], 2.0, 28.0, 40.0, [0.3, -0.2], None, [None; 2]),
    ];
    all.into_iter().map(|pair| (pair.clone(), pair.sheet())).collect()
}

/// Pure rolling at the pitch point; sliding grows away from it as the sum of the speeds says; of both flanks specific
/// sliding belongs to the same speeds.
#[test]
fn sliding_follows_from_the_speeds() {
    for (_, sheet) in sheets() {
        let pitch = sheet.points.iter().find(|p| p.name == 'C').unwrap();
        close("sliding at C", pitch.sliding_speed_mm_s_per_rpm, 0.0, 1e-12);
        close("specific sliding at C", pitch.pinion_specific_sliding, 0.0, 1e-12);
        for p in &sheet.points {
            let of = 1.0 - p.wheel_rolling_speed_mm_s_per_rpm / p.pinion_rolling_speed_mm_s_per_rpm;
            close("specific sliding", p.pinion_specific_sliding, of, 1e-12);
            let product = (1.0 - p.pinion_specific_sliding) * (1.0 - p.wheel_specific_sliding);
            close("both", product, 1.0, 1e-12);
        }
    }
}

/// A ball of the dimension over balls touches the flank: its centre is half its diameter away from the nearest point.
#[test]
fn balls_touch_the_flanks() {
    for (pair, sheet) in sheets() {
        for (gear, own) in [(&pair.pinion, &sheet.pinion), (&pair.wheel, &sheet.wheel)] {
            let balls = own.balls.unwrap();
            let z = f64::from(gear.teeth());
            let across = if gear.teeth().is_multiple_of(2) { 1.0 } else { (std::f64::consts::PI / (2.0 * z)).cos() };
            let radius = 0.5 * (balls.dimension_mm - balls.ball_diameter_mm) / across;
            // The space beside tooth 0, half a pitch on, at mid-face.
            let angle = std::f64::consts::PI / z;
            let flank = gear.flank(geometry::Side::Left);
            let turned = if flank.point(flank.roll_tip, 0.0).y > 0.0 { angle } else { -angle };
            let centre = geometry::Vec3::new(radius * turned.cos(), radius * turned.sin(), 0.0);
            let foot = flank.locate(&centre).unwrap();
            close("ball to flank", foot.distance.abs(), 0.5 * balls.ball_diameter_mm, 1e-9);
            assert!(foot.roll > flank.roll_form && foot.roll < flank.roll_tip, "on the flank");
        }
    }
}

/// A thinner tooth shortens the span by its allowance times cos a_n, and gauges say so.
#[test]
fn allowances_show_on_gauges() {
    let data = GearData { thickness_allowance: 0.1, ..GearData::default() };
    let gear = Gear::new(data.clone()).unwrap();
    let wheel = Gear::new(GearData { helix_angle: -data.helix_angle, ..data.clone() }).unwrap();
    let sheet = GearPair::new(gear, wheel, None).unwrap().sheet();
    let GearSheet { span, balls, normal_tooth_thickness_mm, .. } = sheet.pinion;
    let (span, balls) = (span.unwrap(), balls.unwrap());
    close("span", span.nominal_length_mm - span.length_mm, 0.1 * data.normal_pressure_angle.cos(), 1e-12);
    assert!(balls.nominal_dimension_mm > balls.dimension_mm + 0.1, "balls stand out farther of thicker teeth");
    let nominal = 0.5 * std::f64::consts::PI * data.normal_module;
    close("thickness", normal_tooth_thickness_mm, nominal - 0.1, 1e-9);
}

/// Flank tolerances double every other class; of class 5, m_n 3, d 95.776, b 20 by hand.
#[test]
fn flank_tolerances_grow_by_class() {
    let gear = Gear::new(GearData::default()).unwrap();
    let of = |class: u32| geometry::FlankTolerances::new(&gear, class);
    close("f_HaT", of(5).profile_slope_um, 0.4 * 3.0 + 0.095_776 + 4.0, 1e-4);
    close("f_HbT", of(5).helix_slope_um, 6.0546, 1e-3);
    close("f_pT", of(5).single_pitch_um, 6.2958, 1e-3);
    close("F_pT", of(5).total_pitch_um, 0.191_552 + 5.382_588 + 2.1 + 12.0, 1e-4);
    close("two classes", of(9).helix_form_um / of(7).helix_form_um, 2.0, 1e-12);
    assert_eq!(of(6).of_key("pinion.modification.drive.lead_slope_um"), Some(of(6).helix_slope_um));
    assert_eq!(of(6).of_key("pinion.modification.tip_relief_um"), None);
}
