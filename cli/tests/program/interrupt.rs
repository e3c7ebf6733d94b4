//! Ctrl-C: the exit code, the time it takes, and the files left.
#![cfg(unix)]

use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::runner::{CASE, ProgramOutput, TestFolder};

/// More work than a test waits for.
const LONG: [&str; 4] = [
    "--set",
    "grid.elements=2048",
    "--set",
    "solver.tolerance=1e-13",
];

/// Starts the program, sends it a signal when `ready`, and waits for its end. Returns its output and the time since the
/// signal.
pub fn interrupted(
    folder: &TestFolder,
    line: &[&str],
    signal: &str,
    ready: impl Fn() -> bool,
) -> (ProgramOutput, Duration) {
    let mut command = folder.command(line);
    let child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while !ready() || start.elapsed() < Duration::from_millis(300) {
        assert!(start.elapsed() < Duration::from_mins(1), "never ready");
        sleep(Duration::from_millis(10));
    }
    let id = child.id().to_string();
    let sent = Instant::now();
    assert!(
        Command::new("kill")
            .args([signal, &id])
            .status()
            .unwrap()
            .success()
    );
    let ran = child.wait_with_output().unwrap().into();
    (ran, sent.elapsed())
}

#[test]
fn ctrl_c_ends_a_run_within_a_second_with_130_and_leaves_nothing_half_written() {
    let folder = TestFolder::with_case(CASE);
    for signal in ["-INT", "-TERM"] {
        let line = [&["run", "case.toml"][..], &LONG].concat();
        let (ran, time) = interrupted(&folder, &line, signal, || true);
        assert_eq!(ran.code, Some(130), "{}", ran.stderr);
        // A second, plus the time to start and end a process on a busy machine.
        assert!(time < Duration::from_secs(3), "{time:?}");
        assert!(ran.stderr.contains("stopp"), "{}", ran.stderr);
        assert_eq!(folder.names(), ["case.toml"]);
    }
}

#[test]
fn ctrl_c_keeps_the_finished_steps_of_a_curve_and_marks_it_incomplete() {
    let folder = TestFolder::with_case(CASE);
    // A step takes some tens of milliseconds: in a second some are done, but never all.
    let start = Instant::now();
    let a_second = || start.elapsed() > Duration::from_secs(1);
    let curve = "load={forces={from=\"0.9 uN\", to=\"1 uN\", count=10000}}";
    let line = [
        "run",
        "case.toml",
        "--out",
        "a",
        "--set",
        curve,
        "--set",
        "grid.elements=128",
    ];
    let (ran, _) = interrupted(&folder, &line, "-INT", a_second);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    let summary = folder.summary("a");
    let steps = summary["steps"].as_array().unwrap();
    assert!((1..10_000).contains(&steps.len()), "{}", steps.len());
    assert!(
        steps
            .iter()
            .all(|step| step["certificate"]["satisfied"] == true)
    );
    let warnings = summary["warnings"].as_array().unwrap();
    assert!(warnings.iter().any(|warning| warning["code"] == "stopped"));
    assert!(
        ran.stderr.contains("stopped by the user after"),
        "{}",
        ran.stderr
    );
}

#[test]
fn ctrl_c_keeps_the_finished_cases_of_a_study() {
    let folder = TestFolder::with_case(CASE);
    let study =
        "[study]\ncase = \"case.toml\"\n[study.vary]\ngrid.elements = [32, 64, 2048, 2048]\n";
    fs::write(folder.path("study.toml"), study).unwrap();
    let table = folder.path("results/study/results.csv");
    let rows = || fs::read_to_string(&table).map_or(0, |text| text.lines().count());
    let line = [
        "study",
        "study.toml",
        "--threads",
        "1",
        "--set",
        "solver.tolerance=1e-13",
    ];
    let (ran, time) = interrupted(&folder, &line, "-INT", || rows() >= 3);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    assert!(time < Duration::from_secs(3), "{time:?}");
    assert_eq!(rows(), 3);
}

#[test]
fn sigterm_finishes_the_running_cases_of_a_study_and_starts_no_other() {
    let folder = TestFolder::with_case(CASE);
    // The second case takes a second or more: it is being solved when the signal comes.
    let study = "[study]\ncase = \"case.toml\"\n[study.vary]\ngrid.elements = [32, 1024, 48]\n";
    fs::write(folder.path("study.toml"), study).unwrap();
    let table = folder.path("results/study/results.csv");
    let cases = || {
        let text = fs::read_to_string(&table).unwrap_or_default();
        let case = |line: &str| line.split(',').next().unwrap().to_owned();
        text.lines().skip(1).map(case).collect::<Vec<_>>()
    };
    let line = ["study", "study.toml", "--threads", "1", "--quiet"];
    let forces = "load={forces={from=\"0.5 uN\", to=\"1 uN\", count=20}}";
    let line = [&line[..], &["--set", forces]].concat();
    let (ran, _) = interrupted(&folder, &line, "-TERM", || cases().len() == 20);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("finishing the running cases"),
        "{}",
        ran.stderr
    );
    let found = cases();
    assert_eq!(found.len(), 40, "{found:?}");
    assert!(found[20..].iter().all(|case| case == "2"), "{found:?}");
}

