//! Properties of every foundation, tested on many random ones.

#![expect(
    clippy::unwrap_used,
    reason = "helpers of tests are tests too; a failed unwrap is a failed test"
)]

use approx::assert_relative_eq;
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use proptest::collection::vec;
use proptest::prelude::*;

fn material() -> impl Strategy<Value = Material> {
    (-6.0..6.0, 0.0..=0.5)
        .prop_map(|(decades, poisson)| Material::new(10_f64.powf(decades), poisson).unwrap())
}

fn interface() -> impl Strategy<Value = Interface> {
    let spring = (-6.0..6.0, -6.0..6.0).prop_map(|(normal, shear)| {
        Interface::spring(10_f64.powf(normal), 10_f64.powf(shear)).unwrap()
    });
    prop_oneof![
        Just(Interface::Bonded),
        Just(Interface::Frictionless),
        spring
    ]
}

fn layer() -> impl Strategy<Value = Layer> {
    (-3.0..2.0, material(), interface()).prop_map(|(decades, material, interface)| {
        Layer::new(10_f64.powf(decades), material, interface).unwrap()
    })
}

fn base() -> impl Strategy<Value = Base> {
    prop_oneof![Just(Base::Rigid), material().prop_map(Base::HalfSpace)]
}

fn foundation() -> impl Strategy<Value = Foundation> {
    (vec(layer(), 1..6), base()).prop_map(|(layers, base)| Foundation::new(layers, base).unwrap())
}

fn wavenumber() -> impl Strategy<Value = f64> {
    (-6.0..4.0).prop_map(|decades| 10_f64.powf(decades))
}

/// The same foundation with all lengths and moduli multiplied.
fn scaled(foundation: &Foundation, length: f64, modulus: f64) -> Foundation {
    let material =
        |m: Material| Material::new(modulus * m.young_modulus(), m.poisson_ratio()).unwrap();
    let interface = |interface: Interface| {
        let [normal, shear] = [interface.normal_compliance(), interface.shear_compliance()];
        Interface::spring(normal * length / modulus, shear * length / modulus).unwrap()
    };
    let layers = foundation.layers().iter().map(|layer| {
        Layer::new(
            length * layer.thickness(),
            material(layer.material()),
            interface(layer.interface()),
        )
        .unwrap()
    });
    let base = match foundation.base() {
        Base::HalfSpace(m) => Base::HalfSpace(material(m)),
        Base::Rigid => Base::Rigid,
    };
    Foundation::new(layers.collect(), base).unwrap()
}

proptest! {
    #[test]
    fn compliance_is_positive_and_finite(foundation in foundation(), k in wavenumber()) {
        let compliance = foundation.compliance(k);
        prop_assert!(compliance.is_finite() && compliance > 0.0);
    }

    #[test]
    fn units_do_not_matter(foundation in foundation(), k in wavenumber()) {
        let (length, modulus) = (1e-6, 1e9);
        let same = scaled(&foundation, length, modulus).compliance(k / length);
        let wanted = foundation.compliance(k) * length / modulus;
        // Scaled lengths and moduli are rounded: once per layer; the rounding of k H in e^{−2kH} hardly matters for C.
        assert_relative_eq!(same, wanted, max_relative = 1e-13);
    }

    #[test]
    fn no_foundation_on_a_half_space_is_stiffer_than_its_stiffest_part(
        foundation in foundation(), k in wavenumber()
    ) {
        if let Base::HalfSpace(base) = foundation.base() {
            let layers = foundation.layers().iter().map(Layer::material);
            let shear = layers.map(|m| m.shear_modulus()).fold(base.shear_modulus(), f64::max);
            // An incompressible half-space of that shear modulus has C k = 1 / (2 G); roundings.
            prop_assert!(foundation.compliance(k) * k >= 0.5 / shear * (1.0 - 1e-13));
        }
    }

    #[test]
    fn stiffening_a_layer_never_raises_the_compliance(foundation in foundation(), k in wavenumber()) {
        let mut layers = foundation.layers().to_vec();
        let first = layers[0];
        let m = first.material();
        let stiffer = Material::new(1.5 * m.young_modulus(), m.poisson_ratio()).unwrap();
        layers[0] = Layer::new(first.thickness(), stiffer, first.interface()).unwrap();
        let stiffer = Foundation::new(layers, foundation.base()).unwrap();
        // Minimum of potential energy; roundings.
        prop_assert!(stiffer.compliance(k) <= foundation.compliance(k) * (1.0 + 1e-13));
    }

    #[test]
    fn removing_friction_never_lowers_the_compliance(foundation in foundation(), k in wavenumber()) {
        let free = foundation.layers().iter().map(|layer| {
            let normal = layer.interface().normal_compliance();
            let interface = Interface::spring(normal, f64::INFINITY).unwrap();
            Layer::new(layer.thickness(), layer.material(), interface).unwrap()
        });
        let free = Foundation::new(free.collect(), foundation.base()).unwrap();
        // Fewer constraints, less energy needed; roundings.
        prop_assert!(free.compliance(k) >= foundation.compliance(k) * (1.0 - 1e-13));
    }

    #[test]
    fn weakening_an_interface_never_lowers_the_compliance(
        foundation in foundation(), k in wavenumber(), normal in 0.0..1e3, shear in 0.0..1e3
    ) {
        let mut layers = foundation.layers().to_vec();
        let first = layers[0];
        let [c_n, c_s] = [first.interface().normal_compliance(), first.interface().shear_compliance()];
        let weaker = Interface::spring(c_n + normal, c_s + shear).unwrap();
        layers[0] = Layer::new(first.thickness(), first.material(), weaker).unwrap();
        let weaker = Foundation::new(layers, foundation.base()).unwrap();
        // Less energy for the same jump; roundings.
        prop_assert!(weaker.compliance(k) >= foundation.compliance(k) * (1.0 - 1e-13));
    }

    #[test]
    fn the_two_forms_of_the_response_agree(foundation in foundation(), k in wavenumber()) {
        let (response, difference) = (foundation.response(k), foundation.response_minus_one(k));
        // The roundings of Φ that `response_minus_one` allows, and those of Φ − 1 here.
        let bound = 1e-15 * (5 + foundation.layers().len()) as f64 * (response + 1.0);
        prop_assert!((response - 1.0 - difference).abs() <= bound);
    }
}
