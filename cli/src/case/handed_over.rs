//! `kind = "function"`: a shape that no file can hold, handed over by the caller that solves the case.

use serde::Serialize;

use super::document::TomlValue;
use super::value_reader::ValueReader;

/// The word for it in a case.
const KIND: &str = "function";

/// A shape of a caller's own; nothing of it is written but its kind. It is no part of the case: all are equal here, and
/// who hands shapes over can tell them apart.
#[derive(Debug, Clone, Serialize)]
pub struct HandedOver<T> {
    /// The shape itself.
    #[serde(skip)]
    pub shape: T,
}

impl<T> PartialEq for HandedOver<T> {
    fn eq(&self, _other: &Self) -> bool {
        true
    }
}

/// The shape, if the kind asks for one and there is one.
pub fn behind<T: Clone>(kind: &ValueReader<'_>, handed: Option<&T>) -> Option<HandedOver<T>> {
    let is_asked_for = matches!(kind.value(), TomlValue::Text(text) if text == KIND);
    let shape = handed.filter(|_| is_asked_for).cloned()?;
    Some(HandedOver { shape })
}
