//! `study` and `gather`: killed at random times, in parts, with failing cases.

use std::fs;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::runner::{CASE, TestFolder, names};

/// 40 cases, of which the four with the widest cylinders overlap.
const STUDY: &str = r#"[study]
case = "case.toml"

[study.vary]
load.force = { from = "0.5 uN", to = "5 uN", count = 10, spacing = "log" }
surface.radius = ["10 nm", "15 nm", "20 nm", "26 nm"]
"#;

const CASES: usize = 40;
const FAILED: usize = 10;

fn folder() -> TestFolder {
    TestFolder::with_study(CASE.replace("elements = 32", "elements = 64"), STUDY)
}

fn table(folder: &TestFolder, name: &str) -> String {
    fs::read_to_string(folder.path(&format!("results/many/{name}"))).unwrap()
}

/// The table of an undisturbed study.
fn undisturbed() -> String {
    let folder = folder();
    let ran = folder.study(&["--threads", "2"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    table(&folder, "results.csv")
}

/// A reproducible sequence of pseudorandom numbers in [0, 1).
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        // Knuth's MMIX generator.
        let Self(state) = self;
        *state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn a_study_killed_ten_times_ends_with_the_table_of_an_uninterrupted_one() {
    let (folder, expected) = (folder(), undisturbed());
    let whole = {
        let start = Instant::now();
        let other = self::folder();
        other.study(&["--threads", "2"]);
        start.elapsed()
    };
    let mut chance = Chance(1);
    let mut kills = 0;
    for _ in 0..10 {
        let mut child = start(&folder);
        // In the first fifth, so that work is left for later kills.
        sleep(whole.mul_f64(0.02 + 0.18 * chance.next()));
        if child.try_wait().unwrap().is_none() {
            kills += 1;
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(kills >= 3, "{kills}");
    let ran = folder.study(&["--threads", "2"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert_eq!(table(&folder, "results.csv"), expected);
    assert_eq!(
        names(&folder.path("results/many")),
        ["report.html", "results.csv", "study.json"]
    );
}

fn start(folder: &TestFolder) -> Child {
    let line = ["study", "many.toml", "--quiet", "--threads", "2"];
    folder.command(&line).spawn().unwrap()
}

#[test]
fn a_failed_case_is_recorded_and_does_not_stop_the_others() {
    let folder = folder();
    let ran = folder.run(&["study", "many.toml", "--json"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(1), ""));
    let report: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(
        (&report["cases"], &report["failed"]),
        (&CASES.into(), &FAILED.into())
    );
    assert_eq!(report["certified"], CASES - FAILED);
    let table = table(&folder, "results.csv");
    let lines: Vec<_> = table.lines().collect();
    assert!(lines[0].starts_with(
        "case,status,load.force [N],surface.radius [m],step,force [N],force error [N],"
    ));
    assert_eq!(lines.len(), 1 + CASES);
    let first = lines[1].strip_prefix("1,certified,5e-7,1e-8,0,");
    assert_eq!(first.unwrap().split(',').next(), Some("5e-7"));
    assert!(
        lines[4].starts_with("4,failed,5e-7,2.6e-8,,"),
        "{}",
        lines[4]
    );
    assert!(lines[4].contains("overlap"), "{}", lines[4]);
    // Finished cases are not solved again.
    let again = Instant::now();
    assert_eq!(folder.study(&[]).code, Some(1));
    assert!(again.elapsed() < Duration::from_secs(5));
    assert_eq!(self::table(&folder, "results.csv"), table);
}

#[test]
fn two_merged_parts_are_the_whole_and_share_no_case() {
    let (folder, expected) = (folder(), undisturbed());
    assert_eq!(folder.study(&["--shard", "1/2"]).code, Some(1));
    let early = folder.run(&["gather", "results/many"]);
    assert_eq!(early.code, Some(1), "{}", early.stderr);
    assert!(early.stderr.contains("20 to do"), "{}", early.stderr);
    assert_eq!(folder.study(&["--shard", "2/2"]).code, Some(1));
    let [first, second] = [1, 2].map(|i| {
        table(&folder, &format!("results-{i}-of-2.csv"))
            .lines()
            .count()
    });
    assert_eq!((first, second), (1 + CASES / 2, 1 + CASES / 2));
    let gathered = folder.run(&["gather", "results/many"]);
    assert_eq!(gathered.code, Some(1), "{}", gathered.stderr);
    assert_eq!(table(&folder, "results.csv"), expected);
    // The whole study counts as done.
    assert_eq!(folder.study(&[]).code, Some(1));
    assert_eq!(table(&folder, "results.csv"), expected);
}

#[test]
fn results_of_another_study_are_kept_unless_started_afresh() {
    let folder = folder();
    let small = STUDY
        .replace("count = 10", "count = 2")
        .replace(", \"26 nm\"", "");
    fs::write(folder.path("many.toml"), &small).unwrap();
    assert_eq!(folder.study(&[]).code, Some(0));
    let first = table(&folder, "results.csv");
    fs::write(folder.path("many.toml"), small.replace("15 nm", "16 nm")).unwrap();
    let refused = folder.study(&[]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("--fresh"), "{}", refused.stderr);
    assert_eq!(table(&folder, "results.csv"), first);
    assert_eq!(folder.study(&["--fresh"]).code, Some(0));
    assert_ne!(table(&folder, "results.csv"), first);
}

#[test]
fn a_killed_fresh_study_leaves_the_old_table() {
    let folder = folder();
    let study_of = |grids: &str| {
        format!("[study]\ncase = \"case.toml\"\n[study.vary]\ngrid.elements = {grids}\n")
    };
    fs::write(folder.path("many.toml"), study_of("[32, 48]")).unwrap();
    assert_eq!(folder.study(&[]).code, Some(0));
    let first = table(&folder, "results.csv");
    // The second case takes longer than the test waits.
    let long = [
        "--fresh",
        "--threads",
        "1",
        "--set",
        "solver.tolerance=1e-13",
    ];
    fs::write(folder.path("many.toml"), study_of("[32, 2048]")).unwrap();
    let line = [&["study", "many.toml", "--quiet"], &long[..]].concat();
    for _ in 0..2 {
        let mut child = folder.command(&line).spawn().unwrap();
        let start = Instant::now();
        let lines = || fs::read_to_string(folder.path("results/many/results.csv"));
        while !lines().is_ok_and(|text| text.lines().count() == 2) {
            assert!(start.elapsed() < Duration::from_mins(1), "no first case");
            sleep(Duration::from_millis(10));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        assert_eq!(table(&folder, ".pellicle-before-results.csv"), first);
    }
    fs::write(folder.path("many.toml"), study_of("[32, 40]")).unwrap();
    assert_eq!(folder.study(&["--fresh"]).code, Some(0));
    assert_eq!(
        names(&folder.path("results/many")),
        ["report.html", "results.csv", "study.json"]
    );
}

#[test]
fn an_invalid_study_leaves_nothing() {
    let folder = folder();
    for (from, to) in [
        ("load.force", "load.froce"),
        ("case.toml", "nothing.toml"),
        ("count = 10", "count = 0"),
        ("[study.vary]", "[study.varies]"),
    ] {
        fs::write(folder.path("many.toml"), STUDY.replace(from, to)).unwrap();
        let ran = folder.study(&[]);
        assert_eq!(ran.code, Some(2), "{to}: {}", ran.stderr);
        assert_eq!(folder.names(), ["case.toml", "many.toml"]);
    }
    let run = folder.run(&["run", "many.toml"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("pellicle study FILE"), "{}", run.stderr);
}

#[test]
fn a_study_is_not_written_into_a_foreign_folder() {
    let folder = folder();
    let ran = folder.study(&["--out", "."]);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert_eq!(folder.names(), ["case.toml", "many.toml"]);
}

#[test]
fn the_cases_can_be_listed_and_have_folders_of_their_own() {
    let folder = folder();
    fs::write(
        folder.path("many.toml"),
        STUDY.replace("count = 10", "count = 2"),
    )
    .unwrap();
    let listed = folder.study(&["--list"]).stdout;
    let lines: Vec<_> = listed.lines().collect();
    assert_eq!(lines.len(), 8);
    assert_eq!(
        lines[2],
        "case 3: load.force = 500.00 nN, surface.radius = 20 nm"
    );
    let ran = folder.study(&["--folders"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let cases = folder.path("results/many/cases");
    // The fourth and the eighth case fail.
    assert_eq!(names(&cases).len(), 6);
    assert!(cases.join("case-0007/summary.json").exists());
}

#[test]
fn the_study_template_is_a_valid_study() {
    let folder = TestFolder::new();
    let template = folder.run(&["init", "study", "--out", "study.toml"]);
    assert_eq!(template.code, Some(0));
    let listed = folder.run(&["study", "study.toml", "--list"]);
    assert_eq!((listed.code, listed.stdout.lines().count()), (Some(0), 12));
}

#[test]
fn samples_from_a_file_give_the_table_of_the_same_values_zipped() {
    let folder = folder();
    let zipped = "[study]\ncase = \"case.toml\"\ncombine = \"zip\"\n[study.vary]\n\
                  load.force = [\"1 uN\", \"3 uN\", \"2 uN\"]\nsurface.radius = [\"10 nm\", \"20 nm\", \"15 nm\"]\n";
    fs::write(folder.path("many.toml"), zipped).unwrap();
    assert_eq!(folder.study(&[]).code, Some(0));
    let expected = table(&folder, "results.csv");
    let sampled = "[study]\ncase = \"case.toml\"\n[study.vary]\nfrom = \"samples.csv\"\n";
    fs::write(folder.path("many.toml"), sampled).unwrap();
    let samples = "load.force [uN],surface.radius\n1,10 nm\n3,20 nm\n2,15 nm\n";
    fs::write(folder.path("samples.csv"), samples).unwrap();
    assert_eq!(folder.study(&["--fresh"]).code, Some(0));
    assert_eq!(table(&folder, "results.csv"), expected);
    // Other samples make another study.
    fs::write(folder.path("samples.csv"), samples.replace("3,", "4,")).unwrap();
    let refused = folder.study(&[]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    fs::write(folder.path("samples.csv"), samples.replace("3,", "x,")).unwrap();
    let wrong = folder.study(&[]);
    assert_eq!(wrong.code, Some(2));
    let wanted = "line 3, key `load.force`: found \"x\", wanted a number, whose unit is uN";
    assert!(wrong.stderr.contains(wanted), "{}", wrong.stderr);
}

#[test]
fn an_invalid_value_is_reported_before_solving_and_recorded() {
    let folder = folder();
    let text = "[study]\ncase = \"case.toml\"\n[study.vary]\nload.force = [\"1 uN\", \"-1 uN\"]\n";
    fs::write(folder.path("many.toml"), text).unwrap();
    let ran = folder.run(&["study", "many.toml"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let first = ran.stderr.lines().next().unwrap();
    assert!(
        first.starts_with("warning: case 2 is invalid and will be recorded as failed"),
        "{first}"
    );
    assert!(first.contains("load.force"), "{first}");
    let table = table(&folder, "results.csv");
    assert!(table.lines().nth(2).unwrap().starts_with("2,failed,"));
}

#[test]
fn the_status_counts_the_cases_of_all_parts_while_they_are_solved() {
    let folder = folder();
    let status = || -> Value { folder.study(&["--status", "--json"]).json() };
    assert_eq!(status()["certified"], 0);
    assert!(!folder.path("results").exists());
    let task = [
        ("SLURM_ARRAY_TASK_ID", "1"),
        ("SLURM_ARRAY_TASK_COUNT", "2"),
        ("SLURM_ARRAY_TASK_MIN", "1"),
    ];
    let line = [
        "study",
        "many.toml",
        "--quiet",
        "--shard",
        "auto",
        "--tolerate-failures",
    ];
    let ran = TestFolder::ran(folder.command(&line).envs(task));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let found = status();
    let done = found["certified"].as_u64().unwrap() + found["failed"].as_u64().unwrap();
    assert_eq!((done, &found["cases"]), (20, &CASES.into()));
    assert_eq!(found["parts_at_work"], 0);
    // The other part's cases, except the first, take longer than the test waits.
    let text = "[study]\ncase = \"case.toml\"\n[study.vary]\ngrid.elements = [32, 2048]\n";
    fs::write(folder.path("many.toml"), text).unwrap();
    let long = ["--threads", "1", "--set", "solver.tolerance=1e-13"];
    let line = [
        &["study", "many.toml", "--quiet", "--out", "long"],
        &long[..],
    ]
    .concat();
    let mut child = folder.command(&line).spawn().unwrap();
    let start = Instant::now();
    let found = loop {
        let more = ["--status", "--json", "--out", "long"];
        let ran = folder.study(&[&more[..], &long].concat());
        let found: Value = serde_json::from_str(&ran.stdout).unwrap();
        if found["certified"] == 1 || found["not_converged"] == 1 {
            break found;
        }
        assert!(start.elapsed() < Duration::from_mins(1), "{found}");
    };
    assert_eq!(found["parts_at_work"], 1);
    assert!(found["cases_per_second"].as_f64().unwrap() > 0.0, "{found}");
    assert!(found["seconds_left"].as_f64().unwrap() > 0.0, "{found}");
    let people = folder.study(&[&["--status", "--out", "long"][..], &long].concat());
    assert!(
        people.stdout.contains("1 to do; 1 part at work, "),
        "{}",
        people.stdout
    );
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn shard_auto_requires_a_slurm_task() {
    let folder = folder();
    let mut command = folder.command(&["study", "many.toml", "--shard", "auto"]);
    for name in ["SLURM_ARRAY_TASK_ID", "SLURM_PROCID"] {
        command.env_remove(name);
    }
    let ran = TestFolder::ran(&mut command);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("SLURM_ARRAY_TASK_ID"), "{}", ran.stderr);
    assert_eq!(folder.names(), ["case.toml", "many.toml"]);
}
