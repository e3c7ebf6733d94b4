//! `pellicle study`: solves a case for many values of its keys.

use std::path::{Path, PathBuf};
use std::time::Duration;

use pellicle::forecast::Forecast;
use pellicle::memory::MemoryBudget;
use pellicle_files::{FileError, json};
use pellicle_study::case_folder::CaseFolders;
use pellicle_study::case_solver::CaseSolver;
use pellicle_study::case_status::Tally;
use pellicle_study::folder::{self as study_folder, StudyFolder};
use pellicle_study::identity::StudyIdentity;
use pellicle_study::kept_file::KeptFields;
use pellicle_study::kept_record::FieldKeeper;
use pellicle_study::plan::StudyPlan;
use pellicle_study::report as study_report;
use pellicle_study::results_table::ResultsTable;
use pellicle_study::shard::Shard;
use pellicle_study::status::StudyStatus;
use pellicle_study::{Study, StudyError};
use pellicle_study::{runner, study_file};
use serde::Serialize;

use crate::arguments::StudyArguments;
use crate::case_folders::{ResultsFolders, discard_cases};
use crate::command::Outcome;
use crate::failure::Failure;
use crate::progress::in_words;
use crate::progress::study::{StudyProgress, rate_in_words};
use crate::{cache, interrupt, terminal};

/// Number of bytes of the list of cases printed at once.
const LISTED_AT_ONCE: usize = 1 << 16;

/// Number of cases of a study whose time is forecast.
const FORECAST_CASES: usize = 8;

/// Solves the remaining cases and prints the number of cases by status.
///
/// # Errors
///
/// [`Failure`] if the study is invalid or its table cannot be written; not if a case fails.
pub fn study(arguments: &StudyArguments) -> Result<Outcome, Failure> {
    let study = study_file::read(&arguments.path, &arguments.sets)?;
    let plan = StudyPlan::new(&study, arguments.shard.resolve()?)?;
    if arguments.list {
        list(&study, &plan.identity)?;
        report_stress_time(&study, &plan.identity);
        return Ok(Outcome::Done);
    }
    if let Some(words) = plan.refused.words().filter(|_| prints_text(arguments)) {
        terminal::report(&format!("warning: {words}"));
    }
    let folder = folder(arguments, &study);
    if arguments.status {
        return print_status(arguments, &folder, &plan.identity);
    }
    if arguments.report {
        return write_report(&folder, &plan.identity);
    }
    let place = StudyFolder::claim(&folder, &plan.identity, arguments.fresh, &discard_cases)?;
    if let Some(before) = place.before.as_ref().filter(|_| prints_text(arguments)) {
        terminal::report(&format!(
            "the old table is kept until the new one is complete: {}",
            before.display()
        ));
    }
    let mut table = ResultsTable::open(place, &plan.identity)?;
    let cases = plan.identity.case_count();
    let to_do = table.remaining(&plan.identity);
    let lines = StudyProgress::new(cases, cases - to_do.count_left(), prints_text(arguments));
    let memory = MemoryBudget::default();
    let done = table.tally().done();
    let kept = KeptFields::open(&folder, &plan.identity, done)?;
    let solver = CaseSolver {
        study: &study,
        columns: &plan.columns,
        cache: cache::open_for_many(),
        memory: &memory,
        folders: (arguments.folders)
            .then(|| (table.place().cases(), &ResultsFolders as &dyn CaseFolders)),
        kept: kept.as_ref().map(|kept| kept as &dyn FieldKeeper),
    };
    let threads = arguments
        .threads
        .map_or_else(runner::default_threads, usize::from);
    let solve = || runner::run(&solver, to_do, threads, &mut table, &lines);
    interrupt::finish_running_cases(solve)?;
    cache::report_warnings(&solver.cache);
    let (tally, path) = (table.tally(), table.path().to_owned());
    if tally.done() == cases {
        kept.as_ref().map_or(Ok(()), KeptFields::finish)?;
        table.finish(&plan.identity)?;
        if plan.identity.shard == Shard::WHOLE {
            study_report::write(&folder, std::slice::from_ref(&plan.identity))?;
        }
    }
    report(arguments, tally, &path, cases)
}

fn prints_text(arguments: &StudyArguments) -> bool {
    !arguments.quiet && !arguments.json
}

/// The output of `--status --json`.
#[derive(Debug, Serialize)]
struct StatusReport {
    cases: usize,
    #[serde(flatten)]
    tally: Tally,
    parts_at_work: usize,
    cases_per_second: Option<f64>,
    seconds_left: Option<f64>,
}

