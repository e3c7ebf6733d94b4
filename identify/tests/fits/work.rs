//! The number of predictions of a fit, none of which is repeated.

use pellicle_identify::{
    Fit, FitOptions, ForwardError, ForwardModel, LinearNuisance, Noise, Prediction, Problem,
    Unknown, identify,
};

use super::toys::{Normals, Point, Toy, coating, coating_moduli, logarithmic, noisy, unknown};

const FORCES: [f64; 2] = [0.01, 100.0];

/// Fits a coating of `E1 = 10`, `E2 = 1.5`, `H = 1` under 60 loads from the start of its unknowns.
fn coating_fit(
    law: fn(f64, &[f64]) -> Point,
    truth: &[f64],
    unknowns: Vec<Unknown>,
    seed: u64,
) -> (Fit, Toy) {
    let forces = logarithmic(FORCES[0], FORCES[1], 60);
    let toy = Toy::new(forces.clone(), law);
    let sigma = 0.002;
    let curve = noisy(
        &forces,
        &toy.values(truth),
        sigma,
        &Normals::new(seed).white(60),
    );
    let shift = [LinearNuisance::shift()];
    let problem = Problem::new(vec![curve], unknowns, &shift, Noise::default()).unwrap();
    let fit = identify(&toy, &problem, &FitOptions::default()).unwrap();
    (fit, toy)
}

#[test]
fn two_unknowns_take_at_most_twelve_predictions_to_the_best_fit() {
    for (seed, start) in [[2.5, 0.5], [40.0, 5.0], [10.0, 1.0], [3.0, 6.0]]
        .iter()
        .enumerate()
    {
        let unknowns = vec![
            unknown("E1", [1.0, 100.0], start[0]),
            unknown("E2", [0.2, 10.0], start[1]),
        ];
        let (fit, toy) = coating_fit(coating_moduli, &[10.0, 1.5], unknowns, seed as u64);
        assert!(
            fit.work.search <= 12,
            "{} predictions from {start:?}",
            fit.work.search
        );
        assert_eq!(fit.work.curves_solved, toy.evaluations().len());
        assert!(
            fit.work.curves_solved <= 12 + 4 * 6,
            "{} in all",
            fit.work.curves_solved
        );
    }
}

#[test]
fn three_unknowns_take_at_most_twenty_predictions_to_the_best_fit() {
    for (seed, start) in [[5.0, 0.8, 2.0], [30.0, 3.0, 0.5], [10.0, 1.0, 1.0]]
        .iter()
        .enumerate()
    {
        let unknowns = vec![
            unknown("E1", [1.0, 100.0], start[0]),
            unknown("E2", [0.2, 10.0], start[1]),
            unknown("H", [0.1, 10.0], start[2]),
        ];
        let (fit, _) = coating_fit(coating, &[10.0, 1.5, 1.0], unknowns, seed as u64);
        assert!(
            fit.work.search <= 20,
            "{} predictions from {start:?}",
            fit.work.search
        );
    }
}

#[test]
fn no_point_is_evaluated_twice() {
    let unknowns = vec![
        unknown("E1", [1.0, 100.0], 3.0),
        unknown("E2", [0.2, 10.0], 3.0),
    ];
    let (_, toy) = coating_fit(coating_moduli, &[10.0, 1.5], unknowns, 7);
    let evaluations = toy.evaluations();
    for (i, parameters) in evaluations.iter().enumerate() {
        assert!(
            !evaluations[..i].contains(parameters),
            "{parameters:?} twice"
        );
    }
}

#[test]
fn the_same_fit_gives_the_same_bits() {
    let once = || {
        let unknowns = vec![
            unknown("E1", [1.0, 100.0], 3.0),
            unknown("E2", [0.2, 10.0], 3.0),
        ];
        coating_fit(coating_moduli, &[10.0, 1.5], unknowns, 7).0
    };
    let in_threads = std::thread::spawn(once).join().unwrap();
    assert_eq!(once(), in_threads);
}

/// A coating model without predictions above a limiting modulus.
struct Limited {
    toy: Toy,
    highest: f64,
}

impl ForwardModel for Limited {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        if parameters[0] > self.highest {
            let source = "the coating is too stiff for the tables".into();
            return Err(ForwardError::OutOfRange { source });
        }
        self.toy.predict(parameters)
    }
}

#[test]
fn a_search_retreats_where_the_model_has_no_prediction() {
    let forces = logarithmic(FORCES[0], FORCES[1], 60);
    let toy = Toy::new(forces.clone(), coating_moduli);
    let curve = noisy(
        &forces,
        &toy.values(&[10.0, 1.5]),
        0.002,
        &Normals::new(5).white(60),
    );
    let unknowns = vec![
        unknown("E1", [1.0, 100.0], 6.0),
        unknown("E2", [0.2, 10.0], 9.0),
    ];
    let problem = Problem::new(vec![curve], unknowns, &[], Noise::white(0.002)).unwrap();
    let limited = Limited { toy, highest: 10.5 };
    let fit = identify(&limited, &problem, &FitOptions::default()).unwrap();
    // Three standard errors of about 0.5 %.
    assert!(
        (fit.estimates[0].value / 10.0 - 1.0).abs() < 0.02,
        "{:?}",
        fit.estimates[0]
    );
}
