//! The numbers that an evaluation takes from elsewhere than the curve, and their uncertainties.

use super::evaluation::IndentationCurve;
use super::numbers::Source;
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

    /// The independent sources with their standard uncertainties. Those of the settings are common to all curves.
    pub(super) fn sources(
        settings: &EvaluationSettings,
        [rate, zero]: [Uncertain; 2],
    ) -> Vec<(Source, Uncertain, Field)> {
        let area = Uncertain {
            value: 0.0,
            sd: f64::from(u8::from(!settings.area_covariance.is_empty())),
        };
        let (own, common) = (Source::Own, Source::Common);
        let frame = settings.frame_compliance;
        let mut sources: Vec<(Source, Uncertain, Field)> = vec![
            (own, rate, |of| &mut of.rate),
            (own, zero, |of| &mut of.zero),
            (common("frame_compliance"), frame, |of| {
                &mut of.frame_compliance
            }),
            (common("area_function"), area, |of| &mut of.area),
            (common("beta"), settings.beta, |of| &mut of.beta),
        ];
        let ratio = settings.poisson_ratio;
        sources.push((common("poisson_ratio"), ratio, |of| &mut of.poisson_ratio));
        if let Epsilon::Fixed(epsilon) = settings.epsilon {
            sources.push((common("epsilon"), epsilon, |of| &mut of.epsilon));
        }
        if let Some(indenter) = settings.indenter {
            let [modulus, ratio] = [indenter.young_modulus, indenter.poisson_ratio];
            sources.push((common("indenter.young_modulus"), modulus, |of| {
                &mut of.indenter[0]
            }));
            sources.push((common("indenter.poisson_ratio"), ratio, |of| {
                &mut of.indenter[1]
            }));
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
        let pairs = of(self).into_iter().zip(of(other));
        pairs
            .into_iter()
            .any(|(one, other)| (one - other).abs() > 0.0)
    }

    /// `h − h₀ − ḣ (t − t₀) − C_f P`, with the time of the first contact.
    pub(super) fn corrected(&self, curve: IndentationCurve<'_>) -> Vec<f64> {
        let first = curve.first_contact.unwrap_or(0);
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
