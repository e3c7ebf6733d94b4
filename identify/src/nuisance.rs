//! Nuisances that enter linearly: zero of the observable, frame compliance, drift, baseline; and the zero of the
//! abscissa, which enters linearly near an origin.

use std::ops::Range;

use crate::{Curve, IdentifyError, Prior, curve::check_length};

/// How a linear nuisance enters the observable, for one unit of its coefficient.
#[derive(Debug, Clone, PartialEq)]
pub enum NuisanceShape {
    /// A constant: the shift of a zero, or a baseline.
    Constant,
    /// The abscissa: the compliance of a machine's frame adds `C_f Q` to a penetration.
    Abscissa,
    /// The time: a drift adds `d t`.
    Time,
    /// Minus the slope of the model: a zero of the abscissa. With the abscissa counted from an origin near the zero,
    /// `f(x − z) ≈ f(x − z₀) − (z − z₀) f′(x − z₀)`.
    Slope,
    /// Any other known shape, one value for each point of all curves.
    Given(Vec<f64>),
}

/// The set of points that share one coefficient.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// All points.
    Common,
    /// The points of one curve: there is one coefficient per curve.
    PerCurve,
}

/// A nuisance that adds a coefficient times a known shape to the observable. It costs no prediction: each evaluation of
/// the misfit eliminates it exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearNuisance {
    name: String,
    shape: NuisanceShape,
    scope: Scope,
    /// Mean and standard deviation of the prior of each curve's coefficient; one entry holds for all, none are without.
    priors: Vec<Option<[f64; 2]>>,
}

impl LinearNuisance {
    /// A nuisance of any shape, without a prior.
    #[must_use]
    pub fn new(name: impl Into<String>, shape: NuisanceShape, scope: Scope) -> Self {
        Self {
            name: name.into(),
            shape,
            scope,
            priors: Vec::new(),
        }
    }

    /// A shift of each curve, such as an unknown zero of the penetration.
    #[must_use]
    pub fn shift() -> Self {
        Self::new("shift", NuisanceShape::Constant, Scope::PerCurve)
    }

    /// The zero of each curve's abscissa: its reading where the model's is zero. The model must know
    /// [`ForwardModel::predict_from`](crate::ForwardModel::predict_from).
    #[must_use]
    pub fn abscissa_zero() -> Self {
        Self::new("abscissa_zero", NuisanceShape::Slope, Scope::PerCurve)
    }

    /// The same nuisance under another name.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// The compliance of the frame, common to all curves.
    #[must_use]
    pub fn frame_compliance() -> Self {
        Self::new("frame_compliance", NuisanceShape::Abscissa, Scope::Common)
    }

    /// A drift of each curve, proportional to time.
    #[must_use]
    pub fn drift() -> Self {
        Self::new("drift", NuisanceShape::Time, Scope::PerCurve)
    }

    /// A constant common to all curves.
    #[must_use]
    pub fn baseline() -> Self {
        Self::new("baseline", NuisanceShape::Constant, Scope::Common)
    }

    /// The same nuisance with a normal prior on its coefficients.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::NumberOf`] where the standard deviation is not positive and finite, or the mean is not finite.
    pub fn with_normal_prior(mut self, mean: f64, sd: f64) -> Result<Self, IdentifyError> {
        Prior::Normal { mean, sd }.check(&self.name)?;
        self.priors = vec![Some([mean, sd])];
        Ok(self)
    }

    /// The same nuisance with a normal prior, mean and standard deviation, for the coefficient of each curve.
    ///
    /// # Errors
    ///
    /// As [`Self::with_normal_prior`].
    pub fn with_normal_priors(
        mut self,
        priors: Vec<Option<[f64; 2]>>,
    ) -> Result<Self, IdentifyError> {
        for [mean, sd] in priors.iter().flatten().copied() {
            Prior::Normal { mean, sd }.check(&self.name)?;
        }
        self.priors = priors;
        Ok(self)
    }

    /// Whether all curves have the same coefficient.
    pub(crate) fn is_common(&self) -> bool {
        self.scope == Scope::Common
    }

    /// Mean and standard deviation of the prior of a curve's coefficient, or of all, if it has one.
    pub(crate) fn prior(&self, curve: Option<usize>) -> Option<[f64; 2]> {
        match self.priors[..] {
            [all] => all,
            _ => self.priors.get(curve?).copied().flatten(),
        }
    }

