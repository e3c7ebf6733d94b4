//! Closed-form curves and their noise.

use std::sync::Mutex;

use pellicle_identify::{Curve, ForwardError, ForwardModel, Prediction, Unknown};
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};

/// One point of a law: value, derivative with respect to the abscissa, derivatives with respect to the parameters.
pub type Point = (f64, f64, Vec<f64>);

/// A law at given abscissae, which records the parameters of each evaluation.
pub struct Toy {
    pub abscissa: Vec<f64>,
    law: fn(f64, &[f64]) -> Point,
    evaluations: Mutex<Vec<Vec<f64>>>,
}

impl Toy {
    pub fn new(abscissa: Vec<f64>, law: fn(f64, &[f64]) -> Point) -> Self {
        Self {
            abscissa,
            law,
            evaluations: Mutex::new(Vec::new()),
        }
    }

    /// The law without noise.
    pub fn values(&self, parameters: &[f64]) -> Vec<f64> {
        self.abscissa
            .iter()
            .map(|&q| (self.law)(q, parameters).0)
            .collect()
    }

    /// The law with its derivatives.
    pub fn points(&self, parameters: &[f64]) -> Vec<Point> {
        let law = |q: &f64| (self.law)(*q, parameters);
        self.abscissa.iter().map(law).collect()
    }

    /// Every set of parameters evaluated, in order.
    pub fn evaluations(&self) -> Vec<Vec<f64>> {
        self.evaluations.lock().unwrap().clone()
    }
}

impl ForwardModel for Toy {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        self.predict_from(parameters, &vec![0.0; self.abscissa.len()])
    }

    fn predict_from(
        &self,
        parameters: &[f64],
        origins: &[f64],
    ) -> Result<Prediction, ForwardError> {
        self.evaluations.lock().unwrap().push(parameters.to_vec());
        let pairs = self.abscissa.iter().zip(origins);
        let points: Vec<Point> = pairs
            .map(|(q, origin)| (self.law)(q - origin, parameters))
            .collect();
        Ok(Prediction {
            value: points.iter().map(|p| p.0).collect(),
            slope: points.iter().map(|p| p.1).collect(),
            derivatives: (0..parameters.len())
                .map(|j| points.iter().map(|p| p.2[j]).collect())
                .collect(),
            origins: origins.to_vec(),
        })
    }
}

/// Hertz, parameters `E*` and `R`: `D = (9Q²/(16 R E*²))^⅓`.
pub fn hertz(q: f64, parameters: &[f64]) -> Point {
    let (e, r) = (parameters[0], parameters[1]);
    let d = (9.0 * q * q / (16.0 * r * e * e)).cbrt();
    (
        d,
        2.0 * d / (3.0 * q),
        vec![-2.0 * d / (3.0 * e), -d / (3.0 * r)],
    )
}

/// Hertz with `R = 1`.
pub fn hertz_modulus(q: f64, parameters: &[f64]) -> Point {
    let (d, slope, mut derivatives) = hertz(q, &[parameters[0], 1.0]);
    derivatives.pop();
    (d, slope, derivatives)
}

/// A coating on a substrate, parameters `E1`, `E2`, `H`: `D = (Q/E)^⅔` with `E = E1 (1 − f) + E2 f`, `f = s/(s + H)`,
/// `s = Q^⅓`.
pub fn coating(q: f64, parameters: &[f64]) -> Point {
    let (e1, e2, h) = (parameters[0], parameters[1], parameters[2]);
    let s = q.cbrt();
    let f = s / (s + h);
    let e = e1 * (1.0 - f) + e2 * f;
    let d = (q / e).powf(2.0 / 3.0);
    let by_e = -2.0 * d / (3.0 * e);
    let by_f = by_e * (e2 - e1);
    let slope = 2.0 * d / (3.0 * q) + by_f * h / (s + h).powi(2) * s / (3.0 * q);
    let by_h = -by_f * s / (s + h).powi(2);
    (d, slope, vec![by_e * (1.0 - f), by_e * f, by_h])
}

/// A coating of thickness 1.
pub fn coating_moduli(q: f64, parameters: &[f64]) -> Point {
    let (d, slope, mut derivatives) = coating(q, &[parameters[0], parameters[1], 1.0]);
    derivatives.pop();
    (d, slope, derivatives)
}

/// A straight line `a + b q`.
pub fn line(q: f64, parameters: &[f64]) -> Point {
    (
        parameters[0] + parameters[1] * q,
        parameters[1],
        vec![1.0, q],
    )
}

/// `points` abscissae from `low` to `high`, evenly spaced in the logarithm.
pub fn logarithmic(low: f64, high: f64, points: usize) -> Vec<f64> {
    (0..points)
        .map(|i| low * (high / low).powf(i as f64 / (points - 1) as f64))
        .collect()
}

/// Seeded normal variates.
pub struct Normals(ChaCha8Rng);

impl Normals {
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub fn next(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    /// White noise of unit variance.
    pub fn white(&mut self, points: usize) -> Vec<f64> {
        (0..points).map(|_| self.next()).collect()
    }

    /// An autoregression plus white noise, with total variance one.
    pub fn autoregressive(&mut self, points: usize, phi: f64, white: f64) -> Vec<f64> {
        let mut state = self.next() * (1.0 - white).sqrt();
        let drive = ((1.0 - phi * phi) * (1.0 - white)).sqrt();
        (0..points)
            .map(|_| {
                let value = state + white.sqrt() * self.next();
                state = phi * state + drive * self.next();
                value
            })
            .collect()
    }
}

/// A curve with noise added to its values.
pub fn noisy(abscissa: &[f64], values: &[f64], sigma: f64, noise: &[f64]) -> Curve {
    let observed = values
        .iter()
        .zip(noise)
        .map(|(v, n)| v + sigma * n)
        .collect();
    Curve::new(abscissa.to_vec(), observed).unwrap()
}

/// An unknown between bounds with a start.
pub fn unknown(name: &str, range: [f64; 2], start: f64) -> Unknown {
    Unknown::positive(name, range)
        .unwrap()
        .starting_at(start)
        .unwrap()
}

/// The moduli of a coating and its substrate.
pub fn two_moduli() -> Vec<Unknown> {
    vec![
        unknown("E1", [1.0, 100.0], 5.0),
        unknown("E2", [0.2, 10.0], 1.0),
    ]
}

#[test]
fn derivatives_of_the_toys_are_their_difference_quotients() {
    let check = |law: fn(f64, &[f64]) -> Point, parameters: &[f64]| {
        let (q, step) = (0.7, 1e-5);
        let (_, slope, derivatives) = law(q, parameters);
        let quotient = (law(q + step, parameters).0 - law(q - step, parameters).0) / (2.0 * step);
        // Central differences have errors of step² and of rounding over step, 1e-10 and 1e-11.
        assert!((slope - quotient).abs() < 1e-8 * slope.abs());
        for (j, derivative) in derivatives.iter().enumerate() {
            let at = |sign: f64| {
                let mut moved = parameters.to_vec();
                moved[j] += sign * step;
                law(q, &moved).0
            };
            let quotient = (at(1.0) - at(-1.0)) / (2.0 * step);
            assert!((derivative - quotient).abs() < 1e-8 * derivative.abs().max(1e-2));
        }
    };
    check(hertz, &[1.3, 0.8]);
    check(coating, &[10.0, 1.5, 0.9]);
    check(line, &[1.0, 2.0]);
}