#[test]
fn an_unfinished_curve_replaces_no_complete_one() {
    let folder = TestFolder::with_case(CASE);
    let first = ["run", "case.toml", "--quiet", "--out", "a"];
    assert_eq!(folder.run(&first).code, Some(0));
    let whole = fs::read(folder.path("a/summary.json")).unwrap();
    let start = Instant::now();
    let two_seconds = || start.elapsed() > Duration::from_secs(2);
    let curve = "load={forces={from=\"0.9 uN\", to=\"1 uN\", count=10000}}";
    let more = ["--force", "--set", curve, "--set", "grid.elements=128"];
    let line = [&first[..2], &first[3..], &more].concat();
    let (ran, _) = interrupted(&folder, &line, "-INT", two_seconds);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    assert_eq!(fs::read(folder.path("a/summary.json")).unwrap(), whole);
    let part = fs::read_to_string(folder.path("a/stopped/summary.json")).unwrap();
    assert!(part.contains("stopped by the user after"), "{part}");
    assert!(
        ran.stderr.contains("written to a/stopped"),
        "{}",
        ran.stderr
    );
}

#[test]
fn signals_are_handled_from_the_start_of_a_command() {
    let folder = TestFolder::new();
    // A command that reads from a pipe waits until the pipe is closed.
    let pipe = |name: &str| {
        let made = Command::new("mkfifo").arg(folder.path(name)).status();
        assert!(made.unwrap().success());
    };
    pipe("case.toml");
    for (place, name) in [
        ("plotted", "summary.json"),
        ("gathered", "study-1-of-2.json"),
    ] {
        fs::create_dir(folder.path(place)).unwrap();
        pipe(&format!("{place}/{name}"));
    }
    let lines = [
        &["check", "case.toml"][..],
        &["run", "case.toml"],
        &["study", "case.toml"],
        &["plot", "plotted"],
        &["gather", "gathered"],
        &["validate"],
    ];
    let start = |line: &&[&str]| {
        let mut command = folder.command(line);
        let command = command.stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().unwrap()
    };
    let mut children: Vec<_> = lines.iter().map(start).collect();
    sleep(Duration::from_millis(300));
    for child in &children {
        let id = child.id().to_string();
        let sent = Command::new("kill").args(["-TERM", &id]).status();
        assert!(sent.unwrap().success());
    }
    for (child, line) in children.iter_mut().zip(lines) {
        assert_eq!(child.wait().unwrap().code(), Some(130), "{line:?}");
    }
}

#[test]
fn a_study_stopped_while_it_is_planned_leaves_nothing() {
    let folder = TestFolder::with_case(CASE);
    // None of a million cases is valid, and the program searches for one.
    let force = "load.force = { from = \"-2 uN\", to = \"-1 uN\", count = 100000 }";
    let grids = "grid.elements = { from = 10, to = 100, count = 10 }";
    let study = format!("[study]\ncase = \"case.toml\"\n[study.vary]\n{force}\n{grids}\n");
    fs::write(folder.path("many.toml"), study).unwrap();
    let (ran, _) = interrupted(&folder, &["study", "many.toml"], "-TERM", || true);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    assert_eq!(folder.names(), ["case.toml", "many.toml"]);
}

#[test]
fn ctrl_c_during_the_stress_search_keeps_the_contact_and_reports_what_is_missing() {
    let folder = TestFolder::with_case(CASE);
    // The loads take a fraction of a second, their stresses take minutes.
    let start = Instant::now();
    let searching = || start.elapsed() > Duration::from_secs(3);
    let curve = "load={forces={from=\"0.9 uN\", to=\"1 uN\", count=300}}";
    let line = [
        "run",
        "case.toml",
        "--out",
        "a",
        "--fields",
        "none",
        "--pictures",
        "none",
        "--set",
        curve,
        "--set",
        "stress.friction=0.1",
    ];
    let (ran, time) = interrupted(&folder, &line, "-INT", searching);
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    assert!(time < Duration::from_secs(3), "{time:?}");
    let summary = folder.summary("a");
    assert_eq!(summary["steps"].as_array().unwrap().len(), 300);
    assert!(summary["steps"][0].get("stress").is_none());
    assert!(
        ran.stderr.contains("before all stresses were found"),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_plan_that_is_stopped_leaves_nothing() {
    let folder = TestFolder::new();
    let fit = r#"
[model]
foundation = { substrate = { young_modulus = "10 GPa", poisson_ratio = 0.3 }, layer = [{ thickness = "0.5 um", young_modulus = "100 GPa", poisson_ratio = 0.25 }] }
indenter = { kind = "paraboloid", radius = "10 um" }
[unknown]
"foundation.substrate.young_modulus" = { from = "1 GPa", to = "100 GPa" }
[report]
design = { forces = { from = "0.1 mN", to = "10 mN", count = 100 } }
"#;
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let (ran, time) = interrupted(&folder, &["identify", "fit.toml", "--plan"], "-INT", || {
        true
    });
    assert_eq!(ran.code, Some(130), "{}", ran.stderr);
    // A second, plus the time to start and end a process on a busy machine.
    assert!(time < Duration::from_secs(3), "{time:?}");
    assert_eq!(folder.names(), ["fit.toml"]);
}
