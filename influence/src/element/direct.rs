//! The reference method: the coefficient (3.4) of Stepanov and Torskaya (2022) by adaptive quadrature, without tables.
//!
//! In polar wavenumbers, with `γ = k a` and the homogeneous part subtracted and added in closed form,
//!
//! `k = k_Love + 8(1−ν1²)a/(π²E1) ∫₀^∞ (Φ(γ/a) − 1) A(γ) dγ`,
//! `A(γ) = ∫₀^{π/2} sinc(γ cos φ) sinc(γ sin φ) cos(2mγ cos φ) cos(2nγ sin φ) dφ`.
//!
//! `Φ − 1` falls exponentially beyond the reciprocal thickness of the top layer, so the outer integral ends at
//! `24 a/h1`.

use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, PI};

use pellicle_kernel::{Foundation, Layer};

use crate::element::check_element_side;
use crate::element::love;
use crate::error::InfluenceError;
use crate::numerics::quadrature::integrate;
use crate::numerics::rounding;

/// `Φ − 1` is below 3e-18 beyond this wavenumber, in units of 1/thickness of the top layer.
const LAST_WAVENUMBER: f64 = 24.0;

/// Requested error, relative to Love's coefficient at the same offset.
const TOLERANCE: f64 = 1e-11;

/// Fraction of the error allowed to the inner integrals.
const INNER_SHARE: f64 = 0.1;

/// Smallest absolute error of an inner integral, which is of order one, in 16 digits.
const ROUNDING: f64 = 1e-15;

/// More oscillations than this in either direction are refused: the cost is their square.
const LARGEST_OSCILLATIONS: f64 = 400.0;

/// Influence coefficient `k`, m/Pa, of a square element of side `element_side` (m), `offset` elements away, by
/// adaptive quadrature.
///
/// The error is at most 1e-11 of [`love::coefficient`] at the same offset, plus the rounding of the inner integrals,
/// some 1e-15 of Love's coefficient at offset 0 times the largest `|Φ − 1|`. The cost is the square of the number of
/// oscillations, about `8 (m+n+1) a/h1`, where a is half a side and h1 the thickness of the top layer: the 400 at which
/// the integral is refused cost 160,000 times as much as one. [`crate::RadialTables`] has no such limits; this function
/// is an independent check of it.
///
/// ```
/// use pellicle_influence::{RadialTables, direct};
/// use pellicle_kernel::{Foundation, Material};
///
/// let (coating, steel) = (Material::new(400e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let foundation = Foundation::coated(2e-6, coating, steel)?;
/// let slow = direct::coefficient(&foundation, 1e-6, [1, 0])?;
/// let fast = RadialTables::build(&foundation)?.coefficient(1e-6, [1, 0]);
/// // The tolerance of the quadrature.
/// assert!((slow / fast - 1.0).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// A side that is not finite and positive; [`InfluenceError::TooManyOscillations`]; a quadrature that misses its
/// tolerance.
pub fn coefficient(
    foundation: &Foundation,
    element_side: f64,
    offset: [usize; 2],
) -> Result<f64, InfluenceError> {
    check_element_side(element_side)?;
    let surface = foundation.surface_material();
    let homogeneous = love::coefficient(&surface, element_side, offset);
    let Some(top) = foundation.layers().first().map(Layer::thickness) else {
        return Ok(homogeneous);
    };
    let half_side = element_side / 2.0;
    let last = LAST_WAVENUMBER * half_side / top;
    let oscillations = last * (2 * (offset[0] + offset[1]) + 2) as f64 / (2.0 * PI);
    if oscillations > LARGEST_OSCILLATIONS {
        return Err(InfluenceError::TooManyOscillations {
            found: oscillations,
            largest: LARGEST_OSCILLATIONS,
        });
    }
    let scale = 8.0 * half_side / (PI * PI * surface.plane_strain_modulus());
    let tolerance = TOLERANCE * homogeneous / scale;
    let layered = outer_integral(foundation, half_side, offset, last, tolerance)?;
    Ok(homogeneous + scale * layered)
}

/// `∫ (Φ(γ/a) − 1) A(γ) dγ` from 0 to `last`.
fn outer_integral(
    foundation: &Foundation,
    half_side: f64,
    offset: [usize; 2],
    last: f64,
    tolerance: f64,
) -> Result<f64, InfluenceError> {
    let inner_tolerance = INNER_SHARE * tolerance / last;
    let failure = Cell::new(None);
    let integrand = |gamma: f64| {
        let response = foundation.response_minus_one(gamma / half_side);
        // An inner integral need not be more accurate than its factor requires.
        let wanted = inner_tolerance / response.abs().max(f64::MIN_POSITIVE);
        match inner_integral(gamma, offset, wanted.clamp(ROUNDING, TOLERANCE)) {
            Ok(inner) => response * inner,
            Err(error) => {
                failure.set(Some(error));
                f64::NAN
            }
        }
    };
    let outcome = integrate(integrand, [0.0, last], pieces(last, offset), tolerance);
    match failure.get() {
        Some(error) => Err(error),
        None => outcome.map(|integral| integral.value),
    }
}

/// `A(γ)`.
fn inner_integral(gamma: f64, offset: [usize; 2], tolerance: f64) -> Result<f64, InfluenceError> {
    let [m, n] = offset.map(|count| 2.0 * count as f64);
    let integrand = |phi: f64| {
        let (y, x) = (gamma * phi.sin(), gamma * phi.cos());
        sinc(x) * sinc(y) * (m * x).cos() * (n * y).cos()
    };
    let outcome = integrate(
        integrand,
        [0.0, FRAC_PI_2],
        pieces(gamma, offset),
        tolerance,
    );
    outcome.map(|integral| integral.value)
}

/// Intervals of about two oscillations.
fn pieces(length: f64, offset: [usize; 2]) -> usize {
    let oscillations = length * (2 * (offset[0] + offset[1]) + 2) as f64 / (2.0 * PI);
    rounding::floor(oscillations / 2.0) + 1
}

/// `sin x / x`.
pub(crate) fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}
