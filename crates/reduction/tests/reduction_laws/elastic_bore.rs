//! A bore that stands on springs all around.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::PI;

use crate::common::{gear, meshed, options};
use faer::Mat;
use fem::{DofMap, ElementOptions, Material, natural_modes};
use geometry::{Gear, GearData, Side};
use mesh::{BoreCoupling, Extent, Foundation, GroupNames, MeshError, MeshedGear, StructuredOptions};
use nalgebra::{DMatrix, Matrix3, Vector3};
use reduction::{FullGear, GearReducer, ModeChoice, ReductionWay, record_key};

fn on_springs(mesh: MeshedGear, stiffness: [f64; 3]) -> MeshedGear {
    mesh.coupled(BoreCoupling::Elastic(Foundation::new(stiffness, None).unwrap()))
}

fn dense(matrix: &fem::SymmetricMatrix) -> DMatrix<f64> {
    let matrix = matrix.to_dense();
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)])
}

fn off(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    assert_eq!((a.nrows(), a.ncols()), (b.nrows(), b.ncols()));
    (a - b).norm_max() / b.norm_max()
}

/// K of a whole gear and of its springs, put together face by face with the points of Gauss's rule that are enough for two
/// shape functions on a plane face, and M.
fn whole(mesh: &MeshedGear, order: u32, [radial, tangential, axial]: [f64; 3]) -> (DofMap, [DMatrix<f64>; 2]) {
    let dofs = DofMap::new(mesh.mesh().nodes.len(), &[]);
    let system = fem::assemble(mesh.mesh(), &Material::STEEL, &dofs, &ElementOptions::default()).unwrap();
    let [mut stiffness, mass] = [&system.stiffness, &system.mass].map(dense);
    let gauss = mesh::gauss_legendre(order as usize + 1);
    for face in &mesh.bore().faces {
        for (&(a, wa), &(b, wb)) in gauss.iter().flat_map(|a| gauss.iter().map(move |b| (a, b))) {
            let (mut n, mut dn) = ([0.0; 9], [[0.0; 2]; 9]);
            face.kind.shape([a, b], &mut n);
            face.kind.shape_gradient([a, b], &mut dn);
            let at = |i: usize| Vector3::from(mesh.mesh().nodes[face.nodes()[i] as usize]);
            let sum = |of: &dyn Fn(usize) -> f64| (0..face.nodes().len()).map(|i| of(i) * at(i)).sum::<Vector3<f64>>();
            let area = wa * wb * sum(&|i| dn[i][0]).cross(&sum(&|i| dn[i][1])).norm();
            let x = sum(&|i| n[i]);
            let outward = Vector3::new(x.x, x.y, 0.0).normalize();
            let along = Vector3::z().cross(&outward);
            let springs = radial * outward * outward.transpose()
                + tangential * along * along.transpose()
                + Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, axial));
            for (i, &p) in face.nodes().iter().enumerate() {
                for (j, &q) in face.nodes().iter().enumerate() {
                    for (k, m) in (0..3).flat_map(|k| (0..3).map(move |m| (k, m))) {
                        let at = (dofs.dof(p, k).unwrap(), dofs.dof(q, m).unwrap());
                        stiffness[at] += area * n[i] * n[j] * springs[(k, m)];
                    }
                }
            }
        }
    }
    (dofs, [stiffness, mass])
}

