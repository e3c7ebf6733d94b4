//! Processor time of a study relative to bare solves of its cases, which run one after the other in one process on one
//! thread. Both are measured in pairs; the resolved cases of the bare solves are prepared beforehand.
//!
//! `cargo bench -p pellicle-cli --bench study_rate -- 20000 3`: cases and pairs; with `2000 3 bodies`, each case has a
//! layer of its own thickness, and so tables of its own. Linux only.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a measurement that cannot go on has failed, and its numbers are printed"
)]

use std::fs;
use std::path::Path;
use std::process::Command;

use pellicle::Case;
use pellicle_contact::solve_path;
use pellicle_influence::Cache;

/// A ball on a hard coating, 32 elements per side.
const BASE: &str = r#"
[foundation]
substrate = { young_modulus = "3 GPa", poisson_ratio = 0.35 }
[[foundation.layer]]
thickness = "1 um"
young_modulus = "200 GPa"
poisson_ratio = 0.25
[indenter]
kind = "sphere"
radius = "0.5 mm"
[load]
force = "1 mN"
[grid]
elements = 32
"#;

/// Loads of one radius.
const LOADS: usize = 100;

fn main() {
    let numbers = std::env::args().filter_map(|argument| argument.parse::<usize>().ok());
    let numbers: Vec<_> = numbers.collect();
    let count = numbers.first().copied().unwrap_or(20_000) / LOADS * LOADS;
    let pairs = numbers.get(1).copied().unwrap_or(3);
    let folder = tempfile::tempdir().unwrap();
    let base = folder.path().join("base.toml");
    fs::write(&base, BASE).unwrap();
    let keys = if std::env::args().any(|argument| argument == "bodies") {
        let thickness = |i: usize| format!("{} nm", 1000.0 + i as f64 / 100.0);
        vec![Key::varied(
            "foundation.layer[0].thickness",
            count,
            thickness,
        )]
    } else {
        let radius = |i: usize| format!("{} um", 400 + i);
        let force = |i: usize| format!("{} uN", 1000 + 70 * i);
        vec![
            Key::varied("indenter.radius", count / LOADS, radius),
            Key::varied("load.force", LOADS, force),
        ]
    };
    fs::write(folder.path().join("many.toml"), study(&keys)).unwrap();
    let case = |i| Case::read(&base, &sets(&keys, i)).unwrap();
    let cases: Vec<_> = (0..count).map(case).collect();
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .unwrap();
    println!("{count} cases: processor time of the bare solves, of the study, and their ratio");
    for _ in 0..pairs {
        // Run on a thread of the pool: from outside, every parallel step would wait for another thread.
        let [bare, _] = timed(|| rayon::scope(|_| solve_all(&cases)));
        let [_, study] = timed(|| run_study(folder.path()));
        println!("{bare:.2} s  {study:.2} s  {:.3}", bare / study);
    }
}

/// A key of the case and its values in the study.
struct Key {
    name: &'static str,
    values: Vec<String>,
}

impl Key {
    fn varied(name: &'static str, count: usize, value: impl Fn(usize) -> String) -> Self {
        Self {
            name,
            values: (0..count).map(value).collect(),
        }
    }
}

/// The text of the study.
fn study(keys: &[Key]) -> String {
    let line = |key: &Key| format!("\"{}\" = {:?}\n", key.name, key.values);
    let lines: String = keys.iter().map(line).collect();
    format!("[study]\ncase = \"base.toml\"\n[study.vary]\n{lines}")
}

/// The values of one case; those of the last key change first.
fn sets(keys: &[Key], mut case: usize) -> Vec<String> {
    let set = |key: &Key| {
        let value = &key.values[case % key.values.len()];
        case /= key.values.len();
        format!("{}={value}", key.name)
    };
    keys.iter().rev().map(set).collect()
}

fn solve_all(cases: &[Case]) {
    let cache = Cache::in_memory();
    for case in cases {
        let model = case.model(&cache).unwrap().value;
        let domain = case.domain(&model).unwrap();
        let (loads, options) = (case.loads(), case.solver_options());
        let path = solve_path(
            &model,
            domain,
            case.grid.elements,
            &loads,
            &options,
            &mut (),
        );
        assert!(path.unwrap().steps[0].solution.certificate.is_satisfied());
    }
}

fn run_study(folder: &Path) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pellicle"));
    command.args(["study", "many.toml", "--quiet", "--fresh", "--threads", "2"]);
    let ran = command
        .current_dir(folder)
        .env("PELLICLE_CACHE", "")
        .status();
    assert!(ran.unwrap().success());
}

/// Processor time in seconds used by some work in this process and in children that it waits for.
fn timed(work: impl FnOnce()) -> [f64; 2] {
    let before = processor_times();
    work();
    let after = processor_times();
    [0, 1].map(|i| after[i] - before[i])
}

/// `proc_pid_stat(5)`: user and system time in ticks of 10 ms, in fields 14 to 17.
fn processor_times() -> [f64; 2] {
    let stat = fs::read_to_string("/proc/self/stat").unwrap();
    let (_, fields) = stat.rsplit_once(')').unwrap();
    let ticks: Vec<f64> = fields
        .split_whitespace()
        .skip(11)
        .take(4)
        .map(|ticks| ticks.parse().unwrap())
        .collect();
    [ticks[0] + ticks[1], ticks[2] + ticks[3]].map(|ticks| ticks / 100.0)
}
