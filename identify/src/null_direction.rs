//! Directions in which no curve changes, and the combinations that remain known.
//!
//! A direction is a list of exponents: multiplying each parameter `θ_k` by `b^{d_k}` leaves every curve unchanged. Only
//! those combinations of a model's directions count that move no fixed parameter and none with a prior. An unknown that
//! takes part in one of them is not identifiable from any data. With a basis `U` of the directions that count, the
//! product `θ_j Π θ_k^{c_k}` is known where `U_j + Σ c_k U_k = 0`.

mod common;

use faer::Mat;

use crate::{IdentifyError, Unknown, curve::check_length};

/// Singular values below this part of the largest are zero: exponents are small numbers such as ½, 1, 2.
const ZERO: f64 = 1e-9;

/// Directions in the logarithms of a model's parameters along which no curve changes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NullDirections {
    parameters: Vec<String>,
    vectors: Vec<Vec<f64>>,
}

impl NullDirections {
    /// Directions over the named parameters, both unknown and fixed: one exponent per parameter.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Length`] where the number of exponents of a direction is not that of the parameters.
    pub fn new(parameters: Vec<String>, vectors: Vec<Vec<f64>>) -> Result<Self, IdentifyError> {
        for vector in &vectors {
            check_length("null direction", vector, parameters.len())?;
        }
        Ok(Self {
            parameters,
            vectors,
        })
    }

    /// The directions that move only unknowns without a prior.
    pub(crate) fn among(&self, unknowns: &[Unknown]) -> Result<NullSpace, IdentifyError> {
        let is_free = |name: &String| {
            unknowns
                .iter()
                .any(|u| u.name() == name && u.prior().is_none())
        };
        let fixed: Vec<usize> = (0..self.parameters.len())
            .filter(|&k| !is_free(&self.parameters[k]))
            .collect();
        // Weights a with aᵀ N = 0 at the fixed parameters.
        let held = Mat::from_fn(fixed.len(), self.vectors.len(), |i, v| {
            self.vectors[v][fixed[i]]
        });
        let weights = kernel(&held)?;
        let entry = |unknown: &Unknown, weight: usize| {
            let place = self
                .parameters
                .iter()
                .position(|name| name == unknown.name());
            place.map_or(0.0, |k| {
                self.vectors
                    .iter()
                    .zip(&weights[weight])
                    .map(|(v, a)| a * v[k])
                    .sum()
            })
        };
        let raw = Mat::from_fn(weights.len(), unknowns.len(), |w, j| entry(&unknowns[j], w));
        Ok(NullSpace {
            basis: row_space(&raw)?,
            unknowns: unknowns.len(),
        })
    }
}

/// The directions among the unknowns, orthonormal.
#[derive(Debug, Clone)]
pub(crate) struct NullSpace {
    basis: Vec<Vec<f64>>,
    unknowns: usize,
}

/// Unknowns held so that the data determine one unknown, and the combination that it then represents.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Hold {
    /// Indices of the unknowns held.
    pub held: Vec<usize>,
    /// Index and exponent `c_k` of each held unknown that the combination contains.
    pub exponents: Vec<(usize, f64)>,
}

impl NullSpace {
    /// Number of independent directions.
    pub fn rank(&self) -> usize {
        self.basis.len()
    }

    /// Whether the unknown takes part in a direction.
    pub fn moves(&self, unknown: usize) -> bool {
        self.basis
            .iter()
            .any(|direction| direction[unknown].abs() > ZERO)
    }

    /// The unknowns to hold so that the data determine `unknown`, with the fewest others in its combination; `None` if
    /// no combination with it is known.
    pub fn hold_for(&self, unknown: usize) -> Result<Option<Hold>, IdentifyError> {
        let mut best: Option<Hold> = None;
        for held in subsets(self.unknowns, self.rank(), Some(unknown)) {
            let Some(hold) = self.solve(unknown, held)? else {
                continue;
            };
            let simpler = |known: &Hold| hold.exponents.len() < known.exponents.len();
            if best.as_ref().is_none_or(simpler) {
                best = Some(hold);
            }
        }
        Ok(best)
    }

