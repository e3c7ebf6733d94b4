//! Odd values of single keys: one sentence each with the key, the value found and the one wanted.

use super::runner::{CASE, TestFolder};

/// A text of the case, its replacement, and the key, the value found and the value wanted as named in the message.
const ODD: [(&str, &str, &str, &str, &str); 16] = [
    (
        "title = \"Test\"",
        "title = 3",
        "`title`",
        "found 3",
        "wanted a string",
    ),
    (
        "\"400 nm\"",
        "[\"400 nm\", \"400 nm\"]",
        "`grid.side`",
        "found [",
        "wanted a positive length",
    ),
    (
        "elements = 32",
        "elements = 32.0",
        "`grid.elements`",
        "found 32.0",
        "wanted an integer from 1",
    ),
    (
        "elements = 32",
        "elements = \"32\"",
        "`grid.elements`",
        "found \"32\"",
        "wanted an integer from 1",
    ),
    (
        "poisson_ratio = 0.3\n",
        "poisson_ratio = \"0.3\"\n",
        "`foundation.layer[0].poisson_ratio`",
        "found \"0.3\"",
        "a number in [0, 0.5]",
    ),
    ("[load]", "[[load]]", "`load`", "found", "wanted a table"),
    (
        "\"1 uN\"",
        "\"1 uN uN\"",
        "`load.force`",
        "unknown unit `uN uN`",
        "wanted a positive force",
    ),
    (
        "\"1 uN\"",
        "\"1e400 uN\"",
        "`load.force`",
        "found \"1e400 uN\"",
        "wanted a positive force",
    ),
    (
        "\"1 uN\"",
        "1979-05-27",
        "`load.force`",
        "found 1979-05-27",
        "wanted a positive force",
    ),
    (
        "force = \"1 uN\"",
        "forces = { from = \"1 uN\", to = \"2 uN\", count = 1_000_000 }",
        "`load.forces.count`",
        "found 1_000_000",
        "wanted an integer from 2 to 10000",
    ),
    (
        "period = \"50 nm\"",
        "period = \"50 nm\"\noffset = [\"1 nm\"]",
        "`surface.offset`",
        "found [\"1 nm\"]",
        "wanted a list of two lengths",
    ),
    (
        "radius = \"4 um\"",
        "radius = \"4 um\"\nhalf_angle = 1",
        "`indenter.half_angle`",
        "found an unknown key",
        "wanted one of kind, radius",
    ),
    (
        "radius = \"4 um\"",
        "radius = \"+-4 um\"",
        "`indenter.radius`",
        "(no number)",
        "wanted a positive length",
    ),
    (
        "side = \"400 nm\"",
        "side = 1e31",
        "`grid.side`",
        "found 1e31",
        "wanted a length between",
    ),
    (
        "kind = \"paraboloid\"\nradius = \"4 um\"",
        "kind = \"map\"\nfile = \".csv\"",
        "`indenter.file`",
        "found \".csv\"",
        "wanted a height map",
    ),
    (
        "kind = \"paraboloid\"\nradius = \"4 um\"",
        "kind = \"map\"\nfile = \"..\"",
        "`indenter.file`",
        "found \"..\"",
        "wanted a height map",
    ),
];

#[test]
fn each_of_a_dozen_odd_values_is_rejected_in_one_sentence_with_key_found_and_wanted() {
    for (from, to, key, found, wanted) in ODD {
        assert_eq!(CASE.matches(from).count(), 1, "{from}");
        let ran = TestFolder::with_case(CASE.replace(from, to)).run(&["check", "case.toml"]);
        assert_eq!(ran.code, Some(2), "{to}: {}", ran.stderr);
        let sentence = ran
            .stderr
            .lines()
            .find(|line| line.contains("case.toml, line"));
        let sentence = sentence.unwrap_or_else(|| panic!("{to}: {}", ran.stderr));
        for part in [key, found, wanted] {
            assert!(sentence.contains(part), "{part} in: {}", ran.stderr);
        }
        assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
    }
}
