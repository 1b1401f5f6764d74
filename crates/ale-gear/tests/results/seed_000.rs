//! The study of seed 000 on the meshes that Gmsh wrote, shortened: what does its figure 3 stand on?

use std::f64::consts::PI;

use crate::util::{Run, Scratch, column, repository};

const ANGLES: [u32; 4] = [10, 15, 20, 25];
const WIDTH: f64 = 22.0;
const TORQUE: f64 = 150e3;

/// The shipped scene with meshes found from anywhere; `edits` shorten it.
fn scene(degrees: u32, edits: &[(&str, &str)]) -> String {
    let folder = repository().join("scenes/seeds/000");
    let text = std::fs::read_to_string(folder.join(format!("beta{degrees}.toml"))).unwrap();
    let text = text.replace("../../../meshes", repository().join("meshes").to_str().unwrap());
    edits.iter().fold(text, |text, (old, new)| {
        assert!(text.contains(old), "{old} is not in\n{text}");
        text.replace(old, new)
    })
}

fn done(run: &Run) {
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
}

/// Transverse pressure angle, base helix angle (rad), base and reference radius (mm).
fn geometry(degrees: u32) -> [f64; 4] {
    let (beta, normal) = (f64::from(degrees).to_radians(), 20f64.to_radians());
    let transverse = (normal.tan() / beta.cos()).atan();
    let radius = 45.0 / beta.cos();
    [transverse, (beta.sin() * normal.cos()).asin(), radius * transverse.cos(), radius]
}

fn mean(all: &[f64]) -> f64 {
    all.iter().sum::<f64>() / all.len() as f64
}

/// The seed's three statements, and the laws that they rest on, from one run of the shipped study.
#[test]
fn error_follows_the_contact_lines_and_moments_grow_with_the_helix_angle() {
    let mut scratch = Scratch::new();
    let short = [
        ("cycles = 8", "cycles = 2\npositions_per_cycle = 8\n[contact]\nslices = 16"),
        ("steps_per_mesh_cycle = 64", "steps_per_mesh_cycle = 32\nsteps_per_resonance = 8\nperiodic_tolerance = 1e-3"),
    ];
    for degrees in ANGLES {
        scratch = scratch.file(&format!("beta{degrees}.toml"), scene(degrees, &short));
    }
    let study = std::fs::read_to_string(repository().join("scenes/seeds/000/study.toml")).unwrap();
    // The whole model takes half a minute.
    let study = study.replace("positions = 1", "positions = 0");
    let scratch = scratch.file("study.toml", study);
    done(&scratch.ale_gear(["run", "study.toml", "--out", "o"]));
    let csv = scratch.read("o/study.csv");
    let numbers = csv.lines().map(|l| l.split_once(',').unwrap().1).collect::<Vec<_>>().join("\n");

    for (i, degrees) in ANGLES.iter().enumerate() {
        let [_, base_helix, base_radius, radius] = geometry(*degrees);
        let rows = scratch.read(&format!("o/cases/{:02}-{degrees}-deg/history.csv", i + 1));
        let of = |name: &str| column(&rows, name);
        // Without friction force stays in the plane of action: at every instant F_a = F_bt tan(b_b), but for tips that
        // meet early and press off that plane.
        let (axial, torque) = (of("wheel_force_z_n"), of("wheel_moment_z_nmm"));
        for (k, (f, t)) in axial.iter().zip(&torque).enumerate() {
            let law = t.abs() / base_radius * base_helix.tan();
            assert!((f.abs() / law - 1.0).abs() < 2e-3, "{degrees} deg, row {k}: {f} N, not {law}");
        }
        // In the mean the driven gear keeps its speed: F_bt is that of the load.
        let law = TORQUE / base_radius * base_helix.tan();
        let found = mean(&axial);
        assert!((found.abs() / law - 1.0).abs() < 1e-3, "{degrees} deg: mean axial force {found} N, not {law}");
        // One force between two gears: its moments about either centre differ by that of F_a over the distance of the
        // centres.
        let (pinion, wheel) = (of("pinion_moment_y_nmm"), of("wheel_moment_y_nmm"));
        for (k, ((p, w), f)) in pinion.iter().zip(&wheel).zip(&axial).enumerate() {
            let law = 2.0 * radius * f;
            assert!((p + w - law).abs() < 1e-6 * law.abs(), "{degrees} deg, row {k}: {p} + {w} N mm, not {law}");
        }
        // Equal teeth: the load comes and goes alike on either side of the pitch point, which leaves F_a r_w in the
        // mean.
        let law = found * radius;
        for (name, all) in [("pinion", &pinion), ("wheel", &wheel)] {
            let m = mean(all);
            assert!(
                (m / law - 1.0).abs() < 0.01,
                "{degrees} deg: mean tilting moment of the {name} {m} N mm, not {law}"
            );
        }
        let contact_ratio = column(&numbers, "eps_gamma")[i];
        assert!((2.0..3.0).contains(&contact_ratio), "{degrees} deg: eps_gamma = {contact_ratio}");
    }

    // Figure 3(a): the error follows the length, and not the number of pairs.
    let length = column(&numbers, "correlation_dte_um_contact_line_length_mm");
    let pairs = column(&numbers, "correlation_dte_um_pairs_in_contact");
    assert!(length[2] < -0.9, "20 deg: correlation of DTE with the length {length:?}, with the pairs {pairs:?}");
    assert!(pairs[2].abs() < length[2].abs() - 0.1, "20 deg: with the length {length:?}, with the pairs {pairs:?}");
    // Figure 3(b) and what the seed says of it: steadier, at the price of axial force and tilting moment.
    let ascends = |name: &str, sign: f64| {
        let all: Vec<f64> = column(&numbers, name).iter().map(|x| sign * x.abs()).collect();
        assert!(all.windows(2).all(|w| w[1] > w[0]), "{name}: {all:?}");
    };
    ascends("mean_wheel_force_z_n", 1.0);
    ascends("mean_pinion_moment_y_nmm", 1.0);
    ascends("peak_to_peak_dte_um", -1.0);
    ascends("peak_to_peak_contact_line_length_mm", -1.0);
}