/// Prints the progress of the study.
fn print_status(
    arguments: &StudyArguments,
    folder: &Path,
    identity: &StudyIdentity,
) -> Result<Outcome, Failure> {
    let status = StudyStatus::read(folder, identity)?;
    if arguments.json {
        let report = StatusReport {
            cases: status.cases,
            tally: status.tally,
            parts_at_work: status.parts_at_work,
            cases_per_second: status.rate,
            seconds_left: status.time_left().map(|left| left.as_secs_f64()),
        };
        terminal::print(&json(&report)?)?;
        return Ok(Outcome::Done);
    }
    let parts = match status.parts_at_work {
        0 => "; no process is working on it".to_owned(),
        1 => "; 1 part at work".to_owned(),
        count => format!("; {count} parts at work"),
    };
    let rate = status.rate.map(|rate| format!(", {}", rate_in_words(rate)));
    let left = status.time_left();
    let left = left.map(|left| format!(", {} left", in_words(left)));
    let rest = rate.unwrap_or_default() + &left.unwrap_or_default();
    terminal::print(&format!(
        "{}{parts}{rest}\n",
        status.tally.words(status.cases)
    ))?;
    Ok(Outcome::Done)
}

/// Writes the report of the cases done so far in all parts of the study, and prints its path.
fn write_report(folder: &Path, identity: &StudyIdentity) -> Result<Outcome, Failure> {
    let mut parts = study_folder::identities(folder)?;
    parts.retain(|part| part.fingerprint == identity.fingerprint);
    // A merged table repeats the cases of all parts.
    if let Some(whole) = parts.iter().position(|part| part.shard == Shard::WHOLE) {
        parts.swap(0, whole);
        if StudyStatus::read(folder, identity)?.to_do() == 0 {
            parts.truncate(1);
        }
    }
    let path = folder.join(study_report::FILE);
    if parts.is_empty() {
        return Err(StudyError::NoParts {
            path: folder.to_owned(),
        }
        .into());
    }
    if !study_report::write(folder, &parts)? {
        return Err(FileError::NotWritten { path }.into());
    }
    terminal::print(&format!("{}\n", path.display()))?;
    Ok(Outcome::Done)
}

/// The given folder, or `results/NAME` after the study.
fn folder(arguments: &StudyArguments, study: &Study) -> PathBuf {
    let default = || Path::new("results").join(&study.name);
    arguments.out.clone().unwrap_or_else(default)
}

/// The output of `--json`.
#[derive(Debug, Serialize)]
struct StudyReport {
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
    let report = StudyReport {
        cases,
        tally,
        table: table.display().to_string(),
    };
    if arguments.json {
        terminal::print(&json(&report)?)?;
    }
    if prints_text(arguments) {
        terminal::report(&format!("{}; {}", tally.words(cases), report.table));
    }
    Ok(match tally.done() {
        done if done < cases => Outcome::Stopped,
        _ if tally.is_certified() || arguments.tolerate_failures => Outcome::Done,
        _ => Outcome::NotConverged,
    })
}

/// Prints the cases of a part, in blocks.
fn list(study: &Study, identity: &StudyIdentity) -> Result<(), Failure> {
    let mut text = String::new();
    for case in identity.cases() {
        let line = format!("case {}: {}\n", case + 1, study.words(case));
        text.push_str(&line);
        if text.len() > LISTED_AT_ONCE {
            terminal::print(&std::mem::take(&mut text))?;
        }
    }
    terminal::print(&text)?;
    Ok(())
}

/// Reports the time that the stresses of a part take, by the forecasts of some cases that are spread evenly over it.
fn report_stress_time(study: &Study, identity: &StudyIdentity) {
    let (cases, cache) = (identity.case_count(), cache::open_for_many());
    let apart = cases.div_ceil(FORECAST_CASES).max(1);
    let mut forecasts = Vec::new();
    for case in identity.cases().step_by(apart) {
        // An invalid case is recorded as failed in its turn.
        let Ok(case) = study.case(case) else {
            continue;
        };
        let cost = match &case.stress {
            Some(_) => (case.model(&cache).ok())
                .and_then(|model| Forecast::new(&case, &model.value).stress),
            None => None,
        };
        forecasts.push(cost.map_or(0.0, |cost| cost.total().as_secs_f64()));
    }
    let sum: f64 = forecasts.iter().sum();
    if sum > 0.0 {
        let all = sum / forecasts.len() as f64 * cases as f64;
        let time = in_words(Duration::try_from_secs_f64(all).unwrap_or(Duration::MAX));
        terminal::report(&format!(
            "stresses and critical loads take about {time} of CPU time, by the forecast of {} of {cases} cases",
            forecasts.len()
        ));
    }
}
