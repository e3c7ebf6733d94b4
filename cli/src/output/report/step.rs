//! One loading step in the report: its numbers with their errors, and its certificate.

use super::grid_error::GridErrorNote;
use super::stress::StressTable;
use super::surface::SurfaceFigure;
use crate::display::{Unit, position, quantity, significant};
use crate::output::pictures::{StepDrawings, StepPicture, StressPicture};
use crate::output::summary::{CertificateSummary, RunSummary, StepSummary};

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
    pub name: &'static str,
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
    let units = summary.units;
    let (numbers, errors) = (&step.summary, &step.grid_error);
    let plain = |name, value| NumberRow {
        name,
        value,
        error: GridErrorNote::NotEstimated,
    };
    let number = |name, value, unit| plain(name, quantity(value, unit, units));
    let estimated = |name, value, unit, error| NumberRow {
        error: GridErrorNote::new(value, unit, error, units),
        ..number(name, value, unit)
    };
    let element_side = summary.grid.element_side;
    let at = position(numbers.max_pressure_at, element_side, units);
    let stiffness = step.contact_stiffness.unwrap_or(0.0);
    let mut rows = vec![
        number("force Q", step.force, Unit::Newton),
        estimated(
            "penetration D",
            step.penetration,
            Unit::Metre,
            errors.penetration,
        ),
        estimated(
            "largest pressure",
            numbers.max_pressure,
            Unit::Pascal,
            errors.max_pressure,
        ),
        plain("at x, y", at),
        number("mean pressure", numbers.mean_pressure, Unit::Pascal),
        estimated(
            "contact area",
            numbers.contact_area,
            Unit::SquareMetre,
            errors.contact_area,
        ),
        number("contact radius", numbers.contact_radius, Unit::Metre),
        number("contact stiffness", stiffness, Unit::NewtonPerMetre),
        plain("elements in contact", numbers.contact_elements.to_string()),
    ];
    if let (Some(fraction), Some(depth)) = (numbers.fraction_at_limit, numbers.plastic_depth) {
        rows.push(plain("fraction at the hardness", significant(fraction, 4)));
        rows.push(number("plastic depth", depth, Unit::Metre));
    }
    if let Some(nominal) = numbers.nominal_pressure {
        rows.push(number("nominal pressure", nominal, Unit::Pascal));
    }
    if summary.has_relief() {
        let (on, between) = (numbers.contact_area_on_relief, numbers.contact_area_between);
        rows.push(number("contact area on the relief", on, Unit::SquareMetre));
        rows.push(number(
            "contact area beside the relief",
            between,
            Unit::SquareMetre,
        ));
    }
    if let Some(rough) = &step.rough_contact {
        let islands = rough.islands.count.to_string();
        rows.extend([
            number("nominal area", rough.nominal_area, Unit::SquareMetre),
            plain("contact fraction", significant(rough.contact_fraction, 4)),
            number(
                "contact area by counting elements",
                rough.counted_area,
                Unit::SquareMetre,
            ),
            number(
                "… with perimeter correction",
                rough.corrected_area,
                Unit::SquareMetre,
            ),
            number("mean gap", rough.mean_gap, Unit::Metre),
            plain("islands", islands),
            number(
                "largest island",
                rough.islands.largest_area,
                Unit::SquareMetre,
            ),
        ]);
    }
    rows
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
