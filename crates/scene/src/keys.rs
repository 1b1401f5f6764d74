//! Which keys there are, and which of them a misspelt one is nearest to.

/// Tables of a kind of file with their keys; the first one is the file itself.
pub type Tables = fn() -> Vec<(String, Vec<&'static str>)>;

/// The nearest of `known` if it is near enough to be meant.
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    // Words of very different length are never alike, and to compare long ones costs the product of their lengths.
    let length = word.chars().count();
    known
        .iter()
        .filter(|k| length <= 2 * k.len() + 1)
        .map(|&k| (strsim::normalized_damerau_levenshtein(word, k), k))
        .filter(|&(likeness, _)| likeness >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, k)| k)
}

/// One sentence for someone who wrote `word` where only `here` may stand, in a file of these tables.
pub(super) fn advice(tables: Tables, word: &str, here: &[&str]) -> String {
    let meant_here = nearest(word, here);
    let elsewhere = tables().into_iter().skip(1).find(|(_, keys)| keys.contains(&word));
    match (elsewhere, meant_here) {
        (Some((table, _)), _) => format!("`{word}` belongs to [{table}]"),
        (None, Some(key)) => format!("did you mean `{key}`?"),
        // A key without its unit (`torque`) is shorter than the real one, so the likeness alone misses it.
        (None, None) => match here.iter().find(|key| key.starts_with(word)) {
            Some(key) => format!("did you mean `{key}`?"),
            None => format!("known here: {}", here.join(", ")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::tables;

    #[test]
    fn advice_finds_neighbours_tables_and_units() {
        let of = |table: &str| tables().into_iter().find(|(name, _)| name == table).unwrap().1;
        assert_eq!(advice(tables, "face_widht_mm", &of("pair")), "did you mean `face_width_mm`?");
        assert_eq!(advice(tables, "teeth", &of("pair")), "`teeth` belongs to [pinion]");
        assert_eq!(advice(tables, "torque", &of("operation")), "did you mean `torque_nm`?");
        assert_eq!(advice(tables, "keeps", &of("pair")), "`keeps` belongs to [[pinion.shaft.discs]]");
        let long = "a".repeat(1 << 24);
        assert!(advice(tables, &long, &of("pair")).starts_with("known here"));
        assert!(advice(tables, "colour", &["poisson"]).starts_with("known here"));
    }
}
