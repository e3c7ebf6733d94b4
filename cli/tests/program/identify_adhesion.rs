//! Retractions and approaches of a cantilever that sticks to a gel, by the closed form of Johnson, Kendall and Roberts.

use std::fs;

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};
use serde_json::Value;

use super::runner::{ProgramOutput, TestFolder};

/// Modulus, Pa, and work of adhesion, J/m².
const TRUTH: [f64; 2] = [20e3, 0.2e-3];
const RADIUS: f64 = 10e-6;
/// Spring constant, N/m.
const SPRING: f64 = 0.1;
/// Standard deviation of the forces, N.
const NOISE: f64 = 60e-12;

/// `a³ = 3R/(4E*) (F + √(8πwE*a³))`: approach of the cantilever's end (m) and force (N) at contact radii, from the
/// jump-out on.
fn branch() -> Vec<[f64; 2]> {
    let ([modulus, work], pi) = (TRUTH, std::f64::consts::PI);
    let modulus = modulus / 0.75;
    let at = |i: u32| {
        let a = 1e-7 * 1.0005_f64.powf(f64::from(i));
        let force = 4.0 * modulus * a.powi(3) / (3.0 * RADIUS)
            - (8.0 * pi * work * modulus * a.powi(3)).sqrt();
        let depth = a * a / RADIUS - (2.0 * pi * work * a / modulus).sqrt();
        [depth + force / SPRING, force]
    };
    let all: Vec<[f64; 2]> = (0..6500).map(at).collect();
    let last = (0..all.len()).min_by(|a, b| all[*a][0].total_cmp(&all[*b][0]));
    all[last.unwrap()..].to_vec()
}

/// Heights and forces of an approach, which jumps in at no approach, and the retraction after it, both with an offset.
fn curve(seed: u64) -> String {
    let branch = branch();
    let force_at = |z: f64| {
        let after = branch.partition_point(|[approach, _]| *approach < z);
        branch.get(after).map_or(0.0, |[_, force]| *force)
    };
    let top = branch[branch.partition_point(|[_, force]| *force < 10e-9)][0];
    let height = |i: u32| top - 2e-6 * f64::from(i) / 1000.0;
    let approach = (0..1000)
        .rev()
        .map(height)
        .map(|z| (z, if z < 0.0 { 0.0 } else { force_at(z) }));
    let retraction = (0..1000)
        .map(height)
        .map(|z| (z, if z < branch[0][0] { 0.0 } else { force_at(z) }));
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let row = |(z, force): (f64, f64)| {
        let noise: f64 = StandardNormal.sample(&mut random);
        format!(
            "{:.3},{:.5}\n",
            1e9 * z + 1234.0,
            1e9 * (force + NOISE * noise + 0.3e-9)
        )
    };
    String::from("height (nm),force (nN)\n")
        + &approach.chain(retraction).map(row).collect::<String>()
}

fn fit(curve: &str, data: &str, load: &str) -> ProgramOutput {
    let text = format!(
        r#"
[model]
foundation = {{ substrate = {{ young_modulus = "10 kPa", poisson_ratio = 0.5 }} }}
indenter = {{ kind = "paraboloid", radius = "10 um" }}
{load}

[[data]]
file = "curve.csv"
columns = {{ height = "height", force = "force" }}
spring_constant = "0.1 N/m"
baseline = "before contact"
{data}

[unknown]
"foundation.substrate.young_modulus" = {{ from = "1 kPa", to = "1 MPa" }}
"load.work_of_adhesion" = {{ from = "1 uJ/m^2", to = "10 mJ/m^2" }}
"#
    );
    let folder = TestFolder::new();
    fs::write(folder.path("curve.csv"), curve).unwrap();
    fs::write(folder.path("fit.toml"), text).unwrap();
    folder.run(&["identify", "fit.toml", "--json", "--threads", "1"])
}

const ADHESION: &str = "load = { work_of_adhesion = \"0.1 mJ/m^2\" }";

/// Whether the intervals hold the truth, each narrower than a part of it.
fn holds(found: &Value, most: f64) -> [bool; 2] {
    [0, 1].map(|unknown| {
        let found = &found["unknowns"][unknown];
        assert_eq!(found["verdict"], "identified", "{found}");
        let [low, high] = [0, 1].map(|end| found["interval"][end].as_f64().unwrap());
        assert!(high - low < most * TRUTH[unknown], "{low} {high}");
        (low..high).contains(&TRUTH[unknown])
    })
}

#[test]
fn modulus_and_work_of_adhesion_are_found_on_the_way_out_and_in_for_both_observables() {
    for observe in ["force at depth", "depth at force"] {
        for (part, most) in [("unloading", 0.05), ("loading", 0.2)] {
            let data = format!("observe = \"{observe}\"\nsegment = {{ part = \"{part}\" }}");
            let found = fit(&curve(4), &data, ADHESION).json();
            assert_eq!(holds(&found, most), [true; 2], "{observe} {part}: {found}");
        }
    }
}

#[test]
fn what_cannot_tell_a_work_of_adhesion_is_refused_in_one_sentence() {
    let retraction = "segment = { part = \"unloading\" }";
    let whole = curve(1);
    let lines: Vec<&str> = whole.lines().filter(|line| !line.contains(",-")).collect();
    let without = lines.join("\n");
    for (output, wanted) in [
        (
            fit(&without, retraction, ADHESION),
            "no pull-off in the data",
        ),
        (
            fit(&curve(1), "segment = { part = \"whole\" }", ADHESION),
            "\"loading\" or \"unloading\"",
        ),
        (
            fit(&curve(1), retraction, ""),
            "without load.work_of_adhesion in the model",
        ),
    ] {
        assert_eq!(output.code, Some(2), "{}", output.stderr);
        assert!(output.stderr.contains(wanted), "{}", output.stderr);
    }
}

#[test]
fn a_law_of_adhesion_that_does_not_hold_at_the_fitted_values_is_told() {
    let is_told = |law: &str| {
        let load = format!("load = {{ work_of_adhesion = \"0.1 mJ/m^2\", adhesion = \"{law}\" }}");
        let found = fit(&curve(4), "segment = { part = \"unloading\" }", &load).json();
        let warnings = found["warnings"].as_array().unwrap().clone();
        let is_of_law = |of: &Value| of["code"] == "adhesion-law";
        warnings.iter().any(is_of_law)
    };
    // Tabor's number is 280.
    assert!(is_told("dmt") && !is_told("jkr"));
}
