//! An orthonormal basis of a few long columns, and projections off it.
//!
//! Modified Gram–Schmidt, each column orthogonalised twice, is orthogonal to rounding: L. Giraud, J. Langou,
//! M. Rozložník and J. van den Eshof, Numer. Math. 101, 87 (2005).

/// A column is dependent if less than this fraction of its length remains after projection off the earlier ones.
const DEPENDENT: f64 = 1e-10;

/// The factorisation `A = Q R` of the independent columns among those given.
#[derive(Debug, Clone, Default)]
pub(crate) struct OrthonormalBasis {
    basis: Vec<Vec<f64>>,
    /// Column `k` of `R`: `k + 1` numbers.
    triangle: Vec<Vec<f64>>,
    /// Indices of the independent columns.
    kept: Vec<usize>,
    columns: usize,
}

impl OrthonormalBasis {
    /// The basis of the columns, in their order.
    pub fn of(columns: impl IntoIterator<Item = Vec<f64>>) -> Self {
        let mut basis = Self::default();
        for column in columns {
            basis.push(column);
        }
        basis
    }

    /// Adds a column if it is independent of the earlier ones.
    pub fn push(&mut self, mut column: Vec<f64>) {
        let length = norm(&column);
        let mut components = self.remove_from(&mut column);
        let rest = norm(&column);
        if rest > DEPENDENT * length {
            column.iter_mut().for_each(|v| *v /= rest);
            components.push(rest);
            self.triangle.push(components);
            self.basis.push(column);
            self.kept.push(self.columns);
        }
        self.columns += 1;
    }

    /// Reduces a column to its part orthogonal to the basis, and returns its components `Qᵀ v`.
    pub fn remove_from(&self, column: &mut [f64]) -> Vec<f64> {
        let mut components = vec![0.0; self.basis.len()];
        for _ in 0..2 {
            for (total, direction) in components.iter_mut().zip(&self.basis) {
                let part = dot(direction, column);
                *total += part;
                for (v, q) in column.iter_mut().zip(direction) {
                    *v -= part * q;
                }
            }
        }
        components
    }

    /// The coefficient of each column, `R⁻¹ Qᵀ v`; zero for those that depend on earlier ones.
    pub fn coefficients(&self, components: &[f64]) -> Vec<f64> {
        let mut rest = components.to_vec();
        let mut coefficients = vec![0.0; self.columns];
        for k in (0..self.kept.len()).rev() {
            let value = rest[k] / self.triangle[k][k];
            coefficients[self.kept[k]] = value;
            for (i, r) in self.triangle[k][..k].iter().enumerate() {
                rest[i] -= value * r;
            }
        }
        coefficients
    }

    /// Number of columns, dependent ones included.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of independent columns.
    pub fn rank(&self) -> usize {
        self.kept.len()
    }

    /// `ln det AᵀA` of the independent columns, `2 Σ ln R_kk`.
    pub fn log_determinant(&self) -> f64 {
        self.triangle
            .iter()
            .enumerate()
            .map(|(k, column)| 2.0 * column[k].ln())
            .sum()
    }

    /// `(AᵀA)⁻¹`, row by row; infinite on the diagonal for columns that depend on earlier ones.
    pub fn inverse_gram(&self) -> Vec<Vec<f64>> {
        let rank = self.rank();
        let mut inverse = vec![vec![0.0; self.columns]; self.columns];
        let solutions: Vec<Vec<f64>> = (0..rank)
            .map(|k| {
                let mut unit = vec![0.0; rank];
                unit[k] = 1.0;
                self.coefficients(&unit)
            })
            .collect();
        for (i, row) in inverse.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = solutions.iter().map(|s| s[i] * s[j]).sum();
            }
            if !self.kept.contains(&i) {
                row[i] = f64::INFINITY;
            }
        }
        inverse
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn a_straight_line_is_fitted_and_a_dependent_third_column_is_dropped() {
        let x = [0.0, 1.0, 2.0, 3.0];
        let line = OrthonormalBasis::of([
            vec![1.0; 4],
            x.to_vec(),
            x.iter().map(|x| 2.0 - 3.0 * x).collect(),
        ]);
        assert_eq!(line.rank(), 2);
        let mut y: Vec<f64> = x.iter().map(|x| 5.0 + 0.5 * x).collect();
        let components = line.remove_from(&mut y);
        let coefficients = line.coefficients(&components);
        // Rounding with four points.
        assert_relative_eq!(coefficients[0], 5.0, max_relative = 1e-14);
        assert_relative_eq!(coefficients[1], 0.5, max_relative = 1e-13);
        assert_eq!(coefficients[2], 0.0);
        assert!(norm(&y) < 1e-14);
        // AᵀA = [4 6; 6 14], determinant 20.
        assert_relative_eq!(line.log_determinant(), 20.0_f64.ln(), max_relative = 1e-14);
        let inverse = line.inverse_gram();
        assert_relative_eq!(inverse[0][0], 0.7, max_relative = 1e-13);
        assert_relative_eq!(inverse[0][1], -0.3, max_relative = 1e-13);
        assert_eq!(inverse[2][2], f64::INFINITY);
    }
}
