//! The house rules, each a function from the tree to its violations.

mod dependencies;
mod disk;
mod documents;
mod sources;
mod test_binaries;
mod violation;

pub use self::violation::Violation;
use crate::Tree;

/// A house rule.
type Rule = fn(&Tree) -> Vec<Violation>;

const RULES: [Rule; 8] = [
    dependencies::point_downward,
    sources::begin_with_their_job,
    sources::have_lines_of_prose_that_fit,
    sources::hold_no_trace_of_a_machine,
    disk::is_changed_in_one_place,
    test_binaries::hold_every_test,
    documents::links_resolve,
    documents::named_tests_exist,
];

/// Returns all violations of house rules in the tree, rule by rule; none for a tidy workspace.
#[must_use]
pub fn tidy(tree: &Tree) -> Vec<Violation> {
    RULES.iter().flat_map(|rule| rule(tree)).collect()
}

/// The violations of one rule in a tree of these files, as text.
#[cfg(test)]
fn broken(rule: Rule, files: &[(&str, &str)]) -> Vec<String> {
    let found = rule(&Tree::of(files));
    found.iter().map(ToString::to_string).collect()
}
