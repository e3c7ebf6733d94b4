//! `fit.json` of an evaluation, in SI units.

use std::collections::BTreeMap;

use pellicle::summary::PROGRAM;
use pellicle_identify::fit_file::evaluation_file::EvaluatedFile;
use pellicle_identify::indentation::{
    EvaluatedCurve, EvaluationSettings, IndentationNumber, Uncertain,
};
use serde::{Serialize, Serializer};

use super::warnings;
use crate::identification::findings::WarningResult;
use crate::identification::result::SCHEMA;

/// Curves of one table are repeats if their largest forces lie within this factor.
const SAME_FORCE: f64 = 1.1;

/// The result of an evaluation: `fit.json`.
#[derive(Debug, Clone, Serialize)]
pub struct EvaluationResult {
    /// Name and version of the layout.
    pub schema: &'static str,
    /// The program that wrote it.
    pub program: &'static str,
    /// Its version.
    pub version: &'static str,
    /// Title of the file.
    pub title: String,
    /// `evaluated`, or `not-evaluated` if a curve has no numbers.
    pub verdict: &'static str,
    /// The curves.
    pub indentation: Vec<Indentation>,
    /// Means over repeats.
    pub repeats: Vec<Repeats>,
    /// Warnings for the reader.
    pub warnings: Vec<WarningResult>,
}

/// The numbers of a curve.
#[derive(Debug, Clone, Serialize)]
pub struct Indentation {
    /// Its file.
    pub file: String,
    /// Its number among all curves, from 1.
    pub curve: usize,
    /// Its numbers by name; null where it does not have one.
    #[serde(flatten, serialize_with = "by_name")]
    pub numbers: Vec<Option<Uncertain>>,
}

/// Means over the curves of one table under one largest force, each with the standard deviation of single curves.
#[derive(Debug, Clone, Serialize)]
pub struct Repeats {
    /// The curves, by number.
    pub curves: Vec<usize>,
    /// Means and standard deviations by name.
    #[serde(flatten, serialize_with = "by_name")]
    pub numbers: Vec<Option<Uncertain>>,
}

fn by_name<S: Serializer>(numbers: &[Option<Uncertain>], to: S) -> Result<S::Ok, S::Error> {
    let names = IndentationNumber::ALL.map(IndentationNumber::name);
    let all: BTreeMap<&str, &Option<Uncertain>> = names.into_iter().zip(numbers).collect();
    all.serialize(to)
}

impl EvaluationResult {
    /// Assembles the result.
    #[must_use]
    pub fn new(title: &str, curves: &[EvaluatedFile], settings: &EvaluationSettings) -> Self {
        let indentation = indentations(curves);
        let whole = indentation.len() == curves.len();
        Self {
            schema: SCHEMA,
            program: PROGRAM,
            version: env!("CARGO_PKG_VERSION"),
            title: title.to_owned(),
            verdict: if whole { "evaluated" } else { "not-evaluated" },
            repeats: repeats(curves),
            indentation,
            warnings: warnings::all(curves, settings),
        }
    }
}

/// The numbers of every curve that has them.
#[must_use]
pub fn indentations(curves: &[EvaluatedFile]) -> Vec<Indentation> {
    let all = curves.iter().enumerate();
    let of = |(index, file): (usize, &EvaluatedFile)| {
        Some(Indentation {
            file: file.measured.file.display().to_string(),
            curve: index + 1,
            numbers: numbers(file.evaluated.as_ref().ok()?),
        })
    };
    all.filter_map(of).collect()
}

fn numbers(curve: &EvaluatedCurve) -> Vec<Option<Uncertain>> {
    IndentationNumber::ALL.map(|of| curve.number(of)).into()
}

/// The repeats of each table.
fn repeats(curves: &[EvaluatedFile]) -> Vec<Repeats> {
    let mut groups: Vec<(usize, f64, Vec<usize>)> = Vec::new();
    for (index, file) in curves.iter().enumerate() {
        let Ok(curve) = &file.evaluated else {
            continue;
        };
        let force = curve.unloading.force;
        let is_same = |(table, of, _): &&mut (usize, f64, Vec<usize>)| {
            *table == file.table && (force / *of).max(*of / force) <= SAME_FORCE
        };
        match groups.iter_mut().find(is_same) {
            Some((_, _, members)) => members.push(index),
            None => groups.push((file.table, force, vec![index])),
        }
    }
    let groups = groups.into_iter().map(|(_, _, members)| members);
    let several = groups.filter(|members| members.len() > 1);
    several.map(|members| mean_of(curves, &members)).collect()
}

fn mean_of(curves: &[EvaluatedFile], members: &[usize]) -> Repeats {
    let of = |number| {
        let values = members.iter().map(|index| {
            let curve = curves[*index].evaluated.as_ref().ok()?;
            curve.number(number).map(|of| of.value)
        });
        let values: Vec<f64> = values.collect::<Option<_>>()?;
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        Some(Uncertain {
            value: mean,
            sd: (squares / (count - 1.0)).sqrt(),
        })
    };
    Repeats {
        curves: members.iter().map(|index| index + 1).collect(),
        numbers: IndentationNumber::ALL.map(of).into(),
    }
}
