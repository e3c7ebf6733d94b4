//! Curves whose zeros are off: of the depth, of the force, of both before a contact that the file shows.
//!
//! Every curve is that of Hertz, so the modulus is known.

use std::fs;

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};
use serde_json::Value;

use super::runner::{ProgramOutput, TestFolder};

/// Fits a curve with these keys of `[[data]]` and these tables.
fn fit(curve: &str, model: [&str; 2], data: &str, tables: &str) -> ProgramOutput {
    let [young_modulus, indenter] = model;
    let fit = format!(
        r#"
[model]
foundation = {{ substrate = {{ young_modulus = "{young_modulus}", poisson_ratio = 0.5 }} }}
indenter = {{ kind = "paraboloid", {indenter} }}

[[data]]
file = "curve.csv"
{data}

[unknown]
"foundation.substrate.young_modulus" = {{ from = "10 Pa", to = "10 TPa" }}

{tables}
"#
    );
    let folder = TestFolder::new();
    fs::write(folder.path("curve.csv"), curve).unwrap();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    folder.run(&["identify", "fit.toml", "--json"])
}

/// What a fit has written, whatever its verdict.
fn written(output: &ProgramOutput) -> Value {
    serde_json::from_str(&output.stdout).unwrap()
}

/// The interval of the modulus, Pa; an open end is the farthest.
fn interval(found: &Value) -> [f64; 2] {
    let ends = &found["unknowns"][0]["interval"];
    [(0, 0.0), (1, f64::INFINITY)].map(|(end, open)| ends[end].as_f64().unwrap_or(open))
}

fn assert_holds(found: &Value, modulus: f64, most: f64) {
    let [low, high] = interval(found);
    assert_eq!(found["verdict"], "fitted", "{found}");
    assert!((low..high).contains(&modulus), "{low} {high}: {found}");
    assert!((high / low).ln() < 2.0 * most, "{low} {high}");
}

/// `F = 4/3 E* √R D^1.5`, ν = 0.5.
fn hertz(modulus: f64, radius: f64, depth: f64) -> f64 {
    4.0 / 3.0 * modulus / 0.75 * radius.sqrt() * depth.max(0.0).powf(1.5)
}

struct Noise(ChaCha8Rng);

impl Noise {
    fn next(&mut self, deviation: f64) -> f64 {
        let normal: f64 = StandardNormal.sample(&mut self.0);
        deviation * normal
    }
}

/// A ball of 10 µm on 52.5 GPa, 100 forces up to some 5 mN with 5 µN of noise; the zeros are off by these.
fn nanoindentation(depth_zero: f64, force_zero: f64) -> String {
    let mut noise = Noise(ChaCha8Rng::seed_from_u64(7));
    let row = |i: u32| {
        let depth = 65e-9 * f64::from(i) / 100.0;
        let force = hertz(52.5e9, 10e-6, depth) + force_zero + noise.next(5e-6);
        format!("{:.6},{:.8}\n", 1e9 * (depth + depth_zero), 1e3 * force)
    };
    String::from("depth (nm),force (mN)\n") + &(2..=100).map(row).collect::<String>()
}

const BALL: [&str; 2] = ["40 GPa", "radius = \"10 um\""];

fn columns(observe: &str) -> String {
    format!(
        "columns = {{ depth = \"depth\", force = \"force\" }}\nobserve = \"{observe}\"\n\
         noise = {{ force = \"5 uN\", correlation = \"none\" }}"
    )
}

#[test]
fn a_zero_of_the_depth_is_found_in_both_modes_of_observation() {
    for observe in ["depth at force", "force at depth"] {
        for off in [-4e-9, 10e-9, 30e-9] {
            let curve = nanoindentation(off, 0.0);
            let found = fit(&curve, BALL, &columns(observe), "").json();
            assert_holds(&found, 52.5e9, 0.005);
            let zero = found["curves"][0]["depth_zero"].as_f64().unwrap();
            assert!((zero - off).abs() < 0.2e-9, "{observe}: {zero}");
        }
    }
}

