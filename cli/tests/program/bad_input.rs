//! Bad input: exit code 2, exactly one diagnosis that names key, line, found and wanted, and nothing written.

use crate::runner::{CASE, Folder};

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
        let folder = Folder::with_case(text);
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
    let folder = Folder::with_case(CASE.replace("radius = \"4 um\"", "raduis = \"4 um\""));
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
    let folder = Folder::new();
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
    let folder = Folder::with_case(CASE);
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
    let folder = Folder::with_case(CASE);
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
