//! Which failure modes and maps a user means.

use crate::{EnvelopeMap, FailureMode, MAPS, MODES};

/// Failure modes and maps that are asked for: those that `only` names, as `F7` or `c`; else all failure modes, or with
/// `quick` those that take a few seconds. With `maps` all maps as well.
///
/// # Errors
/// A word that names none.
pub fn chosen(
    only: &[String],
    quick: bool,
    maps: bool,
) -> Result<(Vec<&'static FailureMode>, Vec<&'static EnvelopeMap>), &String> {
    let is_map = |word: &String| MAPS.iter().any(|m| m.key == word);
    if let Some(word) = only.iter().find(|word| !is_map(word) && !MODES.iter().any(|m| m.is_named(word))) {
        return Err(word);
    }
    let all = only.is_empty();
    let modes = MODES.iter().filter(|m| if all { !quick || m.is_quick() } else { only.iter().any(|w| m.is_named(w)) });
    let drawn = MAPS.iter().filter(|m| maps || only.iter().any(|word| word == m.key));
    Ok((modes.collect(), drawn.collect()))
}

#[cfg(test)]
mod tests {
    use super::chosen;

    #[test]
    fn words_name_modes_and_maps() {
        let count = |only: &[&str], quick, maps| {
            let only: Vec<String> = only.iter().map(|w| (*w).to_owned()).collect();
            chosen(&only, quick, maps).map(|(m, d)| (m.len(), d.len())).map_err(String::clone)
        };
        assert_eq!(count(&[], false, false), Ok((41, 0)));
        assert_eq!(count(&["F7", "f07", "c"], false, false), Ok((1, 1)));
        assert_eq!(count(&["F36"], false, false), Err("F36".to_owned()));
        assert_eq!(count(&["x"], false, true), Err("x".to_owned()));
        let (quick, maps) = count(&[], true, true).unwrap();
        assert!(quick > 10 && quick < 41 && maps == 7, "{quick} quick modes, {maps} maps");
    }
}
