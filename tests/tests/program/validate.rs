//! `pellicle validate` passes, and fails with slightly wrong coefficients.

use serde_json::Value;

use super::{Ran, run};

fn validate(arguments: &[&str]) -> Ran {
    run("", &[&["validate"], arguments].concat())
}

/// The number of failing rows by section.
fn failures(report: &Value) -> Vec<(String, usize, usize)> {
    let sections = report["sections"].as_array().unwrap();
    let count = |section: &Value| {
        let rows = section["rows"].as_array().unwrap();
        let failed = rows.iter().filter(|row| row["verdict"] == "fail").count();
        let name = section["name"].as_str().unwrap().to_owned();
        (name, failed, rows.len())
    };
    sections.iter().map(count).collect()
}

/// The same for one section.
fn of(name: &str, report: &Value) -> [usize; 2] {
    let all = failures(report);
    let found = all.iter().find(|section| section.0 == name).unwrap();
    [found.1, found.2]
}

#[test]
fn every_row_passes_and_the_exit_code_is_zero() {
    let ran = validate(&["--json", "--threads", "2"]);
    let report = ran.json();
    let sections = report["sections"].as_array().unwrap();
    for row in sections
        .iter()
        .flat_map(|section| section["rows"].as_array().unwrap())
    {
        assert_eq!(row["verdict"], "pass", "{row}");
    }
    assert_eq!(ran.code, Some(0));
    assert_eq!(ran.stderr, "");
    assert_eq!(report["verdict"], "pass");
    assert_eq!(report["failed"], 0);
    assert_eq!(report["threads"], 2);
    let rows: usize = failures(&report).iter().map(|section| section.2).sum();
    assert_eq!(report["passed"].as_u64(), Some(rows as u64));
    assert_eq!(rows, 117, "the number given in docs/evidence.md");
}

#[test]
fn coefficients_wrong_by_a_thousandth_fail_every_section_with_an_independent_reference() {
    let ran = validate(&["--json", "--perturb-coefficients", "1e-3"]);
    assert_eq!(ran.code, Some(1));
    let report = ran.json();
    assert_eq!(report["verdict"], "fail");
    for section in [
        "Influence coefficients",
        "Layered bodies, axisymmetric",
        "The same grid problem",
    ] {
        let [failed, rows] = of(section, &report);
        assert_eq!(failed, rows, "{section}");
    }
    assert!(of("Closed forms", &report)[0] >= 5);
    // Layers in the wavenumber domain have no coefficients.
    assert_eq!(of("Compliance of layers", &report)[0], 0);
}

#[test]
fn coefficients_wrong_by_a_millionth_fail_and_the_table_names_the_rows() {
    let ran = validate(&["--perturb-coefficients", "1e-6"]);
    assert_eq!(ran.code, Some(1));
    assert!(ran.stderr.contains("test hook"), "{}", ran.stderr);
    assert!(ran.stderr.contains("do not trust"), "{}", ran.stderr);
    let failing = ran.stdout.lines().filter(|line| line.ends_with("FAIL"));
    let failing: Vec<_> = failing.collect();
    assert_eq!(failing.len(), 22, "{}", ran.stdout);
    assert!(failing[0].contains("half-space: 144 coefficients"));
    let summary = "10 of 10  Influence coefficients";
    assert!(ran.stdout.contains(summary), "{}", ran.stdout);
}

#[test]
fn an_invalid_perturbation_is_an_error_of_the_command_line() {
    for by in ["-1", "nan", "inf", "x"] {
        let ran = validate(&["--perturb-coefficients", by]);
        assert_eq!(ran.code, Some(2), "{by}");
        assert_eq!(ran.stdout, "", "{by}");
    }
}
