//! Ctrl-C in a fit: the results found so far are kept and marked.
#![cfg(unix)]

use std::fs;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::interrupt::interrupted;
use super::runner::TestFolder;

/// Three unknowns of a coating.
const COATING: &str = r#"
[model]
foundation = { substrate = { young_modulus = "10 GPa", poisson_ratio = 0.3 }, layer = [{ thickness = "0.5 um", young_modulus = "100 GPa", poisson_ratio = 0.25 }] }
# Not a circle, so that it needs a grid, and takes long.
indenter = { kind = "paraboloid", radii = ["10 um", "11 um"] }
[unknown]
"foundation.layer[0].young_modulus" = { from = "20 GPa", to = "500 GPa" }
"foundation.layer[0].thickness" = { from = "0.05 um", to = "5 um" }
"foundation.substrate.young_modulus" = { from = "2 GPa", to = "50 GPa" }
"#;

const TABLE: &str = r#"
[[data]]
file = "coating.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "mN" }
segment = { from = "0.1 mN", to = "10 mN" }
noise = { relative = 0.01, depth = "0 nm", correlation = "none" }
"#;

/// A fit of `tables` tables, each with its own model; six of them are more work than a test waits for.
fn fit(tables: usize) -> String {
    let radius = |table: usize| {
        format!("set = {{ \"indenter.radii\" = [\"10.00{table} um\", \"11 um\"] }}\n")
    };
    let tables = (0..tables).map(|table| TABLE.to_owned() + &radius(table));
    COATING.to_owned() + &tables.collect::<String>()
}

#[test]
fn ctrl_c_in_a_fit_keeps_and_marks_the_result_so_far() {
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), fit(1)).unwrap();
    let simulate = ["identify", "fit.toml", "--simulate", "--out", "coating.csv"];
    let ran = folder.run(&simulate);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    fs::write(folder.path("fit.toml"), fit(6)).unwrap();
    let start = Instant::now();
    let later = || start.elapsed() > Duration::from_secs(6);
    let line = ["identify", "fit.toml", "--out", "fit"];
    let (ran, time) = interrupted(&folder, &line, "-INT", later);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    // One load of a prediction, the noise of the existing data, and the time to write on a busy machine.
    assert!(time < Duration::from_secs(8), "{time:?}");
    if ran.stderr.contains("nothing is written") {
        // The machine was so busy that no curve was solved in six seconds.
        assert_eq!(folder.names(), ["coating.csv", "fit.toml"]);
        return;
    }
    let found = fs::read_to_string(folder.path("fit").join("fit.json")).unwrap();
    let found: Value = serde_json::from_str(&found).unwrap();
    let warnings = found["warnings"].as_array().unwrap();
    let codes: Vec<_> = warnings
        .iter()
        .map(|one| one["code"].as_str().unwrap())
        .collect();
    assert!(codes.contains(&"stopped"), "{codes:?}");
    let unknowns = found["unknowns"].as_array().unwrap();
    let is_open = |one: &Value| one["interval"] == serde_json::json!([null, null]);
    assert!(unknowns.iter().any(is_open), "{unknowns:?}");
    assert!(
        ran.stderr.contains("the fit was stopped before"),
        "{}",
        ran.stderr
    );
}
