//! The fields of one loading step.

/// The fields of a step, N × N values each, element `(i, j)` at index `i N + j`: the first index runs along x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fields<'a> {
    /// Side of the square domain, m.
    pub side: f64,
    /// Elements per side, N.
    pub size: usize,
    /// Pressure `p`, Pa.
    pub pressure: &'a [f64],
    /// Displacement `u` of the body's surface, m, positive into the body.
    pub displacement: &'a [f64],
    /// Gap `g`, m; +∞ where there is no indenter surface.
    pub gap: &'a [f64],
    /// Shortening `w*` of the relief, m.
    pub shortening: &'a [f64],
    /// Plastic depth where the pressure is cut at a hardness, m; empty without a hardness.
    pub plastic_depth: &'a [f64],
    /// Profile `f*` of the relief, m: 0 on the tops, negative between them.
    pub profile: &'a [f64],
    /// Whether an element belongs to the relief.
    pub mask: &'a [bool],
}

impl Fields<'_> {
    /// Coordinate of the lower side of element `i`, m; `i` may lie outside the domain.
    #[must_use]
    pub fn edge(&self, i: usize) -> f64 {
        self.side * (i as f64 / self.size as f64 - 0.5)
    }

    /// Coordinate of the centre of element `i`, m.
    #[must_use]
    pub fn centre(&self, i: usize) -> f64 {
        // x_i = (2i + 1 − N) h/2; the bracket is exact.
        ((2 * i + 1) as f64 - self.size as f64) * (0.5 * self.element_side())
    }

    /// The element along an axis that contains a coordinate or is nearest to it.
    #[must_use]
    pub fn nearest(&self, coordinate: f64) -> usize {
        let elements = (coordinate / self.side + 0.5) * self.size as f64;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the conversion saturates"
        )]
        let element = elements as usize;
        element.min(self.size.saturating_sub(1))
    }

    /// Side of an element, m.
    #[must_use]
    pub fn element_side(&self) -> f64 {
        self.side / self.size as f64
    }
}
