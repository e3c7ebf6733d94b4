//! Evaluations of readings of a continuous stiffness, each a contact of its own.

use std::fmt::Write as _;
use std::fs;

use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};
use serde_json::Value;

use super::runner::TestFolder;

/// Readings of a continuous stiffness on 72 GPa by a rigid Berkovich tip: `S = 2 E_r √(24.5/π) h_c`,
/// `P = 9.5 GPa · 24.5 h_c²`, `h = h_c + 0.75 P/S`, with a relative noise of the stiffness.
fn continuous_stiffness(count: u32, noise: f64) -> String {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut text = String::from("depth (nm),force (mN),stiffness (N/m)\n");
    let reduced = 72e9 / (1.0 - 0.17_f64.powi(2));
    for i in 0..count {
        let contact = 1e-9 * (100.0 + 2.0 * f64::from(i));
        let force = 9.5e9 * 24.5 * contact * contact;
        let stiffness = 2.0 * reduced * (24.5 / std::f64::consts::PI).sqrt() * contact;
        let depth = contact + 0.75 * force / stiffness;
        let error: f64 = StandardNormal.sample(&mut random);
        let stiffness = stiffness * (1.0 + noise * error);
        writeln!(text, "{},{},{stiffness}", depth * 1e9, force * 1e3).unwrap();
    }
    text
}

/// The readings of a file, evaluated: what the program prints, its folder, and its result.
fn readings(file: &str) -> (String, TestFolder, Value) {
    let fit = r#"
        [[data]]
        file = "csm.csv"
        columns = { depth = "depth (nm)", force = "force (mN)", stiffness = "stiffness (N/m)" }
        observe = "unloading"
        [evaluation]
        area_function = [24.5]
        poisson_ratio = 0.17
        indenter = "rigid"
    "#;
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    fs::write(folder.path("csm.csv"), file).unwrap();
    let ran = folder.run(&["identify", "fit.toml", "--out", "found"]);
    let found = fs::read(folder.path("found/fit.json")).unwrap();
    let found = serde_json::from_slice(&found).unwrap();
    (ran.stderr, folder, found)
}

#[test]
fn readings_of_a_continuous_stiffness_are_few_on_the_terminal_and_no_repeats_of_each_other() {
    let (terminal, folder, found) = readings(&continuous_stiffness(100, 0.0));
    let printed = terminal.lines().filter(|line| line.contains("E_IT = "));
    let printed: Vec<_> = printed.collect();
    assert_eq!(printed.len(), 8, "{terminal}");
    assert!(printed.iter().all(|line| line.contains("E_IT = 72.0")));
    assert!(printed[7].contains("h_c = 298.0"), "{}", printed[7]);
    assert!(terminal.contains("csm.csv: 100 readings, all in indentation.csv"));
    assert_eq!(found["indentation"].as_array().unwrap().len(), 100);
    assert_eq!(found["repeats"].as_array().unwrap().len(), 0);
    let page = fs::read_to_string(folder.path("found/report.html")).unwrap();
    assert!(page.contains("csm.csv, reading 100 of 100"));
}

#[test]
fn the_scatter_of_readings_is_their_uncertainty() {
    let (.., found) = readings(&continuous_stiffness(100, 0.02));
    let readings = found["indentation"].as_array().unwrap().iter();
    let squares = readings.map(|reading| {
        let [value, sd] = ["value", "sd"].map(|of| reading["indentation_modulus"][of].as_f64());
        ((value.unwrap() - 72e9) / sd.unwrap()).powi(2)
    });
    // A standard deviation of 32 of them each, and the scatter of a hundred.
    let mean_square = squares.sum::<f64>() / 100.0;
    assert!((0.7..1.5).contains(&mean_square), "{mean_square}");
}

#[test]
fn readings_may_stand_in_any_order_and_far_apart() {
    let noisy = continuous_stiffness(100, 0.02);
    let (head, rows) = noisy.split_once('\n').unwrap();
    let rows: Vec<&str> = rows.lines().collect();
    let of = |order: &[usize]| {
        let rows: Vec<&str> = order.iter().map(|row| rows[*row]).collect();
        let (_, _, found) = readings(&format!("{head}\n{}\n", rows.join("\n")));
        let readings = found["indentation"].as_array().unwrap();
        assert_eq!(readings.len(), order.len(), "{}", found["warnings"]);
        let number = |of: &str| readings[0]["indentation_modulus"][of].as_f64().unwrap();
        ["value", "sd"].map(number)
    };
    let in_order: Vec<usize> = (0..100).collect();
    let strewn: Vec<usize> = in_order.iter().map(|row| row * 37 % 100).collect();
    let [one, other] = [of(&in_order), of(&strewn)];
    for (one, other) in one.iter().zip(other) {
        assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    }
    // Twelve of them, from 100 to 298 nm: a fifth of a tenth beside the noise of 2 %.
    let few: Vec<usize> = (0..12).map(|n| 9 * n).collect();
    let [value, sd] = of(&few);
    assert!((0.003..0.03).contains(&(sd / value)), "{}", sd / value);
}
