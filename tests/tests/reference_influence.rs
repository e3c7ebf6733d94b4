//! Influence coefficients against high-precision data: `influence_two_layer.json`, and `influence_extreme.json` for the softest and
//! stiffest coatings (mpmath 1.3, 34 digits: boundary integral of `∫ Φ J1/s ds` near, area integral of `t ∫ Φ J0 ds` far,
//! with the closed form of Φ).

use std::collections::BTreeMap;

use pellicle_influence::{RadialTables, love};
use pellicle_kernel::{Foundation, Material};
use serde_json::Value;

const TWO_LAYER: &str = include_str!("../data/influence_two_layer.json");
const EXTREME: &str = include_str!("../data/influence_extreme.json");

fn number(value: &Value) -> f64 {
    let text = value.as_str().expect("numbers are strings");
    text.parse().expect("a decimal number")
}

fn count(value: &Value) -> usize {
    let count = value.as_u64().expect("offsets are whole numbers");
    usize::try_from(count).expect("a small number")
}

/// The foundation of one case: thickness 1, `E1` 1.
fn foundation(case: &Value) -> Foundation {
    let coating = Material::new(1.0, number(&case["nu1"])).expect("a material");
    let substrate = Material::new(1.0 / number(&case["chi"]), number(&case["nu2"]));
    Foundation::coated(1.0, coating, substrate.expect("a material")).expect("a foundation")
}

/// Largest error of `k E1/a` relative to `max(|k|, min(1, Φ(0)) k_Love)` over a file, by case.
fn errors(data: &str) -> BTreeMap<String, f64> {
    let data: Value = serde_json::from_str(data).expect("JSON");
    let cases = data["cases"].as_object().expect("cases");
    let tables: BTreeMap<&str, RadialTables> = cases
        .iter()
        .map(|(name, case)| {
            (
                name.as_str(),
                RadialTables::build(&foundation(case)).expect("tables"),
            )
        })
        .collect();
    let mut worst = BTreeMap::new();
    for value in data["values"].as_array().expect("values") {
        let case = value["case"].as_str().expect("a case");
        let tables = &tables[case];
        let half_side = 1.0 / number(&value["lam"]);
        let offset = [count(&value["m"]), count(&value["n"])];
        let found = tables.coefficient(2.0 * half_side, offset) / half_side;
        let (expected, love) = (number(&value["U"]), number(&value["U_homogeneous"]));
        let scale = expected
            .abs()
            .max(tables.foundation().response_at_zero().min(1.0) * love);
        let error = (found - expected).abs() / scale;
        let entry = worst.entry(case.to_owned()).or_insert(0.0);
        *entry = error.max(*entry);
    }
    worst
}

#[test]
fn two_layer_coefficients_have_thirteen_digits() {
    for (case, error) in errors(TWO_LAYER) {
        // Product rules leave up to 1e-13 of the scale around the softest layers.
        assert!(error < 1e-13, "case {case}: {error:e}");
    }
}

#[test]
fn the_softest_and_stiffest_coatings_have_thirteen_digits() {
    for (case, error) in errors(EXTREME) {
        // As above.
        assert!(error < 1e-13, "case {case}: {error:e}");
    }
}

#[test]
fn loves_coefficients_are_those_of_the_data() {
    let data: Value = serde_json::from_str(TWO_LAYER).expect("JSON");
    for value in data["values"].as_array().expect("values") {
        let case = &data["cases"][value["case"].as_str().expect("a case")];
        let coating = Material::new(1.0, number(&case["nu1"])).expect("a material");
        let found = love::coefficient(&coating, 2.0, [count(&value["m"]), count(&value["n"])]);
        let expected = number(&value["U_homogeneous"]);
        // Rounding.
        assert!((found / expected - 1.0).abs() < 1e-14);
    }
}
