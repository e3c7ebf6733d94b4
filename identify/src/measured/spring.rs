//! The cantilever of a force microscope: penetration from the height of its piezo and the force.
//!
//! `δ = z − d = z − F/k`: the penetration is the approach of the piezo less the deflection of the cantilever. The force
//! was computed from the deflection, `F = k d`, here or by the instrument, so another spring constant changes the force
//! but not the penetration. `identification/spring_constants.rs` describes the effect on a fit.

use pellicle::declare::shape::{Field, Shape, TableShape};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::dimension::{Dimension, Sign};
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::TomlValue;
use pellicle::input::value_reader::ValueReader;

use super::channel::Channel;
use super::curve::CurveWarning;
use super::error::CurveError;
use super::raw_curve::RawCurve;
use super::stated::{StatedNumber, StatedQuantity};

/// SI unit of a spring constant.
pub const UNIT: &str = "N/m";

/// The spring constant of a cantilever, N/m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringConstant {
    /// Its mean.
    pub mean: f64,
    /// Its standard deviation; none if it is taken as exact.
    pub sd: Option<f64>,
    /// Where it comes from.
    pub source: SpringSource,
}

/// Where a spring constant comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpringSource {
    /// The fit file, with its unit: files that state another one are refused.
    FitFile,
    /// The fit file, as a bare number, which replaces what the files state.
    BareNumber,
    /// The files of the measurement.
    Measurement,
}

impl SpringConstant {
    /// What it may be.
    #[must_use]
    pub fn shape() -> Shape {
        Shape::Either(vec![stiffness(), Shape::Table(Self::table())])
    }

    /// The keys of one with a standard deviation.
    fn table() -> TableShape {
        TableShape::of([
            Field::required("mean", "its value", stiffness()),
            Field::optional("sd", "its standard deviation", stiffness(), "none"),
        ])
    }

    /// Reads a stiffness, or a table of `mean` and `sd`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(field: &ValueReader<'_>) -> Result<Self, Diagnosis> {
        if !field.is_table() {
            let mean = field.quantity(Dimension::Stiffness, Sign::Positive)?;
            let source = SpringSource::of(field);
            let sd = None;
            return Ok(Self { mean, sd, source });
        }
        let table: TableReader<'_> = field.clone().table()?;
        table.only(&Self::table().keys())?;
        let sd = table.optional("sd");
        let sd = sd.map(|field| field.quantity(Dimension::Stiffness, Sign::Positive));
        Ok(Self {
            mean: table.positive("mean", Dimension::Stiffness)?,
            sd: sd.transpose()?,
            source: SpringSource::of(&table.required("mean", "a stiffness")?),
        })
    }

    /// Compares the constant with that of a file; a warning tells the one that was taken from it.
    pub(super) fn compared_with(
        &self,
        stated: &[StatedNumber],
    ) -> Result<Option<CurveWarning>, CurveError> {
        let Some(stated) = StatedNumber::of(StatedQuantity::SpringConstant, stated) else {
            return Ok(None);
        };
        match self.source {
            SpringSource::FitFile if stated.contradicts(self.mean) => {
                Err(CurveError::OtherSpringConstant {
                    given: self.mean,
                    stated: stated.value,
                    line: stated.line,
                    text: stated.text.clone(),
                })
            }
            SpringSource::Measurement => Ok(Some(CurveWarning::new(
                "stated-spring-constant",
                format!(
                    "the spring constant is that of line {}, \"{}\"",
                    stated.line, stated.text
                ),
            ))),
            SpringSource::FitFile | SpringSource::BareNumber => Ok(None),
        }
    }

    /// The constant that the files of a measurement state, the same in all of them; none if one states none.
    ///
    /// # Errors
    ///
    /// A file that states another one than the first, with both statements.
    pub fn of_files(
        stated: &[Vec<StatedNumber>],
    ) -> Result<Option<Self>, (usize, Box<[StatedNumber; 2]>)> {
        let one =
            |of: &Vec<StatedNumber>| StatedNumber::of(StatedQuantity::SpringConstant, of).cloned();
        let all: Option<Vec<StatedNumber>> = stated.iter().map(one).collect();
        let all = all.unwrap_or_default();
        let Some(first) = all.first() else {
            return Ok(None);
        };
        if let Some(other) = all.iter().position(|other| first.contradicts(other.value)) {
            let both = Box::new([first.clone(), all[other].clone()]);
            return Err((other, both));
        }
        let (mean, source) = (first.value, SpringSource::Measurement);
        Ok(Some(Self {
            mean,
            sd: None,
            source,
        }))
    }
}

impl SpringSource {
    fn of(field: &ValueReader<'_>) -> Self {
        match field.value() {
            TomlValue::Text(_) => Self::FitFile,
            _ => Self::BareNumber,
        }
    }
}

/// The direction in which the height of a piezo is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HeightDirection {
    /// Determined from the force, which grows towards the body.
    #[default]
    FromForce,
    /// A larger height is nearer to the body.
    Toward,
    /// A larger height is farther from the body.
    Away,
}

/// A positive stiffness.
const fn stiffness() -> Shape {
    Shape::Quantity(Dimension::Stiffness, Sign::Positive)
}

