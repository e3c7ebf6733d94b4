//! The list of the keys of a fit, made from the declarations.
//!
//! `PELLICLE_UPDATE_DOCUMENTS=1 cargo test -p pellicle-identify documents` writes it anew.

use std::fs;
use std::path::Path;

use pellicle::declare::keys;
use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle_identify::fit_file::shape::fit_file;

#[test]
fn the_list_of_keys_is_that_of_the_declarations() {
    let mut file = fit_file();
    for field in &mut file.fields {
        if field.key == "model" {
            let case =
                Field::optional("case", "the path of a case", Shape::Text, "its tables here");
            let tables = "the tables of a [case](keys.md); without loads, but for an adhesion";
            field.shape = Shape::Table(TableShape::of([case]).open_to(tables));
        }
    }
    let head = "# The keys of a fit\n\nMade from the declarations in `pellicle-identify`. A quantity is a string with its \
                unit or a bare number.\n[Fits](identification.md), [measured curves](measured-curves.md) and \
                [unloadings](indentation.md) explain them.\n\n";
    let text = format!("{head}{}\n", keys::markdown(&file).trim_end());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/fit-keys.md");
    if std::env::var_os("PELLICLE_UPDATE_DOCUMENTS").is_some() {
        fs::write(&path, &text).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(
        found, text,
        "docs/fit-keys.md differs from the declarations; see the head of this test"
    );
}
