//! Readers of single values. Each knows what it reads as a [`Shape`]; defaults are added by
//! [`or`](Codec::or), [`or_else`](Codec::or_else) and [`optional`](Codec::optional).

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use super::combinators::{Checked, Mapped, Optional, Or, OrElse};
use super::shape::{Field, Presence, Shape, TableShape};
use super::{Scope, in_words};
use crate::input::diagnosis::Diagnosis;
use crate::input::dimension::{Dimension, Sign};
use crate::input::table_reader::TableReader;
use crate::input::toml_tree::TomlValue;
use crate::input::value_reader::ValueReader;

/// Reads the value of a field.
pub trait Codec: Sized {
    /// What it reads.
    type Out;

    /// What the value may be.
    fn shape(&self) -> Shape;

    /// What is wanted, in the words of a diagnosis.
    fn wanted(&self) -> String;

    /// Reads a value.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if it is not such a value.
    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<Self::Out, Diagnosis>;

    /// Reads the value of a key.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if it is required and missing, or not such a value.
    fn take(
        &self,
        key: &'static str,
        table: &TableReader<'_>,
        scope: &Scope<'_>,
    ) -> Result<Self::Out, Diagnosis> {
        self.read(&table.required(key, &self.wanted())?, scope)
    }

    /// Whether the key must be given.
    fn presence(&self) -> Presence {
        Presence::Required
    }

    /// Adds the field, or the fields of a part, to those of its table.
    fn declare(&self, key: &'static str, meaning: &'static str, table: &mut TableShape) {
        table.fields.push(Field {
            key,
            meaning,
            shape: self.shape(),
            presence: self.presence(),
        });
    }

    /// With this value, shown so in words, if the key is missing.
    fn or(self, value: Self::Out, words: &'static str) -> Or<Self>
    where
        Self::Out: Clone,
    {
        Or {
            codec: self,
            value,
            words,
        }
    }

    /// With a value that depends on what is read before, if the key is missing; where there is none, it is required.
    fn or_else(
        self,
        value: fn(&Scope<'_>) -> Option<Self::Out>,
        words: &'static str,
    ) -> OrElse<Self> {
        OrElse {
            codec: self,
            value,
            words,
        }
    }

    /// None if the key is missing; the words say what holds then.
    fn optional(self, words: &'static str) -> Optional<Self> {
        Optional { codec: self, words }
    }

    /// With the value changed by a function.
    fn map(self, change: fn(Self::Out) -> Self::Out) -> Mapped<Self> {
        Mapped {
            codec: self,
            change,
        }
    }

    /// With a further check of the value.
    fn checked(self, check: Check<Self::Out>) -> Checked<Self> {
        Checked { codec: self, check }
    }
}

/// A check of a value that was read; it may change the value.
pub type Check<T> = fn(&ValueReader<'_>, T, &Scope<'_>) -> Result<T, Diagnosis>;

/// A quantity with a unit, or a bare number.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    pub(super) dimension: Dimension,
    pub(super) sign: Sign,
}

impl Quantity {
    const fn of(dimension: Dimension) -> Self {
        let sign = Sign::Any;
        Self { dimension, sign }
    }

    /// Only positive ones.
    #[must_use]
    pub const fn positive(self) -> Self {
        let sign = Sign::Positive;
        Self { sign, ..self }
    }

    /// Only those of zero or more.
    #[must_use]
    pub const fn not_negative(self) -> Self {
        let sign = Sign::NotNegative;
        Self { sign, ..self }
    }
}

/// A length.
#[must_use]
pub const fn length() -> Quantity {
    Quantity::of(Dimension::Length)
}

/// A pressure or a modulus.
#[must_use]
pub const fn pressure() -> Quantity {
    Quantity::of(Dimension::Pressure)
}

/// A force.
#[must_use]
pub const fn force() -> Quantity {
    Quantity::of(Dimension::Force)
}

/// An angle. A bare number beyond a full turn is refused: it was probably meant in degrees.
#[must_use]
pub const fn angle() -> Quantity {
    Quantity::of(Dimension::Angle)
}

/// A compliance, a length over a pressure.
#[must_use]
pub const fn compliance() -> Quantity {
    Quantity::of(Dimension::Compliance)
}

/// A wear coefficient, of any sign.
#[must_use]
pub const fn wear_coefficient() -> Quantity {
    Quantity::of(Dimension::WearCoefficient)
}

/// An energy per area.
#[must_use]
pub const fn energy_per_area() -> Quantity {
    Quantity::of(Dimension::EnergyPerArea)
}

impl Codec for Quantity {
    type Out = f64;

    fn shape(&self) -> Shape {
        Shape::Quantity(self.dimension, self.sign)
    }

    fn wanted(&self) -> String {
        self.sign.wanted(self.dimension)
    }

