//! One loading step in a summary, with its stresses and derivatives.

use pellicle_contact::{
    Certificate, GridError, RoughContact, Sensitivity, Status, Step, StressExtremes, Summary, Work,
};
use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use super::area_law::AreaLaw;

/// One loading step: a [`Step`] without its fields.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct StepSummary {
    /// `Q`, N.
    #[serde(deserialize_with = "nan_from_null")]
    pub force: f64,
    /// `D`, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub penetration: f64,
    /// The numbers that describe the contact.
    #[serde(flatten)]
    pub summary: Summary,
    /// Contact stiffness `dQ/dD`, N/m; none without contact.
    #[serde(default)]
    pub contact_stiffness: Option<f64>,
    /// Islands, gaps and pressures, if a map takes part and there is contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rough_contact: Option<RoughContact>,
    /// Its area against the pressure on it, if one surface is a measured map and the other smooth, and there is
    /// contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area_law: Option<AreaLaw>,
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
    /// The wear up to here, if there is any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wear: Option<WearSummary>,
}

/// The lines of a certificate, and its verdict in place of the tolerance.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct CertificateSummary {
    /// The lines.
    #[serde(flatten)]
    pub lines: Certificate,
    /// The largest of the dimensionless lines.
    #[serde(deserialize_with = "nan_from_null")]
    pub worst: f64,
    /// Whether every line is within the tolerance.
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

/// The wear of a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WearSummary {
    /// Sliding distance, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub distance: f64,
    /// Worn volume, m³, of one cell if the domain is periodic.
    #[serde(deserialize_with = "nan_from_null")]
    pub volume: f64,
    /// Largest depth of wear, m.
    #[serde(deserialize_with = "nan_from_null")]
    pub max_depth: f64,
    /// Heights after wear along x through the axis, at equally spaced points across the domain, m.
    #[serde(default)]
    pub section: Vec<f64>,
}

/// The derivatives of a step with respect to one parameter θ of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SensitivitySummary {
    /// Key of the parameter in the case.
    pub parameter: String,
    /// The derivatives, with θ in SI units or the case's own.
    #[serde(flatten)]
    pub derivatives: Sensitivity,
}

impl StepSummary {
    /// The status; in a file older than the status, that of the certificate.
    #[must_use]
    pub fn verdict(&self) -> Status {
        if self.certificate.satisfied {
            self.status
        } else {
            Status::NotConverged
        }
    }

    /// The words that mark a step in pictures; none if it is certified.
    #[must_use]
    pub fn mark(&self) -> Option<&'static str> {
        match self.verdict() {
            Status::Certified => None,
            Status::CutOff => Some("CUT OFF"),
            Status::BeyondModel => Some("BEYOND THE MODEL"),
            Status::NotConverged => Some("NOT CONVERGED"),
        }
    }
}

impl From<&Step> for StepSummary {
    fn from(step: &Step) -> Self {
        let lines = step.solution.certificate;
        Self {
            force: step.solution.force,
            penetration: step.solution.penetration,
            summary: step.summary,
            contact_stiffness: step.contact_stiffness,
            rough_contact: step.rough.clone(),
            area_law: None,
            status: step.status(),
            certificate: CertificateSummary {
                lines,
                worst: lines.worst(),
                satisfied: lines.is_satisfied(),
            },
            work: step.work.clone(),
            grid_error: step.grid_error.clone(),
            sensitivities: None,
            stress: None,
            wear: step.wear.as_ref().map(|wear| WearSummary {
                distance: wear.distance,
                volume: wear.volume,
                max_depth: wear.max_depth,
                section: Vec::new(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn work() -> Value {
        json!({
            "iterations": 1, "operator_applications": 2, "seconds": null,
            "levels": [{"elements": 64, "iterations": 1, "operator_applications": 2}],
        })
    }

    fn grid_error() -> Value {
        json!({
            "penetration": {"estimate": null, "order": null, "resolved": false},
            "force": null, "contact_area": null, "max_pressure": null,
            "levels": [{"elements": 64, "penetration": null, "contact_area": null, "max_pressure": null}],
        })
    }

    /// Reads a step, which must be written with the same keys in the same order.
    fn read(step: &Value) -> StepSummary {
        let read: StepSummary = serde_json::from_value(step.clone()).unwrap();
        assert_eq!(serde_json::to_string(&read).unwrap(), step.to_string());
        read
    }

    #[test]
    fn non_finite_numbers_are_written_as_null_and_read_back_as_nan() {
        let step = json!({
            "force": null, "penetration": null, "max_pressure": null, "max_pressure_at": [null, 1.5],
            "mean_pressure": null, "contact_area": null, "contact_elements": 1,
            "contact_area_on_relief": null, "contact_area_between": null, "contact_radius": null,
            "contact_stiffness": null, "status": "not-converged",
            "certificate": {
                "complementarity": null, "gap_in_contact": null, "overlap": null, "load": null,
                "min_pressure": null, "worst": null, "satisfied": false,
            },
            "work": work(), "grid_error": grid_error(),
        });
        let read = read(&step);
        assert!(read.force.is_nan() && read.summary.max_pressure_at[0].is_nan());
        assert!(read.grid_error.levels[0].penetration.is_nan());
    }

    #[test]
    fn a_step_with_hardness_rough_contact_and_derivatives_is_read_back_as_written() {
        let histogram = json!({"largest": 4.5, "counts": [3, 0, 1]});
        let step = json!({
            "force": 1.5, "penetration": 2.5, "max_pressure": 3.5, "max_pressure_at": [0.5, 1.5],
            "mean_pressure": 4.5, "nominal_pressure": 0.5, "contact_area": 5.5, "contact_elements": 6,
            "contact_area_on_relief": 7.5, "contact_area_between": 8.5, "contact_radius": 9.5,
            "area_at_limit": 1.25, "fraction_at_limit": 0.25, "plastic_depth": 0.75,
            "contact_stiffness": 10.5,
            "rough_contact": {
                "nominal_area": 11.5, "contact_fraction": 0.5, "counted_area": 12.5, "corrected_area": 12.25,
                "perimeter": 13.5, "mean_gap": 14.5,
                "islands": {"count": 2, "largest_area": 15.5, "mean_area": 16.5, "counts_by_octave": [1, 1]},
                "pressures": histogram, "gaps": histogram,
            },
            "status": "certified",
            "certificate": {
                "complementarity": 0.125, "gap_in_contact": 0.25, "overlap": 0.5, "load": 0.0,
                "min_pressure": 0.0, "gap_at_limit": 0.75, "over_limit": 0.0, "worst": 0.75, "satisfied": true,
            },
            "work": work(), "grid_error": grid_error(),
            "sensitivities": [{
                "parameter": "foundation.layer.1.thickness", "value": 17.5, "penetration": 18.5,
                "smooth_penetration": null, "force": 19.5, "energy": 20.5,
            }],
        });
        let read = read(&step);
        assert_eq!(read.summary.fraction_at_limit, Some(0.25));
        assert_eq!(read.certificate.lines.gap_at_limit, Some(0.75));
        assert_eq!(read.sensitivities.unwrap()[0].derivatives.energy, 20.5);
    }
}
