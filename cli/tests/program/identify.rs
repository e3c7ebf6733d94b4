//! `pellicle identify` as seen by a user: numbers with intervals, verdicts, exit codes, wrong fit files.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::identify_plan::number;
use super::runner::{ProgramOutput, TestFolder, keys};

/// A coating on a polymer indented by a ball, with noise of 1 %.
const COATING: &str = r#"
title = "Coating on polymer, ball"

[model]
foundation = { substrate = { young_modulus = "10 GPa", poisson_ratio = 0.3 }, layer = [{ thickness = "0.5 um", young_modulus = "100 GPa", poisson_ratio = 0.25 }] }
indenter = { kind = "paraboloid", radius = "10 um" }

[[data]]
file = "coating.csv"
columns = { depth = "depth", force = "force", time = 1 }
units = { depth = "nm", force = "mN", time = "s" }
segment = { from = "0.1 mN", to = "10 mN" }
noise = { relative = 0.01, depth = "0 nm", correlation = "none" }

[unknown]
"foundation.layer[0].young_modulus" = { from = "20 GPa", to = "500 GPa" }
"foundation.substrate.young_modulus" = { from = "2 GPa", to = "50 GPa" }
"#;

/// A ball on a half-space.
const BALL: &str = r#"
[model]
foundation = { substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 } }
indenter = { kind = "paraboloid", radius = "10 um" }

[[data]]
file = "ball.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "mN" }
segment = { from = "0.05 mN", to = "5 mN" }
noise = { relative = 0.01, depth = "0 nm", correlation = "none" }

[unknown]
"foundation.substrate.young_modulus" = { from = "1 GPa", to = "1 TPa" }
"#;

/// A fit of the radius of a diamond ball to repeats on tungsten.
pub fn tungsten() -> String {
    let curves = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../identify/tests/curves/tungsten_sphere_test0*.csv");
    format!(
        r#"
[model]
foundation = {{ substrate = {{ young_modulus = "410 GPa", poisson_ratio = 0.28 }} }}
indenter = {{ kind = "paraboloid", radius = "165 nm", young_modulus = "1141 GPa", poisson_ratio = 0.07 }}
[[data]]
file = "{}"
columns = {{ depth = "depth", force = "load", time = 1 }}
units = {{ depth = "nm", force = "mN", time = "s" }}
segment = {{ from = "0.02 mN", until = "largest depth step" }}
[unknown]
"indenter.radius" = {{ from = "20 nm", to = "2 um" }}
"#,
        curves.display()
    )
}

