//! The Cholesky factor of a small dense system and the last rows of its inverse, in single precision and in the widest
//! instructions that the processor has.
//!
//! Columns of the matrix lie one after the other, padded to whole vectors, so that four columns of two vectors each
//! stay in registers while all earlier columns are subtracted from them. With 93 unknowns, nine of them a tile's own,
//! this takes half of the time of the general routines of a linear-algebra library.

#![expect(
    clippy::inline_always,
    reason = "vector instructions are available only in the function that dispatches"
)]

use pulp::{Arch, Simd, WithSimd};

/// Most rows of the inverse that can be found together.
pub const MOST_ROWS: usize = 16;
/// Columns that are factored together.
const TOGETHER: usize = 4;
/// Unknowns that are eliminated together in the substitution; a multiple of [`TOGETHER`].
const PANEL: usize = 8;
/// Columns are padded to a multiple of this: two of the longest vectors.
const PADDED: usize = 32;

/// A symmetric positive definite system, and memory that serves one system after another.
#[derive(Default)]
pub struct SmallSystem {
    order: usize,
    /// Length of a column.
    stride: usize,
    /// `A`, and once it is factored `L`, with the inverse of its diagonal: lower triangles by columns, padded with
    /// those of the identity.
    lower: Vec<f32>,
    /// For each unknown its entries in the last rows of `L⁻¹`.
    inverse: Vec<[f32; MOST_ROWS]>,
}

impl SmallSystem {
    /// Begins a system of this many unknowns; all entries are zero.
    pub fn begin(&mut self, order: usize) {
        self.order = order;
        self.stride = order.next_multiple_of(PADDED);
        let columns = order.next_multiple_of(PANEL);
        self.lower.clear();
        self.lower.resize(columns * self.stride, 0.0);
        for beyond in order..columns {
            self.lower[beyond * self.stride + beyond] = 1.0;
        }
        self.inverse.clear();
        self.inverse.resize(columns, [0.0; MOST_ROWS]);
    }

    /// The entries of `A` on and below the diagonal of a column.
    pub fn column(&mut self, column: usize) -> &mut [f32] {
        &mut self.lower[column * self.stride..][column..self.order]
    }

    /// For each unknown its entries in the last `rows` rows of `L⁻¹`, of which there are at most [`MOST_ROWS`]; none if
    /// `A` is not positive definite up to rounding.
    pub fn last_rows_of_inverse(&mut self, rows: usize) -> Option<&[[f32; MOST_ROWS]]> {
        let arch = Arch::new();
        if !arch.dispatch(Factor(self)) {
            return None;
        }
        for row in 0..rows {
            self.inverse[self.order - rows + row][row] = 1.0;
        }
        arch.dispatch(Substitution { system: self, rows });
        Some(&self.inverse[..self.order])
    }
}

/// Replaces `A` by `L`, `A = L Lᵀ`; returns false if it is not positive definite.
///
/// ```text
/// L_ij L_jj = A_ij − Σₖ L_ik L_jk,    k < j
/// ```
struct Factor<'a>(&'a mut SmallSystem);

impl WithSimd for Factor<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let SmallSystem {
            order,
            stride,
            ref mut lower,
            ..
        } = *self.0;
        let tile = 2 * S::F32_LANES;
        let end = order.next_multiple_of(tile);
        for first in (0..order).step_by(TOGETHER) {
            // From the tile that holds the diagonal on.
            let from = first / tile * tile;
            let (earlier, columns) = lower.split_at_mut(first * stride);
            let columns = &mut columns[..TOGETHER * stride];
            for row in (from..end).step_by(tile) {
                let mut sums = [[simd.splat_f32s(0.0); 2]; TOGETHER];
                for column in earlier.chunks_exact(stride) {
                    let factors = pair::<S>(&column[row..row + tile]);
                    for (sums, weight) in sums.iter_mut().zip(&column[first..first + TOGETHER]) {
                        let weight = simd.splat_f32s(*weight);
                        for (sum, factor) in sums.iter_mut().zip(factors) {
                            *sum = simd.mul_add_e_f32s(weight, factor, *sum);
                        }
                    }
                }
                for (sums, column) in sums.iter().zip(columns.chunks_exact_mut(stride)) {
                    let (vectors, _) = S::as_mut_simd_f32s(&mut column[row..row + tile]);
                    for (vector, sum) in vectors.iter_mut().zip(sums) {
                        *vector = simd.sub_f32s(*vector, *sum);
                    }
                }
            }
            for next in 0..TOGETHER {
                let (before, column) = columns.split_at_mut(next * stride);
                let diagonal = first + next;
                let (vectors, _) = S::as_mut_simd_f32s(&mut column[from..end]);
                for other in before.chunks_exact(stride) {
                    let weight = simd.splat_f32s(-other[diagonal]);
                    let (others, _) = S::as_simd_f32s(&other[from..end]);
                    for (vector, other) in vectors.iter_mut().zip(others) {
                        *vector = simd.mul_add_e_f32s(weight, *other, *vector);
                    }
                }
                let pivot = column[diagonal];
                if pivot.is_nan() || pivot <= 0.0 {
                    return false;
                }
                let inverse = 1.0 / pivot.sqrt();
                let (vectors, _) = S::as_mut_simd_f32s(&mut column[from..end]);
                for vector in vectors {
                    *vector = simd.mul_f32s(*vector, simd.splat_f32s(inverse));
                }
                column[diagonal] = inverse;
            }
        }
        true
    }
}

