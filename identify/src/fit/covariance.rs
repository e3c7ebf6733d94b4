//! Covariances of unknowns and of linear nuisances.
//!
//! The covariance of the unknowns is `(JᵀJ)⁻¹` with the nuisances eliminated, which is their block of the inverse of
//! the full matrix.

use super::Fitting;
use crate::{
    Coefficient, distribution::student_quantile, fit::intervals::Sought,
    orthonormal_basis::OrthonormalBasis, refinement::Refined,
};

impl Fitting<'_> {
    /// The covariance of the unknowns in their coordinates.
    pub(super) fn covariance(&self, refined: &Refined) -> Vec<Vec<f64>> {
        let unknowns = self.problem.unknowns().len();
        let system = &refined.minimum.system;
        let determined =
            OrthonormalBasis::of(self.determined.iter().map(|&j| system.jacobian[j].clone()));
        let inverse = determined.inverse_gram();
        let mut covariance = vec![vec![0.0; unknowns]; unknowns];
        for (a, &i) in self.determined.iter().enumerate() {
            for (b, &j) in self.determined.iter().enumerate() {
                if !self.null_space.moves(i) && !self.null_space.moves(j) {
                    covariance[i][j] = inverse[a][b];
                }
            }
        }
        for (j, row) in covariance.iter_mut().enumerate() {
            if self.null_space.moves(j) {
                row[j] = f64::INFINITY;
            }
        }
        covariance
    }

    /// The linear nuisances, with intervals that allow for the uncertainty of the unknowns.
    pub(super) fn coefficients(&self, refined: &Refined, sought: &[Sought]) -> Vec<Coefficient> {
        let (_, jacobian) = refined.metric.rows(&refined.minimum.at);
        let mut columns: Vec<Vec<f64>> = self
            .determined
            .iter()
            .map(|&j| jacobian[j].clone())
            .collect();
        columns.extend(refined.metric.nuisance_columns());
        let inverse = OrthonormalBasis::of(columns).inverse_gram();
        let degrees = sought
            .iter()
            .map(|one| one.degrees)
            .fold(f64::INFINITY, f64::min);
        let quantile = student_quantile(self.options.level, degrees);
        let values = &refined.minimum.system.coefficients;
        self.problem
            .columns()
            .iter()
            .zip(values)
            .enumerate()
            .map(|(k, (column, &value))| {
                let place = self.determined.len() + k;
                let half = quantile * inverse[place][place].sqrt();
                let value = value + column.origin(&refined.minimum.at.origins);
                Coefficient {
                    name: column.name.clone(),
                    curve: column.curve,
                    value,
                    interval: [value - half, value + half],
                }
            })
            .collect()
    }
}
