//! Flat punches on the layered body, without a grid: indenters, and the contacts of unloadings, whose stiffness is that
//! of a punch of their radius.

use pellicle_contact::axisymmetric::{AxisymmetricElasticity, punch_stiffness};
use pellicle_contact::{ContactError, Model, ModelParameter};
use pellicle_influence::ElasticBodies;

use super::axisymmetric::AxisymmetricModel;
use super::curve::{ContactCurve, Observable, Thinned};
use crate::Prediction;

/// Relative step of a parameter for differentiating a stiffness, which is exact to 1e-12: an error of 1e-8.
const STEP: f64 = 1e-4;
/// Limit on the steps to a parameter, of which ten or so suffice, and its relative accuracy.
const MOST_STEPS: usize = 100;
const ACCURACY: f64 = 1e-14;

impl ContactCurve {
    /// Stiffnesses at the radii of the curve, differentiated by central differences.
    pub(super) fn punch_stiffnesses(
        &self,
        model: &Model,
        sought: &[ModelParameter],
    ) -> Result<Prediction, ContactError> {
        let bodies = model.tables.bodies();
        let at = self.punches(bodies)?;
        let mut prediction = Prediction {
            value: at.iter().map(|[stiffness, _]| *stiffness).collect(),
            slope: at.iter().map(|[_, slope]| *slope).collect(),
            ..Prediction::default()
        };
        for parameter in sought {
            let value = model.parameter(*parameter).unwrap_or(f64::NAN);
            let moved = |factor: f64| {
                let moved = value * factor;
                Ok((moved, self.punches(&with(bodies, *parameter, moved)?)?))
            };
            let (less, below) = moved(1.0 - STEP)?;
            // A ratio of one half has no neighbour above.
            let (more, above) = moved(1.0 + STEP).or_else(|_: ContactError| moved(1.0))?;
            let pairs = above.iter().zip(&below);
            let slopes = pairs.map(|([above, _], [below, _])| (above - below) / (more - less));
            prediction.derivatives.push(slopes.collect());
        }
        Ok(prediction)
    }

    /// The curve of one of its points alone.
    #[must_use]
    pub fn at(&self, point: usize) -> Self {
        Self {
            abscissae: vec![self.abscissae[point]],
            thinned: self.thinned.as_ref().map(|thinned| Thinned {
                off: vec![thinned.off[point]],
                ..thinned.clone()
            }),
            ..self.clone()
        }
    }

    /// The value of a parameter in a range for which the stiffness at the first point is the one given (N/m), to 1e-13,
    /// with `d ln S/d ln θ` there and `d ln S/d ln a`; none if no value in the range gives it.
    ///
    /// # Errors
    ///
    /// [`ContactError`] where the stiffness cannot be computed.
    pub fn parameter_at(
        &self,
        parameter: ModelParameter,
        [low, high]: [f64; 2],
        stiffness: f64,
    ) -> Result<Option<ParameterAtPoint>, ContactError> {
        // ln S of ln θ
        let at = |x: f64| -> Result<[f64; 2], ContactError> {
            let bodies = with(self.model.tables.bodies(), parameter, x.exp())?;
            Ok(self.punches(&bodies)?[0])
        };
        let miss = |x: f64| Ok::<f64, ContactError>((at(x)?[0] / stiffness).ln());
        let Some(x) = try_root(miss, [low.ln(), high.ln()])? else {
            return Ok(None);
        };
        let [above, below] = [at(x + STEP)?[0], at(x - STEP)?[0]];
        let [found, slope] = at(x)?;
        Ok(Some(ParameterAtPoint {
            value: x.exp(),
            by_parameter: (above / below).ln() / (2.0 * STEP),
            by_radius: slope * self.abscissae[0] / found,
        }))
    }

    /// Stiffness (N/m) and its derivative by the radius at each radius.
    fn punches(&self, bodies: &ElasticBodies) -> Result<Vec<[f64; 2]>, ContactError> {
        let whole = AxisymmetricElasticity::new(bodies);
        let punch = |body: &AxisymmetricElasticity, radius: f64| {
            let punch = body.punch(radius)?;
            Ok([punch.stiffness, punch.stiffness_slope])
        };
        let at = |(point, radius): (usize, &f64)| {
            let Some(Thinned { thickness, off }) = &self.thinned else {
                return punch(&whole, *radius);
            };
            let left = value(bodies, *thickness).unwrap_or(f64::NAN) - off[point];
            let thinned = with(bodies, *thickness, left)?;
            punch(&AxisymmetricElasticity::new(&thinned), *radius)
        };
        self.abscissae.iter().enumerate().map(at).collect()
    }
}

