//! A given operator under all elements of a square; nothing else is known of the body.

use std::sync::Arc;

use pellicle_influence::{ElasticOperator, SurfaceElasticity};

use super::{Support, divisible::Divisible};
use crate::grid::region::Region;

/// An operator and its square.
pub struct Given {
    region: Region,
    operator: Box<dyn ElasticOperator>,
}

impl Given {
    pub fn new(operator: Box<dyn ElasticOperator>, region: Region) -> Self {
        Self { region, operator }
    }
}

impl ElasticOperator for Given {
    fn size(&self) -> usize {
        self.operator.size()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.operator.apply_into(pressure, displacement);
    }
}

impl Support for Given {
    fn region(&self) -> &Region {
        &self.region
    }

    fn elasticity(&self) -> Option<&Arc<SurfaceElasticity>> {
        None
    }
}

impl Divisible for Given {}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3 × 3 elements on independent springs, each softer than the last.
    struct Springs;

    impl ElasticOperator for Springs {
        fn size(&self) -> usize {
            3
        }

        fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
            for (e, (u, p)) in displacement.iter_mut().zip(pressure).enumerate() {
                *u = (e + 1) as f64 * p;
            }
        }
    }

    #[test]
    fn the_own_coefficient_of_an_operator_is_that_of_its_central_element() {
        let mut given = Given::new(Box::new(Springs), Region::whole(3));
        assert_eq!(given.own_coefficient(), 5.0);
        assert!(given.coefficient([0, 1]).is_nan() && given.symbol(0).is_none());
        assert!(given.part(&Region::whole(3)).is_none());
    }
}
