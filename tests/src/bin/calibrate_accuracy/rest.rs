//! The table of pairs at rest.

use analysis::accuracy::{CalibratedMesh, Calibration, MeshLaw, PairLaw, PositionsLaw, Quantity, QuantityLaws};
use serde_json::Value;
use verification::{
    measured_pair::{MeasuredPair, POSITIONS, RUNGS},
    pair_law_fit::{Fitted, PairCase, conformal, fit},
};

use super::Failure;

/// Share of the pairs that all bounds of a quantity together hold for.
const COVERAGE: f64 = 0.96;
/// Numbers of positions.
const OF_POSITIONS: [u32; 3] = [8, 16, 32];
/// Pairs that laws are made of, at least.
const LEAST_PAIRS: usize = 20;

/// The table of measured pairs, one a line.
pub(super) fn table(lines: &[Value]) -> Result<Calibration, Failure> {
    // Those without finer meshes are spur pairs whose positions alone were measured.
    let (pairs, spur): (Vec<_>, Vec<_>) =
        lines.iter().filter_map(MeasuredPair::new).partition(MeasuredPair::has_meshes);
    println!("{} pairs, positions of {} spur pairs", pairs.len(), spur.len());
    let mut quantities = Vec::new();
    for q in Quantity::ALL.iter().copied().filter(|q| !q.is_of_motion()) {
        let laws = laws(&pairs, &spur, q).ok_or_else(|| format!("too few pairs with {}", q.key()))?;
        quantities.push(laws);
    }
    Ok(Calibration { pairs: pairs.len(), coverage: COVERAGE, quantities })
}

fn meshes() -> Vec<CalibratedMesh> {
    RUNGS.into_iter().map(CalibratedMesh::Rung).chain([CalibratedMesh::Default]).collect()
}

/// A law of one cause: its cases and what is made of them.
struct Cause {
    cases: Vec<PairCase>,
    fitted: Fitted,
}

/// `of`: difference and error of a pair, on the features of a mesh.
fn cause(
    pairs: &[&MeasuredPair],
    q: Quantity,
    mesh: CalibratedMesh,
    by_difference: bool,
    of: impl Fn(&MeasuredPair) -> Option<[f64; 2]>,
) -> Option<Cause> {
    let case = |pair: &&MeasuredPair| {
        let [difference, error] = of(pair)?;
        let scale = pair.sample(mesh)?.scale(q)?;
        Some(PairCase { features: pair.features(mesh)?, difference, error, scale })
    };
    let cases: Vec<PairCase> = pairs.iter().filter_map(case).collect();
    (cases.len() == pairs.len()).then(|| Cause { fitted: fit(&cases, by_difference), cases })
}

fn laws(pairs: &[MeasuredPair], spur: &[MeasuredPair], q: Quantity) -> Option<QuantityLaws> {
    let whole = |pair: &&MeasuredPair| pair.exact(q).is_some() && pair.slices_error(q).is_some();
    let pairs: Vec<&MeasuredPair> = pairs.iter().filter(whole).collect();
    if pairs.len() < LEAST_PAIRS {
        return None;
    }
    let coarsest = CalibratedMesh::Rung(RUNGS[0]);
    let slices = cause(&pairs, q, coarsest, false, |p| Some([0.0, p.slices_error(q)?]))?;
    let of_mesh = |mesh| Some((mesh, cause(&pairs, q, mesh, false, |p| Some([0.0, p.mesh_error(mesh, q)?]))?));
    let of_positions = |n: u32| {
        let of = |p: &MeasuredPair| Some([p.halved_difference(n, q)?, p.positions_error(n, q)?]);
        Some((n, cause(&pairs, q, coarsest, n > POSITIONS, of)?))
    };
    let mesh: Vec<(CalibratedMesh, Cause)> = meshes().into_iter().map(of_mesh).collect::<Option<_>>()?;
    let positions: Vec<(u32, Cause)> = OF_POSITIONS.into_iter().map(of_positions).collect::<Option<_>>()?;
    // All causes together hold for more pairs than each by itself.
    let mut ratios = Vec::new();
    let mut sharp = Vec::new();
    for (_, m) in &mesh {
        for (_, p) in &positions {
            for i in 0..pairs.len() {
                let all = [m, &slices, p];
                let error: f64 = all.iter().map(|c| c.cases[i].error).sum();
                let [known, within] = [0, 1].map(|k| all.iter().map(|c| c.fitted.held_out[i][k]).sum::<f64>());
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
        shown(&|[e, k, w, s]| (k + joint * w) / e.max(1e-9 * s)),
    );
    let scaled = |c: &Cause| PairLaw { factor: joint * c.fitted.law.factor, ..c.fitted.law.clone() };
    let usual = |c: &Cause| {
        let law = scaled(c);
        let of =
            |c: &PairCase| law.of(&c.features, c.difference, c.scale).iter().map(|x| x.abs()).sum::<f64>() / c.scale;
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
    let coarsest = CalibratedMesh::Rung(RUNGS[0]);
    let ratio = |pair: &MeasuredPair| {
        let (difference, error) = (pair.halved_difference(positions, q)?, pair.positions_error(positions, q)?);
        let [known, within] = law.of(&pair.features(coarsest)?, difference, pair.sample(coarsest)?.scale(q)?);
        Some((error - known).abs() / within)
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
