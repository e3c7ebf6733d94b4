//! The keys of a fit file, from the declarations of its tables: each reader accepts the keys of its own and no others,
//! and from them come the list in the documents and the schema by which editors complete and check a fit.

use pellicle::Case;
use pellicle::declare::schema;
use pellicle::declare::shape::{Field, Presence, Shape, TableShape};

use super::evaluation;
use super::nuisance::NuisanceTable;
use super::report::ReportTable;
use crate::measured::data_table::DataTable;

/// The tables of a fit file.
#[must_use]
pub fn fit_file() -> TableShape {
    let optional = Field::optional;
    let data = Shape::list(Shape::Table(DataTable::shape()));
    let unknowns = TableShape::default().open_to("a key of the model with its bounds or its prior");
    TableShape::of([
        optional(
            "title",
            "title of the results",
            Shape::Text,
            "the name of the file",
        ),
        optional(
            "model",
            "a case, or the file of one",
            model(),
            "unloadings are evaluated alone",
        ),
        optional(
            "data",
            "measured curves and how they are read",
            data,
            "the fit can only be planned",
        ),
        optional(
            "unknown",
            "what is sought",
            Shape::Table(unknowns),
            "unloadings are evaluated alone",
        ),
        optional(
            "nuisance",
            "what else acts on the measurements",
            Shape::Table(NuisanceTable::shape()),
            "its defaults",
        ),
        optional(
            "report",
            "the form of the result",
            Shape::Table(ReportTable::shape()),
            "its defaults",
        ),
        optional(
            "evaluation",
            "how unloadings are evaluated by Oliver and Pharr",
            Shape::Table(evaluation::shape()),
            "no unloadings",
        ),
    ])
}

/// The keys of a model that is the file of a case.
pub(super) fn model_file() -> TableShape {
    TableShape::of([Field::required("case", "the path of a case", Shape::Text)])
}

/// A model: a file, or the tables of a case, of which a fit supplies some.
fn model() -> Shape {
    let mut case = Case::shape();
    for field in &mut case.fields {
        let missing = |words: &str| Presence::Default(words.into());
        match (field.key, &mut field.shape) {
            // A fit has forces of its own; only an adhesion is taken from the model.
            ("load", Shape::Table(load)) => {
                free_alternatives(load, "no load");
                field.presence = missing("no adhesion");
            }
            // The radius may be in the measured files, and the whole indenter in `[evaluation]`.
            ("indenter", Shape::Kinds(indenter)) => {
                for (_, _, table) in &mut indenter.kinds {
                    if table.keys().contains(&"radius") {
                        table.one_of.push("radius");
                        free_alternatives(table, "that of the files");
                    }
                }
                field.presence = missing("that of the evaluation");
            }
            _ => {}
        }
    }
    Shape::Either(vec![Shape::Table(model_file()), Shape::Table(case)])
}

/// Frees a table of having exactly one of some keys; none of them means this.
fn free_alternatives(table: &mut TableShape, none: &str) {
    for field in &mut table.fields {
        if table.one_of.contains(&field.key) {
            field.presence = Presence::Default(none.into());
        }
    }
    table.one_of.clear();
}

/// The JSON schema of a fit file.
#[must_use]
pub fn schema() -> String {
    schema::text(&schema::of_file("A fit of Pellicle", &fit_file()))
}
