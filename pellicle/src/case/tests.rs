//! Cases read from text, and read again after being written.

use super::*;

fn read(text: &str, sets: &[&str]) -> Result<Case, Diagnosis> {
    let sets: Vec<_> = sets.iter().map(|&set| set.to_owned()).collect();
    Case::parse(
        &Arc::new(Source::new("case.toml", text.to_owned())),
        "case",
        Path::new(""),
        &sets,
    )
}

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = "7 GPa", poisson_ratio = 0.4 }

[[foundation.layer]]
thickness = "10 nm"
young_modulus = "70 GPa"
poisson_ratio = 0.3

[surface]
kind = "cylinders"
radius = "5 nm"
height = "2 nm"
period = "20 nm"

[indenter]
kind = "cone"
half_angle = "70 deg"
tip_radius = "400 nm"

[load]
forces = { from = "1 uN", to = "1 mN", count = 4, spacing = "log" }
"#;

/// Checks that a written case is again a case file.
fn check_written(case: &Case) {
    let written = toml::to_string(case).unwrap();
    let again = read(&written, &[]).unwrap();
    // The numbers are the same; the units in which they were written are lost.
    let again = Case {
        units: case.units,
        ..again
    };
    assert_eq!(&again, case);
}

#[test]
fn the_resolved_case_is_a_valid_case_file() {
    let case = read(CASE, &[]).unwrap();
    check_written(&case);
}

#[test]
fn the_resolved_case_includes_strengths_and_stresses() {
    let layer = "yield_strength = \"2 GPa\"\ntensile_strength = \"1 GPa\"\ninterface_shear_strength = \"0.4 GPa\"\n\
        interface_tensile_strength = \"0.3 GPa\"\n[surface]";
    let substrate = "poisson_ratio = 0.4, yield_strength = \"0.2 GPa\", tensile_strength = 1e8 }";
    let grading = "{ from = \"70 GPa\", to = \"50 GPa\", profile = \"linear\" }";
    let stress = "\n[stress]\ndepths = [\"5 nm\", 0]\nextent = \"9 um\"\nfriction = 0.3\ndirection = \"30 deg\"\n";
    let text = CASE
        .replace("[surface]", layer)
        .replace("poisson_ratio = 0.4 }", substrate)
        + stress;
    let case = read(&text.replace("\"70 GPa\"", grading), &[]).unwrap();
    check_written(&case);
    let strengths = serde_json::to_value(&case.foundation).unwrap();
    for (place, strength) in [
        ("/layer/0/yield_strength", 2e9),
        ("/layer/0/tensile_strength", 1e9),
        ("/layer/0/interface_shear_strength", 0.4e9),
        ("/layer/0/interface_tensile_strength", 0.3e9),
        ("/substrate/yield_strength", 0.2e9),
        ("/substrate/tensile_strength", 1e8),
    ] {
        assert_eq!(strengths.pointer(place).unwrap(), strength, "{place}");
    }
    assert_eq!(case.stress.unwrap().depths.unwrap(), [0.0, 5e-9]);
    // Values that are not given are not written; an empty table of stresses is.
    let plain = toml::to_string(&read(&format!("{CASE}\n[stress]"), &[]).unwrap()).unwrap();
    assert!(
        !plain.contains("strength") && plain.contains("[stress]"),
        "{plain}"
    );
}

#[test]
fn a_value_set_on_the_command_line_replaces_that_of_the_file() {
    let case = read(
        CASE,
        &["foundation.layer.0.thickness=3 um", "grid.elements=64"],
    )
    .unwrap();
    assert_eq!(case.foundation.layer[0].thickness, 3e-6);
    assert_eq!(case.grid.elements, 64);
}

#[test]
fn an_invalid_value_on_the_command_line_is_reported_there() {
    let message = read(CASE, &["foundation.layer.0.poisson_ratio=0.6"])
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("--set, key `foundation.layer[0].poisson_ratio`: found 0.6"),
        "{message}"
    );
}

#[test]
fn a_misspelt_table_is_reported_before_the_missing_one() {
    let diagnosis = read(&CASE.replace("[load]", "[laod]"), &[]).unwrap_err();
    assert_eq!(diagnosis.key.as_deref(), Some("laod"));
    assert_eq!(diagnosis.help.as_deref(), Some("did you mean `load`?"));
}

#[test]
fn a_missing_table_is_reported_at_the_end() {
    let text = CASE.replace("[load]", "").replace("forces =", "# forces =");
    let message = read(&text, &[]).unwrap_err().to_string();
    assert!(
        message.contains("key `load`: found no such key, wanted a table [load]"),
        "{message}"
    );
}

#[test]
fn a_value_in_place_of_a_table_is_answered_with_its_key() {
    let found = read(CASE, &["load=200 mN"]).unwrap_err().to_string();
    assert!(
        found.contains("wanted a table, such as { force = \"200 mN\" }"),
        "{found}"
    );
}
