//! The face load factor K_Hbeta of a misaligned spur pair against the closed form of a rigid wedge on a uniform bed
//! (ISO 6336-1, clause 7), and how far teeth are from such a bed.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::Station;
use analysis::results::face_load_factor;
use contact::{
    Misalignment, Site, SliceResult,
    complementarity::{Balance, DenseProblem, DenseSolver},
};
use faer::Mat;
use ltca::{StaticHistory, StaticModel, StaticOptions, StaticPosition};
use mesh::Extent;
use testing::{Case, default_data, of_order, quadratic};

/// Slices over the face: the outermost is half a slice from the end, where the wedge presses most.
const SLICES: usize = 128;
/// Stiffness of the bed, N/(mm um): about that of a pair of steel teeth.
const BED: f64 = 15.0;

/// K_Hbeta of a wedge that opens by `wedge` um over the face, on a bed of `stiffness` N/(mm um) under `load` N/mm: 1 +
/// c f/(2 w) while all of the face presses, sqrt(2 c f/w) beyond.
fn closed_form(wedge: f64, stiffness: f64, load: f64) -> f64 {
    let part = stiffness * wedge / load;
    if part < 2.0 { 1.0 + 0.5 * part } else { (2.0 * part).sqrt() }
}

fn misaligned(case: &Case, wedge_um: f64, slices: usize) -> StaticOptions {
    let mut options = case.slice_options().with_contact(|c| c.slices = slices);
    let tilt = Misalignment { in_plane_of_action: 1e-3 * wedge_um, ..Default::default() };
    options.contact.offsets[1] = tilt.wheel_offset(&case.pair, options.side());
    options
}

/// The position with the loads of its slices on a uniform bed in place of the gears: the gaps are those of the solved
/// pair's flanks, the solver is that of the contact, and each slice deflects under its own load alone.
fn on_a_bed(model: &mut StaticModel, station: Station) -> StaticPosition {
    let mut position = model.solve(station).unwrap_or_else(|e| panic!("{e}"));
    let (driven, torque, side) = (model.options().driven(), model.options().torque, model.options().side());
    let e = model.last().unwrap();
    let gaps: Vec<f64> = e.rows.iter().map(|r| r.gap).collect();
    let levers: Vec<f64> = e.rows.iter().map(|r| r.levers[driven]).collect();
    let n = gaps.len();
    let rigid = Mat::zeros(n, n);
    let problem = DenseProblem {
        compliance: rigid.as_ref(),
        symmetric: true,
        gaps: &gaps,
        levers: &levers,
        torque_levers: &levers,
        balance: Balance::Moment(-side.sign() * torque),
    };
    let own = |i: usize| 1e-3 / (BED * e.slices[i].length);
    let mut solver = DenseSolver::new(n);
    solver.solve(&problem, |i, force| (own(i) * force, own(i)), |_| 0.0).unwrap_or_else(|e| panic!("{e}"));
    let slices: Vec<SliceResult> = (e.slices.iter().zip(solver.forces()))
        .filter(|(_, force)| **force > 0.0)
        .map(|(slice, force)| SliceResult {
            z: slice.z,
            wheel_z: slice.at[1][1],
            side,
            roll: [slice.at[0][0], slice.at[1][0]],
            line_load: force / slice.length,
            half_width: 0.0,
            pressure: 0.0,
            off_line: 0.0,
            site: Site::Flank,
        })
        .collect();
    let loaded = position.pairs.iter_mut().find(|pair| pair.normal_force > 0.0).unwrap();
    loaded.slices = slices;
    position.pairs.retain(|pair| pair.normal_force > 0.0);
    assert_eq!(position.pairs.len(), 1, "one pair carries all in the middle of the path");
    position
}

