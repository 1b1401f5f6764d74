//! A tooth change is bookkeeping: STE, pair forces and strain energy may not jump.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::{AleError, Station, ToothWindow};
use geometry::Sense;
use ltca::{StaticError, StaticOptions};
use mesh::MeshedGear;
use reduction::ElasticGear;
use testing::{Case, generated};

/// A turn and a tenth, or three whole turns, in either sense, across tooth z-1 to 0.
#[test]
fn turns_end_where_they_began() {
    let cycles = testing::cases(33, 90);
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    for sense in [Sense::Ccw, Sense::Cw] {
        let options = case.options().with_contact(|c| {
            c.sense = sense;
            c.points_per_face_edge = 4
        });
        let mut model = case.reduced(options);
        let stations = 4;
        let (mut worst, mut changes) = ([0.0f64; 3], 0);
        let mut first_cycle = Vec::new();
        for i in 0..=cycles * stations {
            let station = Station { cycle: (i / stations) as i64, phase: (i % stations) as f64 / stations as f64 };
            let position = model
                .advance(station, |change| {
                    changes += 1;
                    let (a, b) = (&change.before, &change.after);
                    worst[0] = worst[0].max((a.transmission_error / b.transmission_error - 1.0).abs());
                    let total: f64 = a.pairs.iter().map(|p| p.normal_force).sum();
                    for p in &a.pairs {
                        let after = b.pairs.iter().find(|q| q.pair == p.pair).map_or(0.0, |q| q.normal_force);
                        worst[1] = worst[1].max((p.normal_force - after).abs() / total);
                    }
                    worst[2] = worst[2].max((a.strain_energy / b.strain_energy - 1.0).abs());
                })
                .unwrap_or_else(|e| panic!("{sense:?}, station {i}: {e}"));
            if i < stations {
                first_cycle.push(position.transmission_error);
            }
            let off = position.transmission_error / first_cycle[i % stations] - 1.0;
            assert!(off.abs() < 1e-9, "{sense:?}: cycle {} differs from the first by {off:e}", i / stations);
        }
        println!(
            "{sense:?}: {changes} changes, worst jumps: STE {:.1e}, pair forces {:.1e}, energy {:.1e}",
            worst[0], worst[1], worst[2]
        );
        assert!(changes >= cycles - 1, "{changes} changes in {cycles} mesh cycles");
        assert!(worst.iter().all(|w| *w < 1e-9), "{worst:?}");
    }
}

fn coordinates_before_and_after(case: &Case) -> ([Vec<f64>; 2], [f64; 2], f64) {
    let mut model = case.reduced(case.options().with_contact(|c| c.points_per_face_edge = 4));
    // Phase 1/8: the pair ahead has left the path, so the window may move on to the next one.
    let station = Station { cycle: 0, phase: 0.0 };
    let before = model.solve(station).unwrap();
    let from = model.contact_set().windows().unwrap()[0].clone();
    let u = model.last().unwrap().displacements[0].clone();
    let ElasticGear::Reduced(gear) = &model.gears()[0] else { unreachable!() };
    // The window that gives up the pair behind (unloaded at phase 0) and takes in the one ahead.
    let forces: Vec<f64> = before.pairs.iter().map(|p| p.normal_force).collect();
    let next = model.window().change(Sense::Cw, &forces).unwrap_or_else(|e| panic!("{forces:?}: {e}"));
    let to = gear.window(next.first_teeth()[0]).unwrap();
    let carried = gear.carry(&from, &to, &u).unwrap();
    let mut naive = carried.clone();
    // The naive change: the oncoming tooth starts from zero.
    let incoming = gear.gear().flank((to.reduced.teeth[2]) % 30, model.options().side()).unwrap();
    for node in incoming.iter().flat_map(|f| f.nodes()) {
        let at = 3 * to.reduced.position(*node).unwrap();
        naive[at..at + 3].fill(0.0);
    }
    let energy = from.reduced.strain_energy(&u);
    ([carried.clone(), naive.clone()], [to.reduced.strain_energy(&carried), to.reduced.strain_energy(&naive)], energy)
}

