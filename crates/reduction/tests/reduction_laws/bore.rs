//! A bore that is held on part of its width, or by its means.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::collections::BTreeMap;

use crate::common::{gear, meshed, options};
use faer::Mat;
use fem::{DofMap, ElementOptions, Material, natural_modes};
use geometry::{Gear, Side};
use mesh::{BoreCoupling, Extent, Face, MeshError, MeshedGear};
use nalgebra::{DMatrix, DVector, Vector3};
use reduction::{FullGear, GearReducer, ModeChoice, ReductionError, ReductionRecord, ReductionWay, record_key};

/// A gear whose stiffness fits into a dense matrix.
fn small(order: u32, extent: Extent) -> (Gear, MeshedGear) {
    let gear = gear(11, 12.0);
    let mesh = meshed(&gear, order, 1, extent);
    (gear, mesh)
}

/// Integrals of the shape functions over some faces, mm^2, by a quadrature of its own: forces of a traction of 1.
fn integrals(mesh: &MeshedGear, faces: &[Face]) -> BTreeMap<u32, f64> {
    let (gauss, mut all) = (mesh::gauss_legendre(6), BTreeMap::new());
    for face in faces {
        for (&(a, wa), &(b, wb)) in gauss.iter().flat_map(|a| gauss.iter().map(move |b| (a, b))) {
            let (mut n, mut dn) = ([0.0; 9], [[0.0; 2]; 9]);
            face.kind.shape([a, b], &mut n);
            face.kind.shape_gradient([a, b], &mut dn);
            let mut t = [Vector3::zeros(); 2];
            for (i, &node) in face.nodes().iter().enumerate() {
                let at = Vector3::from(mesh.mesh().nodes[node as usize]);
                (0..2).for_each(|k| t[k] += dn[i][k] * at);
            }
            let area = wa * wb * t[0].cross(&t[1]).norm();
            for (i, &node) in face.nodes().iter().enumerate() {
                *all.entry(node).or_default() += n[i] * area;
            }
        }
    }
    all
}

/// The gear with all that it has to hold: K, and B of which B'u = 0.
struct Whole {
    dofs: DofMap,
    stiffness: DMatrix<f64>,
    mass: DMatrix<f64>,
    /// Sums over the held faces of u dA and x x u dA, by a quadrature of its own.
    means: DMatrix<f64>,
}

impl Whole {
    fn new(mesh: &MeshedGear) -> Self {
        let dofs = DofMap::new(mesh.mesh().nodes.len(), &[]);
        let dense = |m: fem::SymmetricMatrix| {
            let m = m.to_dense();
            DMatrix::from_fn(m.nrows(), m.ncols(), |i, j| m[(i, j)])
        };
        let elements = ElementOptions::default();
        let stiffness = dense(fem::assemble_stiffness(mesh.mesh(), &Material::STEEL, &dofs, &elements).unwrap());
        let mass = dense(fem::assemble_mass(mesh.mesh(), &Material::STEEL, &dofs).unwrap());
        let mut means = DMatrix::zeros(stiffness.nrows(), 6);
        for (node, weight) in integrals(mesh, &mesh.bore().faces) {
            for axis in 0..3 {
                let row = dofs.dof(node, axis).unwrap();
                let unit = Vector3::from_fn(|k, _| f64::from(u8::from(k == axis)));
                let arm = Vector3::from(mesh.mesh().nodes[node as usize]).cross(&unit);
                means[(row, axis)] += weight;
                (0..3).for_each(|k| means[(row, 3 + k)] += weight * arm[k]);
            }
        }
        Self { dofs, stiffness, mass, means }
    }

    /// Displacements and reactions under forces, of [K B; B' 0].
    fn solve(&self, forces: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
        let n = self.stiffness.nrows();
        let mut all = DMatrix::zeros(n + 6, n + 6);
        all.view_mut((0, 0), (n, n)).copy_from(&self.stiffness);
        all.view_mut((0, n), (n, 6)).copy_from(&(1e3 * &self.means));
        all.view_mut((n, 0), (6, n)).copy_from(&(1e3 * self.means.transpose()));
        let mut right = DMatrix::zeros(n + 6, forces.ncols());
        right.view_mut((0, 0), (n, forces.ncols())).copy_from(forces);
        let found = all.lu().solve(&right).unwrap();
        (found.rows(0, n).into_owned(), 1e3 * found.rows(n, 6).into_owned())
    }
}

fn by_means(mesh: MeshedGear) -> MeshedGear {
    mesh.coupled(BoreCoupling::Distributing)
}

fn off(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    assert_eq!((a.nrows(), a.ncols()), (b.nrows(), b.ncols()));
    (a - b).norm_max() / b.norm_max()
}

