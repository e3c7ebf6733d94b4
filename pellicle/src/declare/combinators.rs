//! Codecs made of others: with defaults, checks and alternatives, or with the keys of a part in the same table.

use std::marker::PhantomData;

use super::codec::{Check, Codec};
use super::shape::{Presence, Shape, TableShape};
use super::{Record, Scope};
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;
use crate::input::value_reader::ValueReader;

/// The shape of the inner codec, and what it wants.
macro_rules! as_inner {
    () => {
        fn shape(&self) -> Shape {
            self.codec.shape()
        }

        fn wanted(&self) -> String {
            self.codec.wanted()
        }
    };
}

/// A value, or a default.
#[derive(Debug, Clone, Copy)]
pub struct Or<C: Codec> {
    pub(super) codec: C,
    pub(super) value: C::Out,
    pub(super) words: &'static str,
}

impl<C: Codec> Codec for Or<C>
where
    C::Out: Clone,
{
    type Out = C::Out;

    as_inner!();

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<C::Out, Diagnosis> {
        self.codec.read(value, scope)
    }

    fn take(
        &self,
        key: &'static str,
        table: &TableReader<'_>,
        scope: &Scope<'_>,
    ) -> Result<C::Out, Diagnosis> {
        match table.optional(key) {
            Some(value) => self.read(&value, scope),
            None => Ok(self.value.clone()),
        }
    }

    fn presence(&self) -> Presence {
        Presence::Default(self.words.into())
    }
}

/// A value, or a default that depends on the rest of the case.
#[derive(Debug, Clone, Copy)]
pub struct OrElse<C: Codec> {
    pub(super) codec: C,
    pub(super) value: fn(&Scope<'_>) -> Option<C::Out>,
    pub(super) words: &'static str,
}

impl<C: Codec> Codec for OrElse<C> {
    type Out = C::Out;

    as_inner!();

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<C::Out, Diagnosis> {
        self.codec.read(value, scope)
    }

    fn take(
        &self,
        key: &'static str,
        table: &TableReader<'_>,
        scope: &Scope<'_>,
    ) -> Result<C::Out, Diagnosis> {
        match (table.optional(key), (self.value)(scope)) {
            (None, Some(default)) => Ok(default),
            _ => self.codec.take(key, table, scope),
        }
    }

    fn presence(&self) -> Presence {
        Presence::Default(self.words.into())
    }
}

/// A value, or none.
#[derive(Debug, Clone, Copy)]
pub struct Optional<C> {
    pub(super) codec: C,
    pub(super) words: &'static str,
}

impl<C: Codec> Codec for Optional<C> {
    type Out = Option<C::Out>;

    as_inner!();

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<Self::Out, Diagnosis> {
        self.codec.read(value, scope).map(Some)
    }

    fn take(
        &self,
        key: &'static str,
        table: &TableReader<'_>,
        scope: &Scope<'_>,
    ) -> Result<Self::Out, Diagnosis> {
        let value = table.optional(key);
        value
            .map(|value| self.codec.read(&value, scope))
            .transpose()
    }

    fn presence(&self) -> Presence {
        Presence::Default(self.words.into())
    }
}

/// A value that is checked further.
#[derive(Debug, Clone, Copy)]
pub struct Checked<C: Codec> {
    pub(super) codec: C,
    pub(super) check: Check<C::Out>,
}

impl<C: Codec> Codec for Checked<C> {
    type Out = C::Out;

    as_inner!();

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<C::Out, Diagnosis> {
        (self.check)(value, self.codec.read(value, scope)?, scope)
    }
}

/// A value that is changed once it is read.
#[derive(Debug, Clone, Copy)]
pub struct Mapped<C: Codec> {
    pub(super) codec: C,
    pub(super) change: fn(C::Out) -> C::Out,
}

impl<C: Codec> Codec for Mapped<C> {
    type Out = C::Out;

