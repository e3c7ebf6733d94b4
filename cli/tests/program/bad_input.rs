//! Bad input: exit code 2, exactly one diagnosis that names key, line, found and wanted, and nothing written.

use crate::runner::{CASE, TestFolder};

/// What the one diagnosis of a wrong case must name.
struct Names<'a> {
    key: &'a str,
    line: usize,
    found: &'a str,
    wanted: &'a str,
}

/// Runs the case with one text replaced by another.
fn refuses(from: &str, to: &str, names: &Names<'_>) {
    assert_eq!(
        CASE.matches(from).count(),
        1,
        "{from} must stand once in the case"
    );
    refuses_case(CASE.replace(from, to).as_bytes(), names);
}

fn refuses_case(text: &[u8], names: &Names<'_>) {
    for command in ["run", "check"] {
        let folder = TestFolder::with_case(text);
        let ran = folder.run(&[command, "case.toml"]);
        assert_eq!(ran.code, Some(2), "{}", ran.stderr);
        assert_eq!(ran.stdout, "");
        assert_one_diagnosis(&ran.stderr, names);
        assert_eq!(folder.names(), ["case.toml"], "nothing may be written");
    }
}

fn assert_one_diagnosis(stderr: &str, names: &Names<'_>) {
    let sentences: Vec<_> = stderr
        .lines()
        .filter(|line| line.contains("wanted") || line.contains("must"))
        .collect();
    let [sentence] = sentences[..] else {
        panic!("not one diagnosis: {stderr}")
    };
    let Names {
        key,
        line,
        found,
        wanted,
    } = names;
    assert!(
        sentence.contains(&format!("case.toml, line {line}")),
        "line {line} in: {stderr}"
    );
    assert!(sentence.contains(key), "{key} in: {stderr}");
    assert!(
        sentence.contains(&format!("found {found}")),
        "found {found} in: {stderr}"
    );
    assert!(sentence.contains(wanted), "{wanted} in: {stderr}");
    assert!(!stderr.contains("panicked"), "{stderr}");
}

#[test]
fn an_unknown_key_is_refused_and_the_right_one_suggested() {
    let names = Names {
        key: "`indenter.raduis`",
        line: 19,
        found: "an unknown key",
        wanted: "wanted one of kind, radius",
    };
    refuses("radius = \"4 um\"", "raduis = \"4 um\"", &names);
    let folder = TestFolder::with_case(CASE.replace("radius = \"4 um\"", "raduis = \"4 um\""));
    assert!(
        folder
            .run(&["run", "case.toml"])
            .stderr
            .contains("did you mean `radius`?")
    );
}

#[test]
fn a_layer_without_thickness_is_refused_at_its_header() {
    let names = Names {
        key: "`foundation.layer[0].thickness`",
        line: 6,
        found: "no such key",
        wanted: "wanted a positive length such as \"5 nm\"",
    };
    refuses("thickness = \"10 nm\"\n", "", &names);
}

#[test]
fn poissons_ratio_beyond_one_half_is_refused() {
    let names = Names {
        key: "`foundation.layer[0].poisson_ratio`",
        line: 9,
        found: "0.6",
        wanted: "[0, 0.5]",
    };
    refuses("poisson_ratio = 0.3", "poisson_ratio = 0.6", &names);
}

#[test]
fn a_negative_force_is_refused() {
    let names = Names {
        key: "`load.force`",
        line: 22,
        found: "\"-1 uN\"",
        wanted: "wanted a positive force such as \"2.3 mN\"",
    };
    refuses("force = \"1 uN\"", "force = \"-1 uN\"", &names);
}

#[test]
fn a_unit_of_the_wrong_kind_is_refused() {
    let names = Names {
        key: "`foundation.layer[0].young_modulus`",
        line: 8,
        found: "\"5 nm\" (a length)",
        wanted: "wanted a positive pressure such as \"70 GPa\"",
    };
    refuses("\"70 GPa\"", "\"5 nm\"", &names);
}

#[test]
fn overlapping_cylinders_are_refused() {
    let names = Names {
        key: "`surface.radius`",
        line: 13,
        found: "\"26 nm\"",
        wanted: "at most half the period",
    };
    refuses("radius = \"20 nm\"", "radius = \"26 nm\"", &names);
}

#[test]
fn a_file_that_is_not_toml_is_refused_where_it_breaks() {
    let names = Names {
        key: "",
        line: 3,
        found: "",
        wanted: "wanted TOML",
    };
    refuses("[foundation]", "[foundation", &names);
}

