//! The next measurement: the design of a fit file, evaluated together with its data.

use std::fs;

use serde_json::Value;

use super::identify::tungsten;
use super::identify_plan::{E1, E2, MODEL, design, error, number, unknown};
use super::runner::{TestFolder, names};

/// Simulates a measurement of a coating, with a radius that is not known exactly and a compliant frame.
fn measured(folder: &TestFolder, report: &str) {
    let fit = format!(
        r#"{MODEL}
[[data]]
file = "coating.csv"
columns = {{ depth = "depth", force = "force", time = "time" }}
units = {{ depth = "nm", force = "mN", time = "s" }}
segment = {{ from = "0.1 mN", to = "10 mN" }}
noise = {{ depth = "0.3 nm", correlation = "none" }}
[unknown]
{E1}
{E2}
[nuisance]
frame_compliance = {{ prior = "normal", mean = "0 nm/mN", sd = "0.5 nm/mN" }}
drift = {{ per = "curve" }}
"indenter.radius" = {{ prior = "lognormal", median = "10 um", factor = 1.02 }}
[report]
intervals = "wald"
{report}
"#
    );
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let simulate = ["identify", "fit.toml", "--simulate", "--quiet", "--force"];
    let ran = folder.run(&[&simulate[..], &["--out", "coating.csv"]].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
}

#[test]
fn existing_data_have_the_intervals_of_the_fit_and_a_repeat_halves_their_variance() {
    let folder = TestFolder::new();
    measured(&folder, "design = { forces = [\"10 mN\"] }");
    let ran = folder.run(&["identify", "fit.toml", "--out", "results"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let results = folder.path("results");
    let read = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    let fit: Value = serde_json::from_str(&read("fit.json")).unwrap();
    let now = design(&fit["design"], &[]);
    for role in ["unknowns", "nuisances"] {
        for one in fit[role].as_array().unwrap() {
            let key = one["key"].as_str().unwrap();
            if key == "frame_compliance" {
                continue;
            }
            for end in [0, 1] {
                let (found, wald) = (&unknown(now, key)["interval"][end], &one["wald"][end]);
                // The best fit and its noise are known to a fraction of a standard error.
                assert!(
                    (number(found) / number(wald) - 1.0).abs() < 1e-4,
                    "{key} {found} {wald}"
                );
            }
        }
    }
    let again = design(&fit["design"], &[(10e-6, 10e-3)]);
    assert_eq!(again["curves"][0]["points"], 100);
    assert_eq!(again, &fit["design"][0]);
    // The radius and the frame are common to both curves, and no prior is counted twice.
    let part = error(again, "layer[0].young_modulus") / error(now, "layer[0].young_modulus");
    assert!((0.71..0.95).contains(&part), "{part}");
    let radius = error(again, "indenter.radius") / error(now, "indenter.radius");
    assert!((0.9..=1.0).contains(&radius), "{radius}");

    for name in ["plan-intervals.svg", "plan-intervals.png"] {
        assert!(names(&results).contains(&name.to_owned()), "{name}");
    }
    let page = read("report.html");
    assert!(page.contains("What to measure next") && page.contains("what was measured"));
    assert!(
        ran.stderr.contains("added to what was measured"),
        "{}",
        ran.stderr
    );
    assert!(!ran.stderr.contains("makes none"), "{}", ran.stderr);
}

#[test]
fn without_a_design_nothing_is_planned() {
    let folder = TestFolder::new();
    measured(&folder, "");
    let ran = folder.run(&["identify", "fit.toml", "--out", "results", "--quiet"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let read = |name: &str| fs::read_to_string(folder.path("results").join(name)).unwrap();
    let fit: Value = serde_json::from_str(&read("fit.json")).unwrap();
    assert!(fit.get("design").is_none());
    assert!(read("report.html").contains("What to measure next"));
    assert!(!folder.path("results/plan-intervals.svg").exists());
}

/// Repeats scatter by more than the error of each: one more curve adds no more than one more repeat.
#[test]
fn the_plan_includes_the_scatter_between_repeats() {
    let fit = tungsten() + "[report]\ndesign = { forces = [\"0.2 mN\"] }\n";
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--json", "--accept-misfit"]);
    let fit: Value = serde_json::from_str(&ran.stdout).unwrap();
    let radius = &fit["unknowns"][0];
    let scatter = number(&radius["scatter"]) / number(&radius["value"]);
    let now = design(&fit["design"], &[]);
    let [low, high] = [0, 1].map(|end: usize| number(&radius["wald"][end]));
    let planned = &unknown(now, "indenter.radius")["interval"];
    let [least, most] = [0, 1].map(|end: usize| number(&planned[end]));
    // Rounding in the algebra of the mixed model.
    let part = (most / least).ln() / (high / low).ln();
    assert!((part - 1.0).abs() < 1e-6, "{part}");
    let more = fit["design"].as_array().unwrap().iter();
    let mut more = more.filter(|design| design["curves"].as_array().unwrap().len() == 1);
    let after = error(more.next().unwrap(), "indenter.radius");
    let before = error(now, "indenter.radius");
    // 1/σ² grows by no more than 1/τ².
    assert!(after < before, "{after} {before}");
    assert!(
        after.powi(-2) - before.powi(-2) < 1.001 * scatter.powi(-2),
        "{after} {before} {scatter}"
    );
}