/// Compliance, field, frequencies of a gear on springs are those of dense matrices of the whole gear, by one sector and by one
/// factor, with linear and quadratic faces, of a gear and of a part of its bore; with all degrees of freedom it has their K.
#[test]
fn an_elastic_bore_is_springs_under_the_whole_gear() {
    let springs = [4e3, 7e2, 1e3];
    for (order, beta, held) in [(1, 12.0, [-4.0, 4.0]), (2, 0.0, [-4.0, 4.0]), (1, 12.0, [0.0, 4.0])] {
        let exact = gear(11, beta);
        let fine = if held[0] < 0.0 { 1 } else { 2 };
        let mesh = |extent| on_springs(meshed(&exact, order, fine, extent).held_between(held).unwrap(), springs);
        let (dofs, [stiffness, mass]) = whole(&mesh(Extent::Whole), order, springs);
        let inverse = stiffness.clone().cholesky().unwrap();
        // Dense frequencies of a larger mesh take a minute.
        let small = order == 1 && fine == 1;
        let hz = small.then(|| natural_modes(&stiffness, &mass).unwrap().frequencies[0] / (2.0 * PI));
        for (way, extent) in [
            (ReductionWay::CyclicSector, Extent::Whole),
            (ReductionWay::CyclicSector, Extent::Periodic),
            (ReductionWay::General, Extent::Whole),
        ] {
            let make = if way == ReductionWay::General { GearReducer::general } else { GearReducer::new };
            let reducer = make(mesh(extent), Material::STEEL, options(&[Side::Left], 2, 10)).unwrap();
            assert_eq!(reducer.way(), way);
            let window = reducer.window(10).unwrap();
            // A sector's copies are numbered in an order of their own.
            let place = |x: [f64; 3]| {
                let near = |m: &[f64; 3]| (0..3).all(|k| (m[k] - x[k]).abs() < 1e-9);
                mesh(Extent::Whole).mesh().nodes.iter().position(near).unwrap() as u32
            };
            let turn = reducer.frame_angle(&window);
            assert!(turn.abs() < 1e-12, "{turn}");
            let own = &reducer.gear().mesh().nodes;
            let nodes: Vec<u32> = window.reduced.nodes.iter().map(|&n| place(own[n as usize])).collect();
            let n = 3 * nodes.len();
            let row = |i: usize| dofs.dof(nodes[i / 3], i % 3).unwrap();
            let unit = DMatrix::from_fn(stiffness.nrows(), n, |i, j| f64::from(u8::from(i == row(j))));
            let moved = inverse.solve(&unit);
            let wanted = Mat::from_fn(n, n, |i, j| moved[(row(i), j)]);
            let c = off(window.reduced.compliance(), &wanted);
            // A field of one uneven load, where the bore is.
            let f: Vec<f64> = (0..n).map(|i| if i % 3 == 1 { -5.0 } else { 2.0 * (0.3 * i as f64).sin() }).collect();
            let bore = reducer.gear().bore_nodes().to_vec();
            let field = reducer.expand_under(&window, &[&f], &bore).unwrap().remove(0);
            let wanted = moved * nalgebra::DVector::from_column_slice(&f);
            let mut apart = 0.0f64;
            for (node, u) in bore.iter().zip(&field) {
                let at = place(own[*node as usize]);
                (0..3).for_each(|k| apart = apart.max((u[k] - wanted[dofs.dof(at, k).unwrap()]).abs()));
            }
            let apart = apart / wanted.amax();
            let lowest = hz.map_or(0.0, |hz| reducer.lowest_elastic_hz().unwrap() / hz - 1.0);
            println!("order {order}, {way:?}, {extent:?}: C off by {c:.1e}, bore {apart:.1e}, {hz:?} Hz {lowest:.1e}");
            assert!(c < 1e-10 && apart < 1e-10, "order {order}, {way:?}: C {c:e}, bore {apart:e}");
            assert!(lowest.abs() < 1e-8, "order {order}, {way:?}: {lowest:e} of {hz:?} Hz");
        }
        let full = FullGear::new(mesh(Extent::Whole), Material::STEEL, &ElementOptions::default()).unwrap();
        let apart = (dense(&full.stiffness) - &stiffness).amax() / stiffness.amax();
        assert!(apart < 1e-13, "order {order}: K of all freedoms is off by {apart:e}");
    }
}