/// Least and largest eigenvalue of a symmetric difference over the largest of `b`.
fn range(a: &Mat<f64>, b: &Mat<f64>) -> [f64; 2] {
    let values = DMatrix::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)] - b[(i, j)]).symmetric_eigenvalues();
    let size = b.norm_max();
    [values.min() / size, values.max() / size]
}

/// Compliance, field, reactions: the whole gear with Lagrange multipliers for six means gives the same, with linear and
/// quadratic faces, the whole bore and a part of it.
#[test]
fn a_mean_seat_is_that_of_the_whole_gear() {
    let all = [-4.0, 4.0];
    // Two elements along the face, so that half of them can be held.
    let both = [(1, 1, all), (2, 1, all), (1, 2, [0.0, 4.0])].into_iter().flat_map(|own| [(own, false), (own, true)]);
    for ((order, fine, held), general) in both {
        let mesh = meshed(&gear(11, 12.0), order, fine, Extent::Whole).held_between(held).unwrap();
        let mesh = by_means(mesh);
        let whole = Whole::new(&mesh);
        let make = if general { GearReducer::general } else { GearReducer::new };
        let reducer = make(mesh, Material::STEEL, options(&[Side::Left], 2, 10)).unwrap();
        assert_eq!(reducer.way(), if general { ReductionWay::General } else { ReductionWay::CyclicSector });
        let window = reducer.window(10).unwrap();
        let nodes = &window.reduced.nodes;
        let row = |i: usize| whole.dofs.dof(nodes[i / 3], i % 3).unwrap();
        let n = 3 * nodes.len();
        let unit = DMatrix::from_fn(whole.stiffness.nrows(), n, |i, j| f64::from(u8::from(i == row(j))));
        let (u, reactions) = whole.solve(&unit);
        let exact = Mat::from_fn(n, n, |i, j| u[(row(i), j)]);
        let c = off(window.reduced.compliance(), &exact);
        // A field of one uneven load, and what holds it.
        let f = DVector::from_fn(n, |i, _| if i % 3 == 1 { -5.0 } else { 2.0 * (0.3 * i as f64).sin() });
        let moved: Vec<f64> = (0..n).map(|i| (0..n).map(|j| exact[(i, j)] * f[j]).sum()).collect();
        let field = reducer.expand(&window, &moved).unwrap();
        let wanted = &u * &f;
        let largest = wanted.amax();
        let apart = (0..wanted.len()).fold(0.0f64, |m, i| {
            let (node, axis) = whole.dofs.node_and_axis(i).unwrap();
            m.max((field[node as usize][axis] - wanted[i]).abs() / largest)
        });
        let own = DVector::from_fn(wanted.len(), |i, _| {
            let (node, axis) = whole.dofs.node_and_axis(i).unwrap();
            field[node as usize][axis]
        });
        let mean = (whole.means.transpose() * &own).amax() / (whole.means.amax() * largest);
        // K u = f - B l: only the bore is held, and the sums of forces and moments are those of the load.
        let left = &unit * &f - &whole.stiffness * &own - &whole.means * (&reactions * &f);
        let sums = |force: &DVector<f64>| {
            let mut sum = [Vector3::zeros(); 2];
            for i in 0..force.len() {
                let (node, axis) = whole.dofs.node_and_axis(i).unwrap();
                let one = Vector3::from_fn(|k, _| if k == axis { force[i] } else { 0.0 });
                sum[0] += one;
                sum[1] += Vector3::from(reducer.gear().mesh().nodes[node as usize]).cross(&one);
            }
            sum
        };
        let [load, held] = [sums(&(&unit * &f)), sums(&(&whole.means * (&reactions * &f)))];
        let balance = (load[0] - held[0]).norm() / load[0].norm() + (load[1] - held[1]).norm() / load[1].norm();
        println!(
            "order {order}, {:?}: C {c:.1e}, field {apart:.1e}, means {mean:.1e}, left {:.1e}, balance {balance:.1e}",
            reducer.way(),
            left.amax()
        );
        assert!(c < 1e-8, "order {order}: C differs by {c:e} of its largest entry");
        assert!(apart < 1e-8, "order {order}: the field differs by {apart:e} of its largest entry");
        // Areas of curved faces depend on the rule that they are summed up by.
        assert!(mean < 3e-8, "order {order}: the bore has a mean motion of {mean:e} of the largest displacement");
        assert!(left.amax() < 3e-5 * f.amax(), "order {order}: {:e} N are left over", left.amax());
        assert!(balance < 1e-8, "order {order}: reactions differ from the load by {balance:e}");
    }
}

