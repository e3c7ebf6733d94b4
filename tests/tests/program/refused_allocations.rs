//! One allocation of a run, a study, the gathering of its parts and a fit is refused, as when the memory is full: the
//! first and the last ones and some between, of all sizes, and of large blocks.
//!
//! Where the program cannot go on without the memory, Rust says how much was refused and ends the program, as does the
//! compressor of a field. Where it can, as for a file that is read, it says a sentence of its own, or goes on. What it
//! leaves is never half of something under the name of the whole, and the same command again ends with the files of an
//! undisturbed one.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;

use super::Ran;

const CASE: &str = include_str!("../../data/refusals/case.toml");

const STUDY: &str = include_str!("../../data/refusals/many.toml");

/// A ball of 10 µm on E/(1 − ν²) = 50 GPa.
const FIT: &str = include_str!("../../data/refusals/fit.toml");

/// Bytes of a block that counts as large: half of a field of 16 × 16 elements.
const LARGE: usize = 1024;

/// The words with which Rust ends the program.
const NO_MEMORY: &str = "memory allocation of ";

/// The compressor, which panics without memory for its state.
const COMPRESSOR: &str = "zlib";

/// The exit code of a panic.
const PANIC: i32 = 101;

/// What is refused, after which commands.
struct Scenario {
    before: &'static [&'static str],
    command: &'static str,
    /// Factor between the distances from the first and from the last allocation of those that are refused.
    spread: u64,
}

/// A folder with the files that a command reads.
struct Place {
    _folder: TempDir,
    path: PathBuf,
}

impl Place {
    fn of(scenario: &Scenario) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().canonicalize().unwrap();
        let curve = curve();
        for (name, text) in [
            ("case.toml", CASE),
            ("many.toml", STUDY),
            ("fit.toml", FIT),
            ("ball.csv", &curve),
        ] {
            fs::write(path.join(name), text).unwrap();
        }
        let place = Self {
            _folder: folder,
            path,
        };
        for command in scenario.before {
            assert_eq!(place.undisturbed(command).code, Some(0), "{command}");
        }
        place
    }

    /// Carries out a command, of which the allocation of this number among those of at least `bytes` is refused.
    fn refused(&self, command: &str, number: u64, bytes: usize) -> Ran {
        let numbers = [number.to_string(), bytes.to_string()];
        let output = Command::new(env!("CARGO_BIN_EXE_pellicle-short-of-memory"))
            .args(numbers)
            .args(command.split(' '))
            .current_dir(&self.path)
            .env("PELLICLE_CACHE", "")
            .env_remove("RUST_BACKTRACE")
            .stdin(Stdio::null())
            .output()
            .unwrap();
        Ran {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    fn undisturbed(&self, command: &str) -> Ran {
        self.refused(command, u64::MAX, LARGE)
    }

    /// The files by name, without times and the place itself.
    fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let mut files = BTreeMap::new();
        let mut folders = vec![self.path.clone()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                    continue;
                }
                let name = path.strip_prefix(&self.path).unwrap().to_str().unwrap();
                files.insert(name.to_owned(), self.lasting(&path));
            }
        }
        files
    }

    /// The content of a file without what differs from one undisturbed command to the next.
    fn lasting(&self, path: &Path) -> Vec<u8> {
        let text = match String::from_utf8(fs::read(path).unwrap()) {
            Ok(text) => text.replace(self.path.to_str().unwrap(), ""),
            Err(bytes) => return bytes.into_bytes(),
        };
        if let Ok(mut value) = serde_json::from_str::<Value>(&text) {
            leave_out_times(&mut value);
            return value.to_string().into_bytes();
        }
        let is_page = path.extension().is_some_and(|ending| ending == "html");
        let tells_a_time = |line: &&str| {
            [" s<", " s,", " s.", " ms"]
                .iter()
                .any(|end| line.contains(end))
        };
        let lines = text.lines().filter(|line| !(is_page && tells_a_time(line)));
        lines.collect::<Vec<_>>().join("\n").into_bytes()
    }
}

/// Removes times, and how much was done when a study was last begun.
fn leave_out_times(value: &mut Value) {
    match value {
        Value::Object(table) => {
            table.retain(|key, _| !["timing", "seconds", "done_before"].contains(&key.as_str()));
            table.values_mut().for_each(leave_out_times);
        }
        Value::Array(items) => items.iter_mut().for_each(leave_out_times),
        _ => {}
    }
}

/// `F = 4/3 · 50 GPa · √(10 µm) · D^1.5`, times 1 % up and down.
fn curve() -> String {
    let row = |i: u32| {
        let depth = 2.0 * f64::from(i);
        let force = 6.667e-3 * depth.powf(1.5) * (1.0 + 0.01 * f64::from(i % 3) - 0.01);
        format!("{depth},{force:.4}\n")
    };
    String::from("depth,force\n") + &(1..=20).map(row).collect::<String>()
}

/// A file that is visible, in its own folder and in those above.
fn is_visible(name: &str) -> bool {
    !name.split('/').any(|part| part.starts_with(".pellicle-"))
}

