//! The parameters of a foundation, one by one: read, or replaced.

use crate::{Base, Foundation, Interface, KernelError, Layer, Material};

/// One parameter of a [`Foundation`].
///
/// Bodies are counted from the surface: the layers from 0, then the half-space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FoundationParameter {
    /// Young's modulus `E` of a body, Pa.
    YoungModulus {
        /// Index of the layer, or the number of layers for the half-space.
        body: usize,
    },
    /// Poisson's ratio `ν` of a body.
    PoissonRatio {
        /// Index of the layer, or the number of layers for the half-space.
        body: usize,
    },
    /// Thickness `H` of a layer, m.
    Thickness {
        /// Index of the layer, from 0 at the surface.
        layer: usize,
    },
    /// Normal compliance `c_n` of the springs below a layer, m/Pa.
    NormalCompliance {
        /// Index of the layer, from 0 at the surface.
        layer: usize,
    },
    /// Shear compliance `c_s` of the springs below a layer, m/Pa.
    ShearCompliance {
        /// Index of the layer, from 0 at the surface.
        layer: usize,
    },
}

impl Foundation {
    /// All parameters, body by body from the surface down; compliances only where they are neither 0 nor infinite.
    #[must_use]
    pub fn parameters(&self) -> Vec<FoundationParameter> {
        use FoundationParameter::{
            NormalCompliance, PoissonRatio, ShearCompliance, Thickness, YoungModulus,
        };
        let count = self.layers().len();
        let of_layer = |body: usize| {
            let layer = body;
            let always = [
                YoungModulus { body },
                PoissonRatio { body },
                Thickness { layer },
            ];
            let springs = [NormalCompliance { layer }, ShearCompliance { layer }];
            let is_there = |spring: &FoundationParameter| {
                let compliance = self.parameter(*spring);
                compliance.is_some_and(|compliance| compliance > 0.0 && compliance.is_finite())
            };
            always
                .into_iter()
                .chain(springs.into_iter().filter(is_there))
        };
        let of_base = [YoungModulus { body: count }, PoissonRatio { body: count }];
        let is_elastic = matches!(self.base(), Base::HalfSpace(_));
        let of_base = of_base.into_iter().filter(|_| is_elastic);
        (0..count).flat_map(of_layer).chain(of_base).collect()
    }

    /// The value of one parameter, in SI units; `None` if the foundation has no such body.
    #[must_use]
    pub fn parameter(&self, parameter: FoundationParameter) -> Option<f64> {
        let layer = |layer: usize| self.layers().get(layer);
        match parameter {
            FoundationParameter::YoungModulus { body } => {
                self.material(body).map(|of| of.young_modulus())
            }
            FoundationParameter::PoissonRatio { body } => {
                self.material(body).map(|of| of.poisson_ratio())
            }
            FoundationParameter::Thickness { layer: index } => layer(index).map(Layer::thickness),
            FoundationParameter::NormalCompliance { layer: index } => {
                layer(index).map(|of| of.interface().normal_compliance())
            }
            FoundationParameter::ShearCompliance { layer: index } => {
                layer(index).map(|of| of.interface().shear_compliance())
            }
        }
    }

