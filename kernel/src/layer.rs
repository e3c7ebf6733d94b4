//! One elastic layer of a foundation, and the base below the last one.

use crate::{Interface, KernelError, Material};

/// An elastic layer: thickness `H` (m), material, and the interface with the body *below* it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    thickness: f64,
    material: Material,
    interface: Interface,
}

impl Layer {
    /// A layer of `thickness` (m, positive and finite) that is joined to the body below by `interface`.
    ///
    /// # Errors
    ///
    /// [`KernelError::Thickness`] if the thickness is not positive and finite.
    pub fn new(
        thickness: f64,
        material: Material,
        interface: Interface,
    ) -> Result<Self, KernelError> {
        if !(thickness.is_finite() && thickness > 0.0) {
            return Err(KernelError::Thickness { found: thickness });
        }
        Ok(Self {
            thickness,
            material,
            interface,
        })
    }

    /// Thickness `H`, m.
    #[must_use]
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// The material of the layer.
    #[must_use]
    pub fn material(&self) -> Material {
        self.material
    }

    /// The interface with the body below the layer.
    #[must_use]
    pub fn interface(&self) -> Interface {
        self.interface
    }
}

/// The body below the last layer.
///
/// Every base reaches to infinity or does not move at all, so nothing above it can float away:
/// there is deliberately no free base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Base {
    /// An elastic half-space.
    HalfSpace(Material),
    /// A body that does not deform.
    Rigid,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layer_without_thickness_is_refused_with_its_value() {
        let material = Material::new(1.0, 0.3).unwrap();
        for found in [0.0, -1e-6, f64::INFINITY] {
            let layer = Layer::new(found, material, Interface::Bonded);
            assert_eq!(layer, Err(KernelError::Thickness { found }));
        }
        assert!(Layer::new(f64::NAN, material, Interface::Bonded).is_err());
    }
}
