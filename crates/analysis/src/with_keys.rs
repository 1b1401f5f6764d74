//! Headlines that know the names of their numbers.

/// A key of a headline, and the type of what it holds, as the code writes it.
pub type HeadlineKey = (&'static str, &'static str);

/// Defines a headline as it stands, and beside it its keys in the same order.
macro_rules! with_keys {
    ($(#[$of_all:meta])* pub struct $name:ident { $($(#[$of_one:meta])* pub $key:ident: $type:ty,)* }) => {
        $(#[$of_all])*
        pub struct $name { $($(#[$of_one])* pub $key: $type,)* }

        impl $name {
            /// Its keys, those that a run may leave out included.
            pub const KEYS: &'static [$crate::HeadlineKey] = &[$((stringify!($key), stringify!($type))),*];
        }
    };
}
pub(crate) use with_keys;