#[test]
fn a_zero_of_the_force_is_sought_where_asked_and_named_where_not() {
    for observe in ["depth at force", "force at depth"] {
        let curve = nanoindentation(0.0, 0.2e-3);
        let output = fit(&curve, BALL, &columns(observe), "");
        assert_eq!(output.code, Some(3));
        let warnings = written(&output)["warnings"].to_string();
        assert!(warnings.contains("nuisance.force_zero"), "{warnings}");
        let sought = "[nuisance]\nforce_zero = { per = \"curve\" }";
        let found = fit(&curve, BALL, &columns(observe), sought).json();
        assert_holds(&found, 52.5e9, 0.01);
        let zero = found["curves"][0]["force_zero"].as_f64().unwrap();
        assert!((zero - 0.2e-3).abs() < 5e-6, "{observe}: {zero}");
    }
}

#[test]
fn a_zero_that_is_not_sought_is_taken_as_exact_and_its_effect_told() {
    let found = fit(
        &nanoindentation(0.0, 0.0),
        BALL,
        &columns("depth at force"),
        "",
    )
    .json();
    let exact = found["taken_as_exact"].as_array().unwrap();
    let zero = exact.iter().find(|of| of["key"] == "force_zero").unwrap();
    // Forces that are all too large by a thousandth of the largest: as if the zero taken were too small by that.
    let off = nanoindentation(0.0, 0.001 * zero["value"].as_f64().unwrap());
    let moved = fit(&off, BALL, &columns("depth at force"), "").json();
    let value = |of: &Value| of["unknowns"][0]["value"].as_f64().unwrap();
    let change = -1000.0 * (value(&moved) / value(&found)).ln();
    let exponent = zero["exponents"][0].as_f64().unwrap();
    // Linear in the zero, to first order.
    assert!((exponent / change - 1.0).abs() < 0.1, "{exponent} {change}");
}

/// An approach of a cantilever of 0.05 N/m to 10 kPa with a ball of 5 µm: 600 heights, 500 nm before the contact, with
/// this force without contact, this slope of it (N/m), and 0.02 nN of noise. Heights are counted away from the body.
fn approach(force_zero: f64, slope: f64, seed: u64) -> String {
    let mut noise = Noise(ChaCha8Rng::seed_from_u64(seed));
    let rows = (0..600).map(|i| {
        let height = 740e-9 * f64::from(i) / 600.0;
        let depth = penetration(10e3, 5e-6, 0.05, height - 500e-9);
        let force = hertz(10e3, 5e-6, depth) + force_zero + slope * height + noise.next(0.02e-9);
        format!("{:.4},{:.6}\n", 1e9 * (8e-6 - height), 1e9 * force)
    });
    String::from("Height (nm),Force (nN)\n") + &rows.collect::<String>()
}

