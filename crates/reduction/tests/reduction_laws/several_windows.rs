//! Several windows of a gear in one reduction against the condensation of the whole gear.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use crate::common::{gear, meshed, options};
use faer::Mat;
use fem::Material;
use geometry::Side;
use mesh::Extent;
use reduction::{GearReducer, ReductionWay, Window};

/// Coordinates of a window in the whole gear's own, which is the window of all teeth: places of its nodes and the turn of its
/// frame.
fn places(reducer: &GearReducer, window: &Window, all: &Window) -> Vec<usize> {
    reducer.material_nodes(window).iter().map(|n| all.reduced.position(*n).unwrap()).collect()
}

/// C of the windows taken out of that of all teeth.
fn taken_out(reducer: &GearReducer, windows: &[&Window], all: &Window) -> Mat<f64> {
    let whole = all.reduced.compliance();
    let rows: Vec<(usize, f64)> = (windows.iter())
        .flat_map(|w| places(reducer, w, all).into_iter().map(|at| (at, -reducer.frame_angle(w))))
        .collect();
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
/// symmetric, and positive where no flank is there twice. A force on one window moves the flanks of the others.
#[test]
fn windows_of_one_gear_are_its_condensation() {
    use Side::{Left, Right};
    for (teeth, beta, order, sides, firsts) in [
        (11, 0.0, 1, &[Right, Left][..], &[0, 5][..]),
        (13, 20.0, 1, &[Right, Left], &[12, 3, 7]),
        (14, -15.0, 1, &[Left], &[1, 9]),
        (11, 25.0, 2, &[Left], &[4, 5, 10]),
    ] {
        let exact = gear(teeth, beta);
        let mesh = || meshed(&exact, order, 2, Extent::Whole);
        let whole = GearReducer::general(mesh(), Material::STEEL, options(sides, teeth as usize, 0)).unwrap();
        let all = whole.window(0).unwrap();
        for (general, way) in [(false, ReductionWay::CyclicSector), (true, ReductionWay::General)] {
            let asked = options(sides, 2, 3);
            let made = if general {
                GearReducer::general(mesh(), Material::STEEL, asked)
            } else {
                GearReducer::new(mesh(), Material::STEEL, asked)
            };
            let reducer = made.unwrap();
            assert_eq!(reducer.way(), way);
            let windows: Vec<Window> = firsts.iter().map(|first| reducer.window(*first).unwrap()).collect();
            let windows: Vec<&Window> = windows.iter().collect();
            let (found, wanted) = (reducer.compliance_of(&windows).unwrap(), taken_out(&reducer, &windows, &all));
            let off = (&found - &wanted).norm_max() / wanted.norm_max();
            let n = windows[0].reduced.coordinates();
            let between = found.as_ref().submatrix(n, 0, n, n).norm_max() / found.norm_max();
            println!(
                "z {teeth}, {beta} deg, {way:?}: off by {off:.1e}, between the first two {between:.1e} of the largest"
            );
            assert!(off < 1e-12, "z {teeth}, {way:?}: {off:e}");
            assert!(between > 1e-6, "z {teeth}: {between:e}");
            let apart = (&found - found.transpose()).norm_max() / found.norm_max();
            assert!(apart < 1e-14, "z {teeth}: not symmetric by {apart:e}");
        }
    }
}
