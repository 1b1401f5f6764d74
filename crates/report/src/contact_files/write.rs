//! The files on contact patterns, which only a run with slices has.

use analysis::results::GearPattern;
use answer::Table;
use scene::Scene;

use super::pattern_table;
use crate::{
    ReportError,
    charts::{contact_pattern_figure, contact_pattern_svg},
};
use export::paraview::write_pattern_vtu;
use store::{ResultFiles, StoreError};

/// Names of the tables of both patterns.
const NAMES: [&str; 2] = ["contact_pattern_pinion", "contact_pattern_wheel"];

/// Writes the pictures of both patterns, and what ParaView takes where the scene asks for it; their rows come back.
///
/// # Errors
/// When the system refuses.
pub fn write_patterns(
    scene: &Scene,
    patterns: &[GearPattern; 2],
    results: &dyn ResultFiles,
) -> Result<Vec<Table>, ReportError> {
    for (pattern, name) in patterns.iter().zip(NAMES).filter(|_| scene.output.vtu) {
        let file = format!("{name}.vtu");
        let mut content = Vec::new();
        write_pattern_vtu(pattern, &mut content)
            .map_err(|cause| StoreError::Write { file: file.clone().into(), cause })?;
        results.write(&file, &content)?;
    }
    if let Some(svg) = contact_pattern_svg(patterns) {
        results.write("contact_pattern.svg", svg.as_bytes())?;
    }
    Ok(patterns.iter().zip(NAMES).map(|(pattern, name)| pattern_table(name, pattern)).collect())
}

/// Both patterns as a part of a page.
pub fn pattern_figure(patterns: &[GearPattern; 2]) -> Option<String> {
    contact_pattern_svg(patterns).map(|svg| contact_pattern_figure(&svg, patterns))
}
