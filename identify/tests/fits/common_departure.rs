//! What repeats have in common cannot be noise: refused if it is there, not refused if their noise only wanders.

use pellicle_identify::{
    Amount, Correlation, Curve, Fit, FitOptions, FitVerdict, LinearNuisance, Noise, Problem,
    Scatter, identify,
};

use super::toys::{Normals, Toy, hertz_modulus, logarithmic, unknown};

const SIGMA: f64 = 0.02;

const ESTIMATED: Noise = Noise {
    observed: Amount::Estimated,
    abscissa: Amount::Given(0.0),
    relative: Amount::Given(0.0),
    correlation: Correlation::Estimated,
};

/// Repeats of a Hertz contact under 0.1 to 30, whose moduli scatter by 3 %, with correlated noise of their own and a
/// hump that they have in common: of this height, between forces of 1 and 4.
fn fit(curves: usize, points: usize, hump: f64, seed: u64) -> Fit {
    let mut normals = Normals::new(seed);
    let forces = logarithmic(0.1, 30.0, points);
    let one = |normals: &mut Normals| {
        let modulus = 5.0 * (0.03 * normals.next()).exp();
        let shift = 0.1 * normals.next();
        let series = normals.autoregressive(points, 0.9, 0.1);
        let values = Toy::new(forces.clone(), hertz_modulus).values(&[modulus]);
        let common = forces.iter().map(|q| {
            let place = (q / 2.0).ln() / 2.5_f64.ln();
            if place.abs() < 1.0 {
                hump * (1.0 - place * place).powi(2)
            } else {
                0.0
            }
        });
        let observed = values.iter().zip(series).zip(common);
        let observed = observed
            .map(|((v, n), c)| v + shift + SIGMA * n + c)
            .collect();
        Curve::new(forces.clone(), observed).unwrap()
    };
    let all: Vec<Curve> = (0..curves).map(|_| one(&mut normals)).collect();
    let model = Toy::new(forces.repeat(curves), hertz_modulus);
    let unknowns = vec![unknown("E", [1.0, 50.0], 10.0)];
    let problem = Problem::new(all, unknowns, &[LinearNuisance::shift()], ESTIMATED)
        .unwrap()
        .with_scatter(Scatter::BetweenCurves);
    identify(&model, &problem, &FitOptions::default()).unwrap()
}

#[test]
fn a_hump_that_all_repeats_have_is_a_misfit_and_where_it_is_is_told() {
    // Four times the noise, which wanders within each curve; the fits take half of it.
    let fit = fit(8, 120, 4.0 * SIGMA, 1);
    assert_eq!(fit.verdict, FitVerdict::Misfit, "{:?}", fit.goodness);
    let common = fit.departure.unwrap();
    assert!(
        common.curves == 8 && common.probability < 1e-3,
        "{common:?}"
    );
    let [from, to] = common.range;
    assert!(
        (0.7..1.6).contains(&from) && (2.5..6.0).contains(&to),
        "{common:?}"
    );
    // Eight curves determine the mean to a third of the noise.
    assert!((SIGMA..4.5 * SIGMA).contains(&common.largest), "{common:?}");
}

#[test]
fn repeats_whose_noise_only_wanders_are_not_refused() {
    for (curves, points) in [(8, 60), (3, 60)] {
        let fits = (0..200).map(|seed| fit(curves, points, 0.0, seed));
        let (mut refused, mut below) = (0, 0);
        for fit in fits {
            refused += usize::from(fit.verdict != FitVerdict::Fitted);
            below += usize::from(fit.goodness.common_p.is_some_and(|p| p < 0.01));
        }
        println!("{curves} curves: {below} below 1 %, {refused} refused of 200");
        // At most 2 % of 200 at the level of 1 %, and of all tests together.
        assert!(
            below <= 4 && refused <= 4,
            "{curves} curves: {below} below 1 %, {refused} refused of 200"
        );
    }
}

/// One curve of 240 points with noise that lasts for a few points, and a hump that only it has.
fn single(hump: f64, persistence: f64, seed: u64) -> Fit {
    let points = 240;
    let mut normals = Normals::new(seed);
    let forces = logarithmic(0.1, 30.0, points);
    let series = normals.autoregressive(points, persistence, 0.2);
    let values = Toy::new(forces.clone(), hertz_modulus).values(&[5.0]);
    let common = forces.iter().map(|q| {
        let place = (q / 2.0).ln() / 4.0_f64.ln();
        if place.abs() < 1.0 {
            hump * (1.0 - place * place).powi(2)
        } else {
            0.0
        }
    });
    let observed = values.iter().zip(series).zip(common);
    let observed = observed.map(|((v, n), c)| v + SIGMA * n + c).collect();
    let curve = Curve::new(forces.clone(), observed).unwrap();
    let unknowns = vec![unknown("E", [1.0, 50.0], 10.0)];
    let problem =
        Problem::new(vec![curve], unknowns, &[LinearNuisance::shift()], ESTIMATED).unwrap();
    identify(
        &Toy::new(forces, hertz_modulus),
        &problem,
        &FitOptions::default(),
    )
    .unwrap()
}

#[test]
fn a_departure_that_correlation_absorbs_is_told_and_wandering_noise_is_not() {
    // Of 200 curves without a departure, 1 % by the level, and 4 at most.
    let told = |persistence| {
        let fits = (0..200).map(|seed| single(0.0, persistence, seed));
        fits.filter(|fit| fit.departure.is_some()).count()
    };
    let counts = [0.5, 0.9].map(told);
    println!("told of without a departure: {counts:?} of 200");
    assert!(counts.iter().all(|count| *count <= 4), "{counts:?} of 200");
    let fits: Vec<Fit> = (0..20).map(|seed| single(3.0 * SIGMA, 0.5, seed)).collect();
    // A hump of three standard deviations: refused by a test or told of in four of five, against one of a hundred
    // without it.
    let is_silent = |fit: &&Fit| fit.verdict == FitVerdict::Fitted && fit.departure.is_none();
    let silent = fits.iter().filter(is_silent).count();
    assert!(silent <= 9, "{silent} of 20 are silent");
}
