//! How often a wrong model of a coating is refused, and a right one accepted.
//!
//! Each measurement has 100 points with noise of 1 % of the depth and its own zero. Its fit seeks both moduli of a
//! half-micrometre coating on a half-space under a ball of ten micrometres, on curves interpolated from the real model.

use std::f64::consts::FRAC_PI_2;

use pellicle_contact::{Cone, Indenter, Model, Paraboloid};
use pellicle_identify::{
    Amount, ContactCurve, ContactCurves, Curve, CurveOptions, Fit, FitOptions, FitVerdict,
    ForwardModel as _, LinearNuisance, Noise, Observable, Problem, Unknown, identify,
};
use pellicle_influence::{Cache, ElasticBodies};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::Relief;
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};
use rayon::prelude::*;

use super::coating::{Coating, coating};
use super::interpolant::Interpolant;

const NOISE: f64 = 0.01;

/// Values of each modulus at which the real model is solved.
const NODES: usize = 7;

/// The coating, the unknowns and the curves of a fit.
struct Fitted {
    coating: Coating,
    unknowns: Vec<Unknown>,
    curves: Interpolant,
}

/// Outcomes of a set of fits.
#[derive(Debug, Clone, Copy, Default)]
struct Ends {
    refused: usize,
    /// Not refused, with both true values in their intervals.
    held: usize,
}

impl Fitted {
    fn new() -> Self {
        let coating = Coating {
            points: 100,
            ..coating(10e-6)
        };
        let ranges = [[30e9, 300e9], [4e9, 25e9]];
        let unknowns: Vec<Unknown> = ["E1", "E2"]
            .iter()
            .zip(ranges)
            .map(|(name, range)| Unknown::positive(*name, range).unwrap())
            .collect();
        let curves = Interpolant::over(&coating.curves(2), &ranges, NODES);
        Self {
            coating,
            unknowns,
            curves,
        }
    }

    fn fit(&self, depths: &[f64], seed: u64) -> Fit {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let read = depths.iter().map(|d| d * (1.0 + NOISE * normal()) + 3e-9);
        let curve = Curve::new(self.coating.forces(), read.collect()).unwrap();
        let noise = Noise {
            observed: Amount::Given(0.0),
            relative: Amount::Estimated,
            ..Noise::default()
        };
        let shift = [LinearNuisance::shift()];
        let problem = Problem::new(vec![curve], self.unknowns.clone(), &shift, noise).unwrap();
        identify(&self.curves, &problem, &FitOptions::default()).unwrap()
    }

    fn fits(&self, depths: &[f64], replicates: u64) -> Ends {
        let truth = self.coating.truth();
        let held = |fit: &Fit| {
            fit.estimates.iter().zip(truth).all(|(estimate, truth)| {
                let [low, high] = estimate.interval;
                low.is_none_or(|low| low <= truth) && high.is_none_or(|high| truth <= high)
            })
        };
        let fits: Vec<Fit> = (0..replicates)
            .into_par_iter()
            .map(|seed| self.fit(depths, seed))
            .collect();
        let refused = |fit: &&Fit| fit.verdict == FitVerdict::Misfit;
        Ends {
            refused: fits.iter().filter(refused).count(),
            held: fits.iter().filter(|fit| !refused(fit) && held(fit)).count(),
        }
    }

    /// Depths of a real model.
    fn depths(&self, layers: &[(f64, f64)], indenter: Indenter) -> Vec<f64> {
        let layers = layers.iter().map(|&(thickness, modulus)| {
            let material = Material::new(modulus, self.coating.layer.1).unwrap();
            Layer::new(thickness, material, Interface::Bonded).unwrap()
        });
        let base =
            Base::HalfSpace(Material::new(self.coating.base.0, self.coating.base.1).unwrap());
        let bodies: ElasticBodies = Foundation::new(layers.collect(), base).unwrap().into();
        let cache = Cache::of_shapes();
        let curve = ContactCurve {
            model: Model {
                tables: cache.radial_tables_of(&bodies).unwrap().value,
                relief: Relief::Bare,
                indenter,
                cache,
            },
            observable: Observable::DepthAtForce,
            abscissae: self.coating.forces(),
            own: Vec::new(),
            origins: Vec::new(),
            series: 0.0,
            thinned: None,
            adhesion: None,
        };
        let curves = ContactCurves::new(vec![curve], Vec::new(), CurveOptions::default()).unwrap();
        curves.predict(&[]).unwrap().value
    }

    /// Depths of the model itself.
    fn true_depths(&self) -> Vec<f64> {
        self.curves
            .predict(&self.coating.truth()[..2])
            .unwrap()
            .value
    }

    /// Depths that grow a tenth faster beyond `yield_force`.
    fn yielding_depths(&self, yield_force: f64) -> Vec<f64> {
        let elastic = self.true_depths();
        let forces = self.coating.forces();
        let first = forces
            .iter()
            .position(|force| *force > yield_force)
            .unwrap();
        let beyond = |depth: &f64| depth + 0.1 * (depth - elastic[first]).max(0.0);
        elastic.iter().map(beyond).collect()
    }
}

fn ball(radius: f64) -> Indenter {
    Paraboloid::new(radius).unwrap().into()
}

#[test]
fn wrong_models_of_a_coating_are_refused_and_a_right_one_is_not() {
    let fitted = Fitted::new();
    let one = [(0.5e-6, 100e9)];
    let two = [(0.25e-6, 100e9), (0.25e-6, 20e9)];
    let cone = Cone::new(FRAC_PI_2 - 0.35, 0.0).unwrap();
    let wrong = [
        ("a layer more", fitted.depths(&two, ball(10e-6))),
        ("a cone", fitted.depths(&one, cone.into())),
        ("a yield at 0.3 mN", fitted.yielding_depths(0.3e-3)),
    ];
    for (name, depths) in &wrong {
        let ends = fitted.fits(depths, 100);
        println!("{name}: {ends:?}");
        assert!(ends.refused + ends.held >= 95, "{name}: {ends:?}");
    }
    let ends = fitted.fits(&fitted.true_depths(), 400);
    println!("right: {ends:?}");
    assert!(ends.refused <= 4, "{ends:?}");
    // Both true values in their intervals of level 0.95, less four standard deviations of a binomial variable.
    assert!(ends.held >= 340, "{ends:?}");
}

/// Negative control: an error that no test can find.
#[test]
fn a_ball_of_another_radius_gives_other_moduli_and_nearly_the_same_curve() {
    let fitted = Fitted::new();
    for radius in [7e-6, 13e-6] {
        let ends = fitted.fits(&fitted.depths(&[(0.5e-6, 100e9)], ball(radius)), 100);
        println!("{radius}: {ends:?}");
        assert!(ends.refused <= 20 && ends.held <= 20, "{radius}: {ends:?}");
    }
}
