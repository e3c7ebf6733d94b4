//! A soft film under the pyramid (Figs. 5 and 6).

use super::cases::PaperCase;
use super::fields::SolvedFields;
use super::loading::{LoadingCurve, range};
use super::numbers::assert_reads;

/// A twentieth exceeds the error of areas and peaks on these grids, and the variation of r² between grids.
const CLEAR: f64 = 0.05;
/// A tenth is visible in a plot and exceeds the error of ∂D/∂Q on these grids.
const DIFFERENT: f64 = 0.1;
/// Losing half of the effect is the least that counts as fading while the load grows more than two-hundredfold.
const FADED: f64 = 0.5;

/// The step of Fig. 5, the last of Fig. 6.
const FIG5: usize = 18;

/// The film's effect at each load: a quantity with the film over that without, minus 1.
fn effect(elements: usize, quantity: impl Fn(LoadingCurve) -> Vec<f64>) -> Vec<f64> {
    let [with, without] = [true, false]
        .map(|film| quantity(LoadingCurve::of(PaperCase::Berkovich { film }, elements)));
    with.iter()
        .zip(&without)
        .map(|(with, without)| with / without - 1.0)
        .collect()
}

/// Squared correlation of the pressure with the indenter's height over the contact: on springs alone `p = (D − f)/η`,
/// the indenter's shape inverted, and it is 1.
fn likeness_to_the_indenter(film: bool, elements: usize) -> f64 {
    let fields = SolvedFields::of(PaperCase::Berkovich { film }, FIG5, elements);
    let height = &fields.geometry.indenter_profile;
    let contact: Vec<[f64; 2]> = fields
        .contact()
        .map(|i| [fields.pressure[i], height[i]])
        .collect();
    let count = contact.len() as f64;
    let mean = [0, 1].map(|k| contact.iter().map(|pair| pair[k]).sum::<f64>() / count);
    let product = |j: usize, k: usize| -> f64 {
        contact
            .iter()
            .map(|pair| (pair[j] - mean[j]) * (pair[k] - mean[k]))
            .sum()
    };
    product(0, 1).powi(2) / (product(0, 0) * product(1, 1))
}

#[test]
fn with_the_film_the_contact_area_is_larger() {
    for (elements, written) in [(256, "79.5 %"), (512, "80.2 %")] {
        let excess = effect(elements, |curve| curve.contact_area)[FIG5];
        assert_reads(excess, written);
        assert!(excess > CLEAR);
    }
}

#[test]
fn with_the_film_the_largest_pressure_is_lower_at_every_load() {
    for elements in [256, 512] {
        let [lowest, highest] = range(&effect(elements, |curve| curve.max_pressure));
        assert_reads(-highest, "35.3 %");
        assert_reads(-lowest, "58.1 %");
        assert!(-highest > CLEAR);
    }
}

#[test]
fn with_the_film_the_pressure_is_closer_to_a_pyramid() {
    for elements in [256, 512] {
        let [with, without] = [true, false].map(|film| likeness_to_the_indenter(film, elements));
        assert_reads(with, "0.917");
        assert_reads(without, "0.719");
        assert!(with - without > CLEAR);
    }
}

#[test]
fn near_zero_load_the_gradients_with_and_without_the_film_differ() {
    for (elements, written) in [(256, "49.8 %"), (512, "47.5 %")] {
        let first = effect(elements, |curve| curve.gradient)[0];
        assert_reads(first, written);
        assert!(first > DIFFERENT);
    }
}

#[test]
fn with_growing_load_the_films_effect_on_the_gradient_fades() {
    for (elements, first, last) in [(256, "49.8 %", "2.20 %"), (512, "47.5 %", "2.17 %")] {
        let effect = effect(elements, |curve| curve.gradient);
        assert_reads(effect[0], first);
        assert_reads(effect[FIG5], last);
        assert!(effect[FIG5].abs() < FADED * effect[0].abs());
    }
}

#[test]
fn with_growing_load_the_films_effect_on_the_penetration_fades() {
    for (elements, first) in [(256, "83.4 %"), (512, "83.3 %")] {
        let effect = effect(elements, |curve| curve.penetration);
        assert_reads(effect[0], first);
        assert_reads(effect[FIG5], "10.2 %");
        assert!(effect[FIG5].abs() < FADED * effect[0].abs());
    }
}

#[test]
fn with_growing_load_the_films_effect_on_the_largest_pressure_does_not_fade() {
    for elements in [256, 512] {
        let effect = effect(elements, |curve| curve.max_pressure);
        assert_reads(-effect[0], "58.1 %");
        assert_reads(-effect[FIG5], "35.3 %");
        assert!(effect[FIG5].abs() > FADED * effect[0].abs());
    }
}
