//! The table of pairs at rest.

use std::collections::BTreeMap;

use analysis::accuracy::{
    CalibratedMesh, Calibration, MeshLaw, PairLaw, PositionsLaw, Quantity, QuantityLaws, together,
};
use serde_json::Value;
use verification::{
    held_out::{held_out, spur_alone},
    measured_pair::{LEAST_ERROR, MeasuredPair, RUNGS},
    pair_bounds::ratios,
    pair_law_fit::{Fitted, Known, PairCase, conformal, fit},
};

use super::Failure;

/// Share of the pairs that all bounds of a quantity together hold for.
const COVERAGE: f64 = 0.96;
/// Numbers of positions.
const OF_POSITIONS: [u32; 3] = [8, 16, 32];
/// Pairs that laws are made of, at least.
const LEAST_PAIRS: usize = 20;

/// The table of measured pairs.
pub(super) fn table(lines: &[Value]) -> Result<Calibration, Failure> {
    let all = MeasuredPair::all(lines);
    if let Some(pair) = all.iter().find(|pair| held_out(pair.seed)) {
        return Err(format!("pairs of seed {} are for checks alone", pair.seed).into());
    }
    let mut made_of = BTreeMap::<u64, Vec<u64>>::new();
    all.iter().for_each(|pair| made_of.entry(pair.seed).or_default().push(pair.index));
    // Some spur pairs say alone how much wider the bounds of their positions are.
    let (spur, all): (Vec<_>, Vec<_>) = all.into_iter().partition(|pair| spur_alone(pair.seed));
    // So do internal pairs of all their bounds.
    let (rings, all): (Vec<_>, Vec<_>) = all.into_iter().partition(|pair| pair.scene.wheel.is_internal());
    let of_curves: Vec<&MeasuredPair> = all.iter().filter(|pair| pair.has_curves()).collect();
    let pairs: Vec<&MeasuredPair> = of_curves.iter().copied().filter(|pair| pair.has_meshes()).collect();
    println!("{} pairs on meshes, curves of {} pairs and of {} spur pairs", pairs.len(), of_curves.len(), spur.len());
    let mut quantities = Vec::new();
    for alike in ALIKE {
        let laws = laws_of_alike(&pairs, &of_curves, &spur, alike);
        let laws = laws.ok_or_else(|| format!("too few pairs with {}", alike.0[0].key()))?;
        let with_rings = laws.into_iter().zip(alike.0).map(|(laws, q)| {
            let ratios = rings.iter().flat_map(|pair| ratios(pair, *q, &laws)).collect();
            let internal = conformal(ratios, COVERAGE).max(1.0);
            println!("{:24} {internal:.2} times the bound for {} internal pairs", q.key(), rings.len());
            QuantityLaws { internal, ..laws }
        });
        quantities.extend(with_rings);
    }
    Ok(Calibration { pairs: pairs.len(), made_of, coverage: COVERAGE, quantities })
}

fn meshes() -> Vec<CalibratedMesh> {
    RUNGS.into_iter().map(CalibratedMesh::Rung).chain([CalibratedMesh::Default]).collect()
}

/// Quantities whose errors go alike with what is known of a pair, and whether something is known of the errors themselves:
/// of the deflection that elements are too stiff.
const ALIKE: [(&[Quantity], Known); 6] = [
    (&[Quantity::MeanSte, Quantity::MeshStiffness, Quantity::MeshStiffnessTangent], Known::Features),
    (
        &[Quantity::PeakToPeakSte, Quantity::FirstSteHarmonic, Quantity::SecondSteHarmonic, Quantity::ThirdSteHarmonic],
        Known::Nothing,
    ),
    (&[Quantity::MaxPairForce], Known::Nothing),
    (&[Quantity::MaxPressure], Known::Nothing),
    (&[Quantity::PinionRootStress, Quantity::WheelRootStress], Known::Nothing),
    (&[Quantity::ContactLineLength], Known::Nothing),
];

/// A law of one cause: its cases and what is made of them.
struct Cause {
    cases: Vec<PairCase>,
    fitted: Fitted,
}

impl Cause {
    /// Causes whose laws have spreads that go alike.
    fn alike(sets: Vec<Vec<PairCase>>, known: Known) -> Vec<Self> {
        let fitted = fit(&sets, known);
        sets.into_iter().zip(fitted).map(|(cases, fitted)| Self { cases, fitted }).collect()
    }

