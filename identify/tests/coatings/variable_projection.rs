//! The same coating fitted by variable projection in another program.
//!
//! The crate `varpro` fits sums of curves with free coefficients (D. P. O'Leary and B. W. Rust, Comput. Optim. Appl.
//! 54, 579 (2013)), by the Levenberg–Marquardt method of MINPACK in its own coordinates. A depth with an unknown gain
//! and zero is such a sum: `y = g D(Q; E1, H) + y0`.

use approx::assert_relative_eq;
use nalgebra_of_varpro::{DMatrix, DVector};
use pellicle_identify::{
    ContactCurves, Curve, FitOptions, ForwardError, ForwardModel, Intervals, LinearNuisance, Noise,
    Prediction, Problem, Unknown, identify,
};
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};
use varpro::{
    model::SeparableNonlinearModel, problem::SeparableProblemBuilder,
    solvers::levmar::LevMarSolver, statistics::FitStatistics,
};

use super::coating::{Coating, THICKNESS, coating, young_modulus};

/// Depths are in nanometres for `varpro`, moduli in gigapascals, thicknesses in micrometres.
const NANO: f64 = 1e-9;
const UNITS: [f64; 2] = [1e9, 1e-6];

/// `g D`, with the gain as the last parameter.
struct Gained(ContactCurves);

impl ForwardModel for Gained {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        let gain = parameters[2];
        let mut prediction = self.0.predict(&parameters[..2])?;
        let depth = prediction.value.clone();
        let columns = prediction.derivatives.iter_mut();
        for column in columns.chain([&mut prediction.value, &mut prediction.slope]) {
            column.iter_mut().for_each(|v| *v *= gain);
        }
        prediction.derivatives.push(depth);
        Ok(prediction)
    }
}

/// `D` and 1 for `varpro`.
#[derive(Debug)]
struct Separable {
    curves: ContactCurves,
    parameters: DVector<f64>,
    prediction: Prediction,
}

impl Separable {
    fn new(curves: ContactCurves, parameters: [f64; 2]) -> Self {
        let mut model = Self {
            prediction: curves.predict(&in_si(&parameters)).unwrap(),
            curves,
            parameters: DVector::from_row_slice(&parameters),
        };
        model.set_params(model.parameters.clone()).unwrap();
        model
    }

    fn columns(first: &[f64], second: f64) -> DMatrix<f64> {
        let points = first.len();
        DMatrix::from_fn(
            points,
            2,
            |i, k| if k == 0 { first[i] / NANO } else { second },
        )
    }
}

fn in_si(parameters: &[f64]) -> Vec<f64> {
    parameters
        .iter()
        .zip(UNITS)
        .map(|(p, unit)| p * unit)
        .collect()
}

impl SeparableNonlinearModel for Separable {
    type ScalarType = f64;
    type Error = ForwardError;

    fn parameter_count(&self) -> usize {
        2
    }

    fn base_function_count(&self) -> usize {
        2
    }

    fn output_len(&self) -> usize {
        self.prediction.value.len()
    }

    fn set_params(&mut self, parameters: DVector<f64>) -> Result<(), ForwardError> {
        self.prediction = self.curves.predict(&in_si(parameters.as_slice()))?;
        self.parameters = parameters;
        Ok(())
    }

    fn params(&self) -> DVector<f64> {
        self.parameters.clone()
    }

    fn eval(&self) -> Result<DMatrix<f64>, ForwardError> {
        Ok(Self::columns(&self.prediction.value, 1.0))
    }

    fn eval_partial_deriv(&self, index: usize) -> Result<DMatrix<f64>, ForwardError> {
        let derivative = &self.prediction.derivatives[index];
        let column: Vec<f64> = derivative.iter().map(|d| d * UNITS[index]).collect();
        Ok(Self::columns(&column, 0.0))
    }
}

fn modulus_and_thickness(coating: Coating) -> ContactCurves {
    coating.curves_of(&[young_modulus(0), THICKNESS])
}

#[test]
fn a_coating_and_the_depth_gain_agree_with_varpro() {
    let coating = Coating {
        points: 60,
        ..coating(10e-6)
    };
    let curves = || modulus_and_thickness(coating);
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let sigma = 0.2 * NANO;
    let truth = curves()
        .predict(&[coating.layer.0, coating.thickness])
        .unwrap();
    let read: Vec<f64> = (truth.value.iter())
        .map(|depth| {
            let noise: f64 = StandardNormal.sample(&mut random);
            1.03 * depth + 3.0 * NANO + sigma * noise
        })
        .collect();

    let unknowns = vec![
        Unknown::positive("E1", [30e9, 300e9])
            .unwrap()
            .starting_at(80e9)
            .unwrap(),
        Unknown::positive("H", [0.1e-6, 2e-6])
            .unwrap()
            .starting_at(0.6e-6)
            .unwrap(),
        Unknown::positive("gain", [0.5, 2.0])
            .unwrap()
            .starting_at(1.0)
            .unwrap(),
    ];
    let curve = Curve::new(coating.forces(), read.clone()).unwrap();
    let shift = [LinearNuisance::shift()];
    let problem = Problem::new(vec![curve], unknowns, &shift, Noise::default()).unwrap();
    let options = FitOptions {
        intervals: Intervals::Wald,
        tolerance: 1e-8,
        ..FitOptions::default()
    };
    let ours = identify(&Gained(curves()), &problem, &options).unwrap();

    let nanometres = DVector::from_iterator(read.len(), read.iter().map(|y| y / NANO));
    let separable = SeparableProblemBuilder::new(Separable::new(curves(), [80.0, 0.6]))
        .observations(nanometres)
        .build()
        .unwrap();
    let theirs = LevMarSolver::default().solve(separable).unwrap();
    let statistics = FitStatistics::try_from(&theirs).unwrap();

    let nonlinear = theirs.nonlinear_parameters();
    let linear = theirs.linear_coefficients().unwrap();
    let found = [nonlinear[0] * UNITS[0], nonlinear[1] * UNITS[1], linear[0]];
    let variances = [
        statistics.nonlinear_parameters_variance()[0] * UNITS[0].powi(2),
        statistics.nonlinear_parameters_variance()[1] * UNITS[1].powi(2),
        statistics.linear_coefficients_variance()[0],
    ];
    for (j, estimate) in ours.estimates.iter().enumerate() {
        let error = variances[j].sqrt();
        // A hundredth of a standard error: the jitter of predictions from a grid.
        assert!(
            (estimate.value - found[j]).abs() < 0.01 * error,
            "{j}: {estimate:?} {found:?} ± {error}"
        );
        // Covariances of logarithms and of the numbers themselves.
        assert_relative_eq!(
            ours.covariance[j][j].sqrt() * estimate.value,
            error,
            max_relative = 1e-2
        );
    }
    let zero = ours.coefficients[0].value / NANO;
    let error = statistics.linear_coefficients_variance()[1].sqrt();
    assert!(
        (zero - linear[1]).abs() < 0.01 * error,
        "{zero} {} ± {error}",
        linear[1]
    );
    assert_relative_eq!(
        ours.noise.observed / NANO,
        statistics.regression_standard_error(),
        max_relative = 1e-3
    );
}
