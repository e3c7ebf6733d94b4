//! The length to which gaps are compared, by the solvers and in the certificate.
//!
//! On a free surface it is the penetration. In a periodic cell the penetration vanishes under a flat body, and the mean
//! displacement that it contains on a rigid base moves all elements alike, however deep: neither says how accurate a
//! gap must be. There it is the largest deformation without that mean,
//!
//! ```text
//! max |K p + w* − C(0) p̄|        at least 1e-6 max(|D|, C(2π/L) p̄)
//! ```
//!
//! The bound is for pressures that are nearly uniform, whose deformation without its mean is rounding.

/// The bound as a fraction: at the default tolerance it leaves gaps of 1e-14 of the displacement by the longest wave,
/// ten times the rounding of a product. Pressures under it are right to the tolerance if waves of one element are up to
/// a million times as stiff as the cell's longest.
const LEAST: f64 = 1e-6;

/// What the scale depends on besides the solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GapScale {
    /// The penetration.
    Penetration,
    /// The deformation of a periodic cell.
    Cell {
        /// `C(0)`: displacement per uniform pressure.
        mean: f64,
        /// `C(2π/L)` of the longest wave.
        longest: f64,
    },
}

impl GapScale {
    /// The same with compliances multiplied by a factor.
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Penetration => self,
            Self::Cell { mean, longest } => Self::Cell {
                mean: factor * mean,
                longest: factor * longest,
            },
        }
    }

    /// The length for a penetration `D` and a mean pressure `p̄`, all in one system of units. `deformation` returns
    /// the largest `|K p + w* − m|` of all elements for a mean displacement `m`.
    pub fn length(
        self,
        penetration: f64,
        mean_pressure: f64,
        deformation: impl FnOnce(f64) -> f64,
    ) -> f64 {
        match self {
            Self::Penetration => penetration.abs(),
            Self::Cell { mean, longest } => {
                let least = LEAST * penetration.abs().max(longest * mean_pressure);
                deformation(mean * mean_pressure).max(least)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::GapScale;

    const CELL: GapScale = GapScale::Cell {
        mean: 100.0,
        longest: 3.0,
    };

    #[test]
    fn on_a_free_surface_gaps_are_relative_to_the_penetration() {
        let length = GapScale::Penetration.length(-0.1, 2.0, |_| f64::NAN);
        assert!((length - 0.1).abs() <= 0.0);
    }

    #[test]
    fn in_a_cell_they_are_relative_to_the_deformation_without_its_mean() {
        // A mean pressure of 2 displaces by 200; of 205 and 198 at two elements, 5 is the largest deformation.
        let deformation = |mean: f64| f64::max((205.0 - mean).abs(), (198.0 - mean).abs());
        assert!((CELL.length(205.0, 2.0, deformation) - 5.0).abs() <= 0.0);
    }

    #[test]
    fn under_a_uniform_pressure_a_millionth_of_the_longest_wave_or_of_the_penetration_remains() {
        for (penetration, wanted) in [(0.0, 6e-6), (-500.0, 5e-4)] {
            let length = CELL.length(penetration, 2.0, |_| 0.0);
            // a rounding or two
            assert!((length / wanted - 1.0).abs() < 1e-15, "{length:e}");
        }
    }

    #[test]
    fn units_of_compliance_are_units_of_length() {
        let [small, large] =
            [1.0, 1e9].map(|factor| CELL.scaled(factor).length(0.0, 2.0, |mean| 0.01 * mean));
        assert!((large / small / 1e9 - 1.0).abs() < 1e-15);
    }
}
