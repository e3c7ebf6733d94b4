//! Oliver and Pharr's numbers of curves that follow their relations.

use pellicle_identify::indentation::{
    AreaFunction, DepthZero, Drift, Epsilon, EvaluatedCurve, EvaluationSettings, IndentationCurve,
    IndentationError, IndentationNumber, IndenterMaterial, Uncertain, evaluate,
};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// An indentation made by the relations themselves.
#[derive(Debug, Clone, Copy)]
struct Synthetic {
    modulus: f64,
    ratio: f64,
    hardness: f64,
    contact_depth: f64,
    exponent: f64,
    drift: f64,
    frame: f64,
    /// Noise of depths and forces.
    noise: [f64; 2],
    /// Seconds of loading, hold, unloading to a tenth, and hold there.
    times: [f64; 4],
    step: f64,
    /// Part of the largest depth that comes in the hold, fast at first.
    creep: f64,
}

const DIAMOND: IndenterMaterial = IndenterMaterial {
    young_modulus: Uncertain {
        value: 1141e9,
        sd: 0.0,
    },
    poisson_ratio: Uncertain {
        value: 0.07,
        sd: 0.0,
    },
};

const SILICA: Synthetic = Synthetic {
    modulus: 72e9,
    ratio: 0.17,
    hardness: 9.5e9,
    contact_depth: 180e-9,
    exponent: 1.3,
    drift: 2e-11,
    frame: 3e-7,
    noise: [0.15e-9, 0.2e-6],
    times: [10.0, 10.0, 9.0, 60.0],
    step: 0.05,
    creep: 0.0,
};

impl Synthetic {
    fn area(&self) -> f64 {
        24.5 * self.contact_depth.powi(2)
    }

    fn reduced(&self) -> f64 {
        let body = (1.0 - self.ratio.powi(2)) / self.modulus;
        1.0 / (body + (1.0 - 0.07_f64.powi(2)) / 1141e9)
    }

    fn force(&self) -> f64 {
        self.hardness * self.area()
    }

    fn stiffness(&self) -> f64 {
        2.0 / std::f64::consts::PI.sqrt() * self.reduced() * self.area().sqrt()
    }

    fn max_depth(&self) -> f64 {
        self.contact_depth + 0.75 * self.force() / self.stiffness()
    }

    fn final_depth(&self) -> f64 {
        self.max_depth() - self.exponent * self.force() / self.stiffness()
    }

    /// Times, depths and forces.
    fn curve(&self, seed: u64) -> [Vec<f64>; 3] {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let [load, hold, unload, low] = self.times;
        let (force, deepest, last) = (self.force(), self.max_depth(), self.final_depth());
        let mut found = [Vec::new(), Vec::new(), Vec::new()];
        let mut time = self.step;
        while time < load + hold + unload + low + 1.0 {
            let back = |p: f64| last + (deepest - last) * (p / force).powf(1.0 / self.exponent);
            let crept = |part: f64| {
                let since = (1.0 + 50.0 * part).ln() / 51.0_f64.ln();
                deepest * (1.0 - self.creep * (1.0 - since))
            };
            let (p, h) = if time < load {
                let p = force * time / load;
                (p, crept(0.0) * (p / force).sqrt())
            } else if time < load + hold {
                (force, crept((time - load) / hold))
            } else if time < load + hold + unload {
                let p = force * (1.0 - 0.9 * (time - load - hold) / unload);
                (p, back(p))
            } else if time < load + hold + unload + low {
                (0.1 * force, back(0.1 * force))
            } else {
                let p = 0.1 * force * (1.0 - 0.9 * (time - load - hold - unload - low));
                (p, back(p))
            };
            let [dh, dp]: [f64; 2] = self
                .noise
                .map(|sd| sd * Distribution::<f64>::sample(&StandardNormal, &mut random));
            found[0].push(time);
            found[1].push(h + self.drift * time + self.frame * p + dh);
            found[2].push(p + dp);
            time += self.step;
        }
        found
    }

    fn settings(&self) -> EvaluationSettings {
        EvaluationSettings {
            area: Some(AreaFunction::Polynomial(vec![24.5])),
            area_covariance: Vec::new(),
            area_range: None,
            beta: Uncertain::exact(1.0),
            epsilon: Epsilon::Fixed(Uncertain::exact(0.75)),
            unloading: [0.95, 0.40],
            frame_compliance: Uncertain::exact(self.frame),
            drift: Drift::Hold,
            depth_zero: DepthZero::AsRecorded,
            poisson_ratio: Uncertain::exact(self.ratio),
            indenter: Some(DIAMOND),
            thinning: 0.0,
            calibrate: None,
        }
    }

    fn evaluated(&self, seed: u64) -> Result<EvaluatedCurve, IndentationError> {
        let [time, depth, force] = self.curve(seed);
        let curve = IndentationCurve {
            time: Some(&time),
            depth: &depth,
            force: &force,
            first_contact: None,
        };
        evaluate(curve, &self.settings())
    }

    fn truth(&self) -> [(IndentationNumber, f64); 8] {
        // ∫ P dh of the loading and the hold, and of the law.
        let (force, deepest) = (self.force(), self.max_depth());
        let before = deepest * (1.0 - self.creep);
        let work = force * (before / 3.0 + deepest - before);
        let back = force * (deepest - self.final_depth()) / (self.exponent + 1.0);
        [
            (IndentationNumber::ElasticWorkRatio, back / work),
            (IndentationNumber::MaxDepth, deepest),
            (IndentationNumber::IndentationModulus, self.modulus),
            (IndentationNumber::IndentationHardness, self.hardness),
            (IndentationNumber::ContactDepth, self.contact_depth),
            (IndentationNumber::ContactStiffness, self.stiffness()),
            (IndentationNumber::ReducedModulus, self.reduced()),
            (IndentationNumber::DriftRate, self.drift),
        ]
    }
}

