//! The files of a plan: picture, table, and `plan.json` last.

use std::path::Path;

use pellicle_files::{json, whole};
use pellicle_plot::sheet::style::Style;

use super::result::{self, PlanResult};
use super::{picture, text};
use crate::failure::Failure;
use crate::identification::findings::WarningResult;
use crate::output::write_progress::WriteProgress;

/// File name of the picture, without extension.
const PICTURE: &str = "plan-intervals";

/// File name of the table.
const TABLE: &str = "plan.csv";

/// Whether a plan writes a file with this name.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let ending = name.strip_prefix(PICTURE);
    [result::FILE, TABLE].contains(&name)
        || ending.is_some_and(|ending| [".svg", ".png"].contains(&ending))
}

/// Writes the files into a folder; a picture that cannot be drawn becomes a warning of the plan.
///
/// # Errors
///
/// [`Failure::File`] if a file cannot be written.
pub fn write(folder: &Path, plan: &mut PlanResult) -> Result<(), Failure> {
    let writer = WriteProgress::new(1, &|_, _| ());
    let conditions = text::conditions(plan);
    let designs = picture::designs(&plan.title, plan.level, &conditions, &plan.designs);
    let svg = writer.drawn(PICTURE, || Ok(designs.draw(&Style::default())));
    if let Some(svg) = svg.flatten() {
        writer.picture(folder, PICTURE, || svg)?;
    }
    let failed = writer.warnings().into_iter();
    plan.warnings.extend(failed.map(|warning| WarningResult {
        code: warning.code,
        message: warning.message,
    }));
    whole::write_bytes(&folder.join(TABLE), table(plan).as_bytes())?;
    let text = json(plan)?;
    Ok(whole::write_bytes(
        &folder.join(result::FILE),
        text.as_bytes(),
    )?)
}

/// Returns the table, as CSV: a row for each design and parameter, best design first.
#[must_use]
pub fn table(plan: &PlanResult) -> String {
    let header = "rank,design,curves,key,unit,value,standard error of ln,low,high,verdict\n";
    let rows = plan.designs.iter().enumerate().flat_map(|(index, design)| {
        text::numbers(design).map(move |of| {
            let [low, high] = of.interval.map(number);
            format!(
                "{},\"{}\",{},{},{},{:e},{},{low},{high},{}\n",
                index + 1,
                text::name(design),
                design.curves.len(),
                of.key,
                of.unit,
                of.value,
                number(of.standard_error),
                of.verdict
            )
        })
    });
    header.to_owned() + &rows.collect::<String>()
}

/// Writes a number, or an empty cell.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_file_names_of_a_plan_are_recognised() {
        for name in [
            "plan.json",
            "plan.csv",
            "plan-intervals.svg",
            "plan-intervals.png",
        ] {
            assert!(is_name(name), "{name}");
        }
        for name in ["plan.md", "plan-intervals.pdf", "plan-intervals", "plan"] {
            assert!(!is_name(name), "{name}");
        }
    }
}
