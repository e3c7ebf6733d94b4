//! The forms of a declaration.

/// Declares a table: its type, each field with its key, type, codec and meaning, and a check of the whole.
///
/// ```text
/// record! {
///     /// A film that covers everything.
///     pub struct FilmCase {
///         thickness: f64 = length().positive(), "thickness";
///         …
///     }
/// }
/// ```
macro_rules! record {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident {
            $($(#[$attribute:meta])* $field:ident: $type:ty = $codec:expr, $meaning:literal;)+
        }
        $(check $check:expr;)?
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, serde::Serialize)]
        $vis struct $name {
            $(#[doc = $meaning] $(#[$attribute])* pub $field: $type,)+
        }

        impl $crate::declare::Record for $name {
            fn shape() -> $crate::declare::TableShape {
                let mut table = $crate::declare::TableShape::default();
                $($crate::declare::Codec::declare(&$crate::declare::of_type::<$type, _>($codec), stringify!($field), $meaning, &mut table);)+
                table
            }

            fn read_part(
                table: &$crate::input::table_reader::TableReader<'_>,
                scope: &$crate::declare::Scope<'_>,
            ) -> Result<Self, $crate::input::diagnosis::Diagnosis> {
                let read = Self {
                    $($field: $crate::declare::Codec::take(&$crate::declare::of_type::<$type, _>($codec), stringify!($field), table, scope)?,)+
                };
                $(($check)(&read, table, scope)?;)?
                Ok(read)
            }
        }
    };
}

/// Declares fields of which exactly one is given: an enum with a variant for each.
macro_rules! one_of {
    (
        $(#[$meta:meta])*
        pub enum $name:ident, $wanted:expr, $help:expr;
        $($key:ident: $variant:ident($type:ty) = $codec:expr, $meaning:literal;)+
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, serde::Serialize)]
        #[serde(rename_all = "snake_case")]
        pub enum $name {
            $(#[doc = $meaning] $variant($type),)+
        }

        impl $name {
            /// The keys, of which exactly one is given.
            pub const KEYS: &'static [&'static str] = &[$(stringify!($key)),+];
        }

        impl $crate::declare::Record for $name {
            fn shape() -> $crate::declare::TableShape {
                let mut table = $crate::declare::TableShape::default();
                $($crate::declare::Codec::declare(&$crate::declare::of_type::<$type, _>($codec), stringify!($key), $meaning, &mut table);)+
                table.one_of.extend(Self::KEYS);
                table
            }

            fn read_part(
                table: &$crate::input::table_reader::TableReader<'_>,
                scope: &$crate::declare::Scope<'_>,
            ) -> Result<Self, $crate::input::diagnosis::Diagnosis> {
                let given = $crate::declare::the_one_given(table, Self::KEYS, $wanted, $help)?;
                $(if given == stringify!($key) {
                    return $crate::declare::Codec::take(&$crate::declare::of_type::<$type, _>($codec), stringify!($key), table, scope)
                        .map(Self::$variant);
                })+
                Err(table.missing(given, $wanted.into()))
            }
        }
    };
}

/// Declares a table whose fields depend on its `kind`: an enum with a variant for each. Variants `outside` are not
/// read from a file.
macro_rules! kinds {
    (
        $(#[$meta:meta])*
        pub enum $name:ident $(default $default:literal)? {
            $($variant:ident $(($type:ty))? = $word:literal, $meaning:literal;)+
        }
        outside {
            $($outside:ident($outside_type:ty), $outside_meaning:literal;)*
        }
    ) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, serde::Serialize)]
        #[serde(tag = "kind", rename_all = "kebab-case")]
        pub enum $name {
            $(#[doc = $meaning] $variant $(($type))?,)+
            $(#[doc = $outside_meaning] $outside($outside_type),)*
        }

        impl $crate::declare::Kinds for $name {
            fn shape() -> $crate::declare::KindsShape {
                $crate::declare::KindsShape {
                    key: "kind",
                    default: None $(.or(Some($default)))?,
                    kinds: vec![$(($word, $meaning, kinds!(@shape $($type)?)),)+],
                    shared: $crate::declare::TableShape::default(),
                }
            }

            fn read(
                table: &$crate::input::table_reader::TableReader<'_>,
                beside: &[&'static str],
                scope: &$crate::declare::Scope<'_>,
            ) -> Result<Self, $crate::input::diagnosis::Diagnosis> {
                let words = [$(($word, $word)),+];
                let kind = $crate::declare::kind_of(table, &words, None $(.or(Some($default)))?)?;
                $(if kind == $word {
                    let own = kinds!(@shape $($type)?).keys();
                    table.only(&[&["kind"], &own[..], beside].concat())?;
                    return kinds!(@read table, scope, $variant $(, $type)?);
                })+
                Err(table.missing("kind", $crate::declare::in_words(&words)))
            }
        }
    };
    (@shape) => { $crate::declare::TableShape::default() };
    (@shape $type:ty) => { <$type as $crate::declare::Record>::shape() };
    (@read $table:ident, $scope:ident, $variant:ident) => { Ok(Self::$variant) };
    (@read $table:ident, $scope:ident, $variant:ident, $type:ty) => {
        <$type as $crate::declare::Record>::read_part($table, $scope).map(Self::$variant)
    };
}

pub(crate) use {kinds, one_of, record};