    /// Error of a case, and what the law of the others says of it: known part and bound.
    fn held_out(&self, case: usize) -> [f64; 3] {
        let [known, within] = self.fitted.held_out[case];
        [self.cases[case].error, known, within]
    }
}

/// Cases of a quantity on a mesh; `None` where a pair has none.
fn on_mesh(
    pairs: &[&MeasuredPair],
    q: Quantity,
    mesh: CalibratedMesh,
    error: impl Fn(&MeasuredPair) -> Option<f64>,
) -> Option<Vec<PairCase>> {
    let of = |(number, pair): (usize, &&MeasuredPair)| {
        let (features, sample) = (pair.features(mesh)?, pair.sample(mesh)?);
        let seen = pair.number(q, sample.get(q)?);
        Some(PairCase { pair: number, features, seen, error: error(pair)?, scale: sample.scale(q)? })
    };
    pairs.iter().enumerate().map(of).collect()
}

fn at_positions((number, pair): (usize, &MeasuredPair), q: Quantity, n: u32) -> Option<PairCase> {
    let (features, seen) = (pair.features_of_positions(n)?, pair.seen(n, q)?);
    let (error, scale) = (pair.positions_error(n, q)?, pair.of_positions(n)?.scale(q)?);
    Some(PairCase { pair: number, features, seen, error, scale })
}

/// Laws of quantities whose errors go alike; `None` where too few pairs have them.
fn laws_of_alike(
    pairs: &[&MeasuredPair],
    of_curves: &[&MeasuredPair],
    spur: &[MeasuredPair],
    (quantities, known): (&[Quantity], Known),
) -> Option<Vec<QuantityLaws>> {
    let whole = |pair: &&MeasuredPair, q: Quantity| pair.exact(q).is_some() && pair.slices_error(q).is_some();
    let pairs: Vec<&MeasuredPair> =
        pairs.iter().copied().filter(|pair| quantities.iter().all(|q| whole(pair, *q))).collect();
    if pairs.len() < LEAST_PAIRS {
        return None;
    }
    let coarsest = CalibratedMesh::Rung(RUNGS[0]);
    let of_slices = |q: &Quantity| on_mesh(&pairs, *q, coarsest, |p| p.slices_error(*q));
    let slices = quantities.iter().map(of_slices).collect::<Option<Vec<_>>>()?;
    let meshes = meshes();
    let of_mesh = |(q, mesh): (Quantity, CalibratedMesh)| on_mesh(&pairs, q, mesh, |p| p.mesh_error(mesh, q));
    let on_meshes = quantities.iter().flat_map(|q| meshes.iter().map(|mesh| (*q, *mesh)));
    let on_meshes = on_meshes.map(of_mesh).collect::<Option<Vec<_>>>()?;
    let mut on_meshes = Cause::alike(on_meshes, known).into_iter();
    let each = quantities.iter().zip(Cause::alike(slices, known));
    each.map(|(q, slices)| {
        let mesh = meshes.iter().copied().zip(on_meshes.by_ref().take(meshes.len())).collect();
        laws((&pairs, of_curves, spur), *q, mesh, slices)
    })
    .collect()
}

