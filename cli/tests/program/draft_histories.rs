//! Drafts of curves with cycles, holds, reversed signs and sensitivities in their heads, up to the modulus.

use std::fs;

use serde_json::Value;

use super::runner::TestFolder;

/// Fused silica under an ideal Berkovich tip.
const MODULUS: f64 = 72e9;
const RATIO: f64 = 0.17;
const HARDNESS: f64 = 9.5e9;
/// The exponent of the unloadings.
const EXPONENT: f64 = 1.35;

/// Deterministic numbers in [−1, 1].
fn ripple(row: usize) -> f64 {
    let turn = row as f64;
    0.5 * ((2.399 * turn).sin() + (5.171 * turn).cos())
}

/// The largest and the final depth (m) under a force, N, by the relations of Oliver and Pharr.
fn depths(force: f64) -> [f64; 2] {
    let area = force / HARDNESS;
    let contact = (area / 24.5).sqrt();
    let diamond = (1.0 - 0.07 * 0.07) / 1141e9;
    let reduced = 1.0 / ((1.0 - RATIO * RATIO) / MODULUS + diamond);
    let stiffness = 2.0 / std::f64::consts::PI.sqrt() * reduced * area.sqrt();
    let deepest = contact + 0.75 * force / stiffness;
    [deepest, deepest - EXPONENT * force / stiffness]
}

/// Cycles up to these forces, unloaded to a fifth in between, with a hold of 20 s and 4 nm of creep at half of the
/// last.
fn cycles(forces: &[f64]) -> String {
    let mut rows: Vec<[f64; 2]> = Vec::new();
    let mut last: f64 = 0.0;
    let mut creep = 0.0;
    for (cycle, top) in forces.iter().enumerate() {
        let is_last = cycle + 1 == forces.len();
        let from = 0.2 * last;
        let [deepest_before, final_before] = depths(last.max(1e-30));
        for i in 0..150 {
            let force = from + (top - from) * f64::from(i) / 150.0;
            // Up to the force before, the way back of the last unloading.
            let depth = if force < last {
                let part = (force / last).powf(1.0 / EXPONENT);
                final_before + (deepest_before - final_before) * part
            } else {
                depths(force)[0]
            };
            rows.push([depth + creep, force]);
            if is_last && i == 75 {
                for k in 1..=200 {
                    creep = 4e-9 * (f64::from(k) / 200.0).sqrt();
                    rows.push([depth + creep, force]);
                }
            }
        }
        let [deepest, left] = depths(*top);
        let end = if is_last { 0.02 } else { 0.2 };
        for i in 0..=120 {
            let force = top * (1.0 - (1.0 - end) * f64::from(i) / 120.0);
            let depth = left + (deepest - left) * (force / top).powf(1.0 / EXPONENT);
            rows.push([depth + creep, force]);
        }
        last = *top;
    }
    let line = |(row, [depth, force]): (usize, &[f64; 2])| {
        let time = 0.1 * row as f64;
        let [h, p] = [
            depth * 1e9 + 0.05 * ripple(row),
            force * 1e3 + 1e-4 * ripple(row + 7),
        ];
        format!("{time:.2},{h:.4},{p:.6}\n")
    };
    String::from("Time (s),Displacement Into Surface (nm),Load On Sample (mN)\n")
        + &rows.iter().enumerate().map(line).collect::<String>()
}

