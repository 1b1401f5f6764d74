//! Planetary stages in space: any member is input, output or fixed, and what a sensor on the ring hears of them.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, path::Path};

use analysis::{Context, Ending, NoObserver, gearbox::GearboxResult, solve};
use scene::gearbox::Gearbox;

use crate::planets::{POSITIONS, STAGE, Stage};

/// Torque of the sun, N m: the stage lags by the backlash and by what gives way, and ratios hold to the square of that angle.
const SUN: f64 = 2.0;
/// Thinning of the teeth, mm: as little.
const THIN: &str = "thickness_allowance_mm = 0.0005\n";
/// Most that torques may be off their ratios.
const EXACT: f64 = 1e-8;
/// Balance of a body over its largest force, or over a thousandth of the largest of all for a planet that idles. Places have a
/// last bit of 1e-14 mm, which a mesh turns to some 1e-9 N, and a planet under 2 N m on the sun may carry some 1e-2 N.
const BALANCED: f64 = 1e-7;

/// The stage on a carrier of its own; the planets turn in it. `roles`: input, output, fixed member.
fn with_carrier(stage: Stage, sun: f64, [input, output, fixed]: [&str; 3]) -> GearboxResult {
    let teeth = stage.teeth.map(|z| f64::from(z.abs()));
    let torque = |name: &str| sun * of_member(name, [1.0, teeth[2] / teeth[0], 1.0 + teeth[2] / teeth[0]]);
    let turn = "turn_stiffness_nm_per_rad = 1e8\n";
    let text = stage.text().replace("thickness_allowance_mm = 0.1\n", THIN);
    assert!(text.contains(THIN), "{text}");
    let end = text.find("[input]").unwrap();
    let mut text = text[..end].replacen(
        "shaft = \"planet\"\nposition_mm",
        "shaft = \"planet\"\nin_shaft = \"carrier\"\nposition_mm",
        2,
    );
    let mut on_carrier = "";
    if fixed == "carrier" {
        on_carrier = turn;
    } else {
        text = text.replace(
            &format!("[[shaft]]\nname = \"{fixed}\"\n"),
            &format!("[[shaft]]\nname = \"{fixed}\"\nfixed = true\n"),
        );
        let bearing = format!("name = \"{fixed} a\"\nshaft = \"{fixed}\"\n");
        assert!(text.contains(&bearing));
        text = text.replace(&bearing, &format!("{bearing}{turn}"));
    }
    text += &format!(
        "[[shaft]]\nname = \"carrier\"\nstands = true\norigin_mm = [0.0, 0.0, 0.0]\n[[shaft.section]]\nlength_mm = 60.0\n\
         outer_diameter_mm = 200.0\ninner_diameter_mm = 180.0\n\
         [[bearing]]\nname = \"carrier a\"\nshaft = \"carrier\"\nposition_mm = 5.0\nstiffness_n_per_mm = [1e6, 1e6, 1e6]\n{on_carrier}\
         [[bearing]]\nname = \"carrier b\"\nshaft = \"carrier\"\nposition_mm = 55.0\nstiffness_n_per_mm = [1e6, 1e6, 0.0]\n\
         [input]\nshaft = \"{input}\"\nposition_mm = 0.0\n[[torque]]\nshaft = \"{output}\"\nposition_mm = 60.0\n\
         torque_nm = {:?}\n[analysis]\npositions_per_cycle = {POSITIONS}\n",
        torque(output)
    );
    let file = Gearbox::parse(&text, Path::new("stage.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"));
    solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished).unwrap_or_else(|e| panic!("{input}: {e}"))
}

/// Of sun, ring and carrier.
fn of_member(name: &str, [sun, ring, carrier]: [f64; 3]) -> f64 {
    match name {
        "sun" => sun,
        "ring" => ring,
        _ => carrier,
    }
}

