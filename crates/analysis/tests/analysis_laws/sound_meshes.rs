//! Meshes that an earlier run has found sound.

use analysis::SOUND_VERSION;

/// Version, and first digits of BLAKE3 of the code that finds a mesh sound, comments left out.
const CHECKS: (u32, &str) = (1, "f97ec1942eb515a1");

/// Whoever changes what makes a mesh sound has to raise the version, so that no mesh passes by a check of before.
#[test]
fn checks_of_meshes_are_those_of_their_version() {
    let sources = [
        include_str!("../../../mesh/src/check/mod.rs"),
        include_str!("../../../mesh/src/check/conformity.rs"),
        include_str!("../../../mesh/src/check/cuts.rs"),
        include_str!("../../../mesh/src/check/nodes.rs"),
        include_str!("../../../mesh/src/quality.rs"),
        include_str!("../../../mesh/src/faces.rs"),
    ];
    let mut hasher = blake3::Hasher::new();
    let lines = sources.into_iter().flat_map(str::lines).map(|line| line.split("//").next().unwrap_or_default().trim());
    lines.for_each(|line| {
        hasher.update(line.as_bytes());
    });
    let code = hasher.finalize().to_hex()[..16].to_owned();
    let found = (SOUND_VERSION, code.as_str());
    assert!(
        found == CHECKS,
        "checks are others: raise SOUND_VERSION in crates/analysis/src/cache.rs, write {found:?} here"
    );
}
