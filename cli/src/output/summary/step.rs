//! One loading step in a summary, with its stresses and derivatives.

use pellicle_contact::{Certificate, GridError, Status, Step, StressExtremes, Work, nan_from_null};
use serde::{Deserialize, Deserializer, Serialize};

use super::roughness::RoughContactSummary;

/// One loading step: the numbers of a [`Step`] without its fields.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StepSummary {
    /// `Q`, N.
    #[serde(deserialize_with = "nan_from_null")]
    pub force: f64,
    /// `D`, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub penetration: f64,
    /// Largest pressure, Pa.
    #[serde(deserialize_with = "nan_from_null")]
    pub max_pressure: f64,
    /// Centre of the element that has it, m.
    #[serde(deserialize_with = "nans_from_nulls")]
    pub max_pressure_at: [f64; 2],
    /// Force over contact area, Pa.
    #[serde(deserialize_with = "nan_from_null")]
    pub mean_pressure: f64,
    /// Contact area, m².
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_area: f64,
    /// Number of elements in contact.
    pub contact_elements: usize,
    /// Contact area on the tops of the relief, m².
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_area_on_relief: f64,
    /// Contact area between the tops, m².
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_area_between: f64,
    /// Distance of the farthest element in contact from the axis, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub contact_radius: f64,
    /// Area of the elements whose pressure is cut, m²; none without a hardness, as for the next two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area_at_limit: Option<f64>,
    /// This area over the contact area; 0 without contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fraction_at_limit: Option<f64>,
    /// Largest plastic depth, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plastic_depth: Option<f64>,
    /// Contact stiffness `dQ/dD`, N/m; none without contact.
    #[serde(default)]
    pub contact_stiffness: Option<f64>,
    /// Islands, gaps and pressures, if a map takes part and there is contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rough_contact: Option<RoughContactSummary>,
    /// Status; `certified` in a file older than this field.
    #[serde(default)]
    pub status: Status,
    /// The certificate: how well the solution satisfies the contact conditions.
    pub certificate: CertificateSummary,
    /// Work of the solution.
    pub work: Work,
    /// Discretisation error.
    pub grid_error: GridError,
    /// The derivatives with respect to the parameters of the case, if requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensitivities: Option<Vec<SensitivitySummary>>,
    /// The largest stresses inside, if requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stress: Option<StressSummary>,
}

/// The lines of a [`Certificate`], and its verdict in place of the tolerance.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct CertificateSummary {
    #[serde(deserialize_with = "nan_from_null")]
    pub complementarity: f64,
    #[serde(deserialize_with = "nan_from_null")]
    pub gap_in_contact: f64,
    #[serde(deserialize_with = "nan_from_null")]
    pub overlap: f64,
    #[serde(deserialize_with = "nan_from_null")]
    pub load: f64,
    #[serde(deserialize_with = "nan_from_null")]
    pub min_pressure: f64,
    /// None without a hardness, as for the next one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_at_limit: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over_limit: Option<f64>,
    #[serde(deserialize_with = "nan_from_null")]
    pub worst: f64,
    pub satisfied: bool,
}

/// The largest stresses of a step, and the sliding assumed for them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressSummary {
    /// Coefficient of friction.
    pub friction: f64,
    /// Direction of sliding, degrees from +x to +y.
    pub direction_degrees: f64,
    /// The extremes in bodies and on interfaces.
    #[serde(flatten)]
    pub extremes: StressExtremes,
}

/// The derivatives of a step with respect to one parameter θ of the case, per unit of θ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SensitivitySummary {
    /// Key of the parameter in the case.
    pub parameter: String,
    /// θ, in SI units or the case's own.
    #[serde(deserialize_with = "nan_from_null")]
    pub value: f64,
    /// `∂D/∂θ` at constant force, for fixed elements in contact.
    pub penetration: Option<f64>,
    /// `∂D/∂θ` along the curve, without the steps due to elements that enter the contact; none for fewer than six
    /// forces.
    pub smooth_penetration: Option<f64>,
    /// `∂Q/∂θ` at constant penetration, for fixed elements in contact.
    pub force: Option<f64>,
    /// `∂E/∂θ` at constant force, `E = ∫ D dQ`.
    #[serde(deserialize_with = "nan_from_null")]
    pub energy: f64,
}

