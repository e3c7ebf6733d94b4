//! Two hundred damaged case files, and faults around a run: each gives one message and leaves no files.

use std::fs;
use std::io::Write;
use std::process::Stdio;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use super::runner::{CASE, ProgramOutput, TestFolder};

/// One way to damage a case, at a place given by a number in [0, 1).
#[derive(Debug, Clone)]
enum Damage {
    /// A letter is inserted into a key.
    Key(f64),
    /// A value is replaced by one that fits nowhere.
    Value(f64, &'static str),
    /// The unit of a quantity is replaced.
    Unit(f64, &'static str),
    /// A required line is removed.
    Line(f64),
    /// A byte that is not text is inserted.
    Byte(f64, u8),
    /// The end is cut off within a line.
    Cut(f64),
    /// A line is repeated.
    Twice(f64),
}

fn damage() -> impl Strategy<Value = Damage> {
    let at = 0.0..1.0;
    let values = vec![
        "nan",
        "-inf",
        "true",
        "[]",
        "{}",
        "\"\"",
        "\"x\"",
        "-3",
        "1e999",
        "1979-05-27",
        "[[[",
        "-0.1",
        "\"5\"",
        "\"1e400 nm\"",
        "9999999999999999999999",
    ];
    let units = vec![
        "N",
        "parsnip",
        "GPA",
        "deg",
        "nm/GPa",
        "K",
        "m m",
        "\u{1f600}",
    ];
    prop_oneof![
        at.clone().prop_map(Damage::Key),
        (at.clone(), prop::sample::select(values)).prop_map(|(at, value)| Damage::Value(at, value)),
        (at.clone(), prop::sample::select(units)).prop_map(|(at, unit)| Damage::Unit(at, unit)),
        at.clone().prop_map(Damage::Line),
        (at.clone(), 0x80..=0xff_u8).prop_map(|(at, byte)| Damage::Byte(at, byte)),
        at.clone().prop_map(Damage::Cut),
        at.prop_map(Damage::Twice),
    ]
}

/// Picks an item by a number in [0, 1).
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "an index into a few items"
)]
fn pick<T: Copy>(items: &[T], at: f64) -> T {
    items[((items.len() as f64 * at) as usize).min(items.len() - 1)]
}

/// Lines `key = value` whose value may make the case invalid; the title may be anything.
fn lines(wanted: impl Fn(&str) -> bool) -> Vec<usize> {
    let lines = CASE.lines().enumerate();
    let kept = lines.filter(|(_, line)| line.contains(" = ") && !line.starts_with("title"));
    kept.filter(|(_, line)| wanted(line))
        .map(|(i, _)| i)
        .collect()
}

fn with_line(i: usize, change: impl Fn(&str) -> String) -> Vec<u8> {
    let lines = CASE.lines().enumerate();
    let lines = lines.map(|(k, line)| {
        if k == i {
            change(line)
        } else {
            line.to_owned()
        }
    });
    (lines.collect::<Vec<_>>().join("\n") + "\n").into_bytes()
}

fn damaged(damage: &Damage) -> Vec<u8> {
    let value_of = |line: &str, value: &str| {
        let (key, _) = line.split_once(" = ").unwrap();
        format!("{key} = {value}")
    };
    match *damage {
        Damage::Key(at) => with_line(pick(&lines(|_| true), at), |line| {
            let (key, value) = line.split_once(" = ").unwrap();
            format!("{}q{} = {value}", &key[..1], &key[1..])
        }),
        Damage::Value(at, value) => {
            with_line(pick(&lines(|_| true), at), |line| value_of(line, value))
        }
        Damage::Unit(at, unit) => {
            let is_quantity = |line: &str| line.ends_with("m\"") || line.ends_with("Pa\"");
            with_line(pick(&lines(is_quantity), at), |line| {
                let (before, _) = line.rsplit_once(' ').unwrap();
                format!("{before} {unit}\"")
            })
        }
        Damage::Line(at) => {
            let needed = |line: &str| !line.starts_with("side") && !line.starts_with("elements");
            with_line(pick(&lines(needed), at), |_| String::new())
        }
        Damage::Byte(at, byte) => {
            let mut bytes = CASE.as_bytes().to_vec();
            let places: Vec<_> = (0..bytes.len()).collect();
            bytes.insert(pick(&places, at), byte);
            bytes
        }
        Damage::Cut(at) => {
            // Before the load, because everything after it has defaults.
            let end = CASE.find("[load]").unwrap();
            let places: Vec<_> = (1..end).collect();
            CASE.as_bytes()[..pick(&places, at)].to_vec()
        }
        Damage::Twice(at) => {
            with_line(pick(&lines(|_| true), at), |line| format!("{line}\n{line}"))
        }
    }
}

