//! Influence coefficients: two methods, limits, symmetries, scaling.

use pellicle_influence::{CoefficientTable, InfluenceError, RadialTables, direct, love};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use proptest::prelude::*;

fn material(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(young_modulus, poisson_ratio).expect("valid input")
}

fn coated(ratio: f64, coating: f64, substrate: f64) -> Foundation {
    let base = material(1.0 / ratio, substrate);
    Foundation::coated(1.0, material(1.0, coating), base).expect("valid input")
}

/// A soft, nearly incompressible layer between two stiff ones, of very different thicknesses, on a half-space.
fn three_layers(interface: Interface) -> Foundation {
    let layer = |thickness, young_modulus, poisson_ratio, interface| {
        Layer::new(thickness, material(young_modulus, poisson_ratio), interface)
            .expect("valid input")
    };
    let layers = vec![
        layer(0.2, 5.0, 0.2, Interface::Bonded),
        layer(1.0, 0.05, 0.49, interface),
        layer(0.01, 20.0, 0.3, Interface::Bonded),
    ];
    Foundation::new(layers, Base::HalfSpace(material(1.0, 0.3))).expect("valid input")
}

fn on_rigid_base(poisson_ratio: f64) -> Foundation {
    let layer =
        Layer::new(1.0, material(1.0, poisson_ratio), Interface::Bonded).expect("valid input");
    Foundation::new(vec![layer], Base::Rigid).expect("valid input")
}

/// Difference of the two methods relative to Love's coefficient.
fn disagreement(foundation: &Foundation, side: f64, offset: [usize; 2]) -> f64 {
    let tables = RadialTables::build(foundation).expect("valid input");
    let fast = tables.coefficient(side, offset);
    let slow = direct::coefficient(foundation, side, offset).expect("valid input");
    (fast - slow).abs() / love::coefficient(&foundation.surface_material(), side, offset)
}

/// The quadrature's tolerance.
const QUADRATURE: f64 = 1e-11;

#[test]
fn quadrature_and_tables_agree_for_coatings() {
    for (ratio, coating, substrate) in [(10.0, 0.3, 0.4), (0.01, 0.3, 0.3), (0.1, 0.5, 0.0)] {
        let foundation = coated(ratio, coating, substrate);
        for (side, offset) in [(2.0, [0, 0]), (2.0, [1, 0]), (0.4, [4, 2]), (0.2, [5, 5])] {
            let found = disagreement(&foundation, side, offset);
            assert!(
                found < QUADRATURE,
                "χ = {ratio}, {side}, {offset:?}: {found:e}"
            );
        }
    }
}

#[test]
fn quadrature_and_tables_agree_for_three_layers() {
    for interface in [Interface::Bonded, Interface::Frictionless] {
        let foundation = three_layers(interface);
        for (side, offset) in [(0.4, [0, 0]), (0.4, [2, 1]), (0.1, [6, 0])] {
            let found = disagreement(&foundation, side, offset);
            assert!(
                found < QUADRATURE,
                "{interface:?}, {side}, {offset:?}: {found:e}"
            );
        }
    }
}

#[test]
fn quadrature_and_tables_agree_on_a_rigid_base() {
    for poisson_ratio in [0.0, 0.3, 0.5] {
        let foundation = on_rigid_base(poisson_ratio);
        for (side, offset) in [(2.0, [0, 0]), (2.0, [1, 1]), (0.4, [5, 0])] {
            let found = disagreement(&foundation, side, offset);
            assert!(
                found < QUADRATURE,
                "ν = {poisson_ratio}, {offset:?}: {found:e}"
            );
        }
    }
}

#[test]
fn quadrature_of_a_very_thin_layer_is_refused_rather_than_endless() {
    let outcome = direct::coefficient(&coated(10.0, 0.3, 0.3), 2000.0, [3, 0]);
    assert!(matches!(
        outcome,
        Err(InfluenceError::TooManyOscillations { .. })
    ));
}

#[test]
fn a_homogeneous_body_has_loves_coefficients_to_the_bit() {
    let steel = material(210e9, 0.3);
    let same = Layer::new(1e-6, steel, Interface::Bonded).unwrap();
    let layered = Foundation::new(vec![same], Base::HalfSpace(steel)).unwrap();
    for foundation in [Foundation::half_space(steel), layered] {
        let tables = RadialTables::build(&foundation).unwrap();
        for offset in [[0, 0], [3, 1], [40, 7]] {
            let expected = love::coefficient(&steel, 1e-6, offset);
            assert_eq!(
                tables.coefficient(1e-6, offset).to_bits(),
                expected.to_bits()
            );
        }
    }
}

#[test]
fn small_elements_on_a_thick_coating_do_not_feel_the_substrate() {
    let foundation = coated(10.0, 0.3, 0.4);
    let tables = RadialTables::build(&foundation).unwrap();
    let ratio = tables.coefficient(2e-6, [0, 0])
        / love::coefficient(&foundation.surface_material(), 2e-6, [0, 0]);
    // T = 1 + g t with g of the order of Φ(0) = 10 and t = 1e-6.
    assert!((ratio - 1.0).abs() < 2e-5 && (ratio - 1.0).abs() > 1e-7);
}

