//! The effect on the estimates of a number that is taken as exact, compared with fits at other values of it.

use pellicle_identify::{
    Fit, FitOptions, ForwardError, ForwardModel, Intervals, LinearNuisance, Noise, Prediction,
    Prior, Problem, Unknown, exponents, identify,
};

use super::toys::{Normals, Toy, coating, hertz, logarithmic, noisy, unknown};

/// A law with its last parameter held.
struct Held {
    toy: Toy,
    value: f64,
}

impl Held {
    fn with_all(&self, parameters: &[f64]) -> Prediction {
        let all = [parameters, &[self.value]].concat();
        self.toy.predict(&all).unwrap()
    }
}

impl ForwardModel for Held {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        let mut prediction = self.with_all(parameters);
        prediction.derivatives.pop();
        Ok(prediction)
    }
}

fn fitted(model: &Held, problem: &Problem) -> Fit {
    let options = FitOptions {
        intervals: Intervals::Wald,
        ..FitOptions::default()
    };
    identify(model, problem, &options).unwrap()
}

/// The exponents of the fit for the held number.
fn found(model: &Held, problem: &Problem) -> Vec<Option<f64>> {
    let fit = fitted(model, problem);
    let values: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
    let mut at_fit = model.with_all(&values);
    let by_held = at_fit.derivatives.pop().unwrap();
    let change = by_held.iter().map(|d| d * model.value).collect();
    let all = exponents(problem, &fit, at_fit, &[change]).unwrap();
    all.into_iter().next().unwrap()
}

#[test]
fn a_modulus_scales_with_the_inverse_root_of_an_exact_radius() {
    let forces = logarithmic(0.1, 10.0, 20);
    let toy = Toy::new(forces.clone(), hertz);
    let curve = noisy(
        &forces,
        &toy.values(&[3.0, 2.0]),
        0.01,
        &Normals::new(1).white(20),
    );
    let unknowns = vec![unknown("E", [0.1, 100.0], 1.0)];
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::default()).unwrap();
    let model = Held { toy, value: 2.0 };
    // D(E, R) is a function of E √R; the rest is rounding.
    let [Some(exponent)] = found(&model, &problem)[..] else {
        panic!("no exponent");
    };
    assert!((exponent + 0.5).abs() < 1e-12, "{exponent}");
}

#[test]
fn exponents_are_the_changes_of_the_fit_with_another_value() {
    let forces = logarithmic(0.01, 100.0, 40);
    let toy = || Toy::new(forces.clone(), coating);
    // Without noise, so that second derivatives of the model do not contribute.
    let curve = noisy(
        &forces,
        &toy().values(&[10.0, 1.5, 1.0]),
        0.0,
        &Normals::new(1).white(40),
    );
    let prior = Prior::Lognormal {
        median: 1.5,
        factor: 1.02,
    };
    let unknowns: Vec<Unknown> = vec![
        unknown("E1", [1.0, 100.0], 5.0),
        unknown("E2", [0.2, 10.0], 1.0).with_prior(prior).unwrap(),
    ];
    let shift = [LinearNuisance::shift()];
    let problem = Problem::new(vec![curve], unknowns, &shift, Noise::white(0.01)).unwrap();
    let of = |value: f64| Held { toy: toy(), value };
    let exponents = found(&of(1.0), &problem);
    let step = 0.005_f64;
    let ends = [step, -step].map(|step| fitted(&of(step.exp()), &problem));
    for (j, exponent) in exponents.iter().enumerate() {
        let [more, less] = [0, 1].map(|k| ends[k].estimates[j].value);
        let quotient = (more / less).ln() / (2.0 * step);
        // The square of the step, and the tolerance of the search.
        assert!(
            (quotient - exponent.unwrap()).abs() < 2e-3,
            "{quotient} {exponent:?}"
        );
        assert!(quotient.abs() > 0.1, "{quotient}");
    }
}

#[test]
fn an_unknown_at_its_bound_has_no_exponent() {
    let forces = logarithmic(0.1, 10.0, 20);
    let toy = Toy::new(forces.clone(), coating);
    let curve = noisy(&forces, &toy.values(&[10.0, 1.5, 1.0]), 0.0, &[0.0; 20]);
    // The best fit lies at the bound.
    let unknowns = vec![
        unknown("E1", [1.0, 8.0], 5.0),
        unknown("E2", [0.2, 10.0], 1.0),
    ];
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::white(0.01)).unwrap();
    let found = found(&Held { toy, value: 1.0 }, &problem);
    assert!(found[0].is_none() && found[1].is_some(), "{found:?}");
}