#[test]
fn an_empty_file_is_refused() {
    let names = Names {
        key: "",
        line: 1,
        found: "an empty file",
        wanted: "wanted a case: [foundation], [indenter] and [load]",
    };
    refuses_case(b"", &names);
}

#[test]
fn a_file_that_is_not_utf8_is_refused() {
    let names = Names {
        key: "",
        line: 2,
        found: "the byte 0xff",
        wanted: "wanted TOML in UTF-8",
    };
    refuses_case(b"title = \"a\"\nb = \"\xff\"\n", &names);
}

#[test]
fn nan_is_refused() {
    let names = Names {
        key: "`indenter.radius`",
        line: 19,
        found: "nan",
        wanted: "wanted a positive length",
    };
    refuses("radius = \"4 um\"", "radius = nan", &names);
}

#[test]
fn a_grid_of_no_elements_or_of_a_thousand_million_is_refused() {
    for elements in ["0", "1_000_000_000", "1e9"] {
        let names = Names {
            key: "`grid.elements`",
            line: 26,
            found: elements,
            wanted: "wanted an integer from 1 to 8192 per side",
        };
        refuses("elements = 32", &format!("elements = {elements}"), &names);
    }
}

#[test]
fn force_and_penetration_together_are_refused() {
    let names = Names {
        key: "`load.penetration`",
        line: 23,
        found: "force and penetration",
        wanted: "wanted exactly one of",
    };
    refuses(
        "force = \"1 uN\"",
        "force = \"1 uN\"\npenetration = \"1 nm\"",
        &names,
    );
}

#[test]
fn a_value_of_the_wrong_type_is_refused() {
    let names = Names {
        key: "`indenter`",
        line: 1,
        found: "3",
        wanted: "wanted a table",
    };
    let without = CASE.replace("[indenter]\nkind = \"paraboloid\"\nradius = \"4 um\"\n", "");
    refuses_case(format!("indenter = 3\n{without}").as_bytes(), &names);
}

#[test]
fn a_map_that_cannot_be_read_is_refused_with_one_sentence() {
    let names = Names {
        key: "`indenter.file`",
        line: 19,
        found: "\"tip.gsf\", which cannot be read: No such file",
        wanted: "wanted a height map (.npy, .csv, .txt or .gsf)",
    };
    let map = "kind = \"map\"\nfile = \"tip.gsf\"";
    refuses("kind = \"paraboloid\"\nradius = \"4 um\"", map, &names);
}

