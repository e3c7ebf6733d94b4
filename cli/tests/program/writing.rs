//! The files written by a run: their choice, size and time, and interruption.

use std::fs;
use std::time::Instant;

use serde_json::Value;

use super::runner::{CASE, TestFolder, names};

/// Three loads.
const LOADS: &str = "load={forces=[\"1 uN\", \"2 uN\", \"4 uN\"]}";

fn run(folder: &TestFolder, out: &str, more: &[&str]) -> String {
    let ran = folder.run(&[&["run", "case.toml", "--out", out], more].concat());
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    ran.stderr
}

/// The steps with a file whose name has this start and end.
fn steps(folder: &TestFolder, out: &str, start: &str, end: &str) -> Vec<String> {
    let names = names(&folder.path(out)).into_iter();
    let step = |name: String| Some(name.strip_prefix(start)?.strip_suffix(end)?.to_owned());
    names.filter_map(step).collect()
}

#[test]
fn fields_and_pictures_are_of_the_last_step_unless_more_are_requested() {
    let folder = TestFolder::with_case(CASE);
    run(&folder, "last", &["--set", LOADS]);
    assert_eq!(steps(&folder, "last", "fields-", ".npz"), ["002"]);
    assert_eq!(steps(&folder, "last", "section-", ".png"), ["002"]);
    assert_eq!(steps(&folder, "last", "fields-", "").join(" "), "002.npz");
    assert!(folder.path("last/curve.png").is_file());
    let flags = [
        "--set",
        LOADS,
        "--fields",
        "all",
        "--pictures",
        "none",
        "--formats",
        "vti",
    ];
    run(&folder, "flags", &flags);
    assert_eq!(steps(&folder, "flags", "fields-", ".vti").len(), 3);
    let pictures = names(&folder.path("flags")).into_iter();
    assert_eq!(pictures.filter(|name| name.ends_with('g')).count(), 0);
    assert!(folder.path("flags/report.html").is_file());
}

#[test]
fn the_case_sets_what_is_written_and_in_which_formats() {
    let output = "[output]\nfields = \"all\"\npictures = \"all\"\nformats = [\"vti\", \"npz\"]\n";
    let folder = TestFolder::with_case(format!("{CASE}{output}"));
    run(&folder, "a", &["--set", LOADS]);
    assert_eq!(steps(&folder, "a", "fields-", ".npz").len(), 3);
    assert_eq!(steps(&folder, "a", "pressure-3d-", ".svg").len(), 3);
    for (prefix, ending) in [("fields-", ".nc"), ("pressure-", ".gsf")] {
        assert!(steps(&folder, "a", prefix, ending).is_empty());
    }
    let wanted = serde_json::json!({"fields": "all", "pictures": "all", "formats": ["npz", "vti"]});
    assert_eq!(folder.summary("a")["case"]["output"], wanted);
}

#[test]
fn the_last_line_names_the_report_which_opens_at_the_last_step() {
    let folder = TestFolder::with_case(CASE);
    let printed = run(&folder, "a", &["--set", LOADS, "--pictures", "all"]);
    let last = printed.trim_end().lines().last().unwrap();
    let named = last.strip_prefix("report: ").unwrap();
    let page = fs::read_to_string(folder.path(named)).unwrap();
    assert!(page.contains("<option value=\"step-2\" selected>step 2, Q = 4.0000 µN"));
    assert_eq!(page.matches(" selected>").count(), 1);
}

#[test]
fn the_total_time_includes_writing() {
    let folder = TestFolder::with_case(CASE);
    let start = Instant::now();
    run(&folder, "a", &["--set", LOADS, "--pictures", "all"]);
    let passed = start.elapsed().as_secs_f64();
    let timing = &folder.summary("a")["timing"];
    let total = timing["total_seconds"].as_f64().unwrap();
    // Nine pictures take many times as long as three loads on 32 × 32 elements: most of the time of the process.
    assert!(
        total <= passed && total > 0.5 * passed,
        "{total} of {passed}"
    );
}

#[test]
fn check_estimates_the_disk_space_of_a_run() {
    let folder = TestFolder::with_case(CASE);
    let many = [
        "--set",
        LOADS,
        "--set",
        "grid.elements=128",
        "--set",
        "output.fields=\"all\"",
    ];
    let some = ["--set", LOADS, "--set", "output.pictures=\"all\""];
    let stress = ["--set", "stress={}"];
    let cases = [("a", &[][..]), ("b", &many), ("c", &some), ("d", &stress)];
    for (out, sets) in cases {
        let checked = folder.run(&[&["check", "case.toml"], sets].concat()).stdout;
        let line = checked.lines().find(|line| line.contains("disk, about"));
        let words: Vec<_> = line.unwrap().split_whitespace().collect();
        let [.., estimate, "MB"] = words[..] else {
            panic!("{words:?}")
        };
        let estimate: f64 = estimate.parse().unwrap();
        run(&folder, out, sets);
        let entries = fs::read_dir(folder.path(out)).unwrap();
        let sizes = entries.map(|entry| entry.unwrap().metadata().unwrap().len());
        let ratio = sizes.sum::<u64>() as f64 / 1e6 / estimate;
        assert!(
            (0.8..1.2).contains(&ratio),
            "{sets:?}: {ratio} of {estimate} MB"
        );
    }
}

