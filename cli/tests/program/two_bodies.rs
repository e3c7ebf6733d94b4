//! A coated ball on a coated disc: summaries, studies and fits name the body of the indenter.

use std::fs;

use serde_json::Value;

use super::runner::TestFolder;

const CASE: &str = r#"
[foundation]
substrate = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
layer = [{ thickness = "3 um", young_modulus = "300 GPa", poisson_ratio = 0.25, yield_strength = "5 GPa" }]
[indenter]
kind = "sphere"
radius = "200 um"
[indenter.body]
substrate = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
[[indenter.body.layer]]
thickness = "2 um"
young_modulus = "180 GPa"
poisson_ratio = 0.22
interface_shear_strength = "300 MPa"
[load]
force = "500 mN"
[grid]
elements = 32
"#;

#[test]
fn the_bodies_of_the_indenter_are_named_in_summary_text_and_files() {
    let folder = TestFolder::with_case(format!("{CASE}[stress]\nbody = \"indenter\"\n"));
    let arguments = [
        "run",
        "case.toml",
        "--out",
        "results",
        "--set",
        "output.formats=['npz', 'nc', 'vti']",
    ];
    let ran = folder.run(&arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let told = "the interface of the indenter fails in shear";
    assert!(ran.stderr.contains(told), "{}", ran.stderr);
    let text = fs::read_to_string(folder.path("results/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(summary["case"]["stress"]["body"], "indenter");
    let critical = summary["critical"].as_array().unwrap();
    assert_eq!(critical.len(), 1);
    assert_eq!(critical[0]["name"], "indenter.interface[0]");
    let bodies = summary["steps"][0]["stress"]["bodies"].as_array().unwrap();
    let names: Vec<_> = bodies.iter().map(|body| &body["name"]).collect();
    assert_eq!(names, ["indenter.layer[0]", "indenter.substrate"]);
    let ran = folder.run(&["stress", "case.toml", "--at", "0,0,2 um", "--json"]);
    // Above and below the interface.
    assert_eq!(
        ran.json().as_array().map(Vec::len),
        Some(2),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_study_varies_a_layer_of_the_indenter() {
    let study = "[study]\ncase = \"case.toml\"\n[study.vary]\n\
        \"indenter.body.layer[0].thickness\" = [\"1 um\", \"4 um\"]\n";
    let folder = TestFolder::with_study(CASE, study);
    let ran = folder.study(&[]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let table = fs::read_to_string(folder.path("results/many/results.csv")).unwrap();
    let header = table.lines().next().unwrap();
    assert!(
        header.contains("indenter.body.layer[0].thickness"),
        "{header}"
    );
    let column = header
        .split(',')
        .position(|name| name == "penetration [m]")
        .unwrap();
    let of_row = |row: &str| row.split(',').nth(column).unwrap().parse::<f64>().unwrap();
    let rows: Vec<f64> = table.lines().skip(1).map(of_row).collect();
    // The layer is softer than its substrate.
    assert!(rows.len() == 2 && rows[1] > rows[0], "{rows:?}");
}

#[test]
fn the_modulus_of_an_indenters_layer_is_fitted() {
    let model = CASE
        .replace("[foundation]", "[model.foundation]")
        .replace("[indenter", "[model.indenter");
    let model = model.replace("[[indenter", "[[model.indenter");
    let (model, _) = model.split_once("[load]").unwrap();
    let fit = format!(
        r#"{model}
[[data]]
file = "ball.csv"
columns = {{ depth = "depth", force = "force" }}
units = {{ depth = "nm", force = "mN" }}
segment = {{ from = "1 mN", to = "500 mN" }}
noise = {{ relative = 0.002, depth = "0 nm", correlation = "none" }}
[nuisance]
shift = "off"
[unknown]
"indenter.body.layer[0].young_modulus" = {{ from = "50 GPa", to = "1 TPa" }}
"#
    );
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let line = [
        "identify",
        "fit.toml",
        "--simulate",
        "--quiet",
        "--out",
        "ball.csv",
    ];
    let ran = folder.run(&line);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let ran = folder.run(&["identify", "fit.toml", "--out", "fit", "--quiet"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let text = fs::read_to_string(folder.path("fit/fit.json")).unwrap();
    let found: Value = serde_json::from_str(&text).unwrap();
    let unknown = &found["unknowns"][0];
    let [value, low, high] = [
        &unknown["value"],
        &unknown["interval"][0],
        &unknown["interval"][1],
    ]
    .map(|value| value.as_f64().unwrap());
    assert!(low < value && value < high, "{unknown}");
    // Simulated with noise of 0.2 % at 180 GPa: within three of its intervals.
    assert!((value - 180e9).abs() < 1.5 * (high - low), "{unknown}");
}
