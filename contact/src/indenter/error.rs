//! Errors in the numbers of an indenter.

use std::fmt;

use thiserror::Error;

use super::PowerLaw;

/// A number that the constructor of an indenter checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum IndenterQuantity {
    /// Radius of a paraboloid, sphere or flat punch, m.
    Radius,
    /// Radius of curvature of an elliptic paraboloid along x, m.
    RadiusAlongX,
    /// Radius of curvature of an elliptic paraboloid along y, m.
    RadiusAlongY,
    /// Radius of a rounded tip, m.
    TipRadius,
    /// Angle between the axis and the side of a cone, rad.
    HalfAngle,
    /// Angle between the axis and the faces of a pyramid, rad.
    FaceAngle,
    /// Exponent n of a power law.
    Exponent,
    /// Coefficient c of a power law, m.
    Coefficient,
}

impl fmt::Display for IndenterQuantity {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Radius => "the indenter's radius",
            Self::RadiusAlongX => "the indenter's radius along x",
            Self::RadiusAlongY => "the indenter's radius along y",
            Self::TipRadius => "the radius of the indenter's tip",
            Self::HalfAngle => "the half-angle of the cone",
            Self::FaceAngle => "the angle between the pyramid's axis and faces",
            Self::Exponent => "the exponent of the indenter's power law",
            Self::Coefficient => "the coefficient of the indenter's power law",
        })
    }
}

/// The reason why an indenter cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum IndenterError {
    /// A length that must be positive and finite is not.
    #[error("found {found} for {quantity}, wanted a positive finite number")]
    NotPositive {
        /// The quantity.
        quantity: IndenterQuantity,
        /// Its value, m.
        found: f64,
    },
    /// A length that must be zero or positive, and finite, is not.
    #[error("found {found} for {quantity}, wanted a finite number of zero or more")]
    Negative {
        /// The quantity.
        quantity: IndenterQuantity,
        /// Its value, m.
        found: f64,
    },
    /// An angle is not between 0 and π/2.
    #[error(
        "found {found} rad ({:.4}°) for {quantity}, wanted an angle between 0 and π/2 (90°)",
        found.to_degrees()
    )]
    Angle {
        /// The quantity.
        quantity: IndenterQuantity,
        /// Its value, rad.
        found: f64,
    },
    /// The exponent of a power law is that of a cusp, or so large that the indenter is hardly different from a punch.
    #[error(
        "found {found} for the exponent of the indenter's power law, wanted a number from {} to {}",
        PowerLaw::LEAST_EXPONENT,
        PowerLaw::MOST_EXPONENT
    )]
    Exponent {
        /// The exponent.
        found: f64,
    },
    /// A pyramid has too few faces to close, or so many that it is hardly different from a cone.
    #[error("found {found} faces for a pyramid, wanted {least} to {most}")]
    FaceCount {
        /// Number of faces requested.
        found: usize,
        /// Smallest number allowed.
        least: usize,
        /// Largest number allowed.
        most: usize,
    },
}

/// Returns the length if it is positive and finite.
pub(super) fn positive(quantity: IndenterQuantity, found: f64) -> Result<f64, IndenterError> {
    if found > 0.0 && found.is_finite() {
        Ok(found)
    } else {
        Err(IndenterError::NotPositive { quantity, found })
    }
}

/// Returns the length if it is zero or positive, and finite.
pub(super) fn not_negative(quantity: IndenterQuantity, found: f64) -> Result<f64, IndenterError> {
    if found >= 0.0 && found.is_finite() {
        Ok(found)
    } else {
        Err(IndenterError::Negative { quantity, found })
    }
}

/// Returns the angle if it lies strictly between 0 and π/2.
pub(super) fn acute(quantity: IndenterQuantity, found: f64) -> Result<f64, IndenterError> {
    if found > 0.0 && found < std::f64::consts::FRAC_PI_2 {
        Ok(found)
    } else {
        Err(IndenterError::Angle { quantity, found })
    }
}
