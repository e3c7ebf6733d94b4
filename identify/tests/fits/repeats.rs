//! Repeats with scatter between them.

use approx::assert_relative_eq;
use pellicle_identify::{
    Correlation, Curve, Fit, FitOptions, FitVerdict, LinearNuisance, Noise, Prior, Problem,
    Scatter, Verdict, identify,
};

use super::toys::{Normals, Toy, coating_moduli, hertz, logarithmic, two_moduli, unknown};

const CURVES: usize = 8;
const SIGMA: f64 = 0.005;

/// Eight curves of coatings whose moduli scatter about 10 and 1.5.
fn curves(points: usize, scatter: f64, seed: u64) -> Vec<Curve> {
    let mut normals = Normals::new(seed);
    (0..CURVES)
        .map(|_| {
            let own = [10.0, 1.5].map(|mean: f64| mean * (scatter * normals.next()).exp());
            let shift = 0.1 * normals.next();
            let forces = logarithmic(0.01, 100.0, points);
            let observed = Toy::new(forces.clone(), coating_moduli)
                .values(&own)
                .iter()
                .map(|v| v + shift + SIGMA * normals.next())
                .collect();
            Curve::new(forces, observed).unwrap()
        })
        .collect()
}

fn fit(curves: Vec<Curve>, noise: Noise) -> Fit {
    let forces = curves.iter().flat_map(Curve::abscissa).copied().collect();
    let shift = [LinearNuisance::shift()];
    let problem = Problem::new(curves, two_moduli(), &shift, noise)
        .unwrap()
        .with_scatter(Scatter::BetweenCurves);
    identify(
        &Toy::new(forces, coating_moduli),
        &problem,
        &FitOptions::default(),
    )
    .unwrap()
}

#[test]
fn the_scatter_and_the_common_value_of_repeats_are_found() {
    let fit = fit(curves(300, 0.05, 1), Noise::default());
    assert_eq!(fit.verdict, FitVerdict::Fitted, "{:?}", fit.goodness);
    assert!(fit.excluded.is_empty());
    // The noise is that within curves: 2400 points determine it to 1.5 %.
    assert_relative_eq!(fit.noise.observed, SIGMA, max_relative = 0.05);
    for (estimate, truth) in fit.estimates.iter().zip([10.0, 1.5]) {
        let between = estimate.between_curves.as_ref().unwrap();
        assert_eq!(between.values.len(), CURVES);
        // Eight curves determine a scatter to 27 %; the tolerance is twice that.
        assert_relative_eq!(
            between.standard_deviation,
            0.05 * truth,
            max_relative = 0.54
        );
        let [low, high] = estimate.interval.map(Option::unwrap);
        assert!(low < truth && truth < high, "{estimate:?}");
        // ± t₇ · 5 %/√8 = ± 4.2 %, give or take the same 27 %.
        assert_relative_eq!(0.5 * (high - low) / truth, 0.042, max_relative = 0.54);
        assert_eq!(estimate.verdict, Verdict::Identified);
    }
    // The search and about five rounds.
    assert!(
        fit.work.curves_solved <= 20,
        "{} predictions",
        fit.work.curves_solved
    );
}

/// Counts how often the interval contains the true value, and how often a curve is left out.
fn held(scatter: f64) -> (Vec<usize>, usize) {
    let (mut held, mut lost) = (vec![0; 2], 0);
    for seed in 0..400 {
        let fit = fit(curves(30, scatter, seed), Noise::default());
        lost += usize::from(!fit.excluded.is_empty());
        for ((count, estimate), truth) in held.iter_mut().zip(&fit.estimates).zip([10.0, 1.5]) {
            let [low, high] = estimate.interval.map(Option::unwrap);
            *count += usize::from(low <= truth && truth <= high);
        }
    }
    (held, lost)
}

