//! The numbers that an evaluation takes from elsewhere than the curve, and their uncertainties.

use super::evaluation::IndentationCurve;
use super::settings::{Epsilon, EvaluationSettings};
use super::uncertain::Uncertain;

/// The numbers that an evaluation takes from elsewhere than the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inputs {
    pub(super) rate: f64,
    pub(super) zero: f64,
    pub(super) frame_compliance: f64,
    /// In standard uncertainties of the area at the contact depth.
    pub(super) area: f64,
    pub(super) beta: f64,
    pub(super) epsilon: f64,
    pub(super) poisson_ratio: f64,
    /// `E_i` and `ν_i`; an infinite modulus for a rigid indenter.
    pub(super) indenter: [f64; 2],
}

pub(super) type Field = fn(&mut Inputs) -> &mut f64;

impl Inputs {
    pub(super) fn of(settings: &EvaluationSettings) -> Self {
        Self {
            rate: 0.0,
            zero: 0.0,
            frame_compliance: settings.frame_compliance.value,
            area: 0.0,
            beta: settings.beta.value,
            epsilon: match settings.epsilon {
                Epsilon::Fixed(epsilon) => epsilon.value,
                Epsilon::Exponent => f64::NAN,
            },
            poisson_ratio: settings.poisson_ratio.value,
            indenter: settings.indenter.map_or([f64::INFINITY, 0.0], |of| {
                [of.young_modulus.value, of.poisson_ratio.value]
            }),
        }
    }

    /// The independent sources with their standard uncertainties.
    pub(super) fn sources(
        self,
        settings: &EvaluationSettings,
        [rate, zero]: [Uncertain; 2],
    ) -> Vec<(Uncertain, Field)> {
        let one = Uncertain {
            value: 0.0,
            sd: f64::from(u8::from(!settings.area_covariance.is_empty())),
        };
        let mut sources: Vec<(Uncertain, Field)> = vec![
            (rate, |of| &mut of.rate),
            (zero, |of| &mut of.zero),
            (settings.frame_compliance, |of| &mut of.frame_compliance),
            (one, |of| &mut of.area),
            (settings.beta, |of| &mut of.beta),
            (settings.poisson_ratio, |of| &mut of.poisson_ratio),
        ];
        if let Epsilon::Fixed(epsilon) = settings.epsilon {
            sources.push((epsilon, |of| &mut of.epsilon));
        }
        if let Some(indenter) = settings.indenter {
            sources.push((indenter.young_modulus, |of| &mut of.indenter[0]));
            sources.push((indenter.poisson_ratio, |of| &mut of.indenter[1]));
        }
        sources
    }

    pub(super) fn moved(mut self, field: Field, by: f64) -> Self {
        *field(&mut self) += by;
        self
    }

    /// Whether these inputs give other depths.
    pub(super) fn changes_data(&self, other: &Self) -> bool {
        let of = |inputs: &Self| [inputs.rate, inputs.zero, inputs.frame_compliance];
        of(self) != of(other)
    }

    /// `h − h₀ − ḣ (t − t₀) − C_f P`, with the time of the first contact.
    pub(super) fn corrected(&self, curve: IndentationCurve<'_>) -> Vec<f64> {
        let (_, first) = curve.contact.unwrap_or_default();
        let times = curve.time.unwrap_or_default();
        let start = times.get(first).copied().unwrap_or(0.0);
        let pairs = curve.depth.iter().zip(curve.force).enumerate();
        let corrected = pairs.map(|(at, (depth, force))| {
            let drift = times.get(at).map_or(0.0, |time| self.rate * (time - start));
            depth - self.zero - drift - self.frame_compliance * force
        });
        corrected.collect()
    }
}