/// The tilting moment at every position is that of the forces of the slices where they act: M_y = z F_x - x F_z, which
/// is F_a r_w when the load stands at the pitch point at mid-face, and F_bt times the centroid's height beside it.
#[test]
fn the_tilting_moment_is_that_of_the_contact_lines() {
    let degrees = 20;
    let still = [
        ("kind = \"dynamic\"\ncycles = 8", "positions_per_cycle = 8\n[output]\ncontact_lines = true"),
        ("[motion]\nrun = \"steady\"\nsteps_per_mesh_cycle = 64\n", ""),
        ("[drive]\nby = \"speed\"\n", ""),
    ];
    let scratch = Scratch::new().file("a.toml", scene(degrees, &still));
    done(&scratch.ale_gear(["run", "a.toml", "--out", "o"]));
    let (rows, lines) = (scratch.read("o/history.csv"), scratch.read("o/contact_lines.csv"));
    let [transverse, base_helix, base_radius, radius] = geometry(degrees);
    let slice = WIDTH / 32.0 / base_helix.cos();
    let of = |name: &str| column(&lines, name);
    let (angle, z, roll, load) =
        (of("pinion_angle_deg"), of("z_mm"), of("pinion_roll_angle_deg"), of("line_load_n_per_mm"));
    let (at, moment, axial) =
        (column(&rows, "pinion_angle_deg"), column(&rows, "pinion_moment_y_nmm"), column(&rows, "pinion_force_z_n"));
    for ((at, moment), axial) in at.iter().zip(&moment).zip(&axial) {
        let here = (0..z.len()).filter(|&i| angle[i] == *at);
        // Along the line of action from the pitch point, and along the axis: sums over the slices' transverse forces.
        let (mut force, mut along, mut height) = (0.0, 0.0, 0.0);
        for i in here {
            let f = load[i] * slice * base_helix.cos();
            force += f;
            along += f * base_radius * (roll[i] * PI / 180.0 - transverse.tan());
            height += f * z[i];
        }
        let (along, height) = (along / force, height / force);
        // The force on the pinion points against the line of action's sense; x of the line of action falls with its arc
        // at the left flanks of a pinion that drives counter-clockwise.
        let x = radius + along * transverse.sin();
        let law = -x * axial + height * (-force * transverse.sin());
        let off = (moment - law).abs() / (axial.abs() * radius);
        assert!(off < 2e-3, "at {at} deg: {moment} N mm, of the lines {law}; centroid {along} along, {height} mm high");
    }
}
