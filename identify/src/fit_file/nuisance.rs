//! `[nuisance]` of a fit file: zero, frame compliance and drift of the curves, and parameters of the model that are not
//! known exactly.

use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::Dimension;
use pellicle::input::table_reader::TableReader;
use pellicle::input::value_reader::ValueReader;

use super::model::ModelParameters;
use super::prior;
use super::unknown::{UnknownCase, flattened, read_unknown};
use crate::{IdentifyError, LinearNuisance, Prior};

/// The nuisances of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct NuisanceTable {
    /// Whether each curve has its own zero.
    pub shift: Switch,
    /// Compliance of the frame.
    pub frame_compliance: Freedom,
    /// Whether each curve drifts.
    pub drift: Switch,
    /// Parameters of the model that are not known exactly.
    pub parameters: Vec<UnknownCase>,
}

/// Whether a nuisance is present, separate for each curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Switch {
    /// The nuisance is absent.
    Off,
    /// Each curve has its own nuisance.
    PerCurve,
}

/// The prior knowledge of a nuisance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Freedom {
    /// The nuisance is absent.
    Off,
    /// The nuisance has no prior.
    Free,
    /// A normal prior.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        sd: f64,
    },
}

impl Default for NuisanceTable {
    fn default() -> Self {
        Self {
            shift: Switch::PerCurve,
            frame_compliance: Freedom::Off,
            drift: Switch::Off,
            parameters: Vec::new(),
        }
    }
}

impl NuisanceTable {
    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(field: &ValueReader<'_>, parameters: &ModelParameters) -> Result<Self, Diagnosis> {
        let mut table = Self::default();
        for (key, field) in flattened(field)? {
            match key.as_str() {
                "shift" => table.shift = switch(&field)?,
                "drift" => table.drift = switch(&field)?,
                "frame_compliance" => table.frame_compliance = freedom(&field)?,
                _ => table
                    .parameters
                    .push(read_unknown(&key, &field, parameters)?),
            }
        }
        Ok(table)
    }

    /// The nuisances that enter linearly.
    ///
    /// # Errors
    ///
    /// [`IdentifyError`] if a prior is invalid.
    pub fn linear(&self) -> Result<Vec<LinearNuisance>, IdentifyError> {
        let mut nuisances = Vec::new();
        if self.shift == Switch::PerCurve {
            nuisances.push(LinearNuisance::shift());
        }
        match self.frame_compliance {
            Freedom::Off => {}
            Freedom::Free => nuisances.push(LinearNuisance::frame_compliance()),
            Freedom::Normal { mean, sd } => {
                let nuisance = LinearNuisance::frame_compliance();
                nuisances.push(nuisance.with_normal_prior(mean, sd)?);
            }
        }
        if self.drift == Switch::PerCurve {
            nuisances.push(LinearNuisance::drift());
        }
        Ok(nuisances)
    }
}

/// Reads `"off"` or `{ per = "curve" }`.
fn switch(field: &ValueReader<'_>) -> Result<Switch, Diagnosis> {
    const WANTED: &str = "\"off\" or { per = \"curve\" }";
    if !field.is_table() {
        return match field.text() {
            Ok("off") => Ok(Switch::Off),
            _ => Err(field.wanted(WANTED)),
        };
    }
    let table = field.clone().table()?;
    table.only(&["per"])?;
    let per = table.required("per", "\"curve\"")?;
    per.choice(&[("curve", Switch::PerCurve)])
}

/// Reads `"off"`, `"free"` or a normal prior.
fn freedom(field: &ValueReader<'_>) -> Result<Freedom, Diagnosis> {
    const WANTED: &str =
        "\"off\", \"free\" or { prior = \"normal\", mean = \"0 nm/mN\", sd = \"0.2 nm/mN\" }";
    if !field.is_table() {
        return match field.text() {
            Ok("off") => Ok(Freedom::Off),
            Ok("free") => Ok(Freedom::Free),
            _ => Err(field.wanted(WANTED)),
        };
    }
    let table: TableReader<'_> = field.clone().table()?;
    table.only(&prior::KEYS)?;
    match prior::read(&table, Some(Dimension::FrameCompliance))? {
        Some(Prior::Normal { mean, sd }) => Ok(Freedom::Normal { mean, sd }),
        _ => Err(field.wanted(WANTED)),
    }
}
