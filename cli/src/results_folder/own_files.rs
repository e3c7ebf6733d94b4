//! The files that a run or a fit writes, as opposed to files of others, which are never replaced.

use std::ffi::OsString;
use std::fs::{self, DirEntry, File};
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

use pellicle::result::table;
use pellicle::summary;
use pellicle_files::disk;
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;

use crate::each;
use crate::identification::{files, result};
use crate::output::report;
use crate::planning;

/// Files written once per run, and their extensions.
const OF_A_RUN: [(&str, &[&str]); 5] = [
    ("curve", &["svg", "png"]),
    ("convergence", &["svg", "png"]),
    ("spectrum", &["svg", "png"]),
    ("area-law", &["svg", "png"]),
    ("wear", &["svg", "png"]),
];

/// Files written once per step: the word before the number of the step, and the extensions.
const OF_A_STEP: [(&str, &[&str]); 13] = [
    ("fields", &["npz", "vti", "nc"]),
    ("stress", &["npz", "nc", "vtr"]),
    ("stress-section", &["svg", "png"]),
    ("stress-interfaces", &["svg", "png"]),
    ("pressure", &["gsf", "svg", "png"]),
    // Of earlier versions.
    ("mask", &["gsf"]),
    ("contact", &["gsf"]),
    ("pressure-3d", &["svg", "png"]),
    ("section", &["svg", "png"]),
    ("heights", &["svg", "png"]),
    ("gap", &["svg", "png"]),
    ("displacement", &["svg", "png"]),
    ("histograms", &["svg", "png"]),
];

/// Whether a run writes a file of this name.
#[must_use]
pub fn is_name(name: &str) -> bool {
    if [summary::FILE, table::FILE, report::FILE].contains(&name) {
        return true;
    }
    let Some((stem, ending)) = name.rsplit_once('.') else {
        return false;
    };
    let is_in = |list: &[(&str, &[&str])], stem: &str| {
        let known = list.iter().find(|(known, _)| *known == stem);
        known.is_some_and(|(_, endings)| endings.contains(&ending))
    };
    let step = stem.rsplit_once('-').filter(|(_, step)| is_number(step));
    is_in(&OF_A_RUN, stem) || step.is_some_and(|(stem, _)| is_in(&OF_A_STEP, stem))
}

fn is_number(text: &str) -> bool {
    text.len() >= 3 && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Whether an entry of a folder is a file or a link with a name that a run uses.
#[must_use]
pub fn is_file(entry: &DirEntry) -> bool {
    let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
    !is_folder && entry.file_name().to_str().is_some_and(is_name)
}

/// The part of a summary that distinguishes it from any other file of its name.
#[derive(Deserialize)]
struct SummaryHead {
    schema: String,
    program: String,
    case: Value,
    steps: Option<Vec<IgnoredAny>>,
}

/// The case whose results a folder contains, from its summary; none if it contains no results of this program.
#[must_use]
pub fn case_in(folder: &Path) -> Option<Value> {
    head(folder).map(|head| head.case)
}

fn head(folder: &Path) -> Option<SummaryHead> {
    let path = folder.join(summary::FILE);
    if !fs::symlink_metadata(&path).ok()?.is_file() {
        return None;
    }
    let file = BufReader::new(File::open(&path).ok()?);
    let head: SummaryHead = serde_json::from_reader(file).ok()?;
    let (layout, _) = summary::SCHEMA.split_once('/')?;
    let (written, _) = head.schema.split_once('/')?;
    (written == layout && head.program == summary::PROGRAM).then_some(head)
}

/// Returns a file in a results folder that has the name of a result but was not written by the run of the summary.
#[must_use]
pub fn not_written(folder: &Path) -> Option<PathBuf> {
    let steps = head(folder)?.steps?.len();
    let entries = fs::read_dir(folder).ok()?.flatten();
    let mut named = entries.filter(is_file);
    let foreign = named.find(|entry| !is_written(entry, steps));
    foreign.map(|entry| entry.path())
}

/// Whether a run of this many steps may have written a file: a curve has that many rows, and no file belongs to a later
/// step.
fn is_written(entry: &DirEntry, steps: usize) -> bool {
    let name = entry.file_name();
    let name = name.to_string_lossy();
    if name == table::FILE {
        let text = fs::read_to_string(entry.path());
        return text.is_ok_and(|text| table::is_of(&text, steps));
    }
    let stem = name.split('.').next().unwrap_or_default();
    let step = stem
        .rsplit_once('-')
        .and_then(|(_, step)| step.parse::<usize>().ok());
    step.is_none_or(|step| step < steps)
}

/// Names of everything in a folder that is not of a run, nor of the fit or plan in it.
///
/// # Errors
///
/// An error of the system if the folder cannot be read.
pub fn others(folder: &Path) -> io::Result<Vec<OsString>> {
    let is_fit = is_fit(folder);
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if !(is_file(&entry) || is_fit && is_fit_file(&entry)) {
            names.push(entry.file_name());
        }
    }
    Ok(names)
}

