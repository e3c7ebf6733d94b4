//! `pellicle study`: one case for many values of its keys.

use std::fs;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::arguments::StudyArguments;
use crate::failure::Failure;
use crate::program::Outcome;
use crate::study::Study;
use crate::study::identity::Identity;
use crate::study::plan::Plan;
use crate::study::progress::Lines;
use crate::study::shard::Shard;
use crate::study::solve::Kit;
use crate::study::status::Tally;
use crate::study::table::{Begin, Table};
use crate::study::{file, runner};
use crate::{cache, interrupt, output, terminal};

/// Solves the cases that are not done yet and says how all of them ended.
///
/// # Errors
///
/// [`Failure`] if the study is wrong or its table cannot be written. A case that fails is none.
pub fn study(arguments: &StudyArguments) -> Result<Outcome, Failure> {
    let study = file::read(&arguments.path, &arguments.sets)?;
    let plan = Plan::new(&study, arguments.shard)?;
    if arguments.list {
        return list(&study, arguments.shard);
    }
    let folder = folder(arguments, &study);
    let begin = prepare(&folder, &plan.identity, arguments.fresh)?;
    let mut table = Table::open(&folder, &plan.identity, begin)?;
    interrupt::listen();
    let cases = plan.identity.cases();
    let is_to_do = |case: &usize| !table.done().contains_key(case);
    let to_do: Vec<_> = cases.iter().copied().filter(is_to_do).collect();
    let lines = Lines::new(
        cases.len(),
        cases.len() - to_do.len(),
        is_watched(arguments),
    );
    let kit = Kit {
        study: &study,
        columns: &plan.columns,
        cache: cache::open(),
        folders: arguments.folders.then(|| folder.join("cases")),
    };
    let threads = arguments
        .threads
        .map_or_else(runner::default_threads, usize::from);
    runner::run(&kit, &to_do, threads, &mut table, &lines)?;
    cache::tell_warnings(&kit.cache);
    let (tally, path) = (table.tally(), table.path().to_owned());
    if tally.done() == cases.len() {
        table.finish(&plan.identity)?;
    }
    report(arguments, tally, &path, cases.len())
}

fn is_watched(arguments: &StudyArguments) -> bool {
    !arguments.quiet && !arguments.json
}

/// The folder named, or `results/NAME` after the study.
fn folder(arguments: &StudyArguments, study: &Study) -> PathBuf {
    let default = || Path::new("results").join(&study.name);
    arguments.out.clone().unwrap_or_else(default)
}

/// Makes the folder, and sees to it that what is in it is of this very study, or is to be begun again.
fn prepare(folder: &Path, identity: &Identity, fresh: bool) -> Result<Begin, Failure> {
    let found = Identity::read(&Identity::path(folder, identity.shard))?;
    if found.is_none() && holds_something_else(folder) {
        return Err(Failure::NoResults {
            path: folder.to_owned(),
        });
    }
    fs::create_dir_all(folder).map_err(|cause| Failure::Write {
        path: folder.to_owned(),
        cause,
    })?;
    let table = identity.table(folder);
    let is_same = found.is_some_and(|found| found.fingerprint == identity.fingerprint);
    let is_empty = table.metadata().map_or(true, |data| data.len() == 0);
    match (fresh || is_empty, is_same) {
        (true, _) => Ok(Begin::Again),
        (false, true) => Ok(Begin::Resume),
        (false, false) => Err(Failure::OtherStudy { path: table }),
    }
}

/// Whether there is anything but the files of studies.
fn holds_something_else(folder: &Path) -> bool {
    let Ok(mut entries) = fs::read_dir(folder) else {
        return folder.exists();
    };
    let is_ours = |name: &str| {
        let starts = ["study", "results", ".partial-", "cases"];
        starts.iter().any(|start| name.starts_with(start))
    };
    entries.any(|entry| entry.map_or(true, |entry| !is_ours(&entry.file_name().to_string_lossy())))
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Report {
    cases: usize,
    #[serde(flatten)]
    tally: Tally,
    table: String,
}

fn report(
    arguments: &StudyArguments,
    tally: Tally,
    table: &Path,
    cases: usize,
) -> Result<Outcome, Failure> {
    let report = Report {
        cases,
        tally,
        table: table.display().to_string(),
    };
    if arguments.json {
        terminal::print(&output::json(&report)?)?;
    }
    if is_watched(arguments) {
        terminal::tell(&format!("{}; {}", words(tally, cases), report.table));
    }
    Ok(match tally.done() {
        done if done < cases => Outcome::Stopped,
        _ if tally.is_certified() => Outcome::Done,
        _ => Outcome::NotConverged,
    })
}

/// How the cases ended, in words.
#[must_use]
pub fn words(tally: Tally, cases: usize) -> String {
    let Tally {
        certified,
        not_converged,
        cut_off,
        failed,
    } = tally;
    let others = [
        (not_converged, "not converged"),
        (cut_off, "cut off"),
        (failed, "failed"),
        (cases - tally.done(), "to do"),
    ];
    let others = others.into_iter().filter(|(count, _)| *count > 0);
    let others = others.map(|(count, word)| format!(", {count} {word}"));
    format!(
        "{cases} cases: {certified} certified{}",
        others.collect::<String>()
    )
}

fn list(study: &Study, shard: Shard) -> Result<Outcome, Failure> {
    let cases = (0..study.len()).filter(|case| shard.holds(*case));
    let line = |case| format!("case {}: {}\n", case + 1, study.words(case));
    terminal::print(&cases.map(line).collect::<String>())?;
    Ok(Outcome::Done)
}
