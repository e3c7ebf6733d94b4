//! The documents made from the declarations: the list of keys, that of results, and its form in Python.
//!
//! `PELLICLE_UPDATE_DOCUMENTS=1 cargo test -p pellicle documents` writes them anew.

use std::fs;
use std::path::{Path, PathBuf};

use pellicle::Case;
use pellicle::declare::keys;
use pellicle::result::documents as results;
use pellicle::result::quantities::QUANTITIES;
use pellicle::summary::schema::of_summary;

/// A file of the repository.
fn document(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name)
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
        "{name} differs from the declarations; see the head of this test"
    );
}

#[test]
fn the_list_of_keys_is_that_of_the_declarations() {
    let head = "# The keys of a case\n\nMade from the declarations in `pellicle/src/case`. A quantity is a string with \
                its unit or a bare\nnumber.\n\n";
    let text = format!("{head}{}", keys::markdown(&Case::shape()));
    hold("docs/keys.md", &format!("{}\n", text.trim_end()));
}

#[test]
fn the_list_of_results_is_that_of_the_declarations() {
    hold("docs/results.md", &results::markdown());
    hold("python/pellicle/numbers.py", &results::python());
}

#[test]
fn the_schema_of_a_summary_has_every_number_at_its_place() {
    let schema = of_summary();
    for quantity in QUANTITIES {
        let mut table = &schema["$defs"]["step"];
        for name in quantity.key.split('.') {
            table = &table["properties"][name];
        }
        assert!(table["description"].is_string(), "{}", quantity.key);
    }
    // What stands in the text by hand is still there.
    assert!(schema["$defs"]["step"]["properties"]["grid_error"]["required"].is_array());
    assert!(schema["properties"]["case"]["properties"]["indenter"].is_object());
}
