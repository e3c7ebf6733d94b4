//! Verdicts on unknowns that the data do or do not determine.

use approx::assert_relative_eq;
use pellicle_identify::{
    Fit, FitOptions, LinearNuisance, Noise, NullDirections, Prior, Problem, Unknown, Verdict,
    identify,
};

use super::toys::{Normals, Point, Toy, coating, hertz, logarithmic, noisy, unknown};

fn fit(
    law: fn(f64, &[f64]) -> Point,
    truth: &[f64],
    unknowns: Vec<Unknown>,
    sigma: f64,
    null_directions: NullDirections,
) -> Fit {
    let forces = logarithmic(0.01, 100.0, 40);
    let toy = Toy::new(forces.clone(), law);
    let curve = noisy(
        &forces,
        &toy.values(truth),
        sigma,
        &Normals::new(11).white(40),
    );
    let shift = [LinearNuisance::shift()];
    let problem = Problem::new(vec![curve], unknowns, &shift, Noise::white(sigma))
        .unwrap()
        .with_null_directions(null_directions);
    identify(&toy, &problem, &FitOptions::default()).unwrap()
}

/// `E*` and `R` of a ball on a half-space: the curve is invariant under `(E, R) → (E/√b, b R)`.
fn ball() -> NullDirections {
    let names = vec!["E".to_owned(), "R".to_owned()];
    NullDirections::new(names, vec![vec![-0.5, 1.0]]).unwrap()
}

fn ball_unknowns() -> Vec<Unknown> {
    vec![
        unknown("E", [0.1, 100.0], 3.0),
        unknown("R", [0.1, 100.0], 3.0),
    ]
}

#[test]
fn a_ball_on_a_half_space_determines_only_the_modulus_times_the_root_of_the_radius() {
    let (e, r) = (5.0_f64, 2.0_f64);
    let fit = fit(hertz, &[e, r], ball_unknowns(), 0.005, ball());
    for estimate in &fit.estimates {
        assert_eq!(estimate.verdict, Verdict::NotIdentifiable);
        assert_eq!(estimate.interval, [None, None]);
    }
    let combination = fit.estimates[0].known_combination.as_ref().unwrap();
    assert_eq!(combination.expression, "E * R^0.5");
    let [Some(low), Some(high)] = combination.interval else {
        panic!("{combination:?}")
    };
    let truth = e * r.sqrt();
    assert!(
        low < truth && truth < high && high / low < 1.05,
        "{combination:?}"
    );
    assert_eq!(
        fit.estimates[1]
            .known_combination
            .as_ref()
            .unwrap()
            .expression,
        "R * E^2"
    );
}

#[test]
fn a_prior_of_the_radius_makes_the_modulus_known_to_half_its_width() {
    let mut unknowns = ball_unknowns();
    let prior = Prior::Lognormal {
        median: 2.0,
        factor: 1.05,
    };
    unknowns[1] = unknowns[1].clone().with_prior(prior).unwrap().as_nuisance();
    let fit = fit(hertz, &[5.0, 2.0], unknowns, 1e-4, ball());
    assert_eq!(fit.estimates[1].verdict, Verdict::PriorDriven);
    assert_eq!(fit.estimates[0].verdict, Verdict::Identified);
    assert!(
        fit.estimates[0]
            .why
            .ends_with("Its uncertainty is mostly that of R.")
    );
    // σ_E/E = ½ σ_R/R, and the noise of the curve adds about 0.01 % to 2.4 %.
    assert_relative_eq!(
        fit.covariance[0][0].sqrt(),
        0.5 * 1.05_f64.ln(),
        max_relative = 1e-3
    );
    // The data leave the radius at its prior: the search ends within a thousandth of its standard deviation.
    assert_relative_eq!(fit.estimates[1].value, 2.0, max_relative = 1e-2 * 0.05);
}

#[test]
fn a_coating_of_known_thickness_is_identified_and_a_buried_one_is_not() {
    let unknowns = |h: f64| {
        vec![
            unknown("E1", [1.0, 100.0], 5.0),
            unknown("E2", [0.2, 10.0], 1.0),
            unknown("H", [h * 0.999, h * 1.001], h),
        ]
    };
    let none = NullDirections::default;
    let thin = fit(coating, &[10.0, 1.5, 1.0], unknowns(1.0), 0.005, none());
    assert_eq!(
        thin.estimates[0].verdict,
        Verdict::Identified,
        "{:?}",
        thin.estimates[0]
    );
    assert_eq!(
        thin.estimates[1].verdict,
        Verdict::Identified,
        "{:?}",
        thin.estimates[1]
    );
    // Under a coating a thousand times thicker, the substrate contributes a hundredth of the modulus.
    let thick = fit(
        coating,
        &[10.0, 1.5, 1000.0],
        unknowns(1000.0),
        0.05,
        none(),
    );
    assert_eq!(
        thick.estimates[1].verdict,
        Verdict::NotIdentified,
        "{:?}",
        thick.estimates[1]
    );
    assert_eq!(thick.estimates[1].interval, [None, None]);
    assert_eq!(
        thick.estimates[0].verdict,
        Verdict::Identified,
        "{:?}",
        thick.estimates[0]
    );
}

#[test]
fn a_thickness_bounded_only_from_below_is_one_sided() {
    // Loads too small to feel the substrate show that the coating is not thin.
    let unknowns = vec![
        unknown("E1", [1.0, 100.0], 10.0),
        unknown("E2", [1.0, 2.0], 1.5),
        unknown("H", [1.0, 1e4], 100.0),
    ];
    let fit = fit(
        coating,
        &[10.0, 1.5, 1000.0],
        unknowns,
        0.02,
        NullDirections::default(),
    );
    assert_eq!(
        fit.estimates[2].verdict,
        Verdict::OneSided,
        "{:?}",
        fit.estimates[2]
    );
    assert!(fit.estimates[2].interval[0].is_some());
    assert!(fit.estimates[2].why.contains("every value up to the bound"));
}

#[test]
fn a_profile_rises_from_the_best_fit_to_the_level() {
    let fit = fit(hertz, &[5.0, 2.0], ball_unknowns(), 0.005, ball());
    let profile = &fit.estimates[0].profile;
    assert!(profile.len() >= 3 && profile.windows(2).all(|p| p[0].value < p[1].value));
    let best = profile
        .iter()
        .position(|p| p.delta_chi_squared == 0.0)
        .unwrap();
    // χ² of one degree of freedom at 95 %, reached within a tenth: the scan ends within 5 % of its root.
    for end in [profile[0], profile[profile.len() - 1]] {
        assert_relative_eq!(end.delta_chi_squared, 3.841, max_relative = 0.11);
    }
    assert_relative_eq!(
        profile[best].value,
        fit.estimates[0].value,
        max_relative = 1e-14
    );
}
