//! Macros for the checked form of a table: its struct, range checks, defaults, and the serialised scene.

macro_rules! checked_table {
    ($checked:ident [$($derive:ident)*], $raw:ident, $table:ident: $about:literal
        { $($name:ident: $kind:ident($($args:tt)*) $(=> $how:tt)? $(as $written:ident)? $(, $meaning:literal)?;)* }) => {
        #[doc = concat!("Checked table of the scene: ", $about, ".")]
        #[derive(Debug, Clone, PartialEq, $($derive),*)]
        pub struct $checked {
            $(
                #[doc = concat!("`", stringify!($name), "`" $(, ": ", $meaning)?, ".")]
                pub $name: checked!($kind ($($args)*) $($how)?),
            )*
        }

        impl $checked {
            /// Each key within its range; an infinite end of a range is `end`.
            #[allow(unused_variables, reason = "some tables have no infinite end")]
            pub(crate) fn read(
                s: &$crate::source::Source<'_>,
                raw: &$raw,
                end: f64,
            ) -> Result<Self, $crate::SceneError> {
                Ok(Self { $($name: read_as!($kind $($how)?, s, $table, raw.$name, end),)* })
            }
        }

        /// As a scene file writes the table: keys that say nothing are left out.
        impl serde::Serialize for $checked {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let mut map = serializer.serialize_map(None)?;
                $($crate::table::write_field(&mut map, stringify!($name), &written!(self.$name $($written)?))?;)*
                serde::ser::SerializeMap::end(map)
            }
        }
    };
}

macro_rules! defaults {
    ($checked:ident
        { $($name:ident: $kind:ident($($args:tt)*) $(=> $how:tt)? $(as $written:ident)? $(, $meaning:literal)?;)* }) => {
        /// Each key at the default of its row; what the check fills in is empty.
        impl Default for $checked {
            fn default() -> Self {
                Self { $($name: default!($kind ($($args)*) $($how)?),)* }
            }
        }
    };
}

/// The default of a row.
macro_rules! default {
    ($kind:ident $args:tt Some) => { Some(default!($kind $args)) };
    (word ($choice:ident)) => { <$choice as $crate::table::Choice>::CHOICES[0].1 };
    (number ($low:expr, $high:expr, $default:expr)) => { $default };
    (whole ($low:expr, $high:expr, $default:expr)) => { $default };
    (switch ($default:expr)) => { $default };
    ($($empty:tt)*) => { Default::default() };
}

/// What a row is when it is checked.
macro_rules! checked {
    ($kind:ident $args:tt Some) => { Option<checked!($kind $args)> };
    (bare_whole $args:tt must) => { u32 };
    (text $args:tt [$($of:tt)*]) => { Option<$crate::DataFile<$($of)*>> };
    ($kind:ident $args:tt ($of:ident)) => { $of };
    ($kind:ident $args:tt {$($of:tt)*}) => { $($of)* };
    (word ($choice:ident)) => { $choice };
    (bare_word ($choice:ident)) => { $choice };
    (words ($choice:ident)) => { Vec<$choice> };
    (whole $args:tt) => { u32 };
    (bare_whole $args:tt) => { Option<u32> };
    (number $args:tt) => { f64 };
    (must $args:tt) => { f64 };
    (bare $args:tt) => { Option<f64> };
    (switch $args:tt) => { bool };
    (text $args:tt) => { String };
    (texts $args:tt) => { Vec<String> };
}

/// The checked value of a row.
macro_rules! read_as {
    ($kind:ident Some, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        Some(read_as!($kind, $s, $table, $raw.$name, $end))
    };
    ($kind:ident {$($of:tt)*}, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        Default::default()
    };
    (text [$($of:tt)*], $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $raw.$name.as_ref().map(|word| $crate::inputs::named($s, stringify!($name), word)).transpose()?
    };
    (table ($of:ident), $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        match &$raw.$name {
            Some(table) => $of::read($s, table.get_ref(), $end)?,
            None => $of::read($s, &Default::default(), $end)?,
        }
    };
    (always ($of:ident), $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $of::read($s, &$raw.$name, $end)?
    };
    (whole, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $s.whole_of(&$table, stringify!($name), &$raw.$name)?
    };
    (bare_whole must, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        read_as!(whole, $s, $table, $raw.$name, $end)
    };
    (bare_whole, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $raw.$name.is_some().then(|| $s.whole_of(&$table, stringify!($name), &$raw.$name)).transpose()?
    };
    (bare, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $s.optional_up_to(&$table, stringify!($name), &$raw.$name, $end)?
    };
    (number, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $s.number_up_to(&$table, stringify!($name), &$raw.$name, $end)?
    };
    (must, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        read_as!(number, $s, $table, $raw.$name, $end)
    };
    (switch, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $crate::source_values::Entry::value(&$raw.$name, $s, &$table, stringify!($name))?
    };
    (text, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $raw.$name.as_ref().map(|word| word.get_ref().clone()).unwrap_or_default()
    };
    (texts, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $raw.$name.iter().flatten().map(|word| word.get_ref().clone()).collect()
    };
    (words, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $s.choices_of(stringify!($name), &$raw.$name)?
    };
    ($word:ident, $s:ident, $table:ident, $raw:ident.$name:ident, $end:ident) => {
        $s.choice_of(stringify!($name), &$raw.$name)?
    };
}

/// Fields of checked tables: types whose values are always written, and types with the method that says which of their
/// values are not.
macro_rules! fields {
    ($($always:ty),*; $($of:ty: $absent:ident),*) => {
        $(impl $crate::table::Field for $always {})*
        $(impl $crate::table::Field for $of {
            fn is_absent(&self) -> bool {
                self.$absent()
            }
        })*
    };
}

/// What the written scene has of a row.
macro_rules! written {
    ($this:ident.$name:ident) => {
        $this.$name
    };
    ($this:ident.$name:ident $written:ident) => {
        $this.$written()
    };
}
