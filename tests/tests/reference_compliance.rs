//! `Φ` and `C` against 40-digit reference data (`tests/data/compliance_*.json`).

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "reference data that cannot be read fail their test"
)]

use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use serde_json::Value;

const TWO_LAYER: &str = include_str!("../data/compliance_two_layer.json");
const N_LAYERS: &str = include_str!("../data/compliance_n_layers.json");

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

fn one_layer(entry: &Value, interface: Interface, rigid: bool) -> Foundation {
    let coating = Material::new(number(&entry["chi"]), number(&entry["nu1"])).unwrap();
    let substrate = Material::new(1.0, number(&entry["nu2"])).unwrap();
    let base = if rigid {
        Base::Rigid
    } else {
        Base::HalfSpace(substrate)
    };
    Foundation::new(vec![Layer::new(1.0, coating, interface).unwrap()], base).unwrap()
}

/// A dozen roundings, no cancellation: measured 9e-16 with one layer.
const LAST_DIGITS: f64 = 2e-15;

/// Largest error of `Φ` relative to `|Φ|` over one column of the two-layer data.
fn worst_in(column: &str, interface: Interface, rigid: bool) -> f64 {
    let data: Value = serde_json::from_str(TWO_LAYER).unwrap();
    let errors = data["values"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|entry| {
            let expected = number(entry.get(column)?);
            let found = one_layer(entry, interface, rigid).response(number(&entry["s"]));
            Some(((found - expected) / expected).abs())
        });
    errors.fold(
        0.0,
        |worst, error| if error <= worst { worst } else { error },
    )
}

#[test]
fn a_bonded_layer_on_a_half_space() {
    let worst = worst_in("Phi", Interface::Bonded, false);
    assert!(worst <= LAST_DIGITS, "{worst:e}");
}

#[test]
fn a_frictionless_layer_on_a_half_space() {
    let worst = worst_in("Phi_slip", Interface::Frictionless, false);
    assert!(worst <= LAST_DIGITS, "{worst:e}");
}

#[test]
fn a_bonded_layer_on_a_rigid_base() {
    let worst = worst_in("Phi_rigid_bonded", Interface::Bonded, true);
    assert!(worst <= LAST_DIGITS, "{worst:e}");
}

#[test]
fn a_frictionless_layer_on_a_rigid_base() {
    let worst = worst_in("Phi_rigid_slip", Interface::Frictionless, true);
    assert!(worst <= LAST_DIGITS, "{worst:e}");
}

#[test]
fn the_difference_from_one_has_digits_of_its_own() {
    let data: Value = serde_json::from_str(TWO_LAYER).unwrap();
    for entry in data["values"].as_array().unwrap() {
        let s = number(&entry["s"]);
        let expected = number(&entry["Phi_minus_1"]);
        let found = one_layer(entry, Interface::Bonded, false).response_minus_one(s);
        // e^{−2s} magnifies the rounding of s by 2s.
        let bound = 1e-14 * (1.0 + 2.0 * s) * expected.abs();
        assert!((found - expected).abs() <= bound, "{entry} {found:e}");
    }
}

fn stack(description: &Value) -> Foundation {
    let layers = description["layers"].as_array().unwrap();
    let interfaces = description["interfaces"].as_array().unwrap();
    let layers = layers.iter().zip(interfaces).map(|(layer, interface)| {
        let interface = match interface.as_str().unwrap() {
            "bonded" => Interface::Bonded,
            "slip" => Interface::Frictionless,
            other => panic!("unknown interface {other}"),
        };
        let material = Material::new(number(&layer[1]), number(&layer[2])).unwrap();
        Layer::new(number(&layer[0]), material, interface).unwrap()
    });
    let base = match &description["substrate"] {
        Value::Array(substrate) => {
            Base::HalfSpace(Material::new(number(&substrate[0]), number(&substrate[1])).unwrap())
        }
        _ => Base::Rigid,
    };
    Foundation::new(layers.collect(), base).unwrap()
}

#[test]
fn stacks_of_layers() {
    let data: Value = serde_json::from_str(N_LAYERS).unwrap();
    for entry in data["values"].as_array().unwrap() {
        let foundation = stack(&data["stacks"][entry["stack"].as_str().unwrap()]);
        let k = number(&entry["k"]);
        let compliance = foundation.compliance(k) / number(&entry["C"]) - 1.0;
        let response = foundation.response(k) / number(&entry["Phi"]) - 1.0;
        let worst = compliance.abs().max(response.abs());
        // Three layers, a dozen roundings each: measured 4.5e-16.
        assert!(worst <= LAST_DIGITS, "{worst:e} {entry}");
    }
}
