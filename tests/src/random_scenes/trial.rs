//! A scene solved by the program in a folder of its own, its files judged, and at times its mirror image as well.

use std::{fs, io, path::Path};

use super::{Draft, Limits, RandomScene, Refusals, Verdict, attempt::run, judge, mirror};

/// One scene in so many is solved in a mirror as well.
const MIRRORED: u64 = 4;

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
    let words = |scene, out| ["run", scene, "--out", out, "--no-cache", "--quiet", "--threads", "1"];
    let attempt = run(program, folder, &words("scene.toml", "o"), limits)?;
    let mut verdict = Verdict::of(index, scene, &attempt, refusals);
    if matches!(attempt.status, Some(0 | 3)) && !folder.join("o/summary.json").exists() {
        verdict.wrong.push(format!("status {:?}, and there is no summary.json", attempt.status));
    }
    if folder.join("o/summary.json").exists() {
        let judged = judge::judge(&folder.join("o"));
        verdict.remarks = judged.remarks;
        verdict.wrong.extend(judged.wrong);
        if let (0, Some((other, turned))) = (index % MIRRORED, mirror::mirrored(index, scene))
            && attempt.status == Some(0)
        {
            lay_out(&other, folder, "mirrored.toml")?;
            let attempt = run(program, folder, &words("mirrored.toml", "m"), limits)?;
            verdict.mirrored = true;
            verdict.wrong.extend(match attempt.status {
                Some(0) => mirror::compare(&folder.join("o"), &folder.join("m"), turned),
                other => vec![format!("mirrored: status {other:?}, {}", attempt.said.trim())],
            });
        }
    }
    Ok(verdict)
}
