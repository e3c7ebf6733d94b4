//! The accuracy of a picture's data in words: grid, certificate, grid error.

use pellicle::display::significant;
use pellicle::summary::{GridSummary, StepSummary};
use pellicle_contact::{ErrorEstimate, LevelValues};
use pellicle_plot::axes::labels::power;

/// The meaning of an unresolved number of [`of_step`].
pub const UNRESOLVED: &str =
    "Unresolved: it still changes from grid to grid, by so much from the next coarser one";

/// Describes the certificate of a step on a grid and the errors of its results: `± 0.1 %`
/// where the grids resolve it, otherwise the change from the next coarser grid, `13 % (unresolved)`.
#[must_use]
pub fn of_step(grid: &GridSummary, step: &StepSummary) -> String {
    let (errors, elements) = (&step.grid_error, grid.elements_in_words());
    format!(
        "{elements} elements, certificate {}; grid error: D {}, area {}, largest p {}",
        power(step.certificate.worst, 1),
        error(
            step.penetration,
            errors.penetration,
            last_change(step, |level| level.penetration)
        ),
        error(
            step.summary.contact_area,
            errors.contact_area,
            last_change(step, |level| level.contact_area)
        ),
        error(
            step.summary.max_pressure,
            errors.max_pressure,
            last_change(step, |level| level.max_pressure)
        ),
    )
}

/// The estimated error, or the change from the next coarser grid if the estimate is not resolved.
fn error(value: f64, estimate: Option<ErrorEstimate>, change: f64) -> String {
    match estimate {
        Some(error) if error.resolved => format!("± {}", percent(error.estimate / value)),
        _ if change.is_finite() => format!("{} (unresolved)", percent(change)),
        _ => "unknown".into(),
    }
}

/// Returns the relative change of a result from the next coarser grid to the finest; NaN on a single grid.
#[must_use]
pub fn last_change(step: &StepSummary, value: fn(&LevelValues) -> f64) -> f64 {
    match step.grid_error.levels.as_slice() {
        [.., coarser, finest] => 1.0 - value(coarser) / value(finest),
        _ => f64::NAN,
    }
}

/// Percentages smaller than this are written as powers of ten.
const SMALL: f64 = 1e-3;

/// Writes a fraction as a percentage with two digits: `0.21 %`, `7.2·10⁻⁵ %`.
#[must_use]
pub fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    let size = percent.abs();
    if 0.0 < size && size < SMALL {
        let sign = if percent < 0.0 { "−" } else { "" };
        return format!("{sign}{} %", power(size, 2));
    }
    let text = significant(percent, 2).replace('-', "−");
    format!("{text} %")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unresolved_grid_error_is_called_so() {
        let estimate = |resolved| {
            Some(ErrorEstimate {
                estimate: 0.02,
                order: None,
                resolved,
            })
        };
        assert_eq!(error(2.0, estimate(true), 0.5), "± 1.0 %");
        assert_eq!(error(2.0, estimate(false), 0.31), "31 % (unresolved)");
        assert_eq!(error(2.0, None, f64::NAN), "unknown");
    }

    #[test]
    fn percentages_have_two_digits_however_small() {
        let parts = [0.0, -0.0021, 1.1e-5, 7.2e-7, -1.26e-6];
        let words = ["0 %", "−0.21 %", "0.0011 %", "7.2·10⁻⁵ %", "−1.3·10⁻⁴ %"];
        assert_eq!(parts.map(percent), words);
    }
}
