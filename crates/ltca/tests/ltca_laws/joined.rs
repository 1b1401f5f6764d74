//! Contacts of meshes that have a gear in common.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::{SlidingWindow, Station};
use contact::{
    ContactSet, Pose, opening,
    pose::{displaced, frames},
    slice::{CommonGear, JoinedContacts, MeshContact, SameSlices},
};
use faer::Mat;
use geometry::{Driver, Gear, GearData, GearPair};
use ltca::StaticOptions;
use mesh::{Extent, StructuredOptions};
use reduction::ElasticGear;
use testing::Case;

const TORQUE: f64 = 1.5e5;

/// Sectors of few linear elements.
const SECTOR: StructuredOptions = StructuredOptions {
    order: 1,
    elements_profile: 2,
    elements_fillet: 2,
    elements_thickness: 2,
    elements_face: 3,
    elements_rim: 2,
    extent: Extent::Periodic,
};

/// A mesh of an idler, and where its gears stand, flanks some um into each other.
struct Mesh {
    gears: [ElasticGear; 2],
    contact: MeshContact,
    poses: [Pose; 2],
}

impl Mesh {
    fn new(teeth: [u32; 2], helix_deg: f64, driver: Driver, (friction, phase): (f64, f64)) -> Self {
        let gear = |i: usize| {
            let helix_angle = [helix_deg, -helix_deg][i].to_radians();
            let bore_diameter = 0.55 * 3.0 * f64::from(teeth[i]);
            Gear::new(GearData { teeth: teeth[i], helix_angle, bore_diameter, face_width: 20.0, ..GearData::default() })
                .unwrap()
        };
        let pair = GearPair::new(gear(0), gear(1), None).unwrap();
        let options = StaticOptions::new(TORQUE, &pair).with_contact(|c| {
            (c.driver, c.slices, c.friction) = (driver, 12, friction);
        });
        let gears = Case::meshed(pair.clone(), &SECTOR, TORQUE).reduced_gears(&options);
        let of = &options.contact;
        let station = Station { cycle: 0, phase };
        let window = SlidingWindow::at(station, options.window_teeth(&pair), teeth, of.sense).unwrap();
        let set = ContactSet::new(&pair, &gears, window.window(), of).unwrap();
        let mut contact = MeshContact::new(&pair, set, of).unwrap();
        let at = |turn: f64| {
            let d = [0.0, 0.0, 0.0, 1e-5, 0.0, 0.0, 2e-3, -1e-3, 0.0, 0.0, -2e-5, 0.0];
            displaced(frames(&pair, contact.contact_set(), window.window(), of, station, [0.0, turn]), &d)
        };
        let turn = 0.02 / pair.wheel.base_radius();
        let both = [at(turn), at(-turn)];
        let poses = both.into_iter().max_by(|a, b| contact.overlap(a).total_cmp(&contact.overlap(b))).unwrap();
        Self { gears, contact, poses }
    }

    /// What the rows of the last solution open by their own mesh, and their own approach, mm.
    fn own_openings(&self) -> Vec<f64> {
        let set = self.contact.contact_set();
        let (rows, slices, forces) = (self.contact.rows(), self.contact.slices(), self.contact.solver().forces());
        let all: Vec<usize> = (0..rows.len()).collect();
        let same = SameSlices::of(rows, slices, &all);
        let matrix = same.compliance(set, forces, &mut set.table_work(rows.len()));
        let states: Vec<_> = self.contact.states(forces).collect();
        let of = |i: usize| {
            let bulk: f64 = (0..rows.len()).map(|j| matrix[(i, j)] * forces[j]).sum();
            let state = &states[i].local;
            let curved =
                if forces[i] > 0.0 { state.approach - state.slope / slices[i].length * forces[i] } else { 0.0 };
            bulk + curved
        };
        all.iter().map(|&i| of(i)).collect()
    }
}

/// The common gear: the wheel of the first mesh, the pinion of the second one.
const ENDS: [usize; 2] = [1, 0];

fn reducer(mesh: &Mesh, end: usize) -> &reduction::GearReducer {
    match &mesh.gears[end] {
        ElasticGear::Reduced(reducer) => reducer,
        ElasticGear::Full(_) => unreachable!("reduced above"),
    }
}

/// Displacements of the idler's flanks in the first mesh under forces on those in the second one.
fn between(meshes: &[Mesh; 2]) -> Mat<f64> {
    let window = |k: usize| meshes[k].contact.contact_set().windows().unwrap()[ENDS[k]].clone();
    let [a, b] = [0, 1].map(|k| reducer(&meshes[k], ENDS[k]));
    a.compliance_between(&window(0), (b, &window(1))).unwrap()
}

