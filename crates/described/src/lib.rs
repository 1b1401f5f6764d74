//! What does each key of an object in a result mean?
//!
//! [`described!`] takes structs whose fields are keys of `summary.json`. The first line of a field's docstring is the meaning of the key: rustdoc and `docs/outputs.md` show the same words.

/// A key of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// Name, which ends with the unit.
    pub name: &'static str,
    /// Type of the value, as the code writes it.
    pub holds: &'static str,
    /// First line of the docstring.
    line: &'static str,
    /// Whether files have the key under this name: not of a field that is left out, nor of one whose own keys stand in its place.
    pub is_written: bool,
}

impl Key {
    /// A key that files have.
    pub const fn new(name: &'static str, holds: &'static str, meaning: &'static str) -> Self {
        Self { name, holds, line: meaning, is_written: true }
    }

    /// A key of a field with these attributes beside its docstring.
    #[doc(hidden)]
    pub const fn of_field(name: &'static str, holds: &'static str, line: &'static str, attributes: &[&str]) -> Self {
        let mut is_written = true;
        let mut k = 0;
        while k < attributes.len() {
            is_written = is_written && !is(attributes[k], "serde(skip)") && !is(attributes[k], "serde(flatten)");
            k += 1;
        }
        Self { name, holds, line, is_written }
    }

    /// Meaning of the key.
    pub fn meaning(&self) -> &'static str {
        self.line.trim()
    }
}

/// Whether two texts are equal.
const fn is(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut k = 0;
    while k < a.len() && k < b.len() && a[k] == b[k] {
        k += 1;
    }
    k == a.len() && k == b.len()
}

/// Defines structs as they stand, each with its keys in the order of its fields as `KEYS`.
///
/// Every field has a docstring, which begins with the meaning of the key in one line.
///
/// ```
/// described::described! {
///     /// Load of a pair.
///     pub struct Load {
///         /// normal force of the pair
///         pub normal_force_n: f64,
///     }
/// }
/// assert_eq!(Load::KEYS[0].name, "normal_force_n");
/// assert_eq!(Load::KEYS[0].meaning(), "normal force of the pair");
/// ```
#[macro_export]
macro_rules! described {
    ($(
        $(#[$of_all:meta])*
        $seen:vis struct $name:ident $(<$life:lifetime>)? {
            $(
                #[doc = $line:literal]
                $(#[$of_one:meta])*
                $field:vis $key:ident: $type:ty
            ),* $(,)?
        }
    )*) => {
        $(
            $(#[$of_all])*
            $seen struct $name $(<$life>)? {
                $(
                    #[doc = $line]
                    $(#[$of_one])*
                    $field $key: $type,
                )*
            }

            impl $(<$life>)? $name $(<$life>)? {
                /// Keys in the order of the fields, those that may be left out included.
                pub const KEYS: &'static [$crate::Key] = &[
                    $($crate::Key::of_field(stringify!($key), stringify!($type), $line, &[$(stringify!($of_one)),*])),*
                ];
            }
        )*
    };
}

#[cfg(test)]
mod tests {
    #![allow(dead_code)]

    described! {
        /// All kinds of fields.
        struct All<'a> {
            /// first
            ///
            /// More of it.
            first_mm: f64,
            /// left out
            #[allow(unused)]
            other: &'a str,
        }

        /// Another one.
        pub(crate) struct Empty {}
    }

    #[test]
    fn a_key_has_name_type_and_first_line() {
        let read: Vec<_> = All::KEYS.iter().map(|key| (key.name, key.holds, key.meaning(), key.is_written)).collect();
        assert_eq!(read, [("first_mm", "f64", "first", true), ("other", "&'a str", "left out", true)]);
        assert_eq!(Empty::KEYS, []);
    }

    #[test]
    fn fields_that_files_lack_are_told_by_their_attributes() {
        let is_written = |attributes: &[&str]| super::Key::of_field("a", "f64", " a", attributes).is_written;
        assert!(is_written(&[]) && is_written(&["serde(skip_serializing_if = \"Option::is_none\")"]));
        assert!(!is_written(&["serde(skip)"]) && !is_written(&["doc = \" more\"", "serde(flatten)"]));
    }
}
