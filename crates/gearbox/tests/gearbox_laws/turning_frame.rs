//! Vibration in the frame of a carrier that turns in space: what a turning observer sees, what must not change, and Lin and
//! Parker's stage at speed.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use gearbox::{Assembly, Bearing, GearboxError, Held, Rotors, Shaft, Structure, WhirlModes};
use nalgebra::{Complex, DMatrix, DVector};

use crate::{planets::lin_and_parker, rotors::friswell};

/// A body beside the others: what stands, or is fixed, and has nothing to do with them.
fn beside(structure: &mut Structure, name: &str) -> usize {
    let shaft = structure.shafts.len();
    structure.shafts.push(Shaft { name: name.into(), origin: [0.0; 3], pieces: Vec::new(), longest_element: 1.0 });
    structure.discs.push(gearbox::Disc::ring(name, shaft, 0.0, [200.0, 100.0], 20.0, 7.85e-9));
    structure.bearings.push(Bearing::diagonal(name, shaft, 0.0, [1e8, 1e8, 1e8, 1e12, 1e12, 1e12]));
    shaft
}

/// A rotor on alike bearings with dampers, alone or seen from a frame that turns.
fn rotor(turning: bool) -> Rotors {
    let mut structure = friswell();
    for bearing in &mut structure.bearings {
        bearing.damping[(0, 0)] = 0.05;
        bearing.damping[(1, 1)] = 0.05;
    }
    let carrier = beside(&mut structure, "carrier");
    let ring = beside(&mut structure, "ring");
    structure.standing = vec![carrier];
    structure.fixed = turning.then_some(ring);
    Rotors::new(Assembly::new(structure).unwrap()).unwrap()
}

/// Seen from a frame that turns by W, forward whirl of a rotor in space is slower by W and backward whirl faster, whatever its
/// spin; decay is the same. Of dampers in space the frame sees forces across: without these decay would be another.
#[test]
fn a_rotor_in_space_is_seen_shifted_by_the_turn_of_the_frame() {
    let (spin, frame) = (300.0, 70.0);
    let space = rotor(false).whirl_modes(&[spin, 0.0, 0.0]).unwrap();
    let seen = rotor(true).whirl_modes(&[spin, frame, 0.0]).unwrap();
    // Of frequencies far below those of the bodies beside.
    let mut wanted: Vec<[f64; 2]> = space
        .modes
        .iter()
        .take_while(|m| m.frequency < 2e3)
        .map(|m| [(m.frequency - (m.whirl[0] * frame).round()).abs(), m.decay])
        .collect();
    wanted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert!(wanted.len() > 6 && wanted.iter().any(|own| own[1] > 1.0), "{wanted:?}");
    for (mode, [frequency, decay]) in seen.modes.iter().zip(&wanted) {
        println!("{:.6} of {frequency:.6} rad/s, decay {:.6} of {decay:.6} 1/s", mode.frequency, mode.decay);
        assert!((mode.frequency - frequency).abs() < 1e-7 * frequency, "{} beside {frequency}", mode.frequency);
        assert!((mode.decay - decay).abs() < 1e-7 * frequency, "decay {} beside {decay}", mode.decay);
    }
}

/// Lin and Parker's stage with the ring fixed in space and the carrier turning; `held`: its turn is given.
fn stage(count: usize, held: bool) -> Rotors {
    let mut structure = lin_and_parker(count);
    structure.fixed = Some(1);
    // The carrier is free.
    structure.bearings[2].stiffness[(5, 5)] = 0.0;
    let held = Held { turns: if held { vec![2] } else { Vec::new() }, ..Held::default() };
    Rotors::holding(Assembly::new(structure).unwrap(), &held).unwrap()
}

/// Speeds in space with the carrier at `frame`: spins of these bodies change tilting alone.
fn at(rotors: &Rotors, frame: f64) -> WhirlModes {
    let count = rotors.assembly().structure().shafts.len() - 3;
    let speeds: Vec<f64> = [4.0 * frame, 0.0, frame].into_iter().chain(vec![-1.5 * frame; count]).collect();
    rotors.whirl_modes(&speeds).unwrap()
}