fn solve(meshes: &mut [Mesh; 2], common: &[CommonGear<'_>]) -> JoinedContacts {
    let mut joined = JoinedContacts::new();
    let poses = [meshes[0].poses, meshes[1].poses];
    let mut contacts = meshes.each_mut().map(|mesh| &mut mesh.contact);
    joined.evaluate(&mut contacts, &poses, common, &mut []).unwrap();
    joined
}

fn idler(friction: f64) -> [Mesh; 2] {
    [
        Mesh::new([20, 31], 15.0, Driver::Pinion, (friction, 0.3)),
        Mesh::new([31, 23], -15.0, Driver::Pinion, (friction, 0.8)),
    ]
}

/// Slices of two meshes of an idler press so that none overlaps and none pulls, by their own mesh and by what the body of the
/// idler passes on from the other one: its matrices between both windows, taken by themselves. So they do with friction.
#[test]
fn joined_contacts_meet_the_conditions_of_contact() {
    for friction in [0.0, 0.08] {
        let mut meshes = idler(friction);
        let compliance = between(&meshes);
        let common = [CommonGear { contacts: [0, 1], bodies: ENDS, compliance: compliance.as_ref() }];
        solve(&mut meshes, &common);
        let rows = meshes.each_ref().map(|mesh| {
            let contact = &mesh.contact;
            let ones = vec![1.0; contact.rows().len()];
            contact.contact_set().supported_rows(&mesh.poses, contact.rows(), contact.slices(), &ones)
        });
        let of_idler = |k: usize| {
            let contact = &meshes[k].contact;
            let all = contact.contact_set().forces_of(&rows[k], contact.solver().forces()).unwrap();
            Mat::from_fn(all[ENDS[k]].len(), 1, |i, _| all[ENDS[k]][i])
        };
        let moved = [&compliance * of_idler(1), compliance.transpose() * of_idler(0)];
        let (mut worst, mut largest, mut across) = (0.0f64, 0.0f64, 0.0f64);
        for (k, mesh) in meshes.iter().enumerate() {
            let own = mesh.own_openings();
            for (i, row) in rows[k].iter().enumerate() {
                let passed = opening(&row.supports[ENDS[k]], moved[k].col_as_slice(0));
                let gap = row.gap + own[i] + passed;
                let force = mesh.contact.solver().forces()[i];
                worst = worst.max(if force > 0.0 { gap.abs() } else { (-gap).max(0.0) });
                (largest, across) = (largest.max(own[i].abs()), across.max(passed.abs()));
            }
            assert!(mesh.contact.solver().forces().iter().filter(|f| **f > 0.0).count() > 8, "mesh {k} is loaded");
        }
        println!(
            "friction {friction}: overlap {:.1e}, passed on {:.1e} of the largest approach",
            worst / largest,
            across / largest
        );
        assert!(worst < 1e-10 * largest, "friction {friction}: {worst} mm of {largest}");
        assert!(across > 1e-3 * largest, "the body passes on next to nothing: {across} mm of {largest}");
    }
}

/// Without a common gear joined contacts are those of each mesh, forces and tangents; with one, the tangent is symmetric and the
/// derivative of the forces, also of one mesh by the gears of the other one.
#[test]
fn the_tangent_of_joined_contacts_is_their_derivative() {
    let mut meshes = idler(0.0);
    let apart = solve(&mut meshes, &[]);
    for (k, mesh) in meshes.iter_mut().enumerate() {
        let joined = mesh.contact.force().clone();
        let (poses, alone) = (mesh.poses, mesh.contact.evaluate(&mesh.poses).unwrap());
        assert_eq!(poses, mesh.poses);
        let sum: f64 = alone.pair_forces.iter().sum();
        let off = joined.pair_forces.iter().zip(&alone.pair_forces).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9 * sum, "mesh {k}: {off} of {sum} N");
        let stiffest = alone.tangent.as_flattened().iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let tangents = joined.tangent.as_flattened().iter().zip(alone.tangent.as_flattened());
        let off = tangents.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Slopes of the local approach are those of forces some Newton steps before the last.
        // Slopes of the local approach are those of forces some Newton steps before the last.
        assert!(off < 1e-6 * stiffest, "mesh {k}: tangents {off:e} apart of {stiffest:e}");
        let nothing = apart.tangent(k, 1 - k).as_flattened().iter().all(|x| *x == 0.0);
        assert!(nothing, "mesh {k} hears the other one through nothing");
    }

    let compliance = between(&meshes);
    let common = [CommonGear { contacts: [0, 1], bodies: ENDS, compliance: compliance.as_ref() }];
    let joined = solve(&mut meshes, &common);
    let [own, across] = [joined.tangent(0, 0), joined.tangent(0, 1)];
    let back = joined.tangent(1, 0);
    let scale = |i: usize, j: usize| (own[i][i] * joined.tangent(1, 1)[j][j]).abs().sqrt();
    for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
        assert!((across[i][j] - back[j][i]).abs() < 1e-9 * scale(i, j), "entry {i}, {j}");
    }
    // The wheel of the second mesh is turned; forces on the idler and the pinion of the first one follow.
    let centre = meshes[1].poses;
    let step = 1e-6 / 30.0;
    let mut force = |by: f64| {
        let turn = nalgebra::UnitQuaternion::from_scaled_axis(contact::Vec3::new(0.0, 0.0, by));
        meshes[1].poses[1].rotation = turn * centre[1].rotation;
        solve(&mut meshes, &common);
        [0, 1].map(|k| meshes[k].contact.force().wrench[1].moment[2])
    };
    let (after, before) = (force(step), force(-step));
    for (k, tangent) in [across[11][11], joined.tangent(1, 1)[11][11]].into_iter().enumerate() {
        let slope = (after[k] - before[k]) / (2.0 * step);
        println!("mesh {k}: {tangent:.6e} beside {slope:.6e} N mm/rad");
        assert!((tangent / slope - 1.0).abs() < 1e-3, "mesh {k}: {tangent} beside {slope} N mm/rad");
    }
}
