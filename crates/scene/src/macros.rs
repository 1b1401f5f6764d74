//! Macros for a row of the table of keys: a key of the schema, a field of the raw values and, where both are equal, a
//! field of the checked values.

/// A table of the scene file: its rows make the [`Table`](crate::table::Table) and the struct of what is written. With
/// `=> Checked` they make the struct of what is meant as well, with `read`, which takes it from what is written.
///
/// ```text
/// table! { STATIC, RawStruct [=> Checked Derive ... [; defaults]]: "what it is about", needed ["key", ...]; { row; ... } }
/// row:   key: kind(range and default) [=> how] [as written], "meaning"
/// how:   nothing   the value within its range, or its default; of `bare` and `bare_whole` an option
///        Some      the same as an option, which the check empties where the key has no meaning
///        must      a `bare_whole` that the check has found there
///        [Type]    the file of this type that the text names
///        (Table)   another checked table, of its defaults where it is not there
///        {Type}    the type's default, until the check fills it in
/// as:    method of the checked table that gives what the written scene has, in place of the value itself
/// ```
macro_rules! table {
    (
        $(#[$meta:meta])* $table:ident, $raw:ident $(=> $checked:ident $($derive:ident)* $(; $defaults:ident)?)?:
        $about:literal
        $(, needed [$($needed:literal),*])?; $rows:tt
    ) => {
        static_table! { $(#[$meta])* $table: $about [$($($needed),*)?] $rows }
        raw_table! { $raw $rows }
        $(
            checked_table! { $checked [$($derive)*], $raw, $table: $about $rows }
            $($defaults! { $checked $rows })?
        )?
    };
}

macro_rules! static_table {
    ($(#[$meta:meta])* $table:ident: $about:literal [$($needed:literal),*]
        { $($name:ident: $kind:ident($($args:tt)*) $(=> $how:tt)? $(as $written:ident)? $(, $meaning:literal)?;)* }) => {
        $(#[$meta])*
        pub(crate) static $table: $crate::table::Table = $crate::table::Table {
            about: $about,
            keys: &[$(key!($name $kind ($($args)*) $($meaning)?)),*],
            needed: &[$($needed),*],
        };
    };
}

macro_rules! raw_table {
    ($raw:ident
        { $($name:ident: $kind:ident($($args:tt)*) $(=> $how:tt)? $(as $written:ident)? $(, $meaning:literal)?;)* }) => {
        #[derive(Debug, Default, Clone, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub(crate) struct $raw {
            $(pub $name: raw!($kind ($($args)*)),)*
        }

        impl $crate::spanned::Over for $raw {
            fn over(&self, base: &Self) -> Self {
                Self { $($name: $crate::spanned::Over::over(&self.$name, &base.$name),)* }
            }
        }
    };
}

/// The key of a row.
macro_rules! key {
    ($name:ident table ($of:ident: $raw:ident)) => { $crate::table::table(stringify!($name), &$of) };
    ($name:ident always ($of:ident: $raw:ident)) => { $crate::table::table(stringify!($name), &$of) };
    ($name:ident document ($of:ident) $about:literal) => {
        $crate::table::document(stringify!($name), &$crate::schema::$of, $about)
    };
    ($name:ident list ($of:ident: $raw:ident)) => { $crate::table::list(stringify!($name), &$of) };
    ($name:ident word ($choice:ident) $about:literal) => {
        $crate::table::word(stringify!($name), <$choice as $crate::table::Choice>::WORDS, $about)
    };
    ($name:ident bare_word ($choice:ident) $about:literal) => {
        $crate::table::bare_word(stringify!($name), <$choice as $crate::table::Choice>::WORDS, $about)
    };
    ($name:ident words ($choice:ident) $about:literal) => {
        $crate::table::words(stringify!($name), <$choice as $crate::table::Choice>::WORDS, $about)
    };
    ($name:ident $kind:ident ($($args:expr),*) $about:literal) => {
        $crate::table::$kind(stringify!($name), $($args,)* $about)
    };
}

/// What is read of a row.
macro_rules! raw {
    (table ($of:ident: $raw:ident)) => { Option<toml::Spanned<$raw>> };
    (always ($of:ident: $raw:ident)) => { $raw };
    (list ($of:ident: $raw:ident)) => { Vec<toml::Spanned<$raw>> };
    (word $args:tt) => { $crate::spanned::Word };
    (bare_word $args:tt) => { $crate::spanned::Word };
    (text $args:tt) => { $crate::spanned::Word };
    (document $args:tt) => { Option<toml::Spanned<$crate::spanned::Named>> };
    (shape $args:tt) => { $crate::spanned::Word };
    (path $args:tt) => { $crate::spanned::Word };
    (words $args:tt) => { $crate::spanned::Words };
    (texts $args:tt) => { $crate::spanned::Words };
    (whole $args:tt) => { $crate::spanned::Whole };
    (bare_whole $args:tt) => { $crate::spanned::Whole };
    (signed_whole $args:tt) => { $crate::spanned::Whole };
    (switch $args:tt) => { $crate::spanned::Switch };
    (numbers $args:tt) => { $crate::spanned::Numbers };
    (wholes $args:tt) => { $crate::spanned::Wholes };
    (rows $args:tt) => { $crate::spanned::Rows };
    ($number:ident $args:tt) => { $crate::spanned::Number };
}

/// The value of a key with range and default of its row; the names of key and field are one.
macro_rules! value {
    ($s:expr, $table:ident, $raw:ident.$key:ident) => {
        $crate::source_values::Entry::value(&$raw.$key, $s, &$crate::schema::$table, stringify!($key))
    };
}

/// The value of a key by its row where it is written, else nothing.
macro_rules! optional {
    ($s:expr, $table:ident, $raw:ident.$key:ident) => {
        $raw.$key.is_some().then(|| value!($s, $table, $raw.$key)).transpose()
    };
}

/// The choice that a word stands for; the first one where none is written.
macro_rules! choice {
    ($s:expr, $raw:ident.$key:ident) => {
        $s.choice_of(stringify!($key), &$raw.$key)
    };
}

/// An enum each of whose values is a word of the scene file; the first one is the default where a default does not
/// depend on other keys.
macro_rules! choices {
    ($(#[$meta:meta])* pub enum $name:ident { $($(#[$of:meta])* $variant:ident = $word:literal,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
        pub enum $name {
            $($(#[$of])* #[serde(rename = $word)] $variant,)*
        }

        impl $name {
            /// Word as written in files.
            #[allow(dead_code, reason = "some are read alone")]
            pub fn word(self) -> &'static str {
                <Self as $crate::table::Choice>::WORDS[self as usize]
            }
        }

        impl $crate::table::Choice for $name {
            const WORDS: &'static [&'static str] = &[$($word),*];
            const CHOICES: &'static [(&'static str, Self)] = &[$(($word, Self::$variant)),*];
        }

        impl $crate::table::Field for $name {}
    };
}