/// Motions in the plane, Hz.
fn plane(modes: &WhirlModes) -> Vec<f64> {
    let in_plane = |m: &&gearbox::WhirlMode| {
        let across: f64 =
            m.shape.iter().enumerate().filter(|(i, _)| [0, 1, 5].contains(&(i % 6))).map(|(_, x)| x.norm_sqr()).sum();
        let rest: f64 =
            m.shape.iter().enumerate().filter(|(i, _)| ![0, 1, 5].contains(&(i % 6))).map(|(_, x)| x.norm_sqr()).sum();
        across > rest
    };
    modes.modes.iter().filter(in_plane).map(|m| m.frequency / TAU).collect()
}

/// With the carrier's turn given, frequencies are those of M q'' + 2 W M J q' + (K - W^2 M_xy) q = 0, Lin and Parker's matrices
/// from the masses alone, to 1e-9.
#[test]
fn lin_and_parkers_stage_at_speed_has_their_gyroscopic_and_centripetal_terms() {
    for (count, frame) in [(3, 200.0), (4, 900.0)] {
        let rotors = stage(count, true);
        let assembly = rotors.assembly();
        let kept: Vec<usize> =
            (0..3 + count).flat_map(|body| [0, 1, 5].map(|k| 6 * body + k)).filter(|i| *i != 17).collect();
        let of = |matrix: &DMatrix<f64>| matrix.select_rows(&kept).select_columns(&kept);
        let (k, m) = (of(&assembly.stiffness()), of(&assembly.mass()));
        let n = kept.len();
        // Rates in units of 1e4 1/s: both halves are of one size.
        let unit = 1e4;
        let mut state = DMatrix::zeros(2 * n, 2 * n);
        for i in 0..n {
            state[(i, n + i)] = 1.0;
            (0..n).for_each(|j| state[(n + i, j)] = -k[(i, j)] / m[(i, i)] / (unit * unit));
            let (pull, turn) = ((frame / unit).powi(2), 2.0 * frame / unit);
            match kept[i] % 6 {
                0 => (state[(n + i, i)], state[(n + i, n + i + 1)]) = (state[(n + i, i)] + pull, turn),
                1 => (state[(n + i, i)], state[(n + i, n + i - 1)]) = (state[(n + i, i)] + pull, -turn),
                _ => {}
            }
        }
        let rates = state.complex_eigenvalues();
        let mut wanted: Vec<f64> = rates.iter().map(|v| v.im * unit / TAU).filter(|f| *f > 1.0).collect();
        wanted.sort_by(f64::total_cmp);
        let found = plane(&at(&rotors, frame));
        println!("{count} planets, {frame} rad/s: {found:.3?} Hz");
        assert_eq!(found.len(), wanted.len());
        for (found, wanted) in found.iter().zip(&wanted) {
            assert!((found / wanted - 1.0).abs() < 1e-7, "{found} beside {wanted} Hz");
        }
    }
}

/// With the carrier free, the train turns freely at any speed: two zeros, and nothing grows or decays. What planets weigh
/// against the turn of the carrier in the turning frame, the centrifugal forces in their turning seats take back.
#[test]
fn the_train_turns_freely_at_any_speed() {
    for count in [3, 5] {
        let rotors = stage(count, false);
        for frame in [0.0, 50.0, -400.0] {
            let found = at(&rotors, frame);
            let largest = found.modes.last().unwrap().frequency;
            let growth = found.modes.iter().map(|m| m.decay.abs()).fold(0.0, f64::max);
            println!(
                "{count} planets, {frame} rad/s: {} zeros, {:?}, growth {growth:.1e}",
                found.zeros, found.decaying
            );
            assert!(found.zeros == 2 && found.decaying.is_empty(), "{} {:?}", found.zeros, found.decaying);
            assert!(growth < 1e-10 * largest, "{growth}");
        }
    }
}

