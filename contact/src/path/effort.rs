//! The work of one level.

use crate::Iterate;

/// The work of several regions together.
#[derive(Default)]
pub struct Effort {
    pub iterations: usize,
    pub operator_applications: usize,
    pub stiffness_applications: usize,
    pub candidate_applications: usize,
    pub residuals: Vec<f64>,
    pub contact_stiffness: Option<f64>,
}

impl Effort {
    /// Counts the products of an iterate as products among candidates; returns the iterate without them.
    pub fn among(&mut self, iterate: Iterate) -> Iterate {
        self.candidate_applications +=
            iterate.operator_applications + iterate.stiffness_applications;
        Iterate {
            operator_applications: 0,
            stiffness_applications: 0,
            ..iterate
        }
    }

    /// Adds the work of an iterate and returns its pressure.
    pub fn take(&mut self, iterate: Iterate) -> Vec<f64> {
        self.iterations += iterate.iterations;
        self.operator_applications += iterate.operator_applications;
        self.stiffness_applications += iterate.stiffness_applications;
        self.residuals.extend(iterate.residuals);
        self.contact_stiffness = iterate.contact_stiffness;
        iterate.pressure
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn iterate(products: usize) -> Iterate {
        Iterate {
            pressure: vec![1.0],
            iterations: 2,
            operator_applications: products,
            stiffness_applications: 3,
            residuals: vec![0.5, 0.25],
            contact_stiffness: Some(7.0),
            penetration: 0.0,
            reached_border: false,
        }
    }

    #[test]
    fn products_among_candidates_are_counted_separately_from_those_of_the_grid() {
        let mut effort = Effort::default();
        let among = effort.among(iterate(10));
        assert_eq!(effort.take(among), [1.0]);
        let among = effort.among(iterate(20));
        effort.take(among);
        effort.take(iterate(40));
        assert_eq!(effort.candidate_applications, 13 + 23);
        assert_eq!(
            (effort.operator_applications, effort.stiffness_applications),
            (40, 3)
        );
        assert_eq!((effort.iterations, effort.residuals.len()), (6, 6));
        assert_eq!(effort.contact_stiffness, Some(7.0));
    }
}