    /// The columns of its coefficients.
    pub(crate) fn columns(&self, curves: &[Curve]) -> Result<Vec<NuisanceColumn>, IdentifyError> {
        let whole = self.whole(curves)?;
        let column = |name, curve, values| NuisanceColumn {
            name,
            curve,
            values,
            by_slope: self.shape == NuisanceShape::Slope,
            is_zero: matches!(self.shape, NuisanceShape::Constant | NuisanceShape::Slope),
            prior: self.prior(curve),
        };
        if self.scope == Scope::Common {
            return Ok(vec![column(self.name.clone(), None, whole)]);
        }
        let mut first = 0;
        Ok((0..curves.len())
            .map(|curve| {
                let end = first + curves[curve].points();
                let mut values = vec![0.0; whole.len()];
                values[first..end].copy_from_slice(&whole[first..end]);
                first = end;
                column(format!("{}[{curve}]", self.name), Some(curve), values)
            })
            .collect())
    }

    /// The shape at the points of all curves.
    fn whole(&self, curves: &[Curve]) -> Result<Vec<f64>, IdentifyError> {
        let points = curves.iter().map(Curve::points).sum();
        match &self.shape {
            NuisanceShape::Constant => Ok(vec![1.0; points]),
            NuisanceShape::Slope => Ok(vec![-1.0; points]),
            NuisanceShape::Abscissa => {
                Ok(curves.iter().flat_map(Curve::abscissa).copied().collect())
            }
            NuisanceShape::Given(values) => {
                check_length("nuisance's shape", values, points)?;
                Ok(values.clone())
            }
            NuisanceShape::Time => {
                let mut times = Vec::with_capacity(points);
                for (index, curve) in curves.iter().enumerate() {
                    let time = curve.time().ok_or(IdentifyError::NoTime { curve: index })?;
                    times.extend_from_slice(time);
                }
                Ok(times)
            }
        }
    }
}

/// The contribution of one unit of a coefficient to each point of all curves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NuisanceColumn {
    pub name: String,
    /// Its curve, if it belongs to only one.
    pub curve: Option<usize>,
    pub values: Vec<f64>,
    /// Whether `values` are to be multiplied by the slopes of the model: the coefficient is a zero of the abscissa.
    pub by_slope: bool,
    /// Whether it is a shift of a zero, on which relative noise does not depend.
    pub is_zero: bool,
    /// Mean and standard deviation of the prior.
    pub prior: Option<[f64; 2]>,
}

impl NuisanceColumn {
    /// The contribution of one unit, for a model with these slopes.
    pub fn with_slopes(&self, slopes: &[f64]) -> Vec<f64> {
        if !self.by_slope {
            return self.values.clone();
        }
        let pairs = self.values.iter().zip(slopes);
        pairs.map(|(value, slope)| value * slope).collect()
    }

    /// The value of which the coefficient is the rest: the origin of the abscissa for its zero, otherwise 0.
    pub fn origin(&self, origins: &[f64]) -> f64 {
        let is_own = |(value, _): &(&f64, &f64)| **value < 0.0;
        let found = self.values.iter().zip(origins).find(is_own);
        let origin = found.filter(|_| self.by_slope).map(|(_, origin)| *origin);
        origin.unwrap_or(0.0)
    }

    /// The column at some of the points.
    pub fn part(&self, points: &Range<usize>) -> Self {
        Self {
            values: self.values[points.clone()].to_vec(),
            ..self.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shift_has_one_column_per_curve_and_a_frame_compliance_one_for_all() {
        let curves = [
            Curve::new(vec![1.0, 2.0], vec![0.0; 2]).unwrap(),
            Curve::new(vec![3.0], vec![0.0]).unwrap(),
        ];
        let shift = LinearNuisance::shift().columns(&curves).unwrap();
        assert_eq!(shift[0].values, [1.0, 1.0, 0.0]);
        assert_eq!(shift[1].values, [0.0, 0.0, 1.0]);
        assert_eq!(shift[1].name, "shift[1]");
        let frame = LinearNuisance::frame_compliance().columns(&curves).unwrap();
        assert_eq!(frame[0].values, [1.0, 2.0, 3.0]);
        assert!(matches!(
            LinearNuisance::drift().columns(&curves),
            Err(IdentifyError::NoTime { curve: 0 })
        ));
    }
}