/// Frequencies do not know the sense of the turn. Translational modes, two of a frequency at rest, split in proportion to the
/// speed; rotational modes and planet modes, N - 3 of each, change with its square, and stay N - 3.
#[test]
fn translational_modes_split_with_the_speed_and_the_others_with_its_square() {
    for count in [4, 5] {
        let rotors = stage(count, false);
        let speeds = [0.0, 20.0, 40.0, -20.0];
        let all: Vec<Vec<f64>> = speeds.iter().map(|frame| plane(&at(&rotors, *frame))).collect();
        let [rest, one, two, back] = &all[..] else { unreachable!() };
        for (a, b) in one.iter().zip(back) {
            assert!((a / b - 1.0).abs() < 1e-9, "{a} and {b} Hz");
        }
        let (mut doubles, mut singles, mut at) = (0, 0, 0);
        while at < rest.len() {
            let same = rest[at..].iter().take_while(|f| (*f / rest[at] - 1.0).abs() < 1e-6).count();
            let [first, second] = [one, two].map(|own| &own[at..at + same]);
            let split = |own: &[f64]| own[same - 1] - own[0];
            // Of translational modes the pair parts; planet modes of N = 5 are pairs as well, and stay.
            if same == 2 && split(first) > 1e-7 * rest[at] {
                let ratio = split(second) / split(first);
                println!("{:.2} Hz: split by {:.5} and {:.5} Hz", rest[at], split(first), split(second));
                assert!((ratio - 2.0).abs() < 2e-3, "{} Hz: {ratio}", rest[at]);
                doubles += 1;
            } else {
                for k in 0..same {
                    let [a, b] = [first[k] - rest[at + k], second[k] - rest[at + k]];
                    assert!((b - 4.0 * a).abs() < 0.05 * a.abs() + 1e-9 * rest[at], "{} Hz: {a:e} and {b:e}", rest[at]);
                    assert!(split(second) < 1e-8 * rest[at], "{} Hz: {:e}", rest[at], split(second));
                }
                singles += same;
            }
            at += same;
        }
        // Six pairs; five rotational motions beside the free one, and three times N - 3 planet modes.
        assert!(doubles == 6 && singles == 5 + 3 * (count - 3), "{doubles}, {singles}");
    }
}

/// What a force at one place does at another is what the same force there does here with all turning the other way.
#[test]
fn responses_are_reciprocal_against_the_sense_of_the_turn() {
    let rotors = stage(4, true);
    let size = rotors.assembly().size();
    let unit = |i: usize| DVector::from_fn(size, |k, _| Complex::new(f64::from(u8::from(i == k)), 0.0));
    let answer = |i: usize, frame: f64| {
        let speeds: Vec<f64> = [4.0, 0.0, 1.0, -1.5, -1.5, -1.5, -1.5].iter().map(|s| s * frame).collect();
        rotors.response(&speeds, 7000.0, 0.02, &unit(i)).unwrap()
    };
    for (a, b) in [(0, 19), (6, 25), (18, 30), (1, 23)] {
        let [there, here] = [answer(a, 500.0)[b], answer(b, -500.0)[a]];
        let same = answer(b, 500.0)[a];
        println!("{a} to {b}: {there:.4e}, back {here:.4e}, in the same sense {same:.4e}");
        assert!((there - here).norm() < 1e-9 * there.norm(), "{there} and {here}");
    }
    assert!((answer(0, 500.0)[19] - answer(19, 500.0)[0]).norm() > 1e-3 * answer(0, 500.0)[19].norm());
}

/// Shafts that stand in one frame turn alike.
#[test]
fn carriers_of_several_speeds_are_refused() {
    let mut structure = lin_and_parker(3);
    structure.fixed = Some(1);
    let other = beside(&mut structure, "other carrier");
    structure.standing.push(other);
    let rotors = Rotors::new(Assembly::new(structure).unwrap()).unwrap();
    let error = rotors.whirl_modes(&[40.0, 0.0, 10.0, -5.0, -5.0, -5.0, 11.0]).unwrap_err();
    assert!(matches!(error, GearboxError::OutOfRange { ref part, .. } if part == "other carrier"), "{error}");
}
