//! The parameters that a fit takes as exact, and the effect of an error in one on the result.

use pellicle::display::significant;
use pellicle_contact::ContactError;
use pellicle_identify::fit_file::model::ModelParameters;
use pellicle_identify::fit_file::nuisance::{DEPTH_ZERO, FORCE_ZERO};
use pellicle_identify::measured::spring;
use pellicle_identify::{Calibration, Fit, FitVerdict, FixedNumber, Prediction, Role, exponents};
use serde::Serialize;

use super::exact_evaluation::{AREA, BETA, FRAME};
use super::findings::{EstimateResult, WarningResult};
use super::{Identification, names};
use crate::failure::Failure;

/// A parameter that a fit takes as exact. Of a zero of the depth or the force the largest reading stands in place of
/// its value, of the compliance of a frame the least of a contact, and of an area function 1: its errors are parts of
/// that.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExactNumber {
    /// Its key; `data[0] KEY` for a value specific to a table of measurements.
    pub key: String,
    /// Its SI unit.
    pub unit: String,
    /// Its value.
    pub value: f64,
    /// `d ln θ/d ln f` of each unknown θ with respect to this parameter f, in the order of the unknowns: the change of
    /// θ in percent if f increases by 1 %. Null if the data do not determine the unknown, or if it is at a bound.
    pub exponents: Vec<Option<f64>>,
}

impl ExactNumber {
    /// Returns the smallest relative error of this parameter that moves an unknown to the end of its interval, with
    /// that unknown; none if no unknown moves.
    #[must_use]
    pub fn tolerance<'u>(&self, unknowns: &'u [EstimateResult]) -> Option<(f64, &'u str)> {
        let pairs = unknowns.iter().zip(&self.exponents);
        let tolerances = pairs.filter_map(|(unknown, exponent)| {
            let [Some(low), Some(high)] = unknown.interval else {
                return None;
            };
            let half = (high / low).ln() / 2.0;
            let tolerance = half / (*exponent)?.abs();
            tolerance.is_finite().then_some((tolerance, &*unknown.key))
        });
        tolerances.min_by(|(one, _), (other, _)| one.total_cmp(other))
    }
}

/// Describes the parameter for which the smallest error matters; none if no parameter moves an unknown.
#[must_use]
pub fn most_critical(numbers: &[ExactNumber], unknowns: &[EstimateResult]) -> Option<String> {
    let of = |number: &ExactNumber| {
        let (tolerance, unknown) = number.tolerance(unknowns)?;
        Some((tolerance, number.key.clone(), unknown.to_owned()))
    };
    let found = numbers.iter().filter_map(of);
    let (tolerance, key, unknown) = found.min_by(|one, other| one.0.total_cmp(&other.0))?;
    let (percent, unknown) = (significant(100.0 * tolerance, 2), names::of_key(&unknown));
    let error = match &*key {
        DEPTH_ZERO | FORCE_ZERO => format!("{key} of {percent} % of the largest reading"),
        AREA => format!("{percent} % in all areas"),
        FRAME => format!("{key} of {percent} % of the least compliance of a contact"),
        BETA => {
            // Area and β enter only together, and most know the area less well.
            let area = numbers
                .iter()
                .find(|number| number.key == AREA)
                .and_then(of);
            let area = area.map(|(part, ..)| significant(100.0 * part, 2));
            let area = area.map_or_else(String::new, |part| format!(" or {part} % in all areas"));
            format!("{percent} % in {key}{area}")
        }
        _ => format!("{percent} % in {key}"),
    };
    Some(format!(
        "taken as exact: an error of {error} moves the {unknown} to the end of its interval"
    ))
}

impl Identification {
    /// Returns the parameters that the models hold fixed, in the order of the case, with the effect of each on the
    /// unknowns; or a warning if it cannot be computed. Only a finished fit that is not a misfit has them.
    #[must_use]
    pub fn taken_as_exact(&self, fit: &Fit) -> (Vec<ExactNumber>, Option<WarningResult>) {
        if fit.stopped.is_some() || fit.verdict != FitVerdict::Fitted {
            return Default::default();
        }
        match self.exponents(fit) {
            Ok(numbers) => (numbers, None),
            Err(Failure::Case(pellicle::Error::Contact(ContactError::Cancelled { .. }))) => {
                Default::default()
            }
            Err(failure) => {
                let message = format!(
                    "the effect of the parameters taken as exact could not be computed: {failure}"
                );
                let code = "taken-as-exact".into();
                (Vec::new(), Some(WarningResult { code, message }))
            }
        }
    }

