//! Pellicle beside its rivals: every program on the same problems, in the same run, judged by the same certificate.
//!
//! The problems stand in [`problem`], the rivals and what they need in [`rival`], their drivers and the certificate
//! in Python under `xtask/compare`. Every run is a process of its own, and the programs take turns.

mod arguments;
mod case;
mod certificate;
mod contest;
mod entrant;
mod environment;
mod lane;
mod measurement;
mod pellicle;
mod problem;
mod process;
mod report;
mod rival;
mod row;
mod table;
mod workshop;

use std::path::Path;

pub use arguments::CompareArguments;
pub use case::Case;
pub use certificate::Certificate;
pub use measurement::Measurement;
pub use pellicle::{PellicleArguments, run_pellicle};
pub use problem::Problem;
pub use report::Report;
pub use rival::Rival;
pub use row::{Outcome, Row, Solved};

use crate::XtaskError;
use contest::Contest;
use workshop::Workshop;

/// Runs the comparison of `arguments` in the workspace at `root`, writes `rivals.md` and `rivals.json` to the folder
/// of results after every problem, and returns them; `tell` hears what is going on.
///
/// # Errors
/// A problem that cannot be posed, Pellicle not built, no Python for the certificate, a file that cannot be written.
/// A rival that is missing, fails or takes too long is a row of the report, not an error.
pub fn compare(
    arguments: &CompareArguments,
    root: &Path,
    tell: &mut dyn FnMut(&str),
) -> Result<Report, XtaskError> {
    let problems = arguments.problems()?;
    let workshop = Workshop::prepare(arguments, root, tell)?;
    let mut report = Report::new();
    for problem in problems {
        for &threads in &arguments.threads {
            let contest = Contest {
                problem,
                threads,
                arguments,
                workshop: &workshop,
            };
            report.rows.extend(contest.run(tell)?);
            report.write(workshop.results())?;
        }
    }
    Ok(report)
}
