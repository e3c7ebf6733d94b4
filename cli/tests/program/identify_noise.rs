//! What is told of the noise, what it hides, and what it cannot explain: intervals, outliers, curves without noise, and
//! what repeats have in common.

use std::fs;

use serde_json::Value;

use super::identify::tungsten;
use super::identify_plan::number;
use super::identify_repeats::{self, table};
use super::runner::{ProgramOutput, TestFolder};

/// A ball of 10 µm on glass, with this line for its noise.
fn ball(noise: &str) -> String {
    identify_repeats::ball(&format!("{}{noise}\n", table("ball.csv")))
}

const POINTS: usize = 60;

/// Forces from 0.1 to 4 mN.
fn forces() -> Vec<f64> {
    (0..POINTS)
        .map(|i| 1e-4 * 40_f64.powf(i as f64 / (POINTS - 1) as f64))
        .collect()
}

/// Hertz: `D = (9Q²/(16 R E*²))^⅓` for R = 10 µm, ν = 0.2.
fn depth(force: f64, modulus: f64) -> f64 {
    let plane = modulus / 0.96;
    (9.0 * force * force / (16.0 * 1e-5 * plane * plane)).cbrt()
}

/// Normal variates: a linear congruential generator and the method of G. E. P. Box and M. E. Muller, Ann. Math. Stat.
/// 29, 610 (1958).
fn normals(seed: u64) -> Vec<f64> {
    let mut state = seed;
    let mut uniform = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0
    };
    (0..20 + POINTS)
        .map(|_| (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos())
        .skip(20)
        .collect()
}

/// A folder with these depths in m, as a table in nm and mN.
fn measured(depths: &[f64]) -> TestFolder {
    let folder = TestFolder::new();
    let rows = forces().into_iter().zip(depths);
    let rows = rows.map(|(q, d)| format!("{},{}\n", 1e9 * d, 1e3 * q));
    let table = format!("depth,force\n{}", rows.collect::<String>());
    fs::write(folder.path("ball.csv"), table).unwrap();
    folder
}

fn fitted(folder: &TestFolder, fit: &str) -> (ProgramOutput, Value) {
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--out", "fit", "--force"]);
    let found = fs::read_to_string(folder.path("fit").join("fit.json"));
    let found = found.unwrap_or_else(|error| panic!("{error}: {}", ran.stderr));
    (ran, serde_json::from_str(&found).unwrap())
}

fn interval(found: &Value) -> [f64; 2] {
    [0, 1].map(|end: usize| number(&found["unknowns"][0]["interval"][end]))
}

#[test]
fn noise_told_of_the_force_alone_gives_the_interval_of_the_likelihood() {
    // Weighted least squares for ln E with a free zero: ∂D/∂ln E = −⅔ D, σ_D = ∂D/∂Q σ_Q = ⅔ (D/Q) σ_Q.
    let (sigma, modulus) = (5e-6, 70e9);
    let rows: Vec<[f64; 3]> = (forces().into_iter())
        .map(|q| {
            let d = depth(q, modulus);
            [(1.5 * q / (d * sigma)).powi(2), -2.0 * d / 3.0, 1.0]
        })
        .collect();
    let sum = |i: usize, k: usize| rows.iter().map(|row| row[0] * row[i] * row[k]).sum::<f64>();
    let information = sum(1, 1) - sum(1, 2) * sum(1, 2) / sum(2, 2);
    let half = 1.96 / information.sqrt();
    let mut at_zero = 0;
    for seed in 1..=4 {
        let pairs = forces().into_iter().zip(normals(seed));
        let depths: Vec<f64> = pairs.map(|(q, n)| depth(q + sigma * n, modulus)).collect();
        let folder = measured(&depths);
        let (ran, found) = fitted(
            &folder,
            &ball("noise = { force = \"5 uN\", correlation = \"none\" }"),
        );
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let [low, high] = interval(&found);
        let found_half = 0.5 * (high / low).ln();
        // The noise of the depth is not told, and its estimate is zero or the excess of a sample of 60.
        let ratio = found_half / half;
        assert!((0.97..1.5).contains(&ratio), "seed {seed}: {ratio}");
        at_zero += usize::from(number(&found["fit"]["noise"]["depth"]) < 1e-13);
    }
    assert!(at_zero > 0, "no estimate at its lower bound");
}

