//! The numbers and fields of a result, as a page in Markdown and as attributes of a step in Python.

use super::extremes::{OF_BODIES, OF_INTERFACES};
use super::fields::{NUMBERS, TRUTHS};
use super::quantities::QUANTITIES;
use super::quantity::{Measure, Part, Quantity};

/// The page.
#[must_use]
pub fn markdown() -> String {
    let numbers: String = QUANTITIES.iter().map(row).collect();
    let bodies = OF_BODIES
        .iter()
        .map(|of| (of.name, of.quantity.name(), of.meaning));
    let interfaces = OF_INTERFACES.iter();
    let interfaces = interfaces.map(|of| (of.name, of.quantity.name(), of.meaning));
    let stress = |(name, key, meaning)| format!("| {name} | `{key}` | {meaning} |\n");
    let bodies: String = bodies.map(stress).collect();
    let interfaces: String = interfaces.map(stress).collect();
    let fields = NUMBERS.iter().map(|of| (of.name, of.unit, of.meaning));
    let fields = fields.chain(TRUTHS.iter().map(|of| (of.name, "", of.meaning)));
    let field = |(name, unit, meaning)| format!("| `{name}` | {unit} | {meaning} |\n");
    let fields = fields.map(field).collect::<Vec<_>>().concat();
    format!(
        "# The numbers and fields of a result\n\n\
         Made from the declarations in `pellicle/src/result`. A number has the same name on the terminal, on the page\n\
         of a run, in `curve.csv` and in the table of a study. Its key is its place in a step of `summary.json`; without\n\
         a dot it is the name of an attribute of a step in Python, too. A number with ± has its grid error beside it: in\n\
         tables, columns `… error`, empty where the number is not resolved, and `… resolved`; in `summary.json`, the\n\
         table `grid_error`. Units are those of a case that names a unit; otherwise the case's own.\n\n\
         | number | symbol | unit | ± | key | meaning | given |\n|---|---|---|---|---|---|---|\n{numbers}\n\
         ## Stresses\n\n\
         The extremes in each body, at x, y, z, and on each interface, at x, y, in Pa, each with ±; in tables with the\n\
         name of the body or interface. `[stress] only` takes their keys.\n\n\
         | in a body | key | meaning |\n|---|---|---|\n{bodies}\n\
         | on an interface | key | meaning |\n|---|---|---|\n{interfaces}\n\
         ## Fields\n\n\
         N × N values, N_x × N_y of an oblong cell, first index along x, under the same name in every file and in Python.\n\n\
         | field | unit | meaning |\n|---|---|---|\n{fields}"
    )
}

fn row(of: &Quantity) -> String {
    let unit = match of.measure {
        Measure::Of(unit) => unit.symbol(),
        Measure::Place => "m",
        Measure::Ratio | Measure::Count | Measure::Truth => "",
    };
    let error = if of.error.is_some() { "±" } else { "" };
    let (name, symbol, key, meaning) = (of.name, of.symbol, of.key, of.meaning);
    let given = of.part.words();
    format!("| {name} | {symbol} | {unit} | {error} | `{key}` | {meaning} | {given} |\n")
}

/// The module of the Python package with the numbers of a step and its fields.
#[must_use]
pub fn python() -> String {
    // A field of the same name is the attribute.
    let is_field = |key| NUMBERS.iter().any(|field| field.name == key);
    let of_step = |of: &&Quantity| !of.key.contains('.') && !is_field(of.key);
    let numbers: String = QUANTITIES.iter().filter(of_step).map(property).collect();
    let fields = NUMBERS
        .iter()
        .map(|of| (of.name, format!("\"{}\"", of.unit), of.meaning));
    let truths = TRUTHS
        .iter()
        .map(|of| (of.name, "None".to_owned(), of.meaning));
    let field = |(name, unit, meaning)| format!("    \"{name}\": ({unit}, \"{meaning}\"),\n");
    let fields = fields.chain(truths).map(field).collect::<Vec<_>>();
    let fields = fields.concat();
    format!(
        "\"\"\"The numbers and fields of a step. Made from the declarations in `pellicle/src/result`.\"\"\"\n\n\
         from __future__ import annotations\n\n\
         from collections.abc import Mapping\n\
         from typing import Any\n\n\
         from .judgement import number\n\n\
         FIELDS: dict[str, tuple[str | None, str]] = {{\n{fields}}}\n\
         \"\"\"Unit and meaning of each field.\"\"\"\n\n\n\
         class StepNumbers:\n    \
         \"\"\"The numbers of a loading step.\"\"\"\n\n    \
         _summary: Mapping[str, Any]\n{numbers}"
    )
}

fn property(of: &Quantity) -> String {
    let (key, meaning) = (of.key, of.meaning);
    let found = format!("self._summary[\"{key}\"]");
    let (kind, value) = match (of.measure, of.part) {
        (Measure::Count, _) => ("int", format!("int({found})")),
        (Measure::Truth, _) => ("bool", format!("bool({found})")),
        (Measure::Place, _) => (
            "tuple[float, float]",
            format!("(number({found}[0]), number({found}[1]))"),
        ),
        (_, Part::Touching | Part::Nominal | Part::Hardness | Part::Averaged) => (
            "float | None",
            format!("None if self._summary.get(\"{key}\") is None else number({found})"),
        ),
        _ => ("float", format!("number({found})")),
    };
    let unit = match of.measure {
        Measure::Of(unit) => format!(", {}", unit.symbol()),
        Measure::Place => ", m".into(),
        Measure::Ratio | Measure::Count | Measure::Truth => String::new(),
    };
    let given = match of.part.words() {
        "always" => String::new(),
        _ => "; None if not given".into(),
    };
    let mut letters = meaning.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    let meaning: String = first.chain(letters).collect();
    format!(
        "\n    @property\n    def {key}(self) -> {kind}:\n        \
         \"\"\"{meaning}{unit}{given}.\"\"\"\n        return {value}\n"
    )
}
