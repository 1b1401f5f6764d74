//! Normal modes against dense matrices, a closed form, and one way against the other.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::{PI, TAU};

use crate::common::{gear, options};
use faer::{Mat, MatRef};
use fem::{DofMap, ElementOptions, Material};
use geometry::{Gear, Side};
use mesh::{ElementBlock, ElementKind, Extent, Face, FaceKind, GroupNames, Mesh, MeshedGear, SurfaceGroup};
use nalgebra::{DMatrix, SymmetricEigen};
use reduction::{GearModes, GearReducer, ModeChoice, ReductionWay, Window};

/// As few elements as a gear can have, times `fine` in the tooth.
fn meshed(gear: &Gear, fine: u32, extent: Extent) -> MeshedGear {
    crate::common::meshed(gear, 1, fine, extent)
}

/// All frequencies of a mesh, Hz, by dense matrices: nodes `held`, by Cholesky of M and nalgebra's symmetric QR.
fn dense_frequencies(mesh: &Mesh, held: &[u32]) -> Vec<f64> {
    let dofs = DofMap::new(mesh.nodes.len(), held);
    let system = fem::assemble(mesh, &Material::STEEL, &dofs, &ElementOptions::default()).unwrap();
    let [k, m] = [system.stiffness.to_dense(), system.mass.to_dense()]
        .map(|a| DMatrix::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)]));
    let l = m.cholesky().unwrap().unpack();
    let half = l.solve_lower_triangular(&k).unwrap();
    let full = l.solve_lower_triangular(&half.transpose()).unwrap();
    let eigen = SymmetricEigen::new(0.5 * (&full + full.transpose()));
    let mut all: Vec<f64> = eigen.eigenvalues.iter().map(|s| s.sqrt() / TAU).collect();
    all.sort_unstable_by(f64::total_cmp);
    all
}

fn worst(found: &[f64], wanted: &[f64]) -> f64 {
    found.iter().zip(wanted).fold(0.0, |m, (f, w)| m.max((f / w - 1.0).abs()))
}

fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    fem::dense::product(a, b)
}

/// Phi_B Omega^-2 Phi_B' of a window: what the modes make of its compliance, whatever the basis of equal frequencies.
fn modal_compliance(modes: &GearModes, reducer: &GearReducer, window: &Window) -> Mat<f64> {
    let shapes = modes.on_window(reducer, window).unwrap();
    let scaled = Mat::from_fn(shapes.nrows(), shapes.ncols(), |i, j| shapes[(i, j)] / modes.squares()[j]);
    product(scaled.as_ref(), shapes.transpose())
}

fn off(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    (a - b).norm_max() / b.norm_max()
}

/// Both ways, free and held, against dense matrices of the whole gear.
#[test]
fn frequencies_are_those_of_dense_matrices() {
    let exact = gear(11, 20.0);
    let mesh = meshed(&exact, 1, Extent::Whole);
    let options = options(&[Side::Left], 3, 9);
    let wanted = dense_frequencies(mesh.mesh(), mesh.bore_nodes());
    for general in [false, true] {
        let reducer = match general {
            false => GearReducer::new(mesh.clone(), Material::STEEL, options.clone()).unwrap(),
            true => GearReducer::general(mesh.clone(), Material::STEEL, options.clone()).unwrap(),
        };
        let modes = reducer.modes(ModeChoice::Count(60)).unwrap();
        let found = modes.frequencies_hz();
        assert!(found.len() >= 60, "{} modes", found.len());
        let free = worst(&found, &wanted);
        // Neither one more nor one less up to a bound.
        let bound = 0.5 * (wanted[40] + wanted[41]);
        let below = reducer.modes(ModeChoice::Below { hz: bound }).unwrap().count();
        assert_eq!(below, wanted.iter().filter(|f| **f <= bound).count(), "{:?}", reducer.way());
        let lowest = reducer.lowest_frequencies().unwrap();
        let mut held = mesh.bore_nodes().to_vec();
        held.extend(&reducer.window(9).unwrap().reduced.nodes);
        let held_wanted = dense_frequencies(mesh.mesh(), &held)[0];
        let held = (lowest.flanks_held_hz / held_wanted - 1.0).abs();
        println!(
            "{:?}: {} freedoms, 60 modes {:.0} .. {:.0} Hz off by {free:.1e}, flanks held {held_wanted:.0} Hz by {held:.1e}",
            reducer.way(),
            wanted.len(),
            found[0],
            found[59]
        );
        assert!(free < 1e-8 && held < 1e-8, "{:?}: {free:e} free, {held:e} held", reducer.way());
        assert!((lowest.flanks_free_hz / found[0] - 1.0).abs() < 1e-12, "{} Hz", lowest.flanks_free_hz);
        assert!(lowest.flanks_held_hz >= lowest.flanks_free_hz);
    }
}

