//! Accuracy requested for the headline values: `[accuracy]`.

use std::fmt;

use serde::{Serialize, Serializer, ser::SerializeMap};

use crate::schema::{Asked, Quantity};
use crate::{Scene, SceneError, Setting, source::Source};

/// Tolerance for the error of a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// As a share of the value itself.
    Relative(f64),
    /// In the unit of the value.
    Absolute(f64),
}

impl Tolerance {
    /// Largest permitted error of a quantity with this value, in its unit.
    pub fn of(self, value: f64) -> f64 {
        match self {
            Self::Relative(share) => share * value.abs(),
            Self::Absolute(most) => most,
        }
    }

    /// Text as in a scene: `1 %`, `0.05 um`.
    pub fn words(self, quantity: Quantity) -> String {
        match self {
            Self::Relative(share) => format!("{} %", 1e6 * share / 1e4),
            Self::Absolute(most) => format!("{most} {}", quantity.unit()).trim_end().to_owned(),
        }
    }

    /// Parses a number above zero followed by `%` or the quantity's unit.
    ///
    /// # Errors
    /// [`ToleranceError`] for any other text.
    pub fn parse(words: &str, quantity: Quantity) -> Result<Self, ToleranceError> {
        let wrong = || ToleranceError { words: words.to_owned(), unit: quantity.unit() };
        let words = words.trim();
        let split = words.find(|c: char| c == '%' || c.is_whitespace() || c.is_alphabetic() && !matches!(c, 'e' | 'E'));
        let (number, unit) = words.split_at(split.unwrap_or(words.len()));
        let value: f64 = number.trim().parse().map_err(|_| wrong())?;
        if !(value.is_finite() && value > 0.0) {
            return Err(wrong());
        }
        match unit.trim() {
            "%" if value <= 100.0 => Ok(Self::Relative(1e-2 * value)),
            unit if unit.replace(['\u{b5}', '\u{3bc}'], "u") == quantity.unit() => Ok(Self::Absolute(value)),
            _ => Err(wrong()),
        }
    }
}

/// A text that is not a tolerance.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{words}` is not an accuracy")]
pub struct ToleranceError {
    /// The text as written.
    pub words: String,
    /// Unit that the quantity has.
    pub unit: &'static str,
}

impl ToleranceError {
    /// Hint: how to write a tolerance.
    pub fn hint(&self) -> String {
        let amount = format!("0.05 {}", self.unit);
        format!("write a share, \"1 %\" (up to 100 %), or a number above zero with its unit, \"{}\"", amount.trim_end())
    }
}

/// Accuracy that a scene requests for its headline values.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AccuracyScene(Vec<(Quantity, Tolerance)>);

impl AccuracyScene {
    /// Accuracy with these tolerances; if a quantity occurs twice, the last tolerance counts.
    pub fn new(tolerances: impl IntoIterator<Item = (Quantity, Tolerance)>) -> Self {
        let mut all: Vec<(Quantity, Tolerance)> = Vec::new();
        for (quantity, tolerance) in tolerances {
            all.retain(|(other, _)| *other != quantity);
            all.push((quantity, tolerance));
        }
        all.sort_by_key(|(quantity, _)| *quantity);
        Self(all)
    }

    /// Whether no accuracy is requested.
    pub fn is_none(&self) -> bool {
        self.0.is_empty()
    }

    /// Requested tolerances in the order of the quantities.
    pub fn tolerances(&self) -> &[(Quantity, Tolerance)] {
        &self.0
    }

    /// Requested tolerance of a quantity.
    pub fn of(&self, quantity: Quantity) -> Option<Tolerance> {
        self.0.iter().find(|(asked, _)| *asked == quantity).map(|(_, tolerance)| *tolerance)
    }

