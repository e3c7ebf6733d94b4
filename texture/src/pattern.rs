//! A lattice of equal round features on the surface: cylinders or dimples.

use crate::error::{Quantity, TextureError, positive};
use crate::lattice::Lattice;
use crate::placement::Placement;

/// The centres of equal round features: a lattice with its place on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    lattice: Lattice,
    period: f64,
    placement: Placement,
}

impl Pattern {
    /// Puts a lattice of this period T (m) with one centre at `offset` (m).
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if the period is not positive and finite, [`TextureError::NotFinite`] if the
    /// offset is not finite.
    pub fn new(lattice: Lattice, period: f64, offset: [f64; 2]) -> Result<Self, TextureError> {
        let period = positive(Quantity::Period, period)?;
        let placement = Placement::new(offset, 0.0)?;
        Ok(Self {
            lattice,
            period,
            placement,
        })
    }

    /// Returns the same lattice turned about the centre at the offset, by `rotation` (radians) from x to y.
    ///
    /// # Errors
    ///
    /// [`TextureError::NotFinite`] if the rotation is not finite.
    pub fn turned(self, rotation: f64) -> Result<Self, TextureError> {
        let placement = Placement::new(self.offset(), rotation)?;
        Ok(Self { placement, ..self })
    }

    /// Arrangement of the centres.
    #[must_use]
    pub fn lattice(&self) -> Lattice {
        self.lattice
    }

    /// Distance T between neighbouring centres, m.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Position of one centre, m.
    #[must_use]
    pub fn offset(&self) -> [f64; 2] {
        self.placement.offset()
    }

    /// Rotation about that centre from x to y, radians.
    #[must_use]
    pub fn rotation(&self) -> f64 {
        self.placement.rotation()
    }

    /// Fraction of the plane that discs of this radius (m) on all centres cover.
    #[must_use]
    pub fn area_fraction(&self, radius: f64) -> f64 {
        self.lattice.area_fraction(radius, self.period)
    }

    /// Distance from a point to the nearest centre, m.
    #[must_use]
    pub fn distance_to_centre(&self, point: [f64; 2]) -> f64 {
        let local = self.placement.local(point);
        self.lattice.distance_to_centre(self.period, local)
    }

    /// Distance from a vector (m) to the nearest one that moves the lattice onto itself, m.
    #[must_use]
    pub fn distance_to_translation(&self, vector: [f64; 2]) -> f64 {
        let local = self.placement.turned_back(vector);
        self.lattice.distance_to_centre(self.period, local)
    }

    /// Whether the lattice is symmetric in x and y by its cell: each axis passes through a centre or halfway between
    /// two centres.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.placement.is_mirrored(self.lattice.cell(self.period))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_lattice_has_its_centres_turned() {
        let pattern = Pattern::new(Lattice::Hexagonal, 2.0, [0.5, 0.25]).unwrap();
        let turned = pattern.turned(f64::to_radians(20.0)).unwrap();
        for k in 0..6 {
            let (sine, cosine) = f64::to_radians(20.0 + 60.0 * f64::from(k)).sin_cos();
            let centre = [0.5 + 2.0 * cosine, 0.25 + 2.0 * sine];
            assert!(turned.distance_to_centre(centre) < 1e-15 * 8.0, "{k}");
            assert!(turned.distance_to_translation([2.0 * cosine, 2.0 * sine]) < 1e-14);
        }
        assert!(!turned.is_mirrored() && turned.distance_to_centre([2.5, 0.25]) > 0.5);
    }
}
