//! Elastic indenters and derivatives of a run, in the summary and the curve.

use serde_json::Value;

use super::runner::TestFolder;

/// Hertz's contact of a diamond on steel, nine forces over a decade.
const HERTZ: &str = r#"
[foundation]
substrate = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[indenter]
kind = "paraboloid"
radius = "10 um"
young_modulus = "1141 GPa"
poisson_ratio = 0.07
[load]
forces = { from = "1 mN", to = "10 mN", count = 9, spacing = "log" }
sensitivities = true
[grid]
elements = 96
"#;

/// `E/(1 − ν²)` of both bodies.
fn moduli() -> [f64; 2] {
    [(210e9, 0.3), (1141e9, 0.07)].map(|(young, nu): (f64, f64)| young / (1.0 - nu * nu))
}

fn summary(folder: &TestFolder) -> Value {
    folder
        .run(&["run", "case.toml", "--json", "--out", "results", "--quiet"])
        .json()
}

#[test]
fn an_elastic_indenter_softens_the_contact_and_has_sensitivities() {
    let folder = TestFolder::with_case(HERTZ);
    let summary = summary(&folder);
    assert_eq!(summary["case"]["indenter"]["young_modulus"], 1141e9);
    let [body, indenter] = moduli();
    // 1/E* = 1/E₁* + 1/E_i*,  D = (9 Q²/(16 R E*²))^(1/3)
    let modulus = 1.0 / (1.0 / body + 1.0 / indenter);
    let step = &summary["steps"][6];
    let number = |value: &Value| value.as_f64().unwrap();
    let [force, penetration] = ["force", "penetration"].map(|key| number(&step[key]));
    let exact = (9.0 * force * force / (16.0 * 10e-6 * modulus * modulus)).cbrt();
    // Grid error.
    assert!((penetration / exact - 1.0).abs() < 1e-3);
    let shares = [
        (
            "foundation.substrate.young_modulus",
            -2.0 / 3.0 * modulus / body,
        ),
        ("indenter.young_modulus", -2.0 / 3.0 * modulus / indenter),
        ("indenter.radius", -1.0 / 3.0),
    ];
    for (key, share) in shares {
        let mut found = step["sensitivities"].as_array().unwrap().iter();
        let found = found.find(|of| of["parameter"] == key).unwrap();
        let value = number(&found["value"]);
        let smooth = number(&found["smooth_penetration"]) * value / exact;
        // About 1000 elements in contact.
        assert!((smooth / share - 1.0).abs() < 5e-3, "{key}: {smooth}");
        let of_elements = number(&found["penetration"]) * value / exact;
        assert!(
            (of_elements / share - 1.0).abs() < 0.05,
            "{key}: {of_elements}"
        );
        let force_change = number(&found["force"]) * value / force;
        assert!(
            (force_change / (-1.5 * share) - 1.0).abs() < 0.05,
            "{key}: {force_change}"
        );
    }
}

#[test]
fn the_curve_has_two_columns_for_each_parameter() {
    let folder = TestFolder::with_case(HERTZ);
    summary(&folder);
    let curve = std::fs::read_to_string(folder.path("results").join("curve.csv")).unwrap();
    let mut lines = curve.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    for name in [
        "d penetration/d indenter.radius [m per m]",
        "d penetration/d indenter.radius along the curve [m per m]",
        "d penetration/d foundation.substrate.young_modulus [m per Pa]",
    ] {
        let column = header.iter().position(|found| *found == name);
        let column = column.unwrap_or_else(|| panic!("{name} in {header:?}"));
        for line in lines.clone() {
            let cell = line.split(',').nth(column).unwrap();
            assert!(cell.parse::<f64>().unwrap() < 0.0, "{name}: {cell}");
        }
    }
}
