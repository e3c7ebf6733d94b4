//! A relief of any shape: a profile and a compliance at every point.

use std::fmt::Debug;
use std::sync::Arc;

use crate::Relief;
use crate::error::{Quantity, TextureError, not_negative};

/// Points along each side of the square over which a compliance is averaged; the mean only serves an estimate.
const POINTS: u32 = 16;

/// A user-defined relief of springs. [`custom`](crate::Relief::custom) makes a [`Relief`](crate::Relief) of it. The
/// springs are linear.
pub trait ReliefShape: Debug + Send + Sync {
    /// Returns the surface profile `f*` at the given points (m): 0 on the highest tops, negative elsewhere, finite.
    fn profile(&self, points: &[[f64; 2]]) -> Vec<f64>;

    /// Returns the compliance η at the given points, m/Pa: not negative; 0 where the relief is as rigid as a part of
    /// the body.
    fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64>;

    /// Whether profile and compliance are symmetric in x and y. If they are, a quarter of the elements is solved for.
    fn is_mirrored(&self) -> bool {
        false
    }

    /// The relief without wear, if this is a worn one: its waves are those that a grid has to resolve, as the wear is
    /// known at elements only.
    fn unworn(&self) -> Option<&Relief> {
        None
    }

    /// Returns the mean of η over [points of the square](mean_points) around the axis that encloses the circle of this
    /// radius (m), m/Pa. It is meant for estimates.
    fn mean_compliance(&self, radius: f64) -> f64 {
        let values = self.compliance(&mean_points(radius));
        values.iter().sum::<f64>() / values.len() as f64
    }
}

/// Returns points of the square around the axis that encloses the circle of this radius (m), for taking a mean over it.
#[must_use]
pub fn mean_points(radius: f64) -> Vec<[f64; 2]> {
    let at = |i: u32| radius * (f64::from(2 * i + 1) / f64::from(POINTS) - 1.0);
    (0..POINTS * POINTS)
        .map(|k| [at(k / POINTS), at(k % POINTS)])
        .collect()
}

/// A user-defined shape, shared by all copies of a relief. It equals only its own copies.
#[derive(Clone, Debug)]
pub struct CustomRelief {
    shape: Arc<dyn ReliefShape>,
    /// Replaces the compliance of the shape, m/Pa.
    uniform_compliance: Option<f64>,
}

impl PartialEq for CustomRelief {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shape, &other.shape)
            && self.uniform_compliance == other.uniform_compliance
    }
}

impl CustomRelief {
    /// Wraps a shape.
    #[must_use]
    pub fn new(shape: impl ReliefShape + 'static) -> Self {
        Self {
            shape: Arc::new(shape),
            uniform_compliance: None,
        }
    }

    /// Returns the same profile with one compliance (m/Pa) everywhere.
    ///
    /// # Errors
    /// [`TextureError`] if the compliance is negative or not finite.
    pub fn with_uniform_compliance(self, compliance: f64) -> Result<Self, TextureError> {
        let uniform_compliance = Some(not_negative(Quantity::Compliance, compliance)?);
        Ok(Self {
            uniform_compliance,
            ..self
        })
    }

    /// The relief without wear, if this is a worn one.
    #[must_use]
    pub fn unworn(&self) -> Option<&Relief> {
        self.shape.unworn()
    }

    /// Returns the surface profile `f*` at the given points, m.
    #[must_use]
    pub fn profile(&self, points: &[[f64; 2]]) -> Vec<f64> {
        self.shape.profile(points)
    }

    /// Returns the compliance η at the given points, m/Pa.
    #[must_use]
    pub fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64> {
        match self.uniform_compliance {
            Some(compliance) => vec![compliance; points.len()],
            None => self.shape.compliance(points),
        }
    }

    /// Whether the shape says that it is symmetric in x and y.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.shape.is_mirrored()
    }

    /// Returns the mean of η about the axis, m/Pa; see [`ReliefShape::mean_compliance`].
    #[must_use]
    pub fn mean_compliance(&self, radius: f64) -> f64 {
        self.uniform_compliance
            .unwrap_or_else(|| self.shape.mean_compliance(radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Grid, Relief};

    /// `f* = −x²`, `η = 1 + y²`.
    #[derive(Debug)]
    struct Valley;

    impl ReliefShape for Valley {
        fn profile(&self, points: &[[f64; 2]]) -> Vec<f64> {
            points.iter().map(|[x, _]| -x * x).collect()
        }

        fn compliance(&self, points: &[[f64; 2]]) -> Vec<f64> {
            points.iter().map(|[_, y]| 1.0 + y * y).collect()
        }
    }

    #[test]
    fn a_shape_is_sampled_at_the_centres_of_the_elements() {
        let relief = Relief::custom(Valley);
        let sampled = relief.sample(&Grid::new(4.0, 2).unwrap());
        assert_eq!(sampled.profile(), [-1.0; 4]);
        assert_eq!(sampled.compliance(), [2.0; 4]);
        let grid = Grid::new(3.0, 3).unwrap();
        assert_eq!(
            relief.sample(&grid).profile(),
            [-1.0, -1.0, -1.0, 0.0, 0.0, 0.0, -1.0, -1.0, -1.0]
        );
        assert_eq!(
            relief.sample_from(&grid, [1, 1]).compliance(),
            [1.0, 2.0, 1.0, 2.0]
        );
    }

    #[test]
    fn the_mean_compliance_is_that_of_the_square() {
        let Relief::Custom(valley) = Relief::custom(Valley) else {
            unreachable!();
        };
        // 1 + R²/3, and the midpoint rule's relative error of 1/16² in the second term.
        let found = valley.mean_compliance(3.0);
        assert!((found - 4.0).abs() <= 3.0 / 256.0 + 1e-12, "{found}");
    }

    #[test]
    fn a_uniform_compliance_replaces_that_of_the_shape() {
        let valley = CustomRelief::new(Valley);
        let uniform = valley.clone().with_uniform_compliance(7.0).unwrap();
        assert_ne!(valley, uniform);
        let points = [[0.0, 1.0], [2.0, 3.0]];
        assert_eq!(uniform.compliance(&points), [7.0, 7.0]);
        assert_eq!(uniform.profile(&points), valley.profile(&points));
        assert_eq!(
            valley.with_uniform_compliance(-1.0),
            Err(TextureError::Negative {
                quantity: Quantity::Compliance,
                found: -1.0
            })
        );
    }

    #[test]
    fn a_shape_equals_only_its_clones() {
        let relief = Relief::custom(Valley);
        assert_eq!(relief, relief.clone());
        assert_ne!(relief, Relief::custom(Valley));
    }
}
