//! A layered elastic foundation and its compliance `C(k)`.
//!
//! `u̅(k) = C(k) p̅(k)` with `C(k) = 2 (1 − ν₁²) / (E₁ k) · Φ(k)`, where `E₁`, `ν₁` belong to the body at the surface,
//! `p` is positive in compression and `u` points into the body.

use crate::response::Response;
use crate::{Base, Interface, KernelError, Layer, Material};

/// Elastic layers, from the surface down, on a [`Base`].
///
/// ```
/// use pellicle_kernel::{Foundation, Material};
///
/// let coating = Material::new(300e9, 0.25)?;
/// let steel = Material::new(210e9, 0.3)?;
/// let foundation = Foundation::coated(2e-6, coating, steel)?;
/// // Waves much shorter than the coating is thick see only the coating: Φ → 1, to rounding.
/// assert!((foundation.response(1e8) - 1.0).abs() < 1e-15);
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Foundation {
    layers: Vec<Layer>,
    base: Base,
    surface_material: Material,
    thickness: f64,
    response: Response,
}

impl Foundation {
    /// A foundation of any number of `layers` (surface first) on a `base`.
    ///
    /// # Errors
    ///
    /// [`KernelError::NothingElastic`] for a rigid base without layers,
    /// [`KernelError::TotalThickness`] if the thicknesses add up to infinity,
    /// [`KernelError::ModulusRatio`] if two neighbours differ by more than a factor of 1e30.
    pub fn new(layers: Vec<Layer>, base: Base) -> Result<Self, KernelError> {
        let surface_material = match (layers.first(), base) {
            (Some(layer), _) => layer.material(),
            (None, Base::HalfSpace(material)) => material,
            (None, Base::Rigid) => return Err(KernelError::NothingElastic),
        };
        let thickness: f64 = layers.iter().map(Layer::thickness).sum();
        if !thickness.is_finite() {
            return Err(KernelError::TotalThickness {
                layers: layers.len(),
                found: thickness,
            });
        }
        check_ratios(&layers, base)?;
        let response = Response::new(&layers, base);
        Ok(Self {
            layers,
            base,
            surface_material,
            thickness,
            response,
        })
    }

    /// A homogeneous elastic half-space: `Φ = 1`.
    #[must_use]
    pub fn half_space(material: Material) -> Self {
        Self {
            layers: Vec::new(),
            base: Base::HalfSpace(material),
            surface_material: material,
            thickness: 0.0,
            response: Response::HalfSpace,
        }
    }

    /// A body that does not deform, `C = 0`: one of two bodies in contact, of which the other is elastic.
    ///
    /// It has neither layers nor parameters; the modulus of its [surface](Self::surface_material) is infinite.
    #[must_use]
    pub fn rigid() -> Self {
        Self {
            layers: Vec::new(),
            base: Base::Rigid,
            surface_material: Material::RIGID,
            thickness: 0.0,
            response: Response::HalfSpace,
        }
    }

