//! Values of a scene file as written, each with its place.

use toml::Spanned;

/// A number as written.
pub type Number = Option<Spanned<f64>>;
/// A whole number as written; signed, so that `-3` is out of range and not of a wrong type.
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
