//! Every relative link of a document leads to a file of the tree, and every anchor to a heading.

use std::collections::BTreeSet;

use crate::markdown::{self, Link};
use crate::{Tree, Violation};

/// Every link in a `.md` file that leads nowhere. Links to other sites are not followed.
pub(super) fn resolve(tree: &Tree) -> Vec<Violation> {
    let paths = tree.paths();
    let mut found = Vec::new();
    for (path, text) in tree.texts_ending(".md") {
        for link in markdown::links(text).iter().filter(|l| is_relative(l)) {
            if let Some(message) = breakage(tree, &paths, path, &link.target) {
                found.push(Violation::at_line(path, link.line, message));
            }
        }
    }
    found
}

fn is_relative(link: &Link) -> bool {
    !link.target.contains("://") && !link.target.starts_with("mailto:")
}

/// What is wrong with `target`, written in the document at `path`.
fn breakage(tree: &Tree, paths: &BTreeSet<&str>, path: &str, target: &str) -> Option<String> {
    let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
    let Some(resolved) = resolved(path, file).filter(|p| paths.contains(p.as_str())) else {
        return Some(format!("the link to `{target}` leads to no file"));
    };
    let (_, document) = tree.texts_ending(".md").find(|(p, _)| *p == resolved)?;
    let is_found = anchor.is_empty() || markdown::anchors(document).iter().any(|a| a == anchor);
    (!is_found).then(|| format!("the link to `{target}` leads to no heading"))
}

/// The path from the root of `target`, as seen from the document `from`; `None` if it leaves the tree.
fn resolved(from: &str, target: &str) -> Option<String> {
    if target.is_empty() {
        return Some(from.to_owned());
    }
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in target.split('/').filter(|part| !matches!(*part, "" | ".")) {
        if part == ".." {
            parts.pop()?;
        } else {
            parts.push(part);
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(text: &str) -> Vec<String> {
        let tree = Tree::of(&[
            ("README.md", "# Pellicle\n"),
            ("docs/notation.md", "# Notation\n## Of the paper\n"),
            ("docs/page.md", text),
        ]);
        resolve(&tree).into_iter().map(|v| v.to_string()).collect()
    }

    #[test]
    fn links_to_files_folders_headings_and_other_sites_are_tidy() {
        let text = "# Here\n[a](../README.md) [b](notation.md#of-the-paper) [c](../docs) [d](#here) [e](https://x.org/y)\n";
        assert!(messages(text).is_empty());
    }

    #[test]
    fn a_link_to_no_file_is_found_with_its_line() {
        let found = messages("# Here\n\n![a](images/none.png)\n");
        assert_eq!(
            found,
            ["docs/page.md:3: the link to `images/none.png` leads to no file"]
        );
    }

    #[test]
    fn a_link_out_of_the_tree_is_found() {
        assert_eq!(messages("[a](../../README.md)").len(), 1);
    }

    #[test]
    fn a_link_to_no_heading_is_found() {
        assert!(messages("[a](notation.md#of-the-book)")[0].contains("leads to no heading"));
        assert!(messages("[a](#gone)")[0].contains("leads to no heading"));
    }
}