    /// Whether it does not deform.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.layers.is_empty() && self.base == Base::Rigid
    }

    /// One bonded layer, a `coating` of `thickness` (m), on a half-space, the `substrate`.
    ///
    /// # Errors
    ///
    /// [`KernelError::Thickness`] if the thickness is not positive and finite,
    /// [`KernelError::ModulusRatio`] if the two differ by more than a factor of 1e30.
    pub fn coated(
        thickness: f64,
        coating: Material,
        substrate: Material,
    ) -> Result<Self, KernelError> {
        let layer = Layer::new(thickness, coating, Interface::Bonded)?;
        Self::new(vec![layer], Base::HalfSpace(substrate))
    }

    /// The layers, surface first; empty for a half-space.
    #[must_use]
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// The base below the layers.
    #[must_use]
    pub fn base(&self) -> Base {
        self.base
    }

    /// The material of the half-space below the layers; `None` for a rigid base.
    #[must_use]
    pub fn base_material(&self) -> Option<Material> {
        match self.base {
            Base::HalfSpace(material) => Some(material),
            Base::Rigid => None,
        }
    }

    /// The material at the surface: of the first layer, or of the half-space; of infinite modulus on a rigid body.
    #[must_use]
    pub fn surface_material(&self) -> Material {
        self.surface_material
    }

    /// Thickness of all layers together, m; 0 for a half-space.
    #[must_use]
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Depth of interface `index` below the surface, m: 0 is the surface, 1 the bottom of the first layer;
    /// infinite beyond the top of the base.
    #[must_use]
    pub fn interface_depth(&self, index: usize) -> f64 {
        match self.layers.get(..index) {
            Some(above) => above.iter().map(Layer::thickness).sum(),
            None => f64::INFINITY,
        }
    }

    /// Compliance `C(k) = 2 (1 − ν₁²) / (E₁ k) · Φ(k)`, m/Pa, at the wavenumber `k` (1/m).
    ///
    /// As accurate as [`response`](Self::response). `C(0)` is the limit: infinite on a half-space, the compliance of a
    /// bed of springs on a rigid base ([`long_waves`](Self::long_waves)).
    #[must_use]
    pub fn compliance(&self, wavenumber: f64) -> f64 {
        if wavenumber == 0.0 {
            return self.long_waves().compliance(0.0);
        }
        let modulus = self.surface_material.plane_strain_modulus();
        // C = 2 (1 − ν₁²) / (E₁ k) · Φ
        2.0 / (modulus * wavenumber.abs()) * self.response(wavenumber)
    }

    /// Response `Φ(k)`: the compliance over that of a half-space of the surface material.
    ///
    /// `Φ → 1` for large `k` and [`response_at_zero`](Self::response_at_zero) for `k → 0`. `k` is
    /// the length of the wave vector, 1/m; its sign does not matter.
    ///
    /// Accuracy: relative error below 1.5e-15 for one layer, 4e-15 for a stack, 1e-14 for 200 layers
    /// (`tests/reference.rs`). Cost: about 40 ns for one layer, 60 ns per layer in a stack.
    #[must_use]
    pub fn response(&self, wavenumber: f64) -> f64 {
        if wavenumber == 0.0 {
            return self.response_at_zero();
        }
        self.response.value(wavenumber.abs())
    }

    /// `Φ(k) − 1` without cancellation: relatively accurate also where `Φ` is almost 1.
    ///
    /// Accuracy, with `s` = `k` times the total thickness: for one layer, a relative error below `2e-15 (1 + 2s)`,
    /// where the factor comes from the rounding of `s` in `e^{−2s}`; for stacks, `1e-13 (1 + 2s)` or, near a zero of
    /// `Φ − 1`, an absolute error of the roundings of `Φ` in `n` layers, at most `(4 + n) 1e-15 (Φ + 1)`
    /// (`tests/reference.rs`, `tests/property.rs`). Below the smallest normal number, for `s > 350`, precision is lost.
    #[must_use]
    pub fn response_minus_one(&self, wavenumber: f64) -> f64 {
        if wavenumber == 0.0 {
            return self.response_at_zero() - 1.0;
        }
        self.response.minus_one(wavenumber.abs())
    }

    /// `lim Φ` for `k → 0`: `χ (1 − ν₂²) / (1 − ν₁²)`, `χ = E₁/E₂`, with `E₂`, `ν₂` of the base;
    /// 0 for a rigid base.
    ///
    /// The layers in between and their interfaces do not matter: a wave much longer than they are thick sees only the
    /// base.
    #[must_use]
    pub fn response_at_zero(&self) -> f64 {
        match self.base {
            // Φ(0) = E₁ (1 − ν₂²) / (E₂ (1 − ν₁²))
            Base::HalfSpace(base) => {
                self.surface_material().plane_strain_modulus() / base.plane_strain_modulus()
            }
            Base::Rigid => 0.0,
        }
    }
}

impl From<Material> for Foundation {
    fn from(material: Material) -> Self {
        Self::half_space(material)
    }
}

impl From<Option<Material>> for Foundation {
    /// A half-space, or a rigid body if there is no material.
    fn from(material: Option<Material>) -> Self {
        material.map_or_else(Self::rigid, Self::half_space)
    }
}

/// Largest ratio of the shear moduli of neighbours, far beyond any pair of materials. The squares of such ratios and
/// the products of a few layers neither overflow nor underflow.
const LARGEST_RATIO: f64 = 1e30;