/// The whole bore held rigidly is what it always was, to the bit, either way of reduction; what holds less is softer.
#[test]
fn holding_less_is_softer() {
    let gear = gear(12, 0.0);
    let reduced = |mesh: MeshedGear, general: bool| {
        let make = if general { GearReducer::general } else { GearReducer::new };
        make(mesh, Material::STEEL, options(&[Side::Left], 2, 0)).unwrap().window(0).unwrap().reduced
    };
    let mesh = |extent| meshed(&gear, 1, 4, extent);
    for (extent, general) in [(Extent::Whole, false), (Extent::Periodic, false), (Extent::Whole, true)] {
        let as_it_was = reduced(mesh(extent), general);
        let all = reduced(mesh(extent).held_between([-4.0, 4.0]).unwrap(), general);
        assert_eq!(as_it_was.nodes, all.nodes);
        assert!(as_it_was.compliance() == all.compliance(), "{extent:?}: held on all of its width is another gear");
        let half = reduced(mesh(extent).held_between([-4.0, 0.0]).unwrap(), general);
        let middle = reduced(mesh(extent).held_between([-2.0, 0.0]).unwrap(), general);
        let [least, most] = range(half.compliance(), all.compliance());
        assert!(least > -1e-9 && most > 0.05, "{extent:?}: half of the bore: {least:e} .. {most:e}");
        let [least, most] = range(middle.compliance(), half.compliance());
        assert!(least > -1e-9 && most > 0.02, "{extent:?}: a quarter of the bore: {least:e} .. {most:e}");
    }
    let kinematic = reduced(mesh(Extent::Whole), true);
    let distributing = reduced(by_means(mesh(Extent::Whole)), true);
    let [least, most] = range(distributing.compliance(), kinematic.compliance());
    println!("distributing beside kinematic: {least:.1e} .. {most:.3} of the largest compliance");
    assert!(least > -1e-9 && most > 0.05, "{least:e} .. {most:e}");
    // A sector stands for the whole gear.
    let sector = reduced(by_means(mesh(Extent::Periodic)), false);
    let apart = range(sector.compliance(), distributing.compliance()).map(f64::abs);
    assert!(apart[0].max(apart[1]) < 1e-9, "a sector: {apart:?}");
}

/// Windows of a gear that is cyclic are alike: the matrices of one, turned, are those of another.
#[test]
fn a_mean_seat_favours_no_tooth() {
    let (gear, mesh) = small(1, Extent::Whole);
    let of = |first: u32| {
        GearReducer::new(by_means(mesh.clone()), Material::STEEL, options(&[Side::Left], 2, first)).unwrap()
    };
    let (a, b) = (of(0), of(4));
    let [c, d] = [a.window(0).unwrap().reduced, b.window(4).unwrap().reduced];
    let (sin, cos) = (4.0 * gear.pitch_angle()).sin_cos();
    let turn = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
    // Nodes of window 4 at the places of those of window 0, turned.
    let nodes = &mesh.mesh().nodes;
    let turned = |x: [f64; 3]| turn.map(|row| (0..3).map(|k| row[k] * x[k]).sum::<f64>());
    let image: Vec<usize> = (c.nodes.iter())
        .map(|&n| {
            let at = turned(nodes[n as usize]);
            let near = |m: &u32| (0..3).all(|k| (nodes[*m as usize][k] - at[k]).abs() < 1e-9);
            d.nodes.iter().position(near).unwrap()
        })
        .collect();
    let n = c.compliance().nrows();
    let wanted = Mat::from_fn(n, n, |i, j| {
        let at = |a: usize, b: usize| d.compliance()[(3 * image[i / 3] + a, 3 * image[j / 3] + b)];
        (0..3).map(|p| (0..3).map(|q| turn[p][i % 3] * at(p, q) * turn[q][j % 3]).sum::<f64>()).sum()
    });
    let apart = off(c.compliance(), &wanted);
    println!("windows of teeth 0 and 4, turned: {apart:.1e}");
    assert!(apart < 1e-9, "{apart:e}");
}

