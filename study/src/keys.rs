//! The keys of a study file: those of `[study]`, beside the tables of its case.

use pellicle::Case;
use pellicle::declare::schema;
use pellicle::declare::shape::{Field, Presence, Shape, TableShape};

use crate::KeptField;
use crate::numbering::Combine;
use crate::study_file::FROM;

/// The keys of `[study]`.
#[must_use]
pub fn study() -> TableShape {
    let from = Field::optional(
        FROM,
        "the path of a table of samples, a column for each key",
        Shape::Text,
        "no samples",
    );
    let vary = TableShape::of([from])
        .open_to("a key of the case with a list of values or `{ from, to, count, spacing }`");
    TableShape::of([
        Field::optional(
            "case",
            "the path of the case, in place of its tables in this file",
            Shape::Text,
            "its tables are in this file",
        ),
        Field::optional(
            "combine",
            "every value with every other, or the first with the first",
            Shape::words(&Combine::CHOICES),
            "`\"product\"`",
        ),
        Field::optional(
            "keep",
            "fields of every case that are kept",
            Shape::list(Shape::words(&KeptField::CHOICES)),
            "none",
        ),
        Field::required("vary", "the keys that vary", Shape::Table(vary)),
    ])
}

/// The JSON schema of a study file, with which editors complete and check it.
#[must_use]
pub fn schema() -> String {
    let mut file = Case::shape();
    // They may be in the file that `study.case` names.
    for field in &mut file.fields {
        field.presence = Presence::Default("as in a case".into());
    }
    let meaning = "the keys that vary, and how they are combined";
    let study = Field::required("study", meaning, Shape::Table(study()));
    file.fields.push(study);
    schema::text(&schema::of_file("A parameter study of Pellicle", &file))
}
