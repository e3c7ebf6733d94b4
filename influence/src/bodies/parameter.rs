//! The parameters of two elastic bodies, one by one: read, or replaced.

use pellicle_kernel::FoundationParameter;

use super::{ElasticBodies, ElasticBody};
use crate::error::InfluenceError;

/// One parameter of [`ElasticBodies`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ElasticParameter {
    /// A parameter of the foundation.
    Foundation(FoundationParameter),
    /// A parameter of the counterbody; the only body of a half-space is number 0.
    Counterbody(FoundationParameter),
}

impl ElasticParameter {
    /// A parameter of one of the bodies.
    #[must_use]
    pub fn new(body: ElasticBody, of: FoundationParameter) -> Self {
        match body {
            ElasticBody::Foundation => Self::Foundation(of),
            ElasticBody::Counterbody => Self::Counterbody(of),
        }
    }

    /// The body, and its parameter.
    #[must_use]
    pub fn parts(self) -> (ElasticBody, FoundationParameter) {
        match self {
            Self::Foundation(of) => (ElasticBody::Foundation, of),
            Self::Counterbody(of) => (ElasticBody::Counterbody, of),
        }
    }
}

impl ElasticBodies {
    /// All parameters, the foundation's first.
    #[must_use]
    pub fn parameters(&self) -> Vec<ElasticParameter> {
        let of_body = |body: ElasticBody| {
            let parameters = self.of(body).parameters().into_iter();
            parameters.map(move |of| ElasticParameter::new(body, of))
        };
        ElasticBody::ALL.into_iter().flat_map(of_body).collect()
    }

    /// The value of one parameter, in SI units; `None` if there is no such body.
    #[must_use]
    pub fn parameter(&self, parameter: ElasticParameter) -> Option<f64> {
        let (body, of) = parameter.parts();
        self.of(body).parameter(of)
    }

    /// The same bodies with another value of one parameter.
    ///
    /// # Errors
    ///
    /// [`InfluenceError::Kernel`]: the errors of
    /// [`Foundation::with_parameter`](pellicle_kernel::Foundation::with_parameter).
    pub fn with_parameter(
        &self,
        parameter: ElasticParameter,
        value: f64,
    ) -> Result<Self, InfluenceError> {
        let (body, of) = parameter.parts();
        let changed = self.of(body).with_parameter(of, value)?;
        Ok(match body {
            ElasticBody::Foundation => Self::new(changed, self.counterbody().clone()),
            ElasticBody::Counterbody => Self::new(self.foundation().clone(), changed),
        })
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
        let modulus = ElasticParameter::Counterbody(FoundationParameter::YoungModulus { body: 0 });
        assert_eq!(rigid.parameter(modulus), None);
        assert!(rigid.with_parameter(modulus, 1.0).is_err());
    }
}