/// Removes the files of a run in a folder, the summary first, since without it a folder does not count as results.
/// Removes the folder if it is then empty.
///
/// # Errors
///
/// An error of the system if a file cannot be removed.
pub fn remove(folder: &Path) -> io::Result<()> {
    remove_files(folder)?;
    if fs::read_dir(folder)?.next().is_none() {
        disk::remove_dir(folder)?;
    }
    Ok(())
}

/// Removes the files likewise, but keeps the folder.
///
/// # Errors
///
/// An error of the system if a file cannot be removed.
pub fn remove_files(folder: &Path) -> io::Result<()> {
    let summary = folder.join(summary::FILE);
    if fs::symlink_metadata(&summary).is_ok() {
        disk::remove_file(&summary)?;
    }
    // Tables are removed only from the folder of a fit: in that of a run they are not the program's.
    let marks: Vec<&str> = marks_in(folder).collect();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let is_mark = marks.iter().any(|mark| name == **mark);
        let is_of_fit = !marks.is_empty() && is_fit_file(&entry) && !is_mark;
        if is_file(&entry) || is_of_fit {
            disk::remove_file(&entry.path())?;
        }
    }
    // Last, so that a half-removed fit is still recognised.
    marks
        .iter()
        .try_for_each(|mark| disk::remove_file(&folder.join(mark)))
}

/// Whether a folder contains the results of a fit or a plan.
#[must_use]
pub fn is_fit(folder: &Path) -> bool {
    marks_in(folder).next().is_some()
}

/// The files that mark a folder as the results of a fit or a plan.
fn marks_in(folder: &Path) -> impl Iterator<Item = &'static str> {
    #[derive(Deserialize)]
    struct ResultHead {
        schema: String,
    }
    let has_layout = |file: &str, schema: &str| {
        let text = fs::read_to_string(folder.join(file)).ok();
        let head = text.and_then(|text| serde_json::from_str::<ResultHead>(&text).ok());
        head.is_some_and(|head| layout(&head.schema) == layout(schema))
    };
    let marks = [
        (result::FILE, result::SCHEMA),
        (planning::result::FILE, planning::result::SCHEMA),
        (each::FILE, each::SCHEMA),
    ];
    let marks = marks
        .into_iter()
        .filter(move |(file, schema)| has_layout(file, schema));
    marks.map(|(file, _)| file)
}

/// The name of a layout without its version.
fn layout(schema: &str) -> &str {
    schema.split('/').next().unwrap_or(schema)
}

/// Whether an entry of a folder is a file or a link with a name that a fit or a plan uses.
#[must_use]
pub fn is_fit_file(entry: &DirEntry) -> bool {
    let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
    let name = entry.file_name();
    !is_folder
        && name.to_str().is_some_and(|name| {
            files::is_name(name) || planning::files::is_name(name) || each::files::is_name(name)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_file_names_of_a_run_are_recognised() {
        for name in [
            "summary.json",
            "curve.csv",
            "curve.svg",
            "report.html",
            "convergence.png",
            "spectrum.svg",
            "area-law.png",
            "histograms-003.png",
            "fields-000.npz",
            "pressure-3d-1234.svg",
            "section-007.png",
            "stress-000.nc",
            "stress-012.vtr",
            "stress-000.npz",
            "stress-section-000.svg",
            "stress-interfaces-001.png",
        ] {
            assert!(is_name(name), "{name}");
        }
        for name in [
            "thesis.tex",
            "curve-2.csv",
            "fields.npz",
            "fields-000.csv",
            "fields-1.npz",
            "section-final.png",
            "section-000 copy.png",
            "summary.json~",
            "",
        ] {
            assert!(!is_name(name), "{name}");
        }
    }

    #[test]
    fn a_summary_of_another_program_is_not_recognised() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(summary::FILE);
        for text in [
            "{}",
            "mine",
            r#"{"schema": "other/1", "program": "pellicle", "case": {}}"#,
            r#"{"schema": "pellicle-summary/1", "program": "other", "case": {}}"#,
        ] {
            fs::write(&path, text).unwrap();
            assert_eq!(case_in(folder.path()), None, "{text}");
        }
        fs::write(
            &path,
            r#"{"schema": "pellicle-summary/1", "program": "pellicle", "case": {"title": "a"}}"#,
        )
        .unwrap();
        assert!(case_in(folder.path()).is_some());
    }
}
