//! How often intervals contain the true value.
//!
//! Each test repeats one measurement 400 times with different noise. Intervals of level 0.95 contain the true value 380
//! times on average, with a standard deviation of 4.4: between 368 and 390 times with 99 % probability, by the binomial
//! distribution.

use pellicle_identify::{
    Amount, Correlation, Fit, FitOptions, LinearNuisance, Noise, Problem, Unknown, identify,
};

use super::toys::{
    Normals, Point, Toy, coating, coating_moduli, hertz_modulus, logarithmic, noisy, two_moduli,
    unknown,
};

const REPLICATES: u64 = 400;
const EXPECTED: std::ops::RangeInclusive<usize> = 368..=390;

/// A measurement with seeded noise, and its fit.
struct Measurement {
    law: fn(f64, &[f64]) -> Point,
    truth: Vec<f64>,
    unknowns: Vec<Unknown>,
    forces: Vec<f64>,
    noise: Noise,
    simulate: fn(&mut Normals, &Toy, &[f64]) -> Vec<f64>,
}

impl Measurement {
    fn fit(&self, seed: u64) -> Fit {
        let toy = Toy::new(self.forces.clone(), self.law);
        let observed = (self.simulate)(&mut Normals::new(seed), &toy, &self.truth);
        let curve = noisy(&self.forces, &observed, 0.0, &vec![0.0; observed.len()]);
        let shift = [LinearNuisance::shift()];
        let problem = Problem::new(vec![curve], self.unknowns.clone(), &shift, self.noise).unwrap();
        identify(&toy, &problem, &FitOptions::default()).unwrap()
    }

    /// Counts how often the profile and Wald intervals of each unknown contain the true value.
    fn held(&self, replicates: u64) -> Vec<[usize; 2]> {
        let mut held = vec![[0; 2]; self.truth.len()];
        for seed in 0..replicates {
            let fit = self.fit(seed);
            for ((count, estimate), &truth) in held.iter_mut().zip(&fit.estimates).zip(&self.truth)
            {
                let [low, high] = estimate.interval;
                let profile =
                    low.is_none_or(|low| low <= truth) && high.is_none_or(|high| truth <= high);
                let wald = estimate
                    .wald
                    .is_some_and(|[low, high]| low <= truth && truth <= high);
                count[0] += usize::from(profile);
                count[1] += usize::from(wald);
            }
        }
        held
    }
}

fn assert_coverage(measurement: &Measurement) {
    for (j, count) in measurement.held(REPLICATES).iter().enumerate() {
        assert!(
            EXPECTED.contains(&count[0]),
            "unknown {j}: {} of 400",
            count[0]
        );
    }
}

fn white() -> Measurement {
    Measurement {
        law: coating_moduli,
        truth: vec![10.0, 1.5],
        unknowns: two_moduli(),
        forces: logarithmic(0.01, 100.0, 24),
        noise: Noise::default(),
        simulate: |normals, toy, truth| {
            let values = toy.values(truth);
            values
                .iter()
                .map(|v| 0.3 + v + 0.02 * normals.next())
                .collect()
        },
    }
}

fn correlated() -> Measurement {
    Measurement {
        law: hertz_modulus,
        truth: vec![5.0],
        unknowns: vec![unknown("E", [1.0, 100.0], 10.0)],
        forces: (1..=300).map(|i| 0.1 * f64::from(i)).collect(),
        noise: Noise {
            correlation: Correlation::Estimated,
            ..Noise::default()
        },
        simulate: |normals, toy, truth| {
            let values = toy.values(truth);
            let noise = normals.autoregressive(values.len(), 0.85, 0.2);
            values
                .iter()
                .zip(noise)
                .map(|(v, n)| v + 0.02 * n)
                .collect()
        },
    }
}

fn both_axes() -> Measurement {
    Measurement {
        law: coating_moduli,
        truth: vec![10.0, 1.5],
        unknowns: two_moduli(),
        forces: logarithmic(0.2, 100.0, 40),
        noise: Noise {
            observed: Amount::Given(0.01),
            abscissa: Amount::Given(0.02),
            ..Noise::default()
        },
        simulate: |normals, toy, truth| {
            let actual: Vec<f64> = toy
                .abscissa
                .iter()
                .map(|q| q + 0.02 * normals.next())
                .collect();
            let values = Toy::new(actual, coating_moduli).values(truth);
            values.iter().map(|v| v + 0.01 * normals.next()).collect()
        },
    }
}

/// A coating whose thickness the data hardly determine.
fn weak() -> Measurement {
    Measurement {
        law: coating,
        truth: vec![10.0, 1.5, 1.0],
        unknowns: vec![
            unknown("E1", [0.5, 1000.0], 10.0),
            unknown("E2", [0.01, 10.0], 1.5),
            unknown("H", [0.02, 50.0], 1.0),
        ],
        forces: logarithmic(0.01, 30.0, 24),
        noise: Noise::white(0.02),
        simulate: |normals, toy, truth| {
            let values = toy.values(truth);
            values.iter().map(|v| v + 0.02 * normals.next()).collect()
        },
    }
}

#[test]
fn with_weak_data_the_covariance_covers_too_little_and_the_profile_does_not() {
    let held = weak().held(REPLICATES);
    for (j, count) in held.iter().enumerate() {
        // Only the lower limit: bounds and open sides make a profile cover more than its level, never less.
        assert!(
            count[0] >= *EXPECTED.start(),
            "unknown {j}: {} of 400",
            count[0]
        );
    }
    assert!(
        held.iter().any(|count| count[1] < *EXPECTED.start()),
        "{held:?}"
    );
}

#[test]
fn profiles_cover_under_white_noise_of_unknown_size() {
    assert_coverage(&white());
}

#[test]
fn profiles_cover_under_correlated_noise() {
    assert_coverage(&correlated());
}

#[test]
fn profiles_cover_under_few_correlated_points() {
    // Sixty points with a correlation of 0.85 are worth about five independent ones.
    assert_coverage(&Measurement {
        forces: logarithmic(0.1, 30.0, 60),
        ..correlated()
    });
}

#[test]
fn profiles_cover_under_noise_in_both_axes() {
    assert_coverage(&both_axes());
}

#[test]
fn profiles_cover_under_noise_in_both_axes_of_unknown_size() {
    assert_coverage(&Measurement {
        noise: Noise {
            abscissa: Amount::Estimated,
            ..Noise::default()
        },
        ..both_axes()
    });
}

#[test]
#[ignore = "4000 replicates of three measurements: half a minute"]
fn profiles_cover_in_ten_times_as_many_replicates() {
    for measurement in [white(), correlated(), both_axes()] {
        for (j, count) in measurement.held(10 * REPLICATES).iter().enumerate() {
            // 3800 and three standard deviations of the binomial distribution, 13.8.
            let missed = 3800_usize.abs_diff(count[0]);
            assert!(missed <= 41, "unknown {j}: {} of 4000", count[0]);
        }
    }
}