    /// The unknowns to hold so that the data determine all others.
    pub fn hold(&self) -> Result<Vec<usize>, IdentifyError> {
        for held in subsets(self.unknowns, self.rank(), None) {
            if kernel(&self.part(&held))?.is_empty() {
                return Ok(held);
            }
        }
        Ok(Vec::new())
    }

    /// The exponents with these unknowns held, if holding them blocks every direction.
    fn solve(&self, unknown: usize, held: Vec<usize>) -> Result<Option<Hold>, IdentifyError> {
        let matrix = self.part(&held);
        if !kernel(&matrix)?.is_empty() {
            return Ok(None);
        }
        // Σ_k c_k U_k = −U_j
        let right = Mat::from_fn(self.rank(), 1, |b, _| -self.basis[b][unknown]);
        let solution = least_norm(&matrix, &right)?;
        let exponents = held
            .iter()
            .zip(solution)
            .filter(|(_, c)| c.abs() > ZERO)
            .map(|(&k, c)| (k, round_off(c)))
            .collect();
        Ok(Some(Hold { held, exponents }))
    }

    /// The entries of the basis for some unknowns, one row per direction.
    fn part(&self, unknowns: &[usize]) -> Mat<f64> {
        Mat::from_fn(self.rank(), unknowns.len(), |b, k| {
            self.basis[b][unknowns[k]]
        })
    }
}

/// An exponent, freed of the rounding of the algebra.
fn round_off(exponent: f64) -> f64 {
    (exponent * 1e9).round() / 1e9
}

/// An orthonormal basis of the vectors `x` with `A x = 0`.
fn kernel(matrix: &Mat<f64>) -> Result<Vec<Vec<f64>>, IdentifyError> {
    eigenvectors(&gram(matrix), |value, largest| {
        value <= ZERO * largest.max(f64::MIN_POSITIVE)
    })
}

/// An orthonormal basis of the rows of a matrix.
fn row_space(matrix: &Mat<f64>) -> Result<Vec<Vec<f64>>, IdentifyError> {
    eigenvectors(&gram(matrix), |value, largest| {
        value > ZERO * largest.max(f64::MIN_POSITIVE)
    })
}

/// `Aᵀ A`.
fn gram(matrix: &Mat<f64>) -> Mat<f64> {
    matrix.transpose() * matrix
}

fn eigenvectors(
    gram: &Mat<f64>,
    wanted: impl Fn(f64, f64) -> bool,
) -> Result<Vec<Vec<f64>>, IdentifyError> {
    let size = gram.nrows();
    if size == 0 {
        return Ok(Vec::new());
    }
    let eigen = gram
        .self_adjoint_eigen(faer::Side::Lower)
        .map_err(|_| IdentifyError::Decomposition { size })?;
    let largest = eigen.S()[size - 1];
    Ok((0..size)
        .filter(|&k| wanted(eigen.S()[k], largest))
        .map(|k| (0..size).map(|i| eigen.U()[(i, k)]).collect())
        .collect())
}

/// The solution of a regular square system.
fn least_norm(matrix: &Mat<f64>, right: &Mat<f64>) -> Result<Vec<f64>, IdentifyError> {
    use faer::linalg::solvers::Solve as _;
    let size = matrix.ncols();
    if size == 0 {
        return Ok(Vec::new());
    }
    let solution = matrix.partial_piv_lu().solve(right);
    let values: Vec<f64> = (0..size).map(|k| solution[(k, 0)]).collect();
    if values.iter().all(|v| v.is_finite()) {
        return Ok(values);
    }
    Err(IdentifyError::Decomposition { size })
}

/// All sets of `size` numbers below `count`, leaving out `without`.
fn subsets(count: usize, size: usize, without: Option<usize>) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..size {
        all = all
            .into_iter()
            .flat_map(|set: Vec<usize>| {
                let next = set.last().map_or(0, |last| last + 1);
                (next..count).filter(|&k| Some(k) != without).map(move |k| {
                    let mut larger = set.clone();
                    larger.push(k);
                    larger
                })
            })
            .collect();
    }
    all
}

#[cfg(test)]
mod tests;
