//! `pellicle identify` on flat punches, on stiffnesses, and on numbers that measurements state in their headers.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::fs;

use serde_json::Value;

use super::identify_plan::number;
use super::runner::{ProgramOutput, TestFolder};

/// Runs the fit of some data.
fn run(fit: &str, data: &[(&str, &str)]) -> ProgramOutput {
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    for (name, text) in data {
        fs::write(folder.path(name), text).unwrap();
    }
    folder.run(&["identify", "fit.toml", "--json"])
}

/// The result of a fit that succeeds.
fn fitted(fit: &str, data: &[(&str, &str)]) -> Value {
    let ran = run(fit, data);
    let found = serde_json::from_str(&ran.stdout);
    found.unwrap_or_else(|error| panic!("{error}: {}", ran.stderr))
}

/// The only unknown of a fit, and its interval.
fn unknown(found: &Value) -> [f64; 3] {
    let of = &found["unknowns"][0];
    let interval = [0, 1].map(|end| number(&of["interval"][end]));
    [number(&of["value"]), interval[0], interval[1]]
}

/// A smooth noise of unit size, without a pattern that a modulus could follow.
fn noise(index: u32) -> f64 {
    f64::from(index * index).mul_add(17.0, 0.4).sin()
}

const PUNCH: &str = r#"
[model]
foundation = { substrate = { young_modulus = "30 kPa", poisson_ratio = 0.45 } }
indenter = { kind = "flat-punch", radius = "1 mm" }
[[data]]
file = "punch.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "um", force = "mN" }
observe = "depth at force"
noise = { relative = 0.02, correlation = "none" }
[unknown]
"foundation.substrate.young_modulus" = { from = "1 kPa", to = "10 MPa" }
"#;

#[test]
fn a_flat_punch_gives_the_same_modulus_by_depths_and_by_forces() {
    // F = 2 a E D/(1 − ν²) with 50 kPa
    let stiffness = 2e-3 * 50e3 / (1.0 - 0.45 * 0.45);
    let mut data = String::from("depth,force\n");
    for i in 0..60 {
        let force = 0.5e-3 + 9.5e-3 * f64::from(i) / 59.0;
        let depth = force / stiffness * 0.01_f64.mul_add(noise(i), 1.0);
        writeln!(data, "{:.4},{:.4}", 1e6 * depth, 1e3 * force).unwrap();
    }
    let data = [("punch.csv", data.as_str())];
    let by_depth = unknown(&fitted(PUNCH, &data));
    let by_force = PUNCH.replace("depth at force", "force at depth");
    let found = fitted(&by_force, &data);
    assert_eq!(found["verdict"], "fitted");
    let by_force = unknown(&found);
    // 2 % of noise on 60 points, and 0.5 % of a rim that no element ends at.
    for [value, low, high] in [by_depth, by_force] {
        assert!((value / 50e3 - 1.0).abs() < 0.015, "{value}");
        assert!(
            low < 50.4e3 && high > 49.6e3 && high / low < 1.05,
            "{low} {high}"
        );
    }
}

const CONTINUOUS: &str = r#"
[model]
foundation = { substrate = { young_modulus = "100 GPa", poisson_ratio = 0.28 } }
indenter = { kind = "cone", half_angle = "70.3 deg" }
[[data]]
file = "csm.txt"
columns = { depth = "Depth", force = "Load", stiffness = "Stiffness" }
observe = "stiffness at force"
[unknown]
"foundation.substrate.young_modulus" = { from = "1 GPa", to = "1 TPa" }
"#;

/// Depth, load and stiffness of a cone on silicon, in nm, mN and a unit of stiffness, with the zero of the depth off.
fn continuous(zero: f64, unit: f64, name: &str) -> String {
    let modulus = 170e9 / (1.0 - 0.28 * 0.28);
    let tangent = 70.3_f64.to_radians().tan();
    let mut text = format!("Depth (nm)\tLoad (mN)\tStiffness ({name})\n");
    for i in 0..40 {
        let depth = 50e-9 + 1.4e-6 * f64::from(i) / 39.0;
        // S = (4/π) E* D tan α, F = S D/2
        let stiffness = 4.0 / PI * modulus * depth * tangent;
        let read = stiffness * 0.002_f64.mul_add(noise(i), 1.0) / unit;
        let (depth, load) = (depth * 1e9 + zero, 0.5e3 * stiffness * depth);
        writeln!(text, "{depth:.2}\t{load:.5}\t{read:.6e}").unwrap();
    }
    text
}

