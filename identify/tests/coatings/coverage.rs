//! How often intervals for coatings contain the true value.
//!
//! Measurements are simulated and fitted on curves interpolated from the real model. Of 400 intervals of level 0.95,
//! between 368 and 390 contain the true value with 99 % probability, by the binomial distribution.

use pellicle_identify::{
    Amount, Correlation, Curve, Fit, FitOptions, ForwardModel as _, LinearNuisance, Noise, Problem,
    Unknown, identify,
};
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};
use rayon::prelude::*;

use super::coating::{Coating, coating};
use super::interpolant::Interpolant;

const EXPECTED: std::ops::RangeInclusive<usize> = 368..=390;

/// Relative noise of the depth.
const RELATIVE: f64 = 0.01;

/// Noise of the force as a fraction of the smallest force.
const OF_FORCE: f64 = 0.02;

const PERSISTENCE: f64 = 0.85;

/// Values of each unknown at which the real model is solved.
const NODES: usize = 5;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// White, of unknown size.
    White,
    /// Autoregressive, of unknown size and correlation.
    Correlated,
    /// White in depth and force, of known size.
    BothAxes,
}

/// A coating and the bounds of its unknowns.
struct System {
    coating: Coating,
    sides: Vec<[f64; 2]>,
}

/// Half a micrometre of 100 GPa on 10 GPa: both moduli.
fn stiff() -> System {
    System {
        coating: coating(10e-6),
        sides: vec![[60e9, 170e9], [8e9, 12.5e9]],
    }
}

/// Half a micrometre of 1 GPa on 100 GPa: both moduli.
fn soft() -> System {
    System {
        coating: Coating {
            layer: (1e9, 0.45),
            base: (100e9, 0.3),
            ..coating(10e-6)
        },
        sides: vec![[0.7e9, 1.4e9], [30e9, 300e9]],
    }
}

/// A micrometre and a half of 100 GPa on 10 GPa: the moduli and the thickness, which are correlated.
fn weak() -> System {
    System {
        coating: Coating {
            thickness: 1.5e-6,
            ..coating(100e-6)
        },
        sides: vec![[60e9, 160e9], [3e9, 25e9], [0.45e-6, 5e-6]],
    }
}

/// Number of forces for a kind of noise: 24 points are too few to estimate a correlation.
fn points(kind: Kind) -> u32 {
    if kind == Kind::Correlated { 240 } else { 24 }
}

/// A system whose curves are free to compute.
struct Simulated {
    curves: Interpolant,
    unknowns: Vec<Unknown>,
    truth: Vec<f64>,
    forces: Vec<f64>,
    kind: Kind,
}

impl Simulated {
    fn new(system: &System, kind: Kind) -> Self {
        let coating = Coating {
            points: points(kind),
            ..system.coating
        };
        let count = system.sides.len();
        let unknowns: Vec<Unknown> = ["E1", "E2", "H"]
            .iter()
            .zip(&system.sides)
            .map(|(name, side)| Unknown::positive(*name, *side).unwrap())
            .collect();
        let model = coating.curves(count);
        Self {
            // The interpolated curves are the truth here, so they need not match the coating to the last digit.
            curves: Interpolant::over(&model, &system.sides, NODES),
            unknowns,
            truth: coating.truth()[..count].to_vec(),
            forces: coating.forces(),
            kind,
        }
    }

    fn noise(&self) -> Noise {
        let relative = Noise {
            observed: Amount::Given(0.0),
            relative: Amount::Estimated,
            ..Noise::default()
        };
        match self.kind {
            Kind::White => relative,
            Kind::Correlated => Noise {
                correlation: Correlation::Estimated,
                ..relative
            },
            Kind::BothAxes => Noise {
                relative: Amount::Given(RELATIVE),
                abscissa: Amount::Given(OF_FORCE * self.forces[0]),
                ..relative
            },
        }
    }

    /// The depths of one measurement, with a zero that is off by a fraction of the first depth.
    fn measured(&self, seed: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let curve = self.curves.predict(&self.truth).unwrap();
        let zero = 0.3 * curve.value[0];
        let mut state = normal();
        let pairs = curve.value.iter().zip(&curve.slope);
        pairs
            .map(|(value, slope)| {
                let of_depth = match self.kind {
                    Kind::White | Kind::BothAxes => normal(),
                    Kind::Correlated => {
                        let now = state;
                        let drive = (1.0 - PERSISTENCE * PERSISTENCE).sqrt();
                        state = PERSISTENCE * state + drive * normal();
                        now
                    }
                };
                let of_force = match self.kind {
                    Kind::White | Kind::Correlated => 0.0,
                    Kind::BothAxes => slope * OF_FORCE * self.forces[0] * normal(),
                };
                zero + value * (1.0 + RELATIVE * of_depth) + of_force
            })
            .collect()
    }

