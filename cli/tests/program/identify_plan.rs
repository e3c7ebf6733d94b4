//! `pellicle identify --plan`: the expected intervals before any measurement.

use std::fs;

use serde_json::Value;

use super::runner::TestFolder;

/// A coating on a polymer indented by a ball; there are no measurements.
pub const MODEL: &str = r#"title = "Coating & ball"
[model]
foundation = { substrate = { young_modulus = "10 GPa", poisson_ratio = 0.3 }, layer = [{ thickness = "0.5 um", young_modulus = "100 GPa", poisson_ratio = 0.25 }] }
indenter = { kind = "paraboloid", radius = "10 um" }
"#;

pub const E1: &str = r#""foundation.layer[0].young_modulus" = { from = "1 GPa", to = "10 TPa" }"#;
pub const E2: &str = r#""foundation.substrate.young_modulus" = { from = "0.1 GPa", to = "1 TPa" }"#;
pub const H: &str = r#""foundation.layer[0].thickness" = { from = "1 nm", to = "100 um" }"#;
const RADIUS: &str = r#""indenter.radius" = { from = "0.1 um", to = "1 mm" }"#;

/// A ball on a half-space.
const BALL: &str = r#"
[model]
foundation = { substrate = { young_modulus = "70 GPa", poisson_ratio = 0.2 } }
indenter = { kind = "paraboloid", radius = "10 um" }
"#;
const MODULUS: &str = r#""foundation.substrate.young_modulus" = { from = "1 GPa", to = "1 TPa" }"#;

/// A fit file with a model, unknowns, and more tables.
pub fn fit_file(model: &str, unknowns: &[&str], more: &str) -> String {
    format!("{model}\n[unknown]\n{}\n{more}\n", unknowns.join("\n"))
}

/// The plan of a fit file, as JSON.
fn planned(folder: &TestFolder, fit: &str) -> Value {
    fs::write(folder.path("fit.toml"), fit).unwrap();
    folder
        .run(&["identify", "fit.toml", "--plan", "--json"])
        .json()
}

/// Finds the design of a list whose curves have these radii and largest forces.
pub fn design<'a>(designs: &'a Value, curves: &[(f64, f64)]) -> &'a Value {
    let is_of = |curve: &Value, (radius, force): (f64, f64)| {
        let near = |found: &Value, wanted: f64| (number(found) / wanted - 1.0).abs() < 1e-9;
        near(&curve["radius"], radius) && near(&curve["forces"][1], force)
    };
    let is_wanted = |design: &&Value| {
        let found = design["curves"].as_array().unwrap();
        found.len() == curves.len()
            && curves
                .iter()
                .all(|one| found.iter().any(|c| is_of(c, *one)))
    };
    let mut designs = designs.as_array().unwrap().iter();
    designs.find(is_wanted).unwrap()
}

/// The standard error of the unknown whose key ends so; infinite if it is not determined.
pub fn error(design: &Value, key: &str) -> f64 {
    let unknown = unknown(design, key);
    unknown["standard_error"].as_f64().unwrap_or(f64::INFINITY)
}

pub fn unknown<'a>(design: &'a Value, key: &str) -> &'a Value {
    let mut all = ["unknowns", "nuisances"]
        .into_iter()
        .flat_map(|role| design[role].as_array().unwrap());
    let is_wanted = |of: &&Value| of["key"].as_str().unwrap().ends_with(key);
    all.find(is_wanted).unwrap()
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn assert_near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found / wanted - 1.0).abs() < tolerance, "{found} {wanted}");
}

/// Errors for a coating computed earlier by another program: 1 % of noise, a free zero, 24 loads over two decades.
#[test]
fn a_plan_without_data_gives_the_errors_computed_by_another_program() {
    let folder = TestFolder::new();
    let errors = |unknowns: &[&str], more: &str| {
        let design_of = "[report]\ndesign = { forces = [\"1 mN\"] }";
        let fit = fit_file(MODEL, unknowns, &format!("{more}\n{design_of}"));
        let plan = planned(&folder, &fit);
        let one = design(&plan["designs"], &[(10e-6, 1e-3)]).clone();
        assert_eq!(plan["warnings"][0]["code"], "assumed-noise");
        let keys = [
            "layer[0].young_modulus",
            "substrate.young_modulus",
            "thickness",
        ];
        let keys = keys.into_iter().take(unknowns.len());
        keys.map(|key| error(&one, key)).collect::<Vec<_>>()
    };
    let assert_all = |found: Vec<f64>, wanted: &[f64], tolerance| {
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert_near(found, *wanted, tolerance);
        }
    };
    // The digits given of the expected values.
    assert_all(errors(&[E1], ""), &[0.010], 0.03);
    assert_all(errors(&[E1, E2], ""), &[0.034, 0.018], 0.03);
    assert_all(errors(&[E1, E2, H], ""), &[0.106, 0.096, 0.155], 0.01);
    // Where the data determine almost nothing, the grid error in the derivatives matters.
    let frame = "[nuisance]\nframe_compliance = \"free\"";
    assert_all(errors(&[E1, E2, H], frame), &[0.20, 4.26, 1.22], 0.08);
}

