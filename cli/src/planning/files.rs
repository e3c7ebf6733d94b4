//! The files of a plan: picture, table, the page, and `plan.json` last.

use std::path::Path;

use super::result::{self, PlanResult};
use super::{page, picture, table, text};
use crate::failure::Failure;
use crate::identification::findings::WarningResult;
use crate::output::write_progress::WriteProgress;
use crate::output::{file, json, report};
use crate::picture::fit::designs;
use crate::picture::style::Style;

/// File name of the table.
const TABLE: &str = "plan.csv";

/// Whether a plan writes a file with this name, other than the page.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let ending = name.strip_prefix(designs::NAME);
    [result::FILE, TABLE].contains(&name)
        || ending.is_some_and(|ending| [".svg", ".png"].contains(&ending))
}

/// Writes the files into a folder; a picture that cannot be drawn becomes a warning of the plan.
///
/// # Errors
///
/// [`Failure::Write`] if a file cannot be written.
pub fn write(folder: &Path, plan: &mut PlanResult) -> Result<(), Failure> {
    let writer = WriteProgress::new(1, &|_, _| ());
    let conditions = text::conditions(plan);
    let designs = picture::designs(&plan.title, plan.level, &conditions, &plan.designs);
    let svg = writer.drawn(designs::NAME, || Ok(designs.draw(&Style::default())));
    let svg = match svg.flatten() {
        Some(svg) => writer.picture(folder, designs::NAME, || svg)?,
        None => None,
    };
    let failed = writer.warnings().into_iter();
    plan.warnings.extend(failed.map(|warning| WarningResult {
        code: warning.code,
        message: warning.message,
    }));
    let csv = table::csv(&plan.designs);
    file::write_bytes(&folder.join(TABLE), csv.as_bytes())?;
    let page = page::html(plan, svg.as_deref());
    file::write_bytes(&folder.join(report::FILE), page.as_bytes())?;
    file::write_bytes(&folder.join(result::FILE), json(plan)?.as_bytes())
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