    /// From what is written.
    ///
    /// # Errors
    /// [`SceneError::Conflict`] for words that are no tolerance.
    pub(crate) fn read(s: &Source<'_>, raw: &impl Asked) -> Result<Self, SceneError> {
        let one = |(quantity, word): (Quantity, &toml::Spanned<String>)| {
            let parsed = Tolerance::parse(word.get_ref(), quantity);
            let said = parsed.map_err(|e| s.conflict(&word.span(), format!("`{}`: {e}", quantity.key()), e.hint()));
            Ok((quantity, said?))
        };
        Ok(Self::new(raw.asked().map(one).collect::<Result<Vec<_>, SceneError>>()?))
    }
}

impl Serialize for AccuracyScene {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (quantity, tolerance) in &self.0 {
            map.serialize_entry(quantity.key(), &tolerance.words(*quantity))?;
        }
        map.end()
    }
}

impl fmt::Display for AccuracyScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all =
            self.0.iter().map(|(quantity, tolerance)| format!("{} {}", quantity.key(), tolerance.words(*quantity)));
        f.write_str(&all.collect::<Vec<_>>().join(", "))
    }
}

impl Scene {
    /// Whether the program chooses model, mesh, slices and positions.
    pub fn is_auto(&self) -> bool {
        self.analysis.model == crate::Model::Auto
    }
}

impl Setting {
    /// Parses `1%` (of the mean static transmission error) or `max_pressure=5%` into that key of `[accuracy]`, with the
    /// model chosen by the program. Messages name it `--accuracy`.
    ///
    /// # Errors
    /// [`SceneError::NoKey`] if the text before `=` is not a key.
    pub fn accuracy(written: &str) -> Result<[Self; 2], SceneError> {
        let (key, amount) = written.split_once('=').unwrap_or((Quantity::MeanSte.key(), written));
        let asked = Self::of(&format!("accuracy.{}", key.trim()), &amount.trim().into())?;
        Ok([asked, Self::of("analysis.model", &"auto".into())?].map(|setting| setting.called("--accuracy")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_are_shares_or_amounts() {
        let of = |words: &str| Tolerance::parse(words, Quantity::MeanSte);
        for (words, tolerance) in [
            ("1 %", Tolerance::Relative(0.01)),
            ("0.3%", Tolerance::Relative(0.003)),
            (" 5e-2 um", Tolerance::Absolute(0.05)),
            ("0.05um", Tolerance::Absolute(0.05)),
            ("0.05 \u{b5}m", Tolerance::Absolute(0.05)),
        ] {
            assert_eq!(of(words), Ok(tolerance), "{words}");
            assert_eq!(of(&tolerance.words(Quantity::MeanSte)), Ok(tolerance), "{words}: written and read");
        }
        for words in ["", "1", "%", "-1 %", "0 um", "101 %", "nan %", "inf um", "1 mm", "um 1", "1 % %"] {
            assert!(of(words).is_err(), "{words}: {:?}", of(words));
        }
    }

    /// A ratio has no unit.
    #[test]
    fn an_amount_of_a_ratio_stands_alone() {
        let of = |words: &str| Tolerance::parse(words, Quantity::FaceLoadFactor);
        assert_eq!(of("0.02"), Ok(Tolerance::Absolute(0.02)));
        assert_eq!(of(&Tolerance::Absolute(0.02).words(Quantity::FaceLoadFactor)), Ok(Tolerance::Absolute(0.02)));
        assert!(of("0.02 um").is_err() && of("2 %") == Ok(Tolerance::Relative(0.02)));
    }

    #[test]
    fn the_last_of_two_holds() {
        let [a, b] = [0.1, 0.2].map(Tolerance::Relative);
        let twice =
            AccuracyScene::new([(Quantity::MaxPressure, a), (Quantity::MeanSte, a), (Quantity::MaxPressure, b)]);
        assert_eq!(twice.tolerances(), [(Quantity::MeanSte, a), (Quantity::MaxPressure, b)]);
        assert_eq!(twice.to_string(), "mean_ste 10 %, max_pressure 20 %");
    }
}
