//! One loading step in the report: its numbers with their errors, and its certificate.

use pellicle::display::{Unit, quantity, significant};
use pellicle::result::quantities::QUANTITIES;
use pellicle::result::quantity::{Measure, Part, Value};
use pellicle::summary::{CertificateSummary, RunSummary, StepSummary};
use pellicle_plot::step::surface_figure::SurfaceFigure;

use super::grid_error::GridErrorNote;
use super::stress::StressTable;
use crate::output::pictures::{StepDrawings, StepPicture, StressPicture};

/// The section of a step.
pub struct StepSection<'a> {
    /// Loading step, counted from 0.
    pub index: usize,
    pub force: String,
    pub rows: Vec<NumberRow>,
    pub certificate: CertificateText,
    pub drawings: &'a [(StepPicture, String)],
    /// The extremes of the stresses, if requested.
    pub stresses: Option<StressTable>,
    pub stress_drawings: &'a [(StressPicture, String)],
    pub surface: Option<&'a SurfaceFigure>,
}

/// A number of a step.
pub struct NumberRow {
    pub name: String,
    pub value: String,
    pub error: GridErrorNote,
}

/// The lines of a certificate, with numbers as on the page.
pub struct CertificateText {
    pub complementarity: String,
    pub gap_in_contact: String,
    pub overlap: String,
    pub load: String,
    /// Whether a pressure is negative or NaN.
    pub negative_pressure: bool,
    pub worst: String,
    pub bound: String,
    pub satisfied: bool,
}

impl<'a> StepSection<'a> {
    pub fn new(summary: &RunSummary, drawings: &'a StepDrawings) -> Self {
        let step = &summary.steps[drawings.step];
        let tolerance = summary.case["solver"]["tolerance"].as_f64();
        Self {
            index: drawings.step,
            force: quantity(step.force, Unit::Newton, summary.units),
            rows: rows(summary, step),
            certificate: CertificateText::new(&step.certificate, tolerance.unwrap_or(f64::NAN)),
            drawings: &drawings.drawings,
            stresses: (step.stress.as_ref()).map(|stress| StressTable::new(stress, summary)),
            stress_drawings: &drawings.stresses,
            surface: drawings.surface.as_ref(),
        }
    }
}

fn rows(summary: &RunSummary, step: &StepSummary) -> Vec<NumberRow> {
    let told = QUANTITIES.iter().filter(|of| of.part != Part::Solution);
    let rows = told.filter_map(|of| {
        let error = match ((of.value)(step)?, of.measure) {
            (Value::Number(value), Measure::Of(unit)) if of.error.is_some() => {
                GridErrorNote::new(value, unit, of.error_in(step), summary.units)
            }
            _ => GridErrorNote::NotEstimated,
        };
        Some(NumberRow {
            name: of.title(),
            value: of.words(step, summary)?,
            error,
        })
    });
    rows.collect()
}

impl CertificateText {
    fn new(certificate: &CertificateSummary, tolerance: f64) -> Self {
        let part = |value: f64| significant(value, 2);
        let CertificateSummary {
            lines,
            worst,
            satisfied,
        } = *certificate;
        let negative_pressure = lines.min_pressure < 0.0 || lines.min_pressure.is_nan();
        Self {
            complementarity: part(lines.complementarity),
            gap_in_contact: part(lines.gap_in_contact),
            overlap: part(lines.overlap),
            load: part(lines.load),
            negative_pressure,
            worst: part(worst),
            bound: part(tolerance),
            satisfied,
        }
    }
}

#[cfg(test)]
mod tests {
    use pellicle_contact::Certificate;

    use super::*;

    const LINES: Certificate = Certificate {
        complementarity: 1e-10,
        gap_in_contact: 2e-9,
        overlap: 3e-9,
        load: 0.0,
        min_pressure: 0.0,
        gap_at_limit: None,
        over_limit: None,
        tolerance: 1e-8,
    };
    const GOOD: CertificateSummary = CertificateSummary {
        lines: LINES,
        worst: 3e-9,
        satisfied: true,
    };

    #[test]
    fn a_nan_pressure_counts_as_negative() {
        let text = CertificateText::new(&GOOD, 1e-8);
        assert_eq!((&text.worst[..], &text.bound[..]), ("3.0e-9", "1.0e-8"));
        assert!(!text.negative_pressure);
        let lines = Certificate {
            min_pressure: f64::NAN,
            ..LINES
        };
        let bad = CertificateSummary { lines, ..GOOD };
        assert!(CertificateText::new(&bad, 1e-8).negative_pressure);
    }
}
