//! Posteriors compared with exact ones and with profiles.

use std::sync::atomic::AtomicUsize;

use pellicle_identify::{
    Amount, Curve, Fit, FitOptions, ForwardError, ForwardModel, LinearNuisance, Noise, Posterior,
    PosteriorOptions, Prediction, Prior, Problem, Surrogate, SurrogateOptions, Unknown, identify,
    posterior,
};
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};

use super::{coating::coating, surrogate::Power};

/// `a + b q`.
struct Line(Vec<f64>);

impl ForwardModel for Line {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        Ok(Prediction {
            value: self
                .0
                .iter()
                .map(|q| parameters[0] + parameters[1] * q)
                .collect(),
            slope: vec![parameters[1]; self.0.len()],
            derivatives: vec![vec![1.0; self.0.len()], self.0.clone()],
        })
    }
}

/// The model's points with noise.
fn measured(model: &dyn ForwardModel, truth: &[f64], sigma: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let values = model.predict(truth).unwrap().value.into_iter();
    values
        .map(|v| {
            let normal: f64 = StandardNormal.sample(&mut random);
            v + sigma(v) * normal
        })
        .collect()
}

/// A fit, its surrogate and its posterior.
fn sampled(model: &dyn ForwardModel, problem: &Problem, samples: usize) -> (Fit, Posterior) {
    let fit = identify(model, problem, &FitOptions::default()).unwrap();
    let surrogate = Surrogate::around(model, problem, &fit, SurrogateOptions::default()).unwrap();
    let options = PosteriorOptions { samples, seed: 5 };
    let posterior = posterior(&surrogate, problem, &fit, options).unwrap();
    assert!(
        posterior.convergence.is_converged(),
        "{:?}",
        posterior.convergence
    );
    assert!(posterior.cut_off < 1e-3, "{}", posterior.cut_off);
    (fit, posterior)
}

/// Checks that the median and the 95 % limits are within `part` of a standard error of the expected ones.
fn assert_quantiles(posterior: &Posterior, unknown: usize, expected: [f64; 3], part: f64) {
    let error = (expected[2] - expected[0]) / (2.0 * 1.96);
    for (probability, expected) in [0.025, 0.5, 0.975].into_iter().zip(expected) {
        let found = posterior.quantile(unknown, probability);
        let missed = (found - expected) / error;
        assert!(
            missed.abs() < part,
            "{unknown} {probability}: {missed} standard errors"
        );
    }
}

#[test]
fn a_line_with_a_prior_and_a_frame_has_the_exact_posterior() {
    let q: Vec<f64> = (0..30).map(|i| f64::from(i) / 30.0).collect();
    let model = Line(q.clone());
    let observed = measured(&model, &[0.5, 2.0], |_| 0.1);
    let prior = Prior::Normal { mean: 2.1, sd: 0.1 };
    let unknowns = vec![
        Unknown::signed("a", [-3.0, 3.0]).unwrap(),
        Unknown::signed("b", [-3.0, 8.0])
            .unwrap()
            .with_prior(prior)
            .unwrap(),
    ];
    // The frame is a second slope, known to 0.15.
    let frame = LinearNuisance::frame_compliance()
        .with_normal_prior(0.0, 0.15)
        .unwrap();
    let curve = Curve::new(q.clone(), observed.clone()).unwrap();
    let problem = Problem::new(vec![curve], unknowns, &[frame], Noise::white(0.1)).unwrap();
    let (_, posterior) = sampled(&model, &problem, 40_000);

    // The sum of slope and frame, and the offset, by the normal equations of the line with variances 0.1²; then with
    // s = b + f, f ~ N(0, 0.15²), b ~ N(2.1, 0.1²): a normal for (a, b) from three unknowns (a, b, f).
    let rows: Vec<([f64; 3], f64)> = q
        .iter()
        .zip(&observed)
        .map(|(q, y)| ([10.0, 10.0 * q, 10.0 * q], 10.0 * y))
        .chain([([0.0, 10.0, 0.0], 21.0), ([0.0, 0.0, 1.0 / 0.15], 0.0)])
        .collect();
    let gram = |i: usize, j: usize| rows.iter().map(|(row, _)| row[i] * row[j]).sum::<f64>();
    let right = |i: usize| rows.iter().map(|(row, y)| row[i] * y).sum::<f64>();
    let matrix: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| gram(i, j)));
    let minor = |i: usize, j: usize| {
        let [a, b] = [(i + 1) % 3, (i + 2) % 3];
        let [c, d] = [(j + 1) % 3, (j + 2) % 3];
        matrix[a][c] * matrix[b][d] - matrix[a][d] * matrix[b][c]
    };
    let determinant: f64 = (0..3).map(|j| matrix[0][j] * minor(0, j)).sum();
    for unknown in 0..2 {
        let mean: f64 = (0..3).map(|j| minor(unknown, j) * right(j)).sum::<f64>() / determinant;
        let error = (minor(unknown, unknown) / determinant).sqrt();
        // About four thousand independent samples: 0.04 of a standard error at the ends.
        let expected = [-1.96, 0.0, 1.96].map(|z| mean + z * error);
        assert_quantiles(&posterior, unknown, expected, 0.1);
    }
}

