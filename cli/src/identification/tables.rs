//! The tables of a fit: data with model and residuals, covariance, profiles.

use pellicle_identify::{Estimate, Fit, Observable};

use super::Identification;

/// Every table with the name of its file.
#[must_use]
pub fn all(of: &Identification, fit: &Fit) -> [(&'static str, String); 3] {
    [
        ("fit.csv", data(of, fit)),
        ("covariance.csv", covariance(fit)),
        ("profiles.csv", profiles(fit)),
    ]
}

/// Data, model and residuals of every point.
fn data(of: &Identification, fit: &Fit) -> String {
    let observable = of.model.curves().first().map(|curve| curve.observable);
    let [x, y, unit] = match observable {
        Some(Observable::ForceAtDepth) => ["depth [m]", "force", "N"],
        Some(Observable::StiffnessAtContactRadius) => ["contact radius [m]", "stiffness", "N/m"],
        _ => ["force [N]", "depth", "m"],
    };
    let mut text =
        format!("file,{x},{y} [{unit}],model [{unit}],residual [{unit}],whitened residual\n");
    let mut point = 0;
    for source in &of.sources {
        let file = quoted(&source.measured.file.display().to_string());
        for (abscissa, observed) in source.abscissa.iter().zip(&source.observed) {
            let points = &fit.points;
            let (model, residual) = (points.model[point], points.residual[point]);
            let whitened = points.whitened[point];
            text +=
                &format!("{file},{abscissa:e},{observed:e},{model:e},{residual:e},{whitened:e}\n");
            point += 1;
        }
    }
    text
}

/// Covariance of the logarithms of the unknowns; empty where it is not finite.
fn covariance(fit: &Fit) -> String {
    let names: Vec<String> = fit.estimates.iter().map(|of| quoted(&of.name)).collect();
    let mut text = format!("covariance of ln,{}\n", names.join(","));
    for (name, row) in names.iter().zip(&fit.covariance) {
        let cells: Vec<String> = row.iter().map(|value| number(*value)).collect();
        text += &format!("{name},{}\n", cells.join(","));
    }
    text
}

/// The profile of every unknown: its value, and how much `χ²` is above the least with it held there.
fn profiles(fit: &Fit) -> String {
    let of_estimate = |estimate: &Estimate| {
        let name = quoted(&estimate.name);
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

/// A text as a cell, quoted where it must be.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
