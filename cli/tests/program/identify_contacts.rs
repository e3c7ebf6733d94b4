//! Fits of a modulus to the contacts of unloadings: how each contact weighs, and what is taken as exact.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::fs;

use serde_json::Value;

use super::identify_plan::number;
use super::runner::TestFolder;

const FIT: &str = r#"
[model.foundation]
substrate = { young_modulus = "20 GPa", poisson_ratio = 0.25 }
[[data]]
file = "depth*.txt"
columns = { depth = 1, force = 2 }
observe = "unloading"
[evaluation]
area_function = [24.5]
drift = "off"
depth_zero = "as recorded"
poisson_ratio = 0.25
[unknown]
"foundation.substrate.young_modulus" = { from = "1 GPa", to = "500 GPa" }
"#;

/// A body of 15 GPa under diamond: its reduced modulus, and a hardness.
const HARDNESS: f64 = 1e9;
fn reduced() -> f64 {
    1.0 / ((1.0 - 0.25_f64.powi(2)) / 15e9 + (1.0 - 0.07_f64.powi(2)) / 1141e9)
}

fn identify(folder: &TestFolder, fit: &str) -> Value {
    fs::write(folder.path("fit.toml"), fit).unwrap();
    folder.run(&["identify", "fit.toml", "--json"]).printed()
}

/// Depths (nm) and forces (mN) of a contact of this depth (m) in a frame of this compliance (m/N): loading, hold and an
/// unloading by a power law, with a noise of 0.2 nm and 0.1 µN.
fn curve(contact_depth: f64, frame: f64, seed: f64) -> String {
    let area = 24.5 * contact_depth * contact_depth;
    let (force, stiffness) = (HARDNESS * area, 2.0 * reduced() * (area / PI).sqrt());
    let deepest = contact_depth + 0.75 * force / stiffness;
    let exponent = 1.45;
    let law =
        |part: f64| deepest - exponent * force / stiffness * (1.0 - part.powf(1.0 / exponent));
    let loading = (0..40).map(|i| f64::from(i) / 40.0);
    let loading = loading.map(|part| (0.98 * deepest * part.sqrt(), part));
    let hold = (0..20).map(|i| (deepest * (1.0 - 0.02 * (-f64::from(i) / 4.0).exp()), 1.0));
    let unloading = (0..40).map(|i| 1.0 - 0.98 * f64::from(i) / 39.0);
    let unloading = unloading.map(|part| (law(part), part));
    let mut text = String::from("Depth (nm)\tLoad (mN)\n");
    for (row, (depth, part)) in (1..).zip(loading.chain(hold).chain(unloading)) {
        // Digits that no period of the rows repeats, with a variance of one.
        let noise = |k: f64| 2.0_f64.sqrt() * (seed * 7.0 + k * f64::from(row * row)).sin();
        let force = part * force;
        let depth = (depth + frame * force) * 1e9 + 0.2 * noise(1.7);
        let force = force * 1e3 + 1e-4 * noise(2.9);
        writeln!(text, "{depth:.6}\t{force:.9}").unwrap();
    }
    text
}

#[test]
fn contacts_weigh_by_their_own_uncertainties() {
    let folder = TestFolder::new();
    for (k, depth) in (1..).zip([60e-9, 100e-9, 160e-9, 260e-9, 400e-9, 600e-9]) {
        fs::write(
            folder.path(&format!("depth{k}.txt")),
            curve(depth, 0.0, f64::from(k)),
        )
        .unwrap();
    }
    let found = identify(&folder, FIT);
    let alone = found["indentation"].as_array().unwrap().iter();
    let alone = alone.map(|of| [&of["exact"]["value"], &of["exact"]["sd"]].map(number));
    let alone: Vec<[f64; 2]> = alone.collect();
    let sds: Vec<f64> = alone.iter().map(|[_, sd]| *sd).collect();
    assert!(sds[0] > 5.0 * sds[5], "{sds:?}");
    let normal: f64 = alone.iter().map(|[_, sd]| sd.powi(-2)).sum();
    let mean = alone
        .iter()
        .map(|[value, sd]| value / sd.powi(2))
        .sum::<f64>()
        / normal;
    let half = 1.96 / normal.sqrt();
    let unknown = &found["unknowns"][0];
    let [low, high] = [0, 1].map(|end| number(&unknown["interval"][end]));
    // The scatter leaves nothing beside the uncertainties, or little.
    let ratio = (high - low) / 2.0 / half;
    assert!((0.95..1.4).contains(&ratio), "{ratio}");
    let miss = (number(&unknown["value"]) - mean) / half;
    assert!(miss.abs() < 0.3, "{miss}");
    assert!(low < 15e9 && 15e9 < high, "{low} {high}");
    assert_eq!(found["verdict"], "fitted");
    // A noise that is stated is that of all contacts.
    let stated = FIT.replace("[evaluation]", "noise = { relative = 0.02 }\n[evaluation]");
    let found = identify(&folder, &stated);
    let [low, high] = [0, 1].map(|end| number(&found["unknowns"][0]["interval"][end]));
    // d ln E/d ln S = E_r/E of the body with its ν.
    let wanted = 2.0 * 1.96 * 0.02 / 6.0_f64.sqrt() * (15e9 / (1.0 - 0.0625)) / reduced();
    assert!(
        ((high / low).ln() / wanted - 1.0).abs() < 0.05,
        "{low} {high}"
    );
}