#[test]
fn a_small_and_a_large_ball_together_come_first() {
    let folder = TestFolder::new();
    let more = "[report]\ndesign = { forces = [\"2 mN\"], radii = [\"1 um\", \"100 um\"] }";
    let plan = planned(&folder, &fit_file(MODEL, &[E1, E2, H], more));
    let designs = &plan["designs"];
    let both = design(designs, &[(1e-6, 2e-3), (100e-6, 2e-3)]);
    assert_eq!(both, &designs[0]);
    for (key, wanted) in [
        ("layer[0].young_modulus", 0.027),
        ("substrate.young_modulus", 0.008),
        ("thickness", 0.027),
    ] {
        // The forces behind these values are not known; 20 µN to 2 mN come close.
        assert_near(error(both, key), wanted, 0.1);
    }
}

/// Fits of simulated measurements scatter as their plan predicts, and give its intervals.
#[test]
fn fits_of_simulated_data_scatter_as_planned() {
    const SEEDS: u32 = 12;
    let folder = TestFolder::new();
    let data = r#"
[[data]]
file = "coating.csv"
columns = { depth = "depth", force = "force" }
units = { depth = "nm", force = "mN" }
segment = { from = "0.1 mN", to = "10 mN" }
noise = { depth = "0.5 nm", relative = 0.005, correlation = "none" }
[report]
intervals = "wald"
"#;
    let fit = fit_file(MODEL, &[E1, E2], data);
    let plan = planned(&folder, &(fit.clone() + "design = { points = 100 }\n"));
    assert!(plan["warnings"].as_array().unwrap().is_empty());
    let planned = design(&plan["designs"], &[(10e-6, 10e-3)]);
    fs::write(folder.path("fit.toml"), &fit).unwrap();
    let keys = [
        ("layer[0].young_modulus", 100e9),
        ("substrate.young_modulus", 10e9),
    ];
    let mut squares = [0.0; 2];
    for seed in 1..=SEEDS {
        let seed = seed.to_string();
        let simulate = [
            "identify",
            "fit.toml",
            "--simulate",
            "--out",
            "coating.csv",
            "--force",
        ];
        let ran = folder.run(&[&simulate[..], &["--quiet", "--seed", &seed]].concat());
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let ran = folder.run(&["identify", "fit.toml", "--json", "--accept-misfit"]);
        let found: Value = serde_json::from_str(&ran.stdout).unwrap();
        for ((key, truth), squares) in keys.into_iter().zip(&mut squares) {
            let one = found["unknowns"].as_array().unwrap().iter();
            let mut one = one.filter(|of| of["key"].as_str().unwrap().ends_with(key));
            let one = one.next().unwrap();
            let expected = error(planned, key);
            *squares += ((number(&one["value"]) / truth).ln() / expected).powi(2);
            let [low, high] = [0, 1].map(|end: usize| number(&one["wald"][end]));
            // The derivatives are taken at an estimate that is off by a standard error, about 2 % of the modulus.
            assert_near((high / low).ln(), 2.0 * 1.959_964 * expected, 0.05);
        }
    }
    // χ² with 12 degrees of freedom lies in this range with probability 0.998.
    assert!(
        squares.iter().all(|sum| (2.2..32.9).contains(sum)),
        "{squares:?}"
    );
}

