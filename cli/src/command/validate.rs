//! `pellicle validate`: the program beside what is known otherwise.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::arguments::ValidateArguments;
use crate::failure::Failure;
use crate::program::Outcome;
use crate::validation::{PLANS, Plan, Report, Scene, Section, heading, section_text};
use crate::{output, terminal, threads};

/// Computes every section and prints its rows as they come, or JSON at the end.
///
/// # Errors
///
/// [`Failure`] if the threads cannot be had or standard output cannot be written to.
pub fn validate(arguments: &ValidateArguments) -> Result<Outcome, Failure> {
    let start = Instant::now();
    threads::set(arguments.threads)?;
    let scene = Scene {
        perturbation: arguments.perturb_coefficients,
    };
    warn_of_hook(scene);
    if !arguments.json {
        terminal::print(&heading())?;
    }
    let mut sections = Vec::new();
    for (count, plan) in PLANS.iter().enumerate() {
        let section = watched(plan, count, scene);
        if !arguments.json {
            terminal::print(&section_text(&section))?;
        }
        sections.push(section);
    }
    let report = Report::new(scene, &sections, start.elapsed().as_secs_f64());
    terminal::print(&if arguments.json {
        output::json(&report)?
    } else {
        report.conclusion()
    })?;
    if report.passes() {
        return Ok(Outcome::Done);
    }
    terminal::tell("Error: the validation fails: do not trust this program's numbers");
    Ok(Outcome::Refuted)
}

fn warn_of_hook(scene: Scene) {
    let by = scene.perturbation;
    if by.abs() > 0.0 {
        terminal::tell(&format!(
            "test hook: every influence coefficient is multiplied by 1 + {by:e}"
        ));
    }
}

/// Computes a section with a line on the terminal meanwhile.
fn watched(plan: &Plan, count: usize, scene: Scene) -> Section {
    let line = ProgressBar::new_spinner();
    // The template is a constant: were it faulty, the default style would stand.
    if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {msg}") {
        line.set_style(style);
    }
    line.set_message(format!("{}/{}: {}", count + 1, PLANS.len(), plan.name));
    line.enable_steady_tick(Duration::from_millis(100));
    let section = plan.carry_out(scene);
    line.finish_and_clear();
    section
}