/// Replaces right-hand sides `e` by the solutions of `Lᵀ g = e`.
///
/// ```text
/// gⱼ = (eⱼ − Σᵢ L_ij gᵢ) / L_jj,    i > j
/// ```
struct Substitution<'a> {
    system: &'a mut SmallSystem,
    /// Number of right-hand sides.
    rows: usize,
}

impl WithSimd for Substitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let SmallSystem {
            stride,
            ref lower,
            ref mut inverse,
            ..
        } = *self.system;
        for first in (0..inverse.len()).step_by(PANEL).rev() {
            let (before, panel) = inverse.split_at_mut(first);
            let own = &lower[first * stride..];
            for vector in 0..self.rows.div_ceil(S::F32_LANES) {
                let mut known = [simd.splat_f32s(0.0); PANEL];
                for (known, unknown) in known.iter_mut().zip(&*panel) {
                    *known = S::as_simd_f32s(unknown).0[vector];
                }
                for i in (0..PANEL).rev() {
                    let row = first + i;
                    known[i] = simd.mul_f32s(known[i], simd.splat_f32s(own[i * stride + row]));
                    for j in 0..i {
                        let weight = simd.splat_f32s(-own[j * stride + row]);
                        known[j] = simd.mul_add_e_f32s(weight, known[i], known[j]);
                    }
                }
                for (known, unknown) in known.iter().zip(&mut *panel) {
                    S::as_mut_simd_f32s(unknown).0[vector] = *known;
                }
                for (unknown, column) in before.iter_mut().zip(lower.chunks_exact(stride)) {
                    let sum = &mut S::as_mut_simd_f32s(unknown).0[vector];
                    for (weight, known) in column[first..first + PANEL].iter().zip(known) {
                        *sum = simd.mul_add_e_f32s(simd.splat_f32s(-weight), known, *sum);
                    }
                }
            }
        }
    }
}

/// The first two vectors of a slice.
#[inline(always)]
fn pair<S: Simd>(values: &[f32]) -> [S::f32s; 2] {
    let (vectors, _) = S::as_simd_f32s(values);
    [vectors[0], vectors[1]]
}

#[cfg(test)]
mod tests {
    use pulp::Scalar;

    use super::*;

    /// A positive definite system of this many unknowns.
    fn system(order: usize) -> impl Fn(usize, usize) -> f32 {
        move |i, j| {
            let place = |k: usize| [7919, 104_729].map(|step| (k * step % 31) as f32);
            let [x, y] = [0, 1].map(|axis: usize| place(i)[axis] - place(j)[axis]);
            if i == j {
                order as f32 / 8.0 + 2.0
            } else {
                1.0 / (1.0 + x.hypot(y))
            }
        }
    }

    fn filled(small: &mut SmallSystem, order: usize, of: impl Fn(usize, usize) -> f32) {
        small.begin(order);
        for column in 0..order {
            let below = small.column(column).iter_mut();
            (column..)
                .zip(below)
                .for_each(|(row, entry)| *entry = of(row, column));
        }
    }

    #[test]
    fn the_last_rows_of_the_inverse_factor_diagonalise_the_system() {
        // G A Gᵀ = 1, and G A = 0 in the columns of all unknowns before a row's own: A = L Lᵀ, so G A = (0 … L_own)ᵀ.
        let mut small = SmallSystem::default();
        for order in [1, 4, 7, 8, 16, 31, 33, 64, 93, 130] {
            let of = system(order);
            for rows in [1, 3, 9, MOST_ROWS].map(|rows| rows.min(order)) {
                filled(&mut small, order, &of);
                let g = small.last_rows_of_inverse(rows).unwrap();
                for row in 0..rows {
                    let image: Vec<f64> = (0..order)
                        .map(|i| (0..order).map(|j| f64::from(of(i, j) * g[j][row])).sum())
                        .collect();
                    let own = order - rows + row;
                    assert!(
                        image[..own].iter().all(|value| value.abs() < 1e-5),
                        "{order} {rows}"
                    );
                    for other in 0..rows {
                        let terms = image.iter().zip(g).map(|(v, g)| v * f64::from(g[other]));
                        let wanted = f64::from(u8::from(other == row));
                        assert!((terms.sum::<f64>() - wanted).abs() < 1e-5, "{order} {rows}");
                    }
                }
                assert!(g.iter().all(|g| g[rows..].iter().all(|g| *g == 0.0)));
            }
        }
    }

    #[test]
    fn without_vector_instructions_the_rows_are_the_same_up_to_rounding() {
        let [mut one, mut other] = [(); 2].map(|()| SmallSystem::default());
        for order in [1, 5, 12, 37] {
            let rows = order.min(9);
            for small in [&mut one, &mut other] {
                filled(small, order, system(order));
            }
            let found = one.last_rows_of_inverse(rows).unwrap();
            assert!(Factor(&mut other).with_simd(Scalar::new()));
            for row in 0..rows {
                other.inverse[order - rows + row][row] = 1.0;
            }
            let system = &mut other;
            Substitution { system, rows }.with_simd(Scalar::new());
            let both = found
                .as_flattened()
                .iter()
                .zip(other.inverse.as_flattened());
            let largest = both.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(largest < 1e-6, "{order}: {largest}");
        }
    }

    #[test]
    fn a_system_that_is_not_positive_definite_has_no_factor() {
        let mut small = SmallSystem::default();
        for order in [2, 40] {
            filled(&mut small, order, system(order));
            assert!(small.last_rows_of_inverse(1).is_some());
            filled(&mut small, order, |_, _| 1.0);
            assert!(small.last_rows_of_inverse(1).is_none(), "{order}");
            filled(&mut small, order, |_, _| f32::NAN);
            assert!(small.last_rows_of_inverse(1).is_none(), "{order}");
        }
    }
}