impl AxisymmetricModel {
    /// The stiffness of a flat punch, N/m.
    fn punch_stiffness(&self) -> Result<f64, ContactError> {
        let radius = self.punch_radius().ok_or(ContactError::NotAxisymmetric)?;
        Ok(punch_stiffness(self.bodies(), radius)?[0])
    }

    /// The readings under a flat punch, in proportion to its stiffness S, and their derivatives by the numbers sought:
    ///
    /// ```text
    /// D = F/S      F = z/(1/S + c) at the approach z of the end of a compliance c in series
    /// ```
    pub(super) fn under_punch(
        &self,
        observable: Observable,
        (abscissae, series): (&[f64], f64),
        sought: &[ModelParameter],
    ) -> Result<Prediction, ContactError> {
        let stiffness = self.punch_stiffness()?;
        // ∂S/∂θ
        let by = |parameter: &ModelParameter| {
            let value = self.value(*parameter).unwrap_or(f64::NAN);
            let moved = |factor: f64| {
                let moved = self.clone().with(*parameter, factor * value)?;
                Ok((factor * value, moved.punch_stiffness()?))
            };
            let (less, below) = moved(1.0 - STEP)?;
            let (more, above) = moved(1.0 + STEP).or_else(|_: ContactError| moved(1.0))?;
            Ok((above - below) / (more - less))
        };
        let by: Vec<f64> = sought.iter().map(by).collect::<Result<_, ContactError>>()?;
        // The reading, its slope, and its derivative by S.
        let at = |x: &f64| match observable {
            Observable::DepthAtForce => {
                let force = x.max(0.0);
                let slope = 1.0 / stiffness + series;
                (force / stiffness, slope, -force / stiffness.powi(2))
            }
            _ if *x <= 0.0 => (0.0, 0.0, 0.0),
            Observable::ForceAtDepth => {
                let rate = 1.0 / (1.0 / stiffness + series);
                (rate * x, rate, x * (rate / stiffness).powi(2))
            }
            _ => (stiffness, 0.0, 1.0),
        };
        let points: Vec<_> = abscissae.iter().map(at).collect();
        let column = |by: f64| points.iter().map(|(.., change)| by * change).collect();
        Ok(Prediction {
            value: points.iter().map(|(value, ..)| *value).collect(),
            slope: points.iter().map(|(_, slope, _)| *slope).collect(),
            derivatives: by.into_iter().map(column).collect(),
            origins: Vec::new(),
        })
    }
}

/// The value of a parameter of the bodies.
fn value(bodies: &ElasticBodies, parameter: ModelParameter) -> Option<f64> {
    match parameter {
        ModelParameter::Elastic(of) => bodies.parameter(of),
        _ => None,
    }
}

/// The bodies with another value of a parameter; those of the indenter's shape do not change them.
fn with(
    bodies: &ElasticBodies,
    parameter: ModelParameter,
    value: f64,
) -> Result<ElasticBodies, ContactError> {
    match parameter {
        ModelParameter::Elastic(of) => Ok(bodies.with_parameter(of, value)?),
        _ => Ok(bodies.clone()),
    }
}

/// A parameter found from the stiffness at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterAtPoint {
    /// Its value.
    pub value: f64,
    /// `d ln S/d ln θ`.
    pub by_parameter: f64,
    /// `d ln S/d ln a`.
    pub by_radius: f64,
}

/// The root of a function that changes its sign between two ends, as [`try_root`].
pub(super) fn root(of: impl Fn(f64) -> f64, ends: [f64; 2]) -> Option<f64> {
    try_root(|x| Ok(of(x)), ends).ok().flatten()
}

/// The root of a function that changes its sign between two ends, by false positions with halved ends (the Illinois
/// method: M. Dowell and P. Jarratt, BIT 11, 168 (1971)); none if it does not.
fn try_root(
    of: impl Fn(f64) -> Result<f64, ContactError>,
    [mut a, mut b]: [f64; 2],
) -> Result<Option<f64>, ContactError> {
    let (mut at_a, mut at_b) = (of(a)?, of(b)?);
    if at_a * at_b > 0.0 || !(at_a.is_finite() && at_b.is_finite()) {
        return Ok(None);
    }
    for _ in 0..MOST_STEPS {
        let x = (a * at_b - b * at_a) / (at_b - at_a);
        let at = of(x)?;
        if at == 0.0 || (b - a).abs() <= ACCURACY || at.abs() <= ACCURACY {
            return Ok(Some(x));
        }
        if at * at_b < 0.0 {
            (a, at_a) = (b, at_b);
        } else {
            at_a *= 0.5;
        }
        (b, at_b) = (x, at);
    }
    Ok(Some(b))
}