/// Springs that grow become a rigid bore: what is left falls with their stiffness.
#[test]
fn stiff_springs_are_a_rigid_bore() {
    for extent in [Extent::Periodic, Extent::Whole] {
        let mesh = meshed(&gear(12, 15.0), 1, 2, extent);
        let of = |mesh| GearReducer::new(mesh, Material::STEEL, options(&[Side::Right], 2, 0)).unwrap();
        let c = |mesh| of(mesh).window(0).unwrap().reduced.compliance().clone();
        let rigid = c(mesh.clone());
        let [soft, stiff] = [1e8, 1e10].map(|k| off(&c(on_springs(mesh.clone(), [k, k, k])), &rigid));
        println!("{extent:?}: {soft:.2e} and {stiff:.2e} of the largest compliance beside a rigid bore");
        assert!(stiff > 0.0 && soft < 0.02, "{extent:?}: {soft:e}, {stiff:e}");
        assert!((soft / stiff - 100.0).abs() < 2.0, "{extent:?}: {soft:e}, {stiff:e}");
    }
}

/// Soft springs carry a rigid gear: it moves and turns as a cylinder of springs lets it, with area A, radius r, width b.
///
/// ```text
/// along x, y: A (k_r + k_t)/2    z: A k_a    about x, y: A [(k_r + k_t)/2 b^2/12 + k_a r^2/2]    about z: A k_t r^2
/// ```
#[test]
fn a_gear_on_soft_springs_is_a_rigid_body() {
    let exact = gear(30, 0.0);
    let [radial, tangential, axial] = [3e-3, 2e-3, 1e-3];
    let mesh = on_springs(meshed(&exact, 2, 2, Extent::Periodic), [radial, tangential, axial]);
    let of_mesh = mesh.rigid_springs().unwrap().unwrap();
    let reducer = GearReducer::new(mesh, Material::STEEL, options(&[Side::Left], 1, 0)).unwrap();
    let reduced = reducer.window(0).unwrap().reduced;
    let (r, b) = (0.5 * exact.data().bore_diameter, exact.data().face_width);
    let (area, across) = (2.0 * PI * r * b, 0.5 * (radial + tangential));
    let tilt = area * (across * b * b / 12.0 + 0.5 * axial * r * r);
    let stiffness = [area * across, area * across, area * axial, tilt, tilt, area * tangential * r * r];
    for (k, wanted) in stiffness.into_iter().enumerate() {
        let off = of_mesh[(k, k)] / wanted - 1.0;
        assert!(off.abs() < 1e-4, "axis {k}: {} beside {wanted}", of_mesh[(k, k)]);
    }
    let nodes = &reducer.gear().mesh().nodes;
    let motion = |i: usize, k: usize| {
        let x = Vector3::from(nodes[reduced.nodes[i / 3] as usize]);
        let unit = Vector3::from_fn(|a, _| f64::from(u8::from(a == k % 3)));
        if k < 3 { unit[i % 3] } else { unit.cross(&x)[i % 3] }
    };
    let n = reduced.coordinates();
    let of = |i: usize, j: usize| (0..6).map(|k| motion(i, k) * motion(j, k) / stiffness[k]).sum::<f64>();
    let apart = off(reduced.compliance(), &Mat::from_fn(n, n, of));
    println!("off by {apart:.1e}");
    // Of the whole: how far a mesh of 30 curved faces is from a cylinder, and what the body yields beside its springs.
    assert!(apart < 1e-4, "{apart:e}");
}

