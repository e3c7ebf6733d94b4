//! The real workspace keeps its own house rules: the check of `cargo xtask tidy` as a test.

use std::path::Path;

use xtask::Tree;

#[test]
fn the_workspace_is_tidy() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let tree = Tree::read(&root).expect("the workspace can be read");
    let found: Vec<String> = xtask::tidy(&tree).iter().map(ToString::to_string).collect();
    assert!(
        found.is_empty(),
        "broken house rules:\n{}",
        found.join("\n")
    );
}

/// Without this test, a reader that finds no files would make every rule pass.
#[test]
fn the_rules_cover_every_member_of_the_workspace() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let tree = Tree::read(&root).expect("the workspace can be read");
    let paths = tree.paths();
    for member in [
        "kernel",
        "influence",
        "texture",
        "contact",
        "cli",
        "xtask",
        "tests",
    ] {
        assert!(
            paths.contains(format!("{member}/Cargo.toml").as_str()),
            "{member}"
        );
    }
}