#[test]
fn intervals_of_repeats_cover_and_good_curves_stay() {
    let (held, lost) = held(0.05);
    for count in held {
        // As in coverage.rs.
        assert!((368..=390).contains(&count), "{count} of 400");
    }
    // Three comparisons of at most 0.5 % each: six of 400, plus twice the root of that.
    assert!(lost <= 11, "{lost} of 400 lost a curve");
}

#[test]
fn intervals_of_repeats_without_scatter_cover_at_least_the_stated_level() {
    let (held, _) = held(0.0);
    assert!(held.iter().all(|count| *count >= 368), "{held:?} of 400");
}

#[test]
fn a_curve_with_a_wrong_surface_is_named_and_excluded() {
    let mut all = curves(100, 0.03, 3);
    // The surface was detected late: the forces of this curve, from 0.01 to 100, are too small by 0.2.
    let forces = all[5].abscissa().to_vec();
    let late: Vec<f64> = forces.iter().map(|q| q + 0.2).collect();
    let observed = Toy::new(late, coating_moduli).values(&[10.0, 1.5]);
    all[5] = Curve::new(forces, observed).unwrap();
    let without: Vec<Curve> = all
        .iter()
        .enumerate()
        .filter(|(i, _)| *i != 5)
        .map(|(_, c)| c.clone())
        .collect();
    let found = fit(all, Noise::default());
    assert_eq!(
        found
            .excluded
            .iter()
            .map(|one| one.curve)
            .collect::<Vec<_>>(),
        [5]
    );
    let alone = fit(without, Noise::default());
    for (a, b) in found.estimates.iter().zip(&alone.estimates) {
        // Both end within 2 % of a standard error of 1 %.
        assert_relative_eq!(a.value, b.value, max_relative = 1e-3);
    }
    assert!(found.points.whitened[500..600].iter().all(|r| *r == 0.0));
}

#[test]
fn a_common_prior_widens_the_common_value_and_not_the_scatter() {
    // Eight balls of the same radius, known to 5 %, on half-spaces of the same modulus.
    let mut normals = Normals::new(4);
    let forces = logarithmic(0.01, 100.0, 50);
    let curves: Vec<Curve> = (0..CURVES)
        .map(|_| {
            let values = Toy::new(forces.clone(), hertz).values(&[5.0, 2.0]);
            let observed = values.iter().map(|v| v + 1e-4 * normals.next()).collect();
            Curve::new(forces.clone(), observed).unwrap()
        })
        .collect();
    let prior = Prior::Lognormal {
        median: 2.0,
        factor: 1.05,
    };
    let radius = unknown("R", [0.5, 5.0], 1.5)
        .with_prior(prior)
        .unwrap()
        .as_nuisance();
    let all = (0..CURVES).flat_map(|_| forces.clone()).collect();
    let unknowns = vec![unknown("E", [0.1, 100.0], 3.0), radius];
    let problem = Problem::new(curves, unknowns, &[], Noise::white(1e-4))
        .unwrap()
        .with_scatter(Scatter::BetweenCurves);
    let fit = identify(&Toy::new(all, hertz), &problem, &FitOptions::default()).unwrap();
    assert_eq!(fit.verdict, FitVerdict::Fitted, "{fit:?}");
    // σ_E/E = ½ σ_R/R with the normal quantile, not Student's: the prior is not a sample of eight.
    let [low, high] = fit.estimates[0].interval.map(Option::unwrap);
    assert_relative_eq!((high / low).ln(), 1.96 * 1.05_f64.ln(), max_relative = 0.01);
    assert!(
        fit.estimates[0]
            .between_curves
            .as_ref()
            .unwrap()
            .standard_deviation
            < 0.01
    );
    assert_eq!(fit.estimates[1].verdict, Verdict::PriorDriven);
    // The interval of the radius is that of its prior.
    let [low, high] = fit.estimates[1].interval.map(Option::unwrap);
    let prior = 2.0 * 1.96 * 1.05_f64.ln();
    assert_relative_eq!((high / low).ln(), prior, max_relative = 0.01);
}

