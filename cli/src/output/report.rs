//! A summary in words, for the person at the terminal.

use super::summary::{EstimateSummary, StepSummary, Summary};
use crate::case::units::Units;
use crate::display::{Unit, quantity, significant};

/// The summary of a run as a few lines; a curve as a table with one line a step.
#[must_use]
pub fn text(summary: &Summary) -> String {
    let mut text = format!("{}\n{}", summary.title, grid(summary));
    match &summary.steps[..] {
        [step] => text.push_str(&single(step, summary.case.units)),
        steps => text.push_str(&table(steps, summary.case.units)),
    }
    text
}

/// The warnings, one a line.
#[must_use]
pub fn warnings(summary: &Summary) -> String {
    let line = |warning: &super::summary::WarningSummary| format!("warning: {}", warning.message);
    let lines: Vec<_> = summary.warnings.iter().map(line).collect();
    lines.join("\n")
}

fn grid(summary: &Summary) -> String {
    let grid = &summary.grid;
    let metres = |value| quantity(value, Unit::Metre, summary.case.units);
    let (side, element_side) = (metres(grid.side), metres(grid.element_side));
    let elements = grid.elements;
    format!(
        "grid {elements} × {elements} on a square of side {side}, element side {element_side}\n"
    )
}

fn single(step: &StepSummary, units: Units) -> String {
    let of = |value, unit| quantity(value, unit, units);
    let error = |estimate: Option<EstimateSummary>, unit| match estimate {
        Some(error) if error.resolved => format!("± {} (grid)", of(error.estimate, unit)),
        Some(_) => "not resolved by the grid".into(),
        None => String::new(),
    };
    let [x, y] = step.max_pressure_at.map(|x| of(x, Unit::Metre));
    let rows = [
        ("force Q", of(step.force, Unit::Newton), String::new()),
        (
            "penetration D",
            of(step.penetration, Unit::Metre),
            error(step.grid_error.penetration, Unit::Metre),
        ),
        (
            "largest pressure",
            of(step.max_pressure, Unit::Pascal),
            error(step.grid_error.max_pressure, Unit::Pascal),
        ),
        ("  at x, y", format!("{x}, {y}"), String::new()),
        (
            "mean pressure",
            of(step.mean_pressure, Unit::Pascal),
            String::new(),
        ),
        (
            "contact area",
            of(step.contact_area, Unit::SquareMetre),
            error(step.grid_error.contact_area, Unit::SquareMetre),
        ),
        (
            "  on the relief",
            of(step.contact_area_on_relief, Unit::SquareMetre),
            String::new(),
        ),
        (
            "  between",
            of(step.contact_area_between, Unit::SquareMetre),
            String::new(),
        ),
        (
            "contact radius",
            of(step.contact_radius, Unit::Metre),
            String::new(),
        ),
        (
            "certificate",
            certificate(step),
            format!("worst line {:.1e}", step.certificate.worst),
        ),
        ("work", work(step), String::new()),
    ];
    let line = |(name, value, note): &(&str, String, String)| {
        let line = format!("  {name:<18}{value:<28}{note}");
        format!("{}\n", line.trim_end())
    };
    rows.iter().map(line).collect()
}

fn certificate(step: &StepSummary) -> String {
    let word = if step.certificate.satisfied {
        "satisfied"
    } else {
        "NOT SATISFIED"
    };
    word.to_owned()
}

fn work(step: &StepSummary) -> String {
    let (products, seconds) = (step.work.operator_applications, step.work.seconds);
    format!("{products} products with K, {} s", significant(seconds, 3))
}

fn table(steps: &[StepSummary], units: Units) -> String {
    const HEAD: [&str; 6] = [
        "step",
        "force",
        "penetration",
        "largest p",
        "contact area",
        "certificate",
    ];
    let of = |value, unit| quantity(value, unit, units);
    let mut text = row(HEAD.map(str::to_owned));
    for (i, step) in steps.iter().enumerate() {
        text.push_str(&row([
            i.to_string(),
            of(step.force, Unit::Newton),
            of(step.penetration, Unit::Metre),
            of(step.max_pressure, Unit::Pascal),
            of(step.contact_area, Unit::SquareMetre),
            certificate(step),
        ]));
    }
    text
}

fn row([step, rest @ ..]: [String; 6]) -> String {
    let rest = rest.map(|cell| format!("{cell:>16}")).concat();
    format!("{step:>6}{rest}\n")
}