/// Misalignment, gaps, solver and factor together: within 2 % of the closed form, from the whole face pressed to a
/// quarter of it. What is left is half a slice at the end, 1.5 % at the most.
#[test]
fn a_wedge_on_a_uniform_bed_has_the_factor_of_the_standard() {
    let case = of_order(1, default_data(0.0), None, 150e3, [2, 2, 2, 3, 2], Extent::Periodic);
    let options = misaligned(&case, 0.0, SLICES);
    let gears = std::sync::Arc::new(case.reduced_gears(&options));
    let load = case.torque / case.pair.wheel.base_radius() / case.pair.face_width();
    let mut pressed_in_part = 0;
    for wedge in [0.0, 5.0, 10.0, 20.0, 40.0, 80.0, 160.0] {
        let options = misaligned(&case, wedge, SLICES);
        let mut model = StaticModel::new(case.pair.clone(), gears.clone(), options).unwrap();
        let position = on_a_bed(&mut model, Station { cycle: 0, phase: 0.5 });
        let history = StaticHistory { positions: vec![position], ..Default::default() };
        let found = face_load_factor(SLICES, &history.positions).unwrap();
        let wanted = closed_form(wedge, BED, load);
        println!("wedge {wedge:>5} um: K_Hbeta {found:.4} ({wanted:.4}), {:+.2} %", 100.0 * (found / wanted - 1.0));
        assert!((found / wanted - 1.0).abs() < 0.02, "{wedge} um: K_Hbeta {found}, closed form {wanted}");
        pressed_in_part += usize::from(wanted > 2.0);
    }
    assert!(pressed_in_part >= 2, "{pressed_in_part} wedges leave a part of the face open");
}

/// Teeth of finite elements are no uniform bed: a slice at an end face has a neighbour on one side alone and is held up
/// by less, so that the ends of the face are pressed more than the wedge alone would. K_Hbeta over the mesh cycle
/// against the closed form with the pair's own stiffness: always above it, and nearer to it the wider the face.
#[test]
fn teeth_are_no_uniform_bed() {
    // Largest excess seen, of the narrow and of the wide pair (docs/validation.md), and a tenth of it.
    for (modules, face, most) in [(20.0 / 3.0, 6, 0.152), (15.0, 12, 0.055)] {
        let data = default_data(0.0).map(|d| geometry::GearData { face_width: 3.0 * modules, ..d });
        let case = quadratic(data, None, 7500.0 * 3.0 * modules, [4, 3, 3, face, 3], Extent::Periodic);
        let (slices, width) = (64, case.pair.face_width());
        let load = case.torque / case.pair.wheel.base_radius() / width;
        let gears = std::sync::Arc::new(case.reduced_gears(&misaligned(&case, 0.0, slices)));
        for wedge in [0.0, 5.0, 10.0, 20.0] {
            let options = misaligned(&case, wedge, slices);
            let mut model = StaticModel::new(case.pair.clone(), gears.clone(), options).unwrap();
            let history = model.run(8, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
            let middle = &history.positions[4];
            let stiffness = 1e-3 * middle.tangent_stiffness / width;
            let found = face_load_factor(slices, &history.positions).unwrap();
            let one = StaticHistory { positions: vec![middle.clone()], ..Default::default() };
            let alone = face_load_factor(slices, &one.positions).unwrap();
            let wanted = closed_form(wedge, stiffness, load);
            println!(
                "b/m_n {modules:.1}, wedge {wedge:>4} um: K_Hbeta {found:.3} over the mesh, {alone:.3} in the middle, {wanted:.3} of a bed of {stiffness:.2} N/(mm um)"
            );
            let over = found / wanted - 1.0;
            assert!(
                (0.0..most).contains(&over),
                "b/m_n {modules:.1}, {wedge} um: {found} over the mesh, {wanted} of a bed"
            );
            // One pair carries all in the middle: it is there that the face is pressed most.
            assert!((alone / found - 1.0).abs() < 1e-3, "{alone} in the middle, {found} over the mesh");
        }
    }
}