#[test]
fn a_file_that_is_not_there_and_a_folder_are_refused() {
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
fn a_wrong_value_on_the_command_line_is_diagnosed_there() {
    let folder = TestFolder::with_case(CASE);
    for set in [
        "load.force=-1",
        "load.force",
        "load.froce=1",
        "grid.elements.x=1",
        "=",
        "foundation.layer.7.thickness=1",
    ] {
        let ran = folder.run(&["run", "case.toml", "--set", set]);
        assert_eq!(ran.code, Some(2), "{set}");
        assert!(
            ran.stderr.contains("--set") && ran.stderr.contains("wanted"),
            "{}",
            ran.stderr
        );
    }
    assert_eq!(folder.names(), ["case.toml"]);
}

#[test]
fn a_wrong_command_line_exits_with_2() {
    let folder = TestFolder::with_case(CASE);
    for line in [
        &["walk"][..],
        &["run"],
        &["run", "case.toml", "--threads", "0"],
        &["kernel", "case.toml"],
        &["kernel", "case.toml", "--wavenumber", "0"],
        &["kernel", "case.toml", "--wavenumber", "nan"],
        &["influence", "case.toml", "--offset", "1"],
        &["influence", "case.toml", "--offset", "a,b"],
        &["plot", "nowhere"],
    ] {
        let ran = folder.run(line);
        assert_eq!(ran.code, Some(2), "{line:?}: {}", ran.stderr);
        assert_eq!(ran.stdout, "", "{line:?}");
    }
}

#[test]
fn sizes_beyond_all_arithmetic_are_refused_at_once() {
    for (found, wanted) in [
        ("1e307", "wanted a length between 1e-30 and 1e30 m"),
        ("1e-308", "wanted a length between 1e-30 and 1e30 m"),
        ("\"1e300 nm\"", "wanted a length between 1e-30 and 1e30 m"),
    ] {
        let names = Names {
            key: "`foundation.layer[0].thickness`",
            line: 7,
            found,
            wanted,
        };
        let to = format!("thickness = {found}\n");
        refuses("thickness = \"10 nm\"\n", &to, &names);
    }
}

#[test]
fn a_needle_that_no_picture_can_show_is_refused() {
    let names = Names {
        key: "`indenter.half_angle`",
        line: 19,
        found: "1e-8",
        wanted: "wanted an angle from the axis between 0 and 90 degrees (0.1 to 89.9999)",
    };
    let cone = "kind = \"cone\"\nhalf_angle = 1e-8";
    refuses("kind = \"paraboloid\"\nradius = \"4 um\"", cone, &names);
}

#[test]
fn a_punch_that_misses_every_element_is_told_at_the_key_of_the_side() {
    let punch = "kind = \"flat-punch\"\nradius = \"1 nm\"";
    let folder =
        TestFolder::with_case(CASE.replace("kind = \"paraboloid\"\nradius = \"4 um\"", punch));
    let ran = folder.run(&["run", "case.toml", "--json"]);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    let sentence = "key `grid.side`: found \"400 nm\": ";
    assert!(ran.stderr.contains(sentence), "{}", ran.stderr);
    assert!(ran.stderr.contains("far too large"), "{}", ran.stderr);
}

#[test]
fn a_case_with_a_byte_order_mark_is_read() {
    let folder = TestFolder::with_case(format!("\u{feff}{CASE}"));
    let checked = folder.run(&["check", "case.toml"]);
    assert_eq!(checked.code, Some(0), "{}", checked.stderr);
    // Places are those of what the editor shows.
    let folder = TestFolder::with_case(format!("\u{feff}{}", CASE.replace("title", "titel")));
    let message = folder.run(&["check", "case.toml"]).stderr;
    assert!(
        message.contains("case.toml, line 1, key `titel`"),
        "{message}"
    );
}

#[test]
fn a_bare_number_among_units_is_warned_of_with_its_line() {
    let folder = TestFolder::with_case(CASE.replace("thickness = \"10 nm\"", "thickness = 10e-9"));
    let sentence = "case.toml, line 7, key `foundation.layer[0].thickness`: 10e-9 among values with units is 10e-9 m";
    let checked = folder.run(&["check", "case.toml"]);
    assert!(checked.stderr.contains(sentence), "{}", checked.stderr);
    let ran = folder.run(&["run", "case.toml", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary: serde_json::Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(summary["warnings"][0]["code"], "bare-number");
    // With no unit anywhere a bare number is what it is.
    let checked = folder.run(&["check", "case.toml"]).stdout;
    let resolved = TestFolder::with_case(checked).run(&["check", "case.toml"]);
    assert!(
        !resolved.stderr.contains("among values with units"),
        "{}",
        resolved.stderr
    );
}

#[test]
fn a_load_set_beside_another_says_what_to_write() {
    let curve = CASE.replace("force = \"1 uN\"", "forces = [\"1 uN\", \"2 uN\"]");
    let folder = TestFolder::with_case(curve);
    let ran = folder.run(&["run", "case.toml", "--set", "load.force=3 uN"]);
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.stderr.contains("found force and forces"),
        "{}",
        ran.stderr
    );
    let hint = "--set load='{ force = \"3 mN\" }'";
    assert!(ran.stderr.contains(hint), "{}", ran.stderr);
}

#[test]
fn an_unknown_unit_comes_with_the_known_ones() {
    let folder = TestFolder::with_case(CASE.replace("\"4 um\"", "\"4 micros\""));
    let message = folder.run(&["check", "case.toml"]).stderr;
    assert!(message.contains("the unknown unit `micros`"), "{message}");
    assert!(
        message.contains("units of a length: m, km, cm, mm, um"),
        "{message}"
    );
    let folder = TestFolder::with_case(CASE.replace("\"4 um\"", "\"4,5 um\""));
    let message = folder.run(&["check", "case.toml"]).stderr;
    assert!(message.contains("the decimal mark is a point"), "{message}");
}

#[test]
fn a_list_of_a_study_refuses_what_the_study_refuses() {
    let study = format!("{CASE}\n[study.vary]\n\"indenter.radius\" = [\"-1 um\"]\n");
    let folder = TestFolder::with_case(study);
    let [listed, solved] = [
        &["study", "case.toml", "--list"][..],
        &["study", "case.toml"],
    ]
    .map(|line| folder.run(line));
    assert_eq!((listed.code, solved.code), (Some(2), Some(2)));
    assert_eq!(listed.stderr, solved.stderr);
    assert!(listed.stdout.is_empty());
}

#[test]
fn what_a_terminal_would_obey_never_reaches_it() {
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
