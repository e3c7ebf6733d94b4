//! A `lib.rs` is a table of contents: documentation, `mod` lines and re-exports.

use crate::{Tree, Violation};

/// What a statement of a `lib.rs` may begin with.
const CONTENTS: [&str; 4] = ["mod ", "pub mod ", "pub(crate) mod ", "pub use "];

/// Every statement of a `src/lib.rs` that is something else.
pub(super) fn hold_no_code(tree: &Tree) -> Vec<Violation> {
    let roots = tree.texts_ending("src/lib.rs");
    roots
        .flat_map(|(path, text)| {
            let code = statements(text)
                .into_iter()
                .filter(|(_, s)| !is_contents(s));
            code.map(move |(line, statement)| {
                let message =
                    format!("`{statement}` belongs in a module of its own; lib.rs only lists them");
                Violation::at_line(path, line, message)
            })
        })
        .collect()
}

fn is_contents(statement: &str) -> bool {
    let is_inline_module = statement.contains('{') && !statement.starts_with("pub use ");
    let is_one = CONTENTS.iter().any(|start| statement.starts_with(start));
    is_one && !is_inline_module
}

/// The first line of every statement, with its number; comments and attributes are none.
fn statements(text: &str) -> Vec<(usize, &str)> {
    let mut statements = Vec::new();
    let mut is_open = false;
    for (index, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or("").trim();
        if code.is_empty() {
            continue;
        }
        if !is_open && !code.starts_with('#') {
            statements.push((index + 1, code));
        }
        // A statement ends in `;` or `}`, an attribute in `]`; rustfmt gives each its own lines.
        is_open = !code.ends_with([';', '}', ']']);
    }
    statements
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<Option<usize>> {
        let found = hold_no_code(&Tree::of(&[("kernel/src/lib.rs", text)]));
        found.into_iter().map(|v| v.line).collect()
    }

    #[test]
    fn a_table_of_contents_is_tidy() {
        let text = "//! Doc.\n#![doc = include_str!(\"../README.md\")]\n\n/// Doc.\npub mod a;\n#[cfg(\n    test\n)]\nmod b;\n\
                    pub use a::{\n    C, // why\n    D,\n};\npub use b::E;\n";
        assert_eq!(lines(text), []);
    }

    #[test]
    fn code_is_found_where_it_begins() {
        assert_eq!(
            lines("//! Doc.\nmod a;\n\npub fn b() -> f64 {\n    1.0\n}\nmod c;\n"),
            [Some(4)]
        );
        assert_eq!(lines("//! Doc.\npub const A: f64 = 1.0;\n"), [Some(2)]);
        assert_eq!(lines("//! Doc.\n#[cfg(test)]\nmod tests {\n}\n"), [Some(3)]);
        assert_eq!(lines("//! Doc.\nuse std::fmt;\n"), [Some(2)]);
    }
}
