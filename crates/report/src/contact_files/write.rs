//! The files on contact lines and pattern, which only a run with slices has.

use analysis::results::{GearPattern, patterns};
use ltca::StaticHistory;

use scene::Scene;

use super::{write_contact_lines, write_contact_pattern};
use crate::{
    ReportError, ResultFiles,
    charts::{contact_pattern_figure, contact_pattern_svg},
    paraview::write_pattern_vtu,
};

/// Writes what the scene asks for of the contact; the pattern comes back as a part of the report's page.
///
/// # Errors
/// When the system refuses, or a result is no number.
pub fn write_contact(
    scene: &Scene,
    history: &StaticHistory,
    results: &dyn ResultFiles,
) -> Result<Option<String>, ReportError> {
    if !scene.has_slices() {
        return Ok(None);
    }
    let pair = scene.gear_pair()?;
    if scene.output.contact_lines {
        results.write("contact_lines.csv", write_contact_lines(scene, &pair, history).as_bytes())?;
    }
    let patterns = patterns(scene, &pair, history)?;
    write_patterns(scene, &patterns, results)
}

/// The patterns of both gears; their picture comes back for the report.
///
/// # Errors
/// When the system refuses.
pub fn write_patterns(
    scene: &Scene,
    patterns: &[GearPattern; 2],
    results: &dyn ResultFiles,
) -> Result<Option<String>, ReportError> {
    for pattern in patterns {
        let file = format!("contact_pattern_{}", pattern.name);
        results.write(&format!("{file}.csv"), write_contact_pattern(pattern).as_bytes())?;
        if scene.output.vtu {
            let file = format!("{file}.vtu");
            let mut content = Vec::new();
            write_pattern_vtu(pattern, &mut content)
                .map_err(|cause| ReportError::Write { file: file.clone().into(), cause })?;
            results.write(&file, &content)?;
        }
    }
    let picture = contact_pattern_svg(patterns);
    if let Some(svg) = &picture {
        results.write("contact_pattern.svg", svg.as_bytes())?;
    }
    Ok(picture.map(|svg| contact_pattern_figure(&svg, patterns)))
}
