//! Displacements and stresses at one point, and the loads that cause them.

use std::ops::{Add, AddAssign, Mul};

use super::principal;

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
/// For a unit load, in Pa, displacements are in m/Pa and stresses are dimensionless.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SubsurfaceState {
    /// `u_x`, `u_y`, `u_z`.
    pub displacement: [f64; 3],
    /// `σ_xx`, `σ_yy`, `σ_zz`, `σ_xy`, `σ_xz`, `σ_yz`.
    pub stress: [f64; 6],
}

impl SubsurfaceState {
    /// The state with these displacements and stresses in one list.
    pub(super) fn from_fields(fields: [f64; FIELDS]) -> Self {
        Self {
            displacement: std::array::from_fn(|i| fields[i]),
            stress: std::array::from_fn(|i| fields[3 + i]),
        }
    }

    /// The state in axes with x and y exchanged.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let [ux, uy, uz] = self.displacement;
        let [xx, yy, zz, xy, xz, yz] = self.stress;
        Self {
            displacement: [uy, ux, uz],
            stress: [yy, xx, zz, xy, yz, xz],
        }
    }

    /// The displacements and then the stresses, by one index.
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

    /// The mean of the normal stresses.
    #[must_use]
    pub fn hydrostatic(&self) -> f64 {
        (self.stress[0] + self.stress[1] + self.stress[2]) / 3.0
    }

    /// The principal stresses, largest first.
    #[must_use]
    pub fn principal(&self) -> [f64; 3] {
        self.principal_axes().map(|(stress, _)| stress)
    }

    /// The principal stresses, largest first, each with its direction, a unit vector.
    #[must_use]
    pub fn principal_axes(&self) -> [(f64, [f64; 3]); 3] {
        let [xx, yy, zz, xy, xz, yz] = self.stress;
        let mut axes = principal::axes_of([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
        axes.sort_by(|(one, _), (other, _)| other.total_cmp(one));
        axes
    }

    /// Tresca's largest shear stress, half the difference of the outer principal stresses.
    #[must_use]
    pub fn max_shear(&self) -> f64 {
        let [largest, _, least] = self.principal();
        (largest - least) / 2.0
    }
}

impl AddAssign for SubsurfaceState {
    #[inline]
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

    #[inline]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl Mul<f64> for SubsurfaceState {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self {
            displacement: self.displacement.map(|value| value * factor),
            stress: self.stress.map(|value| value * factor),
        }
    }
}
