//! `pellicle study CASE --find CONDITION --by KEY`: the smallest or largest value of a key for which a condition holds.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pellicle::case::BaseCase;
use pellicle::input::source_file;
use pellicle::input::span::Source;
use pellicle::memory::MemoryBudget;
use pellicle::run::Resources;
use pellicle_files::json;
use pellicle_study::find::answer::{Answer, Verdict};
use pellicle_study::find::folder::{SearchFolder, SearchReport};
use pellicle_study::find::tried::Tried;
use pellicle_study::find::{MAX_CASES, Means, Question, Search};

use crate::arguments::StudyArguments;
use crate::command::Outcome;
use crate::command::plot::paper::draw_found;
use crate::failure::Failure;
use crate::progress::find::SearchProgress;
use crate::{cache, interrupt, terminal};

/// Searches, and prints the answer.
///
/// # Errors
///
/// [`Failure`] if the question is wrong, or its folder cannot be written.
pub fn find(arguments: &StudyArguments) -> Result<Outcome, Failure> {
    let base = BaseCase::read(&arguments.path, &arguments.sets)?;
    let search = Search::new(base, &question(arguments))?;
    if arguments.list {
        return list(&search);
    }
    let (folder, before) = SearchFolder::claim(&folder(arguments), &search, arguments.fresh)?;
    let solve = || run(arguments, &search, &folder, before);
    let (answer, tried) = match arguments.threads {
        Some(threads) => {
            let threads = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
            threads.build()?.install(solve)?
        }
        None => solve()?,
    };
    let Some(answer) = answer else {
        return Ok(Outcome::Stopped);
    };
    folder.write(&search, &tried, Some(&answer))?;
    draw_found(folder.path())?;
    if arguments.json {
        let report = SearchReport::new(&search, tried.len(), Some(&answer));
        terminal::print(&json(&report)?)?;
    } else {
        terminal::print(&search.words(&answer))?;
        if !arguments.quiet {
            let cases = pellicle::display::count(tried.len(), "case");
            terminal::report(&format!("{cases} tried; {}", folder.path().display()));
        }
    }
    Ok(match answer.verdict {
        Verdict::Found => Outcome::Done,
        _ => Outcome::NotConverged,
    })
}

/// The question, each text under the name of its option.
fn question(arguments: &StudyArguments) -> Question {
    let text = |option: &str, text: &str| Arc::new(Source::new(option, text.trim().to_owned()));
    let given =
        |option: &str, given: &Option<String>| text(option, given.as_deref().unwrap_or_default());
    Question {
        condition: given("--find", &arguments.find),
        key: given("--by", &arguments.by),
        between: match &arguments.between[..] {
            [low, high] => Some([text("--between", low), text("--between", high)]),
            _ => None,
        },
        within: arguments.within,
    }
}

/// The given folder, or `results/NAME-find` after the case.
fn folder(arguments: &StudyArguments) -> PathBuf {
    let default = || {
        let name = source_file::stem(&arguments.path);
        Path::new("results").join(format!("{name}-find"))
    };
    arguments.out.clone().unwrap_or_else(default)
}

/// Prints the range and the number of cases, and solves none.
fn list(search: &Search) -> Result<Outcome, Failure> {
    let [low, high] = search.range.map(|end| search.key.words(end));
    let words = search.condition.words();
    terminal::print(&format!(
        "{words}: {} from {low} to {high}; 2 cases if it holds at both ends or at neither, \
         else 4 to 10 as a rule and {MAX_CASES} at most\n",
        search.key.path
    ))?;
    Ok(Outcome::Done)
}

fn run(
    arguments: &StudyArguments,
    search: &Search,
    folder: &SearchFolder,
    before: Vec<Tried>,
) -> Result<(Option<Answer>, Vec<Tried>), Failure> {
    let (cache, memory) = (cache::open_for_many(), MemoryBudget::default());
    let means = Means {
        resources: Resources {
            cache: &cache,
            memory: &memory,
            writers: 0,
        },
        monitor: &SearchProgress::new(&search.key.path, !arguments.quiet && !arguments.json),
        keep: &|tried| folder.write(search, tried, None),
    };
    let found = search.run(before, means)?;
    cache::report_warnings(&cache);
    if interrupt::is_requested() {
        return Ok((None, found.1));
    }
    Ok(found)
}