#[test]
fn an_outlier_is_named_with_its_row_and_omitted_by_the_key_that_is_named() {
    let pairs = forces().into_iter().zip(normals(3));
    let mut depths: Vec<f64> = pairs.map(|(q, n)| depth(q, 70e9) + 0.2e-9 * n).collect();
    depths[30] = 5e-6;
    let folder = measured(&depths);
    let (ran, found) = fitted(&folder, &ball(""));
    assert_eq!(ran.code, Some(3), "{}", ran.stderr);
    assert_eq!(found["verdict"], "misfit");
    let outlier = &found["fit"]["outliers"][0];
    assert_eq!(
        (&outlier["row"], &outlier["file"]),
        (&31.into(), &"ball.csv".into())
    );
    // Ten neighbours determine the value to a few tenths of the noise and of the error of the fit that was dragged.
    let expected = depth(forces()[30], 70e9);
    assert!(
        (number(&outlier["expected"]) - expected).abs() < 2e-9,
        "{outlier} {expected}"
    );
    assert!(number(&outlier["deviations"]) > 100.0, "{outlier}");
    for said in [
        "ball.csv: row 31 is an outlier: 5.000 µm",
        "data[0].omit = [31]",
    ] {
        assert!(ran.stderr.contains(said), "{said}: {}", ran.stderr);
    }
    let (ran, found) = fitted(&folder, &ball("omit = [31]"));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let excluded = serde_json::json!([{ "reason": "omitted row", "count": 1 }]);
    assert_eq!(found["fit"]["excluded"], excluded);
    assert_eq!(found["fit"]["outliers"], serde_json::json!([]));
    let [low, high] = interval(&found);
    assert!(
        low < 70e9 && 70e9 < high && high / low < 1.05,
        "{low} {high}"
    );
    // A row that the table does not have.
    fs::write(folder.path("fit.toml"), ball("omit = [61]")).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--json"]);
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.stderr.contains("data[0].omit") && ran.stderr.contains("61"),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_curve_without_noise_is_fitted_with_the_error_of_the_grid_in_its_interval() {
    let depths: Vec<f64> = forces().into_iter().map(|q| depth(q, 227.7e9)).collect();
    let folder = measured(&depths);
    // A ball itself needs no grid. With radii that differ by 1e-5 its penetration differs by the square of that.
    let oblong = |rest: &str| {
        let found = ball(rest).replace(
            "radius = \"10 um\"",
            "radii = [\"9.99995 um\", \"10.00005 um\"]",
        );
        assert!(found.contains("radii"), "{found}");
        found
    };
    let (ran, found) = fitted(&folder, &ball(""));
    assert_eq!((ran.code, &found["verdict"]), (Some(0), &"fitted".into()));
    let [low, high] = interval(&found);
    assert!(
        (low / 227.7e9 - 1.0).abs() < 1e-7 && (high / 227.7e9 - 1.0).abs() < 1e-7,
        "{low} {high}"
    );
    let (ran, found) = fitted(&folder, &oblong(""));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(found["verdict"], "fitted");
    let [low, high] = interval(&found);
    // The curve is Hertz's of 227.7 GPa; the grid errs by some 1e-4.
    assert!(
        low < 227.7e9 && 227.7e9 < high && high / low < 1.01,
        "{low} {high}"
    );
    assert!(ran.stderr.contains("Give the noise"), "{}", ran.stderr);
    let (ran, found) = fitted(&folder, &oblong("noise = { relative = 0.01 }"));
    assert_eq!(
        (ran.code, &found["verdict"]),
        (Some(0), &"fitted".into()),
        "{}",
        ran.stderr
    );
    assert!(!ran.stderr.contains("Give the noise"), "{}", ran.stderr);
}

#[test]
fn what_the_repeats_on_tungsten_have_in_common_is_a_misfit() {
    // The files read by hand: in all eight the depths from 15 to 80 µN lie to one side of the best paraboloid.
    let folder = TestFolder::new();
    for keep in ["", "[report]\noutside = \"keep\"\n"] {
        let (ran, found) = fitted(&folder, &format!("{}{keep}", tungsten()));
        assert_eq!(ran.code, Some(3), "{}", ran.stderr);
        assert_eq!(found["verdict"], "misfit");
        let common = &found["fit"]["departure"];
        assert_eq!(common["curves"], 8, "{common}");
        let [from, to] = [0, 1].map(|end: usize| number(&common["range"][end]));
        assert!(from < 30e-6 && to > 80e-6, "{common}");
        let largest = number(&common["largest"]).abs();
        assert!((0.1e-9..2e-9).contains(&largest), "{common}");
        assert!(number(&common["p"]) < 1e-3, "{common}");
        assert!(ran.stderr.contains("all 8 repeats lie"), "{}", ran.stderr);
    }
}

#[test]
fn a_misfit_by_noise_of_the_force_taken_for_one_of_the_depth_names_it() {
    // Depths from 1/50 of the largest: there ∂D/∂Q ∝ D^−½ makes the noise in depth seven times as large.
    let (largest, sigma) = (4e-3, 1.2e-5);
    let mut misfits = 0;
    for seed in 0..12 {
        let noise = (0..3).flat_map(|part| normals(100 * seed + part));
        let rows = (1..).zip(noise).map(|(row, n)| {
            let part = 0.02 + 0.98 * f64::from(row) / (3 * POINTS) as f64;
            let force = largest * part.powf(1.5);
            let depth = depth((force + sigma * n).max(0.0), 70e9);
            format!("{},{}\n", 1e9 * depth, 1e3 * force)
        });
        let folder = TestFolder::new();
        let table = format!("depth,force\n{}", rows.collect::<String>());
        fs::write(folder.path("ball.csv"), table).unwrap();
        let (ran, found) = fitted(&folder, &ball(""));
        if found["verdict"] != "misfit" {
            continue;
        }
        misfits += 1;
        let advice = "noise = { force = \"";
        let (_, told) = ran.stderr.split_once(advice).expect("the advice");
        let (told, _) = told.split_once('"').expect("a force");
        let told = format!("noise = {{ force = \"{told}\" }}");
        let (_, found) = fitted(&folder, &ball(&told));
        assert_eq!(found["verdict"], "fitted", "{told}");
    }
    assert!(misfits > 0);
}