/// Natural modes with the means held: those of the dense matrices on the motions that have no means.
#[test]
fn modes_of_a_mean_seat_are_those_of_the_whole_gear() {
    let (_, mesh) = small(1, Extent::Whole);
    let whole = Whole::new(&by_means(mesh.clone()));
    let n = whole.stiffness.nrows();
    // A basis of B'u = 0.
    let q = whole.means.clone().insert_columns(6, 0, 0.0);
    let full = DMatrix::from_fn(n, n, |i, j| if j < 6 { q[(i, j)] } else { f64::from(u8::from(i == j)) });
    let basis = full.qr().q().columns(6, n - 6).into_owned();
    let of = |m: &DMatrix<f64>| {
        let m = basis.transpose() * m * &basis;
        0.5 * (&m + m.transpose())
    };
    let wanted = natural_modes(&of(&whole.stiffness), &of(&whole.mass)).unwrap();
    let make = |mesh| GearReducer::new(mesh, Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
    let free = make(by_means(mesh.clone()));
    let found = free.modes(ModeChoice::Count(6)).unwrap().frequencies_hz();
    // Flanks held: all harmonics of the ring together.
    let general = GearReducer::general(by_means(mesh.clone()), Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
    let [own, other] = [&free, &general].map(|reducer| reducer.lowest_frequencies().unwrap().flanks_held_hz);
    println!("flanks held: {own:.1} Hz by sectors, {other:.1} Hz by the whole");
    assert!((own / other - 1.0).abs() < 1e-6, "flanks held: {own} Hz by sectors, {other} Hz by the whole");
    let rigid = make(mesh).modes(ModeChoice::Count(6)).unwrap().frequencies_hz();
    for (i, hz) in found.iter().enumerate() {
        let exact = wanted.frequencies[i] / std::f64::consts::TAU;
        let stiffer = rigid.get(i).copied().unwrap_or(f64::INFINITY);
        println!("mode {}: {hz:.1} Hz, whole gear {exact:.1}, rigid bore {stiffer:.1}", i + 1);
        assert!((hz / exact - 1.0).abs() < 1e-6, "mode {}: {hz} beside {exact} Hz", i + 1);
        assert!(*hz < stiffer, "mode {}: a rigid bore holds more", i + 1);
    }
}

/// What a bore that is held by its means gives beside a rigid one, under a traction on a flank, settles as the mesh
/// grows finer.
#[test]
fn a_mean_seat_settles_with_the_mesh() {
    let gear = gear(12, 0.0);
    let given = |fine: u32| {
        let mesh = meshed(&gear, 2, fine, Extent::Whole);
        let pressed = integrals(&mesh, mesh.flank(0, Side::Left).unwrap());
        let work = |mesh: MeshedGear| {
            let reducer = GearReducer::new(mesh, Material::STEEL, options(&[Side::Left], 1, 0)).unwrap();
            let reduced = reducer.window(0).unwrap().reduced;
            let f = |i: usize| if i % 3 == 1 { pressed[&reduced.nodes[i / 3]] } else { 0.0 };
            let n = reduced.compliance().nrows();
            (0..n).map(|i| (0..n).map(|j| f(i) * reduced.compliance()[(i, j)] * f(j)).sum::<f64>()).sum::<f64>()
        };
        let area: f64 = pressed.values().sum();
        (work(by_means(mesh.clone())) - work(mesh)) / area.powi(2)
    };
    let [a, b, c] = [1, 2, 3].map(given);
    println!("compliance beyond that of a rigid bore: {a:.4e}, {b:.4e}, {c:.4e} mm/N");
    assert!(c > 0.0 && (c - b).abs() < 0.02 * c && (c - b).abs() < 0.5 * (b - a).abs(), "{a} {b} {c}");
}

/// Records know how the bore was held, and bring it back.
#[test]
fn records_know_the_bore() {
    let (geometry, mesh) = small(1, Extent::Whole);
    let options = options(&[Side::Left], 2, 0);
    let key = |mesh: &MeshedGear| record_key(mesh, &geometry, &Material::STEEL, &options, "auto");
    let means = by_means(mesh.clone());
    let fine = meshed(&geometry, 1, 2, Extent::Whole);
    let part = fine.clone().held_between([0.0, 4.0]).unwrap();
    assert_ne!(key(&mesh), key(&means), "coupling");
    assert_ne!(key(&fine), key(&part), "held part");
    assert_eq!(key(&mesh), key(&mesh.clone().held_between([-4.0, 4.0]).unwrap()), "all of it is all of it");
    let reducer = GearReducer::new(means.clone(), Material::STEEL, options.clone()).unwrap();
    let bytes = reducer.record().unwrap().to_bytes(&key(&means));
    let record = ReductionRecord::from_bytes(&bytes, &key(&means)).unwrap();
    let stored = GearReducer::from_record(means, Material::STEEL, options, record).unwrap();
    let (a, b) = (stored.window(3).unwrap(), reducer.window(3).unwrap());
    assert!(stored.is_from_record() && a.reduced.compliance() == b.reduced.compliance());
    let u: Vec<f64> = (0..a.reduced.coordinates()).map(|i| 1e-3 * (i as f64).cos()).collect();
    assert_eq!(stored.expand(&a, &u).unwrap(), reducer.expand(&b, &u).unwrap());
}

/// What cannot be held so is told.
#[test]
fn impossible_seats_are_refused() {
    let (_, mesh) = small(1, Extent::Whole);
    let error = mesh.clone().held_between([1.0, 1.5]).unwrap_err();
    assert!(matches!(error, MeshError::NotHeld { .. }), "{error}");
    let error = FullGear::new(by_means(mesh), Material::STEEL, &ElementOptions::default()).unwrap_err();
    assert!(matches!(error, ReductionError::NotReduced), "{error}");
}
