//! The next measurement after a fit: curves of a design added to its data, with its values and its noise.

use std::ops::Range;

use pellicle_identify::{
    Coefficient, Curve, Exclusion, Fit, FitVerdict, ForwardModel, Observable, Prediction,
};

use super::advice::{self, Advice};
use super::candidate::candidates;
use super::comparison;
use super::design::DesignResult;
use super::premises::{IndenterRadius, Premises};
use super::{Judged, Planning, not_solved};
use crate::failure::Failure;
use crate::identification::Identification;
use crate::identification::findings::WarningResult;

/// The gain of the designs in a fit file over its data.
#[derive(Debug, Clone, Default)]
pub struct Next {
    /// The designs, the best first, and the data alone.
    pub designs: Vec<DesignResult>,
    /// The advice on the next measurement, in one or two sentences.
    pub advice: String,
    /// Warnings for the reader.
    pub warnings: Vec<WarningResult>,
}

impl Next {
    /// Evaluates the designs that the fit file asks for; if no plan can be made, this is a warning. `report` receives
    /// the number of curves evaluated.
    #[must_use]
    pub fn of(of: &Identification, fit: &Fit, report: &dyn Fn(usize)) -> Self {
        if of.file.report.design.is_empty() {
            return Self::default();
        }
        if fit.verdict == FitVerdict::NotConverged {
            return Self::without(&"the fit has not converged");
        }
        match Self::planned(of, fit, report) {
            Ok(next) => next,
            Err(failure) => Self::without(&failure),
        }
    }

    fn without(reason: &dyn std::fmt::Display) -> Self {
        Self {
            warnings: vec![WarningResult {
                code: "not-planned".into(),
                message: format!("no measurement is planned: {reason}"),
            }],
            ..Self::default()
        }
    }

    fn planned(of: &Identification, fit: &Fit, report: &dyn Fn(usize)) -> Result<Self, Failure> {
        let points = of.problem.curves().iter().map(Curve::points).max();
        let most = points.unwrap_or(super::candidate::POINTS);
        let candidates = candidates(&of.file, most, Some(largest_force(of)))?;
        let premises = Premises::of_fit(of, fit, &candidates)?;
        let data = data(of, fit, &premises)?;
        let mut planning = Planning::new(premises, &candidates, &of.stop, report)?;
        planning.data = Some(data);
        let designs = comparison::designs(&planning)?;
        Ok(Self {
            advice: advice::advice(&designs, Advice::AfterAFit),
            designs,
            warnings: planning.warnings,
        })
    }
}

/// The largest measured force, N.
fn largest_force(of: &Identification) -> f64 {
    let observes_force = of
        .model
        .curves()
        .iter()
        .any(|curve| curve.observable == Observable::ForceAtDepth);
    let forces = of.problem.curves().iter().flat_map(|curve| {
        let forces = if observes_force {
            curve.observed()
        } else {
            curve.abscissa()
        };
        forces.iter().copied()
    });
    forces.fold(0.0, f64::max)
}

/// The information in the data of a fit.
fn data(of: &Identification, fit: &Fit, premises: &Premises<'_>) -> Result<Judged, Failure> {
    let values = &premises.plan.truth[..premises.cases().len()];
    let mut prediction = of.model.predict(values).map_err(not_solved)?;
    prediction.value = without_shift(of, fit);
    let prediction = premises.spread(prediction, &IndenterRadius::OfModel);
    let left_out: Vec<usize> = fit.excluded.iter().map(Exclusion::curve).collect();
    let curves = of.problem.curves();
    let used = (0..curves.len()).filter(|index| !left_out.contains(index));
    let used: Vec<usize> = used.collect();
    let prediction = part(&prediction, curves, &used);
    let curves: Vec<Curve> = used.iter().map(|index| curves[*index].clone()).collect();
    let place = premises.place_of_radius();
    let parameter = place.map(|place| premises.cases()[place].parameter);
    let shares = |parameter| {
        let mut curves = of.model.curves().iter();
        curves.any(|curve| !curve.own.contains(parameter))
    };
    let shares = parameter.as_ref().is_some_and(shares);
    Ok(Judged {
        candidate: None,
        radii: place.filter(|_| shares).into_iter().collect(),
        information: premises.plan.information(&prediction, &curves)?,
        directions: of.directions.clone(),
    })
}

/// The model at each point without its shift, because relative noise refers to that; frame and drift are included.
fn without_shift(of: &Identification, fit: &Fit) -> Vec<f64> {
    let curves = of.problem.curves().iter().enumerate();
    let shifts = curves.flat_map(|(index, curve)| {
        let is_shift =
            |one: &&Coefficient| one.curve == Some(index) && one.name.starts_with("shift");
        let shift = fit.coefficients.iter().find(is_shift);
        std::iter::repeat_n(shift.map_or(0.0, |one| one.value), curve.points())
    });
    let model = fit.points.model.iter();
    model
        .zip(shifts)
        .map(|(read, shift)| read - shift)
        .collect()
}

/// Returns the prediction at the points of the curves in `used`.
fn part(of: &Prediction, curves: &[Curve], used: &[usize]) -> Prediction {
    let mut first = 0;
    let spans: Vec<Range<usize>> = curves
        .iter()
        .map(|curve| {
            let span = first..first + curve.points();
            first = span.end;
            span
        })
        .collect();
    let of_used = |values: &Vec<f64>| -> Vec<f64> {
        let spans = used.iter().map(|index| spans[*index].clone());
        spans
            .flat_map(|span| values[span].iter().copied())
            .collect()
    };
    Prediction {
        value: of_used(&of.value),
        slope: of_used(&of.slope),
        derivatives: of.derivatives.iter().map(of_used).collect(),
    }
}
