//! One loading step in the report: its numbers with their errors, and its certificate in words.

use pellicle_contact::Estimate;

use crate::case::units::Units;
use crate::display::{Unit, error_of, quantity, significant};
use crate::output::summary::{CertificateSummary, StepSummary, Summary};

/// The numbers of a step as a table.
#[must_use]
pub fn numbers(summary: &Summary, step: &StepSummary) -> String {
    let units = summary.units;
    let error = &step.grid_error;
    let plain = |name: &str, value, unit| row(name, &quantity(value, unit, units), "");
    let estimated = |name: &str, value, unit, error| {
        row(
            name,
            &quantity(value, unit, units),
            &note(value, unit, error, units),
        )
    };
    let [x, y] = step
        .max_pressure_at
        .map(|at| quantity(at, Unit::Metre, units));
    let mut rows = vec![
        plain("force Q", step.force, Unit::Newton),
        estimated(
            "penetration D",
            step.penetration,
            Unit::Metre,
            error.penetration,
        ),
        estimated(
            "largest pressure",
            step.max_pressure,
            Unit::Pascal,
            error.max_pressure,
        ),
        row("at x, y", &format!("{x}, {y}"), ""),
        plain("mean pressure", step.mean_pressure, Unit::Pascal),
        estimated(
            "contact area",
            step.contact_area,
            Unit::SquareMetre,
            error.contact_area,
        ),
        plain("contact radius", step.contact_radius, Unit::Metre),
        plain(
            "contact stiffness",
            step.contact_stiffness.unwrap_or(0.0),
            Unit::NewtonPerMetre,
        ),
        row(
            "elements in contact",
            &step.contact_elements.to_string(),
            "",
        ),
    ];
    if summary.has_relief() {
        let (on, between) = (step.contact_area_on_relief, step.contact_area_between);
        rows.push(plain("contact on the relief", on, Unit::SquareMetre));
        rows.push(plain("contact beside it", between, Unit::SquareMetre));
    }
    format!(
        "<table><thead><tr><th>quantity</th><th>value</th><th>estimated error of the grid</th></tr></thead>\n<tbody>\n{}</tbody></table>\n",
        rows.concat()
    )
}

fn row(name: &str, value: &str, note: &str) -> String {
    format!("<tr><th>{name}</th><td class=\"number\">{value}</td><td>{note}</td></tr>\n")
}

/// How far the grid can be trusted with a number.
fn note(value: f64, unit: Unit, error: Option<Estimate>, units: Units) -> String {
    let Some(error) = error else {
        return "none: there was one grid only".into();
    };
    if !error.resolved {
        return "<strong>not resolved</strong>: the number still changes from grid to grid".into();
    }
    let order = error.order.map(|order| format!(", order {order:.1}"));
    error_of(value, error.estimate, unit, units) + &order.unwrap_or_default()
}

/// The certificate of a step in words.
#[must_use]
pub fn certificate(certificate: &CertificateSummary, tolerance: f64) -> String {
    let part = |value: f64| significant(value, 2);
    let lines = [
        format!(
            "Where there is pressure the surfaces touch: the gap there, weighted by the pressure, is {} of the penetration, \
             and nowhere more than {}.",
            part(certificate.complementarity),
            part(certificate.gap_in_contact)
        ),
        format!(
            "The bodies do not overlap by more than {} of the penetration.",
            part(certificate.overlap)
        ),
        format!(
            "The pressures add up to the force but for {} of it.",
            part(certificate.load)
        ),
        pulling(certificate.min_pressure),
    ];
    let lines = lines.map(|line| format!("<li>{line}</li>\n")).concat();
    let (worst, bound) = (part(certificate.worst), part(tolerance));
    let verdict = if certificate.satisfied {
        format!(
            "<p class=\"verdict good\">Satisfied: the worst of these is {worst}, the bound is {bound}.</p>"
        )
    } else {
        format!(
            "<p class=\"verdict bad\">NOT SATISFIED: the worst of these is {worst}, the bound is {bound}. \
             Do not use these numbers.</p>"
        )
    };
    format!(
        "<p>Computed afresh from the pressure alone, not from the iteration that found it:</p>\n<ul>\n{lines}</ul>\n{verdict}\n"
    )
}

fn pulling(min_pressure: f64) -> String {
    if min_pressure >= 0.0 {
        "Nothing pulls: no pressure is negative.".into()
    } else {
        "The surfaces pull at each other somewhere, or a pressure is no number.".into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: CertificateSummary = CertificateSummary {
        complementarity: 1e-10,
        gap_in_contact: 2e-9,
        overlap: 3e-9,
        load: 0.0,
        min_pressure: 0.0,
        worst: 3e-9,
        satisfied: true,
    };

    #[test]
    fn a_certificate_says_its_verdict() {
        assert!(
            certificate(&GOOD, 1e-8)
                .contains("Satisfied: the worst of these is 3.0e-9, the bound is 1.0e-8")
        );
        let bad = CertificateSummary {
            worst: f64::NAN,
            min_pressure: f64::NAN,
            satisfied: false,
            ..GOOD
        };
        let text = certificate(&bad, 1e-8);
        assert!(text.contains("NOT SATISFIED") && text.contains("pull at each other"));
    }
}