impl StepSummary {
    /// Summarises a step with elements of this area, m².
    pub(super) fn new(step: &Step, element_area: f64, has_hardness: bool) -> Self {
        let (solution, summary) = (&step.solution, &step.summary);
        let with_hardness = |value: f64| has_hardness.then_some(value);
        let part = summary.area_at_limit / summary.contact_area;
        let mut certificate = CertificateSummary::from(&solution.certificate);
        if !has_hardness {
            (certificate.gap_at_limit, certificate.over_limit) = (None, None);
        }
        Self {
            force: solution.force,
            penetration: solution.penetration,
            max_pressure: summary.max_pressure,
            max_pressure_at: summary.max_pressure_at,
            mean_pressure: summary.mean_pressure,
            contact_area: summary.contact_area,
            contact_elements: summary.contact_elements,
            contact_area_on_relief: summary.contact_area_on_relief,
            contact_area_between: summary.contact_area_between,
            contact_radius: summary.contact_radius,
            area_at_limit: with_hardness(summary.area_at_limit),
            fraction_at_limit: with_hardness(if part.is_finite() { part.min(1.0) } else { 0.0 }),
            plastic_depth: with_hardness(summary.plastic_depth),
            contact_stiffness: step.contact_stiffness,
            rough_contact: RoughContactSummary::of(step, element_area),
            status: step.status(),
            certificate,
            work: step.work.clone(),
            grid_error: step.grid_error.clone(),
            sensitivities: None,
            stress: None,
        }
    }
}

impl From<&Certificate> for CertificateSummary {
    fn from(certificate: &Certificate) -> Self {
        Self {
            complementarity: certificate.complementarity,
            gap_in_contact: certificate.gap_in_contact,
            overlap: certificate.overlap,
            load: certificate.load,
            min_pressure: certificate.min_pressure,
            gap_at_limit: Some(certificate.gap_at_limit),
            over_limit: Some(certificate.over_limit),
            worst: certificate.worst(),
            satisfied: certificate.is_satisfied(),
        }
    }
}

/// Reads two numbers, with `null` as NaN.
fn nans_from_nulls<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 2], D::Error> {
    let pair = <[Option<f64>; 2]>::deserialize(deserializer)?;
    Ok(pair.map(|number| number.unwrap_or(f64::NAN)))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn non_finite_numbers_are_written_as_null_and_read_back_as_nan() {
        let estimate = json!({"estimate": null, "order": null, "resolved": false});
        let step = json!({
            "force": null, "penetration": null, "max_pressure": null, "max_pressure_at": [null, 1.5],
            "mean_pressure": null, "contact_area": null, "contact_elements": 1,
            "contact_area_on_relief": null, "contact_area_between": null, "contact_radius": null,
            "contact_stiffness": null, "status": "not-converged",
            "certificate": {
                "complementarity": null, "gap_in_contact": null, "overlap": null, "load": null,
                "min_pressure": null, "worst": null, "satisfied": false,
            },
            "work": {
                "iterations": 1, "operator_applications": 2, "seconds": null,
                "levels": [{"elements": 64, "iterations": 1, "operator_applications": 2}],
            },
            "grid_error": {
                "penetration": estimate, "force": null, "contact_area": null, "max_pressure": null,
                "levels": [{"elements": 64, "penetration": null, "contact_area": null, "max_pressure": null}],
            },
        });
        let read: StepSummary = serde_json::from_value(step.clone()).unwrap();
        assert!(read.force.is_nan() && read.max_pressure_at[0].is_nan());
        assert!(read.grid_error.levels[0].penetration.is_nan());
        // This includes the order of keys.
        assert_eq!(serde_json::to_string(&read).unwrap(), step.to_string());
    }
}
