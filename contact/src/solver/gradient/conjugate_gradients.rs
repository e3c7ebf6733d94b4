//! Conjugate gradients: the directions, and the solution of one linear system along them.
//!
//! ```text
//! z = M r,    d ← z + β d,    α = r·z / d·A d,    x ← x + α d,    r ← r − α A d
//! β = r·z / (r·z)₀                    of one system that stays          (Fletcher and Reeves)
//! β = max(0, (r·z − z·r₀) / (r·z)₀)   where the residual is corrected   (Polak and Ribière)
//! ```

use std::sync::Arc;

use crate::vector::{
    add_scaled, dot,
    stretches::{SparseField, Stretches},
};

/// The last direction, with the product from which the next one follows.
pub struct Directions {
    direction: SparseField,
    stretches: Arc<Stretches>,
    /// `r·z` of the last direction; none before the first.
    product: Option<f64>,
}

impl Directions {
    /// Directions on all elements.
    pub fn new(elements: usize) -> Self {
        Self {
            direction: SparseField::new(elements),
            stretches: Arc::new(Stretches::all(elements)),
            product: None,
        }
    }

    /// Directions that are 0 outside some stretches; those so far are discarded unless they lie on the same.
    pub fn stay_on(&mut self, stretches: &Arc<Stretches>) {
        if !Arc::ptr_eq(&self.stretches, stretches) {
            self.stretches = stretches.clone();
            self.restart();
        }
    }

    /// Begins again: the next direction is `z`.
    pub fn restart(&mut self) {
        self.product = None;
    }

    /// The last direction `d`.
    pub fn last(&self) -> &[f64] {
        &self.direction
    }

    /// Turns to the next direction of one system, from its `z` and `r·z`.
    pub fn turn(&mut self, z: &[f64], product: f64) {
        let beta = self.product.map(|before| product / before);
        self.turn_by(beta, z, product);
    }

    /// The same where residuals are corrected besides the steps, given the residual of the last direction.
    pub fn turn_from(&mut self, residual_before: &[f64], z: &[f64], product: f64) {
        let along = || self.stretches.dot(z, residual_before);
        let beta = |before: f64| ((product - along()) / before).max(0.0);
        self.turn_by(self.product.map(beta), z, product);
    }

    /// Changes the last direction, which stays the one from which the next follows.
    pub fn correct(&mut self, correction: impl FnOnce(&mut [f64])) {
        correction(self.direction.on(&self.stretches));
    }

    fn turn_by(&mut self, beta: Option<f64>, z: &[f64], product: f64) {
        let (on, direction) = (&self.stretches, self.direction.on(&self.stretches));
        match beta {
            None => on.update(direction, z, |d, z| *d = *z),
            Some(beta) => on.update(direction, z, |d, z| *d = z + beta * *d),
        }
        self.product = Some(product);
    }
}

/// A symmetric positive linear system `A x = b` with a preconditioner `M`, as it is solved.
pub trait LinearSystem {
    /// Computes `z = M r`; returns `r·z`.
    fn precondition(&mut self, residual: &[f64]) -> f64;

    /// Whether the solution is final, given `r·z`.
    fn is_solved(&mut self, product: f64) -> bool;

    /// The last `z`, without its part along directions taken beforehand.
    fn correction<'a>(&'a mut self, residual: &'a [f64]) -> &'a [f64];

    /// Writes `A d`.
    fn apply_into(&mut self, direction: &[f64], image: &mut [f64]);

    /// Takes a step `α d`, given `r·z`; returns false if it is not one.
    fn take(&mut self, alpha: f64, direction: &[f64], product: f64) -> bool;
}

/// The fields with which a system is solved.
pub struct SystemFields<'a> {
    /// `b − A x`, at the start and at the end.
    pub residual: &'a mut [f64],
    pub directions: &'a mut Directions,
    pub image: &'a mut [f64],
}

/// Solves a system in at most `most_steps` steps; returns the steps taken, or none if they were not enough.
pub fn solve(
    system: &mut impl LinearSystem,
    fields: SystemFields<'_>,
    most_steps: usize,
) -> Option<usize> {
    let SystemFields {
        residual,
        directions,
        image,
    } = fields;
    directions.restart();
    for steps in 0..most_steps {
        let product = system.precondition(residual);
        if system.is_solved(product) {
            return Some(steps);
        }
        directions.turn(system.correction(residual), product);
        system.apply_into(directions.last(), image);
        let alpha = product / dot(directions.last(), image);
        if !system.take(alpha, directions.last(), product) {
            return Some(steps);
        }
        add_scaled(residual, -alpha, image);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `A = diag(1, 2, 3) + 1 1ᵀ`, without a preconditioner, solved to a residual.
    struct Small {
        solution: [f64; 3],
        accuracy: f64,
    }

    impl LinearSystem for Small {
        fn precondition(&mut self, residual: &[f64]) -> f64 {
            dot(residual, residual)
        }

        fn is_solved(&mut self, product: f64) -> bool {
            product <= self.accuracy
        }

        fn correction<'a>(&'a mut self, residual: &'a [f64]) -> &'a [f64] {
            residual
        }

        fn apply_into(&mut self, direction: &[f64], image: &mut [f64]) {
            let sum: f64 = direction.iter().sum();
            for (i, (y, d)) in image.iter_mut().zip(direction).enumerate() {
                *y = (i + 1) as f64 * d + sum;
            }
        }

        fn take(&mut self, alpha: f64, direction: &[f64], _: f64) -> bool {
            add_scaled(&mut self.solution, alpha, direction);
            true
        }
    }

    /// The steps and the solution of `A x = A (1, −1, 2)`.
    fn solved(accuracy: f64, most_steps: usize) -> (Option<usize>, [f64; 3]) {
        let (mut residual, mut image) = ([0.0; 3], [0.0; 3]);
        let mut small = Small {
            solution: [0.0; 3],
            accuracy,
        };
        small.apply_into(&[1.0, -1.0, 2.0], &mut residual);
        let fields = SystemFields {
            residual: &mut residual,
            directions: &mut Directions::new(3),
            image: &mut image,
        };
        (solve(&mut small, fields, most_steps), small.solution)
    }

    #[test]
    fn a_system_of_three_unknowns_is_solved_in_three_steps() {
        let (steps, solution) = solved(1e-24, 10);
        assert_eq!(steps, Some(3));
        for (found, wanted) in solution.iter().zip([1.0, -1.0, 2.0]) {
            assert!((found - wanted).abs() < 1e-13, "{solution:?}");
        }
        assert_eq!(solved(1e-24, 2).0, None);
    }

    #[test]
    fn a_corrected_residual_never_turns_a_direction_back() {
        let mut directions = Directions::new(2);
        directions.turn_from(&[9.0, 9.0], &[1.0, 2.0], 5.0);
        assert_eq!(directions.last(), [1.0, 2.0]);
        // (5 − 3)/5 of the last direction; then −1 of it, which counts as none.
        directions.turn_from(&[1.0, 1.0], &[2.0, 1.0], 5.0);
        assert_eq!(directions.last(), [2.4, 1.8]);
        directions.turn_from(&[5.0, 5.0], &[1.0, 1.0], 5.0);
        assert_eq!(directions.last(), [1.0, 1.0]);
    }
}
