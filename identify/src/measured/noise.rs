//! The table `noise` of a fit file: the noise of a measurement, as far as it is known.

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::table_reader::TableReader;

use crate::Reading;

/// The noise, as far as it is known; the rest is estimated.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MeasuredNoise {
    /// Standard deviation of the depth, m.
    pub depth: Option<f64>,
    /// Standard deviation of the force, N.
    pub force: Option<f64>,
    /// Standard deviation of the stiffness, N/m.
    pub stiffness: Option<f64>,
    /// Standard deviation of the observable relative to its value.
    pub relative: Option<f64>,
    /// Whether the noise of neighbouring points is correlated.
    pub correlation: NoiseCorrelation,
}

/// Whether the noise of neighbouring points is correlated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum NoiseCorrelation {
    /// Noise is independent.
    None,
    /// Noise is correlated, and the correlation is estimated.
    #[default]
    Estimate,
}

impl MeasuredNoise {
    /// The standard deviation of a quantity, if it is known.
    #[must_use]
    pub fn of(&self, reading: Reading) -> Option<f64> {
        match reading {
            Reading::Depth => self.depth,
            Reading::Force => self.force,
            Reading::Stiffness => self.stiffness,
            Reading::ContactRadius => None,
        }
    }

    const CORRELATIONS: [(&'static str, NoiseCorrelation); 2] = [
        ("none", NoiseCorrelation::None),
        ("estimate", NoiseCorrelation::Estimate),
    ];

    /// Its keys.
    #[must_use]
    pub fn shape() -> TableShape {
        let sd = |key, meaning, dimension| {
            let shape = Shape::Quantity(dimension, Sign::NotNegative);
            Field::optional(key, meaning, shape, "estimated")
        };
        let relative = "a part of what is observed, beside the other";
        let correlations = Shape::words(&Self::CORRELATIONS);
        TableShape::of([
            sd("depth", "that of a depth", Dimension::Length),
            sd("force", "that of a force", Dimension::Force),
            sd("stiffness", "that of a stiffness", Dimension::Stiffness),
            Field::optional("relative", relative, Shape::Number, "0"),
            Field::optional(
                "correlation",
                "of neighbouring points",
                correlations,
                "`\"estimate\"`",
            ),
        ])
    }

    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&Self::shape().keys())?;
        let quantity = |key, dimension| {
            let field = table.optional(key);
            field
                .map(|field| field.quantity(dimension, Sign::NotNegative))
                .transpose()
        };
        let relative = table.optional("relative").map(|field| {
            let wanted = "a fraction of 0 or more, below 1";
            let number = field.number(wanted)?;
            Some(number)
                .filter(|n| (0.0..1.0).contains(n))
                .ok_or_else(|| field.wanted(wanted))
        });
        let correlation = table.optional("correlation");
        let correlation = correlation.map(|field| field.choice(&Self::CORRELATIONS));
        Ok(Self {
            depth: quantity("depth", Dimension::Length)?,
            force: quantity("force", Dimension::Force)?,
            stiffness: quantity("stiffness", Dimension::Stiffness)?,
            relative: relative.transpose()?,
            correlation: correlation.transpose()?.unwrap_or_default(),
        })
    }
}
