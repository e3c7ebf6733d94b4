//! Intervals where the noise is told, told in part, and not told.
//!
//! Each measurement is fitted twice: with what is told of the noise, and with the noise it really has, whose interval
//! is that of the likelihood. The first must contain the true value as often as it claims, and must not be much wider
//! than the second.

use pellicle_identify::{
    Amount, Correlation, Curve, Fit, FitOptions, LinearNuisance, Noise, Problem, identify,
};

use super::toys::{Normals, Toy, hertz_modulus, logarithmic, unknown};

/// A series of measurements: a Hertz contact of modulus 5 under 0.1 to 30, depths from 0.06 to 2.8.
#[derive(Clone, Copy)]
struct Series {
    name: &'static str,
    points: usize,
    /// The noise of the measurements.
    real: Noise,
    /// What the fit knows of it.
    told: Noise,
}

/// The outcome of a series.
#[derive(Debug, Clone, Copy, Default)]
struct Outcome {
    /// Intervals that contain the true value.
    held: usize,
    /// Largest ratio of an interval to that of the likelihood with the real noise.
    beside_real: f64,
    /// Largest ratio of an interval to that of the likelihood with the noise of the fit, given or estimated.
    beside_estimated: f64,
}

const MODULUS: f64 = 5.0;

const NONE: Amount = Amount::Given(0.0);

fn amounts(observed: Amount, abscissa: Amount, relative: Amount) -> Noise {
    Noise {
        observed,
        abscissa,
        relative,
        correlation: Correlation::None,
    }
}

fn size(amount: Amount) -> f64 {
    match amount {
        Amount::Given(size) => size,
        Amount::Estimated => f64::NAN,
    }
}

impl Series {
    /// A measurement: an actual force for each reading, and noise of the depth, correlated or not.
    fn curve(&self, seed: u64) -> Curve {
        let mut normals = Normals::new(seed);
        let read = logarithmic(0.1, 30.0, self.points);
        let noise = self.real;
        let series = match noise.correlation {
            Correlation::Given {
                persistence,
                white_fraction,
            } => normals.autoregressive(self.points, persistence, white_fraction),
            _ => normals.white(self.points),
        };
        let actual: Vec<f64> = (read.iter())
            .map(|q| (q + size(noise.abscissa) * normals.next()).abs())
            .collect();
        let values = Toy::new(actual, hertz_modulus).values(&[MODULUS]);
        let pairs = values.iter().zip(series);
        let observed =
            pairs.map(|(v, n)| 0.3 + v + n * size(noise.observed).hypot(v * size(noise.relative)));
        Curve::new(read, observed.collect()).unwrap()
    }

    fn fit(&self, noise: Noise, seed: u64) -> Fit {
        let curve = self.curve(seed);
        let toy = Toy::new(curve.abscissa().to_vec(), hertz_modulus);
        let unknowns = vec![unknown("E", [1.0, 100.0], 10.0)];
        let shift = [LinearNuisance::shift()];
        let problem = Problem::new(vec![curve], unknowns, &shift, noise).unwrap();
        identify(&toy, &problem, &FitOptions::default()).unwrap()
    }

    fn run(&self, seeds: std::ops::Range<u64>) -> Outcome {
        let normal = 1.959_964;
        let mut outcome = Outcome::default();
        for seed in seeds {
            let fit = self.fit(self.told, seed);
            let found = &fit.estimates[0];
            let [low, high] = found.interval.map(Option::unwrap);
            let known = self.fit(self.real, seed).estimates[0].interval;
            let [least, most] = known.map(Option::unwrap);
            outcome.held += usize::from(low <= MODULUS && MODULUS <= high);
            let real = (high - low) / (most - least);
            outcome.beside_real = outcome.beside_real.max(real);
            let quantile = found.threshold(0.95).sqrt() / normal;
            outcome.beside_estimated = outcome.beside_estimated.max(quantile);
        }
        outcome
    }
}

