//! A forward model built from predictions of another: free to evaluate, with a stated error.
//!
//! Curves over a box of the coordinates `x` of the unknowns (`ln θ`) are combinations of a few basis curves. Their
//! amplitudes are polynomials of bounded total degree in `x`, fitted to the model at points distributed like Chebyshev
//! nodes. Twice as many points as coefficients keep the fit stable (G. Migliorati, F. Nobile, E. von Schwerin and R.
//! Tempone, Found. Comput. Math. 14, 419 (2014)). The degree is raised, then the box is shrunk, until the surrogate
//! matches the model at points not used in the fit.

mod chebyshev;
mod reduced_curves;
mod region;
mod sample_points;

use rayon::prelude::*;

use chebyshev::Products;
use reduced_curves::ReducedCurves;
use region::Region;
use sample_points::SamplePoints;

use crate::{
    Fit, ForwardError, ForwardModel, IdentifyError, Prediction, Problem, Unknown,
    orthonormal_basis::{OrthonormalBasis, dot},
};

/// Total degrees tried, in order.
const DEGREES: [usize; 6] = [3, 5, 7, 9, 11, 13];

/// Sides of the box tried, in order, as fractions of those wanted.
const SIDES: [f64; 3] = [1.0, 0.75, 0.5];

/// Predictions per coefficient.
const OVERSAMPLING: usize = 2;

/// Check points per dimension.
const CHECKS: usize = 12;

/// Largest error of a curve as a combination of basis curves, as a fraction of the tolerance.
const COMPRESSION: f64 = 1e-2;

/// Options for building a surrogate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurrogateOptions {
    /// Largest relative error of the observable at the check points, 10⁻⁴ by default.
    pub tolerance: f64,
    /// Maximum number of predictions of the model, 1500 by default.
    pub most_predictions: usize,
    /// Seed of the sample points.
    pub seed: u64,
}

impl Default for SurrogateOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-4,
            most_predictions: 1500,
            seed: 1,
        }
    }
}

/// Polynomials of one to four unknowns that replace a model.
#[derive(Debug, Clone)]
pub struct Surrogate {
    region: Region,
    products: Products,
    curves: ReducedCurves,
    /// For each vector of the basis, the coefficient of each product.
    coefficients: Vec<Vec<f64>>,
    error: f64,
    predictions: usize,
}

impl Surrogate {
    /// Builds a surrogate over a box, given the smallest and largest value of each unknown.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Surrogate`] if it is not accurate enough, [`IdentifyError::Length`] if the numbers of sides and
    /// unknowns differ or exceed four, [`IdentifyError::NumberOf`] for a side of zero length.
    pub fn over(
        model: &dyn ForwardModel,
        unknowns: &[Unknown],
        sides: &[[f64; 2]],
        options: SurrogateOptions,
    ) -> Result<Self, IdentifyError> {
        Self::built(model, &Region::new(unknowns, sides)?, options)
    }

    /// Builds a surrogate around the best fit of a problem. The box reaches two and a half times as far as the wider of
    /// the profile and covariance intervals (five standard errors at level 95 %), or to the bounds where these are
    /// open.
    ///
    /// # Errors
    ///
    /// See [`Self::over`].
    pub fn around(
        model: &dyn ForwardModel,
        problem: &Problem,
        fit: &Fit,
        options: SurrogateOptions,
    ) -> Result<Self, IdentifyError> {
        Self::built(model, &Region::around(problem.unknowns(), fit)?, options)
    }

    /// Largest relative error of the observable at the check points.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Number of predictions of the model used.
    #[must_use]
    pub fn predictions(&self) -> usize {
        self.predictions
    }

    /// Smallest and largest value of each unknown.
    #[must_use]
    pub fn sides(&self) -> Vec<[f64; 2]> {
        self.region.sides()
    }

    /// Total degree of its polynomials.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.products.degree()
    }

    pub(crate) fn region(&self) -> &Region {
        &self.region
    }

    fn built(
        model: &dyn ForwardModel,
        wanted: &Region,
        options: SurrogateOptions,
    ) -> Result<Self, IdentifyError> {
        let mut reached = f64::INFINITY;
        let mut predictions = 0;
        for side in SIDES {
            let mut building = Building {
                model,
                region: wanted.shrunk(side),
                options,
                samples: Vec::new(),
            };
            let (least, found) = building.raise_degree(predictions)?;
            reached = reached.min(least);
            predictions = building.predictions(predictions);
            if let Some(found) = found {
                return Ok(Self {
                    predictions,
                    ..found
                });
            }
        }
        Err(IdentifyError::Surrogate {
            reached,
            wanted: options.tolerance,
            predictions,
        })
    }

    /// Values and slopes at a point of the cube, in the scale of interpolation.
    fn curve(&self, at: &[f64]) -> Vec<f64> {
        self.curves
            .expand(&self.amplitudes(&self.products.values(at)))
    }

    fn amplitudes(&self, products: &[f64]) -> Vec<f64> {
        let amplitude = |coefficients: &Vec<f64>| dot(coefficients, products);
        self.coefficients.iter().map(amplitude).collect()
    }

    /// The values of all points, without slopes, at coordinates inside the box.
    pub(crate) fn values(&self, position: &[f64]) -> Vec<f64> {
        let mut curve = self.curve(&self.region.cube(position));
        curve.truncate(self.curves.points);
        for v in &mut curve {
            *v = self.curves.scales[0].undo(*v).0;
        }
        curve
    }

    /// Largest relative error of the observable with respect to predictions of the model.
    fn misses(&self, checks: &[Sample]) -> f64 {
        let scale = self.curves.scales[0];
        let of_point = |(found, value): (&f64, &f64)| {
            let error = (scale.undo(*found).0 - value) / scale.reference(*value);
            error.abs()
        };
        let of_curve = |(at, prediction): &Sample| {
            let curve = self.curve(at);
            let errors = curve.iter().zip(&prediction.value).map(of_point);
            errors.fold(0.0, f64::max)
        };
        checks.iter().map(of_curve).fold(0.0, f64::max)
    }
}

