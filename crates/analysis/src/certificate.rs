//! Checks that a result of a scene must pass.

pub use answer::{Check, Checks};
use scene::Scene;

use crate::AnalysisError;

/// Whether all checks pass.
///
/// # Errors
/// [`AnalysisError::Certificate`]: the first failed check with its value and limit, and the number of further failed
/// checks.
pub fn verdict(checks: &Checks, scene: &Scene) -> Result<(), AnalysisError> {
    let Some(failed) = checks.failed() else { return Ok(()) };
    Err(AnalysisError::Certificate(failed).in_file(&scene.file))
}

/// A kind of check, for `docs/outputs.md`.
#[derive(Debug, Clone, Copy)]
pub struct CheckKind {
    /// Names of the checks; `<k>` is the number of a mesh.
    pub name: &'static str,
    /// Limit in words.
    pub bound: &'static str,
    /// Results to which the check applies.
    pub of: &'static str,
    /// Meaning of the value.
    pub meaning: &'static str,
}

const fn kind(name: &'static str, bound: &'static str, of: &'static str, meaning: &'static str) -> CheckKind {
    CheckKind { name, bound, of, meaning }
}

const AT_REST: &str = "positions at rest; the quasi-static cycle of a motion or a sweep";
const IN_MOTION: &str = "motions of `reduced`, `reduced+modes` and `mapped`; each speed of a sweep";
const REDUCED: &str = "motions of `reduced` and `reduced+modes`";
const GEARBOX_IN_MOTION: &str = "motions of gearboxes";
const EXACT_IN_MOTION: &str = "motions of gearboxes in exact contact";

/// All kinds of checks; a test compares their limits with those of runs.
pub const CHECKS: [CheckKind; 33] = [
    kind("torque_residual", "1e-8", AT_REST, "largest relative difference of contact torque and applied torque"),
    kind(
        "complementarity_residual",
        "1e-6",
        AT_REST,
        "largest relative violation of gap >= 0, pressure >= 0, one of them zero",
    ),
    kind("action_reaction_residual", "1e-8", AT_REST, "largest relative difference of the forces on pinion and wheel"),
    kind(
        "round_off_share",
        "1e-2",
        AT_REST,
        "round-off of the flanks' positions over their approach under the load: above it the load is too small for the mesh. A scene at rest whose estimated stiffness gives more than three times this is refused before the work",
    ),
    kind(
        "pose_residual",
        "2e-3",
        AT_REST,
        "error of the driven gear's rotation at its last step over the approach of the flanks; above 1e-9 where the force of a slice jumps between two parts of a profile",
    ),
    kind(
        "deflection_over_module",
        "0.3",
        AT_REST,
        "largest deflection of the teeth along the line of action (transmission error minus that of the unloaded flanks) over the module: above it linear elasticity is not valid",
    ),
    kind(
        "pressure_over_modulus",
        "0.3",
        AT_REST,
        "largest pressure over E*, `1/E* = sum (1 - nu^2)/E`: at the bound the Hertz band is 0.6 as wide as the radius of the flanks",
    ),
    kind(
        "dynamic_deflection_over_module",
        "0.3",
        IN_MOTION,
        "largest deflection of the teeth in motion over the module: transmission error minus the most that backlash, micro-geometry, pitch errors and misalignment can give",
    ),
    kind("dynamic_pressure_over_modulus", "0.3", REDUCED, "largest pressure in motion over E*"),
    kind(
        "energy_residual",
        "1e-2",
        "motions of pairs and gearboxes; each speed of a sweep",
        "energy that steps add or take by themselves, over the kinetic and elastic energy that comes and goes in them: `energy_open_over_vibration`; of gearboxes the bound is 1e-3",
    ),
    kind(
        "map_error",
        "3e-4",
        "`mapped`",
        "root mean square error of the map's approach at random places, over the mean approach under the load",
    ),
    kind(
        "map_excess",
        "1",
        "`mapped`",
        "largest force of a step over the largest of the map, or distance of the tilt from the middle of the map over half its range, whichever is more",
    ),
    kind(
        "flank_excursion",
        "1",
        "`lumped8`, `lumped12`, `shaft18`, `impact`",
        "largest penetration of the flanks, or motion beyond the backlash, over the normal module: above it the teeth would have passed each other",
    ),
    kind(
        "pulling_force",
        "1e-6",
        "`reduced`, `reduced+modes`, `impact`",
        "largest pull of a flank over the largest normal force",
    ),
    kind(
        "force_jump",
        "1e-4",
        REDUCED,
        "largest difference of the forces before and after a tooth change at the same place, over the largest normal force",
    ),
    kind("harmonic_residual", "1e-8", "continuations", "largest `residual` of the branch"),
    kind("harmonic_tail", "`tail` of the scene", "continuations", "largest `tail` of the branch"),
    kind(
        "multiplier_error",
        "0.02",
        "continuations of gearboxes",
        "largest change of a Floquet multiplier by the modes beyond twice `highest_frequency_hz`, at eight motions",
    ),
    kind(
        "range_left_out",
        "0.01",
        "continuations",
        "share of the range that the branch did not reach when it broke off or had all its `motions`; 0 of one that left the range at either end",
    ),
    kind("residual", "1e-6", "gearboxes", "unbalanced forces at the gears over the load, worst of all positions"),
    kind(
        "body_balance",
        "1e-8",
        "gearboxes",
        "sum of the forces, or moments, on a shaft over the largest of them, worst of all positions",
    ),
    kind(
        "mesh_<k>_deflection_over_module",
        "1",
        "gearboxes",
        "largest transmission error of the mesh over its module, shafts and bearings included",
    ),
    kind("mesh_<k>_pressure_over_modulus", "0.3", "gearboxes", "largest pressure of the mesh over E*"),
    kind(
        "mesh_<k>_dynamic_deflection_over_module",
        "1",
        GEARBOX_IN_MOTION,
        "`dynamic_deflection_over_module` of the mesh, shafts and bearings included",
    ),
    kind(
        "mesh_<k>_dynamic_pressure_over_modulus",
        "0.3",
        EXACT_IN_MOTION,
        "`dynamic_pressure_over_modulus` of the mesh, coast flanks among it",
    ),
    kind("mesh_<k>_pulling_force", "1e-6", EXACT_IN_MOTION, "`pulling_force` of the mesh"),
    kind("mesh_<k>_force_jump", "1e-4", EXACT_IN_MOTION, "`force_jump` of the mesh"),
    kind(
        "mesh_<k>_map_error",
        "10 times `map_tolerance`, 0.5 at the most",
        "motions and continuations of gearboxes on maps",
        "`map_error` of the mesh",
    ),
    kind(
        "mesh_<k>_map_excess",
        "1",
        "motions and continuations of gearboxes on maps and springs",
        "`map_excess` of the mesh; of a spring the change of its stiffness by the tilt over half of it",
    ),
    kind(
        "shaft_frequency_error",
        "0.03",
        GEARBOX_IN_MOTION,
        "largest relative error of the natural frequencies of the reduced shafts",
    ),
    kind(
        "cases_without_result",
        "1 - 1/n",
        "plans and studies of n cases",
        "share of the cases without a result: one case has to have one",
    ),
    kind("failure_modes_missed", "0", "envelopes", "failure modes that do not come out as they have to"),
    kind("cells_wrong_without_a_word", "0", "envelopes", "cells of maps that are wrong without a remark"),
];
