//! Influence coefficients against high-precision data: `influence_two_layer.json`, and `influence_extreme.json` for the softest and stiffest
//! coatings (mpmath 1.3, 34 digits: boundary integral of `∫ Φ J1/s ds` near, area integral of `t ∫ Φ J0 ds` far,
//! with the closed form of Φ).

use std::collections::BTreeMap;

use pellicle_cli::validation::data::influence::{Coefficients, extreme, two_layer};
use pellicle_influence::{RadialTables, love};
use pellicle_tests::scene::material;

/// Product rules leave up to 1e-13 of the scale around the softest layers.
const PRODUCT_RULES: f64 = 1e-13;

/// Largest error of `k E1/a` relative to `max(|k|, min(1, Φ(0)) k_Love)` over a file, by case, of coefficients that are wrong by a part.
fn errors(data: &Coefficients, perturbation: f64) -> BTreeMap<&str, f64> {
    let tables = |name: &String| {
        let foundation = data.cases[name].foundation().expect("a foundation");
        let tables = RadialTables::build(&foundation).expect("tables");
        tables.perturbed(perturbation)
    };
    let tables: BTreeMap<_, _> = data.cases.keys().map(|name| (name, tables(name))).collect();
    let mut worst = BTreeMap::new();
    for value in &data.values {
        let tables = &tables[&value.case];
        let side = value.element_side();
        let found = 2.0 * tables.coefficient(side, [value.m, value.n]) / side;
        let scale = value.scale(tables.foundation().response_at_zero());
        let error = (found - value.value).abs() / scale;
        let entry = worst.entry(value.case.as_str()).or_insert(0.0);
        *entry = error.max(*entry);
    }
    worst
}

#[test]
fn two_layer_coefficients_have_thirteen_digits() {
    for (case, error) in errors(&two_layer().expect("the data"), 0.0) {
        assert!(error < PRODUCT_RULES, "case {case}: {error:e}");
    }
}

#[test]
fn the_softest_and_stiffest_coatings_have_thirteen_digits() {
    for (case, error) in errors(&extreme().expect("the data"), 0.0) {
        assert!(error < PRODUCT_RULES, "case {case}: {error:e}");
    }
}

#[test]
fn coefficients_wrong_in_the_thirteenth_digit_are_seen_in_every_case() {
    for data in [two_layer(), extreme()] {
        for (case, error) in errors(&data.expect("the data"), 1e-12) {
            assert!(error > PRODUCT_RULES, "case {case}: {error:e}");
        }
    }
}

#[test]
fn loves_coefficients_are_those_of_the_data() {
    let data = two_layer().expect("the data");
    for value in &data.values {
        let coating = material(1.0, data.cases[&value.case].nu1);
        let found = love::coefficient(&coating, 2.0, [value.m, value.n]);
        // Rounding.
        assert!((found / value.homogeneous - 1.0).abs() < 1e-14);
    }
}
