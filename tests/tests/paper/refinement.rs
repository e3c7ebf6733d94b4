//! Peaks on grids finer than the paper could afford: the tables of `docs/paper.md`, line by line.

use super::cases::{Coating, PaperCase, only_step, path, spring_length};
use super::layer_between::share_between;
use super::numbers::{assert_reads, exponent, fitted_exponent};

/// The page with the tables.
const PAGE: &str = include_str!("../../../docs/paper.md");
/// N^0.1 grows by 7 % with every doubling; singular pressures grow as N^(1/2) or faster.
const SETTLED: f64 = 0.1;

/// A case, its coating, and the heading of its table.
const TABLES: [(PaperCase, Coating, &str); 6] = [
    (
        PaperCase::Fig2a,
        Coating::Soft,
        "Fig. 2(a): soft coating, small load",
    ),
    (
        PaperCase::Fig2b,
        Coating::Stiff,
        "Fig. 2(b): stiff coating, small load",
    ),
    (
        PaperCase::Fig2c,
        Coating::Soft,
        "Fig. 2(c): soft coating, six times the load",
    ),
    (
        PaperCase::Fig2d,
        Coating::Stiff,
        "Fig. 2(d): stiff coating, six times the load",
    ),
    (
        PaperCase::OneCylinder(Coating::Soft),
        Coating::Soft,
        "One cylinder of the soft coating under a flat punch of its own size",
    ),
    (
        PaperCase::OneCylinder(Coating::Stiff),
        Coating::Stiff,
        "One cylinder of the stiff coating under a flat punch of its own size",
    ),
];

/// The cells of the table under a heading, one list per line, N first; and the sentence below it about the fits.
fn table(heading: &str) -> (Vec<Vec<&'static str>>, &'static str) {
    let start = PAGE.find(&format!("### {heading}\n")).expect(heading);
    let mut lines = PAGE[start..].lines().skip(4);
    let cells = |line: &'static str| line.trim_matches('|').split('|').map(str::trim).collect();
    let rows = lines
        .by_ref()
        .take_while(|line| line.starts_with('|'))
        .map(cells)
        .collect();
    (rows, lines.next().expect("fits below the table"))
}

fn peak(case: PaperCase, elements: usize) -> (usize, f64) {
    (elements, only_step(case, elements).summary.max_pressure)
}

/// Asserts the lines of all tables whose N is selected.
fn assert_lines(belongs: impl Fn(usize) -> bool) {
    for (case, coating, heading) in TABLES {
        let (rows, _) = table(heading);
        assert!(rows.len() >= 6, "{heading}");
        for row in rows {
            let row = <[&str; 7]>::try_from(row).expect(heading);
            let [n, side, depth, largest, growth, at, between] = row;
            let elements = n.parse().expect("elements per side");
            if !belongs(elements) {
                continue;
            }
            let step = only_step(case, elements);
            let [x, y] = step.summary.max_pressure_at;
            let element = path(case, elements).grid.element_side();
            assert_reads(element / spring_length(coating), side);
            assert_reads(step.solution.penetration, depth);
            assert_reads(step.summary.max_pressure, largest);
            assert_reads(x.hypot(y), at);
            assert_reads(share_between(case, elements), between);
            if let Some(growth) = growth.strip_prefix("N^") {
                assert_reads(
                    exponent(peak(case, elements / 2), peak(case, elements)),
                    growth,
                );
            }
        }
    }
}

#[test]
fn every_row_of_the_tables_up_to_1024_elements_is_reproduced() {
    assert_lines(|elements| elements <= 1024);
}

#[test]
fn every_row_of_the_tables_of_2048_elements_is_reproduced() {
    assert_lines(|elements| elements == 2048);
}

#[test]
#[ignore = "minutes and 2 GB for the grids of 4096 elements a side"]
fn every_row_of_the_tables_of_4096_elements_and_every_fit_is_reproduced() {
    assert_lines(|elements| elements == 4096);
    for (case, coating, heading) in TABLES {
        let (rows, fits) = table(heading);
        let [coarse, fine] = [true, false].map(|is_larger| {
            let grids = rows
                .iter()
                .map(|row| row[0].parse().expect("elements per side"));
            let peaks: Vec<_> = grids
                .filter(|&n| {
                    (path(case, n).grid.element_side() >= spring_length(coating)) == is_larger
                })
                .map(|n| peak(case, n))
                .collect();
            peaks
        });
        let (larger, smaller) = fits.split_once(';').expect("two fits");
        for (peaks, fit) in [(coarse, larger), (fine, smaller)] {
            let written = fit
                .split_once("N^")
                .map(|(_, digits)| digits.trim_end_matches('.'));
            match written {
                Some(digits) => assert_reads(fitted_exponent(&peaks), digits),
                None => assert!(peaks.len() < 2, "{heading}: {fit}"),
            }
        }
    }
}

/// Whether the largest pressure has settled at 1024 and at 2048 elements per side.
fn settles(case: PaperCase) -> [bool; 2] {
    [1024, 2048].map(|n| exponent(peak(case, n / 2), peak(case, n)).abs() < SETTLED)
}

#[test]
fn whether_the_largest_pressure_on_the_soft_coating_has_settled_depends_on_the_grid() {
    for case in [PaperCase::Fig2a, PaperCase::Fig2c] {
        assert_eq!(settles(case), [true, false], "{case:?}");
    }
}

#[test]
fn the_largest_pressure_on_the_stiff_coating_has_not_settled() {
    for case in [PaperCase::Fig2b, PaperCase::Fig2d] {
        assert_eq!(settles(case), [false, false], "{case:?}");
    }
}

#[test]
fn the_edge_peak_of_one_cylinder_settles_once_elements_are_much_smaller_than_the_springs_length() {
    for coating in [Coating::Soft, Coating::Stiff] {
        assert_eq!(
            settles(PaperCase::OneCylinder(coating)),
            [true, true],
            "{coating:?}"
        );
    }
}
