//! A search for stresses and critical loads runs within twice the memory that `check` states.
//!
//! 3 random bodies with up to eight layers by default; for more
//!
//! ```sh
//! PELLICLE_STRESS_MEMORY=2000 cargo test --release -p pellicle-cli --test all stress_memory
//! ```

#![cfg(target_os = "linux")]

use std::process::Command;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::runner::TestFolder;

/// Number of random bodies in the short form.
const SHORT: u64 = 3;

/// A ball on a body of this many layers under a force or a penetration, with or without sliding.
fn case(random: &mut ChaCha8Rng, layers: usize, elements: usize) -> String {
    let mut between = |low: f64, high: f64| low * (high / low).powf(random.random::<f64>());
    let mut text = format!(
        "[foundation]\nsubstrate = {{ young_modulus = {}, poisson_ratio = 0.3, yield_strength = {} }}\n",
        between(0.1, 10.0),
        between(0.01, 10.0)
    );
    for _ in 0..layers {
        let layer = format!(
            "[[foundation.layer]]\nthickness = {}\nyoung_modulus = {}\npoisson_ratio = {}\n",
            between(1e-3, 10.0),
            between(0.1, 10.0),
            between(0.1, 0.49)
        );
        text.push_str(&layer);
    }
    let friction = between(0.01, 2.0);
    let friction = if friction < 0.1 { 0.0 } else { friction };
    let load = if between(0.1, 10.0) < 1.0 {
        format!("force = {}", between(1e-5, 1e-2))
    } else {
        format!("penetration = {}", between(1e-3, 1e-2))
    };
    text + &format!(
        "[indenter]\nkind = \"paraboloid\"\nradius = 1.0\n[load]\n{load}\n\
         [grid]\nelements = {elements}\n[stress]\nfriction = {friction}\n"
    )
}

/// The memory that `check` states, in MB; none if it refuses the case.
fn stated(folder: &TestFolder) -> Option<f64> {
    let found = folder.run(&["check", "case.toml"]);
    let mut lines = found.stdout.lines();
    let line = lines.find_map(|line| line.strip_prefix("# memory, about"))?;
    let mut words = line.split_whitespace();
    let number: f64 = words.next()?.parse().ok()?;
    Some(match words.next()? {
        "GB" => 1e3 * number,
        _ => number,
    })
}

#[test]
fn stresses_are_found_within_twice_the_memory_that_check_states() {
    let count = std::env::var("PELLICLE_STRESS_MEMORY");
    let count = count.map_or(SHORT, |count| count.parse().unwrap());
    let mut failures = Vec::new();
    for seed in 0..count {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        // The first has the most layers.
        let layers = if seed == 0 {
            8
        } else {
            random.random_range(0..=8)
        };
        let elements = [32, 64][random.random_range(0..2)];
        let folder = TestFolder::with_case(case(&mut random, layers, elements));
        let Some(megabytes) = stated(&folder) else {
            continue;
        };
        // In blocks of 1024 bytes; more than this is not given to the process.
        let kilobytes = 2e6 * megabytes / 1024.0;
        let script = format!("ulimit -d {kilobytes:.0}; exec \"$0\" run case.toml --json");
        let mut command = Command::new("sh");
        command
            .args(["-c", &script, env!("CARGO_BIN_EXE_pellicle")])
            .current_dir(folder.path(""))
            .env("PELLICLE_CACHE", "")
            .env("RAYON_NUM_THREADS", "1");
        let ran = TestFolder::ran(&mut command);
        // Refused or not converged, but never killed.
        if !matches!(ran.code, Some(0..=2)) || ran.stderr.contains("memory") {
            failures.push(format!(
                "{seed}: {megabytes} MB stated, {:?} {}",
                ran.code, ran.stderr
            ));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