/// Materials, exponents, drifts and frames at random.
fn random(seed: u64) -> Synthetic {
    let mut random = ChaCha8Rng::seed_from_u64(1000 + seed);
    let mut between = |low: f64, high: f64| low * (high / low).powf(random.random::<f64>());
    let modulus = between(5e9, 300e9);
    Synthetic {
        modulus,
        hardness: modulus * between(0.02, 0.1),
        contact_depth: between(60e-9, 1e-6),
        exponent: between(1.2, 1.7),
        drift: between(0.005e-9, 0.1e-9) * if seed.is_multiple_of(2) { 1.0 } else { -1.0 },
        frame: between(0.05e-6, 0.5e-6),
        ..SILICA
    }
}

#[test]
fn a_curve_without_noise_gives_its_numbers_to_rounding() {
    let exact = Synthetic {
        noise: [0.0; 2],
        drift: 0.0,
        ..SILICA
    };
    let found = exact.evaluated(1).unwrap();
    for (number, truth) in exact.truth() {
        let value = found.numbers.get(number).unwrap().value;
        // Works are sums over the points.
        let accuracy = match number {
            IndentationNumber::ElasticWorkRatio => 1e-3,
            _ => 1e-6,
        };
        assert!(
            (value - truth).abs() <= accuracy * truth.abs() + 1e-15,
            "{number:?}: {value} {truth}"
        );
    }
}

#[test]
fn a_loading_tells_where_the_contact_begins() {
    let [mut time, mut depth, mut force] = SILICA.curve(3);
    let evaluated = |[time, depth, force]: [&[f64]; 3], first, zero| {
        let curve = IndentationCurve {
            time: Some(time),
            depth,
            force,
            first_contact: first,
        };
        let settings = EvaluationSettings {
            depth_zero: zero,
            ..SILICA.settings()
        };
        evaluate(curve, &settings).unwrap()
    };
    // A depth that is off is told, and taken out on demand.
    depth.iter_mut().for_each(|depth| *depth += 10e-9);
    let all = [&time[..], &depth, &force];
    let begins = evaluated(all, None, DepthZero::FirstContactIfFound)
        .begins
        .unwrap();
    assert!(
        (begins.value - 10e-9).abs() < 3.0 * begins.sd && begins.sd < 1e-9,
        "{begins:?}"
    );
    let found = evaluated(all, None, DepthZero::FirstContact).numbers;
    let contact = found.get(IndentationNumber::ContactDepth).unwrap();
    assert!(
        (contact.value - 180e-9).abs() < 3.0 * contact.sd,
        "{contact:?}"
    );
    // After a stretch without contact it is taken out by default.
    let before = 100;
    time.iter_mut().for_each(|time| *time += 5.0);
    for list in [&mut time, &mut depth, &mut force] {
        list.splice(0..0, vec![0.0; before]);
    }
    for i in 0..before {
        time[i] = 0.05 * (1 + i) as f64;
        depth[i] = 10e-9 - 60e-9 * (1.0 - i as f64 / before as f64);
    }
    let all = [&time[..], &depth, &force];
    let found = evaluated(all, Some(before), DepthZero::FirstContactIfFound).numbers;
    let contact = found.get(IndentationNumber::ContactDepth).unwrap();
    assert!(
        (contact.value - 180e-9).abs() < 3.0 * contact.sd,
        "{contact:?}"
    );
}

#[test]
fn a_short_hold_after_a_slow_unloading_gives_the_drift() {
    let slow = Synthetic {
        times: [60.0, 5.0, 90.0, 20.0],
        ..SILICA
    };
    let found = slow.evaluated(1).unwrap();
    let Uncertain { value, sd } = found.numbers.get(IndentationNumber::DriftRate).unwrap();
    assert!((value - slow.drift).abs() < 3.0 * sd, "{value} ± {sd}");
}

/// 95 % intervals of normal errors hold in 186 to 195 of 200 with 90 % probability; the noise, of which only 90 points
/// or so tell, makes them Student's.
#[test]
fn the_intervals_hold_in_180_to_196_of_200_curves() {
    let mut held = [0; 8];
    for seed in 0..200 {
        let synthetic = random(seed);
        let found = synthetic.evaluated(seed).unwrap();
        for (place, (number, truth)) in synthetic.truth().into_iter().enumerate() {
            let Uncertain { value, sd } = found.numbers.get(number).unwrap();
            held[place] += usize::from((value - truth).abs() <= 1.96 * sd);
        }
    }
    for of_number in held {
        assert!((180..=197).contains(&of_number), "{held:?}");
    }
}

#[test]
fn a_hold_of_few_points_before_a_longer_one_is_found_with_its_creep() {
    for seed in 0..20 {
        let few = Synthetic {
            creep: 0.1,
            step: 0.25,
            ..SILICA
        };
        let found = few.evaluated(seed).unwrap();
        let truth = few.truth().into_iter();
        let creep = (IndentationNumber::Creep, few.creep / (1.0 - few.creep));
        for (number, truth) in truth.chain([creep]) {
            let Uncertain { value, sd } = found.numbers.get(number).unwrap();
            // The work before the first point is missing, 0.4 % of all.
            let missing = match number {
                IndentationNumber::ElasticWorkRatio => 0.005 * truth,
                _ => 0.0,
            };
            let error = (value - truth).abs();
            let most = 4.0 * sd + missing;
            assert!(error < most, "{number:?}: {value} ± {sd} for {truth}");
        }
    }
}