/// Whether a file of a study that is filled while the cases are solved tells its readers that it is not complete: every
/// whole row of the table is one of the complete table, and the number of cases in the head of the fields is 0.
fn is_part(name: &str, found: &[u8], wanted: &[u8]) -> bool {
    if Path::new(name)
        .extension()
        .is_some_and(|ending| ending == "nc")
    {
        let is_empty = |bytes: &[u8]| bytes[4..8] == [0; 4];
        return is_empty(found) && !is_empty(wanted);
    }
    let [found, wanted] = [found, wanted].map(String::from_utf8_lossy);
    let whole = found.rsplit_once('\n').map_or("", |(whole, _)| whole);
    let is_row = |row: &str| wanted.lines().any(|wanted| wanted == row);
    name.ends_with("results.csv") && whole.lines().all(is_row)
}

/// The first and the last of `count` numbers, and those at distances from them that grow by a factor.
fn spread(count: u64, factor: u64) -> BTreeSet<u64> {
    let distances = std::iter::successors(Some(1), |distance| Some(factor * distance));
    let distances = distances.take_while(|distance| *distance < count);
    let from_ends = distances.flat_map(|distance| [distance, count - distance]);
    from_ends.chain([0]).collect()
}

/// Refuses some allocations of a command in turn; the number of times that the program had no memory.
fn refuse_some(scenario: &Scenario) -> usize {
    let place = Place::of(scenario);
    let earlier = place.files();
    let mut without_memory = 0;
    let mut wanted = None;
    for bytes in [0, LARGE] {
        let place = Place::of(scenario);
        let ran = place.refused(scenario.command, u64::MAX, bytes);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let count = ran.stderr.lines().last().unwrap().parse().unwrap();
        let wanted = &*wanted.get_or_insert_with(|| place.files());
        for number in spread(count, scenario.spread) {
            let of = format!("{}, {number} of {count}", scenario.command);
            without_memory +=
                usize::from(refuse(scenario, [&earlier, wanted], (number, bytes), &of));
        }
    }
    without_memory
}

/// Refuses an allocation; whether the program ended because of it.
fn refuse(
    scenario: &Scenario,
    [earlier, wanted]: [&BTreeMap<String, Vec<u8>>; 2],
    (number, bytes): (u64, usize),
    of: &str,
) -> bool {
    let place = Place::of(scenario);
    let ran = place.refused(scenario.command, number, bytes);
    let left = place.files();
    let of = format!("{of}, {:?}: {}", ran.code, ran.stderr);
    match ran.code {
        Some(0) => assert!(left == *wanted, "{of}"),
        Some(2) => assert!(ran.stderr.starts_with("Error: "), "{of}"),
        Some(PANIC) => assert!(ran.stderr.contains(COMPRESSOR), "{of}"),
        _ => assert!(ran.stderr.contains(NO_MEMORY), "{of}"),
    }
    for (name, content) in left.iter().filter(|(name, _)| is_visible(name)) {
        let is_whole = [wanted, earlier].map(|files| files.get(name) == Some(content));
        let is_part = || {
            wanted
                .get(name)
                .is_some_and(|wanted| is_part(name, content, wanted))
        };
        assert!(is_whole.contains(&true) || is_part(), "{of}: {name}");
    }
    if left != *earlier {
        let again = place.undisturbed(scenario.command);
        assert_eq!(again.code, Some(0), "{of}, again: {}", again.stderr);
        let found = place.files();
        assert!(
            found.keys().eq(wanted.keys()),
            "{of}, again: {:?}",
            found.keys()
        );
        for (name, content) in wanted {
            assert!(found[name] == *content, "{of}, again: {name}");
        }
    }
    ran.code != Some(0)
}

#[test]
fn a_run_survives_a_refused_allocation() {
    let ended = refuse_some(&Scenario {
        before: &[],
        command: "run case.toml --out results --force --quiet --pictures none --threads 1",
        spread: 2,
    });
    assert!(ended > 10, "{ended}");
}

#[test]
fn a_run_in_the_place_of_another_survives_a_refused_allocation() {
    let ended = refuse_some(&Scenario {
        before: &["run case.toml --out results --quiet --pictures none --set load.force=2e-6"],
        command: "run case.toml --out results --force --quiet --fields none --pictures none --threads 1",
        spread: 2,
    });
    assert!(ended > 10, "{ended}");
}

#[test]
fn a_study_survives_a_refused_allocation() {
    let ended = refuse_some(&Scenario {
        before: &[],
        command: "study many.toml --out many --quiet --threads 1",
        spread: 2,
    });
    assert!(ended > 10, "{ended}");
}

#[test]
fn the_gathering_of_a_study_survives_a_refused_allocation() {
    let ended = refuse_some(&Scenario {
        before: &[
            "study many.toml --out many --quiet --threads 1 --shard 1/2",
            "study many.toml --out many --quiet --threads 1 --shard 2/2",
        ],
        command: "gather many",
        spread: 2,
    });
    assert!(ended > 5, "{ended}");
}

#[test]
fn a_fit_survives_a_refused_allocation() {
    let ended = refuse_some(&Scenario {
        before: &[],
        command: "identify fit.toml --out fit --force --quiet --threads 1",
        spread: 512,
    });
    assert!(ended > 5, "{ended}");
}