    fn fit(&self, seed: u64) -> Fit {
        let curve = Curve::new(self.forces.clone(), self.measured(seed)).unwrap();
        let shift = [LinearNuisance::shift()];
        let unknowns = self.unknowns.clone();
        let problem = Problem::new(vec![curve], unknowns, &shift, self.noise()).unwrap();
        identify(&self.curves, &problem, &FitOptions::default()).unwrap()
    }

    /// Counts, for each unknown, the profile and Wald intervals that contain the truth, and the open profiles.
    fn held(&self, replicates: u64) -> Vec<[usize; 3]> {
        let fits: Vec<Fit> = (0..replicates)
            .into_par_iter()
            .map(|seed| self.fit(seed))
            .collect();
        let count = |j: usize, of: &dyn Fn(&pellicle_identify::Estimate) -> bool| {
            fits.iter().filter(|fit| of(&fit.estimates[j])).count()
        };
        let each = self.truth.iter().enumerate();
        each.map(|(j, truth)| {
            let profile = count(j, &|one| {
                let [low, high] = one.interval;
                low.is_none_or(|low| low <= *truth) && high.is_none_or(|high| *truth <= high)
            });
            let wald = count(j, &|one| {
                one.wald
                    .is_some_and(|[low, high]| low <= *truth && *truth <= high)
            });
            [profile, wald, count(j, &|one| one.interval.contains(&None))]
        })
        .collect()
    }
}

#[test]
fn nearly_all_of_forty_coating_intervals_contain_the_truth() {
    for count in Simulated::new(&stiff(), Kind::White).held(40) {
        // 38, less three and a half standard deviations of the binomial distribution, 1.4.
        assert!(count[0] >= 33, "{count:?}");
    }
}

/// The increase of χ² over the best fit at other moduli and thickness, with the optimal zero.
fn worse_by(simulated: &Simulated, fit: &Fit, observed: &[f64], parameters: &[f64]) -> f64 {
    let model = simulated.curves.predict(parameters).unwrap().value;
    let shift = fit.coefficients[0].value;
    let weights: Vec<f64> = (fit.points.model.iter())
        .map(|depth| (fit.noise.relative * (depth - shift)).powi(-2))
        .collect();
    let rest: Vec<f64> = observed.iter().zip(&model).map(|(y, f)| y - f).collect();
    let zero = dot(&weights, &rest) / weights.iter().sum::<f64>();
    let of_one = |(weight, rest): (&f64, &f64)| weight * (rest - zero).powi(2);
    let sum: f64 = weights.iter().zip(&rest).map(of_one).sum();
    let least: f64 = fit.points.whitened.iter().map(|r| r * r).sum();
    sum - least
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn a_profile_with_two_valleys_ends_where_the_lower_one_does() {
    let simulated = Simulated::new(&weak(), Kind::White);
    // At the upper end E2 is at its bound, 3 GPa, in one valley, and 8 GPa in the other.
    for seed in [115, 243] {
        let fit = simulated.fit(seed);
        let observed = simulated.measured(seed);
        let modulus = &fit.estimates[0];
        let end = modulus.interval[1].unwrap();
        let grid =
            |range: [f64; 2], i: i32| range[0] * (range[1] / range[0]).powf(f64::from(i) / 60.0);
        let least_along = |i: i32| {
            (0..=60)
                .map(|k| [end, grid([3e9, 25e9], i), grid([0.45e-6, 5e-6], k)])
                .map(|values| worse_by(&simulated, &fit, &observed, &values))
                .fold(f64::INFINITY, f64::min)
        };
        let least: Vec<f64> = (0..=60_i32).into_par_iter().map(least_along).collect();
        let least = least.into_iter().fold(f64::INFINITY, f64::min);
        let target = modulus.threshold(0.95);
        // Scans end within a twentieth of the target; the 4 % grid finds no less than the profile, and at most a few
        // tenths more.
        assert!(
            (0.9 * target..1.3 * target).contains(&least),
            "{seed}: {least} {target}"
        );
    }
}

#[test]
#[ignore = "six minutes in release on two busy cores"]
fn profile_intervals_of_coatings_cover_as_stated_and_covariances_of_weak_ones_do_not() {
    let mut failed = Vec::new();
    let mut weak_covariances = false;
    for (name, system) in [("weak", weak()), ("soft", soft()), ("stiff", stiff())] {
        for kind in [Kind::White, Kind::Correlated, Kind::BothAxes] {
            let simulated = Simulated::new(&system, kind);
            let held = simulated.held(400);
            println!("{name} {kind:?}: {held:?}");
            if held.iter().any(|count| !EXPECTED.contains(&count[0])) {
                failed.push((name, kind, held.clone()));
            }
            let wald_fails = held.iter().any(|count| count[1] < *EXPECTED.start());
            weak_covariances |= name == "weak" && wald_fails;
        }
    }
    assert!(weak_covariances);
    assert!(failed.is_empty(), "{failed:?}");
}
