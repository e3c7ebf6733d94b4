//! Results with numbers that no body can have: written, marked, and with the unit that was probably meant.

use std::fs;

use serde_json::Value;

use super::runner::TestFolder;

/// A ball on a coated polymer under a force given in MN for mN.
const MEGANEWTONS: &str = r#"
[foundation]
substrate = { young_modulus = "3 GPa", poisson_ratio = 0.35 }
[[foundation.layer]]
thickness = "2 um"
young_modulus = "200 GPa"
poisson_ratio = 0.25
[indenter]
kind = "sphere"
radius = "0.5 mm"
[load]
force = "5 MN"
[grid]
elements = 64
"#;

/// A polymer film on glass under a ball, up to a force that shortens it by its thickness.
const FILM: &str = r#"
[foundation]
substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 }
[[foundation.layer]]
thickness = "100 nm"
young_modulus = "1 GPa"
poisson_ratio = 0.4
[indenter]
kind = "sphere"
radius = "50 um"
[load]
forces = ["0.01 mN", "1 mN", "100 mN"]
[grid]
elements = 64
"#;

fn statuses(summary: &Value) -> Vec<&str> {
    let steps = summary["steps"].as_array().unwrap().iter();
    steps.map(|step| step["status"].as_str().unwrap()).collect()
}

/// The messages of the warnings with a code.
fn messages<'a>(summary: &'a Value, code: &str) -> Vec<&'a str> {
    let warnings = summary["warnings"].as_array().unwrap().iter();
    let of_code = warnings.filter(|warning| warning["code"] == code);
    of_code
        .map(|one| one["message"].as_str().unwrap())
        .collect()
}

#[test]
fn a_critical_load_beyond_the_model_says_so() {
    let strong = MEGANEWTONS.replace(
        "poisson_ratio = 0.25",
        "poisson_ratio = 0.25\nyield_strength = \"900 GPa\"",
    );
    let folder = TestFolder::with_case(format!("{strong}\n[stress]\n"));
    let flags = ["--pictures", "none", "--fields", "none", "--out"];
    let run = |more: &[&str]| folder.run(&[&["run", "case.toml"], &flags[..], more].concat());
    // The ball is sunk by 15 radii when the coating yields.
    let ran = run(&["a"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let load = folder.summary("a")["critical"][0].clone();
    assert_eq!(load["status"], "beyond-model");
    assert!(load["penetration"].as_f64().unwrap() > 0.5e-3);
    let weak = "foundation.layer.0.yield_strength=\"0.5 GPa\"";
    let ran = run(&["b", "--set", weak, "--set", "load.force=\"100 mN\""]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(folder.summary("b")["critical"][0]["status"], "met");
    let curve = fs::read_to_string(folder.path("a/curve.csv")).unwrap();
    assert!(curve.contains(",beyond-model\n"), "{curve}");
    let text = fs::read_to_string(folder.path("a/report.html")).unwrap();
    assert!(text.contains("BEYOND THE MODEL, do not use this load"));
}

#[test]
fn a_result_beyond_the_model_is_written_and_marked_and_the_unit_is_asked_for() {
    let folder = TestFolder::with_case(MEGANEWTONS);
    let ran = folder.run(&["run", "case.toml", "--out", "a"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("Error: beyond the model"),
        "{}",
        ran.stderr
    );
    assert!(ran.stderr.contains("BEYOND THE MODEL"), "{}", ran.stderr);
    let summary = folder.summary("a");
    assert_eq!(summary["status"], "beyond-model");
    assert_eq!(statuses(&summary), ["beyond-model"]);
    assert_eq!(summary["steps"][0]["certificate"]["satisfied"], true);
    let [message] = messages(&summary, "beyond-model")[..] else {
        panic!("{summary:#}")
    };
    // Found 1.43 m for a radius of 0.5 mm.
    assert!(
        message.contains("the indenter is sunk by 28") && message.contains("times its radius"),
        "{message}"
    );
    let question = "load.force is given as 5 MN: was mN meant?";
    assert!(message.ends_with(question), "{message}");
    let page = fs::read_to_string(folder.path("a/report.html")).unwrap();
    assert!(page.contains("Beyond the model:") && page.contains(question));
    let right = ["run", "case.toml", "--json", "--set", "load.force=5 mN"];
    let ran = folder.run(&right);
    assert_eq!(statuses(&ran.json()), ["certified"]);
}

#[test]
fn steps_of_a_curve_that_the_model_can_hold_stay_certified() {
    let folder = TestFolder::with_case(FILM);
    let ran = folder.run(&["run", "case.toml", "--out", "a"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let summary = folder.summary("a");
    assert_eq!(
        statuses(&summary),
        ["certified", "certified", "beyond-model"]
    );
    // `pellicle stress` has the film shortened by 112.6 nm of 100 nm on the axis.
    let [message] = messages(&summary, "beyond-model")[..] else {
        panic!("{summary:#}")
    };
    let times = message.split_once("layer[0] is shortened by ").unwrap().1;
    let times: f64 = times.split(' ').next().unwrap().parse().unwrap();
    assert!((times / 1.126 - 1.0).abs() < 0.05, "{message}");
    // Smaller loads are sensible, so no unit is at fault.
    assert!(!message.contains("meant"), "{message}");
    assert_eq!(messages(&summary, "layer-shortening").len(), 1);
    let curve = fs::read_to_string(folder.path("a/curve.svg")).unwrap();
    assert!(curve.contains("BEYOND THE MODEL"));
    let terminal = ran.stderr.matches("BEYOND THE MODEL").count();
    assert_eq!(terminal, 1, "{}", ran.stderr);
}

#[test]
fn an_interlayer_shortened_by_ten_times_its_thickness_is_beyond_the_model() {
    // A coating on a soft interlayer, which `pellicle stress` has shortened by 2010 nm of 200 nm.
    let layer = "[[foundation.layer]]\nthickness = \"200 nm\"\nyoung_modulus = \"2 MPa\"\npoisson_ratio = 0.45\n";
    let case = MEGANEWTONS.replace("[indenter]", &format!("{layer}[indenter]"));
    let case = case
        .replace("\"3 GPa\"", "\"200 GPa\"")
        .replace("0.35", "0.3");
    let case = case.replace("\"2 um\"", "\"1 um\"").replace(
        "\"200 GPa\"\npoisson_ratio = 0.25",
        "\"100 GPa\"\npoisson_ratio = 0.3",
    );
    let case = case.replace("0.5 mm", "100 um").replace("5 MN", "50 mN");
    let ran = TestFolder::with_case(case).run(&["run", "case.toml", "--json"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let summary: Value = serde_json::from_str(&ran.stdout).unwrap();
    let [message] = messages(&summary, "beyond-model")[..] else {
        panic!("{summary:#}")
    };
    assert!(
        message.contains("layer[1] is shortened by 10."),
        "{message}"
    );
    let question = "load.force is given as 50 mN: was uN meant?";
    assert!(message.contains(question), "{message}");
}

#[test]
fn a_study_counts_cases_beyond_the_model() {
    let text = format!("{MEGANEWTONS}[study.vary]\nload.force = [\"5 mN\", \"5 MN\"]\n");
    let folder = TestFolder::with_case(text);
    let ran = folder.run(&["study", "case.toml", "--out", "a"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let words = "2 cases: 1 certified, 1 beyond the model";
    assert!(ran.stderr.contains(words), "{}", ran.stderr);
    let table = fs::read_to_string(folder.path("a/results.csv")).unwrap();
    assert!(table.contains("\n2,beyond-model,"), "{table}");
}