impl ForwardModel for Surrogate {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        let outside = |source: IdentifyError| ForwardError::OutOfRange {
            source: Box::new(source),
        };
        let at = self.region.inside(parameters).map_err(outside)?;
        let curve = self.curve(&at);
        let (values, slopes) = curve.split_at(self.curves.points);
        let [of_value, of_slope] = self.curves.scales;
        let derivatives = (0..at.len()).map(|axis| {
            let change = self.amplitudes(&self.products.derivatives(&at, axis));
            let change = self.curves.change_of_values(&change);
            let by_value = self.region.slope(axis, parameters[axis]);
            let pairs = change.iter().zip(values);
            pairs
                .map(|(change, &value)| change * of_value.undo(value).1 * by_value)
                .collect()
        });
        Ok(Prediction {
            derivatives: derivatives.collect(),
            value: values.iter().map(|&v| of_value.undo(v).0).collect(),
            slope: slopes.iter().map(|&v| of_slope.undo(v).0).collect(),
        })
    }
}

/// A point of the cube, and the prediction there.
type Sample = (Vec<f64>, Prediction);

/// A surrogate under construction: its box, and the predictions there so far.
struct Building<'m> {
    model: &'m dyn ForwardModel,
    region: Region,
    options: SurrogateOptions,
    samples: Vec<Sample>,
}

impl Building<'_> {
    /// Raises the degree until the error is within tolerance. Returns the smallest error, and the surrogate if one
    /// succeeded.
    fn raise_degree(&mut self, before: usize) -> Result<(f64, Option<Surrogate>), IdentifyError> {
        let dimensions = self.region.dimensions();
        let points = SamplePoints::new(dimensions, self.options.seed);
        let others = SamplePoints::new(dimensions, self.options.seed.wrapping_add(1));
        let checks = (0..self.checks()).map(|i| others.even(i)).collect();
        let mut least = f64::INFINITY;
        let Some(checks) = self.predicted(checks)? else {
            return Ok((least, None));
        };
        for degree in DEGREES {
            let products = Products::new(dimensions, degree);
            let wanted = OVERSAMPLING * products.count();
            if before + self.checks() + wanted > self.options.most_predictions {
                break;
            }
            let next = (self.samples.len()..wanted).map(|i| points.chebyshev(i));
            let Some(more) = self.predicted(next.collect())? else {
                break;
            };
            self.samples.extend(more);
            let surrogate = self.fitted(products);
            let error = surrogate.misses(&checks);
            least = least.min(error);
            if error <= self.options.tolerance {
                return Ok((least, Some(Surrogate { error, ..surrogate })));
            }
        }
        Ok((least, None))
    }

    fn checks(&self) -> usize {
        CHECKS * self.region.dimensions()
    }

    fn predictions(&self, before: usize) -> usize {
        before + self.samples.len() + self.checks()
    }

    /// Evaluates the model at points of the cube; `None` if it has no prediction at one of them.
    fn predicted(&self, places: Vec<Vec<f64>>) -> Result<Option<Vec<Sample>>, IdentifyError> {
        let predict = |at: Vec<f64>| {
            let prediction = self.model.predict(&self.region.parameters(&at))?;
            Ok((at, prediction))
        };
        let results: Vec<Result<_, ForwardError>> = places.into_par_iter().map(predict).collect();
        let stopped = results
            .iter()
            .any(|one| matches!(one, Err(ForwardError::Stopped)));
        if stopped {
            let predictions = self.predictions(0);
            return Err(IdentifyError::Stopped { predictions });
        }
        let found: Result<Vec<_>, ForwardError> = results.into_iter().collect();
        Ok(found
            .ok()
            .filter(|all| all.iter().all(|one| self.is_complete(&one.1))))
    }

    fn is_complete(&self, prediction: &Prediction) -> bool {
        prediction.is_complete(prediction.value.len(), self.region.dimensions())
    }

    /// Fits the amplitudes at the points so far by least squares.
    fn fitted(&self, products: Products) -> Surrogate {
        let predictions: Vec<Prediction> = self.samples.iter().map(|one| one.1.clone()).collect();
        let tolerance = COMPRESSION * self.options.tolerance;
        let (curves, amplitudes) = ReducedCurves::of(&predictions, tolerance);
        let rows: Vec<Vec<f64>> = self
            .samples
            .iter()
            .map(|one| products.values(&one.0))
            .collect();
        let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let matrix = OrthonormalBasis::of((0..products.count()).map(column));
        let solve = |mut amplitude: Vec<f64>| {
            let components = matrix.remove_from(&mut amplitude);
            matrix.coefficients(&components)
        };
        Surrogate {
            region: self.region.clone(),
            coefficients: amplitudes.into_iter().map(solve).collect(),
            products,
            curves,
            error: f64::INFINITY,
            predictions: 0,
        }
    }
}
