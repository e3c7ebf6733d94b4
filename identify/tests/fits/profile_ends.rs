//! Interval ends checked by an independent scan: at each end, the best fit with the unknown held there is worse by the
//! squared quantile, to a hundredth of a standard error. Also counts the predictions needed.

use nalgebra::{DMatrix, DVector};
use pellicle_identify::{
    Fit, FitOptions, LinearNuisance, Noise, Problem, Unknown, Verdict, identify,
};

use super::toys::{Normals, Point, Toy, coating, coating_moduli, logarithmic, noisy, unknown};

/// `z` at the ends of an interval of level 0.95.
const QUANTILE: f64 = 1.959_963_984_540_054;

/// A search with more predictions follows a curved valley: the third coating with three unknowns.
const WINDING: usize = 7;

/// A toy law, its true parameters, and the noise of its 60 points.
struct System {
    law: fn(f64, &[f64]) -> Point,
    truth: &'static [f64],
    forces: [f64; 2],
    sigma: f64,
}

/// Coatings from stiff to soft, thick and thin, with noise from 0.1 to 1 % of a depth of one.
const TWO: [System; 3] = [
    System {
        law: coating_moduli,
        truth: &[10.0, 1.5],
        forces: [0.01, 100.0],
        sigma: 0.002,
    },
    System {
        law: coating_moduli,
        truth: &[10.0, 1.5],
        forces: [0.1, 10.0],
        sigma: 0.005,
    },
    System {
        law: coating_moduli,
        truth: &[0.5, 4.0],
        forces: [0.01, 10.0],
        sigma: 0.005,
    },
];

const THREE: [System; 4] = [
    System {
        law: coating,
        truth: &[10.0, 1.5, 1.0],
        forces: [0.01, 100.0],
        sigma: 0.002,
    },
    System {
        law: coating,
        truth: &[10.0, 1.5, 1.0],
        forces: [0.01, 100.0],
        sigma: 0.006,
    },
    System {
        law: coating,
        truth: &[4.0, 1.0, 0.4],
        forces: [0.001, 100.0],
        sigma: 0.001,
    },
    System {
        law: coating,
        truth: &[0.5, 4.0, 2.0],
        forces: [0.01, 1000.0],
        sigma: 0.01,
    },
];

/// The measured points and their fit.
struct Fitted {
    fit: Fit,
    toy: Toy,
    observed: Vec<f64>,
    sigma: f64,
}

impl System {
    fn fitted(&self, seed: u64) -> Fitted {
        let forces = logarithmic(self.forces[0], self.forces[1], 60);
        let toy = Toy::new(forces.clone(), self.law);
        let noise = Normals::new(seed).white(60);
        let curve = noisy(&forces, &toy.values(self.truth), self.sigma, &noise);
        let observed = curve.observed().to_vec();
        let starts = [1.5, 0.7, 1.3];
        let names = ["E1", "E2", "H"].iter().zip(self.truth).zip(starts);
        let unknowns: Vec<Unknown> = names
            .map(|((name, truth), part)| unknown(name, [0.02 * truth, 50.0 * truth], part * truth))
            .collect();
        let shift = [LinearNuisance::shift()];
        let noise = Noise::white(self.sigma);
        let problem = Problem::new(vec![curve], unknowns, &shift, noise).unwrap();
        let fit = identify(&toy, &problem, &FitOptions::default()).unwrap();
        Fitted {
            fit,
            toy,
            observed,
            sigma: self.sigma,
        }
    }
}

impl Fitted {
    /// Minimises `χ²` over the shift and all parameters except the one held, by Gauss–Newton in logarithms.
    fn least(&self, start: &[f64], held: Option<usize>) -> (f64, Vec<f64>) {
        let free: Vec<usize> = (0..start.len()).filter(|j| Some(*j) != held).collect();
        let mut parameters = start.to_vec();
        let mut best = f64::INFINITY;
        for _ in 0..200 {
            let points = self.toy.points(&parameters);
            let count = points.len();
            let matrix = DMatrix::from_fn(count, free.len() + 1, |i, k| {
                free.get(k).map_or(1.0, |&j| points[i].2[j] * parameters[j]) / self.sigma
            });
            let residual =
                DVector::from_fn(count, |i, _| (self.observed[i] - points[i].0) / self.sigma);
            let step = matrix
                .clone()
                .svd(true, true)
                .solve(&residual, 1e-14)
                .unwrap();
            // With only the best shift subtracted.
            let mean = residual.mean();
            best = residual.iter().map(|r| (r - mean).powi(2)).sum();
            let longest = step.rows(0, free.len()).amax();
            if longest < 1e-10 {
                break;
            }
            let part = (0.3 / longest).min(1.0);
            for (k, &j) in free.iter().enumerate() {
                parameters[j] *= (part * step[k]).exp();
            }
        }
        (best, parameters)
    }

    /// The distances, in standard errors, between the ends of an unknown's interval and those of the scan.
    fn misses(&self, unknown: usize) -> Vec<f64> {
        let values: Vec<f64> = self.fit.estimates.iter().map(|of| of.value).collect();
        let (least, best) = self.least(&values, None);
        let ends = self.fit.estimates[unknown].interval.into_iter().flatten();
        let miss = |end: f64| {
            // Outward in steps, so that the others can follow.
            let mut parameters = best.clone();
            let mut found = least;
            for step in 1..=20 {
                let part = f64::from(step) / 20.0;
                parameters[unknown] = best[unknown] * (end / best[unknown]).powf(part);
                (found, parameters) = self.least(&parameters, Some(unknown));
            }
            (found - least).sqrt() - QUANTILE
        };
        ends.map(miss).collect()
    }
}

fn assert_ends(systems: &[System], most: usize) {
    let mut winding = 0;
    for (index, system) in systems.iter().enumerate() {
        for seed in 0..5 {
            let fitted = system.fitted(seed);
            let work = fitted.fit.work;
            let is_determined = |verdict| matches!(verdict, Verdict::Identified | Verdict::Weak);
            assert!(
                fitted
                    .fit
                    .estimates
                    .iter()
                    .all(|of| is_determined(of.verdict)),
                "{index} {seed}: {:?}",
                fitted.fit.estimates
            );
            let unknowns = 0..system.truth.len();
            let misses: Vec<f64> = unknowns.flat_map(|j| fitted.misses(j)).collect();
            let worst = misses
                .iter()
                .fold(0.0, |worst: f64, miss| worst.max(miss.abs()));
            assert!(worst < 0.01, "{index} {seed}: {misses:?}");
            // Two per end, and one to check that no other valley is lower there.
            let ends = 2 * system.truth.len();
            assert!(
                work.curves_solved - work.search <= 2 * ends + 1,
                "{index} {seed}: {work:?}"
            );
            let is_winding = work.search > WINDING;
            assert!(
                is_winding || work.curves_solved <= most,
                "{index} {seed}: {work:?}"
            );
            winding += usize::from(is_winding);
        }
    }
    // One system out of four, and one fit of another.
    assert!(winding <= 6, "{winding}");
}

#[test]
fn two_unknowns_with_accurate_interval_ends_take_at_most_thirteen_predictions() {
    assert_ends(&TWO, 13);
}

#[test]
fn three_unknowns_with_accurate_interval_ends_take_at_most_twenty_predictions() {
    assert_ends(&THREE, 20);
}
