//! The result of a fit on the terminal.

use super::result::{EstimateResult, FitResult};
use crate::display::significant;

/// The result in words, one line for each number.
#[must_use]
pub fn text(result: &FitResult) -> String {
    let mut text = format!("{}\n", result.title);
    for estimate in result.unknowns.iter().chain(&result.nuisances) {
        text += &line(estimate);
    }
    let fit = &result.fit;
    text += &format!(
        "  points {}, χ² per degree of freedom {}, misfit p {}, Durbin-Watson {}\n",
        fit.points,
        significant(fit.chi_squared_per_degree, 3),
        significant(fit.misfit_p, 2),
        significant(fit.durbin_watson, 3),
    );
    text += &format!(
        "  {} curves solved, {} loads, {} s\n",
        result.work.curves_solved,
        result.work.loads_solved,
        significant(result.work.seconds, 3)
    );
    text
}

fn line(estimate: &EstimateResult) -> String {
    let (key, unit) = (&estimate.key, prefixed(estimate));
    let number = |value: f64| significant(value / unit.0, 4);
    let end = |end: Option<f64>| end.map_or("open".to_owned(), number);
    let [low, high] = estimate.interval.map(end);
    let value = number(estimate.value);
    let mut line = format!(
        "  {key} = {value} {}   [{low}, {high}]   {}\n      {}\n",
        unit.1, estimate.verdict, estimate.why
    );
    if let Some(scatter) = estimate.scatter {
        line += &format!(
            "      scatter between repeats {} {}\n",
            number(scatter),
            unit.1
        );
    }
    if let Some(known) = &estimate.known_combination {
        let end = |end: Option<f64>| end.map_or("open".to_owned(), |value| significant(value, 4));
        let [low, high] = known.interval.map(end);
        let value = significant(known.value, 4);
        line += &format!("      {} = {value} [{low}, {high}]\n", known.expression);
    }
    line
}

/// The power of a thousand that suits a number, and its unit with the prefix.
fn prefixed(estimate: &EstimateResult) -> (f64, String) {
    const PREFIXES: [(f64, &str); 9] = [
        (1e12, "T"),
        (1e9, "G"),
        (1e6, "M"),
        (1e3, "k"),
        (1.0, ""),
        (1e-3, "m"),
        (1e-6, "µ"),
        (1e-9, "n"),
        (1e-12, "p"),
    ];
    let unit = estimate.unit.as_str();
    if !matches!(unit, "Pa" | "m" | "N") {
        return (
            1.0,
            if unit == "1" {
                String::new()
            } else {
                unit.to_owned()
            },
        );
    }
    let suits = |(factor, _): &&(f64, &str)| estimate.value.abs() >= *factor;
    let (factor, prefix) = PREFIXES.iter().find(suits).unwrap_or(&PREFIXES[4]);
    (*factor, format!("{prefix}{unit}"))
}
