//! `Φ` and `C` against 40-digit reference data (`tests/data/compliance_*.json`).

use pellicle_cli::validation::data::compliance::{OneLayer, one_layer, stacks};
use pellicle_kernel::Interface::{Bonded, Frictionless};
use pellicle_kernel::{Foundation, Interface};

/// A dozen roundings, no cancellation: measured 9e-16 with one layer.
const LAST_DIGITS: f64 = 2e-15;

fn values() -> Vec<OneLayer> {
    one_layer().expect("the data")
}

fn layer(value: &OneLayer, interface: Interface, rigid: bool) -> Foundation {
    value.foundation(interface, rigid).expect("a foundation")
}

/// The larger, NaN if either is.
fn worse(one: f64, other: f64) -> f64 {
    if other <= one { one } else { other }
}

/// Largest error of `Φ` relative to `|Φ|` over one column of the two-layer data, of which there must be some.
fn worst(interface: Interface, rigid: bool, column: impl Fn(&OneLayer) -> Option<f64>) -> f64 {
    let values = values();
    let errors = values.iter().filter_map(|value| {
        let expected = column(value)?;
        let found = layer(value, interface, rigid).response(value.s);
        Some(((found - expected) / expected).abs())
    });
    errors.reduce(worse).expect("values")
}

#[test]
fn a_bonded_layer_on_a_half_space() {
    let worst = worst(Bonded, false, |value| Some(value.bonded));
    assert!(worst <= LAST_DIGITS, "{worst:e}");
}

#[test]
fn a_frictionless_layer_on_a_half_space() {
    let worst = worst(Frictionless, false, |value| value.sliding);
    assert!(worst <= LAST_DIGITS, "{worst:e}");
}

#[test]
fn a_bonded_layer_on_a_rigid_base() {
    let worst = worst(Bonded, true, |value| value.bonded_to_rigid);
    assert!(worst <= LAST_DIGITS, "{worst:e}");
}

#[test]
fn a_frictionless_layer_on_a_rigid_base() {
    let worst = worst(Frictionless, true, |value| value.sliding_on_rigid);
    assert!(worst <= LAST_DIGITS, "{worst:e}");
}

#[test]
fn a_thickness_wrong_by_a_hundred_billionth_is_seen() {
    let errors = values().into_iter().map(|mut value| {
        let expected = value.bonded;
        value.s *= 1.0 + 1e-11;
        let found = layer(&value, Bonded, false).response(value.s);
        ((found - expected) / expected).abs()
    });
    let worst = errors.reduce(worse).expect("values");
    assert!(worst > LAST_DIGITS, "{worst:e}");
}

#[test]
fn the_difference_from_one_has_digits_of_its_own() {
    for value in values() {
        let (s, expected) = (value.s, value.bonded_minus_one);
        let found = layer(&value, Bonded, false).response_minus_one(s);
        // e^{−2s} magnifies the rounding of s by 2s.
        let bound = 1e-14 * (1.0 + 2.0 * s) * expected.abs();
        assert!((found - expected).abs() <= bound, "{value:?} {found:e}");
    }
}

#[test]
fn stacks_of_layers() {
    let data = stacks().expect("the data");
    for value in &data.values {
        let foundation = data.stacks[&value.stack].foundation().expect("a stack");
        let k = value.wavenumber;
        let compliance = foundation.compliance(k) / value.compliance - 1.0;
        let response = foundation.response(k) / value.response - 1.0;
        // Three layers, a dozen roundings each: measured 4.5e-16.
        let worst = compliance.abs().max(response.abs());
        assert!(worst <= LAST_DIGITS, "{worst:e} {value:?}");
    }
}
