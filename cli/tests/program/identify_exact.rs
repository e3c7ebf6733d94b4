//! The part of a fit's result about the parameters that are taken as exact.

use std::fs;

use serde_json::Value;

use super::runner::TestFolder;

/// Two balls on a half-space; the radius of one is given in the table of its curve.
const BALLS: &str = r#"
[model]
foundation = { substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 } }
indenter = { kind = "paraboloid", radius = "10 um", young_modulus = "1140 GPa", poisson_ratio = 0.07 }

[[data]]
file = "ball-1.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "mN" }
segment = { from = "0.05 mN", to = "5 mN" }
noise = { relative = 0.01, depth = "0 nm", correlation = "none" }

[[data]]
file = "ball-2.csv"
set = { "indenter.radius" = "20 um" }
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "mN" }
segment = { from = "0.05 mN", to = "5 mN" }
noise = { relative = 0.01, depth = "0 nm", correlation = "none" }

[nuisance]
shift = "off"

[unknown]
"foundation.substrate.young_modulus" = { from = "1 GPa", to = "1 TPa" }
"#;

/// A folder with a fit file and the measurements simulated from it.
fn simulated(fit: &str) -> TestFolder {
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let line = ["identify", "fit.toml", "--simulate", "--quiet"];
    let ran = folder.run(&[&line[..], &["--out", "ball.csv"]].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    folder
}

#[test]
fn a_modulus_varies_with_each_exact_parameter_as_in_hertz_theory() {
    let folder = simulated(BALLS);
    let ran = folder.run(&["identify", "fit.toml", "--out", "fit"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let fit: Value =
        serde_json::from_str(&fs::read_to_string(folder.path("fit/fit.json")).unwrap()).unwrap();
    let exponent = |key: &str| {
        let mut all = fit["taken_as_exact"].as_array().unwrap().iter();
        let found = all.find(|number| number["key"] == key).unwrap();
        found["exponents"][0].as_f64().unwrap()
    };
    // E = (1 − ν²)/(1/E* − 1/E_i*) with E* √R as measured, half of the weight for each ball, since both curves have the
    // same number of points.
    let (modulus, ratio) = (fit["unknowns"][0]["value"].as_f64().unwrap(), 0.2);
    let body = modulus / (1.0 - ratio * ratio);
    let diamond = 1140e9 / (1.0 - 0.07 * 0.07);
    let both = body * diamond / (body + diamond);
    let of_radius = -0.5 * body / both;
    for (key, wanted) in [
        ("indenter.radius", of_radius / 2.0),
        ("data[1] indenter.radius", of_radius / 2.0),
        ("indenter.young_modulus", -body / diamond),
        (
            "foundation.substrate.poisson_ratio",
            -2.0 * ratio * ratio / (1.0 - ratio * ratio),
        ),
    ] {
        let found = exponent(key);
        // Grid error with 64 elements.
        assert!((found - wanted).abs() < 2e-3, "{key}: {found} for {wanted}");
    }
    let sentence = "taken as exact: an error of ";
    assert!(ran.stderr.contains(sentence), "{}", ran.stderr);
    let page = fs::read_to_string(folder.path("fit/report.html")).unwrap();
    for text in [
        "Taken as exact",
        "data[1] indenter.radius",
        "error that matters",
    ] {
        assert!(page.contains(text), "{text}");
    }
}
