//! Whether repeats depart from their fits in the same way.
//!
//! Noise of each curve, however correlated, is independent of that of the others; what all of them share is a misfit.
//! Each curve has the normal equations `A_i`, `b_i` of smooth departures from its own fit, with its unknowns and
//! nuisances eliminated. In coordinates in which `Σ A_i = 1`, the common departure is `γ = Σ b_i`, and
//! `d_i = b_i − A_i γ` is what curve `i` has of its own. With `m` departures and `R` curves
//!
//! ```text
//! F = |γ|² (R − 1)/(R Σ |d_i|²)
//! ```
//!
//! is Fisher's with `m` and `(R − 1) m` degrees of freedom: an analysis of variance, whose unit is the scatter between
//! the curves and not the noise estimated within them, which has absorbed the misfit. Where the departures scatter
//! unequally, both degrees are multiplied by `ε = (tr S)²/(m tr S²)`, `S = Σ d_i d_iᵀ` (S. Geisser and S. W.
//! Greenhouse, Ann. Math. Stat. 29, 885 (1958)).

use faer::{Mat, Side};

use super::mixed_model::CurveEquations;
use crate::distribution::fisher_above;

/// Departures of which less than this part of the square remains beside unknowns and nuisances are those of a
/// derivative with its error, not of the curve.
const DEPENDENT: f64 = 1e-6;
/// Fewer curves do not show what is common.
const FEWEST_CURVES: usize = 3;

/// The smooth departures of one curve.
#[derive(Debug, Clone)]
pub(super) struct DepartureShare {
    /// Its normal equations, with its unknowns and nuisances eliminated.
    pub equations: CurveEquations,
    /// The square of each departure before that.
    pub squares: Vec<f64>,
}

/// The probability that independent curves have as large a common departure; `None` for fewer than three curves or if
/// unknowns and nuisances reproduce every departure.
pub(super) fn common_p(curves: &[&DepartureShare]) -> Option<f64> {
    if curves.len() < FEWEST_CURVES {
        return None;
    }
    let basis = basis(curves)?;
    let departures = basis.ncols();
    let in_basis = curves.iter().map(|curve| {
        let of = &curve.equations;
        (
            basis.transpose() * &of.gram * &basis,
            basis.transpose() * &of.pull,
        )
    });
    let in_basis: Vec<(Mat<f64>, Mat<f64>)> = in_basis.collect();
    let mut common = Mat::<f64>::zeros(departures, 1);
    for (_, pull) in &in_basis {
        common += pull;
    }
    let mut scatter = Mat::<f64>::zeros(departures, departures);
    for (gram, pull) in &in_basis {
        let own = pull - gram * &common;
        scatter += &own * own.transpose();
    }
    let (m, curves) = (departures as f64, curves.len() as f64);
    let trace: f64 = (0..departures).map(|k| scatter[(k, k)]).sum();
    let f = common.squared_norm_l2() * (curves - 1.0) / (curves * trace);
    // tr S² = Σ S_ij², since S is symmetric.
    let epsilon = trace * trace / (m * scatter.squared_norm_l2());
    (trace > 0.0).then(|| fisher_above(f, epsilon * m, epsilon * (curves - 1.0) * m))
}

/// Columns `V` for which `Vᵀ (Σ A_i) V = 1`, over the departures that unknowns and nuisances do not reproduce.
fn basis(curves: &[&DepartureShare]) -> Option<Mat<f64>> {
    let size = curves.first()?.squares.len();
    let square = |k: usize| curves.iter().map(|curve| curve.squares[k]).sum::<f64>();
    let scale: Vec<f64> = (0..size).map(|k| square(k).sqrt().recip()).collect();
    let whole = Mat::from_fn(size, size, |i, k| {
        let sum: f64 = curves
            .iter()
            .map(|curve| curve.equations.gram[(i, k)])
            .sum();
        scale[i] * sum * scale[k]
    });
    let is_finite = (0..size).all(|i| (0..size).all(|k| whole[(i, k)].is_finite()));
    let eigen = whole
        .self_adjoint_eigen(Side::Lower)
        .ok()
        .filter(|_| is_finite)?;
    let kept: Vec<usize> = (0..size).filter(|k| eigen.S()[*k] > DEPENDENT).collect();
    let column =
        |i: usize, k: usize| scale[i] * eigen.U()[(i, kept[k])] / eigen.S()[kept[k]].sqrt();
    (!kept.is_empty()).then(|| Mat::from_fn(size, kept.len(), column))
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// One curve of unit information about each departure.
    fn share(departures: &[f64]) -> DepartureShare {
        let size = departures.len();
        DepartureShare {
            equations: CurveEquations {
                gram: Mat::identity(size, size),
                pull: Mat::from_fn(size, 1, |i, _| departures[i]),
            },
            squares: vec![1.0; size],
        }
    }

    #[test]
    fn one_departure_is_tested_as_the_mean_of_a_sample() {
        // Mean 2, standard deviation 1, five values: t = 2√5, and t² is F with 1 and 4 degrees of freedom.
        let root = 0.5_f64.sqrt();
        let values = [2.0 - 2.0 * root, 2.0, 2.0, 2.0, 2.0 + 2.0 * root];
        let all: Vec<DepartureShare> = values.iter().map(|v| share(&[*v])).collect();
        let p = common_p(&all.iter().collect::<Vec<_>>()).unwrap();
        // Rounding of a few sums.
        assert_relative_eq!(p, fisher_above(20.0, 1.0, 4.0), max_relative = 1e-12);
    }

    #[test]
    fn departures_that_scatter_equally_count_fully_and_one_alone_counts_once() {
        let p = |all: &[[f64; 2]]| {
            let all: Vec<DepartureShare> = all.iter().map(|v| share(v)).collect();
            common_p(&all.iter().collect::<Vec<_>>()).unwrap()
        };
        // About the mean (1, 0): ε is 1 for the corners of a square, ½ on a line.
        let square = p(&[[2.0, 0.0], [0.0, 0.0], [1.0, 1.0], [1.0, -1.0]]);
        // |γ|² = 4, tr S = 4: F = 4·3/(4·4)… with Σ A_i = 4, both are a quarter of this.
        assert_relative_eq!(
            square,
            fisher_above(4.0 * 3.0 / 4.0 / 1.0, 2.0, 6.0),
            max_relative = 1e-12
        );
        let line = p(&[[2.0, 0.0], [0.0, 0.0], [2.0, 0.0], [0.0, 0.0]]);
        assert_relative_eq!(line, fisher_above(3.0, 1.0, 3.0), max_relative = 1e-12);
    }

    #[test]
    fn two_curves_have_no_common_departure() {
        let all = [share(&[1.0]), share(&[1.1])];
        assert_eq!(common_p(&all.iter().collect::<Vec<_>>()), None);
    }
}
