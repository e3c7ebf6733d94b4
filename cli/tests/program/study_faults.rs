//! Faults around a study: the disk becomes full, a part is started twice, the clocks of two machines differ. Nothing is
//! lost or duplicated, and one sentence says what to do.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime};

use serde_json::Value;

use super::read_back::say_skipped;
use super::runner::{CASE, ProgramOutput, TestFolder};

/// 40 cases, of which the ten with the widest cylinders overlap.
const STUDY: &str = r#"[study]
case = "case.toml"

[study.vary]
load.force = { from = "0.5 uN", to = "5 uN", count = 10, spacing = "log" }
surface.radius = ["10 nm", "15 nm", "20 nm", "26 nm"]
"#;

fn study(folder: &TestFolder, more: &[&str]) -> ProgramOutput {
    folder.study(&[&["--threads", "2"], more].concat())
}

fn read(folder: &TestFolder, name: &str) -> Vec<u8> {
    fs::read(folder.path(name)).unwrap()
}

/// Files of an undisturbed study.
fn undisturbed(text: &str, names: &[&str]) -> Vec<Vec<u8>> {
    let folder = TestFolder::with_study(CASE, text);
    assert_eq!(study(&folder, &[]).code, Some(1));
    let path = |name: &&str| read(&folder, &format!("results/many/{name}"));
    names.iter().map(path).collect()
}

/// Runs the study on a small file system of size `size`, again once there is room, and copies its files; `None` if no
/// file system can be mounted.
#[cfg(target_os = "linux")]
fn ran_on_a_small_disk(folder: &TestFolder, size: &str) -> Option<[String; 3]> {
    let script = format!(
        "mkdir results && mount -t tmpfs -o size={size} none results || exit 99\n\
         \"$0\" study many.toml --quiet --threads 2 2> first; echo $? > code\n\
         mount -o remount,size=64m results || exit 99\n\
         \"$0\" study many.toml --quiet --threads 2 2> second; echo $? > again\n\
         cp -r results/many copy"
    );
    let program = env!("CARGO_BIN_EXE_pellicle");
    let mut command = Command::new("unshare");
    command.args(["--mount", "sh", "-c", &script, program]);
    command
        .current_dir(folder.path(""))
        .env("PELLICLE_CACHE", "");
    let ran = command.stdin(Stdio::null()).output();
    if !ran.is_ok_and(|ran| ran.status.success()) {
        return None;
    }
    let text = |name| String::from_utf8(read(folder, name)).unwrap();
    Some(["code", "first", "again"].map(text))
}

#[cfg(target_os = "linux")]
#[test]
fn on_a_full_disk_a_study_stops_with_an_error_and_continues_once_there_is_space() {
    let keeps = STUDY.replace("\n\n", "\nkeep = [\"pressure\"]\n\n");
    for (text, size, full, names) in [
        (STUDY, "20k", "results.csv", &["results.csv"][..]),
        (
            &*keeps,
            "160k",
            "fields-n32.nc",
            &["results.csv", "fields-n32.nc"][..],
        ),
    ] {
        let folder = TestFolder::with_study(CASE, text);
        let Some([code, message, again]) = ran_on_a_small_disk(&folder, size) else {
            say_skipped("no small file system can be mounted");
            return;
        };
        assert_eq!(code, "2\n", "{message}");
        let sentence = format!("results/many/{full}: cannot be written: No space left on device");
        assert!(
            message.starts_with("Error: ") && message.contains(&sentence),
            "{message}"
        );
        assert_eq!(message.lines().count(), 1, "{message}");
        assert_eq!(again, "1\n");
        let found: Vec<_> = names
            .iter()
            .map(|name| read(&folder, &format!("copy/{name}")))
            .collect();
        assert!(found == undisturbed(text, names), "{full}");
    }
}

/// The same on any system whose shell can limit the size of a file: the table reaches the limit.
#[cfg(unix)]
#[test]
fn a_table_at_the_file_size_limit_keeps_its_cases() {
    let folder = TestFolder::with_study(CASE, STUDY);
    // Without the trap the system ends the program; 8 blocks of 512 bytes hold a quarter of the table.
    let script = "trap '' XFSZ; ulimit -f 8; exec \"$0\" study many.toml --quiet --threads 2";
    let mut command = Command::new("sh");
    command.args(["-c", script, env!("CARGO_BIN_EXE_pellicle")]);
    command
        .current_dir(folder.path(""))
        .env("PELLICLE_CACHE", "");
    let ran = TestFolder::ran(command.stdin(Stdio::null()));
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(
        ran.stderr
            .contains("results.csv: cannot be written: File too large"),
        "{}",
        ran.stderr
    );
    let expected = undisturbed(STUDY, &["results.csv"]).remove(0);
    let kept = read(&folder, "results/many/results.csv");
    assert!(kept.ends_with(b"\n") && kept.len() < expected.len());
    assert_eq!(study(&folder, &[]).code, Some(1));
    assert!(read(&folder, "results/many/results.csv") == expected);
}

