//! Surrogates compared with their model.

use std::sync::atomic::{AtomicUsize, Ordering};

use pellicle_identify::{
    ForwardError, ForwardModel, IdentifyError, Prediction, Surrogate, SurrogateOptions, Unknown,
};

use super::coating::coating;

/// `y = a q^b + c`, with a count of its evaluations.
pub struct Power {
    pub abscissa: Vec<f64>,
    pub evaluations: AtomicUsize,
}

impl ForwardModel for Power {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        let [a, b, c] = [parameters[0], parameters[1], parameters[2]];
        let of = |f: &dyn Fn(f64) -> f64| self.abscissa.iter().map(|&q| f(q)).collect::<Vec<_>>();
        Ok(Prediction {
            value: of(&|q| a * q.powf(b) + c),
            slope: of(&|q| a * b * q.powf(b - 1.0)),
            derivatives: vec![
                of(&|q| q.powf(b)),
                of(&|q| a * q.powf(b) * q.ln()),
                of(&|_| 1.0),
            ],
        })
    }
}

fn power(points: u32) -> Power {
    Power {
        abscissa: (1..=points)
            .map(|i| 3.0 * f64::from(i) / f64::from(points))
            .collect(),
        evaluations: AtomicUsize::new(0),
    }
}

fn unknowns() -> [Unknown; 3] {
    [
        Unknown::positive("a", [0.1, 10.0]).unwrap(),
        Unknown::positive("b", [0.2, 2.0]).unwrap(),
        Unknown::signed("c", [-1.0, 1.0]).unwrap(),
    ]
}

const SIDES: [[f64; 2]; 3] = [[1.0, 2.0], [0.5, 0.8], [-0.1, 0.2]];

#[test]
fn values_slopes_and_derivatives_match_the_model_for_any_number_of_points() {
    let model = power(2000);
    let surrogate =
        Surrogate::over(&model, &unknowns(), &SIDES, SurrogateOptions::default()).unwrap();
    assert_eq!(
        surrogate.predictions(),
        model.evaluations.load(Ordering::Relaxed)
    );
    assert!(
        surrogate.error() < 1e-4 && surrogate.predictions() <= 300,
        "{surrogate:?}"
    );
    let at = [1.4, 0.62, 0.11];
    let (found, expected) = (surrogate.predict(&at).unwrap(), model.predict(&at).unwrap());
    let assert_near = |found: &[f64], expected: &[f64], tolerance: f64| {
        let largest = expected.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < tolerance * largest,
                "{found} {expected}"
            );
        }
    };
    assert_near(&found.value, &expected.value, 1e-4);
    assert_near(&found.slope, &expected.slope, 1e-3);
    for (found, expected) in found.derivatives.iter().zip(&expected.derivatives) {
        // A derivative loses at worst a factor of the degree squared, at a face; less inside.
        assert_near(found, expected, 2e-3);
    }
}

#[test]
fn there_is_no_prediction_outside_the_box() {
    let options = SurrogateOptions::default();
    let surrogate = Surrogate::over(&power(20), &unknowns(), &SIDES, options).unwrap();
    let outside = surrogate.predict(&[2.1, 0.6, 0.0]);
    assert!(matches!(outside, Err(ForwardError::OutOfRange { .. })));
}

#[test]
fn a_model_with_a_kink_is_refused_with_the_error_reached() {
    struct Kink;
    impl ForwardModel for Kink {
        fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
            let value = 1.0 + (parameters[0] - 1.37).abs();
            Ok(Prediction {
                value: vec![value],
                slope: vec![1.0],
                derivatives: vec![vec![0.0]],
            })
        }
    }
    let unknown = [Unknown::positive("x", [0.1, 10.0]).unwrap()];
    let error = Surrogate::over(&Kink, &unknown, &[[1.0, 2.0]], SurrogateOptions::default());
    let Err(IdentifyError::Surrogate {
        reached, wanted, ..
    }) = error
    else {
        panic!("{error:?}");
    };
    assert!(reached > wanted && reached < 0.1);
}

#[test]
fn two_moduli_of_a_coating_take_a_hundred_curves() {
    let coating = coating(10e-6);
    let model = coating.curves(2);
    let [e1, e2] = ["E1", "E2"].map(|name| Unknown::positive(name, [1e9, 1e12]).unwrap());
    let sides = [[80e9, 125e9], [9e9, 11e9]];
    let surrogate = Surrogate::over(&model, &[e1, e2], &sides, SurrogateOptions::default());
    let surrogate = surrogate.unwrap();
    assert!(
        surrogate.error() < 1e-4 && surrogate.predictions() <= 150,
        "{surrogate:?}"
    );
    let at = [93e9, 10.4e9];
    let (found, expected) = (surrogate.predict(&at).unwrap(), model.predict(&at).unwrap());
    for (found, expected) in found.value.iter().zip(&expected.value) {
        assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
    }
    for (j, value) in at.iter().enumerate() {
        for (i, expected) in expected.derivatives[j].iter().enumerate() {
            let error = (found.derivatives[j][i] - expected) * value / found.value[i];
            // The error of D over half a side of the box, 0.2, and the grid error of the derivatives, 1e-3.
            assert!(error.abs() < 2e-3, "{j} {i}: {error:e}");
        }
    }
}