/// One sector instead of a gear: frequencies, inertia shared with rigid motion, and shapes on the flanks of every
/// window.
#[test]
fn a_sector_has_the_modes_of_the_gear() {
    for (teeth, beta, extent) in [(11, 20.0, Extent::Whole), (14, 0.0, Extent::Whole), (17, -15.0, Extent::Periodic)] {
        let exact = gear(teeth, beta);
        let options = options(&[Side::Left, Side::Right], 2, teeth - 1);
        let cyclic = GearReducer::new(meshed(&exact, 2, extent), Material::STEEL, options.clone()).unwrap();
        let general = GearReducer::general(meshed(&exact, 2, extent), Material::STEEL, options).unwrap();
        assert_eq!([cyclic.way(), general.way()], [ReductionWay::CyclicSector, ReductionWay::General]);
        let [a, b] = [&cyclic, &general].map(|r| r.modes(ModeChoice::Count(24)).unwrap());
        assert_eq!(a.count(), b.count(), "z {teeth}");
        let frequency = worst(&a.frequencies_hz(), &b.frequencies_hz());
        // Modes of one frequency may be turned among themselves: what counts is their sum of squares.
        let inertia = |m: &GearModes| {
            let c = m.coupling();
            Mat::from_fn(6, 6, |i, j| c.iter().map(|row| row[i] * row[j]).sum::<f64>())
        };
        let shared = off(&inertia(&a), &inertia(&b));
        let mut shapes = 0.0f64;
        let mut turned = 0.0f64;
        for first in [teeth - 1, 0, 5] {
            let [v, w] = [&cyclic, &general].map(|r| r.window(first).unwrap());
            let [x, y] = [modal_compliance(&a, &cyclic, &v), modal_compliance(&b, &general, &w)];
            if extent == Extent::Whole {
                shapes = shapes.max(off(&x, &y));
            }
            let base = cyclic.window(teeth - 1).unwrap();
            turned = turned.max(off(&x, &modal_compliance(&a, &cyclic, &base)));
        }
        let lowest = [&cyclic, &general].map(|r| r.lowest_frequencies().unwrap());
        let held = (lowest[0].flanks_held_hz / lowest[1].flanks_held_hz - 1.0).abs();
        println!(
            "z {teeth}, {beta} deg: {:.0} .. {:.0} Hz, waves {:?}; off: frequencies {frequency:.1e}, held {held:.1e}, \
             inertia {shared:.1e}, flanks {shapes:.1e}, other windows {turned:.1e}",
            a.frequencies_hz()[0],
            a.frequencies_hz()[23],
            a.waves().unwrap()
        );
        assert!(frequency < 1e-8 && held < 1e-8, "z {teeth}: frequencies {frequency:e}, held {held:e}");
        assert!(shared < 1e-8 && shapes < 1e-7 && turned < 1e-7, "z {teeth}: {shared:e}, {shapes:e}, {turned:e}");
    }
}

