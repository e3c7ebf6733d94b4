//! The zeros of the depths and the forces of a fit's curves.

use pellicle_identify::fit_file::FitFile;
use pellicle_identify::fit_file::nuisance::{DEPTH_ZERO, FORCE_ZERO, ForceZero, LOOSELY};
use pellicle_identify::{
    Coefficient, Fit, ForwardError, ForwardModel as _, IdentifyError, LinearNuisance,
    NuisanceShape, Observable, Prediction, Reading, Scope,
};

use super::curve_source::CurveSource;
use super::{Identification, observe};

/// The name of the zero that is sought along the abscissa, if there is one.
#[must_use]
pub fn of_abscissa(file: &FitFile, sources: &[(usize, CurveSource)]) -> Option<&'static str> {
    let told: Vec<_> = sources
        .iter()
        .map(|(_, source)| source.force_zero())
        .collect();
    let observe = observe(file);
    let name = name(observe.abscissa())?;
    let is_sought = match name {
        DEPTH_ZERO => file.nuisances.seeks_depth_zero(observe),
        _ => file.nuisances.seeks_force_zero(observe, &told),
    };
    is_sought.then_some(name)
}

/// A slope, N/m, that changes no force of any instrument over a metre.
const LEAST_SLOPE: f64 = 1e-15;

/// The slope of each baseline that was subtracted from observed forces, as it is known no better than its stretch
/// tells; where that is in the fit, it is found there and only held loosely.
///
/// # Errors
///
/// [`IdentifyError`] if a number is not finite.
pub fn baseline_slopes(
    observe: Observable,
    sources: &[CurveSource],
) -> Result<Option<LinearNuisance>, IdentifyError> {
    let subtracted = |source: &CurveSource| {
        let before = source.measured.before_contact;
        before.filter(|before| before.is_subtracted)
    };
    if observe != Observable::ForceAtDepth || !sources.iter().any(|of| subtracted(of).is_some()) {
        return Ok(None);
    }
    let distances = sources.iter().flat_map(|source| {
        let contact = source.origin(observe).unwrap_or(0.0);
        source
            .abscissa
            .iter()
            .map(move |abscissa| abscissa - contact)
    });
    let prior = |source: &CurveSource| match (subtracted(source), source.force_zero()) {
        (Some(before), ForceZero::InFit(_)) => {
            Some([0.0, (LOOSELY * before.line.slope_sd).max(LEAST_SLOPE)])
        }
        (Some(before), _) => Some([0.0, before.line.slope_sd.max(LEAST_SLOPE)]),
        // Nothing was subtracted, so there is no slope to be wrong.
        (None, _) => Some([0.0, LEAST_SLOPE]),
    };
    let shape = NuisanceShape::Given(distances.collect());
    let slopes = LinearNuisance::new("baseline_slope", shape, Scope::PerCurve);
    let priors = sources.iter().map(prior).collect();
    Ok(Some(slopes.with_normal_priors(priors)?))
}

/// The name of the zero of a reading, if it has one.
fn name(of: Reading) -> Option<&'static str> {
    match of {
        Reading::Depth => Some(DEPTH_ZERO),
        Reading::Force => Some(FORCE_ZERO),
        Reading::ContactRadius | Reading::Stiffness => None,
    }
}

/// A zero that a fit takes as exact.
#[derive(Debug, Clone)]
pub struct ExactZero {
    /// Its name.
    pub name: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// The largest reading of the quantity.
    pub reading: f64,
    /// The change of the observable at all points for a zero off by the largest reading.
    pub change: Vec<f64>,
}

/// The zero of this name of a curve in a fit.
#[must_use]
pub fn of_fit(fit: &Fit, name: &str, curve: usize) -> Option<f64> {
    let is_it = |one: &&Coefficient| one.curve == Some(curve) && one.name.starts_with(name);
    fit.coefficients.iter().find(is_it).map(|one| one.value)
}

impl Identification {
    /// The origins of the abscissae of all points of `self` in a fit of some of them; empty without zeros.
    #[must_use]
    pub fn origins(&self, fit: &Fit) -> Vec<f64> {
        let is_sought = |name: &&str| {
            let mut coefficients = fit.coefficients.iter();
            coefficients.any(|one| one.name.starts_with(name))
        };
        let Some(name) = name(observe(&self.file).abscissa()).filter(is_sought) else {
            return Vec::new();
        };
        let sources = self.sources.iter().enumerate();
        let each = sources.map(|(index, source)| {
            // A repeat that disagrees with the others has none.
            let zero = of_fit(fit, name, index);
            let zero = zero
                .or_else(|| source.origin(observe(&self.file)))
                .unwrap_or(0.0);
            vec![zero; source.abscissa.len()]
        });
        each.collect::<Vec<_>>().concat()
    }

    /// The zeros that a fit takes as exact: for each its name, unit, the largest reading, and the change of the
    /// observable if that zero were off by the largest reading, at all points.
    #[must_use]
    pub fn exact_zeros(&self, fit: &Fit, slopes: &[f64]) -> Vec<ExactZero> {
        let sought = |name: &str| {
            fit.coefficients
                .iter()
                .any(|one| one.name.starts_with(name))
        };
        let largest = |values: fn(&CurveSource) -> &[f64]| {
            let all = self.sources.iter().flat_map(values);
            all.fold(0.0, |most: f64, value| most.max(value.abs()))
        };
        let [x, y] = [largest(|of| &of.abscissa), largest(|of| &of.observed)];
        // y = f(x − z): ∂y/∂z = −f′; of the observable itself it is 1.
        let shifted: Vec<f64> = slopes.iter().map(|slope| -slope * x).collect();
        let raised = vec![y; slopes.len()];
        let observe = observe(&self.file);
        let zeros = [Reading::Depth, Reading::Force]
            .into_iter()
            .filter_map(|of| {
                let (reading, change) = match of {
                    _ if of == observe.observed() => (y, raised.clone()),
                    _ if of == observe.abscissa() => (x, shifted.clone()),
                    _ => return None,
                };
                let (name, unit) = (name(of)?, of.unit());
                Some(ExactZero {
                    name,
                    unit,
                    reading,
                    change,
                })
            });
        zeros.filter(|zero| !sought(zero.name)).collect()
    }

    /// What the models predict at the values and the zeros of a fit, for all points of `self`.
    ///
    /// # Errors
    ///
    /// [`ForwardError`] if the contact cannot be solved.
    pub fn prediction_of(&self, fit: &Fit) -> Result<Prediction, ForwardError> {
        let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
        self.model.predict_from(&values, &self.origins(fit))
    }
}