/// The penetration `D` with `D + F(D)/k` equal to an approach, by bisection.
fn penetration(modulus: f64, radius: f64, spring: f64, approach: f64) -> f64 {
    let [mut low, mut high] = [0.0, approach.max(0.0)];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let found = middle + hertz(modulus, radius, middle) / spring;
        *(if found < approach {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    low
}

const CANTILEVER: &str =
    "columns = { height = \"Height\", force = \"Force\" }\nspring_constant = \"0.05 N/m\"";
const SOFT: [&str; 2] = ["5 kPa", "radius = \"5 um\""];

#[test]
fn a_whole_approach_needs_no_segment() {
    for (observe, most) in [("force at depth", 0.01), ("depth at force", 0.02)] {
        for force_zero in [0.0, -0.68e-9, 20e-9] {
            let data = format!("{CANTILEVER}\nobserve = \"{observe}\"");
            let found = fit(&approach(force_zero, 0.0, 3), SOFT, &data, "").json();
            assert_holds(&found, 10e3, most);
            // What is left after the line before the contact is subtracted.
            let zero = found["curves"][0]["force_zero"].as_f64().unwrap();
            let before = &found["curves"][0]["before_contact"];
            let zero = zero + before["force"].as_f64().unwrap();
            assert!((zero - force_zero).abs() < 0.01e-9, "{observe}: {zero}");
            let noise = &before["noise"];
            assert!(
                (noise.as_f64().unwrap() / 0.02e-9 - 1.0).abs() < 0.15,
                "{noise}"
            );
        }
    }
}

#[test]
fn the_slope_of_a_baseline_is_removed_and_named_where_it_is_kept() {
    let curve = approach(1e-9, 0.3e-3, 4);
    let output = fit(
        &curve,
        SOFT,
        &format!("{CANTILEVER}\nbaseline = \"off\""),
        "",
    );
    assert_eq!(output.code, Some(3));
    let warnings = written(&output)["warnings"].to_string();
    assert!(warnings.contains("baseline = "), "{warnings}");
    for baseline in [
        "",
        "baseline = \"before contact\"",
        "baseline = { from = \"50 nm\", to = \"450 nm\" }",
    ] {
        let data = format!("{CANTILEVER}\n{baseline}");
        let found = fit(&curve, SOFT, &data, "").json();
        assert_holds(&found, 10e3, 0.01);
        let before = &found["curves"][0]["before_contact"];
        assert_eq!(before["subtracted"], true);
        let number = |key: &str| before[key].as_f64().unwrap();
        assert!(
            (number("slope") - 0.3e-3).abs() < 4.0 * number("slope_sd"),
            "{before}"
        );
    }
}

#[test]
fn a_pull_off_is_noticed() {
    // Adhesion draws the cantilever down where the contact begins, and holds it on the way out.
    let mut curve = approach(0.0, 0.0, 5);
    let drawn = curve.clone();
    curve = drawn
        .lines()
        .enumerate()
        .map(|(row, line)| match line.split_once(',') {
            Some((height, force)) if (390..430).contains(&row) => {
                let force: f64 = force.parse().unwrap();
                format!("{height},{:.6}\n", force - 0.6)
            }
            _ => format!("{line}\n"),
        })
        .collect();
    let output = fit(&curve, SOFT, CANTILEVER, "");
    let warnings = written(&output)["warnings"].to_string();
    assert!(warnings.contains("adhesion"), "{warnings}");
}

#[test]
fn a_repulsion_that_passes_for_noise_is_told() {
    let is_told = |repulsion: f64| {
        let rows = approach(0.0, 0.0, 6);
        let repelled = rows.lines().enumerate().map(|(row, line)| {
            let Some((height, force)) = line.split_once(',').filter(|_| row > 0) else {
                return format!("{line}\n");
            };
            let force: f64 = force.parse().unwrap();
            let distance = 500.0 - 740.0 * (row - 1) as f64 / 600.0;
            let more = repulsion * (-distance.max(0.0) / 60.0).exp();
            format!("{height},{:.6}\n", force + more)
        });
        let output = fit(&repelled.collect::<String>(), SOFT, CANTILEVER, "");
        let found = written(&output);
        found["warnings"].to_string().contains("scatter-in-contact")
    };
    assert!(!is_told(0.0));
    assert!(is_told(0.3));
}

#[test]
fn wrong_keys_of_zeros_and_baselines_are_refused() {
    let curve = nanoindentation(0.0, 0.0);
    let data = columns("depth at force");
    let both = "[nuisance]\nshift = \"off\"\ndepth_zero = \"off\"";
    let output = fit(&curve, BALL, &data, both);
    assert!(
        output.stderr.contains("either depth_zero or shift"),
        "{}",
        output.stderr
    );
    let output = fit(&curve, BALL, &format!("{data}\nbaseline = \"on\""), "");
    assert!(
        output.stderr.contains("\"before contact\""),
        "{}",
        output.stderr
    );
    let far = "{ from = \"5 um\", to = \"9 um\" }";
    let output = fit(
        &approach(0.0, 0.0, 3),
        SOFT,
        &format!("{CANTILEVER}\nbaseline = {far}"),
        "",
    );
    assert_eq!(output.code, Some(2));
    assert!(
        output
            .stderr
            .contains("no stretch before the contact from 5e-6"),
        "{}",
        output.stderr
    );
}

/// Approaches of random stiffness, cantilever, contact point, baseline, length and noise; with slopes of the baseline
/// up to none, a twentieth and a tenth of the mean slope of the contact, the last over long baselines; and short ones.
///
/// `PELLICLE_APPROACHES=200` tries that many, and asks that 180 to 196 intervals of each 200 hold the modulus.
#[test]
fn intervals_hold_the_modulus_of_random_approaches() {
    let wanted = std::env::var("PELLICLE_APPROACHES").ok();
    let count = wanted.map_or(4, |count| count.parse().unwrap());
    // Short ones may not show themselves.
    let asked = "baseline = \"before contact\"";
    for (slopes, lengths, keys) in [
        (0.0, [0.5, 3.0], ""),
        (0.05, [0.5, 3.0], ""),
        (0.1, [3.0, 6.0], ""),
        (0.03, [0.1, 0.5], asked),
    ] {
        let held = (0..count)
            .filter(|seed| is_held(*seed, (slopes, lengths), keys))
            .count();
        let part = held as f64 / count as f64;
        eprintln!("{held} of {count} intervals hold the modulus");
        // Three standard deviations of 95 % on each side.
        let spread = 3.0 * (0.95 * 0.05 / count as f64).sqrt();
        assert!(part >= 0.95 - spread, "{slopes}: {held} of {count}");
    }
}

/// Whether the interval holds the modulus, for slopes of the baseline up to this part of that of the contact, and
/// lengths of the baseline between these multiples of the depth.
fn is_held(seed: u64, (slopes, [short, long]): (f64, [f64; 2]), keys: &str) -> bool {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut between = |low: f64, high: f64| low * (high / low).powf(random.random::<f64>());
    let (modulus, radius) = (between(300.0, 3e5), between(1e-6, 5e-6));
    let depth = radius * between(0.04, 0.1);
    let largest = hertz(modulus, radius, depth);
    let spring = largest / depth * between(0.2, 10.0);
    let before = depth * between(short, long);
    let [noise, zero] = [
        largest * between(1e-3, 0.02),
        largest * (between(0.1, 2.0) - 1.0),
    ];
    let slope = slopes * largest / depth * (between(0.1, 2.0) - 1.0);
    let start = between(300.0, 3e6);
    let end = depth + largest / spring + before;
    let mut noises = Noise(ChaCha8Rng::seed_from_u64(1000 + seed));
    let rows = (0..500).map(|i| {
        let height = end * f64::from(i) / 500.0;
        let depth = penetration(modulus, radius, spring, height - before);
        let force = hertz(modulus, radius, depth) + zero + slope * height + noises.next(noise);
        format!("{:.8e},{:.8e}\n", 1e9 * (1e-5 - height), 1e9 * force)
    });
    let curve = String::from("Height (nm),Force (nN)\n") + &rows.collect::<String>();
    let data = format!(
        "columns = {{ height = \"Height\", force = \"Force\" }}\nspring_constant = \"{spring} N/m\"\n{keys}"
    );
    let model = [&*format!("{start} Pa"), &format!("radius = \"{radius} m\"")];
    let found = fit(&curve, model, &data, "").json();
    assert_eq!(found["verdict"], "fitted", "{seed}: {found}");
    let [low, high] = interval(&found);
    (low..=high).contains(&modulus)
}
