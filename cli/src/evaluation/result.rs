//! `fit.json` of an evaluation, in SI units.

use std::collections::BTreeMap;

use pellicle::summary::PROGRAM;
use pellicle_identify::fit_file::evaluation_file::{Evaluated, EvaluatedFile, EvaluationFile};
use pellicle_identify::indentation::{
    EffectiveIndenterNumbers, EvaluationSettings, IndentationNumber, IndentationNumbers, Uncertain,
};
use serde::{Serialize, Serializer};

use super::{depth_trend, warnings};
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
    /// Whether it is one reading of a continuous stiffness, not an unloading.
    #[serde(skip)]
    pub is_reading: bool,
    /// Its numbers by name; null where it does not have one.
    #[serde(flatten, serialize_with = "by_name")]
    pub numbers: Vec<Option<Uncertain>>,
    /// The only unknown of a fit, from this contact alone, exactly for the layered body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exact: Option<ExactModulus>,
    /// The power-law indenter whose elastic contact with the fitted body is that of the unloading.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effective_indenter: Option<EffectiveIndenterNumbers>,
}

impl Indentation {
    /// One of its numbers; zero where it does not have it.
    #[must_use]
    pub fn number(&self, of: IndentationNumber) -> Uncertain {
        self.numbers[of.place()].unwrap_or_default()
    }
}

/// An unknown from a single contact.
#[derive(Debug, Clone, Serialize)]
pub struct ExactModulus {
    /// Its key.
    pub key: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Its value; null if no value in its bounds gives the measured stiffness.
    pub value: Option<f64>,
    /// Its standard uncertainty.
    pub sd: Option<f64>,
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
    pub fn new(
        file: &EvaluationFile,
        curves: &[EvaluatedFile],
        settings: &EvaluationSettings,
    ) -> Self {
        let is_whole = curves.iter().all(|file| file.evaluated.is_ok());
        Self {
            schema: SCHEMA,
            program: PROGRAM,
            version: env!("CARGO_PKG_VERSION"),
            title: file.title.clone(),
            verdict: if is_whole {
                "evaluated"
            } else {
                "not-evaluated"
            },
            indentation: indentations(curves),
            repeats: repeats(curves),
            warnings: WarningResult::of_guesses(&file.document)
                .into_iter()
                .chain(warnings::all(curves, settings))
                .chain(depth_trend::warning(curves))
                .collect(),
        }
    }
}

/// A contact: its file, its number among all from 1, and its numbers.
struct OneContact<'a> {
    file: &'a EvaluatedFile,
    curve: usize,
    numbers: &'a IndentationNumbers,
}

impl OneContact<'_> {
    fn is_reading(&self) -> bool {
        matches!(self.file.evaluated, Ok(Evaluated::Stiffnesses(_)))
    }
}

fn contacts(curves: &[EvaluatedFile]) -> Vec<OneContact<'_>> {
    let of_file = curves.iter().flat_map(|file| {
        let contacts = file.evaluated.iter().flat_map(Evaluated::contacts);
        contacts.map(move |numbers| (file, numbers))
    });
    let numbered = of_file.enumerate();
    numbered
        .map(|(index, (file, numbers))| OneContact {
            file,
            curve: index + 1,
            numbers,
        })
        .collect()
}

/// The numbers of every contact that has them.
#[must_use]
pub fn indentations(curves: &[EvaluatedFile]) -> Vec<Indentation> {
    let of = |contact: &OneContact<'_>| Indentation {
        file: contact.file.measured.file.display().to_string(),
        curve: contact.curve,
        is_reading: contact.is_reading(),
        numbers: IndentationNumber::ALL
            .map(|of| contact.numbers.get(of))
            .into(),
        exact: None,
        effective_indenter: None,
    };
    contacts(curves).iter().map(of).collect()
}

/// The repeats of each table; the readings of a continuous stiffness are none of each other.
fn repeats(curves: &[EvaluatedFile]) -> Vec<Repeats> {
    let mut groups: Vec<(usize, f64, Vec<OneContact<'_>>)> = Vec::new();
    let unloadings = contacts(curves).into_iter();
    for contact in unloadings.filter(|contact| !contact.is_reading()) {
        let force = contact.numbers.get(IndentationNumber::MaxForce);
        let force = force.unwrap_or_default().value;
        let table = contact.file.table;
        let is_same = |(of, largest, _): &&mut (usize, f64, Vec<OneContact<'_>>)| {
            *of == table && (force / *largest).max(*largest / force) <= SAME_FORCE
        };
        match groups.iter_mut().find(is_same) {
            Some((_, _, members)) => members.push(contact),
            None => groups.push((table, force, vec![contact])),
        }
    }
    let groups = groups.into_iter().map(|(_, _, members)| members);
    let several = groups.filter(|members| members.len() > 1);
    several.map(|members| mean_of(&members)).collect()
}

fn mean_of(members: &[OneContact<'_>]) -> Repeats {
    let of = |number| {
        let values = members.iter().map(|of| of.numbers.get(number));
        let values: Vec<Uncertain> = values.collect::<Option<_>>()?;
        let count = values.len() as f64;
        let mean = values.iter().map(|of| of.value).sum::<f64>() / count;
        let squares: f64 = values.iter().map(|of| (of.value - mean).powi(2)).sum();
        Some(Uncertain {
            value: mean,
            sd: (squares / (count - 1.0)).sqrt(),
        })
    };
    Repeats {
        curves: members.iter().map(|of| of.curve).collect(),
        numbers: IndentationNumber::ALL.map(of).into(),
    }
}
