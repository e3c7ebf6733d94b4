//! The parameters of two elastic bodies, one by one: read, or replaced.

use pellicle_kernel::{FoundationParameter, KernelError, Material};

use super::ElasticBodies;
use crate::error::InfluenceError;

/// One parameter of [`ElasticBodies`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ElasticParameter {
    /// A parameter of the foundation.
    Foundation(FoundationParameter),
    /// Young's modulus `E_i` of the counterbody, Pa.
    CounterbodyYoungModulus,
    /// Poisson's ratio `ν_i` of the counterbody.
    CounterbodyPoissonRatio,
}

impl ElasticBodies {
    /// All parameters, the foundation's first.
    #[must_use]
    pub fn parameters(&self) -> Vec<ElasticParameter> {
        let of_foundation = self.foundation().parameters();
        let of_counterbody = [
            ElasticParameter::CounterbodyYoungModulus,
            ElasticParameter::CounterbodyPoissonRatio,
        ];
        let of_counterbody = of_counterbody.into_iter();
        let is_there = |_: &ElasticParameter| self.counterbody().is_some();
        let of_foundation = of_foundation.into_iter().map(ElasticParameter::Foundation);
        of_foundation
            .chain(of_counterbody.filter(is_there))
            .collect()
    }

    /// The value of one parameter, in SI units; `None` if there is no such body.
    #[must_use]
    pub fn parameter(&self, parameter: ElasticParameter) -> Option<f64> {
        match parameter {
            ElasticParameter::Foundation(of) => self.foundation().parameter(of),
            ElasticParameter::CounterbodyYoungModulus => {
                self.counterbody().map(Material::young_modulus)
            }
            ElasticParameter::CounterbodyPoissonRatio => {
                self.counterbody().map(Material::poisson_ratio)
            }
        }
    }

    /// The same bodies with another value of one parameter.
    ///
    /// # Errors
    ///
    /// [`InfluenceError::Kernel`]: the errors of
    /// [`Foundation::with_parameter`](pellicle_kernel::Foundation::with_parameter) and [`Material::new`], or
    /// [`KernelError::NothingElastic`] if the counterbody is rigid.
    pub fn with_parameter(
        &self,
        parameter: ElasticParameter,
        value: f64,
    ) -> Result<Self, InfluenceError> {
        if let ElasticParameter::Foundation(of) = parameter {
            let foundation = self.foundation().with_parameter(of, value)?;
            return Ok(Self::new(foundation, self.counterbody().copied()));
        }
        let material = self.counterbody().ok_or(KernelError::NothingElastic)?;
        let changed = if parameter == ElasticParameter::CounterbodyYoungModulus {
            Material::new(value, material.poisson_ratio())
        } else {
            Material::new(material.young_modulus(), value)
        };
        Ok(Self::new(self.foundation().clone(), Some(changed?)))
    }
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Foundation, Material};

    use super::*;

    #[test]
    fn every_parameter_is_listed_read_and_replaced() {
        let material = |young, poisson| Material::new(young, poisson).unwrap();
        let foundation = Foundation::half_space(material(2.0, 0.1));
        let bodies = ElasticBodies::new(foundation.clone(), Some(material(7.0, 0.2)));
        let all = bodies.parameters();
        let values = |of: &ElasticBodies| all.iter().map(|p| of.parameter(*p)).collect::<Vec<_>>();
        assert_eq!(values(&bodies), [2.0, 0.1, 7.0, 0.2].map(Some));
        for (index, parameter) in all.iter().enumerate() {
            let mut expected = values(&bodies);
            expected[index] = Some(0.25);
            let other = bodies.with_parameter(*parameter, 0.25).unwrap();
            assert_eq!(values(&other), expected);
        }
        let rigid = ElasticBodies::from(foundation);
        assert_eq!(rigid.parameters().len(), 2);
        let modulus = ElasticParameter::CounterbodyYoungModulus;
        assert_eq!(rigid.parameter(modulus), None);
        assert!(rigid.with_parameter(modulus, 1.0).is_err());
    }
}
