//! Controls of the grid error: a result that converges is called resolved, one that diverges is not.

use pellicle_contact::{FlatPunch, Indenter, Load, Step};
use pellicle_kernel::Foundation;

use crate::comparison::Comparison;
use crate::run::{ContactSetup, ValidationError, ValidationRun, paraboloid, unit_material};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "The grid error's controls",
    source: "Hertz's peak is finite, that at the rim of a flat punch is not",
    because: "a word: the verdict on the largest pressure",
    rows,
};

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let punch = Indenter::FlatPunch(FlatPunch::new(0.1)?);
    let verdict = |indenter| -> Result<&str, ValidationError> {
        let body = Foundation::half_space(unit_material()?);
        let load = Load::Force(4e-3 / 3.0);
        let path = run.solve(&ContactSetup::bare(body, indenter, (0.3, 256), load))?;
        Ok(of_the_peak(&path.steps[0]))
    };
    Ok(vec![
        Comparison::words("Hertz".into(), "resolved", verdict(paraboloid(1.0)?)?),
        Comparison::words("Flat punch".into(), "unresolved", verdict(punch)?),
    ])
}

fn of_the_peak(step: &Step) -> &'static str {
    match step.grid_error.max_pressure {
        Some(estimate) if estimate.resolved => "resolved",
        Some(_) => "unresolved",
        None => "nothing",
    }
}