    fn exponents(&self, fit: &Fit) -> Result<Vec<ExactNumber>, Failure> {
        let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
        // Only parameters with keys, not those of the sublayers of a graded layer.
        let tables = self.file.data.iter();
        let tables = tables.map(|table| self.file.model.with(&table.set));
        let tables = tables.collect::<Result<Vec<_>, pellicle::Error>>()?;
        let numbers =
            |table: &ModelParameters| table.parameters.iter().map(|of| of.parameter).collect();
        let keyed: Vec<_> = tables.iter().map(numbers).collect();
        let (at_fit, fixed) =
            (self.model).predict_with_fixed(&values, &self.origins(fit), &keyed)?;
        let mut numbers: Vec<ExactNumber> = Vec::new();
        let mut changes: Vec<Vec<f64>> = Vec::new();
        for (table, parameters) in tables.iter().enumerate() {
            let of_table = fixed.iter().filter(|of| of.curve == table);
            for (number, change) in self.named((table, parameters), of_table) {
                // Tables share the parameters that are not specific to one.
                if let Some(known) = numbers.iter().position(|known| known.key == number.key) {
                    let pairs = changes[known].iter_mut().zip(change);
                    pairs.for_each(|(sum, of_table)| *sum += of_table);
                } else {
                    numbers.push(number);
                    changes.push(change);
                }
            }
        }
        for (number, change) in self.exact_calibrations(&at_fit) {
            numbers.push(number);
            changes.push(change);
        }
        for (number, change) in self.exact_evaluations(&at_fit) {
            numbers.push(number);
            changes.push(change);
        }
        for zero in self.exact_zeros(fit, &at_fit.slope) {
            numbers.push(ExactNumber {
                key: zero.name.into(),
                unit: zero.unit.into(),
                value: zero.reading,
                exponents: Vec::new(),
            });
            changes.push(zero.change);
        }
        let all = exponents(&self.problem, fit, at_fit, &changes)?;
        for (number, of_all) in numbers.iter_mut().zip(all) {
            let pairs = of_all.into_iter().zip(&fit.estimates);
            let sought = pairs.filter(|(_, estimate)| estimate.role == Role::Sought);
            number.exponents = sought.map(|(exponent, _)| exponent).collect();
        }
        Ok(numbers)
    }

    /// The spring constants without a standard deviation and the sensitivities of deflections, each with `∂y/∂ln f`.
    fn exact_calibrations(&self, at_fit: &Prediction) -> Vec<(ExactNumber, Vec<f64>)> {
        let tables = self.file.data.iter().enumerate();
        let calibrations = tables.flat_map(|(table, data)| {
            let spring = data.spring_constant.filter(|spring| spring.sd.is_none());
            let spring = spring.map(|spring| {
                let key = format!("data[{table}].spring_constant");
                (
                    table,
                    Calibration::SpringConstant,
                    key,
                    spring.mean,
                    spring::UNIT,
                )
            });
            let sensitivity = data.columns.sensitivity().map(|value| {
                let key = format!("data[{table}].units.deflection");
                (table, Calibration::Sensitivity, key, value, "m/V")
            });
            [spring, sensitivity].into_iter().flatten()
        });
        let named = calibrations.filter_map(|(table, calibration, key, value, unit)| {
            let change = self.model.by_calibration(table, calibration, at_fit)?;
            let (unit, exponents) = (unit.into(), Vec::new());
            let number = ExactNumber {
                key,
                unit,
                value,
                exponents,
            };
            Some((number, change))
        });
        named.collect()
    }

    /// The fixed parameters of a table with their keys, each with `∂y/∂ln f`.
    fn named<'n>(
        &self,
        (table, parameters): (usize, &ModelParameters),
        fixed: impl Iterator<Item = &'n FixedNumber>,
    ) -> Vec<(ExactNumber, Vec<f64>)> {
        let own = parameters.given_in(&self.file.data[table].set);
        let named = fixed.filter_map(|of| {
            let mut all = parameters.parameters.iter();
            let found = all.find(|known| known.parameter == of.parameter)?;
            let key = if own.contains(&of.parameter) {
                format!("data[{table}] {}", found.key)
            } else {
                found.key.clone()
            };
            let number = ExactNumber {
                key,
                unit: found.unit().into(),
                value: of.value,
                exponents: Vec::new(),
            };
            let change = of.derivative.iter().map(|d| d * of.value).collect();
            Some((number, change))
        });
        named.collect()
    }
}
