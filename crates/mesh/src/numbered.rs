//! Names that differ only in a number, such as those of numbered teeth.

use std::collections::BTreeMap;

/// A name without its last number.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Numbered {
    /// The name with `{k}` in place of the number: `ToothL_{k}`.
    pub pattern: String,
    /// The number: 12 for `ToothL_12`, -1 for `Zahn (-1)`.
    pub number: i64,
}

impl Numbered {
    /// Splits off the last number of a name. `None` if the name has no number or if the number does not fit into 64
    /// bits.
    ///
    /// ```
    /// # use mesh::Numbered;
    /// let tooth = Numbered::of("tooth_12_left").unwrap();
    /// assert_eq!((tooth.pattern.as_str(), tooth.number), ("tooth_{k}_left", 12));
    /// assert_eq!(Numbered::of("Hub"), None);
    /// ```
    pub fn of(name: &str) -> Option<Self> {
        let end = name.rfind(|c: char| c.is_ascii_digit())? + 1;
        let start = name[..end]
            .rfind(|c: char| !c.is_ascii_digit())
            .map_or(0, |at| at + name[at..].chars().next().map_or(0, char::len_utf8));
        // A sign belongs to the number unless it joins it to a word: `Zahn -1`, but `Zahn-1`.
        let signed = name[..start].strip_suffix('-').filter(|before| !before.ends_with(char::is_alphanumeric));
        let start = signed.map_or(start, str::len);
        let number = name[start..end].parse().ok()?;
        Some(Self { pattern: format!("{}{{k}}{}", &name[..start], &name[end..]), number })
    }
}

/// Names with those that differ in a number only as one pattern with its range, in the order in which each appears
/// first.
pub(crate) fn folded(names: &[String]) -> Vec<String> {
    let parsed: Vec<Option<Numbered>> = names.iter().map(|n| Numbered::of(n)).collect();
    // Of each pattern how many names it has, and its least and largest number.
    let mut ranges: BTreeMap<&str, (usize, i64, i64)> = BTreeMap::new();
    for p in parsed.iter().flatten() {
        let range = ranges.entry(&p.pattern).or_insert((0, p.number, p.number));
        *range = (range.0 + 1, range.1.min(p.number), range.2.max(p.number));
    }
    let mut folded: Vec<String> = Vec::new();
    for (name, parsed) in names.iter().zip(&parsed) {
        let Some(pattern) = parsed.as_ref().map(|p| p.pattern.as_str()) else {
            folded.push(format!("`{name}`"));
            continue;
        };
        // Told where the first of its names stands; the others find nothing left.
        match ranges.get(pattern) {
            Some((1, ..)) => folded.push(format!("`{name}`")),
            Some((_, least, largest)) => {
                folded.push(format!("`{pattern}` with k from {least} to {largest}"));
                ranges.remove(pattern);
            }
            None => {}
        }
    }
    folded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn teeth_are_told_by_one_pattern() {
        let names: Vec<String> =
            ["Hub", "ToothL_0", "ToothL_1", "ToothL_10", "zahn7é", "Bohrung2"].map(String::from).into();
        assert_eq!(folded(&names), ["`Hub`", "`ToothL_{k}` with k from 0 to 10", "`zahn7é`", "`Bohrung2`"]);
        assert_eq!(Numbered::of("é7").map(|n| n.pattern), Some("é{k}".into()));
        let signed = ["Zahn (-1)", "Zahn-1"].map(|n| Numbered::of(n).map(|n| (n.pattern, n.number)));
        assert_eq!(signed, [Some(("Zahn ({k})".into(), -1)), Some(("Zahn-{k}".into(), 1))]);
        assert_eq!(Numbered::of("1234567890123456789012"), None, "no number that fits");
    }
}
