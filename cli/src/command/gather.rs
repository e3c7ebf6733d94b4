//! `pellicle gather`: merges the parts of a study.

use pellicle_study::gather::{self, OtherTable};

use crate::arguments::GatherArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::terminal;

/// The largest number of missing cases that are named.
const MAX_NAMED: usize = 10;

/// Writes the merged table if every case is there; otherwise names the missing ones.
///
/// # Errors
///
/// [`Failure`] if there are no parts or they do not belong together.
pub fn gather(arguments: &GatherArguments) -> Result<Outcome, Failure> {
    let other = if arguments.force {
        OtherTable::Replace
    } else {
        OtherTable::Keep
    };
    let found = gather::gather(&arguments.folder, other)?;
    let cases = found.tally.done() + found.missing.len();
    terminal::report(&found.tally.words(cases));
    let Some(table) = found.table else {
        let first = found.missing.iter().take(MAX_NAMED);
        let names: Vec<_> = first.map(|case| (case + 1).to_string()).collect();
        let more = if found.missing.len() > MAX_NAMED {
            ", …"
        } else {
            ""
        };
        let names = names.join(", ");
        terminal::report(&format!(
            "Error: nothing is written: cases {names}{more} are missing"
        ));
        return Ok(Outcome::NotConverged);
    };
    terminal::report(&format!("written to {}", table.display()));
    Ok(if found.tally.is_certified() {
        Outcome::Done
    } else {
        Outcome::NotConverged
    })
}
