//! The validity of the model where a fit uses it, and the warnings about points at which it does not hold.

use std::collections::BTreeMap;

use pellicle::case::adhesion::law_warning;
use pellicle::display::significant;
use pellicle_contact::{ContactError, LARGEST_SLOPE, Warning};
use pellicle_identify::{Fit, ForwardError, Observable};
use pellicle_influence::ElasticBody;

use super::Identification;
use super::findings::WarningResult;
use super::outside::{Handling, Outside};
use super::remembered::Remembered;
use super::{observe, units};

/// The mean pressure, Pa, that bodies as stiff as those that would give it do not bear elastically: rubbers and gels
/// stay below, polymers, metals and ceramics yield at less than half of what a Berkovich tip would need.
const LARGEST_ELASTIC_PRESSURE: f64 = 1e8;

/// Returns the points, among all measured ones, at which the model does not hold according to a fit of some of them. If
/// the contact cannot be solved, these are the points known before. None if the user stopped.
#[must_use]
pub fn outside(
    whole: &Identification,
    fit: &Fit,
    (now, model): (&Identification, &Remembered<'_>),
) -> Option<Outside> {
    let as_before = |failure: String| Outside {
        failure: Some(failure),
        ..now.outside.clone()
    };
    let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
    // If points were left out before, the fit's own prediction does not cover all points.
    let known = model
        .known(&values)
        .filter(|known| known.value.len() == whole.problem.points() && known.origins.is_empty());
    let at_fit = match known.map_or_else(|| whole.prediction_of(fit), Ok) {
        Ok(prediction) => prediction,
        Err(ForwardError::Stopped) => return None,
        Err(error) => return Some(as_before(error.to_string())),
    };
    let pairs = at_fit.value.iter().zip(&at_fit.slope);
    let noise = pairs.map(|(value, slope)| fit.noise.variance(*value, *slope).sqrt());
    let noise: Vec<f64> = noise.collect();
    let invalid = match whole.model.invalid_points(fit, &at_fit, &noise) {
        Err(ContactError::Cancelled { .. }) => return None,
        Err(error) => return Some(as_before(error.to_string())),
        Ok(invalid) => invalid,
    };
    Some(Outside::of(invalid, &whole.sources))
}

impl Identification {
    /// Warnings about the points at which the model does not hold: their number and range on each curve, and how they
    /// were handled.
    #[must_use]
    pub fn outside_warnings(&self) -> Vec<WarningResult> {
        let mut found = Vec::new();
        let mut warnings: Vec<_> = self.steep_tip().into_iter().collect();
        for (source, points) in self.sources.iter().zip(&self.outside.points) {
            let mut by_reason: BTreeMap<String, Vec<f64>> = BTreeMap::new();
            for point in points {
                let known = by_reason.entry(point.reason.to_string()).or_default();
                known.push(point.abscissa);
            }
            let file = source.measured.file.display();
            found.extend(by_reason.into_iter().map(|(reason, abscissae)| {
                let (count, range) = (abscissae.len(), self.range(&abscissae));
                format!("{file}: outside the model, {reason}: {count} points {range}")
            }));
        }
        let what = match self.outside.handling {
            _ if found.is_empty() => None,
            Handling::LeftOut => Some("these points are not in the fit; excluded.csv lists them"),
            Handling::Kept => Some("these points are in the fit, as report.outside requests"),
            Handling::Unsettled => Some(
                "these points are not in the fit, but its result would exclude others: choose a segment that \
                 avoids them, or report.outside = \"keep\", which fits all points",
            ),
            Handling::NotConverged => Some(
                "these points are in the fit, which did not converge: choose a segment that avoids them",
            ),
            Handling::TooFewLeft => Some(
                "too few points are left without them: the fit uses all points, also those outside its model. \
                 Choose a segment that avoids them, or report.outside = \"keep\", which accepts them",
            ),
        };
        found.extend(what.map(str::to_owned));
        if self.outside.includes_inaccurate() {
            found.push(self.inaccurate_warning());
        }
        let failure = self.outside.failure.as_ref();
        found.extend(failure.map(|failure| {
            format!("whether the model is valid at every point could not be checked: {failure}")
        }));
        let warning = |message| WarningResult {
            code: "outside-model".into(),
            message,
        };
        warnings.extend(found.into_iter().map(warning));
        warnings
    }

    /// The warning about a self-similar indenter that is steep at every point: said once, it is no reason to leave any
    /// point out.
    fn steep_tip(&self) -> Option<WarningResult> {
        let curves = self.model.curves().iter();
        let slopes = curves.filter_map(|curve| curve.model.indenter.self_similar_slope());
        let slope = slopes.fold(0.0, f64::max);
        let warning = Warning::SteepTip { slope };
        (slope > LARGEST_SLOPE).then(|| WarningResult {
            code: warning.code().into(),
            message: format!("{warning}; no point is left out for it"),
        })
    }

    /// The warning that another law of adhesion holds at the fitted values.
    pub(super) fn adhesion_law(&self, fit: &Fit) -> Option<WarningResult> {
        let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
        let of_curve = |curve: usize| {
            let law = self.model.curves()[curve].adhesion?.law;
            let contacts = self.model.adhesive(curve, &values).ok()??;
            law_warning(law, contacts.tabor_number().ok()??)
        };
        let found = (0..self.model.curves().len()).find_map(of_curve)?;
        Some(WarningResult {
            code: found.code.into(),
            message: found.message,
        })
    }

    /// The warning that a sharp tip leaves an imprint in a body as stiff as the fitted one, where only loadings are
    /// fitted: they are then not those of an elastic contact.
    pub(super) fn sharp_tip(&self, fit: &Fit) -> Option<WarningResult> {
        let is_loading = matches!(
            observe(&self.file),
            Observable::DepthAtForce | Observable::ForceAtDepth
        );
        let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
        let pressure = |curve: usize| {
            let model = self.model.model(curve, &values).ok()?;
            // Of a rigid cone on a half-space p = E* tan β/2, with its slope (I. N. Sneddon, Int. J. Engng Sci. 3, 47
            // (1965)).
            let slope = model.indenter.self_similar_slope()?;
            let body = model.tables.bodies().of(ElasticBody::Foundation);
            let top = body.surface_material();
            Some((
                0.5 * top.plane_strain_modulus() * slope,
                top.young_modulus(),
            ))
        };
        let curves = 0..self.model.curves().len();
        let pressures = curves.filter_map(pressure);
        let (pressure, modulus) = pressures.max_by(|one, other| one.0.total_cmp(&other.0))?;
        (is_loading && pressure > LARGEST_ELASTIC_PRESSURE).then(|| {
            let [pressure, modulus] = [pressure, modulus].map(|of| {
                let scale = units::scale(of, "Pa");
                format!("{} {}", significant(of / scale.divisor, 2), scale.label)
            });
            WarningResult {
                code: "sharp-tip".into(),
                message: format!(
                    "a sharp tip on a body of {modulus} would press with {pressure} in the mean if the contact were \
                     elastic, at every depth: bodies as stiff yield before, a loading is then that of an imprint, and the \
                     modulus fitted to it is far too small. Unless unloadings have been seen to follow their loadings, \
                     evaluate them: pellicle init fit-unloading"
                ),
            }
        })
    }

    /// Describes the points at which the grid's error is too large for the noise, and how to change that.
    fn inaccurate_warning(&self) -> String {
        let inaccurate = self.outside.inaccurate.iter().flatten();
        let count = inaccurate.count();
        let noise = if self.problem.noise_is_given() {
            "the noise given is smaller than the error of the grid"
        } else {
            "the noise estimated from the residuals is smaller than the error of the grid"
        };
        format!(
            "{noise} at {count} points, and too few are left without them: they are in the fit, and the intervals \
             include that error. Give the noise of the measurement, such as noise = {{ relative = 0.01 }} in [[data]]"
        )
    }

    /// The smallest and largest of some abscissae in words.
    fn range(&self, abscissae: &[f64]) -> String {
        let least = abscissae.iter().copied().fold(f64::INFINITY, f64::min);
        let most = abscissae.iter().copied().fold(0.0, f64::max);
        let observable = self.model.curves().first().map(|curve| curve.observable);
        let unit = observable.unwrap_or_default().abscissa().unit();
        let scale = units::scale(most, unit);
        let number = |value: f64| significant(value / scale.divisor, 3);
        format!("from {} to {} {}", number(least), number(most), scale.label)
    }
}
