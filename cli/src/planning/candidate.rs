//! A curve that may be measured, and the curves of a design.

use pellicle::display::{short, span};
use pellicle::input::diagnosis::Diagnosis;
use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::model::ModelParameters;
use pellicle_identify::measured::curve_segment::SegmentEnd;
use serde::Serialize;

use crate::failure::Failure;
use crate::identification::units;

/// Default number of points of a curve.
const POINTS: usize = 24;

/// Ratio of the largest to the smallest load, unless the segment begins later.
const SPAN: f64 = 100.0;

/// A curve that may be measured: points evenly spaced in the logarithm of the force.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CandidateCurve {
    /// Radius of the indenter, m; null if it has none.
    pub radius: Option<f64>,
    /// Least and largest force, N.
    pub forces: [f64; 2],
    /// Number of points.
    pub points: usize,
}

impl CandidateCurve {
    /// Returns the forces of the points, N.
    #[must_use]
    pub fn loads(&self) -> Vec<f64> {
        let [least, most] = self.forces;
        let part = |i: usize| i as f64 / (self.points - 1) as f64;
        let load = |i| least * (most / least).powf(part(i));
        (0..self.points).map(load).collect()
    }

    /// Describes the curve: `R 10 µm, 0.1 to 10 mN`.
    #[must_use]
    pub fn words(&self) -> String {
        let forces = span(self.forces, &units::scale(self.forces[1], "N"));
        match self.radius {
            Some(radius) => format!("{}, {forces}", radius_words(radius)),
            None => forces,
        }
    }
}

/// Writes a radius: `R 10 µm`.
#[must_use]
pub fn radius_words(radius: f64) -> String {
    let scale = units::scale(radius, "m");
    let number = short(radius / scale.divisor);
    format!("R {number} {}", scale.label)
}

/// Returns the curves of the design in a fit file: each radius with each largest force.
///
/// If no radii are given, they are those of the `[[data]]` tables, or that of the model. If no forces are given, the
/// end of the segment is used.
///
/// # Errors
///
/// [`Failure`] if there is no largest force, or if the values of a table are not valid.
pub fn candidates(file: &FitFile) -> Result<Vec<CandidateCurve>, Failure> {
    let design = &file.report.design;
    let radii: Vec<Option<f64>> = if design.radii.is_empty() {
        radii_of_tables(file)?
    } else {
        design.radii.iter().copied().map(Some).collect()
    };
    let forces = if design.forces.is_empty() {
        vec![end(file).ok_or_else(|| no_force(file))?]
    } else {
        design.forces.clone()
    };
    let points = design.points.unwrap_or(POINTS);
    let one = |radius: Option<f64>, most: f64| CandidateCurve {
        radius,
        forces: [least(file, most), most],
        points,
    };
    let of_radius = |radius: Option<f64>| forces.iter().map(move |most| (radius, *most));
    let all = radii.into_iter().flat_map(of_radius);
    Ok(all.map(|(radius, most)| one(radius, most)).collect())
}

/// The indenter radii of the tables; without tables, that of the model.
fn radii_of_tables(file: &FitFile) -> Result<Vec<Option<f64>>, Failure> {
    let radius = |of: &ModelParameters| of.radius().and_then(|radius| of.value(radius));
    if file.data.is_empty() {
        return Ok(vec![radius(&file.model.parameters()?)]);
    }
    let mut radii = Vec::new();
    for table in &file.data {
        let found = radius(&file.model.with(&table.set)?);
        if !radii.contains(&found) {
            radii.push(found);
        }
    }
    Ok(radii)
}

/// The largest force at which a segment ends.
fn end(file: &FitFile) -> Option<f64> {
    let ends = file.data.iter().filter_map(|table| match table.segment.to {
        Some(SegmentEnd::Force(force)) => Some(force),
        _ => None,
    });
    ends.filter(|force| *force > 0.0).reduce(f64::max)
}

/// Two decades below the largest force, or the beginning of the segment if that is later.
fn least(file: &FitFile, most: f64) -> f64 {
    let from = file
        .data
        .first()
        .and_then(|table| match table.segment.from {
            Some(SegmentEnd::Force(force)) if force < most => Some(force),
            _ => None,
        });
    (most / SPAN).max(from.unwrap_or(0.0))
}

fn no_force(file: &FitFile) -> Diagnosis {
    let wanted = "at least one largest force, such as { forces = [\"1 mN\", \"10 mN\"] }";
    file.document.wanted("report.design.forces", wanted)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_are_evenly_spread_in_the_logarithm_and_named() {
        let curve = CandidateCurve {
            radius: Some(1e-5),
            forces: [1e-4, 1e-2],
            points: 3,
        };
        let loads = curve.loads();
        // Rounding of a power.
        assert!((loads[1] / 1e-3 - 1.0).abs() < 1e-12 && loads.len() == 3);
        assert_eq!(curve.words(), "R 10 µm, 0.1 to 10 mN");
    }
}