#[test]
fn of_many_processes_started_on_one_part_one_works_and_the_others_report_it() {
    let folder = TestFolder::with_study(CASE, STUDY);
    let line = [
        "study",
        "many.toml",
        "--quiet",
        "--threads",
        "1",
        "--shard",
        "1/2",
    ];
    let start = |_| {
        let mut command = folder.command(&line);
        command.stderr(Stdio::piped()).spawn().unwrap()
    };
    let children: Vec<Child> = (0..6).map(start).collect();
    let mut worked = 0;
    for child in children {
        let ran = ProgramOutput::from(child.wait_with_output().unwrap());
        if ran.code == Some(1) {
            // Some of its cases fail. A process that starts when the part is done finds nothing to do.
            worked += 1;
            assert_eq!(ran.stderr, "");
        } else {
            assert_eq!(ran.code, Some(2), "{}", ran.stderr);
            let message = "results-1-of-2.csv: found another process writing to it: wait until it has ended\n";
            assert!(
                ran.stderr.ends_with(message) && ran.stderr.lines().count() == 1,
                "{}",
                ran.stderr
            );
        }
    }
    assert!(worked > 0);
    assert_eq!(study(&folder, &["--shard", "2/2"]).code, Some(1));
    assert_eq!(folder.run(&["gather", "results/many"]).code, Some(1));
    let expected = undisturbed(STUDY, &["results.csv"]).remove(0);
    assert!(read(&folder, "results/many/results.csv") == expected);
}

/// The library that changes a program's clock; `None` if it is not installed.
fn other_clock() -> Option<&'static str> {
    const PLACES: [&str; 3] = [
        "/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1",
        "/usr/lib/aarch64-linux-gnu/faketime/libfaketimeMT.so.1",
        "/usr/lib/faketime/libfaketimeMT.so.1",
    ];
    PLACES.into_iter().find(|place| Path::new(place).exists())
}

#[test]
fn parts_on_machines_with_clocks_an_hour_apart_give_the_table_of_one() {
    // Long enough for both to be at work when the status is read.
    let text = STUDY
        .replace("\n\n", "\nkeep = [\"pressure\"]\n\n")
        .replace("count = 10", "count = 100");
    let folder = TestFolder::with_study(CASE, &text);
    let clock = other_clock();
    if clock.is_none() {
        say_skipped("libfaketime is not installed: only the times of files differ");
    }
    let start = |part: &str, hour: &str| -> Child {
        let line = [
            "study",
            "many.toml",
            "--quiet",
            "--threads",
            "1",
            "--shard",
            part,
        ];
        let mut command = folder.command(&line);
        if let Some(library) = clock {
            command.env("LD_PRELOAD", library).env("FAKETIME", hour);
            command.env("FAKETIME_DONT_FAKE_MONOTONIC", "1");
        }
        command.spawn().unwrap()
    };
    let mut parts = [("1/2", "+1h"), ("2/2", "-1h")].map(|(part, hour)| start(part, hour));
    // Waits until cases of both parts are on disk; on a busy machine both may be done by then.
    let waiting = Instant::now();
    let mut most_at_work = 0;
    loop {
        let ran = study(&folder, &["--status", "--json"]);
        let status: Value = serde_json::from_str(&ran.stdout).unwrap();
        most_at_work = most_at_work.max(status["parts_at_work"].as_u64().unwrap());
        if status["certified"] != 0 && most_at_work == 2 || waiting.elapsed().as_secs() > 60 {
            break;
        }
        sleep(Duration::from_millis(20));
    }
    assert_eq!(most_at_work, 2, "parts at work at the same time");
    for part in &mut parts {
        part.kill().unwrap();
        part.wait().unwrap();
    }
    // Files as written by another machine, with its time.
    let hour = Duration::from_hours(1);
    for (name, time) in [
        ("study-1-of-2.json", SystemTime::now() + hour),
        ("results-2-of-2.csv", SystemTime::now() - hour),
    ] {
        let file = fs::File::options()
            .append(true)
            .open(folder.path("results/many").join(name));
        file.unwrap().set_modified(time).unwrap();
    }
    for mut part in [("1/2", "-1h"), ("2/2", "+1h")].map(|(part, hour)| start(part, hour)) {
        assert_eq!(part.wait().unwrap().code(), Some(1));
    }
    let gathered = folder.run(&["gather", "results/many"]);
    assert_eq!(gathered.code, Some(1), "{}", gathered.stderr);
    let names = ["results.csv", "fields-n32.nc"];
    let found = names.map(|name| read(&folder, &format!("results/many/{name}")));
    assert!(found[..] == undisturbed(&text, &names)[..]);
}
