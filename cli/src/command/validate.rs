//! `pellicle validate`: compares the program with known results.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use pellicle_files::json;
use pellicle_validation::{
    SECTIONS, SectionResult, ValidationReport, ValidationRun, ValidationSection, heading,
    section_text,
};

use crate::arguments::ValidateArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::{terminal, threads};

/// Computes every section and prints its rows as they come, or JSON at the end.
///
/// # Errors
///
/// [`Failure`] if the threads cannot be started or standard output cannot be written to.
pub fn validate(arguments: &ValidateArguments) -> Result<Outcome, Failure> {
    let start = Instant::now();
    threads::set(arguments.threads)?;
    let run = ValidationRun {
        perturbation: arguments.perturb_coefficients,
    };
    warn_of_hook(run);
    if !arguments.json {
        terminal::print(&heading())?;
    }
    let mut sections = Vec::new();
    for (count, section) in SECTIONS.iter().enumerate() {
        let section = compute_with_progress(section, count, run);
        if !arguments.json {
            terminal::print(&section_text(&section))?;
        }
        sections.push(section);
    }
    let report = ValidationReport::new(run, &sections, start.elapsed().as_secs_f64());
    terminal::print(&if arguments.json {
        json(&report)?
    } else {
        report.conclusion()
    })?;
    if report.passes() {
        return Ok(Outcome::Done);
    }
    terminal::report("Error: the validation fails: do not trust this program's numbers");
    Ok(Outcome::Refuted)
}

fn warn_of_hook(run: ValidationRun) {
    let by = run.perturbation;
    if by.abs() > 0.0 {
        terminal::report(&format!(
            "test hook: every influence coefficient is multiplied by 1 + {by:e}"
        ));
    }
}

/// Computes a section, with a progress line on the terminal.
fn compute_with_progress(
    section: &'static ValidationSection,
    count: usize,
    run: ValidationRun,
) -> SectionResult {
    let line = ProgressBar::new_spinner();
    // The template is a constant; if it were invalid, the default style would remain.
    if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
        line.set_style(style);
    }
    line.set_message(format!(
        "{}/{}: {}",
        count + 1,
        SECTIONS.len(),
        section.name
    ));
    line.enable_steady_tick(Duration::from_millis(100));
    let section = section.compute(run);
    line.finish_and_clear();
    section
}
