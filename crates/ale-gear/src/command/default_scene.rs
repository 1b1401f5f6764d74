//! Where the default scene is.

use std::path::{Path, PathBuf};

use crate::error::CommandError;

const PLACE: &str = "scenes/default.toml";

/// The default scene, looked for upwards from the current folder, upwards from the program, and where it was built.
///
/// # Errors
/// Exit status 2 when it is in none of these places.
pub(super) fn find() -> Result<PathBuf, CommandError> {
    let here = std::env::current_dir().ok();
    let program = std::env::current_exe().ok();
    let built = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).map(Path::to_owned);
    let starts = [here.as_deref(), program.as_deref(), built.as_deref()];
    let found =
        starts.into_iter().flatten().flat_map(Path::ancestors).map(|folder| folder.join(PLACE)).find(|p| p.is_file());
    match found {
        // From the top of the repository the short name reads better in messages and in the report.
        Some(_) if Path::new(PLACE).is_file() => Ok(PathBuf::from(PLACE)),
        Some(path) => Ok(path),
        None => Err(CommandError::input(
            format_args!("the default scene {PLACE} is not found"),
            Some("run inside the repository, or give a scene: `ale-gear run SCENE.toml --out DIR`".into()),
        )),
    }
}
