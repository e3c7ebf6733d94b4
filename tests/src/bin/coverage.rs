//! Prints how often the grid's error bars contain the true value:
//! `cargo run --release -p pellicle-tests --bin coverage [NAME…]`.

#![expect(clippy::print_stdout, reason = "a table for people at a terminal")]

use pellicle_tests::coverage::{benchmarks, coverage, grids};

/// The grid whose numbers serve as the truth where no closed form is known.
const FINEST: usize = 3072;

fn main() {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let wanted =
        |name: &str| names.is_empty() || names.iter().any(|part| name.contains(part.as_str()));
    let grids = grids(60, 48, 1536);
    println!(
        "| contact | number | grids | resolved | error above ± | above 3 × ± | worst ratio | median of ± over error |"
    );
    println!("|---|---|--:|--:|--:|--:|--:|--:|");
    let mut all = Vec::new();
    for benchmark in benchmarks()
        .into_iter()
        .filter(|benchmark| wanted(&benchmark.name))
    {
        for row in benchmark.rows(&grids, FINEST) {
            let (above, far_above, worst) = (row.above(1.0), row.above(3.0), row.worst());
            let (name, quantity, count) = (&row.benchmark, row.quantity, row.bars.len());
            let (resolved, width) = (row.resolved().count(), row.width());
            let numbers = if resolved == 0 {
                "| | | |".to_owned()
            } else {
                format!("{above} | {far_above} | {worst:.2} | {width:.1} |")
            };
            println!("| {name} | {quantity} | {count} | {resolved} | {numbers}");
            all.push(row);
        }
    }
    let (within, width) = coverage(&all);
    println!(
        "\nAll together: {:.1} % of the resolved numbers lie within their ±; median of ± over error {width:.1}.",
        100.0 * within
    );
}
