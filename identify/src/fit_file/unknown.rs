//! `[unknown]` of a fit file: the parameters to be fitted, each between bounds or with a prior.

use pellicle::case::parameter::{self, CaseParameter};
use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::key_path::dotted;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::{TomlEntry, TomlTable, TomlValue};
use pellicle::input::value_reader::ValueReader;
use pellicle_contact::{IndenterQuantity, ModelParameter};

use super::model::ModelParameters;
use super::prior;
use crate::{IdentifyError, Prior, Unknown};

/// Without bounds, a parameter is sought within this many standard deviations of its prior.
const DEVIATIONS: f64 = 8.0;
/// Smallest and largest Poisson's ratio that are sought: the fit works with its logarithm, and no ratio exceeds ½.
const RATIOS: [f64; 2] = [1e-3, 0.499];
/// Smallest and largest exponent of a power law that are sought: derivatives need neighbours, and at 1 the coefficient
/// of the indenter is of no effect.
const EXPONENTS: [f64; 2] = [1.001, 49.0];
/// The smallest value that is sought, as a fraction of the prior's mean.
const LEAST_PART: f64 = 1e-3;

/// A parameter to be fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct UnknownCase {
    /// Its key in the case.
    pub key: String,
    /// The parameter of the model.
    pub parameter: ModelParameter,
    /// Its dimension; none for Poisson's ratio and an exponent.
    pub dimension: Option<Dimension>,
    /// Smallest and largest value, in SI units.
    pub range: [f64; 2],
    /// Its prior, if any.
    pub prior: Option<Prior>,
    /// The start of the search: the value of the case, if it lies in the range.
    pub start: f64,
}

impl UnknownCase {
    /// Returns the unknown of the fit.
    ///
    /// # Errors
    ///
    /// [`IdentifyError`] if the prior's centre lies outside the range.
    pub fn unknown(&self) -> Result<Unknown, IdentifyError> {
        let unknown = Unknown::positive(self.key.clone(), self.range)?.starting_at(self.start)?;
        match self.prior {
            Some(prior) => unknown.with_prior(prior),
            None => Ok(unknown),
        }
    }

    /// Its SI unit.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        parameter::unit(self.dimension)
    }
}

/// Reads the table, one unknown per key.
///
/// # Errors
///
/// A [`Diagnosis`] of the first fault.
pub fn read_unknowns(
    field: &ValueReader<'_>,
    parameters: &ModelParameters,
) -> Result<Vec<UnknownCase>, Diagnosis> {
    let fields = flattened(field)?;
    if fields.is_empty() {
        return Err(field.wanted("at least one key of the model that is sought"));
    }
    let read = |(key, field): &(String, ValueReader<'_>)| read_unknown(key, field, parameters);
    fields.iter().map(read).collect()
}

/// The keys of what is sought: bounds, a prior, or both.
#[must_use]
pub fn shape() -> TableShape {
    let bound = || Shape::Either(vec![Shape::Number, Shape::Text]);
    let end = |key, meaning| Field::optional(key, meaning, bound(), "that of the prior");
    let ends = [end("from", "the lower bound"), end("to", "the upper bound")];
    let prior = prior::shape(None).fields;
    TableShape::of(ends.into_iter().chain(prior).collect::<Vec<_>>())
}

/// Reads one key.
///
/// # Errors
///
/// A [`Diagnosis`] of the first fault.
pub fn read_unknown(
    key: &str,
    field: &ValueReader<'_>,
    parameters: &ModelParameters,
) -> Result<UnknownCase, Diagnosis> {
    let of = parameters.required(field, key)?;
    let table = field.clone().table()?;
    table.only(&shape().keys())?;
    let prior = prior::read(&table, of.dimension)?;
    let range = range(&table, of, prior)?;
    let [low, high] = range;
    if low >= high {
        return Err(field.wanted("bounds with `from` below `to`"));
    }
    let value = parameters.value(of).unwrap_or(f64::NAN);
    let start = if (low..=high).contains(&value) {
        value
    } else {
        (low * high).sqrt()
    };
    let case = UnknownCase {
        key: of.key.clone(),
        parameter: of.parameter,
        dimension: of.dimension,
        range,
        prior,
        start,
    };
    case.unknown().map_err(|error| field.refused(&error))?;
    Ok(case)
}

/// Returns the given bounds, or those of the prior.
fn range(
    table: &TableReader<'_>,
    of: &CaseParameter,
    prior: Option<Prior>,
) -> Result<[f64; 2], Diagnosis> {
    let [low, high] = match prior {
        Some(Prior::Lognormal { median, factor }) => {
            let reach = factor.powf(DEVIATIONS);
            [Some(median / reach), Some(median * reach)]
        }
        Some(Prior::Normal { mean, sd }) => [
            Some((mean - DEVIATIONS * sd).max(LEAST_PART * mean)),
            Some(mean + DEVIATIONS * sd),
        ],
        None => [None, None],
    };
    let bound = |key, default: Option<f64>| match (table.optional(key), default) {
        (None, Some(default)) => Ok(default),
        _ => prior::value(table, key, of.dimension, Sign::Positive),
    };
    let range = [bound("from", low)?, bound("to", high)?];
    let [least, most] = match (of.parameter, of.dimension) {
        (ModelParameter::Indenter(IndenterQuantity::Exponent), _) => EXPONENTS,
        (_, None) => RATIOS,
        (_, Some(_)) => return Ok(range),
    };
    Ok(range.map(|value| value.clamp(least, most)))
}

/// Returns the entries of a table with their dotted keys, whether quoted or not.
///
/// # Errors
///
/// A [`Diagnosis`] if the value is not a table.
pub fn flattened<'a>(field: &ValueReader<'a>) -> Result<Vec<(String, ValueReader<'a>)>, Diagnosis> {
    let TomlValue::Table(table) = field.value() else {
        return Err(field.wanted("a table"));
    };
    let mut found = Vec::new();
    collect(table, "", field.path(), &mut found);
    Ok(found)
}

fn collect<'a>(
    table: &'a TomlTable,
    prefix: &str,
    path: &str,
    found: &mut Vec<(String, ValueReader<'a>)>,
) {
    for TomlEntry { key, node, .. } in &table.entries {
        let (key, path) = (dotted(prefix, key), dotted(path, key));
        match &node.value {
            TomlValue::Table(inner) if inner.entries.iter().all(is_part_of_key) => {
                collect(inner, &key, &path, found);
            }
            _ => found.push((key, ValueReader::new(path, node))),
        }
    }
}

/// Whether an entry is part of the key of a parameter rather than part of its description.
fn is_part_of_key(entry: &TomlEntry) -> bool {
    let key = entry.key.as_str();
    !(key == "per" || shape().keys().contains(&key))
}
