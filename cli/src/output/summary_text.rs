//! A summary in words, for the terminal.

pub mod adhesion;
mod columns;
pub mod stress;

use pellicle::case::grid::BoundaryCase;
use pellicle::display::{Unit, quantity, significant};
use pellicle::result::quantities::{QUANTITIES, of_a_curve};
use pellicle::result::quantity::Part;
use pellicle::summary::{RunSummary, StepSummary, WarningSummary};
use pellicle_contact::Status;

use self::columns::TextColumns;

/// Largest number of warnings with the same code that are all printed.
const MAX_SHOWN_PER_CODE: usize = 3;

/// Least width of a column in the table of a curve.
const LEAST_WIDTH: usize = 16;

/// Describes a run in a few lines; a curve as a table with one line per step.
#[must_use]
pub fn text(summary: &RunSummary) -> String {
    let mut text = format!("{}\n{}", summary.title, grid(summary));
    match &summary.steps[..] {
        [step] => text.push_str(&single(step, summary)),
        _ => text.push_str(&table(summary)),
    }
    text + &adhesion::curve(summary) + &stress::critical(summary)
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
    let element_side = metres(grid.element_side);
    let square = match grid.boundary {
        BoundaryCase::Free => "square",
        BoundaryCase::Periodic => "periodic cell",
    };
    let (elements, sides) = (grid.elements_in_words(), grid.sides_in_words(summary.units));
    let body = if summary.has_rigid_indenter() {
        ", rigid indenter"
    } else {
        ""
    };
    let line =
        format!("grid {elements} on a {square} of {sides}, element side {element_side}{body}\n");
    match grid.boundary {
        BoundaryCase::Free => line,
        BoundaryCase::Periodic => {
            line + "force on one cell; on a half-space penetration from the mean plane of the deformed surface\n"
        }
    }
}

fn single(step: &StepSummary, run: &RunSummary) -> String {
    let mut lines = TextColumns {
        units: run.units,
        element_side: run.grid.element_side,
        text: String::new(),
    };
    let told = QUANTITIES.iter().filter(|of| of.part != Part::Solution);
    for quantity in told {
        lines.number(quantity, step, run);
    }
    let worst = format!("worst line {:.1e}", step.certificate.worst);
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

fn table(run: &RunSummary) -> String {
    let quantities = of_a_curve(run);
    let longest = quantities.iter().map(|of| of.name.len()).max();
    let width = LEAST_WIDTH.max(longest.map_or(0, |longest| longest + 1));
    let row = |step: String, cells: Vec<String>, last: String| {
        let cells = cells.into_iter().chain([last]);
        let cells: Vec<_> = cells.map(|cell| format!("{cell:>width$}")).collect();
        format!("{step:>6}{}\n", cells.concat())
    };
    let names = quantities.iter().map(|of| of.name.to_owned()).collect();
    let mut text = row("step".into(), names, "certificate".into());
    for (i, step) in run.steps.iter().enumerate() {
        let words = quantities.iter();
        let words = words.map(|of| of.words(step, run).unwrap_or_default());
        text.push_str(&row(i.to_string(), words.collect(), certificate(step)));
    }
    text
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