/// Carried coordinates describe the same field: same strain energy. Starting the oncoming tooth from zero tears it.
#[test]
fn coordinates_go_over_without_a_jump() {
    let cyclic = generated(20.0, [2, 2, 2, 4, 1]);
    // The same gears with one node of the rim moved by 10 nm: not cyclic any more, so the general way is taken.
    let mut general = generated(20.0, [2, 2, 2, 4, 1]);
    general.meshes = general.meshes.map(nudged);
    for (name, case) in [("cyclic", &cyclic), ("general", &general)] {
        let (_, [carried, naive], before) = coordinates_before_and_after(case);
        println!("{name}: energy {before:.6e}, carried {carried:.6e}, naive {naive:.6e} N mm");
        assert!((carried / before - 1.0).abs() < 1e-9, "{name}: {carried} after {before}");
        assert!((naive / before - 1.0).abs() > 1e-3, "{name}: the naive change must show: {naive} after {before}");
    }
}

fn nudged(gear: MeshedGear) -> MeshedGear {
    let mut mesh = gear.mesh().clone();
    let bore = gear.bore_nodes()[7] as usize;
    mesh.nodes[bore][2] += 1e-5;
    MeshedGear::from_groups(mesh, &mesh::GroupNames::default(), gear.tooth_count()).unwrap()
}

/// Cyclic or not, a window has the same answer; a gear that is not cyclic reduces each window by solves.
#[test]
fn general_windows_equal_cyclic_ones() {
    let cyclic = generated(20.0, [2, 2, 2, 4, 1]);
    let mut general = generated(20.0, [2, 2, 2, 4, 1]);
    general.meshes = general.meshes.map(nudged);
    let run = |case: &Case| {
        let mut model = case.reduced(case.options().with_contact(|c| c.points_per_face_edge = 4));
        let history = model.run(4, 3, |_, _, _| ()).unwrap();
        let cyclic = model.gears().iter().all(|g| matches!(g, ElasticGear::Reduced(r) if r.is_cyclic()));
        (history, cyclic)
    };
    let ((a, first), (b, second)) = (run(&cyclic), run(&general));
    assert!(first && !second, "recognised as cyclic: {first}, {second}");
    for (a, b) in a.positions.iter().zip(&b.positions) {
        // The node moved by 1e-5 of 20 mm; its influence is far below that.
        let off = a.transmission_error / b.transmission_error - 1.0;
        assert!(off.abs() < 1e-6, "angle {}: {off:e}", a.pinion_angle);
    }
}

/// A loaded tooth is not dropped, and the program says which.
#[test]
fn a_loaded_tooth_stays() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    let mut model = case.reduced(case.options().with_contact(|c| c.points_per_face_edge = 4));
    let station = Station { cycle: 0, phase: 0.5 };
    let position = model.solve(station).unwrap();
    let refused = model.change(&position, station).unwrap_err();
    println!("{refused}\nhint: {}", refused.hint().unwrap_or_default());
    let window: Result<ToothWindow, AleError> = model.window().change(Sense::Ccw, &[1.0, 1.0, 1.0]);
    assert!(matches!(window, Err(AleError::LoadedTooth { .. })));
    assert!(refused.to_string().contains("still carries"), "{refused}");
}

/// eps_gamma = 2.245 needs three teeth; a window of two says which pair it misses instead of leaving it out.
#[test]
fn a_starved_window_is_an_error() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    let options = StaticOptions { window: Some(2), ..case.options() }.with_contact(|c| c.points_per_face_edge = 4);
    let refused = case.reduced(options).run(8, 1, |_, _, _| ()).unwrap_err();
    println!("{refused}");
    assert!(matches!(refused, StaticError::Window(AleError::Starved { window: 2, .. })), "{refused}");
}