/// The body of a planet (36 teeth, module 21 mm) between sun and ring, on a bearing of 2000 N/mm^3 all around, by the rim over
/// the module, beside figures of a plane annulus without teeth by its Fourier series, 1e-3 um/(N/mm): rigid bores 3.8, 5.0, 8.1;
/// on the bearing 21, 16.4, 13.3; sun and ring feel each other by 0 and, on the bearing, 7.4. Differences tell of the body alone,
/// whatever the tooth yields. A narrow gear is in plane stress; of a material with E/(1 - nu^2) and nu/(1 - nu) that is the plane
/// strain of steel.
#[test]
fn a_planet_on_a_bearing_yields_as_a_plane_annulus_does() {
    let near = |what: &str, found: f64, wanted: f64| {
        println!("{what}: {found:.2}, plane annulus {wanted:.1}");
        // Figures of two digits, and teeth on the rim.
        assert!((found / wanted - 1.0).abs() < 0.08, "{what}: {found} beside {wanted}");
    };
    let mut before: Option<(f64, f64)> = None;
    for (rim, rigid_bore, bearing_all_around, between) in
        [(2.0, 3.8, 21.0, None), (3.0, 5.0, 16.4, Some(7.4)), (6.0, 8.1, 13.3, None)]
    {
        let data = GearData {
            teeth: 36,
            normal_module: 21.0,
            profile_shift: 0.5039,
            face_width: 21.0,
            bore_diameter: 100.0,
            ..GearData::default()
        };
        let root = Gear::new(data.clone()).unwrap().root_radius();
        let exact = Gear::new(GearData { bore_diameter: 2.0 * (root - rim * 21.0), ..data }).unwrap();
        let made = StructuredOptions {
            order: 2,
            elements_profile: 6,
            elements_fillet: 4,
            elements_thickness: 4,
            elements_face: 2,
            elements_rim: 6,
            extent: Extent::Periodic,
        };
        let steel = Material::STEEL;
        let (young, poisson) =
            (steel.young_mpa() / (1.0 - steel.poisson().powi(2)), steel.poisson() / (1.0 - steel.poisson()));
        let material = Material::new(young, poisson, steel.density_t_per_mm3()).unwrap();
        let mesh = mesh::generate(&exact, &made).unwrap();
        let mesh = MeshedGear::from_groups(mesh, &GroupNames::default(), 36).unwrap();
        // Hardly anything along the circumference: the turn of the whole gear, which the forces of sun and ring do not make, is
        // taken off.
        let bearing = [2e3, 2.0, 2.0];
        let r = 0.5 * exact.data().bore_diameter;
        let of = |mesh: MeshedGear, held: bool| {
            let made = |side| GearReducer::new(mesh.clone(), material, options(&[side], 1, 0)).unwrap();
            // Sun and ring on opposite teeth, on flanks of either side; both press in the same direction across.
            let (ring, sun) = (made(Side::Right), made(Side::Left));
            let windows = [(&ring, ring.window(0).unwrap()), (&sun, sun.window(18).unwrap())];
            let c =
                GearReducer::compliance_of(&[(windows[0].0, &windows[0].1), (windows[1].0, &windows[1].1)]).unwrap();
            let mut loads = Vec::new();
            for (k, alpha) in [15.63f64, 24.169].into_iter().enumerate() {
                let (reducer, window) = &windows[k];
                loads.push(pressed(reducer, window, alpha.to_radians(), k == 1));
            }
            let n = loads[0].0.len();
            let full = |k: usize, i: usize| {
                if (i < n) == (k == 0) { loads[k].0[i - k * n] } else { 0.0 }
            };
            let turn = |a: usize, b: usize| {
                if held { 0.0 } else { loads[a].1 * loads[b].1 / (2.0 * PI * r.powi(3) * bearing[1]) }
            };
            let work = |a: usize, b: usize| {
                let sum: f64 =
                    (0..2 * n).map(|i| (0..2 * n).map(|j| full(a, i) * c[(i, j)] * full(b, j)).sum::<f64>()).sum();
                sum * exact.data().face_width - turn(a, b)
            };
            [work(0, 0), work(1, 1), work(0, 1)].map(|c| 1e6 * c)
        };
        let rigid = of(mesh.clone(), true);
        let on_bearing = of(on_springs(mesh, bearing), false);
        let own = |[sun, ring, _]: [f64; 3]| 0.5 * (sun + ring);
        near(&format!("rim {rim}: softer on a bearing"), own(on_bearing) - own(rigid), bearing_all_around - rigid_bore);
        if let Some((thinner, figure)) = before.replace((own(rigid), rigid_bore)) {
            near(&format!("rim {rim}: softer than a thinner one"), own(rigid) - thinner, rigid_bore - figure);
        }
        if let Some(between) = between {
            near(&format!("rim {rim}: between sun and ring"), on_bearing[2], between);
        }
        assert!(rigid[2].abs() < 0.05, "rim {rim}: a rigid bore passes on {}", rigid[2]);
    }
}