/// A folder with this fit file and the measurements simulated from it.
fn simulated(fit: &str, data: &str, seed: &str) -> TestFolder {
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let arguments = [
        "identify",
        "fit.toml",
        "--simulate",
        "--seed",
        seed,
        "--out",
        data,
        "--quiet",
    ];
    let ran = folder.run(&arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    folder
}

/// Runs the fit of another fit file in the folder.
fn fitted(folder: &TestFolder, fit: &str, more: &[&str]) -> (ProgramOutput, Value) {
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let ran = folder.run(&[&["identify", "fit.toml", "--json"], more].concat());
    let found = serde_json::from_str(&ran.stdout);
    let found = found.unwrap_or_else(|error| panic!("{error}: {}", ran.stderr));
    (ran, found)
}

#[test]
fn moduli_of_a_coating_and_its_substrate_lie_in_their_fitted_intervals() {
    let folder = simulated(COATING, "coating.csv", "3");
    let (ran, fit) = fitted(&folder, COATING, &[]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(
        keys(&fit),
        [
            "schema",
            "program",
            "version",
            "title",
            "verdict",
            "unknowns",
            "nuisances",
            "correlation",
            "taken_as_exact",
            "fit",
            "work",
            "curves",
            "warnings"
        ]
    );
    assert_eq!(fit["verdict"], "fitted");
    for (index, truth) in [(0, 100e9), (1, 10e9)] {
        let unknown = &fit["unknowns"][index];
        assert_eq!(
            keys(unknown),
            [
                "key",
                "unit",
                "value",
                "interval",
                "level",
                "wald",
                "verdict",
                "why",
                "known_combination"
            ]
        );
        let [low, high] = [0, 1].map(|end: usize| number(&unknown["interval"][end]));
        assert!(low < truth && truth < high, "{unknown}");
        assert_eq!(unknown["verdict"], "identified");
        assert_eq!(unknown["unit"], "Pa");
    }
    assert!(
        number(&fit["work"]["curves_solved"]) <= 12.0,
        "{}",
        fit["work"]
    );
    // No other files are left.
    assert_eq!(folder.names(), ["coating.csv", "fit.toml"]);
}

#[test]
fn the_same_seed_on_one_thread_or_two_gives_the_same_bytes() {
    let folder = simulated(COATING, "coating.csv", "5");
    let again = simulated(COATING, "coating.csv", "5");
    let data = |folder: &TestFolder| fs::read(folder.path("coating.csv")).unwrap();
    assert_eq!(data(&folder), data(&again));
    let result = |threads: &str| {
        let (_, mut fit) = fitted(&folder, COATING, &["--threads", threads]);
        fit["work"]["seconds"] = Value::Null;
        fit.to_string()
    };
    assert_eq!(result("1"), result("2"));
}

#[test]
fn a_ball_on_a_half_space_determines_the_modulus_times_the_root_of_the_radius() {
    let folder = simulated(BALL, "ball.csv", "1");
    let both = format!("{BALL}\"indenter.radius\" = {{ from = \"1 um\", to = \"100 um\" }}\n");
    let (ran, fit) = fitted(&folder, &both, &[]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let modulus = &fit["unknowns"][0];
    assert_eq!(modulus["verdict"], "not-identifiable");
    assert!(modulus["interval"][0].is_null() && modulus["interval"][1].is_null());
    let known = &modulus["known_combination"];
    let expression = "foundation.substrate.young_modulus * indenter.radius^0.5";
    assert_eq!(known["expression"], expression);
    let truth = 70e9 * 10e-6_f64.sqrt();
    let [low, high] = [0, 1].map(|end: usize| number(&known["interval"][end]));
    assert!(low < truth && truth < high && high < 1.05 * low, "{known}");
}

#[test]
fn twin_coatings_give_the_same_misfit_and_neither_poissons_ratio_is_identifiable() {
    // The same compliance to 1e-15 (Dundurs).
    let twin = COATING
        .replace(
            "\"10 GPa\", poisson_ratio = 0.3 ",
            "\"9.86374 GPa\", poisson_ratio = 0.32 ",
        )
        .replace(
            "\"100 GPa\", poisson_ratio = 0.25",
            "\"87.3387 GPa\", poisson_ratio = 0.425676",
        );
    assert_eq!(
        twin.matches("0.425676").count() + twin.matches("9.86374").count(),
        2
    );
    let folder = simulated(COATING, "coating.csv", "7");
    let free = |fit: &str| {
        let fit = format!(
            "{fit}\"foundation.layer[0].poisson_ratio\" = {{ from = 0.05, to = 0.49 }}\n\
             \"foundation.substrate.poisson_ratio\" = {{ from = 0.05, to = 0.49 }}\n[report]\nintervals = \"wald\"\n"
        );
        fitted(&folder, &fit, &[]).1
    };
    let (found, other) = (free(COATING), free(&twin));
    let misfit = |found: &Value| number(&found["fit"]["chi_squared_per_degree"]);
    let (own, other) = (misfit(&found), misfit(&other));
    assert!((own - other).abs() < 1e-6 * own, "{own} {other}");
    for unknown in found["unknowns"].as_array().unwrap() {
        assert_eq!(unknown["verdict"], "not-identifiable", "{unknown}");
    }
}

#[test]
fn a_cone_fitted_as_a_paraboloid_is_refused_with_exit_code_3() {
    let cone = BALL.replace(
        "kind = \"paraboloid\", radius = \"10 um\"",
        "kind = \"cone\", half_angle = \"75 deg\"",
    );
    let folder = simulated(&cone, "ball.csv", "2");
    let (ran, fit) = fitted(&folder, BALL, &[]);
    assert_eq!(
        (ran.code, &fit["verdict"]),
        (Some(3), &"misfit".into()),
        "{}",
        ran.stderr
    );
    assert!(number(&fit["fit"]["misfit_p"]) < 0.01);
    let (ran, _) = fitted(&folder, BALL, &["--accept-misfit"]);
    assert_eq!(ran.code, Some(0));
}

#[test]
fn repeats_on_tungsten_scatter_by_more_than_the_error_of_each() {
    let folder = TestFolder::new();
    let (ran, found) = fitted(&folder, &tungsten(), &["--accept-misfit"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(found["verdict"], "misfit");
    let radius = &found["unknowns"][0];
    let (value, scatter) = (number(&radius["value"]), number(&radius["scatter"]));
    assert!((130e-9..190e-9).contains(&value), "{radius}");
    assert!((0.02..0.1).contains(&(scatter / value)), "{radius}");
    let [low, high] = [0, 1].map(|end: usize| number(&radius["interval"][end]));
    assert!(high / low > 1.03, "{radius}");
    let excluded = found["fit"]["excluded"].as_array().unwrap();
    let is_pop_in = |one: &Value| one["reason"] == "after the largest depth step";
    assert!(excluded.iter().any(is_pop_in), "{excluded:?}");
}

#[test]
fn results_are_written_to_a_folder_without_overwriting_others() {
    let folder = simulated(BALL, "ball.csv", "4");
    let ran = folder.run(&["identify", "fit.toml", "--out", "fit", "--quiet"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    for name in ["fit.json", "fit.csv", "covariance.csv", "profiles.csv"] {
        assert!(folder.path("fit").join(name).is_file(), "{name}");
    }
    let rows = fs::read_to_string(folder.path("fit").join("fit.csv")).unwrap();
    assert_eq!(rows.lines().count(), 101);
    let again = folder.run(&["identify", "fit.toml", "--out", "fit", "--quiet"]);
    assert_eq!(again.code, Some(2));
    assert!(again.stderr.contains("--force"), "{}", again.stderr);
    let forced = folder.run(&["identify", "fit.toml", "--out", "fit", "--quiet", "--force"]);
    assert_eq!(forced.code, Some(0), "{}", forced.stderr);
}

#[test]
fn wrong_fit_files_are_refused_in_one_sentence() {
    let folder = simulated(BALL, "ball.csv", "1");
    let refusals = [
        (
            "young_modulus\" = { from",
            "yuong_modulus\" = { from",
            "did you mean",
        ),
        ("from = \"1 GPa\"", "from = \"1 nm\"", "pressure"),
        ("to = \"1 TPa\"", "to = \"0.5 GPa\"", "`from` below `to`"),
        (
            "file = \"ball.csv\"",
            "file = \"none.csv\"",
            "no file matches",
        ),
        ("depth = \"depth\", ", "depth = 7, ", "7"),
        ("[unknown]", "[unknowns]", "unknown"),
        ("radius = \"10 um\"", "radius = \"-1 um\"", "radius"),
        ("depth = \"nm\"", "depth = \"mN\"", "length"),
        ("from = \"0.05 mN\"", "from = \"4.99 mN\"", "points"),
    ];
    for (from, to, said) in refusals {
        assert_eq!(BALL.matches(from).count(), 1, "{from}");
        fs::write(folder.path("wrong.toml"), BALL.replace(from, to)).unwrap();
        let ran = folder.run(&["identify", "wrong.toml", "--json"]);
        assert_eq!(
            (ran.code, ran.stdout.as_str()),
            (Some(2), ""),
            "{to}: {}",
            ran.stderr
        );
        assert!(ran.stderr.contains(said), "{to}: {}", ran.stderr);
        assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
    }
}
