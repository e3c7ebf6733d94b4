//! What a picture says of its data: grid, certificate, grid error.

use pellicle_cli::display::significant;
use pellicle_cli::output::summary::{EstimateSummary, LevelSummary, StepSummary};

use super::number::power;
use crate::PaperRun;

/// What the brackets in the notes of steps mean.
pub(super) const BRACKETS: &str =
    "[…]: not resolved by the grids; the change from the next coarser grid";

/// The note of one loading step.
pub(super) fn of_step(run: &PaperRun, step: &StepSummary) -> String {
    let errors = &step.grid_error;
    format!(
        "{}, certificate {}; grid error of D {}, of the area {}, of the largest p {}",
        grid(run),
        power(step.certificate.worst, 1),
        error(
            step.penetration,
            errors.penetration,
            last_change(step, |level| level.penetration)
        ),
        error(
            step.contact_area,
            errors.contact_area,
            last_change(step, |level| level.contact_area)
        ),
        error(
            step.max_pressure,
            errors.max_pressure,
            last_change(step, |level| level.max_pressure)
        ),
    )
}

/// The note of a loading path of which penetration and largest pressure are of interest.
pub(super) fn of_path(run: &PaperRun, with_peak: bool) -> String {
    let worst = |of: fn(&StepSummary) -> f64| run.steps().iter().map(of).fold(0.0, f64::max);
    let penetration = worst(|step| last_change(step, |level| level.penetration).abs());
    let peak = worst(|step| last_change(step, |level| level.max_pressure).abs());
    let peak = if with_peak {
        format!(", of the largest p ≤ {}", percent(peak))
    } else {
        String::new()
    };
    format!(
        "{}, {} loads, certificates ≤ {}; change of D from the next coarser grid ≤ {}{peak}",
        grid(run),
        run.steps().len(),
        power(run.worst(), 1),
        percent(penetration),
    )
}

fn grid(run: &PaperRun) -> String {
    let n = run.record.grid.elements;
    format!("{n} × {n} elements")
}

/// The estimated error, or, where there is none that means something, the change from the next coarser grid.
fn error(value: f64, estimate: Option<EstimateSummary>, change: f64) -> String {
    match estimate {
        Some(error) if error.resolved => format!("± {}", percent(error.estimate / value)),
        _ if change.is_finite() => format!("[{}]", percent(change)),
        _ => "unknown".into(),
    }
}

/// By how much a number changed from the next coarser grid to the finest, as a part of it.
fn last_change(step: &StepSummary, value: fn(&LevelSummary) -> f64) -> f64 {
    match step.grid_error.levels.as_slice() {
        [.., coarser, finest] => 1.0 - value(coarser) / value(finest),
        _ => f64::NAN,
    }
}

/// A part as percent with two digits.
fn percent(part: f64) -> String {
    let text = significant(100.0 * part, 2).replace('-', "−");
    format!("{text} %")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_that_is_not_resolved_is_not_given_as_an_error() {
        let estimate = |resolved| {
            Some(EstimateSummary {
                estimate: 0.02,
                order: None,
                resolved,
            })
        };
        assert_eq!(error(2.0, estimate(true), 0.5), "± 1.0 %");
        assert_eq!(error(2.0, estimate(false), 0.31), "[31 %]");
        assert_eq!(error(2.0, None, f64::NAN), "unknown");
    }
}