#[test]
fn a_ball_of_unknown_radius_determines_only_a_product_in_any_design() {
    let folder = TestFolder::new();
    let more =
        "[report]\ndesign = { forces = [\"1 mN\", \"5 mN\"], radii = [\"1 um\", \"10 um\"] }";
    let plan = planned(&folder, &fit_file(BALL, &[MODULUS, RADIUS], more));
    for design in plan["designs"].as_array().unwrap() {
        for unknown in design["unknowns"].as_array().unwrap() {
            assert_eq!(unknown["verdict"], "not-identifiable", "{unknown}");
            assert!(unknown["standard_error"].is_null(), "{unknown}");
        }
    }
    let own = design(&plan["designs"], &[(10e-6, 5e-3)]);
    let known = &unknown(own, "young_modulus")["known_combination"];
    let product = "foundation.substrate.young_modulus * indenter.radius^0.5";
    assert_eq!(known["expression"], product);
    // D ~ E^(−2/3): 24 points with 1 % noise, all with the same relative change; their spread determines the zero.
    let [low, high] = [0, 1].map(|end: usize| number(&known["interval"][end]));
    assert!(high / low > 1.0 && high / low < 1.05, "{known}");

    // With another ball of known radius, both are determined.
    let data = r#"
[[data]]
file = "none.csv"
columns = { depth = 1, force = 2 }
set = { "indenter.radius" = "1 um" }
"#;
    let plan = planned(
        &folder,
        &fit_file(BALL, &[MODULUS, RADIUS], &format!("{data}{more}")),
    );
    let alone = design(&plan["designs"], &[(1e-6, 1e-3)]);
    assert_eq!(unknown(alone, "young_modulus")["verdict"], "identified");
    assert_eq!(
        unknown(alone, "indenter.radius")["verdict"],
        "not-identified"
    );
    let both = design(&plan["designs"], &[(1e-6, 1e-3), (10e-6, 1e-3)]);
    for key in ["young_modulus", "indenter.radius"] {
        assert_eq!(unknown(both, key)["verdict"], "identified");
    }
}

/// On a half-space `D ~ E^(−2/3) R^(−1/3)`: the error of the modulus is that of the product, plus half that of the
/// radius.
#[test]
fn the_prior_of_a_radius_enters_the_error_of_the_modulus() {
    let folder = TestFolder::new();
    let prior = |factor: f64| {
        let prior = format!("{{ prior = \"lognormal\", median = \"10 um\", factor = {factor} }}");
        format!("[nuisance]\n\"indenter.radius\" = {prior}\n")
    };
    let report = "[report]\ndesign = { forces = [\"1 mN\"], radii = [\"1 um\", \"10 um\"] }";
    let plan = |more: &str| {
        planned(
            &folder,
            &fit_file(BALL, &[MODULUS], &format!("{more}{report}")),
        )
    };
    let modulus = |plan: &Value, curves: &[(f64, f64)]| {
        error(design(&plan["designs"], curves), "young_modulus")
    };
    let (known, unsure) = (plan(""), plan(&prior(1.05)));
    for radius in [1e-6, 10e-6] {
        let curves = [(radius, 1e-3)];
        let half = 0.5 * 1.05_f64.ln();
        let expected = modulus(&known, &curves).hypot(half);
        // Grid error in the derivatives.
        assert_near(modulus(&unsure, &curves), expected, 1e-3);
    }
    // Two balls, each with its own radius: 1/σ² adds.
    let both = [(1e-6, 1e-3), (10e-6, 1e-3)];
    let sum: f64 = both
        .iter()
        .map(|one| modulus(&unsure, &[*one]).powi(-2))
        .sum();
    assert_near(modulus(&unsure, &both), sum.sqrt().recip(), 1e-3);
}

/// The force at a depth is the same measurement: with noise on both axes, neither form has more information.
#[test]
fn forces_at_depths_are_as_informative_as_depths_at_forces() {
    let folder = TestFolder::new();
    let errors = |observe: &str| {
        let data = format!(
            "[[data]]\nfile = \"none.csv\"\ncolumns = {{ depth = 1, force = 2 }}\nobserve = \"{observe}\"\n\
             noise = {{ depth = \"1 nm\", force = \"1 uN\" }}\nsegment = {{ to = \"1 mN\" }}\n\
             [nuisance]\nshift = \"off\"\n"
        );
        let plan = planned(&folder, &fit_file(MODEL, &[E1, E2], &data));
        let one = design(&plan["designs"], &[(10e-6, 1e-3)]).clone();
        ["layer[0].young_modulus", "substrate.young_modulus"].map(|key| error(&one, key))
    };
    let (depths, forces) = (errors("depth at force"), errors("force at depth"));
    for (depth, force) in depths.into_iter().zip(forces) {
        // Identical in exact arithmetic.
        assert_near(depth, force, 1e-9);
    }
}
