//! The dimensionless form of a foundation, which determines its radial functions.

use pellicle_kernel::{Base, Foundation, Interface, KernelError, Layer, Material};

/// Bits kept of a number's fraction: a relative precision of 1e-12.
const KEPT_BITS: u32 = 40;
/// The remaining ones of the 52 bits.
const DROPPED: u32 = 52 - KEPT_BITS;

/// The foundation in units of its total thickness and of the modulus at its surface. All numbers except Poisson's
/// ratios are rounded, so that foundations that differ only in size and stiffness have the same shape to the bit.
pub(super) fn of(foundation: &Foundation) -> Result<Foundation, KernelError> {
    let length = foundation.thickness();
    let modulus = foundation.surface_material().young_modulus();
    let material =
        |of: Material| Material::new(rounded(of.young_modulus() / modulus), of.poisson_ratio());
    let interface = |of: Interface| {
        let per_unit = modulus / length;
        let [normal, shear] = [of.normal_compliance(), of.shear_compliance()];
        Interface::spring(rounded(normal * per_unit), rounded(shear * per_unit))
    };
    let layer = |of: &Layer| {
        let thickness = rounded(of.thickness() / length);
        Layer::new(
            thickness,
            material(of.material())?,
            interface(of.interface())?,
        )
    };
    let layers = foundation.layers().iter().map(layer);
    let base = match foundation.base() {
        Base::HalfSpace(base) => Base::HalfSpace(material(base)?),
        Base::Rigid => Base::Rigid,
    };
    Foundation::new(layers.collect::<Result<_, _>>()?, base)
}

/// The nearest number with [`KEPT_BITS`] bits; 0 and ∞ are unchanged.
fn rounded(value: f64) -> f64 {
    if !value.is_finite() {
        return value;
    }
    let half = 1_u64 << (DROPPED - 1);
    f64::from_bits((value.to_bits() + half) >> DROPPED << DROPPED)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn foundation(length: f64, modulus: f64) -> Foundation {
        let material = |young: f64, nu| Material::new(young * modulus, nu).unwrap();
        let springs = Interface::spring(0.3 * length / modulus, f64::INFINITY).unwrap();
        let layers = vec![
            Layer::new(0.3 * length, material(7.0, 0.2), springs).unwrap(),
            Layer::new(0.11 * length, material(0.1, 0.5), Interface::Bonded).unwrap(),
        ];
        Foundation::new(layers, Base::HalfSpace(material(1.0, 0.3))).unwrap()
    }

    #[test]
    fn the_shape_is_independent_of_size_and_stiffness_to_the_bit() {
        let shape = of(&foundation(1.0, 1.0)).unwrap();
        for (length, modulus) in [(3e-7, 1.7e9), (0.7, 1.3), (1e-3, 4.1e11)] {
            assert_eq!(of(&foundation(length, modulus)).unwrap(), shape);
        }
        assert_ne!(
            of(&foundation(1.0, 1.0)
                .with_parameter(
                    pellicle_kernel::FoundationParameter::YoungModulus { body: 2 },
                    1.1,
                )
                .unwrap())
            .unwrap(),
            shape
        );
    }

    #[test]
    fn values_are_rounded_to_the_nearest() {
        for value in [1.0, 1.0 / 3.0, 6.02e23, 1.6e-19] {
            assert!((rounded(value) / value - 1.0).abs() < 0.5_f64.powi(41));
        }
        assert!(rounded(0.0).to_bits() == 0 && rounded(f64::INFINITY).is_infinite());
    }
}
