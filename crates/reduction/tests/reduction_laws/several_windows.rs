//! Several windows of a gear in one reduction against the condensation of the whole gear.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use crate::common::{gear, meshed, options};
use faer::Mat;
use fem::Material;
use geometry::Side;
use mesh::Extent;
use reduction::{GearReducer, ReductionError, ReductionWay, Window};

/// Of each of a window's coordinate nodes the node of the whole gear at its place, among those of the window of all teeth, and
/// the angle from the frame of its matrices to the gear's own, rad.
fn places((reducer, window): (&GearReducer, &Window), (whole, all): (&GearReducer, &Window)) -> Vec<(usize, f64)> {
    let angle = reducer.frame_angle(window);
    let nodes = &whole.gear().mesh().nodes;
    let at = |node: &u32| {
        let [x, y, z] = reducer.gear().mesh().nodes[*node as usize];
        let place = [angle.cos() * x - angle.sin() * y, angle.sin() * x + angle.cos() * y, z];
        let off = |n: &u32| (0..3).map(|k| (nodes[*n as usize][k] - place[k]).abs()).sum::<f64>();
        let best = all.reduced.nodes.iter().enumerate().min_by(|a, b| off(a.1).total_cmp(&off(b.1))).unwrap();
        assert!(off(best.1) < 1e-9, "no node of the whole gear at {place:?}");
        (best.0, -angle)
    };
    window.reduced.nodes.iter().map(at).collect()
}

/// C of the windows taken out of that of all teeth.
fn taken_out(windows: &[(&GearReducer, &Window)], all: (&GearReducer, &Window)) -> Mat<f64> {
    let whole = all.1.reduced.compliance();
    let rows: Vec<(usize, f64)> = windows.iter().flat_map(|window| places(*window, all)).collect();
    let turn = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]
    };
    let entry = |i: usize, j: usize| -> f64 {
        let ((a, p), (b, q)) = (rows[i / 3], rows[j / 3]);
        let (r, s) = (turn(p)[i % 3], turn(q)[j % 3]);
        let pairs = (0..3).flat_map(|k| (0..3).map(move |m| (k, m)));
        pairs.map(|(k, m)| r[k] * s[m] * whole[(3 * a + k, 3 * b + m)]).sum()
    };
    Mat::from_fn(3 * rows.len(), 3 * rows.len(), entry)
}

/// Two windows of an idler, two of a planet, three of a ring's place, windows that have teeth in common, and one beside itself:
/// C of all together is the condensation of the whole gear to 1e-12 of its largest entry, by one sector and by one factor; it is
/// symmetric. So it is where each window is of a reduction of its own, to other sides of the teeth and more or fewer of them. A
/// force on one window moves the flanks of the others.
#[test]
fn windows_of_one_gear_are_its_condensation() {
    use Side::{Left, Right};
    for (teeth, beta, order, sides, firsts) in [
        (11, 0.0, 1, [&[Right, Left][..], &[Right, Left], &[Right, Left]], &[0, 5][..]),
        (13, 20.0, 1, [&[Right, Left], &[Right], &[Left]], &[12, 3, 7]),
        (14, -15.0, 1, [&[Left], &[Right], &[Right]], &[1, 9]),
        (11, 25.0, 2, [&[Left], &[Right], &[Left, Right]], &[4, 5, 10]),
    ] {
        let exact = gear(teeth, beta);
        let mesh = |extent| meshed(&exact, order, 2, extent);
        let whole = options(&[Right, Left], teeth as usize, 0);
        let whole = GearReducer::general(mesh(Extent::Whole), Material::STEEL, whole).unwrap();
        let all = whole.window(0).unwrap();
        for (way, extent) in [
            (ReductionWay::CyclicSector, Extent::Whole),
            (ReductionWay::CyclicSector, Extent::Periodic),
            (ReductionWay::General, Extent::Whole),
        ] {
            let made = |(i, first): (usize, &u32)| {
                // The first window of a reduction is another one than that which is asked for.
                let asked = options(sides[i], 2 + i, first + 3);
                let made = match way {
                    ReductionWay::SectorAndBolts | ReductionWay::General => {
                        GearReducer::general(mesh(extent), Material::STEEL, asked)
                    }
                    ReductionWay::CyclicSector => GearReducer::new(mesh(extent), Material::STEEL, asked),
                };
                let reducer = made.unwrap();
                assert_eq!(reducer.way(), way);
                let window = reducer.window(*first).unwrap();
                (reducer, window)
            };
            let windows: Vec<(GearReducer, Window)> = firsts.iter().enumerate().map(made).collect();
            let windows: Vec<(&GearReducer, &Window)> = windows.iter().map(|(r, w)| (r, w)).collect();
            let found = GearReducer::compliance_of(&windows).unwrap();
            let wanted = taken_out(&windows, (&whole, &all));
            let off = (&found - &wanted).norm_max() / wanted.norm_max();
            let [n, m] = [0, 1].map(|i| windows[i].1.reduced.coordinates());
            let between = found.as_ref().submatrix(n, 0, m, n).norm_max() / found.norm_max();
            println!(
                "z {teeth}, {beta} deg, {way:?}, {extent:?}: off by {off:.1e}, between the first two {between:.1e} of the largest"
            );
            assert!(off < 1e-12, "z {teeth}, {way:?}: {off:e}");
            assert!(between > 1e-6, "z {teeth}: {between:e}");
            let apart = (&found - found.transpose()).norm_max() / found.norm_max();
            assert!(apart < 1e-14, "z {teeth}: not symmetric by {apart:e}");
        }
    }
}

/// Reductions of a gear that is meshed, or condensed, in two ways have nothing in common, and say so.
#[test]
fn windows_of_two_meshes_of_a_gear_are_refused() {
    let exact = gear(11, 0.0);
    let made = |fine| {
        GearReducer::new(meshed(&exact, 1, fine, Extent::Periodic), Material::STEEL, options(&[Side::Left], 2, 0))
            .unwrap()
    };
    let general = meshed(&exact, 1, 2, Extent::Whole);
    let general = GearReducer::general(general, Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
    let sector = made(2);
    for other in [made(1), general] {
        let [own, theirs] = [&sector, &other].map(|reducer| reducer.window(0).unwrap());
        let refused = sector.compliance_between(&own, (&other, &theirs)).unwrap_err();
        assert_eq!(refused, ReductionError::OtherReduction);
        assert!(refused.hint().is_some());
    }
}