    as_inner!();

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<C::Out, Diagnosis> {
        self.codec.read(value, scope).map(self.change)
    }
}

/// A value of one codec, or a table of another.
#[derive(Debug, Clone, Copy)]
pub struct Either<V: Codec, T, O> {
    value: V,
    of_value: fn(V::Out) -> O,
    of_table: fn(T) -> O,
    wanted: &'static str,
}

/// A value, or else a table, each turned into the same type; wanted in these words if the key is missing.
pub const fn either<V: Codec, T: Record, O>(
    value: V,
    of_value: fn(V::Out) -> O,
    of_table: fn(T) -> O,
    wanted: &'static str,
) -> Either<V, T, O> {
    Either {
        value,
        of_value,
        of_table,
        wanted,
    }
}

impl<V: Codec, T: Record, O> Codec for Either<V, T, O> {
    type Out = O;

    fn shape(&self) -> Shape {
        Shape::Either(vec![self.value.shape(), Shape::Table(T::shape())])
    }

    fn wanted(&self) -> String {
        self.wanted.into()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<O, Diagnosis> {
        if value.is_table() {
            let table = value.clone().table()?;
            return T::read(&table, scope).map(self.of_table);
        }
        self.value.read(value, scope).map(self.of_value)
    }
}

/// A table of a record.
#[derive(Debug, Clone, Copy)]
pub struct Nested<T> {
    wanted: &'static str,
    record: PhantomData<fn() -> T>,
}

/// A table of a record; wanted in these words if the key is missing.
#[must_use]
pub const fn table<T: Record>(wanted: &'static str) -> Nested<T> {
    Nested {
        wanted,
        record: PhantomData,
    }
}

impl<T: Record> Codec for Nested<T> {
    type Out = T;

    fn shape(&self) -> Shape {
        Shape::Table(T::shape())
    }

    fn wanted(&self) -> String {
        self.wanted.into()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<T, Diagnosis> {
        T::read(&value.clone().table()?, scope)
    }
}

/// The fields of a record among those of another table.
#[derive(Debug, Clone, Copy)]
pub struct Part<T>(PhantomData<fn() -> T>);

/// The fields of a record, in the table of which they are a part.
#[must_use]
pub const fn part<T: Record>() -> Part<T> {
    Part(PhantomData)
}

impl<T: Record> Codec for Part<T> {
    type Out = T;

    fn shape(&self) -> Shape {
        Shape::Table(T::shape())
    }

    fn wanted(&self) -> String {
        String::new()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<T, Diagnosis> {
        T::read(&value.clone().table()?, scope)
    }

    fn take(
        &self,
        _: &'static str,
        table: &TableReader<'_>,
        scope: &Scope<'_>,
    ) -> Result<T, Diagnosis> {
        // The other keys of the table are read, and unknown ones refused, elsewhere.
        T::read_part(table, scope)
    }

    fn declare(&self, _: &'static str, _: &'static str, table: &mut TableShape) {
        let TableShape {
            fields,
            one_of,
            together,
            open,
        } = T::shape();
        table.fields.extend(fields);
        table.one_of.extend(one_of);
        table.together.extend(together);
        table.open = table.open.or(open);
    }
}

/// The fields of a record among those of another table, all or none.
#[derive(Debug, Clone, Copy)]
pub struct Together<T>(PhantomData<fn() -> T>);

/// The fields of a record, in the table of which they are a part: all or none.
#[must_use]
pub const fn together<T: Record>() -> Together<T> {
    Together(PhantomData)
}

impl<T: Record> Codec for Together<T> {
    type Out = Option<T>;

    fn shape(&self) -> Shape {
        Shape::Table(T::shape())
    }

    fn wanted(&self) -> String {
        String::new()
    }

    fn read(&self, value: &ValueReader<'_>, scope: &Scope<'_>) -> Result<Option<T>, Diagnosis> {
        T::read(&value.clone().table()?, scope).map(Some)
    }

    fn take(
        &self,
        _: &'static str,
        table: &TableReader<'_>,
        scope: &Scope<'_>,
    ) -> Result<Option<T>, Diagnosis> {
        if table.given(&T::shape().keys()).is_empty() {
            return Ok(None);
        }
        T::read_part(table, scope).map(Some)
    }

    fn declare(&self, _: &'static str, _: &'static str, table: &mut TableShape) {
        let shape = T::shape();
        table.together.extend(shape.keys());
        table.fields.extend(shape.fields);
    }
}