#[test]
fn eight_curves_of_a_thousand_points_with_correlated_noise_are_fitted() {
    let noise = Noise {
        correlation: Correlation::Estimated,
        ..Noise::default()
    };
    let fit = fit(curves(1000, 0.05, 9), noise);
    assert_eq!(fit.verdict, FitVerdict::Fitted, "{:?}", fit.goodness);
    // 8000 points determine the size of white noise to 0.8 %.
    assert_relative_eq!(fit.noise.observed, SIGMA, max_relative = 0.03);
}

#[test]
fn repeats_that_differ_by_half_have_nothing_in_common() {
    // A linearisation about the common moduli is off by its second order, on the same side for all curves.
    let fits = (0..40).map(|seed| fit(curves(60, 0.5, seed), Noise::default()));
    let (mut refused, mut covered) = (0, 0);
    for fit in fits {
        refused += usize::from(fit.verdict != FitVerdict::Fitted);
        let [low, high] = fit.estimates[0].interval.map(Option::unwrap);
        covered += usize::from((low..=high).contains(&10.0));
    }
    // 1 % of 40 by the level, and two more; of 40 intervals 38 ± 1.4 cover.
    assert!(refused <= 2, "{refused} of 40 refused");
    assert!(covered >= 34, "{covered} of 40 cover");
}

#[test]
fn a_hump_that_all_repeats_have_is_found_however_they_differ() {
    let with_hump = |curve: &Curve| {
        let pairs = curve.abscissa().iter().zip(curve.observed());
        let hump = |q: f64| 4.0 * SIGMA * (-q.ln().powi(2)).exp();
        let observed = pairs.map(|(q, d)| d + hump(*q)).collect();
        Curve::new(curve.abscissa().to_vec(), observed).unwrap()
    };
    let all = curves(60, 0.5, 2).iter().map(with_hump).collect();
    let fit = fit(all, Noise::default());
    assert_eq!(fit.verdict, FitVerdict::Misfit, "{:?}", fit.goodness);
    assert!(fit.goodness.common_p.unwrap() < 1e-3, "{:?}", fit.goodness);
}

#[test]
fn a_repeat_of_another_place_stays_and_what_the_others_give_is_told() {
    let mut all = curves(100, 0.0, 3);
    let forces = all[5].abscissa().to_vec();
    let values = Toy::new(forces.clone(), coating_moduli).values(&[4.0, 1.5]);
    let mut normals = Normals::new(8);
    let observed = values.iter().map(|v| v + SIGMA * normals.next()).collect();
    all[5] = Curve::new(forces, observed).unwrap();
    let without: Vec<Curve> = (all.iter().enumerate())
        .filter(|(i, _)| *i != 5)
        .map(|(_, curve)| curve.clone())
        .collect();
    let found = fit(all, Noise::default());
    assert!(found.excluded.is_empty(), "{:?}", found.excluded);
    let odd = found.odd.unwrap();
    assert!(odd.curves.len() == 1 && odd.curves[0].curve == 5, "{odd:?}");
    assert!(
        odd.curves[0].unknown == 0 && odd.curves[0].deviation < -10.0,
        "{odd:?}"
    );
    // ln 0.4 in one of eight: a standard deviation of |ln 0.4|/√8.
    let between = found.estimates[0].between_curves.as_ref().unwrap();
    let scatter = between.standard_deviation / found.estimates[0].value;
    assert_relative_eq!(scatter, -0.4_f64.ln() / 8.0_f64.sqrt(), max_relative = 0.05);
    let alone = fit(without, Noise::default());
    let [low, high] = alone.estimates[0].interval.map(Option::unwrap);
    // The noise is estimated from seven curves in place of eight.
    assert_relative_eq!(
        odd.without[0].value,
        alone.estimates[0].value,
        max_relative = 1e-3
    );
    assert_relative_eq!(odd.without[0].interval[0], low, max_relative = 3e-3);
    assert_relative_eq!(odd.without[0].interval[1], high, max_relative = 3e-3);
}
