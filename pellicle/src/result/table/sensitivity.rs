//! The columns of derivatives in a curve.

use crate::case::key_dimension;
use crate::input::dimension::Dimension;
use crate::input::units::Units;
use crate::result::quantity::cell;
use crate::summary::{RunSummary, StepSummary};

/// The parameters of the case whose derivatives are columns.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SensitivityColumns {
    keys: Vec<String>,
}

impl SensitivityColumns {
    /// The columns of the steps of a summary.
    #[must_use]
    pub fn of_steps(summary: &RunSummary) -> Self {
        let mut steps = summary.steps.iter();
        let first = steps.find_map(|step| step.sensitivities.as_ref());
        let keys = first.into_iter().flatten().map(|of| of.parameter.clone());
        Self {
            keys: keys.collect(),
        }
    }

    /// Names of the columns: for each parameter, the derivative for the elements in contact and that along the curve.
    #[must_use]
    pub fn header(&self, units: Units) -> Vec<String> {
        let unit = |key: &str| match units {
            Units::Consistent => units.name("m").to_owned(),
            Units::Si => format!("m per {}", si_unit(key)),
        };
        let of_key = |key: &String| {
            let unit = unit(key);
            [
                format!("d penetration/d {key} [{unit}]"),
                format!("d penetration/d {key} along the curve [{unit}]"),
            ]
        };
        self.keys.iter().flat_map(of_key).collect()
    }

    /// The values of a step; cells without a value are empty.
    #[must_use]
    pub fn row(&self, step: &StepSummary) -> Vec<String> {
        let of_key = |key: &String| {
            let mut found = step.sensitivities.iter().flatten();
            let found = found.find(|of| of.parameter == *key);
            [
                cell(found.and_then(|of| of.derivatives.penetration)),
                cell(found.and_then(|of| of.derivatives.smooth_penetration)),
            ]
        };
        self.keys.iter().flat_map(of_key).collect()
    }
}

/// The SI unit of a parameter of a case.
fn si_unit(key: &str) -> &'static str {
    key_dimension::of_path(key).map_or("1", Dimension::si_unit)
}
