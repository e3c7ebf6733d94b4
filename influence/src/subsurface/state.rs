//! Displacements and stresses at one point, and the loads that they are of.

use std::ops::{Add, AddAssign, Mul};

/// A uniform load on an element, of 1 Pa.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceLoad {
    /// A pressure.
    Pressure,
    /// A traction that drags the surface along +x.
    Traction,
}

/// Fields at a point: three displacements and six stresses.
pub const FIELDS: usize = 9;

/// Displacements and stresses at a point of the body. Tension is positive, z into the body.
///
/// Of a unit load, in Pa, displacements are in m/Pa and stresses without unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SubsurfaceState {
    /// `u_x`, `u_y`, `u_z`.
    pub displacement: [f64; 3],
    /// `σ_xx`, `σ_yy`, `σ_zz`, `σ_xy`, `σ_xz`, `σ_yz`.
    pub stress: [f64; 6],
}

impl SubsurfaceState {
    /// The state in axes in which x and y have changed places.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let [ux, uy, uz] = self.displacement;
        let [xx, yy, zz, xy, xz, yz] = self.stress;
        Self {
            displacement: [uy, ux, uz],
            stress: [yy, xx, zz, xy, yz, xz],
        }
    }

    /// The displacements, then the stresses, by one index.
    ///
    /// # Panics
    /// If the index is above 8.
    #[must_use]
    pub fn field(&self, index: usize) -> f64 {
        match index.checked_sub(3) {
            None => self.displacement[index],
            Some(index) => self.stress[index],
        }
    }

    /// Von Mises' equivalent stress.
    #[must_use]
    pub fn von_mises(&self) -> f64 {
        let [xx, yy, zz, xy, xz, yz] = self.stress;
        let squares = |a: f64, b: f64, c: f64| a * a + b * b + c * c;
        // σ² = ½ [(σ_xx − σ_yy)² + (σ_yy − σ_zz)² + (σ_zz − σ_xx)²] + 3 (σ_xy² + σ_xz² + σ_yz²)
        (0.5 * squares(xx - yy, yy - zz, zz - xx) + 3.0 * squares(xy, xz, yz)).sqrt()
    }
}

impl AddAssign for SubsurfaceState {
    fn add_assign(&mut self, other: Self) {
        let displacements = self.displacement.iter_mut().zip(other.displacement);
        let stresses = self.stress.iter_mut().zip(other.stress);
        displacements
            .chain(stresses)
            .for_each(|(sum, term)| *sum += term);
    }
}

impl Add for SubsurfaceState {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl Mul<f64> for SubsurfaceState {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            displacement: self.displacement.map(|value| value * factor),
            stress: self.stress.map(|value| value * factor),
        }
    }
}
