//! Fields inside a body under an axisymmetric pressure, by Hankel integrals of the kernel's amplitudes.
//!
//! With `p̅(k) = ∫ p J₀(kr) r dr` and the amplitudes of a wave of pressure:
//!
//! ```text
//! u_z  = ∫ p̅ u̅_z J₀ k dk     u_r  = ∫ p̅ u̅_x J₁ k dk     σ_zz = ∫ p̅ σ̅_zz J₀ k dk     σ_rz = ∫ p̅ σ̅_xz J₁ k dk
//! σ_rr = ∫ p̅ (σ̅_xx (J₀ − J₁/kr) + σ̅_yy J₁/kr) k dk      σ_θθ = ∫ p̅ (σ̅_xx J₁/kr + σ̅_yy (J₀ − J₁/kr)) k dk
//! ```

use libm::{j0, j1};
use pellicle_contact::axisymmetric::AxisymmetricPressure;
use pellicle_contact::axisymmetric::quadrature::{composite, graded};
use pellicle_influence::Depth;
use pellicle_kernel::{Foundation, InPlane};

use super::super::run::ValidationError;

/// An axisymmetric pressure, given by its transform.
#[derive(Debug, Clone)]
pub struct RadialPressure<F> {
    /// `p̅(k) = ∫ p J₀(kr) r dr`, in N.
    pub transform: F,
    /// Radius of the loaded area, m.
    pub radius: f64,
}

/// Returns the pressure of an axisymmetric contact.
#[must_use]
pub fn of_contact(pressure: &AxisymmetricPressure) -> RadialPressure<impl Fn(f64) -> f64 + '_> {
    RadialPressure {
        transform: |k: f64| pressure.transform(k),
        radius: pressure.radius(),
    }
}

/// The state at a point of a body in cylindrical coordinates; z into the body, tension positive.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RadialState {
    /// `u_r`, m.
    pub outward: f64,
    /// `u_z`, m.
    pub sinking: f64,
    /// `σ_rr`, Pa.
    pub radial: f64,
    /// `σ_θθ`, Pa.
    pub hoop: f64,
    /// `σ_zz`, Pa.
    pub axial: f64,
    /// `σ_rz`, Pa.
    pub shear: f64,
}

impl RadialState {
    /// Returns the von Mises stress, Pa.
    #[must_use]
    pub fn von_mises(&self) -> f64 {
        let Self {
            radial,
            hoop,
            axial,
            shear,
            ..
        } = self;
        let squares = (radial - hoop).powi(2) + (hoop - axial).powi(2) + (axial - radial).powi(2);
        (0.5 * squares + 3.0 * shear * shear).sqrt()
    }
}

/// Returns a uniform pressure (Pa) on a circle of this radius (m): `p̅ = q a J₁(ka)/k`.
#[must_use]
pub fn circle(pressure: f64, radius: f64) -> RadialPressure<impl Fn(f64) -> f64> {
    RadialPressure {
        transform: move |k: f64| pressure * radius * j1(k * radius) / k,
        radius,
    }
}

/// `e^{−kz}` is negligible beyond this `kz`.
const DECAY: f64 = 42.0;

/// Computes the fields at distances `radii` (m) from the axis at a depth below the surface.
///
/// Accuracy: 1e-11 of the largest stress, for depths above a hundredth of the pressure's radius.
///
/// # Errors
/// An error if the kernel cannot give the amplitudes.
pub fn fields<F: Fn(f64) -> f64>(
    foundation: &Foundation,
    pressure: &RadialPressure<F>,
    depth: Depth,
    radii: &[f64],
) -> Result<Vec<RadialState>, ValidationError> {
    let farthest = radii.iter().copied().fold(0.0, f64::max);
    // One piece per half period of p̅ J.
    let width = std::f64::consts::PI / (pressure.radius + farthest + depth.z);
    let mut states = vec![RadialState::default(); radii.len()];
    for (k, weight) in composite(&graded(DECAY / depth.z, width)) {
        let wave = foundation.interior(k)?.at(depth.z, depth.side).normal;
        let factor = weight * k * (pressure.transform)(k);
        for (state, r) in states.iter_mut().zip(radii) {
            state.add(&wave, k * r, factor);
        }
    }
    Ok(states)
}

impl RadialState {
    fn add(&mut self, wave: &InPlane, argument: f64, factor: f64) {
        let (even, odd) = (j0(argument), j1(argument));
        let odd_over = if argument == 0.0 { 0.5 } else { odd / argument };
        let (along, across) = (wave.longitudinal_stress, wave.transverse_stress);
        self.outward += factor * wave.horizontal_displacement * odd;
        self.sinking += factor * wave.vertical_displacement * even;
        self.radial += factor * (along * (even - odd_over) + across * odd_over);
        self.hoop += factor * (along * odd_over + across * (even - odd_over));
        self.axial += factor * wave.normal_stress * even;
        self.shear += factor * wave.shear_stress * odd;
    }
}
