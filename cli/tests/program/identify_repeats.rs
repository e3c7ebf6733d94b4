//! Several curves of which one is odd: a soft place, a curve that is no contact, the same data twice.

use std::fs;

use serde_json::Value;

use super::identify_plan::number;
use super::runner::TestFolder;

const POINTS: usize = 60;
const NOISE: f64 = 2e-10;

/// A ball of 10 µm on an elastic body, with these tables for its data.
pub fn ball(tables: &str) -> String {
    format!(
        r#"
[model]
foundation = {{ substrate = {{ young_modulus = "70 GPa", poisson_ratio = 0.2 }} }}
indenter = {{ kind = "paraboloid", radius = "10 um" }}
{tables}
[unknown]
"foundation.substrate.young_modulus" = {{ from = "1 GPa", to = "10 TPa" }}
"#
    )
}

/// One table of data.
pub fn table(file: &str) -> String {
    format!(
        r#"
[[data]]
file = "{file}"
columns = {{ depth = "depth", force = "force" }}
units = {{ depth = "nm", force = "mN" }}
"#
    )
}

/// Writes a curve of a body of this modulus: Hertz, with noise of 0.2 nm of a generator of this seed.
fn write(folder: &TestFolder, name: &str, modulus: f64, seed: u64) {
    let mut state = seed;
    let mut uniform = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0
    };
    // The sum of twelve uniform variates is normal but for its tails.
    let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
    let row = |i: usize| {
        let force = 1e-4 * 40_f64.powf(i as f64 / (POINTS - 1) as f64);
        let plane = modulus / 0.96;
        let depth = (9.0 * force * force / (16.0 * 1e-5 * plane * plane)).cbrt();
        format!("{},{}\n", 1e9 * (depth + NOISE * normal()), 1e3 * force)
    };
    let rows: String = (0..POINTS).map(row).collect();
    fs::write(folder.path(name), format!("depth,force\n{rows}")).unwrap();
}

/// The exit code of a fit, its standard error, and its result.
fn fitted(folder: &TestFolder, fit: &str) -> (Option<i32>, String, Value) {
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--json"]);
    let found = serde_json::from_str(&ran.stdout);
    let found = found.unwrap_or_else(|error| panic!("{error}: {}", ran.stderr));
    (ran.code, ran.stderr, found)
}

/// The messages of the warnings with this code.
fn messages(found: &Value, code: &str) -> Vec<String> {
    let all = found["warnings"].as_array().unwrap().iter();
    all.filter(|warning| warning["code"] == code)
        .map(|warning| warning["message"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn a_repeat_of_a_soft_place_is_told_of_and_its_scatter_is_in_the_interval() {
    let folder = TestFolder::new();
    for seed in 1..6 {
        write(&folder, &format!("r{seed}.csv"), 70e9, seed);
    }
    write(&folder, "r6.csv", 49e9, 6);
    let (code, errors, found) = fitted(&folder, &ball(&table("r*.csv")));
    assert_eq!(code, Some(0), "{errors}");
    let told = messages(&found, "odd-repeat");
    assert!(
        told.len() == 2 && errors.contains("r6.csv alone gives"),
        "{errors}"
    );
    assert!(told[0].contains("below the other repeats"), "{told:?}");
    assert!(
        told[1].contains("without it") && told[1].contains(" 70."),
        "{told:?}"
    );
    assert!(
        found["fit"]["excluded"].as_array().unwrap().is_empty(),
        "{found}"
    );
    // ln 0.7 in one of six: a standard deviation of |ln 0.7|/√6 about the mean, 70 GPa · 0.7^(1/6).
    let unknown = &found["unknowns"][0];
    let value = number(&unknown["value"]);
    let wanted = 70e9 * 0.7_f64.powf(1.0 / 6.0);
    assert!((value / wanted - 1.0).abs() < 0.01, "{value}");
    let scatter = number(&unknown["scatter"]) / value;
    assert!(
        (scatter / (-0.7_f64.ln() / 6.0_f64.sqrt()) - 1.0).abs() < 0.03,
        "{scatter}"
    );
    let [low, high] = [0, 1].map(|end: usize| number(&unknown["interval"][end]));
    assert!(low < 70e9 && 70e9 < high, "{low} {high}");
}

#[test]
fn files_with_the_same_points_are_told_of() {
    let folder = TestFolder::new();
    for (name, seed) in [("r1.csv", 1), ("r2.csv", 2), ("r3.csv", 1)] {
        write(&folder, name, 70e9, seed);
    }
    let (_, errors, found) = fitted(&folder, &ball(&table("r*.csv")));
    let told = messages(&found, "same-data");
    assert_eq!(told.len(), 1, "{errors}");
    assert!(
        ["r1.csv", "r3.csv"]
            .iter()
            .all(|name| told[0].contains(name))
            && !told[0].contains("r2"),
        "{told:?}"
    );
}

#[test]
fn the_file_that_carries_the_misfit_of_several_tables_is_named() {
    let folder = TestFolder::new();
    let mut tables = String::new();
    for seed in 1..5 {
        let name = format!("r{seed}.csv");
        write(&folder, &name, if seed == 2 { 60e9 } else { 70e9 }, seed);
        tables += &table(&name);
    }
    let (code, errors, found) = fitted(&folder, &ball(&tables));
    assert_eq!(code, Some(3), "{errors}");
    let told = messages(&found, "one-curve-misfits");
    assert!(
        told.len() == 1 && told[0].contains("r2.csv carries"),
        "{errors}"
    );
}

#[test]
fn a_curve_that_never_leaves_its_noise_is_no_contact_and_no_value_of_a_map() {
    let folder = TestFolder::new();
    for (name, seed) in [("x1y1.csv", 1), ("x2y1.csv", 2)] {
        write(&folder, name, 70e9, seed);
    }
    // 120 rows of which the 40th has the largest force: its loading has too few for a test of flatness.
    let force =
        |i: u32| 0.05 + 0.01 * f64::from(i * 7 % 11) / 11.0 + if i == 40 { 0.02 } else { 0.0 };
    let rows: Vec<String> = (0..120)
        .map(|i| format!("{},{}", 2 * i, force(i)))
        .collect();
    let rows = rows.join("\n");
    fs::write(folder.path("x1y2.csv"), format!("depth,force\n{rows}")).unwrap();
    fs::write(folder.path("fit.toml"), ball(&table("x*.csv"))).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--each", "--out", "each"]);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains("2 fitted, 1 failed"), "{}", ran.stderr);
    let csv = fs::read_to_string(folder.path("each/each.csv")).unwrap();
    let row = csv.lines().find(|line| line.contains("x1y2")).unwrap();
    assert!(
        row.contains("failed") && row.contains("stay within their noise"),
        "{row}"
    );
    fs::write(folder.path("one.toml"), ball(&table("x1y2.csv"))).unwrap();
    let ran = folder.run(&["identify", "one.toml"]);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("stay within their noise"),
        "{}",
        ran.stderr
    );
}
