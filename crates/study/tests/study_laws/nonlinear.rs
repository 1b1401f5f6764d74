//! Sections, bifurcation diagrams, exponents, portraits and Campbell diagrams against motions that are known.

use std::{convert::Infallible, f64::consts::TAU};

use study::{
    LyapunovPlan, StudyError, campbell, crossing_section, iterated_section, largest_lyapunov, phase_portrait,
    section_period, stroboscopic_section, sweep_both_ways,
};

fn logistic(r: f64, x: f64) -> f64 {
    r * x * (1.0 - x)
}

/// One step of the classical Runge-Kutta method.
fn rk4<const N: usize>(f: impl Fn(f64, [f64; N]) -> [f64; N], t: f64, x: [f64; N], h: f64) -> [f64; N] {
    let to = |k: [f64; N], s: f64| std::array::from_fn(|i| x[i] + s * h * k[i]);
    let a = f(t, x);
    let b = f(t + 0.5 * h, to(a, 0.5));
    let c = f(t + 0.5 * h, to(b, 0.5));
    let d = f(t + h, to(c, 1.0));
    std::array::from_fn(|i| x[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
}

/// Logistic map: fixed point 1 - 1/r up to r = 3, period 2 beyond, 4 beyond 1 + sqrt 6, 3 in its window at 3.835;
/// branches in closed form.
#[test]
fn logistic_map_doubles_where_it_must() {
    let run = |r: f64, x: &mut f64| {
        iterated_section(x, 4000, 64, |x| {
            *x = logistic(r, *x);
            Ok::<_, Infallible>(*x)
        })
    };
    let values = [2.8, 2.95, 3.2, 3.4, 3.5, 3.835];
    let both = sweep_both_ways(&values, &mut 0.3, run).unwrap();
    let found = &both.forward;
    for (branch, period) in found.iter().zip([1, 1, 2, 2, 4, 3]) {
        assert_eq!(branch.distinct(1e-6), period, "r = {}", branch.value);
        let points: Vec<Vec<f64>> = branch.points.iter().map(|&x| vec![x]).collect();
        assert_eq!(section_period(&points, 1e-6, &[1.0]), Some(period), "r = {}", branch.value);
    }
    assert!((found[0].points[0] - (1.0 - 1.0 / 2.8)).abs() < 1e-9);
    // Period 2: x = (r + 1 +- sqrt((r - 3)(r + 1))) / (2 r).
    let [low, high] = found[2].extent().unwrap();
    let root = f64::sqrt(0.2 * 4.2);
    assert!((high - (4.2 + root) / 6.4).abs() < 1e-9 && (low - (4.2 - root) / 6.4).abs() < 1e-9);
    // From where the way up ended the way down finds the same points.
    for (a, b) in found.iter().zip(&both.backward) {
        let [a, b] = [a, b].map(|x| x.extent().unwrap());
        assert!((a[0] - b[0]).abs() < 1e-6 && (a[1] - b[1]).abs() < 1e-6);
    }
}

/// ln 2 a step at r = 4; ln |f'| at a fixed point.
#[test]
fn exponent_of_the_logistic_map() {
    let plan = LyapunovPlan { stretch: 1.0, settling: 100, stretches: 20_000, distance: 1e-9 };
    let of =
        |r: f64| largest_lyapunov(&[0.3], &[1.0], &plan, |x, _| Ok::<_, Infallible>(vec![logistic(r, x[0])])).unwrap();
    let chaos = of(4.0);
    assert!((chaos.exponent - 2f64.ln()).abs() < 0.01 && chaos.is_chaotic(), "{chaos:?}");
    let fixed = of(2.8);
    assert!((fixed.exponent - f64::ln(0.8)).abs() < 1e-3 && !fixed.is_chaotic(), "{fixed:?}");
}

/// Lorenz's system (10, 28, 8/3): 0.9056 (Sprott, Chaos and Time-Series Analysis, 2003); a damped driven oscillator:
/// -zeta omega.
#[test]
fn exponents_of_flows() {
    let lorenz = |_: f64, [x, y, z]: [f64; 3]| [10.0 * (y - x), x * (28.0 - z) - y, x * y - 8.0 / 3.0 * z];
    let plan = LyapunovPlan { stretch: 0.5, settling: 40, stretches: 2000, distance: 1e-7 };
    let found = largest_lyapunov(&[1.0, 1.0, 20.0], &[10.0; 3], &plan, |x, _| {
        let mut x = [x[0], x[1], x[2]];
        for _ in 0..100 {
            x = rk4(lorenz, 0.0, x, 0.005);
        }
        Ok::<_, Infallible>(x.to_vec())
    })
    .unwrap();
    assert!((found.exponent - 0.9056).abs() < 0.03 && found.is_chaotic(), "{found:?}");
    let swing = |t: f64, [x, v]: [f64; 2]| [v, (2.0 * t).cos() - x - 0.1 * v];
    let period = TAU / 2.0;
    let plan = LyapunovPlan { stretch: period, settling: 20, stretches: 60, distance: 1e-6 };
    let found = largest_lyapunov(&[0.1, 0.0], &[1.0; 2], &plan, |x, _| {
        let mut x = [x[0], x[1]];
        for k in 0..100 {
            x = rk4(swing, f64::from(k) * period / 100.0, x, period / 100.0);
        }
        Ok::<_, Infallible>(x.to_vec())
    })
    .unwrap();
    assert!((found.exponent + 0.05).abs() < 2e-3, "{found:?}");
}

/// Growth that is drawn anew for each stretch: the error of its mean is the deviation over the root of their number.
/// Ten parts tell it to a quarter.
#[test]
fn the_error_of_an_exponent_is_that_of_a_mean() {
    let rate = |k: usize| {
        let mixed = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let mixed = (mixed ^ (mixed >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        ((mixed ^ (mixed >> 29)) >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let mut largest = 0.0f64;
    for from in 0..8 {
        let plan = LyapunovPlan { stretch: 1.0, settling: 0, stretches: 4000, distance: 1e-7 };
        let found = largest_lyapunov(&[0.0], &[1.0], &plan, |x, k| {
            Ok::<_, Infallible>(vec![x[0] * rate(k + 4000 * from).exp()])
        })
        .unwrap();
        let wanted = (1.0 / 12.0 / 4000.0f64).sqrt();
        assert!((0.4..1.8).contains(&(found.error / wanted)), "{found:?}, wanted {wanted:e}");
        largest = largest.max((found.exponent / wanted).abs());
    }
    assert!(largest < 3.5, "off by {largest} standard errors");
}

/// A state with memory: both ways differ exactly where there are two answers.
#[test]
fn hysteresis_is_where_both_ways_differ() {
    // x jumps to 1 at 0.7 going up and back to 0 at 0.4 going down.
    let run = |value: f64, x: &mut f64| {
        *x = if value > 0.65 {
            1.0
        } else if value < 0.35 {
            0.0
        } else {
            *x
        };
        Ok::<_, Infallible>(vec![*x + value])
    };
    let values: Vec<f64> = (0..=10).map(|i| 0.1 * f64::from(i)).collect();
    let both = sweep_both_ways(&values, &mut 0.0, run).unwrap();
    let bands = both.hysteresis(0.5);
    assert_eq!(bands.len(), 1);
    assert!((bands[0][0] - 0.4).abs() < 1e-12 && (bands[0][1] - 0.6).abs() < 1e-12, "{bands:?}");
    assert!(both.backward.windows(2).all(|w| w[0].value < w[1].value));
    // The first failure is handed on.
    let fails = |v: f64, _: &mut ()| if v > 1.5 { Err::<Vec<f64>, f64>(v) } else { Ok(vec![]) };
    assert_eq!(sweep_both_ways(&[1.0, 2.0, 3.0], &mut (), fails), Err(2.0));
}

/// A cosine once a period is one point, every half period two; interpolated between samples that do not fall there.
#[test]
fn sections_of_a_cosine() {
    let times: Vec<f64> = (0..700).map(|k| 0.03 * f64::from(k)).collect();
    let x: Vec<f64> = times.iter().map(|t| (t + 0.4).cos()).collect();
    let v: Vec<f64> = times.iter().map(|t| -(t + 0.4).sin()).collect();
    let once = stroboscopic_section(&times, &[&x, &v], TAU, 1.0).unwrap();
    assert_eq!(once.len(), 4);
    for point in &once {
        assert!((point[0] - 1.4f64.cos()).abs() < 1e-6 && (point[1] + 1.4f64.sin()).abs() < 1e-6, "{point:?}");
    }
    assert_eq!(section_period(&once, 1e-5, &[1.0, 1.0]), Some(1));
    let twice = stroboscopic_section(&times, &[&x], 0.5 * TAU, 1.0).unwrap();
    assert_eq!(section_period(&twice, 1e-5, &[1.0]), Some(2));
    // x goes up through zero at 3 pi / 2 - 0.4 and whole turns later, with velocity 1.
    let up = crossing_section(&times, &x, &[&v]).unwrap();
    for (k, point) in up.iter().enumerate() {
        assert!(
            (point[0] - (0.75 * TAU - 0.4 + TAU * k as f64)).abs() < 1e-6 && (point[1] - 1.0).abs() < 1e-5,
            "{point:?}"
        );
    }
    // A sample on the surface is a crossing, and one only.
    let touching = crossing_section(&[0.0, 1.0, 2.0, 3.0], &[-1.0, 0.0, 1.0, 2.0], &[]).unwrap();
    assert_eq!(touching.len(), 1);
    assert!((touching[0][0] - 1.0).abs() < 1e-9, "{touching:?}");
    // Ends of the record count although round-off puts them beside it: 0.1, 0.4, ... 0.7 of times that are sums of
    // tenths.
    let tenths: Vec<f64> = (1..=7).map(|k| 0.1 * f64::from(k)).collect();
    assert_eq!(stroboscopic_section(&tenths, &[&tenths], 0.3, 0.1).unwrap().len(), 3);
    assert_eq!(stroboscopic_section(&tenths, &[&tenths], 0.3, 0.1 + 1e-11).unwrap().len(), 3);
    assert_eq!(stroboscopic_section(&tenths, &[&tenths], 0.3, 0.1 - 1e-11).unwrap().len(), 3);
    // A period that is seen less than three times is none yet.
    let wave: Vec<Vec<f64>> = (0..8).map(|k| vec![f64::from(k % 4)]).collect();
    assert_eq!(section_period(&wave, 1e-6, &[1.0]), None);
    let longer: Vec<Vec<f64>> = (0..12).map(|k| vec![f64::from(k % 4)]).collect();
    assert_eq!(section_period(&longer, 1e-6, &[1.0]), Some(4));
    let (back, short) = ([0.0, 2.0, 1.0], [0.0; 2]);
    assert!(matches!(stroboscopic_section(&back, &[&[0.0; 3]], 1.0, 0.0), Err(StudyError::NotAscending { index: 2 })));
    let dense = stroboscopic_section(&[0.0, 1.0], &[], 1e-300, 0.0);
    assert!(matches!(dense, Err(StudyError::TooFewSamples { .. })));
    assert!(stroboscopic_section(&[0.0, 1.0], &[], 0.0, 0.0).is_err());
    assert!(matches!(crossing_section(&[0.0, 1.0, 2.0], &short, &[]), Err(StudyError::Lengths { .. })));
}

/// A sine of amplitude a at omega: an ellipse of area pi a^2 omega that closes after a period and not after half of
/// one.
#[test]
fn portrait_of_a_sine_is_an_ellipse() {
    let (a, omega, n) = (0.3, 7.0, 200);
    let phase = |k: usize| TAU * k as f64 / n as f64;
    let x: Vec<f64> = (0..3 * n).map(|k| a * phase(k).sin()).collect();
    let v: Vec<f64> = (0..3 * n).map(|k| a * omega * phase(k).cos()).collect();
    let portrait = phase_portrait(&x, &v).unwrap();
    let area = 0.5 * TAU * a * a * omega * 3.0;
    assert!((portrait.area() / area - 1.0).abs() < 1e-3, "{} for {area}", portrait.area());
    assert!(portrait.opening(n).unwrap() < 1e-12 && portrait.opening(n / 2).unwrap() > 1.0);
    assert!(portrait.opening(3 * n).is_none() && portrait.opening(0).is_none());
    assert!(matches!(phase_portrait(&x, &v[1..]), Err(StudyError::Lengths { .. })));
}

/// A gyroscopic pair of whirl f0 -+ s/2 (backward falls, forward rises) met by orders 1 and 2: closed form.
#[test]
fn campbell_finds_the_critical_speeds() {
    let speeds: Vec<f64> = (0..=40).map(f64::from).collect();
    let found = campbell(&speeds, &[1.0, 2.0], |s| vec![30.0 + 0.5 * s, 30.0 - 0.5 * s]).unwrap();
    let wanted = [(2.0, 12.0), (1.0, 20.0), (2.0, 20.0)];
    // The forward mode meets order 1 at 60, beyond the diagram.
    assert_eq!(found.resonances.len(), 3, "{:?}", found.resonances);
    for (r, (order, speed)) in found.resonances.iter().zip(wanted) {
        assert!(
            (r.speed - speed).abs() < 1e-12 && (r.frequency - order * speed).abs() < 1e-12 && r.order == order,
            "{r:?}"
        );
    }
    assert!(matches!(campbell(&[0.0, 0.0], &[1.0], |_| vec![1.0]), Err(StudyError::NotAscending { .. })));
    assert!(campbell(&[0.0, 1.0], &[1.0], |s| vec![1.0; 1 + s as usize]).is_err());
    assert!(campbell(&[0.0, 1.0], &[0.0], |_| vec![1.0]).is_err());
}