/// Drafts a fit file for a curve and runs it with some of its words replaced.
fn drafted(curve: &str, replaced: &[(&str, &str)]) -> (String, Value) {
    let folder = TestFolder::new();
    fs::write(folder.path("curve.txt"), curve).unwrap();
    let ran = folder.run(&["init", "fit", "--from", "curve.txt"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let mut fit = fs::read_to_string(folder.path("curve.toml")).unwrap();
    for (old, new) in replaced {
        assert!(fit.contains(old), "{old}: {fit}");
        fit = fit.replace(old, new);
    }
    fs::write(folder.path("curve.toml"), &fit).unwrap();
    (
        fit,
        folder.run(&["identify", "curve.toml", "--json"]).json(),
    )
}

#[test]
fn every_cycle_has_the_modulus_of_the_body_and_creep_under_a_first_load_is_no_drift() {
    for forces in [&[8e-3][..], &[1e-3, 2e-3, 4e-3, 8e-3]] {
        let ratio = [("poisson_ratio = 0.25", "poisson_ratio = 0.17")];
        let (fit, found) = drafted(&cycles(forces), &ratio);
        let all = found["indentation"].as_array().unwrap();
        assert_eq!(all.len(), forces.len(), "{fit}\n{found}");
        for (cycle, (one, force)) in all.iter().zip(forces).enumerate() {
            let number = |key: &str| one[key]["value"].as_f64().unwrap();
            assert!((number("max_force") / force - 1.0).abs() < 2e-3, "{one}");
            // The creep is an eighth of the depth of the first contacts, and none of these.
            let creep = if cycle + 1 == forces.len() { 4e-9 } else { 0.0 };
            let deeper = 1.0 + creep / depths(*force)[0];
            for (key, truth, power) in [
                ("indentation_modulus", MODULUS, 1.0),
                ("indentation_hardness", HARDNESS, 2.0),
            ] {
                let wanted = truth / deeper.powf(power);
                assert!((number(key) / wanted - 1.0).abs() < 0.02, "{key}: {one}");
            }
            assert!(number("drift_rate").abs() < 1e-30, "{one}");
        }
    }
}

/// An approach of a ball of 5 µm on a body of 20 kPa, in columns of height (nm) and a deflection or a force.
fn approach(head: &str, load: impl Fn(f64) -> f64) -> String {
    let (radius, modulus, spring) = (5e-6_f64, 20e3 / 0.75, 0.1);
    let row = |i: usize| {
        let height = -600e-9 + 1e-9 * 4.0 * i as f64;
        let [mut low, mut high] = [0.0, height.max(0.0)];
        for _ in 0..60 {
            let depth = 0.5 * (low + high);
            let force = 4.0 / 3.0 * modulus * radius.sqrt() * f64::powf(depth, 1.5);
            if depth + force / spring < height {
                low = depth;
            } else {
                high = depth;
            }
        }
        let force = 4.0 / 3.0 * modulus * radius.sqrt() * f64::powf(low, 1.5);
        let force = force + 5e-12 * ripple(i);
        format!("{:.4}\t{:.8}\n", 1e9 * height, load(force))
    };
    head.to_owned() + &(0..300).map(row).collect::<String>()
}

#[test]
fn a_reversed_force_and_the_sensitivity_of_a_head_are_understood() {
    let head = "Spring constant (N/m): 0.1\nTip radius (um): 5\n";
    let reversed = approach(&format!("{head}Z (nm)\tForce (nN)\n"), |force| -1e9 * force);
    let sensitivity = format!("Deflection sensitivity (nm/V): 60\n{head}Z (nm)\tDeflection (V)\n");
    let in_volts = approach(&sensitivity, |force| force / 0.1 / 60e-9);
    for (curve, key) in [
        (reversed, "units = { force = \"-1 nN\" }"),
        (in_volts, "units = { deflection = \"60 nm/V\" }"),
    ] {
        let (fit, found) = drafted(&curve, &[]);
        assert!(fit.contains(key), "{fit}");
        let modulus = found["unknowns"][0]["value"].as_f64().unwrap();
        assert!((modulus / 20e3 - 1.0).abs() < 0.01, "{found}");
    }
}

#[test]
fn a_retraction_before_the_approach_reverses_no_sign() {
    let head = "Spring constant (N/m): 0.1\nTip radius (um): 5\nZ (nm)\tForce (nN)\n";
    let way_in = approach(head, |force| 1e9 * force);
    let (lines, rows) = (
        head.lines().count(),
        way_in.lines().skip(head.lines().count()),
    );
    let rows: Vec<&str> = rows.collect();
    let mut way_out: Vec<String> = rows.iter().rev().map(|row| (*row).to_owned()).collect();
    // The lowest force of the file is noise far from the contact.
    way_out[290] = way_out[290].split('\t').next().unwrap().to_owned() + "\t-0.09";
    let kept = way_in.lines().take(lines).map(str::to_owned);
    let whole: Vec<String> = (kept.chain(way_out))
        .chain(rows.iter().map(|row| (*row).to_owned()))
        .collect();
    let folder = TestFolder::new();
    fs::write(folder.path("curve.txt"), whole.join("\n") + "\n").unwrap();
    let ran = folder.run(&["init", "fit-afm", "--from", "curve.txt"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let fit = fs::read_to_string(folder.path("curve.toml")).unwrap();
    assert!(!fit.contains("-1 nN"), "{fit}");
}

#[test]
fn a_loading_of_a_sharp_tip_on_a_hard_body_is_told_to_be_that_of_an_imprint() {
    let loading = cycles(&[8e-3]);
    let loading: String = loading
        .lines()
        .take(70)
        .map(|line| line.to_owned() + "\n")
        .collect();
    let (_, found) = drafted(&loading, &[]);
    let warnings = found["warnings"].as_array().unwrap();
    let warning = warnings
        .iter()
        .find(|of| of["code"] == "sharp-tip")
        .unwrap();
    let message = warning["message"].as_str().unwrap();
    assert!(message.contains("pellicle init fit-unloading"), "{message}");
}
