//! Modes of a gear that spins, as patterns that stand in space.

use std::f64::consts::TAU;

use faer::Mat;
use fem::{DofMap, Material};
use geometry::Side;
use mesh::{Extent, MeshedGear};
use nalgebra::{DMatrix, Vector3};
use reduction::{GearModes, GearReducer, ModeChoice};

use crate::common::{gear, meshed, options};

/// Largest entry of a difference, over the largest of what is wanted.
fn off(found: &DMatrix<f64>, wanted: &DMatrix<f64>) -> f64 {
    (found - wanted).amax() / wanted.amax()
}

fn cyclic(teeth: u32, helix_deg: f64) -> (GearReducer, GearModes) {
    let whole = meshed(&gear(teeth, helix_deg), 1, 1, Extent::Whole);
    let reducer = GearReducer::new(whole, Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
    let modes = reducer.modes(ModeChoice::Count(20)).unwrap();
    (reducer, modes)
}

/// A pattern that stands still is met by the next tooth after a pitch: e^(2 pi/z N) is the turn by a tooth. Turns add up,
/// and keep lengths.
#[test]
fn a_turn_by_a_pitch_is_that_by_a_tooth() {
    let (_, modes) = cyclic(13, 15.0);
    let (standing, by_tooth) = (modes.standing().unwrap(), modes.turned_by_teeth(1).unwrap());
    let pitch = TAU / 13.0;
    assert!(off(&standing.turned(pitch), &by_tooth) < 1e-6, "{:e}", off(&standing.turned(pitch), &by_tooth));
    let twice = standing.turned(0.4) * standing.turned(1.1);
    assert!(off(&standing.turned(1.5), &twice) < 1e-6);
    let one = standing.turned(0.7).transpose() * standing.turned(0.7);
    assert!(off(&one, &DMatrix::identity(modes.count(), modes.count())) < 1e-6);
}

/// Inertia that modes share with rigid motion is that of a body of revolution: L D = e^(theta N) L at any angle, D the
/// turn of common axes into those of the gear.
#[test]
fn shared_inertia_turns_with_the_pattern() {
    let (_, modes) = cyclic(13, 15.0);
    let standing = modes.standing().unwrap();
    let shared = DMatrix::from_fn(modes.count(), 6, |j, axis| modes.coupling()[j][axis]);
    for angle in [0.3f64, 2.0, -1.2] {
        let (sin, cos) = angle.sin_cos();
        let mut own = DMatrix::<f64>::identity(6, 6);
        for at in [0, 3] {
            (own[(at, at)], own[(at, at + 1)]) = (cos, sin);
            (own[(at + 1, at)], own[(at + 1, at + 1)]) = (-sin, cos);
        }
        let (found, wanted) = (&shared * own, standing.turned(angle) * &shared);
        assert!(off(&found, &wanted) < 1e-6, "{angle} rad: {:e}", off(&found, &wanted));
    }
}

/// Products of a field over the whole mesh with the inertia of every mode, by the mass of all nodes.
fn products(gear: &MeshedGear, fields: [&[Vec<[f64; 3]>]; 2]) -> DMatrix<f64> {
    let nodes = gear.mesh().nodes.len();
    let mass = fem::assemble_mass(gear.mesh(), &Material::STEEL, &DofMap::new(nodes, &[])).unwrap();
    let [a, b] = fields.map(|own| Mat::from_fn(3 * nodes, own.len(), |row, j| own[j][row / 3][row % 3]));
    let all = fem::dense::product(a.transpose(), mass.multiply(b.as_ref()).unwrap().as_ref());
    DMatrix::from_fn(all.nrows(), all.ncols(), |i, j| all[(i, j)])
}

/// Gyroscopic matrices made sector by sector are those of all nodes: 2 (N + Phi' M (e_z x Phi)), and
/// L'N + the work of unit rates of the rigid motion on the velocity of what spins.
#[test]
fn gyroscopic_matrices_are_those_of_all_nodes() {
    let (reducer, modes) = cyclic(13, 15.0);
    let standing = modes.standing().unwrap();
    let gear = reducer.gear();
    let shapes: Vec<Vec<[f64; 3]>> = (0..modes.count()).map(|j| modes.field(&reducer, j).unwrap()).collect();
    let across = |u: &[f64; 3]| [-u[1], u[0], 0.0];
    let swept: Vec<Vec<[f64; 3]>> = shapes.iter().map(|own| own.iter().map(across).collect()).collect();
    // The rate of turning, out of small turns.
    let small = 1e-5;
    let rate = (standing.turned(small) - standing.turned(-small)) / (2.0 * small);
    let wanted = 2.0 * (&rate + products(gear, [&shapes, &swept]));
    assert!(off(&standing.gyroscopic, &wanted) < 1e-6, "{:e}", off(&standing.gyroscopic, &wanted));
    assert!((&standing.gyroscopic + standing.gyroscopic.transpose()).amax() < 1e-12 * wanted.amax());
    let unit = |k: usize| Vector3::from_fn(|i, _| f64::from(u8::from(i == k % 3)));
    let rigid = |k: usize, x: Vector3<f64>| if k < 3 { unit(k) } else { unit(k).cross(&x) };
    let places: Vec<Vector3<f64>> = gear.mesh().nodes.iter().map(|x| Vector3::from(*x)).collect();
    let field =
        |of: &dyn Fn(Vector3<f64>) -> Vector3<f64>| places.iter().map(|x| of(*x).into()).collect::<Vec<[f64; 3]>>();
    let motions: Vec<Vec<[f64; 3]>> = (0..6).map(|k| field(&|x| rigid(k, x))).collect();
    let mut wanted = products(gear, [&motions, &shapes]) * &rate + products(gear, [&motions, &swept]);
    // (e_k x u) . (e_z x r) of the tilts and the turn: a shape moves the place at which the spin is felt.
    let spun: Vec<[f64; 3]> = field(&|x| Vector3::z().cross(&x));
    for k in 3..6 {
        let moved: Vec<Vec<[f64; 3]>> =
            shapes.iter().map(|own| own.iter().map(|u| unit(k).cross(&Vector3::from(*u)).into()).collect()).collect();
        let more = products(gear, [std::slice::from_ref(&spun), &moved]);
        (0..modes.count()).for_each(|j| wanted[(k, j)] += more[(0, j)]);
    }
    assert!(off(&standing.coupling, &wanted) < 1e-6, "{:e}", off(&standing.coupling, &wanted));
}

/// A gear known as a whole has no standing patterns: nothing says that its teeth are alike.
#[test]
fn a_gear_known_as_a_whole_has_none() {
    let whole = meshed(&gear(11, 0.0), 1, 1, Extent::Whole);
    let reducer = GearReducer::general(whole, Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
    assert!(reducer.modes(ModeChoice::Count(6)).unwrap().standing().is_none());
}
