//! Readers of several values.

use std::marker::PhantomData;

use super::codec::{Check, Codec, Quantity};
use super::shape::{Field, Presence, Shape, TableShape};
use super::{Record, Scope};
use crate::input::diagnosis::Diagnosis;
use crate::input::quantity_list::QuantityList;
use crate::input::value_reader::ValueReader;

/// Several quantities, one by one or as a range.
#[derive(Debug, Clone, Copy)]
pub struct Series {
    item: Quantity,
    most: usize,
    check: Check<f64>,
}

/// A list of at most so many quantities, or a table of `from`, `to`, `count` and `spacing`.
#[must_use]
pub fn series(item: Quantity, most: usize) -> Series {
    let check: Check<f64> = |_, value, _| Ok(value);
    Series { item, most, check }
}

impl Series {
    /// With a check of each item, or of the ends of a range.
    #[must_use]
    pub fn each(self, check: Check<f64>) -> Self {
        Self { check, ..self }
    }
}

impl Codec for Series {
    type Out = Vec<f64>;

    fn shape(&self) -> Shape {
        let end = |key, meaning| Field {
            key,
            meaning,
            shape: self.item.shape(),
            presence: Presence::Required,
        };
        let count = Field {
            key: "count",
            meaning: "how many values",
            shape: Shape::Count(2..=self.most),
            presence: Presence::Required,
        };
        let spacing = Field {
            key: "spacing",
            meaning: "equal differences or equal ratios",
            shape: Shape::Words(vec!["linear", "log"]),
            presence: Presence::Default("\"linear\"".into()),
        };
        let range = TableShape {
            fields: vec![
                end("from", "first value"),
                end("to", "last value"),
                count,
                spacing,
            ],
            ..TableShape::default()
        };
        Shape::Either(vec![
            Shape::List(Box::new(self.item.shape()), None),
            Shape::Table(range),
        ])
    }

    fn wanted(&self) -> String {
        "a list of values, or a table of from, to, count and spacing".into()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<Vec<f64>, Diagnosis> {
        let list = QuantityList {
            dimension: self.item.dimension,
            sign: self.item.sign,
            most: self.most,
        };
        list.read_checked(value, |item, number| (self.check)(item, number, scope))
    }
}

/// Two values.
#[derive(Debug, Clone, Copy)]
pub struct Pair<C> {
    item: C,
    wanted: &'static str,
}

/// A list of exactly two values, wanted in these words.
pub const fn pair<C>(item: C, wanted: &'static str) -> Pair<C> {
    Pair { item, wanted }
}

impl<C: Codec> Codec for Pair<C> {
    type Out = [C::Out; 2];

    fn shape(&self) -> Shape {
        Shape::List(Box::new(self.item.shape()), Some(2))
    }

    fn wanted(&self) -> String {
        self.wanted.into()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<Self::Out, Diagnosis> {
        match &value.list(self.wanted)?[..] {
            [x, y] => Ok([self.item.read(x, scope)?, self.item.read(y, scope)?]),
            _ => Err(value.wanted(self.wanted)),
        }
    }
}

/// A list of values.
#[derive(Debug, Clone)]
pub struct List<C> {
    item: C,
    wanted: String,
}

/// A list of at least one value, wanted in these words.
pub fn list<C: Codec>(item: C, wanted: impl Into<String>) -> List<C> {
    let wanted = wanted.into();
    List { item, wanted }
}

impl<C: Codec> Codec for List<C> {
    type Out = Vec<C::Out>;

    fn shape(&self) -> Shape {
        Shape::List(Box::new(self.item.shape()), None)
    }

    fn wanted(&self) -> String {
        self.wanted.clone()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<Vec<C::Out>, Diagnosis> {
        let items = value.list(&self.wanted)?;
        items
            .iter()
            .map(|item| self.item.read(item, scope))
            .collect()
    }
}

/// A list of tables.
#[derive(Debug, Clone, Copy)]
pub struct Tables<T> {
    wanted: &'static str,
    of: PhantomData<fn() -> T>,
}

/// A list of tables, which may be empty or missing, wanted in these words.
#[must_use]
pub const fn tables<T: Record>(wanted: &'static str) -> Tables<T> {
    let of = PhantomData;
    Tables { wanted, of }
}

impl<T: Record> Codec for Tables<T> {
    type Out = Vec<T>;

    fn shape(&self) -> Shape {
        Shape::List(Box::new(Shape::Table(T::shape())), None)
    }

    fn wanted(&self) -> String {
        self.wanted.into()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<Vec<T>, Diagnosis> {
        let items = value.items(self.wanted)?.into_iter();
        items.map(|item| T::read(&item.table()?, scope)).collect()
    }
}