/// A force of 1 N into a flank at its foot, where it hardly bends the tooth, spread along the face, at an angle (rad) to the
/// tangent; and its moment about the axis, N mm.
fn pressed(reducer: &GearReducer, window: &reduction::Window, alpha: f64, counter_clockwise: bool) -> (Vec<f64>, f64) {
    let nodes = &reducer.gear().mesh().nodes;
    let at = |&n: &u32| Vector3::from(nodes[n as usize]);
    let of = |n: &u32| at(n).xy().norm();
    let foot = window.reduced.nodes.iter().map(of).fold(f64::INFINITY, f64::min);
    let row = |n: &u32| (of(n) - foot).abs() < 1e-6;
    let count = window.reduced.nodes.iter().filter(|n| row(n)).count() as f64;
    let (mut load, mut moment) = (Vec::new(), 0.0);
    for n in &window.reduced.nodes {
        let outward = Vector3::new(at(n).x, at(n).y, 0.0).normalize();
        // The left flank is the counter-clockwise one: what presses it pushes clockwise.
        let across = Vector3::z().cross(&outward) * if counter_clockwise { -1.0 } else { 1.0 };
        let force = if row(n) { (alpha.cos() * across - alpha.sin() * outward) / count } else { Vector3::zeros() };
        moment += at(n).cross(&force).z;
        load.extend([force.x, force.y, force.z]);
    }
    (load, moment)
}

/// Records know the springs, and two gears on different ones are not one body.
#[test]
fn records_know_the_springs() {
    let exact = gear(11, 12.0);
    let mesh = meshed(&exact, 1, 1, Extent::Periodic);
    let options = options(&[Side::Left], 2, 0);
    let key = |mesh: &MeshedGear| record_key(mesh, &exact, &Material::STEEL, &options, "auto");
    let [a, b] = [[1e3, 1e3, 1e3], [1e3, 1e3, 2e3]].map(|k| on_springs(mesh.clone(), k));
    assert_ne!(key(&a), key(&b));
    assert_ne!(key(&a), key(&mesh));
    let made = |mesh: &MeshedGear| GearReducer::new(mesh.clone(), Material::STEEL, options.clone()).unwrap();
    let [a, b, same] = [&a, &b, &a].map(made);
    assert!(a.has_body_of(&same).unwrap() && !a.has_body_of(&b).unwrap());
    assert!(a.compliance_between(&a.window(0).unwrap(), (&b, &b.window(3).unwrap())).is_err());
    assert!(a.modes(ModeChoice::Count(2)).unwrap().frequencies_hz()[0] > 0.0);
}

/// What lets the gear go is refused.
#[test]
fn springs_that_leave_a_gear_free_are_refused() {
    for (springs, said) in [
        ([1.0, 0.0, 1.0], "turn about its axis: it has no tangential"),
        ([1.0, 1.0, 0.0], "move along its axis: it has no axial"),
        ([-1.0, 1.0, 1.0], "-1 N/mm^3"),
        ([1.0, f64::NAN, 1.0], "NaN"),
    ] {
        let error: MeshError = Foundation::new(springs, None).unwrap_err();
        assert!(error.to_string().contains(said) && error.hint().is_some(), "{error}");
    }
    assert!(Foundation::new([0.0, 1.0, 1.0], None).is_ok(), "what turns and slides on springs is held across too");
}
