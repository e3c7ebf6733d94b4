//! The keys of a case, each declared once: `record!` declares a table with its fields, `one_of!` fields of which
//! exactly one is given, `kinds!` a table whose `kind` chooses its fields. From a declaration come the type, the reader
//! with its diagnoses, and the [`Shape`] of the table; from that the [schema] for editors, the list of [keys] in the
//! documents, and the dimension of each number.
//!
//! A line of a declaration is a field: its key and type, the [`Codec`] that reads it, and its meaning.

pub mod codec;
mod combinators;
pub mod keys;
mod lists;
pub(crate) mod macros;
pub mod schema;
pub mod shape;
pub mod template;

pub use codec::{
    Codec, angle, compliance, count, energy_per_area, force, fraction, length, literal, number,
    pressure, switch, text, wear_coefficient, word,
};
pub use combinators::{either, part, table, together};
pub use lists::{Series, list, pair, series, tables};
pub use shape::{Field, KindsShape, Presence, Shape, TableShape};

use crate::case::foundation::FoundationCase;
use crate::case::height_limits::HeightLimits;
use crate::case::map_sources::MapSources;
use crate::input::diagnosis::{Diagnosis, Fault};
use crate::input::table_reader::TableReader;

/// What the reader of a field may know besides its value.
#[derive(Debug, Clone, Copy, Default)]
pub struct Scope<'a> {
    /// The maps that a case may name.
    pub maps: Option<&'a MapSources>,
    /// The foundation, once it is read.
    pub foundation: Option<&'a FoundationCase>,
    /// Elements per side, once they are read.
    pub elements: usize,
    /// Side of the domain, m, if it is read and given.
    pub side: Option<f64>,
    /// The steepest heights that a map may have.
    pub limits: HeightLimits,
}

/// A table declared by its fields.
pub trait Record: Sized {
    /// Its fields.
    fn shape() -> TableShape;

    /// Reads the fields; other keys of the table are ignored.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first field that is wrong.
    fn read_part(table: &TableReader<'_>, scope: &Scope<'_>) -> Result<Self, Diagnosis>;

    /// Reads a table of these fields and no others.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first unknown key, or else of the first field that is wrong.
    fn read(table: &TableReader<'_>, scope: &Scope<'_>) -> Result<Self, Diagnosis> {
        table.only(&Self::shape().keys())?;
        Self::read_part(table, scope)
    }
}

/// A table whose `kind` chooses its fields.
pub trait Kinds: Sized {
    /// Its kinds.
    fn shape() -> KindsShape;

    /// Reads a table that may also have the keys `beside`, which are read elsewhere.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the kind, of the first key unknown to it, or else of the first field that is wrong.
    fn read(
        table: &TableReader<'_>,
        beside: &[&'static str],
        scope: &Scope<'_>,
    ) -> Result<Self, Diagnosis>;
}

/// A codec as that of a field of this type.
pub(crate) fn of_type<T, C: Codec<Out = T>>(codec: C) -> C {
    codec
}

/// The one key of `keys` that a table has.
///
/// # Errors
///
/// A [`Diagnosis`] of the first key if none is given, of the second that is given if several are.
pub(crate) fn the_one_given(
    table: &TableReader<'_>,
    keys: &'static [&'static str],
    wanted: &str,
    help: Option<&str>,
) -> Result<&'static str, Diagnosis> {
    match table.given(keys)[..] {
        [key] => Ok(key),
        [] => Err(table.missing(keys.first().unwrap_or(&""), wanted.into())),
        [first, second, ..] => {
            let wrong = Fault::Wrong {
                found: format!("{first} and {second}"),
                wanted: wanted.into(),
            };
            let diagnosis = table.required(second, wanted)?.diagnosis(wrong);
            Err(match help {
                Some(help) => diagnosis.with_help(help),
                None => diagnosis,
            })
        }
    }
}

/// The word of the key `kind`, or the default.
///
/// # Errors
///
/// A [`Diagnosis`] if it is none of the words, or required and missing.
pub(crate) fn kind_of(
    table: &TableReader<'_>,
    words: &[(&'static str, &'static str)],
    default: Option<&'static str>,
) -> Result<&'static str, Diagnosis> {
    match (table.optional("kind"), default) {
        (Some(field), _) => field.choice(words),
        (None, Some(word)) => Ok(word),
        (None, None) => Err(table.missing("kind", in_words(words))),
    }
}

/// The words as alternatives: `"a", "b" or "c"`.
pub(crate) fn in_words<T>(words: &[(&'static str, T)]) -> String {
    let words: Vec<_> = words.iter().map(|(word, _)| *word).collect();
    match &words[..] {
        [] => String::new(),
        [one] => format!("\"{one}\""),
        [most @ .., last] => format!("\"{}\" or \"{last}\"", most.join("\", \"")),
    }
}
