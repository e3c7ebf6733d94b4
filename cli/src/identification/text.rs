//! The result of a fit on the terminal.

use pellicle::display::significant;

use super::findings::EstimateResult;
use super::result::FitResult;
use super::taken_as_exact::most_critical;
use crate::evaluation;

/// Describes the result, one line per parameter.
#[must_use]
pub fn text(result: &FitResult) -> String {
    let estimates = result.unknowns.iter().chain(&result.nuisances).map(line);
    let fit = &result.fit;
    let quality = format!(
        "  points {}, χ² per degree of freedom {}, misfit p {}, Durbin-Watson {}\n",
        fit.points,
        significant(fit.chi_squared_per_degree, 3),
        significant(fit.misfit_p, 2),
        significant(fit.durbin_watson, 3),
    );
    let work = format!(
        "  {} curves solved, {} loads, {} s\n",
        result.work.curves_solved,
        result.work.loads_solved,
        significant(result.work.seconds, 3)
    );
    let exact = most_critical(&result.taken_as_exact, &result.unknowns);
    let exact = exact.map(|sentence| format!("  {sentence}\n"));
    format!(
        "{}\n{}{}{}{quality}{work}",
        result.title,
        estimates.collect::<String>(),
        evaluation::text::beside(&result.indentation),
        exact.unwrap_or_default(),
    )
}

fn line(estimate: &EstimateResult) -> String {
    let (key, unit) = (&estimate.key, prefixed(estimate));
    let number = |value: f64| significant(value / unit.0, 4);
    let end = |end: Option<f64>| end.map_or("open".to_owned(), number);
    let [low, high] = estimate.interval.map(end);
    let value = number(estimate.value);
    let own = format!(
        "  {key} = {value} {}   [{low}, {high}]   {}\n      {}\n",
        unit.1, estimate.verdict, estimate.why
    );
    let scatter = estimate.scatter.map(|scatter| {
        let (scatter, unit) = (number(scatter), &unit.1);
        format!("      scatter between repeats {scatter} {unit}\n")
    });
    let known = estimate.known_combination.as_ref().map(|known| {
        let end = |end: Option<f64>| end.map_or("open".to_owned(), |value| significant(value, 4));
        let [low, high] = known.interval.map(end);
        let value = significant(known.value, 4);
        format!("      {} = {value} [{low}, {high}]\n", known.expression)
    });
    own + &scatter.unwrap_or_default() + &known.unwrap_or_default()
}

/// The power of a thousand suited to an estimate, and its unit with the prefix.
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
