//! The independent paths to `Φ` agree over the whole range of parameters.

#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests are tests too; a failed unwrap is a failed test"
)]

use pellicle_kernel::{Base, Foundation, Interface, Layer, Material, Side, TransformedSystem};

const RATIOS: [f64; 9] = [1e-6, 1e-4, 1e-2, 0.3, 1.0, 3.0, 1e2, 1e4, 1e6];
const POISSON: [f64; 5] = [0.0, 0.2, 0.37, 0.499, 0.5];

/// Calls `check(s, layer, half-space)` for `s` in [1e-8, 1e3], `χ` in [1e-6, 1e6], `ν` in [0, 0.5].
fn for_each_case(mut check: impl FnMut(f64, Material, Material)) {
    for step in 0..=44 {
        let s = 10_f64.powf(-8.0 + 0.25 * f64::from(step));
        for chi in RATIOS {
            for nu1 in POISSON {
                for nu2 in POISSON {
                    let layer = Material::new(chi, nu1).unwrap();
                    check(s, layer, Material::new(1.0, nu2).unwrap());
                }
            }
        }
    }
}

fn relative(found: f64, wanted: f64) -> f64 {
    (found / wanted - 1.0).abs()
}

#[test]
fn the_closed_form_solves_the_transformed_system() {
    for_each_case(|s, layer, half_space| {
        let closed = Foundation::coated(1.0, layer, half_space)
            .unwrap()
            .response(s);
        let system = TransformedSystem::new(s, layer, half_space)
            .response()
            .unwrap();
        // The error is that of the elimination: a few tens of roundings and, for large s, the square of the size s of
        // the linear parts of its waves.
        let bound = 1e-14 + 3.3e-16 * s * s;
        assert!(
            relative(system, closed) <= bound,
            "s = {s:e}, {layer:?}, {half_space:?}"
        );
    });
}

/// The layer, of thickness 1, cut into pieces whose thicknesses are exact doubles.
fn cut(layer: Material, half_space: Material) -> Foundation {
    let pieces = [0.25, 0.5, 0.25];
    let layers = pieces.map(|h| Layer::new(h, layer, Interface::Bonded).unwrap());
    Foundation::new(layers.to_vec(), Base::HalfSpace(half_space)).unwrap()
}

#[test]
fn the_recursion_through_three_pieces_is_the_closed_form() {
    for_each_case(|s, layer, half_space| {
        let closed = Foundation::coated(1.0, layer, half_space).unwrap();
        let pieces = cut(layer, half_space);
        // Measured 1e-15: roundings only, three layers instead of one.
        assert!(
            relative(pieces.response(s), closed.response(s)) <= 3e-15,
            "s = {s:e}, {layer:?}"
        );
        let (found, wanted) = (pieces.response_minus_one(s), closed.response_minus_one(s));
        // e^{−2s} magnifies roundings by 2s; below the smallest normal number precision is lost.
        let bound = 1e-13 * (1.0 + 2.0 * s) * wanted.abs() + f64::MIN_POSITIVE;
        assert!(
            (found - wanted).abs() <= bound,
            "s = {s:e}, {layer:?} {half_space:?} {found:e} {wanted:e}"
        );
    });
}

/// Calls `check(s, layer, interface, half-space)` with springs from stiffer to softer than the layers.
fn on_springs(mut check: impl FnMut(f64, Material, Interface, Material)) {
    for s in [1e-6, 1e-3, 0.1, 1.0, 5.0, 30.0] {
        for chi in [1e-3, 0.3, 1.0, 30.0] {
            for compliances in [
                [0.0, 0.0],
                [0.0, f64::INFINITY],
                [1e-3, 0.1],
                [3.0, 0.0],
                [0.0, 20.0],
                [1e3, f64::INFINITY],
            ] {
                let [normal, shear] = compliances;
                let interface = Interface::spring(normal, shear).unwrap();
                for nu in [0.0, 0.37, 0.5] {
                    let layer = Material::new(chi, nu).unwrap();
                    check(s, layer, interface, Material::new(1.0, 0.2).unwrap());
                }
            }
        }
    }
}

#[test]
fn springs_in_the_recursion_agree_with_the_transformed_system() {
    on_springs(|s, layer, interface, half_space| {
        let coating = Layer::new(1.0, layer, interface).unwrap();
        let foundation = Foundation::new(vec![coating], Base::HalfSpace(half_space)).unwrap();
        let system = TransformedSystem::on(s, layer, interface, half_space);
        let response = system.response().unwrap();
        // The error is that of the elimination, a few tens of roundings.
        assert!(
            relative(response, foundation.response(s)) <= 2e-14,
            "s = {s:e}, {layer:?}, {interface:?}"
        );
        let moved = foundation.interior(s).unwrap().at(0.0, Side::Below).shear;
        let unit = layer.shear_modulus() * s / (1.0 - layer.poisson_ratio());
        let wanted = unit * moved.horizontal_displacement;
        assert!(
            relative(system.shear_response().unwrap(), wanted) <= 2e-14,
            "s = {s:e}, {layer:?}, {interface:?}"
        );
    });
}