impl HeightDirection {
    /// The words for the directions.
    pub const CHOICES: [(&'static str, Self); 3] = [
        ("auto", Self::FromForce),
        ("toward", Self::Toward),
        ("away", Self::Away),
    ];

    /// Reads the word for a direction.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is not one of the words.
    pub fn read(field: &ValueReader<'_>) -> Result<Self, Diagnosis> {
        field.choice(&Self::CHOICES)
    }

    /// 1 if larger heights are nearer to the body, −1 otherwise.
    fn sign(self, heights: &[f64], forces: &[f64]) -> Result<f64, CurveError> {
        match self {
            Self::Toward => Ok(1.0),
            Self::Away => Ok(-1.0),
            Self::FromForce => match contact_slope(heights, forces) {
                slope if slope > 0.0 => Ok(1.0),
                slope if slope < 0.0 => Ok(-1.0),
                _ => Err(CurveError::HeightDirection),
            },
        }
    }
}

/// Computes the penetration, m, from the approach of the piezo, m, the force, N, and the spring constant, N/m. It is
/// zero at the first point.
///
/// ```
/// use pellicle_identify::measured::spring::penetration;
/// // 10 nm of approach, 2 nN on 1 N/m: 8 nm are left.
/// let found = penetration(&[0.0, 10e-9], &[1e-9, 3e-9], 1.0);
/// assert_eq!(found[0], 0.0);
/// // One rounding each of a difference, a quotient and a difference.
/// assert!((found[1] - 8e-9).abs() < 1e-23);
/// ```
#[must_use]
pub fn penetration(approach: &[f64], force: &[f64], spring_constant: f64) -> Vec<f64> {
    let (z0, f0) = match (approach.first(), force.first()) {
        (Some(z0), Some(f0)) => (*z0, *f0),
        _ => return Vec::new(),
    };
    // δ = (z − z0) − (F − F0)/k
    let depth = |(z, f): (&f64, &f64)| (z - z0) - (f - f0) / spring_constant;
    approach.iter().zip(force).map(depth).collect()
}

/// Orients the heights so that they grow towards the body. Adds the force, if the deflection is measured, and the
/// penetration at this spring constant.
pub(crate) fn add_penetration(
    raw: &mut RawCurve<'_>,
    direction: HeightDirection,
    spring: SpringConstant,
) -> Result<(), CurveError> {
    if let Some(deflections) = raw.values(Channel::Deflection) {
        // F = k d
        let forces = deflections.iter().map(|d| spring.mean * d).collect();
        raw.replace(Channel::Force, forces);
    }
    let (heights, forces) = (raw.values(Channel::Height), raw.values(Channel::Force));
    let (Some(heights), Some(forces)) = (heights, forces) else {
        return Ok(());
    };
    let sign = direction.sign(heights, forces)?;
    let approach = heights.iter().map(|height| sign * height).collect();
    raw.replace(Channel::Height, approach);
    subtract_deflection(raw, spring);
    Ok(())
}

/// Computes the penetration from the approach and the force, as far as both are there. Its zero does not matter here:
/// an invalid first row must not make all rows invalid.
pub(super) fn subtract_deflection(raw: &mut RawCurve<'_>, spring: SpringConstant) {
    let (approach, forces) = (raw.values(Channel::Height), raw.values(Channel::Force));
    if let (Some(approach), Some(forces)) = (approach, forces) {
        let depth = |(z, f): (&f64, &f64)| z - f / spring.mean;
        let depths = approach.iter().zip(forces).map(depth).collect();
        raw.replace(Channel::Depth, depths);
    }
}

/// Returns the covariance of a length and the force over the points in the upper half of the force range, that is, in
/// contact; its sign is that of the change of the length with the force. These points are not affected by adhesion,
/// drift before contact, or a slow retract after it. Points with NaN are ignored.
pub(super) fn contact_slope(lengths: &[f64], forces: &[f64]) -> f64 {
    let is_valid = |(length, force): &(&f64, &f64)| length.is_finite() && force.is_finite();
    let valid = || lengths.iter().zip(forces).filter(is_valid);
    let highest = valid()
        .map(|(_, force)| *force)
        .fold(f64::NEG_INFINITY, f64::max);
    let lowest = valid()
        .map(|(_, force)| *force)
        .fold(f64::INFINITY, f64::min);
    let middle = 0.5 * (highest + lowest);
    let contact: Vec<_> = valid().filter(|(_, force)| **force > middle).collect();
    let count = contact.len() as f64;
    let mean_length = contact.iter().map(|(length, _)| *length).sum::<f64>() / count;
    let mean_force = contact.iter().map(|(_, force)| *force).sum::<f64>() / count;
    let product = |(length, force): &(&f64, &f64)| (*length - mean_length) * (*force - mean_force);
    contact.iter().map(product).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_direction_is_that_of_increasing_force() {
        // Adhesion and a slope before contact are ignored.
        let forces = [0.0, 0.1, 0.2, -1.0, 1.0, 2.0, 3.0];
        let toward = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        let sign = |heights: &[f64]| HeightDirection::FromForce.sign(heights, &forces);
        assert_eq!(sign(&toward), Ok(1.0));
        assert_eq!(sign(&toward.map(|z| 10.0 - z)), Ok(-1.0));
        assert_eq!(sign(&[2.0; 7]), Err(CurveError::HeightDirection));
        assert_eq!(HeightDirection::Away.sign(&toward, &forces), Ok(-1.0));
    }
}
