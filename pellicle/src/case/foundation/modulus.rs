//! Young's modulus of a layer: uniform, or graded from the top of the layer to its bottom.

use serde::Serialize;

use crate::input::diagnosis::Diagnosis;
use crate::input::dimension::{Dimension, Sign};
use crate::input::value_reader::ValueReader;

/// Young's modulus of a layer, Pa.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ModulusCase {
    /// The same at every depth.
    Uniform(f64),
    /// Changing with depth.
    Graded(GradingCase),
}

/// A Young's modulus that changes with depth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GradingCase {
    /// Modulus at the top, Pa.
    pub from: f64,
    /// Modulus at the bottom, Pa.
    pub to: f64,
    /// Its profile in between.
    pub profile: GradingProfile,
}

/// The profile of a graded modulus between top and bottom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum GradingProfile {
    /// Changes by the same amount over equal depths.
    Linear,
    /// Changes by the same factor over equal depths.
    Exponential,
}

impl ModulusCase {
    /// Reads a modulus, or a table of two moduli and a profile.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if it is neither, or a modulus is not positive.
    pub fn read(field: ValueReader<'_>) -> Result<Self, Diagnosis> {
        if !field.is_table() {
            let modulus = field.quantity(Dimension::Pressure, Sign::Positive)?;
            return Ok(Self::Uniform(modulus));
        }
        let table = field.table()?;
        table.only(&["from", "to", "profile"])?;
        let profile = table.required("profile", "\"linear\" or \"exponential\"")?;
        Ok(Self::Graded(GradingCase {
            from: table.positive("from", Dimension::Pressure)?,
            to: table.positive("to", Dimension::Pressure)?,
            profile: profile.choice(&[
                ("linear", GradingProfile::Linear),
                ("exponential", GradingProfile::Exponential),
            ])?,
        }))
    }

    /// The modulus at the top, Pa.
    #[must_use]
    pub fn at_top(self) -> f64 {
        match self {
            Self::Uniform(modulus) | Self::Graded(GradingCase { from: modulus, .. }) => modulus,
        }
    }
}

impl GradingCase {
    /// The modulus (Pa) at this fraction of the thickness, 0 at the top and 1 at the bottom.
    #[must_use]
    pub fn at(self, part: f64) -> f64 {
        let Self { from, to, profile } = self;
        match profile {
            GradingProfile::Linear => from + (to - from) * part,
            GradingProfile::Exponential => from * (to / from).powf(part),
        }
    }
}
