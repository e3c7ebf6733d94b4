//! A summary in words, for the terminal.

mod columns;
pub mod stress;

use pellicle_contact::{RoughContact, Status};

use self::columns::TextColumns;
use super::summary::{RunSummary, StepSummary, WarningSummary};
use crate::case::grid::BoundaryCase;
use crate::display::{Unit, quantity, significant};
use crate::input::units::Units;

/// Largest number of warnings with the same code that are all printed.
const MAX_SHOWN_PER_CODE: usize = 3;

/// Describes a run in a few lines; a curve as a table with one line per step.
#[must_use]
pub fn text(summary: &RunSummary) -> String {
    let mut text = format!("{}\n{}", summary.title, grid(summary));
    match &summary.steps[..] {
        [step] => text.push_str(&single(step, summary)),
        steps => text.push_str(&table(steps, summary.units)),
    }
    text + &stress::critical(summary)
}

/// Lists the warnings, one per line; of more than [`MAX_SHOWN_PER_CODE`] with one code, only the first and the number
/// of others.
#[must_use]
pub fn warning_lines(warnings: &[WarningSummary]) -> String {
    let mut shown: Vec<&str> = Vec::new();
    let mut lines = Vec::new();
    for WarningSummary { code, message } in warnings {
        let alike = warnings.iter().filter(|other| other.code == *code);
        let count = alike.count();
        if count <= MAX_SHOWN_PER_CODE {
            lines.push(format!("warning: {message}"));
        } else if !shown.contains(&code.as_str()) {
            shown.push(code);
            lines.push(format!("warning: {message}"));
            let more = count - 1;
            lines.push(format!(
                "warning: {more} more of this kind ({code}), each in the summary's JSON"
            ));
        }
    }
    lines.join("\n")
}

fn grid(summary: &RunSummary) -> String {
    let grid = &summary.grid;
    let metres = |value| quantity(value, Unit::Metre, summary.units);
    let (side, element_side) = (metres(grid.side), metres(grid.element_side));
    let elements = grid.elements;
    let square = match grid.boundary {
        BoundaryCase::Free => "square",
        BoundaryCase::Periodic => "periodic cell",
    };
    let line = format!(
        "grid {elements} × {elements} on a {square} of side {side}, element side {element_side}\n"
    );
    match grid.boundary {
        BoundaryCase::Free => line,
        BoundaryCase::Periodic => {
            line + "force on one cell; on a half-space penetration from the mean plane of the deformed surface\n"
        }
    }
}

impl TextColumns {
    fn rough(&mut self, rough: &RoughContact) {
        let nominal = quantity(rough.nominal_area, Unit::SquareMetre, self.units);
        let fraction = significant(rough.contact_fraction, 4);
        self.push("contact fraction", &fraction, &format!("of {nominal}"));
        let largest = quantity(rough.islands.largest_area, Unit::SquareMetre, self.units);
        let islands = rough.islands.count.to_string();
        self.push("islands", &islands, &format!("largest {largest}"));
        self.quantity("mean gap", rough.mean_gap, Unit::Metre);
    }
}

fn single(step: &StepSummary, run: &RunSummary) -> String {
    let mut lines = TextColumns {
        units: run.units,
        element_side: run.grid.element_side,
        text: String::new(),
    };
    let (numbers, error) = (&step.summary, &step.grid_error);
    lines.estimated("force Q", step.force, Unit::Newton, error.force);
    lines.estimated(
        "penetration D",
        step.penetration,
        Unit::Metre,
        error.penetration,
    );
    lines.estimated(
        "largest pressure",
        numbers.max_pressure,
        Unit::Pascal,
        error.max_pressure,
    );
    lines.position("  at x, y", numbers.max_pressure_at);
    lines.quantity("mean pressure", numbers.mean_pressure, Unit::Pascal);
    if let Some(nominal) = numbers.nominal_pressure {
        lines.quantity("nominal pressure", nominal, Unit::Pascal);
    }
    lines.estimated(
        "contact area",
        numbers.contact_area,
        Unit::SquareMetre,
        error.contact_area,
    );
    if run.has_relief() {
        lines.quantity(
            "  on the relief",
            numbers.contact_area_on_relief,
            Unit::SquareMetre,
        );
        lines.quantity("  between", numbers.contact_area_between, Unit::SquareMetre);
    }
    lines.quantity("contact radius", numbers.contact_radius, Unit::Metre);
    if let (Some(fraction), Some(depth)) = (numbers.fraction_at_limit, numbers.plastic_depth) {
        let percent = format!("{:.1} % of the contact area", 100.0 * fraction);
        lines.push("at the hardness", &percent, "");
        lines.quantity("plastic depth", depth, Unit::Metre);
    }
    let stiffness = step.contact_stiffness.unwrap_or(0.0);
    lines.quantity("contact stiffness", stiffness, Unit::NewtonPerMetre);
    let worst = format!("worst line {:.1e}", step.certificate.worst);
    if let Some(rough) = &step.rough_contact {
        lines.rough(rough);
    }
    lines.push("certificate", &certificate(step), &worst);
    lines.push("work", &work(step), "");
    if let Some(stress) = &step.stress {
        lines.stresses(stress);
    }
    lines.text
}

fn certificate(step: &StepSummary) -> String {
    let word = match step.status {
        _ if !step.certificate.satisfied => "NOT SATISFIED",
        Status::CutOff => "CUT OFF",
        Status::BeyondModel => "BEYOND THE MODEL",
        _ => "satisfied",
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
            of(step.summary.max_pressure, Unit::Pascal),
            of(step.summary.contact_area, Unit::SquareMetre),
            certificate(step),
        ]));
    }
    text
}

fn row([step, rest @ ..]: [String; 6]) -> String {
    let rest = rest.map(|cell| format!("{cell:>16}")).concat();
    format!("{step:>6}{rest}\n")
}

#[cfg(test)]
mod tests {
    use super::{WarningSummary, warning_lines};

    #[test]
    fn many_warnings_of_one_kind_are_shown_as_the_first_and_a_count() {
        let warning = |code: &str, message: String| WarningSummary {
            code: code.into(),
            message,
        };
        let of_steps = |count: usize| (0..count).map(|i| warning("steep", format!("step {i}")));
        let mut warnings: Vec<WarningSummary> = of_steps(3).collect();
        let all = "warning: step 0\nwarning: step 1\nwarning: step 2";
        assert_eq!(warning_lines(&warnings), all);
        warnings = of_steps(5).collect();
        warnings.insert(2, warning("other", "one more".into()));
        let first = "warning: step 0\nwarning: 4 more of this kind (steep), each in the summary's JSON\nwarning: one more";
        assert_eq!(warning_lines(&warnings), first);
        assert_eq!(warning_lines(&[]), "");
    }
}
