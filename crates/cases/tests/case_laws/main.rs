//! Laws of plans: every combination once, samples that fill their distributions, the same numbers for the same seed.

use cases::{Axis, Cases, CasesError, Design, Distribution, Sampling, around_a_circle, spread};

const DESIGNS: [Design; 3] = [Design::LatinHypercube, Design::Sobol, Design::Random];

fn sampling(design: Design, samples: u32) -> Sampling {
    Sampling { design, samples, seed: 7 }
}

fn normal(mean: f64, deviation: f64) -> Distribution {
    Distribution::Normal { mean, deviation, least: f64::NEG_INFINITY, largest: f64::INFINITY }
}

/// Every combination of two lists with every sample, once; the last axis is the fastest.
#[test]
fn every_combination_is_there_once() {
    let axes = vec![
        Axis::Each(vec![1.0, 2.0, 3.0]),
        Axis::Drawn(Distribution::Uniform { from: 0.0, to: 1.0 }),
        Axis::Each(vec![10.0, 20.0]),
    ];
    let cases = Cases::new(axes, &sampling(Design::Sobol, 5)).unwrap();
    assert_eq!((cases.count(), cases.samples()), (30, 5));
    let all: Vec<Vec<f64>> = (0..30).map(|i| cases.values(i)).collect();
    for (i, values) in all.iter().enumerate() {
        assert_eq!([values[0], values[2]], [1.0 + ((i % 6) / 2) as f64, 10.0 * (1 + i % 2) as f64], "case {i}");
        // One sample is shared by its combinations.
        assert_eq!(values[1], all[6 * (i / 6)][1], "case {i}");
    }
    let alone = Cases::new(vec![Axis::Each(vec![4.0, 5.0])], &sampling(Design::Random, 100)).unwrap();
    assert_eq!(alone.count(), 2, "nothing is drawn: no samples");
}

/// Mean and deviation of what is drawn are those of its distribution, within four standard errors of random samples.
#[test]
fn samples_have_the_moments_of_their_distributions() {
    let thirds = Distribution::Normal { mean: 0.0, deviation: 1.0, least: 0.0, largest: f64::INFINITY };
    for (of, mean, deviation) in [
        (Distribution::Uniform { from: -2.0, to: 4.0 }, 1.0, 3f64.sqrt()),
        (normal(5.0, 2.0), 5.0, 2.0),
        // Half of a normal distribution: sqrt(2 / pi), sqrt(1 - 2 / pi).
        (thirds, 0.797_884_560_8, 0.602_810_275_0),
        // ln x uniform over ln 1 .. ln e: e - 1, sqrt((e^2 - 1) / 2 - (e - 1)^2).
        (Distribution::LogUniform { from: 1.0, to: std::f64::consts::E }, 1.718_281_828, 0.491_8),
    ] {
        for design in DESIGNS {
            const N: u32 = 4096;
            let axes = vec![Axis::Drawn(of), Axis::Drawn(normal(0.0, 1.0))];
            let cases = Cases::new(axes, &sampling(design, N)).unwrap();
            let drawn: Vec<Vec<f64>> = (0..cases.count()).map(|i| cases.values(i)).collect();
            let average = |f: &dyn Fn(&[f64]) -> f64| drawn.iter().map(|x| f(x)).sum::<f64>() / f64::from(N);
            let found = average(&|x| x[0]);
            let spread = average(&|x| (x[0] - found).powi(2)).sqrt();
            let error = 4.0 * deviation / f64::from(N).sqrt();
            assert!((found - mean).abs() < error, "{of:?} by {design:?}: mean {found}, not {mean}");
            assert!((spread - deviation).abs() < error, "{of:?} by {design:?}: deviation {spread}, not {deviation}");
            let together = average(&|x| (x[0] - found) * x[1]) / deviation;
            assert!(together.abs() < 4.0 / f64::from(N).sqrt(), "{design:?}: axes are correlated by {together}");
        }
    }
}

/// A Latin hypercube has one sample in each part of each axis.
#[test]
fn a_latin_hypercube_has_every_part_once() {
    let unit = Axis::Drawn(Distribution::Uniform { from: 0.0, to: 1.0 });
    let cases = Cases::new(vec![unit; 3], &sampling(Design::LatinHypercube, 50)).unwrap();
    for axis in 0..3 {
        let mut parts: Vec<u32> = (0..50).map(|i| (50.0 * cases.values(i)[axis]) as u32).collect();
        parts.sort_unstable();
        assert_eq!(parts, (0..50).collect::<Vec<_>>(), "axis {axis}");
    }
}

