//! Every package has a README that says how to use it alone.

use crate::manifest;
use crate::{Tree, Violation};

/// Every member without a `README.md`.
pub(super) fn introduce_every_package(tree: &Tree) -> Vec<Violation> {
    let readmes = manifest::members(tree)
        .into_iter()
        .map(|member| format!("{}/README.md", member.folder));
    readmes
        .filter(|path| tree.text(path).is_none_or(|text| text.trim().is_empty()))
        .map(|path| Violation::in_file(&path, "missing or empty; every package introduces itself"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOT: (&str, &str) = ("Cargo.toml", "[workspace]\nmembers = [\"kernel\"]");

    #[test]
    fn a_package_with_a_readme_is_tidy() {
        let tree = Tree::of(&[ROOT, ("kernel/README.md", "# Kernel")]);
        assert_eq!(introduce_every_package(&tree), []);
    }

    #[test]
    fn a_missing_or_empty_readme_is_found() {
        assert_eq!(introduce_every_package(&Tree::of(&[ROOT])).len(), 1);
        let tree = Tree::of(&[ROOT, ("kernel/README.md", "\n")]);
        assert_eq!(introduce_every_package(&tree)[0].path, "kernel/README.md");
    }
}
