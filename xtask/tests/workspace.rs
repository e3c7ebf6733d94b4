//! The real workspace keeps its own house rules: the check of `cargo xtask tidy` as a test.

use std::path::Path;

use xtask::{SiteSource, Tree};

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

#[test]
fn the_site_has_every_page_to_which_its_pages_lead() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let tree = Tree::read(&root).expect("the workspace can be read");
    let site = SiteSource::gathered(&tree).expect("the contents are complete");
    let documents = tree.texts_ending(".md").map(|(path, _)| path);
    for page in documents.filter(|path| path.starts_with("docs/")) {
        assert!(site.pages().iter().any(|listed| listed == page), "{page}");
    }
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