/// Bore-held modes with the inertia that they share with rigid motion are the gear whose bore is rigid and free:
/// frequencies of the whole mesh with its bore nodes tied to one body, by dense matrices.
#[test]
fn modes_and_a_rigid_body_are_the_free_gear() {
    let mesh = meshed(&gear(11, 20.0), 1, Extent::Whole);
    let nodes = &mesh.mesh().nodes;
    let n = 3 * nodes.len();
    let all = DofMap::new(nodes.len(), &[]);
    let system = fem::assemble(mesh.mesh(), &Material::STEEL, &all, &ElementOptions::default()).unwrap();
    let motion = DMatrix::from_fn(n, 6, |row, j| {
        let (x, axis) = (nalgebra::Vector3::from(nodes[row / 3]), row % 3);
        let unit = nalgebra::Vector3::from_fn(|i, _| f64::from(u8::from(i == j % 3)));
        if j < 3 { unit[axis] } else { unit.cross(&x)[axis] }
    });
    let is_bore = |row: usize| mesh.bore_nodes().binary_search(&((row / 3) as u32)).is_ok();
    let free: Vec<usize> = (0..n).filter(|&row| !is_bore(row)).collect();
    let tied = DMatrix::from_fn(n, 6 + free.len(), |row, j| match j {
        0..6 if is_bore(row) => motion[(row, j)],
        0..6 => 0.0,
        _ => f64::from(u8::from(free[j - 6] == row)),
    });
    let [k, m] =
        [system.stiffness.to_dense(), system.mass.to_dense()].map(|a| DMatrix::from_fn(n, n, |i, j| a[(i, j)]));
    let frequencies = |k: DMatrix<f64>, m: DMatrix<f64>| {
        let l = m.cholesky().unwrap().unpack();
        let half = l.solve_lower_triangular(&k).unwrap();
        let full = l.solve_lower_triangular(&half.transpose()).unwrap();
        let mut all: Vec<f64> =
            SymmetricEigen::new(0.5 * (&full + full.transpose())).eigenvalues.iter().copied().collect();
        all.sort_unstable_by(f64::total_cmp);
        all.iter().skip(6).map(|s| s.sqrt() / TAU).collect::<Vec<_>>()
    };
    let wanted = frequencies(tied.tr_mul(&k) * &tied, tied.tr_mul(&m) * &tied);
    let reducer = GearReducer::new(mesh.clone(), Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
    let modes = reducer.modes(ModeChoice::Count(usize::MAX)).unwrap();
    let size = 6 + modes.count();
    let (mut stiffness, mut mass) = (DMatrix::zeros(size, size), DMatrix::identity(size, size));
    mass.view_mut((0, 0), (6, 6)).copy_from(&(motion.tr_mul(&m) * &motion));
    for (j, (square, shared)) in modes.squares().iter().zip(modes.coupling()).enumerate() {
        stiffness[(6 + j, 6 + j)] = *square;
        (0..6).for_each(|i| (mass[(i, 6 + j)], mass[(6 + j, i)]) = (shared[i], shared[i]));
    }
    let found = frequencies(stiffness, mass);
    let off = worst(&found[..40], &wanted);
    println!(
        "bore free: {:.0} .. {:.0} Hz, off by {off:.1e}; bore held from {:.0} Hz on",
        wanted[0],
        wanted[39],
        modes.frequencies_hz()[0]
    );
    assert!(off < 1e-7, "{off:e}");
}

/// A ring of rectangular section, bore held, with patches on its outside for flanks.
fn ring(inner: f64, outer: f64, width: f64, [around, across, along]: [usize; 3], teeth: u32) -> MeshedGear {
    let node = |i: usize, j: usize, k: usize| ((k * (across + 1) + j) * around + i % around) as u32;
    let mut nodes = Vec::new();
    for k in 0..=along {
        for j in 0..=across {
            for i in 0..around {
                let r = inner + (outer - inner) * j as f64 / across as f64;
                let (sin, cos) = (TAU * i as f64 / around as f64).sin_cos();
                nodes.push([r * cos, r * sin, width * (k as f64 / along as f64 - 0.5)]);
            }
        }
    }
    let mut block = ElementBlock { kind: ElementKind::Hex8, connectivity: Vec::new(), tags: Vec::new() };
    for k in 0..along {
        for j in 0..across {
            for i in 0..around {
                let low = [node(i, j, k), node(i, j + 1, k), node(i + 1, j + 1, k), node(i + 1, j, k)];
                let high = low.map(|n| n + ((across + 1) * around) as u32);
                block.connectivity.extend(low.into_iter().chain(high));
                block.tags.push(block.tags.len() as u64 + 1);
            }
        }
    }
    let face = |i: usize, j: usize, k: usize| {
        Face::new(FaceKind::Quad4, &[node(i, j, k), node(i + 1, j, k), node(i + 1, j, k + 1), node(i, j, k + 1)])
    };
    let every = |from: usize, to: usize, j: usize| {
        (from..to).flat_map(move |i| (0..along).map(move |k| face(i, j, k))).collect::<Vec<_>>()
    };
    let mut surfaces = vec![SurfaceGroup { name: "bore".into(), faces: every(0, around, 0) }];
    let pitch = around / teeth as usize;
    for tooth in 0..teeth as usize {
        for (side, at) in [("right", 1), ("left", 3)] {
            let name = format!("flank_{side}_{tooth}");
            let faces = every(tooth * pitch + at, tooth * pitch + at + 1, across);
            surfaces.push(SurfaceGroup { name, faces });
        }
    }
    let node_tags = (1..=nodes.len() as u64).collect();
    let mesh = Mesh { nodes, node_tags, blocks: vec![block], surfaces, ..Mesh::default() };
    MeshedGear::from_groups(mesh, &GroupNames::default(), teeth).unwrap()
}

/// J_n(x) and Y_n(x) by their integrals (DLMF 10.9.2, 10.9.7).
fn bessel(n: i32, x: f64) -> [f64; 2] {
    let simpson = |f: &dyn Fn(f64) -> f64, to: f64| {
        let steps = 2000;
        let h = to / f64::from(steps);
        let weight = |i| {
            if i == 0 || i == steps {
                1.0
            } else if i % 2 == 1 {
                4.0
            } else {
                2.0
            }
        };
        (0..=steps).map(|i| weight(i) * f(h * f64::from(i))).sum::<f64>() * h / 3.0
    };
    let order = f64::from(n);
    let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
    let j = simpson(&|t| (x * t.sin() - order * t).cos(), PI) / PI;
    let tail = |t: f64| ((order * t).exp() + sign * (-order * t).exp()) * (-x * t.sinh()).exp();
    let y = simpson(&|t| (x * t.sin() - order * t).sin(), PI) / PI - simpson(&tail, 8.0) / PI;
    [j, y]
}

/// Torsion of a ring held at its bore: J_2(kb) Y_1(ka) = Y_2(kb) J_1(ka), omega = k sqrt(G / rho), whatever Poisson's
/// ratio.
#[test]
fn a_ring_twists_at_its_own_frequency() {
    let (a, b) = (20.0, 50.0);
    let condition = |k: f64| {
        let ([j1, y1], [j2, y2]) = (bessel(1, k * a), bessel(2, k * b));
        j2 * y1 - y2 * j1
    };
    let (mut low, mut high) = (0.3 / (b - a), 2.0 / (b - a));
    assert!(condition(low) * condition(high) < 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if condition(low) * condition(middle) > 0.0 { low = middle } else { high = middle }
    }
    for poisson in [0.0, 0.3] {
        // The same shear modulus for both.
        let shear = 8.0e4;
        let material = Material::new(2.0 * shear * (1.0 + poisson), poisson, 7.85e-9).unwrap();
        let wanted = low * (shear / 7.85e-9f64).sqrt() / TAU;
        let errors = [1, 2].map(|fine| {
            let mesh = ring(a, b, 6.0, [24 * fine, 4 * fine, 1], 6);
            let reducer = GearReducer::new(mesh, material, options(&[Side::Left], 2, 0)).unwrap();
            let modes = reducer.modes(ModeChoice::Below { hz: 1.3 * wanted }).unwrap();
            // The mode with most of the turn's inertia.
            let about = |j: usize| modes.coupling()[j][5].abs();
            let torsion = (0..modes.count()).max_by(|&i, &j| about(i).total_cmp(&about(j))).unwrap();
            let found = modes.frequencies_hz()[torsion];
            println!("nu {poisson}, {fine}: {found:.1} Hz, {wanted:.1} by Bessel functions, {}", reducer.way().name());
            if let Some(waves) = modes.waves() {
                assert_eq!(waves[torsion], 0, "torsion has no waves about the axis");
            }
            found / wanted - 1.0
        });
        let order = (errors[0] / errors[1]).log2();
        println!("nu {poisson}: errors {:.2e}, {:.2e}, order {order:.2}", errors[0], errors[1]);
        assert!(errors[1] > 0.0 && errors[1] < 5e-3, "nu {poisson}: off by {:e}", errors[1]);
        assert!((order - 2.0).abs() < 0.2, "nu {poisson}: order {order}");
    }
}

/// What the modes leave of a window's compliance is a compliance, smaller with every mode, and nothing with all of
/// them.
#[test]
fn modes_and_residual_make_the_compliance() {
    let mesh = meshed(&gear(11, 20.0), 1, Extent::Whole);
    let reducer = GearReducer::new(mesh, Material::STEEL, options(&[Side::Left], 3, 0)).unwrap();
    let window = reducer.window(4).unwrap();
    let compliance = window.reduced.compliance();
    let mut last = f64::INFINITY;
    for count in [0, 1, 8, 40, 150, usize::MAX] {
        let modes = reducer.modes(ModeChoice::Count(count)).unwrap();
        assert!(modes.count() >= count.min(reducer.free_count()) && modes.count() <= reducer.free_count());
        let rest = compliance - modal_compliance(&modes, &reducer, &window);
        let (values, _) = fem::dense::symmetric_eigen(rest.as_ref()).unwrap();
        let trace: f64 = values.iter().sum::<f64>() / (0..compliance.nrows()).map(|i| compliance[(i, i)]).sum::<f64>();
        let most = values[values.len() - 1].max(compliance.norm_max());
        println!(
            "{} modes leave {:.4} of the trace, least eigenvalue {:.1e} of the largest",
            modes.count(),
            trace,
            values[0] / most
        );
        assert!(values[0] > -1e-9 * most, "{} modes: {:e}", modes.count(), values[0] / most);
        assert!(trace < last, "{} modes leave {trace} of the trace, fewer left {last}", modes.count());
        last = trace;
    }
    assert!(last.abs() < 1e-6, "all modes leave {last}");
}

/// Craig and Bampton's reduction stiffens: its frequencies come down to the gear's with every fixed-boundary mode, and
/// its modes make up the whole compliance.
#[test]
fn craig_bampton_comes_from_above() {
    let mesh = meshed(&gear(11, 20.0), 2, Extent::Whole);
    let options = options(&[Side::Left, Side::Right], 3, 0);
    let reducer = GearReducer::new(mesh.clone(), Material::STEEL, options.clone()).unwrap();
    let wanted = reducer.modes(ModeChoice::Count(16)).unwrap().frequencies_hz();
    let window = reducer.window(7).unwrap();
    let mut last: Vec<f64> = vec![f64::INFINITY; 16];
    for fixed in [0, 1, 2, 4, 8, 16] {
        let found = reducer.craig_bampton_modes(ModeChoice::Count(16), fixed).unwrap().frequencies_hz();
        println!(
            "{fixed} fixed modes a harmonic: off by {:.1e} at most, lowest by {:.1e}",
            worst(&found, &wanted),
            found[0] / wanted[0] - 1.0
        );
        for (j, ((f, l), w)) in found.iter().zip(&last).zip(&wanted).enumerate() {
            assert!(
                *f <= l * (1.0 + 1e-11) && *f >= w * (1.0 - 1e-11),
                "mode {j}, {fixed} fixed: {f} Hz, {l} before, {w} wanted"
            );
        }
        last = found;
    }
    assert!(worst(&last, &wanted) < 3e-3, "{:e}", worst(&last, &wanted));
    let all = reducer.craig_bampton_modes(ModeChoice::Count(usize::MAX), 2).unwrap();
    let whole = off(&modal_compliance(&all, &reducer, &window), window.reduced.compliance());
    println!("all {} modes: compliance off by {whole:.1e}", all.count());
    assert!(whole < 1e-9, "{whole:e}");
    // The whole gear at once has the same space, fixed modes or none.
    let general = GearReducer::general(mesh, Material::STEEL, options).unwrap();
    let [a, b] =
        [&reducer, &general].map(|r| r.craig_bampton_modes(ModeChoice::Count(16), 0).unwrap().frequencies_hz());
    assert!(worst(&a, &b) < 1e-9, "{:e}", worst(&a, &b));
}

/// One thread or two, the same bits.
#[test]
fn threads_change_nothing() {
    let mesh = meshed(&gear(13, 10.0), 2, Extent::Periodic);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let reducer = GearReducer::new(mesh.clone(), Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
            let modes = reducer.modes(ModeChoice::Count(12)).unwrap();
            let shapes = modes.on_window(&reducer, &reducer.window(3).unwrap()).unwrap();
            (modes.squares().to_vec(), shapes, reducer.lowest_frequencies().unwrap())
        })
    };
    assert!(run(1) == run(2), "modes depend on the number of threads");
}

