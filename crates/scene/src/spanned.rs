//! Values of a scene file as written, each with its place.

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{Error, IgnoredAny, MapAccess, Visitor},
};
use toml::Spanned;

/// A number as written.
pub type Number = Option<Spanned<f64>>;
/// A whole number as written; signed, so that `-3` is out of range instead of having the wrong type.
pub type Whole = Option<Spanned<i64>>;
/// A word as written.
pub type Word = Option<Spanned<String>>;

/// Words as written.
pub(crate) type Words = Option<Vec<Spanned<String>>>;
/// On or off as written.
pub(crate) type Switch = Option<Spanned<bool>>;
/// A list of numbers as written.
pub(crate) type Numbers = Option<Spanned<Vec<Spanned<f64>>>>;
/// A list of whole numbers as written.
pub(crate) type Wholes = Option<Spanned<Vec<i64>>>;
/// Rows of numbers as written.
pub(crate) type Rows = Option<Spanned<Vec<Spanned<Vec<f64>>>>>;

/// What is written in two places.
pub(crate) trait Over {
    /// The value written here, or where there is none that of `base`.
    #[must_use]
    fn over(&self, base: &Self) -> Self;
}

impl<T: Clone> Over for Option<T> {
    fn over(&self, base: &Self) -> Self {
        self.clone().or_else(|| base.clone())
    }
}

impl<T: Clone> Over for Vec<T> {
    fn over(&self, base: &Self) -> Self {
        if self.is_empty() { base.clone() } else { self.clone() }
    }
}

/// A document as another one names it.
#[derive(Debug, Clone)]
pub(crate) enum Named {
    /// Named by its path.
    Path(String),
    /// Given by its tables at this place.
    Here,
}

/// What is expected of a [`Named`].
pub(crate) const NAMED: &str = "a path in quotes, or the tables of a document";

impl<'de> Deserialize<'de> for Named {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;

        impl<'de> Visitor<'de> for Either {
            type Value = Named;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(NAMED)
            }

            fn visit_str<E: Error>(self, path: &str) -> Result<Named, E> {
                Ok(Named::Path(path.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named, A::Error> {
                while map.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
                Ok(Named::Here)
            }
        }

        deserializer.deserialize_any(Either)
    }
}