#[test]
fn stiffnesses_give_the_modulus_in_any_unit_whatever_the_zero_of_the_depth() {
    let depths = CONTINUOUS.replace("at force", "at depth");
    for (fit, zero, unit, name) in [
        (CONTINUOUS, 20.0, 1.0, "N/m"),
        (CONTINUOUS, -7.0, 1e6, "mN/nm"),
        (&depths, 20.0, 1e3, "uN/nm"),
    ] {
        let found = fitted(fit, &[("csm.txt", &continuous(zero, unit, name))]);
        assert_eq!(found["verdict"], "fitted", "{found}");
        let [value, low, high] = unknown(&found);
        // 0.2 % of noise on 40 points, and grid errors of 1e-4.
        assert!((value / 170e9 - 1.0).abs() < 2e-3, "{value} {name}");
        assert!(
            low < 170.2e9 && high > 169.8e9 && high / low < 1.01,
            "{low} {high}"
        );
        assert!(number(&found["fit"]["noise"]["stiffness"]) >= 0.0);
        // At a force the zero of the depth does not enter; at a depth it is found.
        let found = &found["curves"][0]["depth_zero"];
        if fit == CONTINUOUS {
            assert!(found.is_null(), "{found}");
        } else {
            assert!(
                (number(found) / (zero * 1e-9) - 1.0).abs() < 0.05,
                "{found}"
            );
        }
    }
}

#[test]
fn nuisances_of_a_depth_are_refused_for_stiffnesses_and_so_is_the_contact_radius_of_a_punch() {
    let data = [("csm.txt", continuous(0.0, 1.0, "N/m"))];
    let data: Vec<_> = data
        .iter()
        .map(|(name, text)| (*name, text.as_str()))
        .collect();
    for (nuisance, wanted) in [
        ("frame_compliance = \"free\"", "1/S = 1/S_contact + C_f"),
        (
            "depth_zero = { per = \"curve\" }",
            "the zero of the depth does not change a stiffness",
        ),
        (
            "drift = { per = \"curve\" }",
            "a drift of the depth does not change a stiffness",
        ),
    ] {
        let ran = run(&format!("{CONTINUOUS}[nuisance]\n{nuisance}\n"), &data);
        let key = nuisance.split(' ').next().unwrap();
        assert_eq!(ran.code, Some(2));
        assert!(
            ran.stderr.contains(&format!("key `nuisance.{key}`")) && ran.stderr.contains(wanted),
            "{}",
            ran.stderr
        );
    }
    let punch = CONTINUOUS
        .replace(
            "\"cone\", half_angle = \"70.3 deg\"",
            "\"flat-punch\", radius = \"1 um\"",
        )
        .replace("stiffness at force", "stiffness at contact radius")
        .replace("depth = \"Depth\"", "contact_radius = \"Depth\"");
    let ran = run(&punch, &data);
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.stderr.contains("key `data[0].observe`") && ran.stderr.contains("flat punch does not"),
        "{}",
        ran.stderr
    );
}

/// A Hysitron text whose headers stand above a word, of a ball of 10 µm on glass of 70 GPa.
fn hysitron() -> String {
    let modulus: f64 = 70e9 / (1.0 - 0.2 * 0.2);
    let mut text = String::from(
        "Mon Jan 5 10:00:00 2026\n\nNumber of Points = 40\nDepth (nm)\tLoad (uN)\tTime (s)\neoh\n",
    );
    for i in 1..=40 {
        let force = 1e-4 * f64::from(i);
        let depth = (9.0 * force * force / (16.0 * 10e-6 * modulus * modulus)).cbrt();
        let depth = 1e9 * depth + 0.05 * noise(i);
        writeln!(
            text,
            "{depth:.5}\t{:.4}\t{:.3}",
            1e6 * force,
            0.1 * f64::from(i)
        )
        .unwrap();
    }
    text
}