#[test]
fn quantiles_agree_with_the_profiles_when_the_noise_is_estimated() {
    let model = Power {
        abscissa: (1..=40).map(|i| 0.1 * f64::from(i)).collect(),
        evaluations: AtomicUsize::new(0),
    };
    let observed = measured(&model, &[1.5, 0.7, 0.1], |_| 0.01);
    let unknowns = vec![
        Unknown::positive("a", [0.2, 10.0]).unwrap(),
        Unknown::positive("b", [0.2, 2.0]).unwrap(),
        Unknown::signed("c", [-1.0, 1.0]).unwrap(),
    ];
    let curve = Curve::new(model.abscissa.clone(), observed).unwrap();
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::default()).unwrap();
    let (fit, posterior) = sampled(&model, &problem, 40_000);
    for (unknown, estimate) in fit.estimates.iter().enumerate() {
        let [low, high] = estimate.interval.map(Option::unwrap);
        // As above; the profile is centred on the best fit, which is not the median of a skewed posterior.
        assert_quantiles(&posterior, unknown, [low, estimate.value, high], 0.15);
    }
}

/// Both moduli of the half-micrometre coating, from a curve with noise of 1 % and an unknown zero.
fn coating_problem(model: &dyn ForwardModel) -> Problem {
    let coating = coating(10e-6);
    let observed = measured(model, &coating.truth()[..2], |v| 0.01 * v);
    let unknowns = vec![
        Unknown::positive("E1", [20e9, 500e9]).unwrap(),
        Unknown::positive("E2", [1e9, 100e9]).unwrap(),
    ];
    let noise = Noise {
        observed: Amount::Given(0.0),
        relative: Amount::Given(0.01),
        ..Noise::default()
    };
    let curve = Curve::new(coating.forces(), observed).unwrap();
    Problem::new(vec![curve], unknowns, &[LinearNuisance::shift()], noise).unwrap()
}

#[test]
fn posterior_quantiles_of_two_coating_moduli_agree_with_their_profiles() {
    let model = coating(10e-6).curves(2);
    let problem = coating_problem(&model);
    let (fit, posterior) = sampled(&model, &problem, 40_000);
    for (unknown, estimate) in fit.estimates.iter().enumerate() {
        let [low, high] = estimate.interval.map(Option::unwrap);
        assert_quantiles(&posterior, unknown, [low, estimate.value, high], 0.1);
    }
}

#[test]
fn one_thread_and_two_draw_the_same_samples() {
    let model = Line((0..20).map(f64::from).collect());
    let observed = measured(&model, &[0.5, 2.0], |_| 0.1);
    let unknowns = ["a", "b"].map(|name| Unknown::signed(name, [-10.0, 10.0]).unwrap());
    let curve = Curve::new(model.0.clone(), observed).unwrap();
    let problem = Problem::new(vec![curve], unknowns.to_vec(), &[], Noise::white(0.1)).unwrap();
    let of = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| sampled(&model, &problem, 1000).1)
    };
    let (one, two) = (of(1), of(2));
    let bytes = |posterior: &Posterior| -> Vec<u64> {
        posterior
            .samples
            .iter()
            .flatten()
            .map(|v| v.to_bits())
            .collect()
    };
    assert_eq!(bytes(&one), bytes(&two));
    assert_eq!(one, two);
}