/// Turning by a tooth takes the modes of a cyclic gear into each other: on the next window they are those of this one
/// times an orthogonal matrix, which after z teeth is 1. A gear that is not known by sectors has no such turn.
#[test]
fn a_tooth_further_modes_are_their_own_mixture() {
    let mesh = meshed(&gear(11, 20.0), 1, Extent::Whole);
    let options = options(&[Side::Left], 3, 0);
    let reducer = GearReducer::new(mesh.clone(), Material::STEEL, options.clone()).unwrap();
    for count in [1, 4, 15] {
        let modes = reducer.modes(ModeChoice::Count(count)).unwrap();
        let turn = modes.turned_by_teeth(1).expect("modes of one frequency are kept together");
        let whole = turn.pow(11) - DMatrix::identity(modes.count(), modes.count());
        assert!(whole.norm() < 1e-6, "{count} modes: after eleven teeth {:e} is left", whole.norm());
        // Turns add up, and one back is the inverse.
        let [on, back] = [14, -2].map(|teeth| modes.turned_by_teeth(teeth).unwrap());
        let [on, back] = [on - turn.pow(3), back - turn.pow(2).transpose()].map(|off| off.norm());
        assert!(on.max(back) < 1e-6, "{count} modes: three teeth on {on:e}, two back {back:e}");
        let on = |tooth: u32| {
            let shapes = modes.on_window(&reducer, &reducer.window(tooth).unwrap()).unwrap();
            DMatrix::from_fn(shapes.nrows(), shapes.ncols(), |i, j| shapes[(i, j)])
        };
        for tooth in [0, 4, 10] {
            let (here, next) = (on(tooth), on(tooth + 1));
            let off = (&here * &turn - &next).norm() / next.norm();
            assert!(off < 1e-6, "{} modes, tooth {tooth}: off by {off:e}", modes.count());
        }
    }
    let general = GearReducer::general(mesh, Material::STEEL, options).unwrap();
    assert!(general.modes(ModeChoice::Count(4)).unwrap().turned_by_teeth(1).is_none());
}
