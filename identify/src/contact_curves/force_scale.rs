//! Forces that were read by an instrument whose constant is not known exactly.
//!
//! A cantilever or a spring of constant k measures a force by its deflection, `F = k d`. Read with a nominal k₀, it
//! gives `F₀ = k₀ d`, so the true force is `F = κ F₀` with `κ = k/k₀`. The reading then follows from the penetration
//! `D(F)` under the true force, and its inverse `Q(D)`:
//!
//! ```text
//! depth at force:    y = D(κ F₀)       ∂y/∂F₀ = κ D′(κ F₀)       ∂y/∂k = (F₀/k₀) D′(κ F₀)
//! force at depth:    y = Q(D)/κ        ∂y/∂D  = Q′(D)/κ          ∂y/∂k = −y/k
//! ```
//!
//! A stiffness is a force over a depth: at a depth it follows the second line, at a force both.
//!
//! A cantilever is also a compliance `c = 1/k₀` in series, as its deflection does not depend on the constant.
//! Penetrations have the slope `κ D′ + c`, and forces are read at approaches,
//!
//! ```text
//! force at approach: D(κ y) + c y = z   ∂y/∂z = 1/(κ D′ + c)   ∂y/∂k = −(y/k₀) D′/(κ D′ + c)
//! ```

use super::curve::{Observable, Reading};
use crate::Prediction;

/// A constant to which the forces of a curve are proportional: one more parameter to be found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceScale {
    /// Its index among such constants; as parameters they come after those of the model.
    pub constant: usize,
    /// The value assumed when the forces were read.
    pub nominal: f64,
}

impl ForceScale {
    /// `κ` among these constants.
    pub(super) fn factor(self, constants: &[f64]) -> f64 {
        let constant = constants.get(self.constant);
        constant.map_or(1.0, |constant| constant / self.nominal)
    }

    /// Converts a prediction from true forces to forces as read. Returns `∂y/∂k`.
    pub(super) fn apply(
        self,
        observable: Observable,
        (factor, series): (f64, f64),
        abscissae: &[f64],
        prediction: &mut Prediction,
    ) -> Vec<f64> {
        let constant = factor * self.nominal;
        let mut change = vec![0.0; prediction.value.len()];
        if observable.abscissa() == Reading::Force {
            let pairs = prediction.slope.iter_mut().zip(abscissae);
            for ((slope, read), change) in pairs.zip(&mut change) {
                // What is left of the slope without c/κ is D′.
                let own = *slope - series / factor;
                *slope = factor * own + series;
                *change = own * read / self.nominal;
            }
        }
        if observable.observed() == Reading::Depth {
            return change;
        }
        let lists = [&mut prediction.value, &mut prediction.slope, &mut change];
        let lists = lists.into_iter().chain(&mut prediction.derivatives);
        lists.flatten().for_each(|value| *value /= factor);
        let pairs = prediction.value.iter().zip(&prediction.slope);
        // D′/(κ D′ + c) = (1 − c ∂y/∂z)/κ
        let by_reading = pairs.map(|(y, slope)| -y * (1.0 - series * slope) / constant);
        by_reading
            .zip(change)
            .map(|(one, other)| one + other)
            .collect()
    }
}

impl Observable {
    /// The true abscissae, where the forces that were read are too small by `factor`.
    pub(super) fn true_abscissae(self, read: &[f64], factor: f64) -> Vec<f64> {
        let factor = if self.abscissa() == Reading::Force {
            factor
        } else {
            1.0
        };
        read.iter().map(|read| factor * read).collect()
    }
}

impl Prediction {
    /// Adds derivatives with respect to `count` constants on which the points do not depend.
    pub(super) fn extend_by_constants(&mut self, count: usize) {
        let none = vec![0.0; self.value.len()];
        let derivatives = &mut self.derivatives;
        derivatives.resize(derivatives.len() + count, none);
    }
}
