//! What the rows of `pellicle validate` do not show of its high-precision data: the response of stacks, and that a
//! thickness wrong by little is seen.

use pellicle_cli::evidence::data::compliance::{one_layer, stacks};
use pellicle_kernel::Interface::Bonded;

/// A dozen roundings, no cancellation: measured 9e-16 with one layer.
const LAST_DIGITS: f64 = 2e-15;

#[test]
fn a_thickness_wrong_by_a_hundred_billionth_is_seen() {
    let errors = one_layer().expect("the data").into_iter().map(|mut value| {
        let expected = value.bonded;
        value.s *= 1.0 + 1e-11;
        let layer = value.foundation(Bonded, false).expect("a foundation");
        (layer.response(value.s) / expected - 1.0).abs()
    });
    assert!(errors.fold(0.0, f64::max) > LAST_DIGITS);
}

#[test]
fn the_response_of_stacks_of_layers_has_all_digits() {
    let data = stacks().expect("the data");
    for value in &data.values {
        let foundation = data.stacks[&value.stack].foundation().expect("a stack");
        let error = (foundation.response(value.wavenumber) / value.response - 1.0).abs();
        // Three layers, a dozen roundings each: measured 4.5e-16.
        assert!(error <= LAST_DIGITS, "{error:e} {value:?}");
    }
}
