//! The tables of a fit: data with model and residuals, covariance, profiles.

use pellicle_files::cell::text_cell;
use pellicle_identify::{Estimate, Fit};

use super::Identification;
use super::curve_source::OutsidePoint;

/// The table of the points at which the model does not hold.
pub const EXCLUDED: &str = "excluded.csv";

/// Every table with the name of its file.
#[must_use]
pub fn all(of: &Identification, fit: &Fit) -> [(&'static str, String); 3] {
    [
        ("fit.csv", data(of, fit)),
        ("covariance.csv", covariance(fit)),
        ("profiles.csv", profiles(fit)),
    ]
}

/// Lists the points left out because the model does not hold there, with the reason; none if there are no such points.
#[must_use]
pub fn excluded(of: &Identification) -> Option<String> {
    if !of.outside.are_left_out() || of.outside.points.is_empty() {
        return None;
    }
    let (x, y, unit) = axes(of);
    let curves = of.sources.iter().zip(&of.outside.points);
    let rows = curves.flat_map(|(source, points)| {
        let file = text_cell(&source.measured.file.display().to_string());
        let points = points.iter();
        points.map(move |point| {
            let OutsidePoint {
                row,
                abscissa,
                observed,
                reason,
            } = point;
            format!("{file},{row},{abscissa:e},{observed:e},{reason}\n")
        })
    });
    Some(format!("file,row,{x},{y} [{unit}],reason\n") + &rows.collect::<String>())
}

/// Heading of the abscissa, name and unit of the observable.
fn axes(of: &Identification) -> (String, &'static str, &'static str) {
    let observable = of.model.curves().first().map(|curve| curve.observable);
    let observable = observable.unwrap_or_default();
    let (x, y) = (observable.abscissa(), observable.observed());
    let name = if of.is_at_approach() {
        "approach"
    } else {
        x.name()
    };
    (format!("{name} [{}]", x.unit()), y.name(), y.unit())
}

/// Data, model and residuals of every point.
fn data(of: &Identification, fit: &Fit) -> String {
    let (x, y, unit) = axes(of);
    let header =
        format!("file,{x},{y} [{unit}],model [{unit}],residual [{unit}],whitened residual\n");
    let sources = of.sources.iter().flat_map(|source| {
        let file = text_cell(&source.measured.file.display().to_string());
        let points = source.abscissa.iter().zip(&source.observed);
        points.map(move |(abscissa, observed)| format!("{file},{abscissa:e},{observed:e}"))
    });
    let fitted = &fit.points;
    let rows = sources.enumerate().map(|(point, measured)| {
        let (model, residual) = (fitted.model[point], fitted.residual[point]);
        let whitened = fitted.whitened[point];
        format!("{measured},{model:e},{residual:e},{whitened:e}\n")
    });
    header + &rows.collect::<String>()
}

/// Covariance of the logarithms of the unknowns; cells that are not finite are empty.
fn covariance(fit: &Fit) -> String {
    let names: Vec<String> = fit.estimates.iter().map(|of| text_cell(&of.name)).collect();
    let rows = names.iter().zip(&fit.covariance).map(|(name, row)| {
        let cells: Vec<String> = row.iter().map(|value| number(*value)).collect();
        format!("{name},{}\n", cells.join(","))
    });
    format!("covariance of ln,{}\n", names.join(",")) + &rows.collect::<String>()
}

/// The profile of every unknown: its value, and the increase of `χ²` over the minimum with the unknown held there.
fn profiles(fit: &Fit) -> String {
    let of_estimate = |estimate: &Estimate| {
        let name = text_cell(&estimate.name);
        let points = estimate.profile.iter();
        let lines = points
            .map(move |point| format!("{name},{:e},{:e}\n", point.value, point.delta_chi_squared));
        lines.collect::<String>()
    };
    let lines: String = fit.estimates.iter().map(of_estimate).collect();
    format!("parameter,value,delta chi squared\n{lines}")
}

fn number(value: f64) -> String {
    if value.is_finite() {
        format!("{value:e}")
    } else {
        String::new()
    }
}
