//! Wrong values in a case: exit code 2, exactly one diagnosis that names key, line, found and wanted, nothing written.

use super::runner::{CASE, TestFolder};

/// The parts that the one diagnosis of a wrong case must name.
pub struct Expected<'a> {
    pub key: &'a str,
    pub line: usize,
    pub found: &'a str,
    pub wanted: &'a str,
}

/// Runs the case with one text replaced by another.
pub fn refuses(from: &str, to: &str, expected: &Expected<'_>) {
    assert_eq!(
        CASE.matches(from).count(),
        1,
        "{from} must stand once in the case"
    );
    refuses_case(CASE.replace(from, to).as_bytes(), expected);
}

pub fn refuses_case(text: &[u8], expected: &Expected<'_>) {
    for command in ["run", "check"] {
        let folder = TestFolder::with_case(text);
        let ran = folder.run(&[command, "case.toml"]);
        assert_eq!(ran.code, Some(2), "{}", ran.stderr);
        assert_eq!(ran.stdout, "");
        assert_one_diagnosis(&ran.stderr, expected);
        assert_eq!(folder.names(), ["case.toml"], "nothing may be written");
    }
}

fn assert_one_diagnosis(stderr: &str, expected: &Expected<'_>) {
    let sentences: Vec<_> = stderr
        .lines()
        .filter(|line| line.contains("wanted") || line.contains("must"))
        .collect();
    let [sentence] = sentences[..] else {
        panic!("not one diagnosis: {stderr}")
    };
    let Expected {
        key,
        line,
        found,
        wanted,
    } = expected;
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
fn an_unknown_key_is_rejected_and_the_right_one_suggested() {
    let expected = Expected {
        key: "`indenter.raduis`",
        line: 19,
        found: "an unknown key",
        wanted: "wanted one of kind, radius",
    };
    refuses("radius = \"4 um\"", "raduis = \"4 um\"", &expected);
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
    let expected = Expected {
        key: "`foundation.layer[0].thickness`",
        line: 6,
        found: "no such key",
        wanted: "wanted a positive length such as \"5 nm\"",
    };
    refuses("thickness = \"10 nm\"\n", "", &expected);
}

#[test]
fn poissons_ratio_beyond_one_half_is_refused() {
    let expected = Expected {
        key: "`foundation.layer[0].poisson_ratio`",
        line: 9,
        found: "0.6",
        wanted: "[0, 0.5]",
    };
    refuses("poisson_ratio = 0.3", "poisson_ratio = 0.6", &expected);
}

#[test]
fn a_negative_force_is_refused() {
    let expected = Expected {
        key: "`load.force`",
        line: 22,
        found: "\"-1 uN\"",
        wanted: "wanted a positive force such as \"2.3 mN\"",
    };
    refuses("force = \"1 uN\"", "force = \"-1 uN\"", &expected);
}

#[test]
fn a_unit_of_the_wrong_kind_is_refused() {
    let expected = Expected {
        key: "`foundation.layer[0].young_modulus`",
        line: 8,
        found: "\"5 nm\" (a length)",
        wanted: "wanted a positive pressure such as \"70 GPa\"",
    };
    refuses("\"70 GPa\"", "\"5 nm\"", &expected);
}

#[test]
fn overlapping_cylinders_are_refused() {
    let expected = Expected {
        key: "`surface.radius`",
        line: 13,
        found: "2.6e-8 for the radius of overlapping circles",
        wanted: "at most half the period",
    };
    refuses("radius = \"20 nm\"", "radius = \"26 nm\"", &expected);
}

#[test]
fn nan_is_refused() {
    let expected = Expected {
        key: "`indenter.radius`",
        line: 19,
        found: "nan",
        wanted: "wanted a positive length",
    };
    refuses("radius = \"4 um\"", "radius = nan", &expected);
}

#[test]
fn a_grid_of_zero_or_a_thousand_million_elements_is_rejected() {
    for elements in ["0", "1_000_000_000", "1e9"] {
        let expected = Expected {
            key: "`grid.elements`",
            line: 26,
            found: elements,
            wanted: "wanted an integer from 1 to 16384 per side",
        };
        refuses(
            "elements = 32",
            &format!("elements = {elements}"),
            &expected,
        );
    }
}

#[test]
fn force_and_penetration_together_are_refused() {
    let expected = Expected {
        key: "`load.penetration`",
        line: 23,
        found: "force and penetration",
        wanted: "wanted exactly one of",
    };
    refuses(
        "force = \"1 uN\"",
        "force = \"1 uN\"\npenetration = \"1 nm\"",
        &expected,
    );
}

#[test]
fn a_value_of_the_wrong_type_is_refused() {
    let expected = Expected {
        key: "`indenter`",
        line: 1,
        found: "3",
        wanted: "wanted a table",
    };
    let without = CASE.replace("[indenter]\nkind = \"paraboloid\"\nradius = \"4 um\"\n", "");
    refuses_case(format!("indenter = 3\n{without}").as_bytes(), &expected);
}

#[test]
fn an_unreadable_map_is_rejected_in_one_sentence() {
    let expected = Expected {
        key: "`indenter.file`",
        line: 19,
        found: "\"tip.gsf\", which cannot be read: No such file",
        wanted: "wanted a height map (.npy, .csv, .txt, .asc or .gsf)",
    };
    let map = "kind = \"map\"\nfile = \"tip.gsf\"";
    refuses("kind = \"paraboloid\"\nradius = \"4 um\"", map, &expected);
}

#[test]
fn absurd_sizes_are_rejected_at_once() {
    for (found, wanted) in [
        ("1e307", "wanted a length between 1e-30 and 1e30 m"),
        ("1e-308", "wanted a length between 1e-30 and 1e30 m"),
        ("\"1e300 nm\"", "wanted a length between 1e-30 and 1e30 m"),
    ] {
        let expected = Expected {
            key: "`foundation.layer[0].thickness`",
            line: 7,
            found,
            wanted,
        };
        let to = format!("thickness = {found}\n");
        refuses("thickness = \"10 nm\"\n", &to, &expected);
    }
}

#[test]
fn a_needle_too_sharp_to_draw_is_rejected() {
    let expected = Expected {
        key: "`indenter.half_angle`",
        line: 19,
        found: "1e-8",
        wanted: "wanted an angle from the axis between 0 and 90 degrees (0.1 to 89.9999)",
    };
    let cone = "kind = \"cone\"\nhalf_angle = 1e-8";
    refuses("kind = \"paraboloid\"\nradius = \"4 um\"", cone, &expected);
}

#[test]
fn a_punch_that_misses_every_element_is_reported_at_the_key_of_the_side() {
    let punch = "kind = \"flat-punch\"\nradius = \"1 nm\"";
    let folder =
        TestFolder::with_case(CASE.replace("kind = \"paraboloid\"\nradius = \"4 um\"", punch));
    let ran = folder.run(&["run", "case.toml", "--json"]);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    let sentence = "key `grid.side`: found a domain of side 4.000e-7";
    assert!(ran.stderr.contains(sentence), "{}", ran.stderr);
    assert!(ran.stderr.contains("far too large"), "{}", ran.stderr);
}

#[test]
fn a_bare_number_among_units_is_warned_of_with_its_line() {
    let folder = TestFolder::with_case(CASE.replace("thickness = \"10 nm\"", "thickness = 10e-9"));
    let sentence = "case.toml, line 7, key `foundation.layer[0].thickness`: 10e-9 among values with units is 10e-9 m";
    let checked = folder.run(&["check", "case.toml"]);
    assert!(checked.stderr.contains(sentence), "{}", checked.stderr);
    let summary = folder.run(&["run", "case.toml", "--json"]).json();
    assert_eq!(summary["warnings"][0]["code"], "bare-number");
    // Without any units, a bare number needs no warning.
    let checked = folder.run(&["check", "case.toml"]).stdout;
    let resolved = TestFolder::with_case(checked).run(&["check", "case.toml"]);
    assert!(
        !resolved.stderr.contains("among values with units"),
        "{}",
        resolved.stderr
    );
}

#[test]
fn an_unknown_unit_is_rejected_with_the_list_of_known_units() {
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
fn an_invalid_strength_is_rejected_at_its_key() {
    for (found, wanted) in [
        ("\"-1 GPa\"", "wanted a positive pressure such as"),
        ("0", "wanted a positive pressure such as"),
        ("\"6\" (a number without a unit)", "or a bare number"),
        ("\"6 nm\" (a length)", "wanted a positive pressure such as"),
    ] {
        for key in ["yield_strength", "interface_shear_strength"] {
            let value = found.split(" (").next().unwrap();
            let expected = Expected {
                key: &format!("`foundation.layer[0].{key}`"),
                line: 10,
                found,
                wanted,
            };
            let with = format!("poisson_ratio = 0.3\n{key} = {value}");
            refuses("poisson_ratio = 0.3", &with, &expected);
        }
    }
}

#[test]
fn a_strength_without_a_unit_among_units_is_warned_of() {
    let strength = "poisson_ratio = 0.3\ntensile_strength = 2e9";
    let folder = TestFolder::with_case(CASE.replace("poisson_ratio = 0.3", strength));
    let checked = folder.run(&["check", "case.toml"]).stderr;
    let sentence = "line 10, key `foundation.layer[0].tensile_strength`: 2e9 among values with units is 2e9 Pa";
    assert!(checked.contains(sentence), "{checked}");
    assert!(
        checked.contains("add a table [stress] to compute stresses"),
        "{checked}"
    );
}

/// The case with a table of stresses that has this line.
fn with_stress(line: &str) -> String {
    format!("{CASE}\n[stress]\n{line}\n")
}

#[test]
fn invalid_stress_requests_are_rejected_at_their_key() {
    for (key, found, wanted) in [
        (
            "friction",
            "-0.1",
            "wanted a coefficient of friction, a number from 0 to 10",
        ),
        ("friction", "11", "a number from 0 to 10"),
        (
            "depths",
            "[\"-1 nm\"]",
            "wanted a depth of zero or more: the surface is at 0",
        ),
        (
            "extent",
            "\"401 nm\"",
            "wanted at most the side of the domain",
        ),
    ] {
        let expected = Expected {
            key: &format!("`stress.{key}"),
            line: 29,
            found: found.trim_start_matches('[').trim_end_matches(']'),
            wanted,
        };
        refuses_case(
            with_stress(&format!("{key} = {found}")).as_bytes(),
            &expected,
        );
    }
    let rigid = with_stress("depths = [0, \"11 nm\"]").replace(
        "{ young_modulus = \"7 GPa\", poisson_ratio = 0.4 }",
        "\"rigid\"",
    );
    let expected = Expected {
        key: "`stress.depths[1]`",
        line: 29,
        found: "\"11 nm\"",
        wanted: "the depth of the rigid base",
    };
    refuses_case(rigid.as_bytes(), &expected);
}

#[test]
fn an_extent_beyond_the_chosen_domain_is_rejected_before_anything_is_solved() {
    let text = with_stress("extent = \"40 um\"").replace("side = \"400 nm\"\n", "");
    let expected = Expected {
        key: "`stress.extent`",
        line: 28,
        found: "\"40 um\"",
        wanted: "chosen from the load",
    };
    refuses_case(text.as_bytes(), &expected);
}

#[test]
fn friction_above_a_frictionless_interface_is_warned_of_with_the_reason() {
    let slides = "poisson_ratio = 0.3\ninterface = \"frictionless\"";
    let text = with_stress("friction = 0.1").replace("poisson_ratio = 0.3", slides);
    let folder = TestFolder::with_case(text);
    let checked = folder.run(&["check", "case.toml"]);
    assert_eq!(checked.code, Some(0), "{}", checked.stderr);
    let sentence =
        "the interface below layer 0 is frictionless and cannot carry the force of friction";
    assert!(checked.stderr.contains(sentence), "{}", checked.stderr);
    let still = folder.run(&["check", "case.toml", "--set", "stress.friction=0"]);
    assert!(!still.stderr.contains("frictionless"), "{}", still.stderr);
}
