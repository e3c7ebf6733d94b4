//! A contact at the largest force of its unloading: depth, area, moduli, hardnesses.

use std::f64::consts::PI;

use statrs::function::gamma::ln_gamma;

use super::inputs::Inputs;
use super::numbers::Values;
use super::settings::{Epsilon, EvaluationSettings};
use super::{IndentationError, IndentationNumber};

/// A contact at the largest force of its unloading.
pub(super) struct Contact {
    pub(super) depth: f64,
    pub(super) force: f64,
    pub(super) stiffness: f64,
    /// The exponent of the unloading, if known.
    pub(super) exponent: Option<f64>,
    /// The area that the instrument gives, m², in place of the area function's.
    pub(super) area: Option<f64>,
}

impl Contact {
    pub(super) fn numbers(
        &self,
        settings: &EvaluationSettings,
        inputs: &Inputs,
    ) -> Result<Values, IndentationError> {
        let epsilon = match (settings.epsilon, self.exponent) {
            (Epsilon::Exponent, Some(exponent)) => epsilon_of(exponent),
            (Epsilon::Exponent, None) => return Err(IndentationError::NoExponent),
            (Epsilon::Fixed(_), _) => inputs.epsilon,
        };
        // h_c = h_max − ε P_max/S
        let contact = self.depth - epsilon * self.force / self.stiffness;
        let area = match (self.area, &settings.area) {
            (Some(area), _) => area,
            (None, Some(function)) => {
                function.positive_area(contact)? + inputs.area * settings.area_sd(contact)
            }
            (None, None) => return Err(IndentationError::NoArea),
        };
        // E_r = √π S/(2 β √A)
        let reduced = PI.sqrt() * self.stiffness / (2.0 * inputs.beta * area.sqrt());
        let [indenter, ratio] = inputs.indenter;
        let alone = indenter / (1.0 - ratio * ratio);
        if reduced >= alone {
            return Err(IndentationError::StifferThanIndenter {
                reduced,
                indenter: alone,
            });
        }
        let square = inputs.poisson_ratio.powi(2);
        let modulus = (1.0 - square) / (1.0 / reduced - 1.0 / alone);
        let surface = settings.area.as_ref().map(|of| of.surface(self.depth));
        let of = |number| match number {
            IndentationNumber::MaxDepth => Some(self.depth),
            IndentationNumber::MaxForce => Some(self.force),
            IndentationNumber::ContactStiffness => Some(self.stiffness),
            IndentationNumber::Exponent => self.exponent,
            IndentationNumber::ContactDepth => Some(contact),
            IndentationNumber::Area => Some(area),
            IndentationNumber::ReducedModulus => Some(reduced),
            IndentationNumber::IndentationModulus => Some(modulus),
            IndentationNumber::IndentationHardness => Some(self.force / area),
            IndentationNumber::MartensHardness => surface.map(|surface| self.force / surface),
            IndentationNumber::FinalDepth
            | IndentationNumber::Creep
            | IndentationNumber::ElasticWorkRatio
            | IndentationNumber::DriftRate => None,
        };
        Ok(IndentationNumber::ALL.map(of))
    }
}

/// `ε(m)`: 0.75 of a paraboloid (m = 3/2), 0.727 of a cone (m = 2). G. M. Pharr and A. Bolshakov, J. Mater. Res. 17,
/// 2660 (2002).
fn epsilon_of(exponent: f64) -> f64 {
    let rise = exponent - 1.0;
    let [above, below] = [exponent / (2.0 * rise), 1.0 / (2.0 * rise)];
    let ratio = (ln_gamma(above) - ln_gamma(below)).exp();
    exponent * (1.0 - 2.0 * rise / PI.sqrt() * ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn epsilon_of_a_paraboloid_and_of_a_cone_are_the_known_ones() {
        assert!((epsilon_of(1.5) - 0.75).abs() < 1e-12);
        assert!((epsilon_of(2.0) - 2.0 * (1.0 - 2.0 / PI)).abs() < 1e-12);
        // That of a flat punch is 1.
        assert!((epsilon_of(1.0001) - 1.0).abs() < 2e-2);
    }
}
