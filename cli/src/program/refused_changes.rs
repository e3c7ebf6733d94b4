//! Every change of the disk by a run, a study, the gathering of its parts, a search and a fit, refused in turn: alone,
//! as when the disk is full for a moment, and with all that follow, as when the program is killed there.
//!
//! A refused command says one sentence. What it leaves is never half of something under the name of the whole, and the
//! same command again ends with the files of an undisturbed one.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use pellicle::Completeness;
use pellicle::input::span::Source;
use pellicle_files::refusal::Refusal;
use pellicle_files::whole::Existing;
use pellicle_identify::StopFlag;
use pellicle_identify::fit_file::{FitFile, FitSources, Measurements};
use pellicle_study::gather::{self, OtherTable};
use serde_json::Value;
use tempfile::TempDir;

use super::*;
use crate::fit_and_plan;
use crate::identification::files;
use crate::results_folder::ResultsFolder;

const CASE: &str = include_str!("../../../tests/data/refusals/case.toml");

/// Three cases, finished in an order of their own.
const STUDY: &str = include_str!("../../../tests/data/refusals/many.toml");

/// A ball of 10 µm on E/(1 − ν²) = 50 GPa, `F = 4/3 E* √R D^1.5` rounded to 0.1 µN.
const FIT: &str = include_str!("../../../tests/data/refusals/fit.toml");

/// A command and what it finds in its folder.
struct Scenario {
    /// Files that are there before.
    given: Vec<(&'static str, String)>,
    /// Commands that have been carried out.
    before: Vec<&'static str>,
    act: Box<Act>,
}

/// What is refused.
type Act = dyn Fn(&Place) -> Result<(), Failure>;

/// Carries out a command of the program.
fn command(words: &'static str) -> Box<Act> {
    Box::new(move |place| place.carried_out(words).map(drop))
}

/// A folder of its own with what a scenario finds.
struct Place {
    _folder: TempDir,
    path: PathBuf,
}

impl Place {
    fn of(scenario: &Scenario) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().canonicalize().unwrap();
        for (name, text) in &scenario.given {
            fs::write(path.join(name), text).unwrap();
        }
        let place = Self {
            _folder: folder,
            path,
        };
        for command in &scenario.before {
            place.carried_out(command).unwrap();
        }
        place
    }

