//! The documents made from the declarations: the list of keys and the schema of a case.
//!
//! `PELLICLE_UPDATE_DOCUMENTS=1 cargo test -p pellicle documents` writes them anew.

use std::fs;
use std::path::{Path, PathBuf};

use pellicle::Case;
use pellicle::declare::{keys, schema};

/// A file of the folder `docs`.
fn document(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../docs")
        .join(name)
}

/// Holds a document to what it should be, or writes it.
fn hold(name: &str, wanted: &str) {
    let path = document(name);
    if std::env::var_os("PELLICLE_UPDATE_DOCUMENTS").is_some() {
        fs::write(path, wanted).expect("a writable folder");
        return;
    }
    let found = fs::read_to_string(&path).expect("the document");
    assert!(
        found == wanted,
        "docs/{name} differs from the declarations; see the head of this test"
    );
}

#[test]
fn the_list_of_keys_is_that_of_the_declarations() {
    let head = "# The keys of a case\n\nMade from the declarations in `pellicle/src/case`. A quantity is a string with \
                its unit or a bare\nnumber.\n\n";
    let text = format!("{head}{}", keys::markdown(&Case::shape()));
    hold("keys.md", &format!("{}\n", text.trim_end()));
}

#[test]
fn the_schema_of_a_case_is_that_of_the_declarations() {
    hold("case.schema.json", &schema::text(&schema::of_case()));
}