#[test]
fn a_needle_is_solved_and_drawn() {
    let needle = "indenter={kind=\"cone\", half_angle=\"0.1 deg\", tip_radius=\"1 um\"}";
    let folder = TestFolder::with_case(CASE);
    let ran = folder.run(&[
        "run",
        "case.toml",
        "--out",
        "a",
        "--set",
        needle,
        "--set",
        "load={penetration=\"1 um\"}",
    ]);
    assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
    assert!(folder.path("a/section-000.png").is_file(), "{}", ran.stderr);
}

#[cfg(unix)]
mod stopped {
    use std::process::{Child, Command, Stdio};
    use std::thread::sleep;
    use std::time::Duration;

    use super::*;

    /// Starts a run that takes seconds to write, and returns once it is writing.
    fn writing(folder: &TestFolder) -> Child {
        writing_on(folder, "96")
    }

    fn writing_on(folder: &TestFolder, elements: &str) -> Child {
        let elements = format!("grid.elements={elements}");
        let loads = "load={forces={from=\"1 uN\", to=\"2 uN\", count=24}}";
        let line = [
            "run",
            "case.toml",
            "--out",
            "a",
            "--fields",
            "all",
            "--pictures",
            "all",
            "--set",
            loads,
            "--set",
            &elements,
        ];
        let mut command = folder.command(&line);
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn();
        let start = Instant::now();
        let has_begun = || {
            let place = folder.path("a");
            let inside = fs::read_dir(&place).into_iter().flatten().flatten();
            let mut hidden = inside
                .map(|entry| entry.path())
                .filter(|path| path.is_dir());
            hidden.any(|path| fs::read_dir(path).is_ok_and(|mut files| files.next().is_some()))
        };
        while !has_begun() {
            assert!(start.elapsed() < Duration::from_mins(1), "nothing written");
            sleep(Duration::from_millis(5));
        }
        child.unwrap()
    }

    fn interrupt(child: &Child) {
        let id = child.id().to_string();
        let sent = Command::new("kill").args(["-INT", &id]).status();
        assert!(sent.unwrap().success());
    }

    #[test]
    fn ctrl_c_leaves_out_what_is_not_written_within_a_second_and_keeps_the_numbers() {
        let folder = TestFolder::with_case(CASE);
        let child = writing(&folder);
        let sent = Instant::now();
        interrupt(&child);
        let output = child.wait_with_output().unwrap();
        // A second, plus the time to end a process on a busy machine.
        assert!(
            sent.elapsed() < Duration::from_secs(3),
            "{:?}",
            sent.elapsed()
        );
        assert_eq!(output.status.code(), Some(130));
        assert_eq!(folder.names(), ["a", "case.toml"]);
        let summary = folder.summary("a");
        assert_eq!(summary["steps"].as_array().unwrap().len(), 24);
        let warnings = summary["warnings"].as_array().unwrap().iter();
        let codes: Vec<_> = warnings.map(|warning| &warning["code"]).collect();
        assert!(codes.contains(&&Value::from("stopped")), "{codes:?}");
        let files = names(&folder.path("a"));
        assert!(files.contains(&"report.html".to_owned()), "{files:?}");
        assert!(files.iter().all(|name| !name.starts_with('.')), "{files:?}");
    }

    #[test]
    fn large_fields_are_also_left_out_within_a_second() {
        let folder = TestFolder::with_case(CASE);
        // Half a minute of compression and drawing.
        let child = writing_on(&folder, "512");
        sleep(Duration::from_millis(500));
        let sent = Instant::now();
        interrupt(&child);
        let output = child.wait_with_output().unwrap();
        let time = sent.elapsed();
        assert!(time < Duration::from_secs(2), "{time:?}");
        assert_eq!(output.status.code(), Some(130));
        assert_eq!(folder.summary("a")["steps"].as_array().unwrap().len(), 24);
    }

    #[test]
    fn a_second_ctrl_c_ends_the_writing_and_leaves_nothing() {
        let folder = TestFolder::with_case(CASE);
        let mut child = writing(&folder);
        interrupt(&child);
        sleep(Duration::from_millis(50));
        interrupt(&child);
        assert_eq!(child.wait().unwrap().code(), Some(130));
        assert_eq!(folder.names(), ["case.toml"]);
    }
}

/// A limit on the size of files stands for a full disk: the archives of the fields and of the stresses do not fit.
#[cfg(target_os = "linux")]
#[test]
fn of_a_file_that_cannot_be_written_one_line_tells_and_no_library() {
    let folder = TestFolder::with_case(CASE.replace("elements = 32", "elements = 256"));
    let program = env!("CARGO_BIN_EXE_pellicle");
    for more in ["", " --set stress={}"] {
        let line = format!("run case.toml --quiet --pictures none --formats npz{more}");
        let script = format!("trap '' XFSZ; ulimit -f 64; exec {program} {line}");
        let mut command = std::process::Command::new("sh");
        command.args(["-c", &script]).env("PELLICLE_CACHE", "");
        let ran = TestFolder::ran(command.current_dir(folder.path(".")));
        assert_eq!(ran.code, Some(2), "{}", ran.stderr);
        assert_eq!(ran.stderr.lines().count(), 1, "{}", ran.stderr);
        assert!(
            ran.stderr.contains(".npz: cannot be written: "),
            "{}",
            ran.stderr
        );
        assert!(!ran.stderr.contains("Zip"), "{}", ran.stderr);
    }
    assert_eq!(folder.names(), ["case.toml"]);
}