/// Whichever member is input, output or fixed: at every angle T_sun : T_ring : T_carrier = 1 : z_r/z_s : -(1 + z_r/z_s), the
/// input brings the power that the output takes, n_s z_s + n_r z_r = n_c (z_s + z_r), all to 1e-8, and every body is in balance.
#[test]
fn any_member_is_input_output_or_fixed() {
    let u = f64::from(-STAGE.teeth[2]) / f64::from(STAGE.teeth[0]);
    let all = [
        ["sun", "ring", "carrier"],
        ["ring", "sun", "carrier"],
        ["sun", "carrier", "ring"],
        ["carrier", "sun", "ring"],
        ["ring", "carrier", "sun"],
        ["carrier", "ring", "sun"],
    ];
    for roles in all {
        let [input, output, fixed] = roles;
        let found = with_carrier(Stage { pin: 5.0, ..STAGE }, SUN, roles);
        // Sun, ring, three planets, carrier.
        let at = |name: &str| of_member(name, [0.0, 1.0, 5.0]) as usize;
        let n = |name: &str| found.ratios_in_space[at(name)];
        let willis = (n("sun") + u * n("ring") - (1.0 + u) * n("carrier")).abs();
        assert!(
            n(fixed) == 0.0 && (n(input) - 1.0).abs() < 1e-12 && willis < 1e-9,
            "{roles:?}: {:?}",
            found.ratios_in_space
        );
        let unit = |name: &str| of_member(name, [1.0, u, -(1.0 + u)]);
        // Against the rotation of the output.
        let load = -n(output).signum() * 1e3 * SUN * unit(output).abs();
        let mut off = 0.0f64;
        for p in &found.positions {
            let held: f64 = found
                .bearings
                .iter()
                .zip(&p.bearings)
                .filter(|(own, _)| own.name.starts_with(fixed))
                .map(|(_, state)| state.moment[2])
                .sum();
            for (name, torque) in [(input, p.input_torque), (fixed, held)] {
                off = off.max((torque / unit(name) / (load / unit(output)) - 1.0).abs());
            }
            off = off.max((p.input_torque * n(input) + load * n(output)).abs() / (load * n(output)).abs());
        }
        let [_, balance] = found.certificate;
        println!("{roles:?}: torques off by {off:.1e}, bodies by {balance:.1e}");
        assert!(off < EXACT && balance < BALANCED, "{roles:?}: {off:e}, {balance:e}");
        let even = with_carrier(STAGE, SUN, roles).outputs[0];
        assert!(even.mean > 0.0 && even.peak_to_peak > 0.0, "{roles:?}: without a pin error {even:?}");
        // Of a pin that is off, the lag without load is that of the gap on the side that carries; a heavier load lags more.
        let heavier = with_carrier(Stage { pin: 5.0, ..STAGE }, 2.0 * SUN, roles);
        let [less, more] = [&found, &heavier].map(|own| own.outputs[0].mean);
        println!("{roles:?}: the output lags {less:.3e} rad, {more:.3e} rad under twice the load");
        assert!(more > less && found.outputs[0].peak_to_peak > 0.0, "{roles:?}: {less:e} and {more:e} rad");
    }
}

/// A sensor fixed to the ring hears equal planets pass with the transmission errors of their meshes (their forces are constant
/// where all mesh in phase): lines at multiples of N of the carrier's turns
/// alone, sidebands of the mesh order z_r; at z_r itself a line only where z_r is a multiple of N.
///
/// ```text
/// s(t) = sum e_n(t) w(psi_n + w_c t)      w: how much the sensor hears of a mesh at an angle from it
/// ```
#[test]
fn a_sensor_on_the_ring_hears_multiples_of_the_planets() {
    for (stage, has_mesh_order) in [(STAGE, false), (Stage { teeth: [40, 20, -80], count: 4, ..STAGE }, true)] {
        let (Stage { teeth, count, .. }, found) = (stage, stage.solve());
        let error = |i: usize, n: usize| 1e3 * found.positions[i].meshes[count + n].transmission_error;
        let ring = teeth[2].unsigned_abs() as usize;
        let instants = ring * POSITIONS;
        let hears = |angle: f64| (2.0 * angle.cos()).exp();
        let signal: Vec<f64> = (0..instants)
            .map(|i| {
                let turned = TAU * i as f64 / instants as f64;
                let of = |n: usize| error(i % POSITIONS, n) * hears(turned + TAU * n as f64 / count as f64);
                (0..count).map(of).sum()
            })
            .collect();
        let line = |order: usize| {
            let part = |(i, s): (usize, &f64)| {
                let (sin, cos) = (TAU * (order * i % instants) as f64 / instants as f64).sin_cos();
                [s * cos, s * sin]
            };
            let [re, im] = signal.iter().enumerate().map(part).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
            re.hypot(im) / instants as f64
        };
        let near = ring - 2 * count..=ring + 2 * count;
        let [on, off] = [true, false]
            .map(|multiple| near.clone().filter(|m| m.is_multiple_of(count) == multiple).map(line).fold(0.0, f64::max));
        println!("{teeth:?}, {count}: on {on:.3e}, off {off:.3e}, mesh order {:.3e} um", line(ring));
        assert!(off < 1e-5 * on, "{off:e} beside {on:e}");
        assert_eq!(ring.is_multiple_of(count), has_mesh_order);
        assert_eq!(line(ring) > 1e-3 * on, has_mesh_order);
    }
}
