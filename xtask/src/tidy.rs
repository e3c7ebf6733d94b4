//! The house rules, one a file, each a function from the tree to what breaks it.

mod architecture;
mod cases;
mod crate_roots;
mod dependencies;
mod evidence;
mod headers;
mod inheritance;
mod links;
mod readmes;
mod test_command;
mod traces;
mod versions;

use crate::{Tree, Violation};

/// A house rule: everything in the tree that breaks it.
type Rule = fn(&Tree) -> Vec<Violation>;

const RULES: [Rule; 12] = [
    dependencies::point_downward,
    versions::stand_in_the_root,
    inheritance::of_package_fields,
    headers::open_every_source,
    crate_roots::hold_no_code,
    readmes::introduce_every_package,
    links::resolve,
    traces::are_removed,
    cases::say_what_they_show,
    evidence::names_tests_that_exist,
    architecture::stays_short,
    test_command::is_what_ci_runs,
];

/// Everything in the tree that breaks a house rule, rule by rule; empty for a tidy workspace.
#[must_use]
pub fn tidy(tree: &Tree) -> Vec<Violation> {
    RULES.iter().flat_map(|rule| rule(tree)).collect()
}
