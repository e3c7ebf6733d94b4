//! The calibrations of a force microscope that a fit takes as exact: spring constant and sensitivity.
//!
//! A deflection is `d = s V` and a force `F = k d`, with the sensitivity s and the spring constant k. If the true ones
//! are `k (1 + ε)` or `s (1 + ε)`, the curves as read change by `ε ∂y/∂ln k` or `ε ∂y/∂ln s`. With the slope `y′` of a
//! prediction at the abscissae `x`, in which the cantilever's compliance `c = 1/k` is contained,
//!
//! ```text
//! depth at force:     ∂y/∂ln k = x (y′ − c)           ∂y/∂ln s = x y′
//! force at approach:  ∂y/∂ln k = −y (1 − c y′)        ∂y/∂ln s = −y
//! ```
//!
//! since the depth `z − d` knows s but not k.

use super::{ContactCurves, Observable};
use crate::{Prediction, problem::spans};

/// A number by which an instrument reads forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Calibration {
    /// The spring constant of a cantilever.
    SpringConstant,
    /// What a volt of its deflection is in metres.
    Sensitivity,
}

impl ContactCurves {
    /// The derivatives `∂y/∂ln f` of all points by a calibration `f` of a curve, from the prediction at a fit; zero for
    /// the points of other curves. None for a curve that is not one of forces and depths.
    #[must_use]
    pub fn by_calibration(
        &self,
        curve: usize,
        calibration: Calibration,
        at_fit: &Prediction,
    ) -> Option<Vec<f64>> {
        let of = &self.curves[curve];
        let points = self.curves.iter().map(|one| one.abscissae.len());
        let span = spans(points)[curve].clone();
        let abscissae = of.abscissae_from(at_fit.origins.get(span.clone()).unwrap_or_default());
        let series = match calibration {
            Calibration::SpringConstant => of.series,
            Calibration::Sensitivity => 0.0,
        };
        let change = |(point, x): (usize, &f64)| {
            let (value, slope) = (at_fit.value[point], at_fit.slope[point]);
            match of.observable {
                Observable::DepthAtForce => Some(x * (slope - series)),
                Observable::ForceAtDepth => Some(-value * (1.0 - series * slope)),
                _ => None,
            }
        };
        let own: Option<Vec<f64>> = span.clone().zip(&abscissae).map(change).collect();
        let mut all = vec![0.0; at_fit.value.len()];
        all[span].copy_from_slice(&own?);
        Some(all)
    }
}
