//! Intervals where the noise is told, told in part, and not told.
//!
//! Each measurement is fitted twice: with what is told of the noise, and with the noise it really has, whose interval
//! is that of the likelihood. The first must contain the true value as often as it claims, and must not be much wider
//! than the second.

use pellicle_identify::{
    Amount, Correlation, Curve, Fit, FitOptions, LinearNuisance, Noise, Problem, identify,
};

use crate::toys::{Normals, Toy, hertz_modulus, logarithmic, unknown};

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
#[derive(Debug)]
struct Outcome {
    /// Intervals that contain the true value.
    held: usize,
    /// Largest ratio of an interval to that of the likelihood with the noise known.
    widest: f64,
    /// Fits without a closed interval.
    open: usize,
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

    fn run(&self, seeds: u64) -> Outcome {
        let mut outcome = Outcome {
            held: 0,
            widest: 0.0,
            open: 0,
        };
        for seed in 0..seeds {
            let interval = |noise| self.fit(noise, seed).estimates[0].interval;
            let ([Some(low), Some(high)], [Some(least), Some(most)]) =
                (interval(self.told), interval(self.real))
            else {
                outcome.open += 1;
                continue;
            };
            outcome.held += usize::from(low <= MODULUS && MODULUS <= high);
            outcome.widest = outcome.widest.max((high - low) / (most - least));
        }
        outcome
    }
}

/// Every kind of knowledge, for a number of points.
fn series(points: usize) -> Vec<Series> {
    let [depth, force] = [Amount::Given(0.02), Amount::Given(0.1)];
    let correlation = Correlation::Given {
        persistence: 0.6,
        white_fraction: 0.3,
    };
    let of = |name, real, told| Series {
        name,
        points,
        real,
        told,
    };
    let correlated = |noise| Noise {
        correlation,
        ..noise
    };
    let estimated = |noise| Noise {
        correlation: Correlation::Estimated,
        ..noise
    };
    let one = amounts(depth, NONE, NONE);
    let both = amounts(depth, force, NONE);
    let unknown = Amount::Estimated;
    vec![
        of(
            "force told, depth exact",
            amounts(NONE, force, NONE),
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
            amounts(depth, NONE, Amount::Given(0.01)),
            amounts(unknown, NONE, Amount::Given(0.01)),
        ),
        of(
            "nothing told of three",
            amounts(depth, force, Amount::Given(0.01)),
            amounts(unknown, unknown, unknown),
        ),
        of("correlated, all told", correlated(one), correlated(one)),
        of("correlated, size told", correlated(one), estimated(one)),
        of(
            "correlated, nothing told",
            correlated(one),
            estimated(amounts(unknown, NONE, NONE)),
        ),
        of(
            "white, correlation allowed",
            one,
            estimated(amounts(unknown, NONE, NONE)),
        ),
    ]
}

#[test]
#[ignore = "study"]
fn study() {
    for points in [24, 60, 240] {
        for one in series(points) {
            let found = one.run(400);
            println!(
                "{points:4} {:30} held {} widest {:.2} open {}",
                one.name, found.held, found.widest, found.open
            );
        }
    }
}
