//! Random plans: a random pair at rest with some of its numbers varied.

use super::{Draft, RandomScene, draw, told::is_at_rest, whole_range::keys_with_range};

/// Samples of a plan.
const SAMPLES: [u32; 2] = [1, 4];
/// Numbers that are asked for: of the headline, of columns, and what is none.
const OUTPUTS: [&str; 6] = [
    "mean_ste_um",
    "peak_to_peak_ste_um",
    "max_pressure_mpa",
    "largest(ste_um)",
    "least(contact_line_length_mm)",
    "no_such_um",
];

/// Plan number `index` of a seed.
pub fn draw_plan(seed: u64, index: u64) -> RandomScene {
    // A plan runs its pair some ten times: at rest, and not with every degree of freedom.
    let pairs = (0..).map(|k| draw(seed, TRIED * index + k));
    let RandomScene { draft, foreign, .. } = pairs
        .take(TRIED as usize)
        .find(|pair| is_at_rest(pair) && pair.model != "full" && !pair.foreign && pair.draft.get("accuracy").is_none())
        .unwrap_or_else(|| draw(seed, index));
    let mut d = Draft::new(seed ^ PLANS, index);
    let mut scene = draft;
    // A plan rates nothing that it is not asked for.
    scene.unset("rating");
    let mut axes: Vec<String> = (0..d.whole(1, 3)).filter_map(|_| axis(&mut d, &scene)).collect();
    // Rarely a key that is varied twice.
    if d.chance(0.95) {
        let mut seen = Vec::new();
        axes.retain(|axis| {
            let key = axis.split(['=', '~']).next().unwrap_or_default().to_owned();
            let is_new = !seen.contains(&key);
            seen.push(key);
            is_new
        });
    }
    scene.set("vary.keys", axes.into_iter().map(scene::Value::from).collect::<Vec<_>>());
    scene.set("vary.samples", i64::from(d.whole(SAMPLES[0], SAMPLES[1])));
    let count = if d.chance(0.05) { OUTPUTS.len() } else { OUTPUTS.len() - 1 };
    let asked = d.some_of(&OUTPUTS[..count]);
    scene.set("vary.output", if asked.is_empty() { vec![OUTPUTS[0].into()] } else { asked });
    if d.chance(0.3) {
        scene.set("vary.design", d.pick(&["sobol", "random", "latin-hypercube", "grid"]));
    }
    RandomScene { draft: scene, model: "plan", anything: true, foreign }
}

/// Pairs among which one for a plan is looked for.
const TRIED: u64 = 32;
/// What tells plans from the pairs of the same seed.
const PLANS: u64 = 0x706c_616e;

/// An axis over a number of the scene, or over any key with a range.
fn axis(d: &mut Draft, scene: &Draft) -> Option<String> {
    let known: Vec<String> = scene.keys().into_iter().filter(|key| scene.number(key).is_some()).collect();
    let (key, [low, high]) = if d.chance(0.8) && !known.is_empty() {
        let key = known[d.whole(0, known.len() as u32 - 1) as usize].clone();
        let at = scene.number(&key)?;
        // A whole number stays one.
        let is_whole = scene.get(&key).is_some_and(|value| value.is_integer());
        (key, [at, if is_whole { at + 2.0 } else { at + 0.2 * at.abs().max(1e-3) }])
    } else {
        let all = keys_with_range();
        let (key, range) = &all[d.whole(0, all.len() as u32 - 1) as usize];
        (key.clone(), *range)
    };
    let kinds = if low.fract() == 0.0 && high.fract() == 0.0 { 1 } else { 3 };
    Some(match d.whole(0, kinds) {
        0 => format!("{key}={low},{high}"),
        1 => format!("{key}={low}:{high}:3"),
        2 => format!("{key}~normal:{low}:{}", high - low),
        _ => format!("{key}~{low}:{high}"),
    })
}