/// Pairs on meshes, pairs with curves, spur pairs.
type Pairs<'a> = (&'a [&'a MeasuredPair], &'a [&'a MeasuredPair], &'a [MeasuredPair]);

fn laws(
    (pairs, of_curves, spur): Pairs<'_>,
    q: Quantity,
    mesh: Vec<(CalibratedMesh, Cause)>,
    slices: Cause,
) -> Option<QuantityLaws> {
    // Those on meshes come first: their cases have the same numbers in all laws.
    let others =
        of_curves.iter().copied().filter(|pair| pairs.iter().all(|p| (p.seed, p.index) != (pair.seed, pair.index)));
    let with_curves: Vec<&MeasuredPair> = pairs.iter().copied().chain(others).collect();
    let of_positions = |n: u32| {
        let cases: Vec<Option<PairCase>> =
            with_curves.iter().enumerate().map(|(i, pair)| at_positions((i, pair), q, n)).collect();
        let are_whole = cases[..pairs.len()].iter().all(Option::is_some);
        are_whole.then(|| cases.into_iter().flatten().collect())
    };
    let sets = OF_POSITIONS.into_iter().map(of_positions).collect::<Option<Vec<_>>>()?;
    let positions: Vec<(u32, Cause)> = OF_POSITIONS.into_iter().zip(Cause::alike(sets, Known::Shape)).collect();
    // All causes together hold for more pairs than each by itself.
    let mut ratios = Vec::new();
    let mut sharp = Vec::new();
    for (_, m) in &mesh {
        for (_, p) in &positions {
            for i in 0..pairs.len() {
                let all = [m, &slices, p].map(|c| c.held_out(i));
                let [error, known] = [0, 1].map(|k| all.iter().map(|c| c[k]).sum::<f64>());
                let within = together(&all.map(|[_, _, within]| within));
                ratios.push((error - known).abs() / within);
                sharp.push([error.abs(), known.abs(), within, m.cases[i].scale]);
            }
        }
    }
    let joint = conformal(ratios, COVERAGE);
    let shown = |of: &dyn Fn(&[f64; 4]) -> f64| median(sharp.iter().map(of).collect());
    println!(
        "{:24} {} pairs, joint {joint:5.2}: error {:7.3} %, bound of the corrected {:7.3} %, bound over error {:5.2}",
        q.key(),
        pairs.len(),
        100.0 * shown(&|[e, _, _, s]| e / s),
        100.0 * shown(&|[_, _, w, s]| joint * w / s),
        shown(&|[e, k, w, s]| (k + joint * w) / e.max(LEAST_ERROR * s)),
    );
    let scaled = |c: &Cause| PairLaw { factor: joint * c.fitted.law.factor, ..c.fitted.law.clone() };
    let usual = |c: &Cause| {
        let law = scaled(c);
        let of = |c: &PairCase| law.of(&c.features, &c.seen, c.scale).iter().map(|x| x.abs()).sum::<f64>() / c.scale;
        quantile(c.cases.iter().map(of).collect(), 0.6)
    };
    for (n, c) in &positions {
        let raw = median(c.cases.iter().map(|c| 100.0 * (c.error / c.scale).abs()).collect());
        let bound =
            median(c.fitted.held_out.iter().zip(&c.cases).map(|(h, c)| 100.0 * joint * h[1] / c.scale).collect());
        println!(
            "    {n} positions: error {raw:.3} %, bound of the corrected {bound:.3} %, usual {:.3} %",
            100.0 * usual(c)
        );
    }
    for (mesh, c) in &mesh {
        let raw = median(c.cases.iter().map(|c| 100.0 * (c.error / c.scale).abs()).collect());
        let bound =
            median(c.fitted.held_out.iter().zip(&c.cases).map(|(h, c)| 100.0 * joint * h[1] / c.scale).collect());
        println!(
            "    {mesh:?}: error {raw:.3} %, bound of the corrected {bound:.3} %, usual {:.3} %",
            100.0 * usual(c)
        );
    }
    Some(QuantityLaws {
        internal: 1.0,
        quantity: q.key().to_owned(),
        mesh: mesh.iter().map(|(mesh, c)| MeshLaw { mesh: *mesh, law: scaled(c) }).collect(),
        slices: scaled(&slices),
        positions: positions
            .iter()
            .map(|(positions, c)| {
                let law = scaled(c);
                let spur = spur_factor(spur, q, (*positions, &law));
                println!("    {positions} positions: {spur:.2} times the bound for spur pairs");
                PositionsLaw { positions: *positions, law, usual: usual(c), spur }
            })
            .collect(),
    })
}

/// How many times the bound of a law holds for the share of the spur pairs, none of which it was made of.
fn spur_factor(pairs: &[MeasuredPair], q: Quantity, (positions, law): (u32, &PairLaw)) -> f64 {
    let ratio = |pair: &MeasuredPair| {
        let case = at_positions((0, pair), q, positions)?;
        let [known, within] = law.of(&case.features, &case.seen, case.scale);
        Some((case.error - known).abs() / within)
    };
    let ratios: Vec<f64> = pairs.iter().filter_map(ratio).collect();
    conformal(ratios, COVERAGE).max(1.0)
}

fn median(all: Vec<f64>) -> f64 {
    quantile(all, 0.5)
}

fn quantile(mut all: Vec<f64>, share: f64) -> f64 {
    all.sort_unstable_by(f64::total_cmp);
    all.get((all.len() as f64 * share) as usize).copied().unwrap_or(f64::INFINITY)
}
