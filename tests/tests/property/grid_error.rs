//! The grid's error bars are resolved where they should be, contain the true value, and are not too wide. The contacts
//! are a selection of those of the program `coverage`. A row of `pellicle validate` checks that a finite peak is
//! resolved and an infinite one is not.

use pellicle_contact::{Cone, Indenter, Load, Step};
use pellicle_tests::coverage::{ErrorBars, GridQuantity, benchmarks, coverage, grids};
use pellicle_tests::scene::{model, paraboloid, solve, unit_half_space};
use pellicle_texture::Relief;

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

fn rows() -> Vec<ErrorBars> {
    let benchmarks = benchmarks()
        .into_iter()
        .filter(|benchmark| NAMES.contains(&benchmark.name.as_str()));
    benchmarks
        .flat_map(|benchmark| benchmark.rows(&grids(12, 48, 256), 512))
        .collect()
}

#[test]
fn nineteen_of_twenty_error_bars_contain_the_truth_and_their_median_width_is_at_most_eight_errors()
{
    let rows = rows();
    let (within, width) = coverage(&rows);
    assert!(within >= 0.95 && width <= 8.0, "{within} {width}");
    let resolved: usize = rows.iter().map(|row| row.resolved().count()).sum();
    let bars: usize = rows.iter().map(|row| row.bars.len()).sum();
    // The edge peaks of a third of the contacts are not resolved.
    assert!(3 * resolved > 2 * bars, "{resolved} of {bars}");
    for row in &rows {
        let is_edge_peak = row.quantity == GridQuantity::MaxPressure
            && ["sharp cone", "flat punch", "Fig. 2a", "Fig. 2c"].contains(&row.benchmark.as_str());
        assert!(!is_edge_peak || row.resolved().count() == 0, "{row:?}");
    }
}

fn pressed(indenter: Indenter, elements: usize) -> Step {
    let model = model(&unit_half_space(), Relief::Bare, indenter);
    // Hertz's contact radius is 0.1.
    let load = Load::Force(4e-3 / 3.0);
    solve(&model, 0.3, elements, load).steps.remove(0)
}

#[test]
fn the_penetration_is_resolved_where_the_peak_is_not() {
    // The pressure is logarithmic at the tip.
    let cone = Indenter::Cone(Cone::new(1.4, 0.0).unwrap());
    let error = pressed(cone, 256).grid_error;
    assert!(error.penetration.unwrap().resolved, "{error:?}");
    assert!(!error.max_pressure.unwrap().resolved, "{error:?}");
}

#[test]
fn two_grids_resolve_nothing_and_one_grid_has_no_estimate() {
    let of_radius = |indenter, elements| pressed(indenter, elements).grid_error.max_pressure;
    assert!(!of_radius(paraboloid(1.0), 32).unwrap().resolved);
    assert!(of_radius(paraboloid(1.0), 20).is_none());
}