    fn read(&self, value: &ValueReader<'_>, _: &Scope<'_>) -> Result<f64, Diagnosis> {
        let quantity = value.quantity(self.dimension, self.sign)?;
        let is_bare = !matches!(value.value(), TomlValue::Text(_));
        if self.dimension == Dimension::Angle && is_bare && quantity.abs() > TAU {
            return Err(value.wanted(format!(
                "a unit, as in \"{quantity} deg\": a bare number is in radians, at most a full turn, 6.283"
            )));
        }
        Ok(quantity)
    }
}

/// A number without a dimension.
#[derive(Debug, Clone)]
pub struct Number {
    range: Option<RangeInclusive<f64>>,
    /// Whether the range is checked here.
    is_checked: bool,
    wanted: String,
}

/// A finite number that something else checks, wanted in these words.
#[must_use]
pub fn number(wanted: &str) -> Number {
    let wanted = wanted.to_owned();
    Number {
        range: None,
        is_checked: false,
        wanted,
    }
}

impl Number {
    /// With the range that something else checks.
    #[must_use]
    pub fn within(self, range: RangeInclusive<f64>) -> Self {
        let range = Some(range);
        Self { range, ..self }
    }
}

/// A number in a range; the words of a diagnosis are `what` and the range.
#[must_use]
pub fn fraction(range: RangeInclusive<f64>, wanted: String) -> Number {
    Number {
        range: Some(range),
        is_checked: true,
        wanted,
    }
}

impl Codec for Number {
    type Out = f64;

    fn shape(&self) -> Shape {
        self.range.clone().map_or(Shape::Number, Shape::Range)
    }

    fn wanted(&self) -> String {
        self.wanted.clone()
    }

    fn read(&self, value: &ValueReader<'_>, _: &Scope<'_>) -> Result<f64, Diagnosis> {
        let number = value.number(&self.wanted)?;
        match &self.range {
            Some(range) if self.is_checked && !range.contains(&number) => {
                Err(value.wanted(&self.wanted))
            }
            _ => Ok(number),
        }
    }
}

/// An integer.
#[derive(Debug, Clone)]
pub struct Count {
    range: RangeInclusive<usize>,
    why: &'static str,
}

/// An integer in a range; `why` follows the range in a diagnosis.
#[must_use]
pub const fn count(range: RangeInclusive<usize>, why: &'static str) -> Count {
    Count { range, why }
}

impl Codec for Count {
    type Out = usize;

    fn shape(&self) -> Shape {
        Shape::Count(self.range.clone())
    }

    fn wanted(&self) -> String {
        let (from, to) = self.range.clone().into_inner();
        format!("an integer from {from} to {to}{}", self.why)
    }

    fn read(&self, value: &ValueReader<'_>, _: &Scope<'_>) -> Result<usize, Diagnosis> {
        value.count(self.range.clone(), self.why)
    }
}

/// One of several words.
#[derive(Debug, Clone, Copy)]
pub struct Word<T: 'static> {
    words: &'static [(&'static str, T)],
}

/// One of these words, each with what it stands for.
#[must_use]
pub const fn word<T>(words: &'static [(&'static str, T)]) -> Word<T> {
    Word { words }
}

impl<T: Copy> Codec for Word<T> {
    type Out = T;

    fn shape(&self) -> Shape {
        Shape::Words(self.words.iter().map(|(word, _)| *word).collect())
    }

    fn wanted(&self) -> String {
        in_words(self.words)
    }

    fn read(&self, value: &ValueReader<'_>, _: &Scope<'_>) -> Result<T, Diagnosis> {
        value.choice(self.words)
    }
}

/// `true` or `false`.
#[derive(Debug, Clone, Copy)]
pub struct Switch;

/// `true` or `false`.
#[must_use]
pub const fn switch() -> Switch {
    Switch
}

impl Codec for Switch {
    type Out = bool;

    fn shape(&self) -> Shape {
        Shape::Switch
    }

    fn wanted(&self) -> String {
        "true or false".into()
    }

    fn read(&self, value: &ValueReader<'_>, _: &Scope<'_>) -> Result<bool, Diagnosis> {
        value.switch()
    }
}

/// Any text, never read as a quantity.
#[derive(Debug, Clone, Copy)]
pub struct Text {
    wanted: &'static str,
}

/// Any text, wanted in these words.
#[must_use]
pub const fn text(wanted: &'static str) -> Text {
    Text { wanted }
}

impl Codec for Text {
    type Out = String;

    fn shape(&self) -> Shape {
        Shape::Text
    }

    fn wanted(&self) -> String {
        self.wanted.into()
    }

    fn read(&self, value: &ValueReader<'_>, _: &Scope<'_>) -> Result<String, Diagnosis> {
        value.text().map(str::to_owned)
    }
}

/// A word that stands for itself.
#[derive(Debug, Clone, Copy)]
pub struct Literal {
    word: &'static str,
    wanted: &'static str,
}

/// This word and nothing else, wanted in these words.
#[must_use]
pub const fn literal(word: &'static str, wanted: &'static str) -> Literal {
    Literal { word, wanted }
}

impl Codec for Literal {
    type Out = ();

    fn shape(&self) -> Shape {
        Shape::Words(vec![self.word])
    }

    fn wanted(&self) -> String {
        self.wanted.into()
    }

    fn read(&self, value: &ValueReader<'_>, _: &Scope<'_>) -> Result<(), Diagnosis> {
        match value.text() {
            Ok(text) if text == self.word => Ok(()),
            _ => Err(value.wanted(self.wanted)),
        }
    }
}
