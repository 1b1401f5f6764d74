//! A scene solved by the program in a folder of its own, its files judged, and held against a law.

use std::{fs, io, path::Path};

use super::{Csv, Draft, Limits, RandomScene, Refusals, Verdict, attempt::run, judge, laws::law_of};

/// One scene in so many is held against a law.
const HELD: u64 = 3;

/// Share by which a number of a case may differ from that of its document alone: cases share windows.
const SAME: f64 = 1e-7;

/// In the message of a number that is not in its range.
const OUT_OF_RANGE: &str = ", allowed is ";

/// Writes a scene and its files into a folder.
fn lay_out(draft: &Draft, folder: &Path, name: &str) -> io::Result<()> {
    fs::write(folder.join(name), draft.text().map_err(io::Error::other)?)?;
    for (file, content) in &draft.files {
        fs::write(folder.join(file), content)?;
    }
    let link = folder.join("meshes");
    if !link.exists() {
        std::os::unix::fs::symlink(testing::meshes_folder().canonicalize()?, link)?;
    }
    Ok(())
}

fn words<'a>(scene: &'a str, out: &'a str) -> [&'a str; 8] {
    ["run", scene, "--out", out, "--no-cache", "--quiet", "--threads", "1"]
}

/// Solves a scene in an empty folder, and says what became of it.
///
/// # Errors
/// When files cannot be written or no process can be started: nothing of the scene's.
pub fn try_scene(
    program: &Path,
    folder: &Path,
    index: u64,
    scene: &RandomScene,
    (limits, refusals): (Limits, &Refusals),
) -> io::Result<Verdict> {
    lay_out(&scene.draft, folder, "scene.toml")?;
    let attempt = run(program, folder, &words("scene.toml", "o"), limits)?;
    let mut verdict = Verdict::of(index, scene, &attempt, refusals);
    if matches!(attempt.status, Some(0 | 3)) && !folder.join("o/summary.json").exists() {
        verdict.wrong.push(format!("status {:?}, and there is no summary.json", attempt.status));
    }
    if folder.join("o/summary.json").exists() {
        let judged = judge::judge(&folder.join("o"));
        verdict.remarks = judged.remarks;
        verdict.wrong.extend(judged.wrong);
        if scene.model == "plan" {
            verdict.wrong.extend(same_case(program, folder, limits)?);
        }
        if let (0, Some(0), Some((law, told))) = (index % HELD, attempt.status, law_of(index / HELD, scene)) {
            verdict.law = Some(law);
            let solve = |draft: &Draft, name: &str| {
                lay_out(draft, folder, &format!("{name}.toml"))?;
                run(program, folder, &words(&format!("{name}.toml"), name), limits)
            };
            // The scene itself, or what stands for it, and then the other way.
            let first = told.first.as_ref().map(|first| solve(first, "first")).transpose()?;
            let one = if first.is_some() { "first" } else { "o" };
            let first = first.map_or(Some(0), |attempt| attempt.status);
            let other = solve(&told.other, "other")?;
            let compared = match (first, other.status) {
                (Some(0), Some(0)) => (told.compare)(&folder.join(one), &folder.join("other")),
                // What has no answer in one way has none in the other; told in another way, a number may leave its range.
                (one, status) if one == status => Vec::new(),
                _ if other.said.contains(OUT_OF_RANGE) => Vec::new(),
                (one, status) => vec![format!("status {one:?}, and {status:?}: {}", other.said.trim())],
            };
            verdict.wrong.extend(compared.into_iter().map(|wrong| format!("{law}: {wrong}")));
        }
    }
    Ok(verdict)
}

/// The first solved case of a plan is the run of its document with the keys of that case: the same numbers.
fn same_case(program: &Path, folder: &Path, limits: Limits) -> io::Result<Vec<String>> {
    let Ok(cases) = Csv::read(&folder.join("o/cases.csv")) else { return Ok(Vec::new()) };
    let at = |name: &str| cases.names.iter().position(|n| n == name);
    let Some(status) = at("status") else { return Ok(Vec::new()) };
    let Some(row) = cases.rows.iter().find(|row| row[status] == "solved") else { return Ok(Vec::new()) };
    let keys = cases.names.iter().zip(row).filter(|(name, _)| name.contains('.') && !name.contains('('));
    let set: Vec<String> = keys.map(|(name, value)| format!("{name}={value}")).collect();
    let text = fs::read_to_string(folder.join("scene.toml"))?;
    let mut table: toml::Table = text.parse().map_err(io::Error::other)?;
    table.remove("vary");
    fs::write(folder.join("case.toml"), toml::to_string(&table).map_err(io::Error::other)?)?;
    let mut all = words("case.toml", "case").to_vec();
    set.iter().for_each(|word| all.extend(["--set", word.as_str()]));
    let alone = run(program, folder, &all, limits)?;
    if !matches!(alone.status, Some(0 | 3)) {
        return Ok(vec![format!("case {} is solved in the plan; alone: {}", row[0], alone.said.trim())]);
    }
    let summary: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("case/summary.json"))?)?;
    let numbers = cases.names.iter().zip(row).filter_map(|(name, cell)| {
        let (alone, planned) = (summary["headline"][name.as_str()].as_f64()?, cell.parse::<f64>().ok()?);
        let differs = (alone - planned).abs() > SAME * alone.abs();
        differs.then(|| format!("case {}: {name} is {planned} in the plan, {alone} alone", row[0]))
    });
    Ok(numbers.collect())
}