const HYSITRON: &str = r#"
[model]
foundation = { substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 } }
indenter = { kind = "paraboloid", radius = "10 um" }
[[data]]
file = "curve.txt"
columns = { depth = "Depth", force = "Load" }
[unknown]
"foundation.substrate.young_modulus" = { from = "1 GPa", to = "10 TPa" }
"#;

#[test]
fn columns_are_found_by_names_that_stand_above_a_word() {
    let data = [("curve.txt", hysitron())];
    let data: Vec<_> = data
        .iter()
        .map(|(name, text)| (*name, text.as_str()))
        .collect();
    let skip = HYSITRON.replace(
        "[unknown]",
        "text = { skip_until = \"Depth (nm)\" }\n[unknown]",
    );
    for fit in [HYSITRON, &skip] {
        let [value, low, high] = unknown(&fitted(fit, &data));
        // 0.05 nm on 40 depths up to 27 nm.
        assert!((value / 70e9 - 1.0).abs() < 0.02, "{value}");
        assert!(low < 70.3e9 && high > 69.7e9, "{low} {high}");
    }
}

/// A file of a cantilever, as from a Chiaro: a ball of 27.5 µm on a gel of 2 kPa.
fn cantilever() -> String {
    let (spring, radius, modulus) = (0.019, 27.5e-6, 2e3 / (1.0 - 0.25));
    let mut text = String::from(
        "Date\t12/05/2025\tStatus\tOK\n\nk (N/m)\t0.019\nTip radius (um)\t27.500\n\nTime (s)\tPiezo (nm)\tCantilever (nm)\n",
    );
    for i in 1..=60 {
        let force = 0.8e-9 * f64::from(i);
        let depth = (9.0 * force * force / (16.0 * radius * modulus * modulus)).cbrt();
        let bent = force / spring;
        let piezo = depth + bent + 2e-9 * noise(i);
        writeln!(
            text,
            "{:.3}\t{:.3}\t{:.3}",
            0.01 * f64::from(i),
            1e9 * piezo,
            1e9 * bent
        )
        .unwrap();
    }
    text
}

const CANTILEVER: &str = r#"
[model]
foundation = { substrate = { young_modulus = "1 kPa", poisson_ratio = 0.5 } }
indenter = { kind = "sphere" }
[[data]]
file = "gel.txt"
columns = { height = "Piezo", deflection = "Cantilever" }
[unknown]
"foundation.substrate.young_modulus" = { from = "10 Pa", to = "1 MPa" }
"#;

#[test]
fn spring_constant_and_radius_come_from_the_file_and_a_contradiction_is_refused() {
    let data = [("gel.txt", cantilever())];
    let data: Vec<_> = data
        .iter()
        .map(|(name, text)| (*name, text.as_str()))
        .collect();
    let found = fitted(CANTILEVER, &data);
    let [value, ..] = unknown(&found);
    assert!((value / 2e3 - 1.0).abs() < 0.02, "{found}");
    let codes: Vec<_> = (found["warnings"].as_array().unwrap().iter())
        .map(|warning| warning["code"].as_str().unwrap())
        .collect();
    assert!(
        codes.contains(&"stated-radius") && codes.contains(&"stated-spring-constant"),
        "{codes:?}"
    );
    let spring = CANTILEVER.replace("[unknown]", "spring_constant = \"0.04 N/m\"\n[unknown]");
    let radius = CANTILEVER.replace("\"sphere\"", "\"sphere\", radius = \"2.75 um\"");
    for (fit, key, line) in [
        (
            spring,
            "key `data[0].spring_constant`",
            "line 3 of the file, \"k (N/m) 0.019\"",
        ),
        (
            radius,
            "key `model.indenter.radius`",
            "\"Tip radius (um) 27.500\"",
        ),
    ] {
        let ran = run(&fit, &data);
        assert_eq!(ran.code, Some(2));
        assert!(
            ran.stderr.contains(key) && ran.stderr.contains(line),
            "{}",
            ran.stderr
        );
        // A bare number replaces that of the file.
        let bare = fit
            .replace("\"0.04 N/m\"", "0.04")
            .replace("\"2.75 um\"", "2.75e-6");
        assert_ne!(run(&bare, &data).code, Some(2));
    }
}
