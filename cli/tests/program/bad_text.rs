//! Case files that are not text, not TOML or not a case, or that contain terminal control characters.

use super::bad_input::{Expected, refuses, refuses_case};
use super::runner::{CASE, TestFolder};

#[test]
fn a_file_that_is_not_toml_is_rejected_at_its_position() {
    let expected = Expected {
        key: "",
        line: 3,
        found: "",
        wanted: "wanted TOML",
    };
    refuses("[foundation]", "[foundation", &expected);
}

#[test]
fn an_empty_file_is_refused() {
    let expected = Expected {
        key: "",
        line: 1,
        found: "an empty file",
        wanted: "wanted a case: [foundation], [indenter] and [load]",
    };
    refuses_case(b"", &expected);
}

#[test]
fn a_file_that_is_not_utf8_is_refused() {
    let expected = Expected {
        key: "",
        line: 2,
        found: "the byte 0xff",
        wanted: "wanted TOML in UTF-8",
    };
    refuses_case(b"title = \"a\"\nb = \"\xff\"\n", &expected);
}

#[test]
fn a_missing_file_and_a_folder_are_rejected() {
    let folder = TestFolder::new();
    for (path, reason) in [("none.toml", "No such file"), (".", "directory")] {
        let ran = folder.run(&["run", path]);
        assert_eq!(ran.code, Some(2));
        assert_eq!(ran.stderr.lines().count(), 1, "{}", ran.stderr);
        assert!(
            ran.stderr.contains(path) && ran.stderr.contains(reason),
            "{}",
            ran.stderr
        );
    }
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn a_case_with_a_byte_order_mark_is_read() {
    let folder = TestFolder::with_case(format!("\u{feff}{CASE}"));
    let checked = folder.run(&["check", "case.toml"]);
    assert_eq!(checked.code, Some(0), "{}", checked.stderr);
    // Positions are those that the editor shows.
    let folder = TestFolder::with_case(format!("\u{feff}{}", CASE.replace("title", "titel")));
    let message = folder.run(&["check", "case.toml"]).stderr;
    assert!(
        message.contains("case.toml, line 1, key `titel`"),
        "{message}"
    );
}

#[test]
fn control_sequences_never_reach_the_terminal() {
    let texts = [
        CASE.replace(
            "title = \"Test\"",
            "title = \"\\u001b[31mred\\u009b1m\\u0007\"",
        )
        .into_bytes(),
        CASE.replace("title =", "\"\\u001b[31mtitle\" =")
            .into_bytes(),
        CASE.replace("[load]", "\u{1b}[31m[load]\u{9b}")
            .into_bytes(),
        CASE.replace("\"1 uN\"", "\"1 \\u001b[2J\"").into_bytes(),
        CASE.replace(
            "kind = \"paraboloid\"",
            "kind = \"map\"\nfile = \"\\u001b[31m.csv\"",
        )
        .into_bytes(),
    ];
    for text in texts {
        let folder = TestFolder::with_case(&text);
        for line in [&["check", "case.toml"][..], &["run", "case.toml"]] {
            let ran = folder.run(line);
            let obeyed = |c: char| c.is_control() && c != '\n' && c != '\t';
            let shown = ran.stdout + &ran.stderr;
            assert!(!shown.contains(obeyed), "{line:?}: {shown:?}");
        }
    }
    let folder = TestFolder::with_case(CASE);
    let set = folder.run(&["check", "case.toml", "--set", "load.force=\u{1b}[31m"]);
    assert!(!set.stderr.contains('\u{1b}'), "{:?}", set.stderr);
}