/// Limits hold, quantiles grow, and the same seed gives the same numbers, another one others.
#[test]
fn limits_and_seeds_hold() {
    let limited = Distribution::Normal { mean: 0.0, deviation: 10.0, least: -3.0, largest: 1.0 };
    let of = |seed, design| {
        let cases = Cases::new(vec![Axis::Drawn(limited)], &Sampling { design, samples: 200, seed }).unwrap();
        (0..200).map(|i| cases.values(i)[0]).collect::<Vec<f64>>()
    };
    for design in DESIGNS {
        let [a, b, c] = [of(1, design), of(1, design), of(2, design)];
        assert!(a == b && a != c, "{design:?}");
        assert!(a.iter().all(|x| (-3.0..=1.0).contains(x)), "{design:?}: {a:?}");
    }
    let quantiles: Vec<f64> = (0..=100).map(|i| limited.quantile(f64::from(i) / 100.0)).collect();
    assert!(quantiles.windows(2).all(|w| w[0] < w[1]), "{quantiles:?}");
}

/// What makes no cases is an error that says why.
#[test]
fn senseless_plans_are_errors() {
    let of = |axes: Vec<Axis>, samples| Cases::new(axes, &sampling(Design::Sobol, samples)).map(|_| ()).unwrap_err();
    assert_eq!(of(vec![Axis::Each(vec![])], 1), CasesError::NoValues { axis: 0 });
    let unit = Axis::Drawn(Distribution::Uniform { from: 0.0, to: 1.0 });
    for bad in [
        Distribution::Uniform { from: 1.0, to: 1.0 },
        Distribution::LogUniform { from: 0.0, to: 1.0 },
        normal(0.0, 0.0),
        normal(f64::NAN, 1.0),
        Distribution::Normal { mean: 0.0, deviation: 1.0, least: 9.0, largest: 10.0 },
    ] {
        assert!(matches!(of(vec![unit.clone(), Axis::Drawn(bad)], 4), CasesError::NoDistribution { axis: 1, .. }));
    }
    assert!(matches!(of(vec![unit; 1], 70_000), CasesError::TooMany { .. }));
    let many = Axis::Each(vec![0.0; 10_000]);
    assert!(matches!(of(vec![many.clone(), many], 1), CasesError::TooMany { what: "cases", .. }));
}

/// Places around a circle close: what lies between neighbours sums to 0, none of it beyond its limit, and no two places
/// are farther apart than theirs. The same draw makes the same circle, another one another.
#[test]
fn deviations_around_a_circle_close_within_their_limits() {
    for (count, step, range) in [(17, 5.0, 30.0), (30, 6.3, 19.7), (500, 6.0, 26.0), (8, 2.0, 3.0)] {
        for i in 0..100 {
            let draw = f64::from(i) / 100.0;
            let places = around_a_circle(draw, count, [step, range]);
            assert_eq!(places.len(), count as usize);
            assert_eq!(places, around_a_circle(draw, count, [step, range]), "draw {draw}");
            assert_ne!(places, around_a_circle(draw + 1e-9, count, [step, range]), "draw {draw}");
            assert!(places.iter().sum::<f64>().abs() < 1e-9 * range, "draw {draw}: mean");
            let last = places[places.len() - 1];
            let before = [last].into_iter().chain(places.iter().copied());
            let largest = before.zip(&places).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
            assert!(largest <= step * (1.0 + 1e-12), "draw {draw}: a step of {largest}, {step} is allowed");
            let apart = spread(&places);
            assert!(apart <= range * (1.0 + 1e-12), "draw {draw}: {apart} apart, {range} are allowed");
        }
    }
}

/// Where the range does not bind, steps have a third of their limit as their deviation: 200 circles of 30 places,
/// within 3 % (four standard errors of 6000 steps, and the thirtieth that closing takes).
#[test]
fn steps_around_a_circle_have_a_third_of_their_limit() {
    let (count, step) = (30u32, 6.0);
    let squares: f64 = (0..200)
        .flat_map(|i| {
            let places = around_a_circle(f64::from(i) / 200.0, count, [step, 1e9]);
            let last = places[places.len() - 1];
            let steps: Vec<f64> =
                [last].into_iter().chain(places.iter().copied()).zip(&places).map(|(a, b)| b - a).collect();
            steps
        })
        .map(|own| own * own)
        .sum();
    let found = (squares / (200.0 * f64::from(count))).sqrt();
    // Limits at three deviations leave 0.9733 of the variance; closing takes one part in 30.
    let wanted = step / 3.0 * (0.9733f64 * (1.0 - 1.0 / 30.0)).sqrt();
    assert!((found / wanted - 1.0).abs() < 0.03, "deviation {found}, not {wanted}");
}