#[test]
fn a_thin_coating_has_little_effect_far_away() {
    let foundation = coated(10.0, 0.3, 0.4);
    let tables = RadialTables::build(&foundation).unwrap();
    let substrate = material(0.1, 0.4);
    for offset in [[500, 0], [4000, 4000]] {
        let ratio = tables.coefficient(2.0, offset) / love::coefficient(&substrate, 2.0, offset);
        // The first correction is of the order of (H/r)² = 1e-6 times the stiffness ratio.
        assert!((ratio - 1.0).abs() < 1e-4);
    }
}

#[test]
fn displacement_decays_to_zero_on_a_rigid_base() {
    let tables = RadialTables::build(&on_rigid_base(0.3)).unwrap();
    let own = tables.coefficient(1.0, [0, 0]);
    assert!(own > 0.0);
    for offset in [[40, 0], [300, 300], [4000, 1]] {
        // e^(−1.5 r/H) is below rounding at r = 40 H.
        assert!(tables.coefficient(1.0, offset).abs() < 1e-17 * own);
    }
}

#[test]
fn an_incompressible_layer_bulges_beside_the_load() {
    let tables = RadialTables::build(&coated(0.01, 0.5, 0.3)).unwrap();
    assert!(tables.coefficient(1.0, [0, 0]) > 0.0);
    assert!(tables.coefficient(1.0, [2, 0]) < 0.0);
}

#[test]
fn near_and_far_rules_join_smoothly() {
    // k r is smooth in the offset: its fourth differences are as small across the border at 5 as beside it.
    let tables = RadialTables::build(&coated(10.0, 0.3, 0.3)).unwrap();
    let line: Vec<f64> = (0..12)
        .map(|m| tables.coefficient(1.0, [m, 0]) * m as f64)
        .collect();
    let difference = |at: usize| {
        [1.0, -4.0, 6.0, -4.0, 1.0]
            .iter()
            .zip(&line[at..])
            .map(|(c, k)| c * k)
            .sum::<f64>()
    };
    for at in 2..7 {
        assert!(
            difference(at).abs() < 2.0 * difference(at - 1).abs(),
            "at {at}"
        );
    }
}

#[test]
fn the_table_holds_the_coefficients_of_the_radial_tables() {
    let tables = RadialTables::build(&coated(3.0, 0.2, 0.4)).unwrap();
    let table = CoefficientTable::assemble(&tables, 0.1, 30).unwrap();
    for (m, n) in [(0, 0), (7, 3), (29, 29), (2, 17)] {
        let expected = tables.coefficient(0.1, [m.max(n), m.min(n)]);
        assert_eq!(table.coefficient([m, n]).to_bits(), expected.to_bits());
    }
}

#[test]
fn a_film_of_a_millionth_of_the_stiffness_is_tabulated() {
    // Far from the load T changes sign and settles at a millionth: the hardest single coating for the expansions.
    for (ratio, coating) in [(3.273e-6, 0.198), (6.533e-6, 0.4106), (1e-6, 0.2)] {
        let tables = RadialTables::build(&coated(ratio, coating, 0.0)).unwrap();
        assert!(tables.error_estimate() < 5e-13, "{ratio}");
    }
}

/// Layers (thickness, modulus, Poisson's ratio, whether they slide on the body below) on a half-space or a rigid base.
fn stack(layers: &[(f64, f64, f64, bool)], base: Option<(f64, f64)>) -> Foundation {
    let layers = layers.iter().map(|(thickness, modulus, ratio, slides)| {
        let interface = if *slides {
            Interface::Frictionless
        } else {
            Interface::Bonded
        };
        Layer::new(*thickness, material(*modulus, *ratio), interface).expect("valid input")
    });
    let base = base.map_or(Base::Rigid, |(modulus, ratio)| {
        Base::HalfSpace(material(modulus, ratio))
    });
    Foundation::new(layers.collect(), base).expect("valid input")
}

/// Foundations with a layer far softer than its neighbours: gold on PDMS on a stage, and random ones.
fn with_soft_middle() -> [Foundation; 4] {
    [
        stack(&[(1e-7, 78e9, 0.44, false), (2e-5, 2e6, 0.49, false)], None),
        stack(
            &[(0.3, 850.0, 0.32, false), (9.0, 1.2e-3, 0.24, false)],
            None,
        ),
        stack(
            &[
                (0.1, 50.0, 0.04, false),
                (5.0, 0.0015, 0.06, true),
                (26.0, 3.0, 0.49, false),
            ],
            Some((37.0, 0.4)),
        ),
        stack(
            &[
                (0.03, 10.0, 0.5, false),
                (0.1, 1e-3, 0.44, false),
                (1.5, 0.01, 0.36, false),
                (22.0, 7.0, 0.5, false),
            ],
            Some((440.0, 0.5)),
        ),
    ]
}

