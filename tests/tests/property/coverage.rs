//! Error bars of the grid contain the truth, and are not wider than they must be: the panel of the program `coverage`
//! in short form.

use pellicle_tests::coverage::{Quantity, Row, benchmarks, coverage, grids};

/// Contacts of every kind: smooth, at a rim, on a coating, on reliefs.
const NAMES: [&str; 8] = [
    "Hertz, force",
    "sharp cone",
    "flat punch",
    "rounded Berkovich",
    "soft coating",
    "film",
    "Fig. 2a",
    "Fig. 2c",
];

fn rows() -> Vec<Row> {
    let benchmarks = benchmarks()
        .into_iter()
        .filter(|benchmark| NAMES.contains(&benchmark.name.as_str()));
    benchmarks
        .flat_map(|benchmark| benchmark.rows(&grids(12, 48, 256), 512))
        .collect()
}

#[test]
fn nineteen_of_twenty_error_bars_contain_the_truth_and_are_eight_times_the_error_at_most() {
    let rows = rows();
    let (within, width) = coverage(&rows);
    assert!(within >= 0.95 && width <= 8.0, "{within} {width}");
    let resolved: usize = rows.iter().map(|row| row.resolved().count()).sum();
    let outcomes: usize = rows.iter().map(|row| row.outcomes.len()).sum();
    // The peaks at edges are not, of a third of the contacts.
    assert!(3 * resolved > 2 * outcomes, "{resolved} of {outcomes}");
    for row in &rows {
        let is_edge_peak = row.quantity == Quantity::MaxPressure
            && ["sharp cone", "flat punch", "Fig. 2a", "Fig. 2c"].contains(&row.benchmark.as_str());
        assert!(!is_edge_peak || row.resolved().count() == 0, "{row:?}");
    }
}
