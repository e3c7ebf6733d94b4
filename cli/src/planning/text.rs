//! A plan on the terminal.

use pellicle::display::{count, short, significant};

use super::candidate::CandidateCurve;
use super::design::{DesignResult, ExpectedResult};
use super::result::PlanResult;
use crate::identification::findings::NoiseResult;
use crate::identification::names;
use crate::identification::units;

/// Number of rows shown.
const ROWS: usize = 24;

/// Describes the plan: the noise and the table.
#[must_use]
pub fn text(plan: &PlanResult) -> String {
    format!(
        "{}: what to measure\n  expected {} intervals, {}\n\n{}\n  {} solved, {} loads, {} s\n",
        plan.title,
        percent(plan.level),
        conditions(plan),
        table(&plan.designs),
        count(plan.work.curves_solved, "curve"),
        plan.work.loads_solved,
        significant(plan.work.seconds, 3)
    )
}

/// Describes the noise and the number of points.
#[must_use]
pub fn conditions(plan: &PlanResult) -> String {
    let mut curves = plan.designs.iter().flat_map(|design| &design.curves);
    let points = curves.next().map_or(0, |curve| curve.points);
    format!("{}, {points} points per curve", noise(&plan.noise))
}

fn noise(of: &NoiseResult) -> String {
    let with_unit = |value: f64, unit, what| {
        let scale = units::scale(value, unit);
        let number = short(value / scale.divisor);
        format!("{number} {} of {what}", scale.label)
    };
    let depth = of.depth.filter(|sigma| *sigma > 0.0);
    let force = of.force.filter(|sigma| *sigma > 0.0);
    let relative = (of.relative > 0.0).then(|| percent(of.relative));
    let parts: Vec<_> = (depth
        .map(|sigma| with_unit(sigma, "m", "depth"))
        .into_iter())
    .chain(force.map(|sigma| with_unit(sigma, "N", "force")))
    .chain(relative.map(|part| format!("{part} of the reading")))
    .collect();
    format!("noise {}", parts.join(" and "))
}

/// Writes a fraction of one in percent.
#[must_use]
pub fn percent(part: f64) -> String {
    format!("{} %", short(100.0 * part))
}

/// Returns the designs in rows, best first, with the unknowns in columns.
#[must_use]
pub fn table(designs: &[DesignResult]) -> String {
    let Some(first) = designs.first() else {
        return String::new();
    };
    let heads = numbers(first).map(|of| names::symbol(&of.key));
    let head: Vec<String> = std::iter::once(String::new()).chain(heads).collect();
    let row = |design: &DesignResult| {
        let name = std::iter::once(name(design));
        name.chain(numbers(design).map(ExpectedResult::width))
            .collect()
    };
    let shown = designs.iter().take(ROWS).map(row);
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(shown).collect();
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..rows[0].len()).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate();
        let cells = cells.map(|(column, (cell, width))| match column {
            0 => format!("  {cell:<width$}"),
            _ => format!("   {cell:>width$}"),
        });
        cells.collect::<String>().trim_end().to_owned() + "\n"
    };
    let rows = rows.iter().map(line).collect::<String>();
    let instead = numbers(first).filter_map(|of| Some((names::symbol(&of.key), of.instead()?)));
    let instead = instead.map(|(symbol, known)| format!("  in place of {symbol}: {known}\n"));
    let more = match designs.len().saturating_sub(ROWS) {
        0 => String::new(),
        more => format!("  … and {}\n", count(more, "worse design")),
    };
    rows + &more + &instead.collect::<String>()
}

/// The unknowns, then the nuisances.
pub fn numbers(design: &DesignResult) -> impl Iterator<Item = &ExpectedResult> {
    design.unknowns.iter().chain(&design.nuisances)
}

/// Names the curves of a design in a row.
#[must_use]
pub fn name(design: &DesignResult) -> String {
    let all: Vec<_> = design.curves.iter().map(CandidateCurve::words).collect();
    match all.len() {
        1 | 2 => all.join(" + "),
        count => format!("all {count} curves"),
    }
}