#[test]
fn two_hundred_damaged_cases_end_with_2_one_diagnosis_and_no_results() {
    let config = Config {
        cases: 200,
        failure_persistence: None,
        ..Config::default()
    };
    let mut runner = TestRunner::new_with_rng(
        config,
        proptest::test_runner::TestRng::deterministic_rng(
            proptest::test_runner::RngAlgorithm::ChaCha,
        ),
    );
    let checked = runner.run(&damage(), |damage| {
        let folder = TestFolder::with_case(damaged(&damage));
        let ran = folder.run(&["run", "case.toml"]);
        prop_assert_eq!(ran.code, Some(2), "{}", ran.stderr);
        let sentences = ran
            .stderr
            .lines()
            .filter(|line| line.contains("case.toml, line "));
        prop_assert_eq!(sentences.count(), 1, "{}", ran.stderr);
        prop_assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
        prop_assert_eq!(folder.names(), ["case.toml"]);
        Ok(())
    });
    if let Err(error) = checked {
        panic!("{error}");
    }
}

/// Whether the tests run as root and may write anywhere.
fn is_root() -> bool {
    let folder = TestFolder::new();
    let path = folder.path("closed");
    fs::create_dir(&path).unwrap();
    set_read_only(&path, true);
    let is_root = fs::write(path.join("a"), "").is_ok();
    set_read_only(&path, false);
    is_root
}

fn set_read_only(path: &std::path::Path, read_only: bool) {
    let mut permissions = fs::metadata(path).unwrap().permissions();
    permissions.set_readonly(read_only);
    fs::set_permissions(path, permissions).unwrap();
}

#[test]
fn an_unwritable_folder_is_reported_before_any_work() {
    if is_root() {
        let folder = TestFolder::with_case(CASE);
        // A folder cannot be made in a file.
        fs::write(folder.path("results"), "mine").unwrap();
        refused(&folder.run(&["run", "case.toml"]), "results");
        refused(
            &folder.run(&["run", "case.toml", "--out", "case.toml/a"]),
            "case.toml",
        );
        return;
    }
    let folder = TestFolder::with_case(CASE);
    let closed = folder.path("closed");
    fs::create_dir(&closed).unwrap();
    fs::copy(folder.path("case.toml"), closed.join("case.toml")).unwrap();
    set_read_only(&closed, true);
    let mut command = folder.command(&["run", "case.toml"]);
    let ran = TestFolder::ran(command.current_dir(&closed));
    set_read_only(&closed, false);
    refused(&ran, "results");
}

fn refused(ran: &ProgramOutput, name: &str) {
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert_eq!(ran.stderr.lines().count(), 1, "{}", ran.stderr);
    assert!(ran.stderr.contains(name), "{}", ran.stderr);
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported_with_exit_code_2() {
    let folder = TestFolder::with_case(CASE);
    for line in [
        &["run", "case.toml", "--json"][..],
        &["check", "case.toml"],
        &["init"],
    ] {
        let full = fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let ran = TestFolder::ran_with_stdout(&mut folder.command(line), full);
        assert_eq!(ran.code, Some(2), "{line:?}: {}", ran.stderr);
        assert!(ran.stderr.contains("standard output"), "{}", ran.stderr);
    }
}

#[test]
fn a_closed_pipe_is_not_an_error() {
    let folder = TestFolder::with_case(CASE);
    for line in [
        &["run", "case.toml", "--json", "--quiet"][..],
        &["check", "case.toml", "--set", "surface={}"],
        &["init"],
        &["man"],
        &["completions", "zsh"],
    ] {
        let mut command = folder.command(line);
        let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), &*stderr), (Some(0), ""), "{line:?}");
    }
}

#[test]
fn a_case_file_of_any_size_is_read_or_rejected() {
    let folder = TestFolder::new();
    let mut file = fs::File::create(folder.path("case.toml")).unwrap();
    file.write_all(CASE.as_bytes()).unwrap();
    let line = format!("# {}\n", "x".repeat(998));
    for _ in 0..17_000 {
        file.write_all(line.as_bytes()).unwrap();
    }
    drop(file);
    let ran = folder.run(&["check", "case.toml"]);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("larger than 16 MiB"), "{}", ran.stderr);
}