#[test]
fn soft_layers_between_stiff_bodies_are_tabulated_to_their_accuracy() {
    for foundation in with_soft_middle() {
        let tables = RadialTables::build(&foundation).unwrap();
        assert!(tables.error_estimate() < 1e-12, "{foundation:?}");
    }
}

#[test]
fn quadrature_and_tables_agree_where_a_soft_layer_is_between_stiff_bodies() {
    for foundation in with_soft_middle() {
        let top = foundation.layers()[0].thickness();
        let tables = RadialTables::build(&foundation).unwrap();
        for (side, offset) in [(top, [0, 0]), (0.5 * top, [6, 1])] {
            let found = tables.coefficient(side, offset);
            let error = found - direct::coefficient(&foundation, side, offset).unwrap();
            let love = love::coefficient(&foundation.surface_material(), side, offset);
            // The quadrature's tolerance, and the rounding of its inner integrals, multiplied by the
            // largest Φ, up to 1e5.
            let own = tables.coefficient(side, [0, 0]);
            let allowed = QUADRATURE * love + 1e-13 * own;
            assert!(
                error.abs() < allowed,
                "{side}, {offset:?}: {error:e} {allowed:e}"
            );
        }
    }
}

#[test]
fn impossible_thicknesses_end_in_an_error_or_in_finite_coefficients() {
    let layer = |thickness| (thickness, 2.0, 0.3, false);
    for thicknesses in [
        &[1e307][..],
        &[1e-308],
        &[1e-308, 1.0],
        &[1e307, 1e-308],
        &[1e-308, 1e307],
        &[1e-200, 1e-180],
    ] {
        let layers: Vec<_> = thicknesses.iter().map(|found| layer(*found)).collect();
        for base in [None, Some((1.0, 0.3))] {
            match RadialTables::build(&stack(&layers, base)) {
                Ok(tables) => {
                    let side = thicknesses[0];
                    let found = tables.coefficient(side, [3, 0]) / side;
                    assert!(found.is_finite(), "{thicknesses:?}");
                }
                Err(InfluenceError::LayerThicknesses { found, largest }) => {
                    assert!(found > largest);
                }
                Err(InfluenceError::TableAccuracy { found, wanted, .. }) => {
                    assert!(found.is_nan() || found > wanted);
                }
                Err(other) => panic!("{other}"),
            }
        }
    }
}

#[test]
fn a_perturbation_counts_as_an_error() {
    let tables = RadialTables::build(&coated(10.0, 0.3, 0.4)).unwrap();
    let wrong = tables.perturbed(-1e-6).error_estimate();
    // Both errors together.
    assert!((wrong - tables.error_estimate() - 1e-6).abs() < 1e-15);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn offsets_may_be_swapped(m in 0_usize..40, n in 0_usize..40, ratio in -2.0..2.0_f64) {
        let tables = RadialTables::build(&coated(10_f64.powf(ratio), 0.3, 0.2)).unwrap();
        let (one, other) = (tables.coefficient(0.3, [m, n]), tables.coefficient(0.3, [n, m]));
        let love = love::coefficient(&material(1.0, 0.3), 0.3, [m, n]);
        // Rounding: the same terms in another order.
        prop_assert!((one - other).abs() < 1e-13 * love * 10_f64.powf(ratio).max(1.0));
    }

    #[test]
    fn only_ratios_of_lengths_and_of_moduli_matter(
        length in 1e-9..1e3_f64, modulus in 1.0..1e12_f64, side in 0.01..100.0_f64,
    ) {
        let coating = |length: f64, modulus: f64| {
            let (layer, base) = (material(modulus, 0.4), material(modulus / 7.0, 0.1));
            RadialTables::build(&Foundation::coated(length, layer, base).unwrap()).unwrap()
        };
        let scaled = coating(length, modulus).coefficient(side * length, [2, 1]);
        let plain = coating(1.0, 1.0).coefficient(side, [2, 1]);
        // k is a length over a modulus; rounding of lengths passes through 1/r.
        prop_assert!((scaled * modulus / length / plain - 1.0).abs() < 1e-12);
    }

    #[test]
    fn every_foundation_gives_finite_coefficients_within_the_estimate(
        ratio in -6.0..6.0_f64, coating in 0.0..=0.5_f64, substrate in 0.0..=0.5_f64, side in -3.0..3.0_f64,
    ) {
        let tables = RadialTables::build(&coated(10_f64.powf(ratio), coating, substrate)).unwrap();
        prop_assert!(tables.error_estimate() < 1e-12);
        for offset in [[0, 0], [1, 0], [4, 4], [5, 0], [300, 20], [4096, 4096]] {
            prop_assert!(tables.coefficient(10_f64.powf(side), offset).is_finite());
        }
    }
}
