//! `Φ` and `Φ − 1` against data of 20 digits (`tests/data/*.txt`; each file says what computed it).

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests are tests too; a failed unwrap is a failed test"
)]

use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

struct Case {
    foundation: Foundation,
    wavenumber: f64,
    response: f64,
    minus_one: f64,
}

fn cases(text: &str) -> Vec<Case> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(case).collect()
}

fn case(line: &str) -> Case {
    let [layers, base, k, response, minus_one] = fields(line, ' ');
    let layers = layers.split(';').map(layer).collect();
    Case {
        foundation: Foundation::new(layers, self::base(base)).unwrap(),
        wavenumber: number(k),
        response: number(response),
        minus_one: number(minus_one),
    }
}

fn layer(text: &str) -> Layer {
    let [thickness, young, poisson, interface] = fields(text, ',');
    let interface = match interface {
        "b" => Interface::Bonded,
        "s" => Interface::Frictionless,
        other => panic!("unknown interface {other}"),
    };
    let material = Material::new(number(young), number(poisson)).unwrap();
    Layer::new(number(thickness), material, interface).unwrap()
}

fn base(text: &str) -> Base {
    if text == "rigid" {
        return Base::Rigid;
    }
    let [young, poisson] = fields(text, ',');
    Base::HalfSpace(Material::new(number(young), number(poisson)).unwrap())
}

fn fields<const N: usize>(text: &str, separator: char) -> [&str; N] {
    let fields: Vec<_> = text.split(separator).collect();
    fields.try_into().unwrap()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

fn one_layer() -> Vec<Case> {
    cases(include_str!("data/one_layer.txt"))
}

fn stacks() -> Vec<Case> {
    cases(include_str!("data/stacks.txt"))
}

fn assert_response(case: &Case, tolerance: f64) {
    let found = case.foundation.response(case.wavenumber);
    let error = (found - case.response).abs() / case.response;
    assert!(
        error <= tolerance,
        "Φ = {found:e}, error {error:e}, {:?}",
        case.foundation
    );
}

#[test]
fn the_response_of_one_layer_is_right_to_the_last_digits() {
    for case in one_layer() {
        // Measured 4.7e-16: a sum of positive terms in numerator and denominator.
        assert_response(&case, 1.5e-15);
    }
}

#[test]
fn the_response_minus_one_of_one_layer_is_right_to_the_last_digits() {
    for case in one_layer() {
        let found = case.foundation.response_minus_one(case.wavenumber);
        let s = case.wavenumber * case.foundation.thickness();
        // Measured 5.1e-16; e^{−2s} magnifies the rounding of s by 2s.
        let bound = 2e-15 * (1.0 + 2.0 * s) * case.minus_one.abs();
        let error = (found - case.minus_one).abs();
        assert!(error <= bound, "{found:e} {error:e} {:?}", case.foundation);
    }
}

#[test]
fn the_response_of_stacks_is_right_to_the_last_digits() {
    for case in stacks() {
        // Measured 1.1e-15 with up to eight layers.
        assert_response(&case, 4e-15);
    }
}

#[test]
fn the_response_minus_one_of_stacks_is_free_of_cancellation() {
    for case in stacks() {
        let found = case.foundation.response_minus_one(case.wavenumber);
        let s = case.wavenumber * case.foundation.thickness();
        let magnified = (1.0 + 2.0 * s) * case.minus_one.abs();
        // The waves reflected by the lower layers cancel in part, to a rounding of the largest one,
        // which has decayed like e^{−2s}.
        let bound = 1e-13 * magnified + 4e-16 * (-2.0 * s).exp();
        let error = (found - case.minus_one).abs();
        assert!(
            error <= bound,
            "{found:e} {:e} {error:e} {:?}",
            case.minus_one,
            case.foundation
        );
    }
}

#[test]
fn two_hundred_layers_keep_every_digit() {
    let layer = |i: u32| {
        let material = Material::new(1.0 + f64::from(i) / 8.0, f64::from(i % 65) / 128.0);
        Layer::new(1.0 / 128.0, material.unwrap(), Interface::Bonded).unwrap()
    };
    let half_space = Base::HalfSpace(Material::new(100.0, 0.25).unwrap());
    let foundation = Foundation::new((0..200).map(layer).collect(), half_space).unwrap();
    for line in include_str!("data/ramp.txt")
        .lines()
        .filter(|line| !line.starts_with('#'))
    {
        let [k, response, minus_one] = fields(line, ' ').map(number);
        // Hundreds of layers of a few roundings each, which do not add up in one direction.
        assert!(
            (foundation.response(k) / response - 1.0).abs() <= 1e-14,
            "{line}"
        );
        let found = foundation.response_minus_one(k);
        assert!((found / minus_one - 1.0).abs() <= 1e-13, "{line} {found}");
    }
}