fn check_ratios(layers: &[Layer], base: Base) -> Result<(), KernelError> {
    let base = match base {
        Base::HalfSpace(material) => Some(material),
        Base::Rigid => None,
    };
    let below = layers.iter().skip(1).map(Layer::material).chain(base);
    for (layer, (upper, lower)) in layers.iter().zip(below).enumerate() {
        let found = upper.material().shear_modulus() / lower.shear_modulus();
        if !(1.0 / LARGEST_RATIO..=LARGEST_RATIO).contains(&found) {
            return Err(KernelError::ModulusRatio {
                layer,
                found,
                smallest: 1.0 / LARGEST_RATIO,
                largest: LARGEST_RATIO,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(young: f64, poisson: f64) -> Material {
        Material::new(young, poisson).unwrap()
    }

    #[test]
    fn a_rigid_base_alone_is_refused() {
        assert_eq!(
            Foundation::new(vec![], Base::Rigid),
            Err(KernelError::NothingElastic)
        );
    }

    #[test]
    fn a_rigid_body_has_no_compliance_and_no_parameters() {
        let body = Foundation::rigid();
        for k in [0.0, 1e-9, 1.0, 1e300] {
            assert!(body.compliance(k).abs() <= 0.0, "{k}");
        }
        assert!(body.is_rigid() && body.parameters().is_empty());
        assert!(body.null_directions().is_empty() && body.confined_compliance().abs() <= 0.0);
        assert!(!Foundation::from(material(1.0, 0.3)).is_rigid());
    }

    #[test]
    fn an_infinite_total_thickness_is_refused() {
        let layer = Layer::new(f64::MAX, material(1.0, 0.3), Interface::Bonded).unwrap();
        let refused = Foundation::new(vec![layer; 2], Base::Rigid);
        let found = f64::INFINITY;
        assert_eq!(
            refused,
            Err(KernelError::TotalThickness { layers: 2, found })
        );
    }

    #[test]
    fn adjacent_layers_of_extreme_modulus_ratio_are_refused_with_that_ratio() {
        let refused = Foundation::coated(1.0, material(1e40, 0.3), material(1.0, 0.3));
        let Err(KernelError::ModulusRatio {
            layer,
            found,
            smallest,
            largest,
        }) = refused
        else {
            panic!("{refused:?}");
        };
        // a rounding or two
        assert!(layer == 0 && (found / 1e40 - 1.0).abs() < 1e-15);
        assert!((smallest / 1e-30 - 1.0).abs() < 1e-15 && (largest / 1e30 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_thickness_is_that_of_all_layers() {
        let layer = |thickness| Layer::new(thickness, material(2.0, 0.3), Interface::Bonded);
        let layers = vec![layer(0.25).unwrap(), layer(0.5).unwrap()];
        let foundation = Foundation::new(layers, Base::Rigid).unwrap();
        // powers of two: exact
        assert!((foundation.thickness() - 0.75).abs() <= 0.0);
    }

    #[test]
    fn equal_materials_are_exactly_a_half_space() {
        let coated = Foundation::coated(1.0, material(0.7, 0.31), material(0.7, 0.31)).unwrap();
        for k in [0.0, 1e-8, 0.3, 1.0, 7.0, 1e6] {
            assert!(coated.response_minus_one(k).abs() <= 0.0, "{k}");
            // Numerator and denominator are rounded separately.
            assert!((coated.response(k) - 1.0).abs() <= 1e-15, "{k}");
        }
    }

    #[test]
    fn the_shortest_waves_depend_on_the_surface_material_alone() {
        let coated = Foundation::coated(1.0, material(1e6, 0.5), material(1.0, 0.0)).unwrap();
        for k in [1e6, 1e300, f64::INFINITY] {
            // One rounding each of numerator and denominator.
            assert!((coated.response(k) - 1.0).abs() <= 5e-16);
            assert!(coated.response_minus_one(k).abs() <= 0.0);
        }
    }

    #[test]
    fn the_longest_waves_depend_on_the_base_alone() {
        let (coating, base) = (material(10.0, 0.3), material(1.0, 0.4));
        let coated = Foundation::coated(1.0, coating, base).unwrap();
        assert_eq!(coated.base_material(), Some(base));
        // χ (1 − ν₂²) / (1 − ν₁²), a few roundings
        assert!((coated.response_at_zero() / (10.0 * 0.84 / 0.91) - 1.0).abs() < 1e-15);
        assert!((coated.response(0.0) - coated.response_at_zero()).abs() <= 0.0);
        // Φ − Φ(0) is of order χ s.
        assert!((coated.response(1e-17) / coated.response_at_zero() - 1.0).abs() < 1e-15);
        assert!(coated.compliance(0.0).is_infinite());
    }

    #[test]
    fn the_longest_waves_on_a_rigid_base_are_those_of_springs() {
        let layer = Layer::new(2.0, material(3.0, 0.25), Interface::Bonded).unwrap();
        let foundation = Foundation::new(vec![layer], Base::Rigid).unwrap();
        assert!(foundation.response(0.0).abs() <= 0.0);
        assert_eq!(foundation.base_material(), None);
        let (limit, near) = (foundation.compliance(0.0), foundation.compliance(1e-9));
        // The next term is of second order in k H.
        assert!((near / limit - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_sign_of_the_wavenumber_does_not_matter() {
        let coated = Foundation::coated(1.0, material(10.0, 0.3), material(1.0, 0.4)).unwrap();
        assert!((coated.compliance(-0.7) - coated.compliance(0.7)).abs() <= 0.0);
    }

    #[test]
    fn foundations_can_be_shared_between_threads() {
        fn shared<T: Send + Sync + Clone>(_: &T) {}
        shared(&Foundation::half_space(material(1.0, 0.3)));
    }
}