    /// Carries out a command; a word that begins with `@` is a path in this folder.
    fn carried_out(&self, command: &str) -> Result<Outcome, Failure> {
        let word = |word: &str| match word.strip_prefix('@') {
            Some(name) => self.path.join(name).into_os_string(),
            None => word.into(),
        };
        let words = std::iter::once("pellicle").chain(command.split(' '));
        execute(Arguments::try_parse_from(words.map(word)).unwrap().command)
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
        let bytes = fs::read(path).unwrap();
        let Ok(text) = String::from_utf8(bytes) else {
            return fs::read(path).unwrap();
        };
        let text = text.replace(self.path.to_str().unwrap(), "");
        if let Ok(mut value) = serde_json::from_str::<Value>(&text) {
            leave_out_times(&mut value);
            return value.to_string().into_bytes();
        }
        let is_page = path.extension().is_some_and(|ending| ending == "html");
        let is_lasting = |line: &&str| !(is_page && tells_a_time(line));
        let lines = text.lines().filter(is_lasting);
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

/// Whether a line of a page tells how long something took.
fn tells_a_time(line: &str) -> bool {
    [" s<", " s,", " ms"].iter().any(|end| line.contains(end))
}

/// A file that is visible, in its own folder and in those above.
fn is_visible(name: &str) -> bool {
    !name.split('/').any(|part| part.starts_with(".pellicle-"))
}

fn refuse_each(scenario: &Scenario, is_part: fn(&str, [&[u8]; 2]) -> bool) -> usize {
    let undisturbed = Place::of(scenario);
    let earlier = undisturbed.files();
    let counted = Refusal::of(&undisturbed.path, 0..0).unwrap();
    (scenario.act)(&undisturbed).unwrap();
    let changes = counted.changes();
    drop(counted);
    let wanted = undisturbed.files();
    assert!(
        wanted.keys().all(|name| is_visible(name)),
        "{:?}",
        wanted.keys()
    );
    for number in 0..changes {
        for refused in [number..number + 1, number..usize::MAX] {
            let place = Place::of(scenario);
            let refusal = Refusal::of(&place.path, refused.clone()).unwrap();
            let ended = (scenario.act)(&place);
            drop(refusal);
            let left = place.files();
            let of = format!("{refused:?} of {changes}: {ended:?}");
            match ended {
                Ok(()) => wanted.iter().for_each(|(name, content)| {
                    assert!(left.get(name) == Some(content), "{of}: {name}");
                }),
                Err(failure) => {
                    let words = failure.render();
                    assert!(
                        words.starts_with("Error: ") && !words.contains('\n'),
                        "{of}: {words}"
                    );
                    assert_eq!(failure.exit_code(), 2, "{of}");
                }
            }
            for (name, content) in left.iter().filter(|(name, _)| is_visible(name)) {
                let is_whole =
                    wanted.get(name) == Some(content) || earlier.get(name) == Some(content);
                assert!(
                    is_whole
                        || wanted
                            .get(name)
                            .is_some_and(|wanted| is_part(name, [content, wanted])),
                    "{of}: {name}"
                );
            }
            if left == earlier {
                // The command begins again as an undisturbed one.
                continue;
            }
            let again = (scenario.act)(&place);
            assert!(again.is_ok(), "{of}, again: {again:?}");
            let found = place.files();
            assert!(
                found.keys().eq(wanted.keys()),
                "{of}, again: {:?}",
                found.keys()
            );
            for (name, content) in &wanted {
                assert!(
                    found[name] == *content,
                    "{of}, again: {name}: {}",
                    difference(&found[name], content)
                );
            }
        }
    }
    changes
}

/// The first line in which two texts differ.
fn difference(found: &[u8], wanted: &[u8]) -> String {
    let [found, wanted] = [found, wanted].map(String::from_utf8_lossy);
    let mut pairs = found.lines().zip(wanted.lines());
    let pair = pairs.find(|(one, other)| one != other);
    pair.map_or("length".into(), |(one, other)| {
        let at = one
            .bytes()
            .zip(other.bytes())
            .position(|(a, b)| a != b)
            .unwrap_or(0);
        let shown = |line: &str| {
            line.chars()
                .skip(at.saturating_sub(60))
                .take(120)
                .collect::<String>()
        };
        format!("{}, wanted {}", shown(one), shown(other))
    })
}

fn given(files: &[(&'static str, &str)]) -> Vec<(&'static str, String)> {
    files
        .iter()
        .map(|(name, text)| (*name, (*text).to_owned()))
        .collect()
}

/// Whether a file of a study that is filled while the cases are solved tells its readers that it is not complete: every
/// whole row of the table is one of the complete table, and the number of cases in the head of the fields is 0.
fn is_of_unfinished_study(name: &str, [found, wanted]: [&[u8]; 2]) -> bool {
    if Path::new(name)
        .extension()
        .is_some_and(|ending| ending == "nc")
    {
        let count = |bytes: &[u8]| bytes[4..8] == [0; 4];
        return count(found) && !count(wanted);
    }
    let [found, wanted] = [found, wanted].map(String::from_utf8_lossy);
    let whole = found.rsplit_once('\n').map_or("", |(whole, _)| whole);
    let is_row = |row: &str| wanted.lines().any(|wanted| wanted == row);
    name.ends_with("results.csv") && whole.lines().all(is_row)
}

#[test]
fn a_run_survives_the_refusal_of_any_change() {
    let scenario = Scenario {
        given: given(&[("case.toml", CASE)]),
        before: vec![],
        act: command("run @case.toml --out @results --force --quiet --pictures none"),
    };
    let changes = refuse_each(&scenario, |_, _| false);
    assert!(changes > 20, "{changes}");
}

#[test]
fn a_run_in_the_place_of_another_survives_the_refusal_of_any_change() {
    let scenario = Scenario {
        given: given(&[("case.toml", CASE)]),
        before: vec![
            "run @case.toml --out @results --quiet --fields none --pictures none --set load.force=2e-6",
        ],
        act: command("run @case.toml --out @results --force --quiet --fields none --pictures none"),
    };
    refuse_each(&scenario, |_, _| false);
}

#[test]
fn a_study_survives_the_refusal_of_any_change() {
    let scenario = Scenario {
        given: given(&[("case.toml", CASE), ("many.toml", STUDY)]),
        before: vec![],
        act: command("study @many.toml --out @many --quiet --threads 1"),
    };
    refuse_each(&scenario, is_of_unfinished_study);
}

#[test]
fn the_gathering_of_a_study_survives_the_refusal_of_any_change() {
    let scenario = Scenario {
        given: given(&[("case.toml", CASE), ("many.toml", STUDY)]),
        before: vec![
            "study @many.toml --out @many --quiet --threads 1 --shard 1/2",
            "study @many.toml --out @many --quiet --threads 1 --shard 2/2",
        ],
        act: Box::new(|place| {
            gather::gather(&place.path.join("many"), OtherTable::Keep)?;
            Ok(())
        }),
    };
    refuse_each(&scenario, |_, _| false);
}

#[test]
fn a_fit_survives_the_refusal_of_any_change() {
    let row = |i: u32| {
        let depth = 2.0 * f64::from(i);
        // 4/3 · 50 GPa · √(10 µm) · (1 nm)^1.5 = 6.67 µN, times 1 % up and down.
        let force = 6.667e-3 * depth.powf(1.5) * (1.0 + 0.01 * f64::from(i % 3) - 0.01);
        format!("{depth},{force:.4}\n")
    };
    let curve = String::from("depth,force\n") + &(1..=20).map(row).collect::<String>();
    // Fitted once: what is refused comes after the fit.
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ball.csv"), curve).unwrap();
    let source = Arc::new(Source::new("fit.toml", FIT.into()));
    let sources = FitSources::in_folder(folder.path());
    let file = FitFile::parse(&source, "fit", &sources, Measurements::Required).unwrap();
    let fitted = fit_and_plan::fit(file, Instant::now(), &StopFlag::default(), &|_| ());
    let fitted = RefCell::new(fitted.unwrap());
    let scenario = Scenario {
        given: vec![],
        before: vec![],
        act: Box::new(move |place| {
            let folder = ResultsFolder::claim(&place.path.join("fit"), Existing::Replace)?;
            let write = |folder: &Path| {
                files::write(folder, &mut fitted.borrow_mut())?;
                Ok(Completeness::Whole)
            };
            folder.write(write).map(drop)
        }),
    };
    refuse_each(&scenario, |_, _| false);
}