    /// The same foundation with another value of one parameter.
    ///
    /// ```
    /// use pellicle_kernel::{Foundation, FoundationParameter, Material};
    ///
    /// let (coating, steel) = (Material::new(400e9, 0.25)?, Material::new(210e9, 0.3)?);
    /// let coated = Foundation::coated(2e-6, coating, steel)?;
    /// let thickness = FoundationParameter::Thickness { layer: 0 };
    /// assert_eq!(coated.with_parameter(thickness, 3e-6)?, Foundation::coated(3e-6, coating, steel)?);
    /// # Ok::<(), pellicle_kernel::KernelError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`KernelError::NoBody`] if the foundation has no such body; the errors of [`Material::new`], [`Layer::new`],
    /// [`Interface::spring`] and [`Foundation::new`] for an invalid value.
    pub fn with_parameter(
        &self,
        parameter: FoundationParameter,
        value: f64,
    ) -> Result<Self, KernelError> {
        use FoundationParameter::{NormalCompliance, PoissonRatio, ShearCompliance, Thickness};
        let (FoundationParameter::YoungModulus { body: index }
        | PoissonRatio { body: index }
        | Thickness { layer: index }
        | NormalCompliance { layer: index }
        | ShearCompliance { layer: index }) = parameter;
        let changed = |material: Material| match parameter {
            FoundationParameter::YoungModulus { .. } => {
                Material::new(value, material.poisson_ratio())
            }
            PoissonRatio { .. } => Material::new(material.young_modulus(), value),
            _ => Ok(material),
        };
        let is_of_base = parameter == FoundationParameter::YoungModulus { body: index }
            || parameter == PoissonRatio { body: index };
        let (mut layers, mut base) = (self.layers().to_vec(), self.base());
        let found = KernelError::NoBody {
            found: index,
            layers: layers.len(),
        };
        match (layers.get_mut(index), &mut base) {
            (Some(layer), _) => {
                let interface = layer.interface();
                let (normal, shear) = (interface.normal_compliance(), interface.shear_compliance());
                let interface = match parameter {
                    NormalCompliance { .. } => Interface::spring(value, shear)?,
                    ShearCompliance { .. } => Interface::spring(normal, value)?,
                    _ => interface,
                };
                let thickness = match parameter {
                    Thickness { .. } => value,
                    _ => layer.thickness(),
                };
                *layer = Layer::new(thickness, changed(layer.material())?, interface)?;
            }
            (None, Base::HalfSpace(material)) if index == self.layers().len() && is_of_base => {
                *material = changed(*material)?;
            }
            _ => return Err(found),
        }
        Self::new(layers, base)
    }

    /// The material of a body; `None` for a rigid base.
    fn material(&self, body: usize) -> Option<Material> {
        match (self.layers().get(body), self.base()) {
            (Some(layer), _) => Some(layer.material()),
            (None, Base::HalfSpace(material)) if body == self.layers().len() => Some(material),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn foundation() -> Foundation {
        let material = |young, poisson| Material::new(young, poisson).unwrap();
        let layers = vec![
            Layer::new(
                1.0,
                material(2.0, 0.1),
                Interface::spring(0.5, 0.0).unwrap(),
            )
            .unwrap(),
            Layer::new(3.0, material(4.0, 0.2), Interface::Bonded).unwrap(),
        ];
        Foundation::new(layers, Base::HalfSpace(material(5.0, 0.3))).unwrap()
    }

    #[test]
    fn every_parameter_is_listed_read_and_replaced_independently() {
        let body = foundation();
        let all = body.parameters();
        let values: Vec<f64> = all.iter().map(|of| body.parameter(*of).unwrap()).collect();
        assert_eq!(values, [2.0, 0.1, 1.0, 0.5, 4.0, 0.2, 3.0, 5.0, 0.3]);
        for (index, parameter) in all.iter().enumerate() {
            let other = body.with_parameter(*parameter, 0.25).unwrap();
            let mut expected = values.clone();
            expected[index] = 0.25;
            let found: Vec<f64> = all.iter().map(|of| other.parameter(*of).unwrap()).collect();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn a_missing_parameter_has_no_value() {
        let body = foundation();
        for parameter in [
            FoundationParameter::YoungModulus { body: 3 },
            FoundationParameter::Thickness { layer: 2 },
        ] {
            assert_eq!(body.parameter(parameter), None);
            let refused = body.with_parameter(parameter, 1.0);
            assert!(matches!(
                refused,
                Err(KernelError::NoBody { layers: 2, .. })
            ));
        }
        let rigid = Foundation::new(body.layers().to_vec(), Base::Rigid).unwrap();
        assert_eq!(rigid.parameters().len(), 7);
    }

    #[test]
    fn an_invalid_value_is_refused() {
        let ratio = FoundationParameter::PoissonRatio { body: 2 };
        let refused = foundation().with_parameter(ratio, 0.6);
        assert_eq!(refused, Err(KernelError::PoissonRatio { found: 0.6 }));
    }
}