/// Readings of a continuous stiffness on that body, with a scatter of 0.5 %.
fn rows() -> String {
    let mut rows = String::from("depth [m],force [N],stiffness [N/m]\n");
    let depths = [80e-9, 120e-9, 180e-9, 270e-9, 400e-9, 600e-9_f64];
    let scatter = [0.6, -1.0, 0.5, 0.9, -0.8, -0.3];
    for (contact_depth, scatter) in depths.into_iter().zip(scatter) {
        let area = 24.5 * contact_depth.powi(2);
        let stiffness = 2.0 * reduced() * (area / PI).sqrt() * (1.0 + 0.005 * scatter);
        let force = HARDNESS * area;
        let depth = contact_depth + 0.75 * force / stiffness;
        writeln!(rows, "{depth:e},{force:e},{stiffness:e}").unwrap();
    }
    rows
}

/// The effect of a number by `taken_as_exact`, and its value.
fn exact(found: &Value, key: &str) -> [f64; 2] {
    let all = found["taken_as_exact"].as_array().unwrap();
    let of = all.iter().find(|of| of["key"] == key);
    let of = of.unwrap_or_else(|| panic!("{key}: {all:?}"));
    [&of["exponents"][0], &of["value"]].map(number)
}

#[test]
fn area_frame_beta_and_epsilon_are_taken_as_exact_and_their_effect_is_that_of_other_ones() {
    let folder = TestFolder::new();
    fs::write(folder.path("rows.csv"), rows()).unwrap();
    let columns = "columns = { depth = 1, force = 2, stiffness = 3 }";
    let fit = FIT
        .replace("depth*.txt", "rows.csv")
        .replace("columns = { depth = 1, force = 2 }", columns)
        .replace("drift = \"off\"\n", "");
    let found = identify(&folder, &fit);
    let modulus = |found: &Value| number(&found["unknowns"][0]["value"]);
    let [_, least] = exact(&found, "evaluation.frame_compliance");
    let frame = format!("frame_compliance = \"{:e} m/N\"\narea", 0.01 * least);
    for (key, place, other) in [
        ("evaluation.area_function", "[24.5]", "[24.745]"),
        ("evaluation.frame_compliance", "area", &frame),
        ("evaluation.beta", "area", "beta = 1.01\narea"),
        ("evaluation.epsilon", "area", "epsilon = 0.7575\narea"),
    ] {
        let [exponent, _] = exact(&found, key);
        let moved = identify(&folder, &fit.replacen(place, other, 1));
        let change = (modulus(&moved) / modulus(&found)).ln() / 0.01;
        // What 1 % changes beyond its first order, and the weights.
        assert!(
            (change - exponent).abs() < 0.03 * exponent.abs() && exponent.abs() > 0.05,
            "{key}: {change} {exponent}"
        );
    }
    // What has an uncertainty is a nuisance.
    let beta = "beta = { mean = 1, sd = 0.02 }\narea";
    let uncertain = identify(&folder, &fit.replacen("area", beta, 1));
    assert!(
        !uncertain["taken_as_exact"]
            .to_string()
            .contains("evaluation.beta")
    );
    let ran = folder.run(&["identify", "fit.toml", "--out", "found"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    fs::write(folder.path("fit.toml"), &fit).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--out", "other"]);
    assert!(
        ran.stderr.contains("% in all areas moves the"),
        "{}",
        ran.stderr
    );
}

#[test]
fn the_radii_that_an_instrument_gives_are_taken_as_exact() {
    let folder = TestFolder::new();
    let table = include_str!("../../src/templates/oxide.csv");
    let fit = include_str!("../../src/templates/fit-film.toml");
    fs::write(folder.path("oxide.csv"), table).unwrap();
    let found = identify(&folder, fit);
    let [exponent, largest] = exact(&found, "data[0].columns.contact_radius");
    // No contact depth enters; what is exact has an uncertainty of zero, not of minus zero.
    assert!(!found["taken_as_exact"].to_string().contains("epsilon"));
    assert!(!found.to_string().contains("-0.0,") && !found.to_string().contains("-0.0}"));
    assert!((largest / 699.77e-9 - 1.0).abs() < 1e-6, "{largest}");
    let wider = table.lines().map(|line| match line.rsplit_once(',') {
        Some((rest, radius)) => match radius.parse::<f64>() {
            Ok(radius) => format!("{rest},{}\n", 1.01 * radius),
            Err(_) => format!("{line}\n"),
        },
        None => format!("{line}\n"),
    });
    fs::write(folder.path("oxide.csv"), wider.collect::<String>()).unwrap();
    let moved = identify(&folder, fit);
    let value = |found: &Value| number(&found["unknowns"][0]["value"]);
    let change = (value(&moved) / value(&found)).ln() / 1.01_f64.ln();
    assert!(
        (change / exponent - 1.0).abs() < 0.03,
        "{change} {exponent}"
    );
}

#[test]
fn another_poisson_ratio_than_that_of_the_top_layer_is_told_of() {
    let folder = TestFolder::new();
    fs::write(
        folder.path("oxide.csv"),
        include_str!("../../src/templates/oxide.csv"),
    )
    .unwrap();
    let fit = include_str!("../../src/templates/fit-film.toml");
    let told = |fit: &str| identify(&folder, fit)["warnings"].to_string();
    assert!(!told(fit).contains("poisson-ratio"));
    let other = fit.replace(
        "poisson_ratio = 0.17\nthinning",
        "poisson_ratio = 0.45\nthinning",
    );
    let told = told(&other);
    assert!(
        told.contains("evaluation.poisson_ratio is 0.45, and Poisson's ratio of the top layer in the model 0.17"),
        "{told}"
    );
}

#[test]
fn a_calibration_by_unloadings_does_not_warn_of_its_own_contacts() {
    let folder = TestFolder::new();
    let depths = [60e-9, 90e-9, 140e-9, 200e-9, 300e-9, 450e-9, 600e-9];
    for (k, depth) in (1..).zip(depths) {
        let text = curve(depth, 1e-6, f64::from(k));
        fs::write(folder.path(&format!("depth{k}.txt")), text).unwrap();
    }
    let (data, rest) = FIT.split_once("[evaluation]").unwrap();
    let data = data.split_once("[[data]]").unwrap().1;
    let calibration = rest.split_once("[unknown]").unwrap().0.replace(
        "area_function = [24.5]",
        "calibrate = { young_modulus = \"15 GPa\", coefficients = 1 }",
    );
    let fit = format!("[[data]]{data}[evaluation]{calibration}");
    let told = |fit: &str| identify(&folder, fit)["warnings"].to_string();
    let warnings = told(&fit);
    assert!(!warnings.contains("area-not-calibrated"), "{warnings}");
    // Other contacts far outside are told of.
    let ran = folder.run(&["identify", "fit.toml", "--out", "tip"]);
    assert!(
        folder.path("tip/calibration.toml").is_file(),
        "{}",
        ran.stderr
    );
    fs::write(folder.path("depth8.txt"), curve(900e-9, 1e-6, 8.0)).unwrap();
    let tip = "area_function = \"tip/calibration.toml\"";
    let (before, after) = fit.split_once("calibrate").unwrap();
    let other = format!("{before}{tip}\n{}", after.split_once('\n').unwrap().1);
    let warnings = told(&other);
    assert!(
        warnings.contains("depth8.txt: 1 contact depth outside those of the area function"),
        "{warnings}"
    );
}