/// Every kind of knowledge of white noise, for a number of points.
fn white(points: usize) -> Vec<Series> {
    let [depth, force, unknown] = [Amount::Given(0.02), Amount::Given(0.1), Amount::Estimated];
    let part = Amount::Given(0.01);
    let of = |name, real, told| Series {
        name,
        points,
        real,
        told,
    };
    let one = amounts(depth, NONE, NONE);
    let both = amounts(depth, force, NONE);
    let force_alone = amounts(NONE, force, NONE);
    vec![
        of(
            "force told, depth exact",
            force_alone,
            amounts(unknown, force, NONE),
        ),
        of("force told, depth not", both, amounts(unknown, force, NONE)),
        of(
            "depth told, force exact",
            one,
            amounts(depth, unknown, NONE),
        ),
        of("depth told, force not", both, amounts(depth, unknown, NONE)),
        of("both told", both, both),
        of("neither told", one, amounts(unknown, NONE, NONE)),
        of(
            "neither told, both present",
            both,
            amounts(unknown, unknown, NONE),
        ),
        of(
            "relative told, depth not",
            amounts(depth, NONE, part),
            amounts(unknown, NONE, part),
        ),
        of(
            "nothing told of three",
            amounts(depth, force, part),
            amounts(unknown, unknown, unknown),
        ),
    ]
}

/// Noise whose correlation is told, estimated, or only suspected.
fn correlated(points: usize) -> Vec<Series> {
    let with = |correlation, size| Noise {
        correlation,
        ..amounts(size, NONE, NONE)
    };
    let [size, unknown] = [Amount::Given(0.02), Amount::Estimated];
    let told = Correlation::Given {
        persistence: 0.6,
        white_fraction: 0.3,
    };
    let of = |name, real, told| Series {
        name,
        points,
        real,
        told,
    };
    let real = with(told, size);
    vec![
        of("correlated, all told", real, real),
        of(
            "correlated, size told",
            real,
            with(Correlation::Estimated, size),
        ),
        of(
            "correlated, nothing told",
            real,
            with(Correlation::Estimated, unknown),
        ),
        of(
            "white, correlation suspected",
            amounts(size, NONE, NONE),
            with(Correlation::Estimated, unknown),
        ),
    ]
}

#[test]
fn noise_that_is_told_costs_no_degree_of_freedom() {
    // The depth is exact and not told to be: half of the estimates of its noise are at their lower bound.
    let told = white(60)[0];
    let at_bound: Vec<Fit> = (0..20)
        .map(|seed| told.fit(told.told, seed))
        .filter(|fit| fit.noise.observed < 1e-9)
        .collect();
    assert!(at_bound.len() > 3, "{} of 20 at the bound", at_bound.len());
    for fit in at_bound {
        // The normal quantile, to five digits.
        let threshold = fit.estimates[0].threshold(0.95);
        assert!((threshold.sqrt() - 1.959_964).abs() < 1e-4, "{fit:?}");
    }
    for one in white(60) {
        let found = one.run(0..40);
        assert!(found.beside_real < 1.5, "{}: {found:?}", one.name);
        // 38 of 40 on average, 33 with 99 % probability.
        assert!(found.held >= 33, "{}: {found:?}", one.name);
    }
}

#[test]
#[ignore = "400 measurements of each of 13 kinds at three numbers of points: some minutes"]
fn intervals_hold_and_are_no_wider_than_the_likelihoods() {
    let mut faults = Vec::new();
    for points in [24, 60, 240] {
        for (is_white, one) in (white(points).into_iter().map(|one| (true, one)))
            .chain(correlated(points).into_iter().map(|one| (false, one)))
        {
            let found = one.run(0..400);
            let Outcome {
                held,
                beside_real,
                beside_estimated,
            } = found;
            println!(
                "{points:4} {:30} held {held} of 400, widest {beside_real:.2} of real, {beside_estimated:.2} of \
                 estimated noise",
                one.name
            );
            // 368 to 390 with 99 % probability each; of 39 kinds one may lie just outside.
            let limit = if points < 60 { 1.65 } else { 1.51 };
            if !(366..=392).contains(&held)
                || beside_estimated > limit
                || (is_white && points >= 60 && beside_real > 1.5)
            {
                faults.push((points, one.name, found));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}
