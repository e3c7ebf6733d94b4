//! The rows as a table in Markdown.

use super::{Certificate, Outcome, Row, Solved};

const HEAD: [&str; 16] = [
    "case",
    "n",
    "threads",
    "program",
    "version",
    "tolerance",
    "time, s",
    "fastest, s",
    "solve, s",
    "products",
    "memory, MiB",
    "complementarity",
    "gap in contact",
    "overlap",
    "load",
    "time / Pellicle's",
];
/// Columns from the time on, that hold what a program's runs brought.
const RESULTS: usize = 10;

/// The table, with a line for every row, in which an absent result says why it is absent.
pub(super) fn table(rows: &[Row]) -> String {
    let mut lines = vec![line(&HEAD.map(str::to_owned)), rule()];
    lines.extend(rows.iter().map(|row| line(&cells(row))));
    lines.concat()
}

/// What is missing and why, a line each; empty if nothing is.
pub(super) fn missing(rows: &[Row]) -> String {
    let mut lines: Vec<String> = Vec::new();
    for row in rows {
        let line = match &row.outcome {
            Outcome::Missing(reason) => format!("- {}: {reason}\n", row.program),
            Outcome::Solved(solved) => match &solved.uncertified {
                Some(reason) => format!("- certificate: {reason}\n"),
                None => continue,
            },
            Outcome::Stopped(_) | Outcome::Failed(_) | Outcome::Serial => continue,
        };
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines.concat()
}

fn line(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}

/// Names to the left, numbers to the right.
fn rule() -> String {
    let columns = (0..HEAD.len()).map(|i| if [0, 3, 4].contains(&i) { "---" } else { "--:" });
    format!("|{}|\n", columns.collect::<Vec<_>>().join("|"))
}

fn cells(row: &Row) -> Vec<String> {
    let mut cells = vec![
        row.case.to_string(),
        row.elements.to_string(),
        row.threads.to_string(),
        row.program.clone(),
    ];
    let version = match &row.outcome {
        Outcome::Solved(solved) => solved.median.version.clone(),
        _ => String::new(),
    };
    cells.extend([version, format!("{:e}", row.tolerance)]);
    cells.extend(match &row.outcome {
        Outcome::Solved(solved) => results(solved),
        Outcome::Stopped(seconds) => because(&format!("stopped after {seconds} s")),
        Outcome::Missing(_) => because("missing"),
        Outcome::Failed(reason) => because(&format!("failed: {}", reason.replace('|', "/"))),
        Outcome::Serial => because("serial"),
    });
    cells
}

/// A reason in place of the first result.
fn because(reason: &str) -> Vec<String> {
    let rest = (1..RESULTS).map(|_| String::new());
    std::iter::once(reason.to_owned()).chain(rest).collect()
}

fn results(solved: &Solved) -> Vec<String> {
    let run = &solved.median;
    let mut cells = vec![
        seconds(run.total_seconds())
            + if run.converged {
                ""
            } else {
                " (not converged)"
            },
        seconds(solved.fastest_seconds()),
        seconds(run.solve_seconds),
        or_dash(run.products),
        or_dash(run.peak_bytes.map(|bytes| bytes.div_ceil(1 << 20))),
    ];
    cells.extend(lines(solved.certificate.as_ref()));
    cells.push(or_dash(
        solved.times_pellicle.map(|ratio| format!("{ratio:.1}")),
    ));
    cells
}

fn lines(certificate: Option<&Certificate>) -> [String; 4] {
    let Some(certificate) = certificate else {
        return std::array::from_fn(|_| "–".to_owned());
    };
    let Certificate {
        complementarity,
        gap_in_contact,
        overlap,
        load,
        ..
    } = certificate;
    [complementarity, gap_in_contact, overlap, load].map(|value| format!("{value:.1e}"))
}

fn or_dash(value: Option<impl ToString>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| value.to_string())
}

/// Three digits, or tenths of a millisecond.
fn seconds(value: f64) -> String {
    let decimals = if value < 0.1 {
        4
    } else if value < 10.0 {
        3
    } else {
        1
    };
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::{measurement, row};
    use super::*;

    fn solved() -> Outcome {
        let certificate = Certificate {
            complementarity: 1.23e-9,
            gap_in_contact: 4.5e-9,
            overlap: 0.0,
            load: 1e-16,
            min_pressure: 0.0,
            penetration: 0.0225,
            contact_elements: 9,
        };
        let solved = Solved::of(vec![measurement(0.25)], Ok(certificate));
        Outcome::Solved(Box::new(solved.unwrap()))
    }

    #[test]
    fn a_solved_row_shows_time_work_memory_and_certificate() {
        let table = table(&[row("aspher", solved())]);
        let expected = "| hertz | 512 | 1 | aspher | 1.0 | 1e-8 | 0.250 | 0.250 | 0.250 | 7 | 1 | 1.2e-9 | 4.5e-9 | 0.0e0 | \
                        1.0e-16 | – |";
        assert_eq!(table.lines().nth(2), Some(expected));
    }

    #[test]
    fn every_line_has_as_many_cells_as_the_head() {
        let rows = [
            row("a", solved()),
            row("b", Outcome::Stopped(60)),
            row("c", Outcome::Missing("no wheel".into())),
            row("d", Outcome::Failed("ValueError: a | b".into())),
            row("e", Outcome::Serial),
        ];
        let table = table(&rows);
        let bars: Vec<usize> = table.lines().map(|l| l.matches('|').count()).collect();
        assert_eq!(bars, [HEAD.len() + 1; 7]);
    }

    #[test]
    fn what_is_missing_is_named_once_with_its_reason() {
        let absent = row("slippy", Outcome::Missing("no wheel".into()));
        let unjudged = Solved::of(vec![measurement(0.25)], Err("no Python".into())).unwrap();
        let rows = [
            absent.clone(),
            row("a", solved()),
            row("b", Outcome::Solved(Box::new(unjudged))),
            row("c", Outcome::Serial),
            absent,
        ];
        let expected = "- slippy: no wheel\n- certificate: no Python\n";
        assert_eq!(missing(&rows), expected);
    }

    #[test]
    fn times_have_three_digits() {
        let shown = [0.01234, 0.5, 3.4567, 152.3].map(seconds);
        assert_eq!(shown, ["0.0123", "0.500", "3.457", "152.3"]);
    }
}
