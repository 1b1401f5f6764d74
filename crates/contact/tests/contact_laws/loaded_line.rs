//! Length of a loaded line from a few stations.

use contact::line::{LineStation, covered, loaded_intervals};

/// Length of the line of a gap g and a deflection o, from `count` stations over a face of 20 mm of which those that
/// gape by more than `reach` are not known.
fn length(g: impl Fn(f64) -> f64, o: impl Fn(f64) -> f64, count: usize, reach: f64) -> f64 {
    let stations: Vec<f64> = (0..count).map(|i| 20.0 * ((i as f64 + 0.5) / count as f64 - 0.5)).collect();
    let known = |&z: &f64| (g(z) <= reach).then(|| LineStation { gap: g(z) + o(z), opened: o(z) });
    let solved: Vec<_> = stations.iter().map(known).collect();
    covered(&loaded_intervals(&stations, &solved, [-10.0, 10.0], |_, z| g(z), |_, z| o(z)), [-10.0, 10.0])
}

/// A crowned line that shrinks to nothing: from nine stations and from ninety, to a 10^4th, wherever its middle lies.
#[test]
fn crowned_lines_have_their_length_from_few_stations() {
    for middle in [0.0, 0.3, 1.111, 2.0] {
        for loaded in [0.3, 1.0, 2.5, 6.0] {
            let g = |z: f64| 1e-3 * ((z - middle).powi(2) - loaded * loaded - 4.0) - 1e-3;
            let o = |z: f64| 1e-3 * (5.0 + 0.02 * (z - middle).powi(2));
            let wanted = 2.0 * loaded / 1.02_f64.sqrt();
            for count in [9, 90] {
                let found = length(g, o, count, 10.0);
                assert!((found / wanted - 1.0).abs() < 1e-4, "{count} stations about {middle}: {found}, not {wanted}");
            }
        }
    }
}

/// A line that ends at tip edges, where the gap rises steeply and stations beyond are not looked at: continuous, exact,
/// also where it has come over an end face but to no station.
#[test]
fn lines_that_end_at_edges_are_continuous() {
    for k in 0..200 {
        let from = -10.3 + 0.1 * f64::from(k);
        let g = |z: f64| if z < from { 0.5 * (from - z).powi(2) + (from - z) - 0.01 } else { -0.01 };
        let o = |z: f64| 0.004 + 1e-4 * z;
        // Beyond the edge the overlap is made up within some hundredths of a mm.
        let edge = {
            let (mut inside, mut outside) = (from, from - 1.0);
            for _ in 0..60 {
                let middle = 0.5 * (inside + outside);
                if g(middle) + o(middle) < 0.0 { inside = middle } else { outside = middle }
            }
            inside
        };
        let wanted = 10.0 - edge.max(-10.0);
        let found = length(g, o, 32, 0.02);
        // Next to the far face one station alone knows of a deflection that is not the same everywhere.
        let allowed = if wanted > 1.5 { 2e-6 } else { 2e-4 };
        assert!((found - wanted).abs() < allowed, "from {from}: {found}, not {wanted}");
    }
}

/// A line that has come over an end face and to no station, with none of them near enough to be known: there as well, at
/// either face.
#[test]
fn corner_pieces_beside_unknown_stations_are_found() {
    for (piece, side) in [0.01, 0.1, 0.25, 0.3].into_iter().flat_map(|piece| [(piece, 1.0), (piece, -1.0)]) {
        let from = 10.0 - piece;
        let g = |z: f64| if side * z < from { 0.5 * (from - side * z) - 0.002 } else { -0.002 };
        let o = |_: f64| 0.001;
        // The overlap is made up within 2 um of the height.
        let found = length(g, o, 32, 1e-4);
        assert!((found - (piece + 0.002)).abs() < 1e-8, "{piece} at {side}: {found}");
    }
}

/// Pressed all over, nowhere, and flanks that do not face each other beyond a height.
#[test]
fn whole_empty_and_displaced() {
    let flat = |at: f64| move |_: f64| at;
    assert_eq!(length(flat(-1.0), flat(0.5), 4, 1.0), 20.0);
    assert_eq!(length(flat(1.0), flat(0.5), 4, 2.0), 0.0);
    assert_eq!(length(flat(1.0), flat(0.5), 4, 0.0), 0.0);
    let facing = |z: f64| if z > 3.0 { f64::INFINITY } else { -1.0 };
    let found = length(facing, flat(0.5), 8, 1.0);
    assert!((found - 13.0).abs() < 1e-5, "{found}");
}
