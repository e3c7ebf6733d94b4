//! What a value may be, as data.

use std::ops::RangeInclusive;

use crate::input::dimension::{Dimension, Sign};

/// What a value may be.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A number with a unit of this dimension, or a bare number.
    Quantity(Dimension, Sign),
    /// A number without a dimension.
    Number,
    /// Such a number in a range.
    Range(RangeInclusive<f64>),
    /// An integer.
    Count(RangeInclusive<usize>),
    /// One of these words.
    Words(Vec<&'static str>),
    /// `true` or `false`.
    Switch,
    /// Any text.
    Text,
    /// A list; the number of its items if that is fixed.
    List(Box<Self>, Option<usize>),
    /// A table.
    Table(TableShape),
    /// A table whose fields depend on a word.
    Kinds(KindsShape),
    /// One of these.
    Either(Vec<Self>),
}

/// The fields of a table.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TableShape {
    /// The fields, in the order of the declaration.
    pub fields: Vec<Field>,
    /// Fields of which exactly one is given.
    pub one_of: Vec<&'static str>,
    /// Fields that are given all or not at all.
    pub together: Vec<&'static str>,
    /// What further keys mean, if it may have any.
    pub open: Option<&'static str>,
}

/// A table whose fields depend on the word of one key.
#[derive(Debug, Clone, PartialEq)]
pub struct KindsShape {
    /// The key, such as `kind`.
    pub key: &'static str,
    /// The word if the key is missing; none if it is required.
    pub default: Option<&'static str>,
    /// The word of each kind, its meaning, and its fields.
    pub kinds: Vec<(&'static str, &'static str, TableShape)>,
    /// Fields of every kind.
    pub shared: TableShape,
}

/// A key of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// The key.
    pub key: &'static str,
    /// Its meaning.
    pub meaning: &'static str,
    /// What its value may be.
    pub shape: Shape,
    /// Whether it must be given.
    pub presence: Presence,
}

/// Whether a key must be given.
#[derive(Debug, Clone, PartialEq)]
pub enum Presence {
    /// It must be given.
    Required,
    /// If missing, this holds, in words.
    Default(String),
}

impl Field {
    /// A key that must be given.
    #[must_use]
    pub const fn required(key: &'static str, meaning: &'static str, shape: Shape) -> Self {
        Self {
            key,
            meaning,
            shape,
            presence: Presence::Required,
        }
    }

    /// A key that may be missing, and what holds then.
    #[must_use]
    pub fn optional(
        key: &'static str,
        meaning: &'static str,
        shape: Shape,
        missing: &'static str,
    ) -> Self {
        Self {
            presence: Presence::Default(missing.into()),
            ..Self::required(key, meaning, shape)
        }
    }
}

impl TableShape {
    /// A table of these fields.
    #[must_use]
    pub fn of(fields: impl Into<Vec<Field>>) -> Self {
        Self {
            fields: fields.into(),
            ..Self::default()
        }
    }

    /// With further keys of this meaning.
    #[must_use]
    pub fn open_to(self, further: &'static str) -> Self {
        Self {
            open: Some(further),
            ..self
        }
    }

    /// The keys of the fields.
    #[must_use]
    pub fn keys(&self) -> Vec<&'static str> {
        self.fields.iter().map(|field| field.key).collect()
    }
}

impl Shape {
    /// A list of such values, of any number.
    #[must_use]
    pub fn list(item: Self) -> Self {
        Self::List(Box::new(item), None)
    }

    /// The keys of choices, as words.
    #[must_use]
    pub fn words<T>(choices: &[(&'static str, T)]) -> Self {
        Self::Words(choices.iter().map(|(word, _)| *word).collect())
    }

    /// The tables directly in it: its own, or those of a list or of each kind.
    #[must_use]
    pub fn tables(&self) -> Vec<&TableShape> {
        match self {
            Self::Table(table) => vec![table],
            Self::Kinds(kinds) => {
                let own = kinds.kinds.iter().map(|(_, _, table)| table);
                own.chain([&kinds.shared]).collect()
            }
            Self::List(item, _) => item.tables(),
            Self::Either(shapes) => shapes.iter().flat_map(Self::tables).collect(),
            _ => Vec::new(),
        }
    }

    /// The dimension of its numbers, if they have one.
    #[must_use]
    pub fn dimension(&self) -> Option<Dimension> {
        match self {
            Self::Quantity(dimension, _) => Some(*dimension),
            Self::List(item, _) => item.dimension(),
            Self::Either(shapes) => shapes.iter().find_map(Self::dimension),
            _ => None,
        }
    }
}
