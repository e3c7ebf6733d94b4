//! The fields of one loading step as the checks look at them.

use super::ClaimsError;

/// The solution on a square of `elements × elements` elements centred on the axis; the first index runs along x.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ContactFields {
    /// Elements per side, N.
    pub(super) elements: usize,
    /// Side of the square.
    pub(super) side: f64,
    /// Pressure `p`.
    pub(super) pressure: Vec<f64>,
    /// Displacement `u` of the body's surface, positive into the body.
    pub(super) displacement: Vec<f64>,
    /// Height of the indenter above its lowest point, `f`.
    pub(super) indenter: Vec<f64>,
    /// Where the relief stands.
    pub(super) relief: Vec<bool>,
}

impl ContactFields {
    /// The fields, if they are as long as the grid is large.
    ///
    /// # Errors
    /// [`ClaimsError::Fields`] if one of them is not.
    pub(super) fn checked(self) -> Result<Self, ClaimsError> {
        let wanted = self.elements * self.elements;
        let lengths = [
            self.pressure.len(),
            self.displacement.len(),
            self.indenter.len(),
            self.relief.len(),
        ];
        match lengths
            .into_iter()
            .find(|&found| found != wanted || found == 0)
        {
            Some(found) => Err(ClaimsError::Fields { wanted, found }),
            None => Ok(self),
        }
    }

    /// Side of an element.
    pub(super) fn element_side(&self) -> f64 {
        self.side / self.elements as f64
    }

    /// Coordinate of the centres of row or column `i`.
    pub(super) fn centre(&self, i: usize) -> f64 {
        (i as f64 + 0.5) * self.element_side() - self.side / 2.0
    }

    /// Centre of the element at `index`.
    pub(super) fn point(&self, index: usize) -> [f64; 2] {
        [index / self.elements, index % self.elements].map(|i| self.centre(i))
    }

    /// Distance of the element at `index` from the axis.
    pub(super) fn radius(&self, index: usize) -> f64 {
        let [x, y] = self.point(index);
        x.hypot(y)
    }

    /// The elements in contact.
    pub(super) fn contact(&self) -> impl Iterator<Item = usize> {
        (0..self.pressure.len()).filter(|&index| self.pressure[index] > 0.0)
    }

    /// The elements in contact that lie between the elements of the relief.
    pub(super) fn contact_between(&self) -> impl Iterator<Item = usize> {
        self.contact().filter(|&index| !self.relief[index])
    }

    /// Distance of the farthest element in contact from the axis; 0 without contact.
    pub(super) fn contact_radius(&self) -> f64 {
        farthest(self.contact().map(|index| self.radius(index)))
    }
}

/// The largest of some distances; 0 without any.
pub(super) fn farthest(distances: impl Iterator<Item = f64>) -> f64 {
    distances.fold(0.0, f64::max)
}
