//! Sums of a field times the coefficients of `F` around elements, in single precision and in the widest
//! instructions that the processor has.

#![expect(
    clippy::inline_always,
    reason = "vector instructions are available only in the function that dispatches"
)]

use std::ops::Range;

use pulp::{Simd, WithSimd};

use crate::vector::single;

/// Offset along both axes up to which coefficients of `F` are used.
pub const REACH: usize = 3;
/// Coefficients along a side of a quarter of the stencil.
const QUARTER_SIDE: usize = REACH + 1;
/// Coefficients of `F` by offset along both axes.
pub type Stencil = [[f64; QUARTER_SIDE]; QUARTER_SIDE];
/// The same in single precision.
pub type SingleStencil = [[f32; QUARTER_SIDE]; QUARTER_SIDE];
/// Places at which the stencil is applied at once.
pub const TOGETHER: usize = 8;

/// A number for each of the places.
pub type Lanes = [f32; TOGETHER];

/// Adjacent elements of a row, some of which belong to a set.
#[derive(Clone, Copy)]
pub struct Group {
    /// Place of the first in the field to which the stencil is applied.
    pub place: usize,
    /// The first.
    pub element: usize,
    /// Which of them belong to it.
    pub members: [bool; TOGETHER],
}

impl Group {
    /// The members, with their places.
    pub fn elements(&self) -> impl Iterator<Item = [usize; 2]> {
        let members = (0..TOGETHER).filter(|k| self.members[*k]);
        members.map(|k| [self.element + k, self.place + k])
    }

    /// Its places.
    pub fn range(&self) -> Range<usize> {
        self.place..self.place + TOGETHER
    }

    /// `factor` times the members' values of a field over the grid; 0 for the others.
    pub fn read(&self, field: &[f64], factor: f64) -> Lanes {
        let field = &field[self.element..];
        std::array::from_fn(|k| {
            if self.members[k] {
                single(factor * field[k])
            } else {
                0.0
            }
        })
    }

    /// Applies `rule` to the members' values of a field over the grid.
    pub fn update(&self, field: &mut [f64], rule: impl Fn(&mut f64, usize)) {
        let values = field[self.element..].iter_mut().zip(self.members);
        for (k, (value, _)) in values.enumerate().filter(|(_, (_, member))| *member) {
            rule(value, k);
        }
    }
}

/// The sums of a field times the coefficients around the elements of some groups, to be written to `sums`; 0 beside
/// them. The output is the product of the sums and the field.
pub struct Stencils<'a> {
    pub groups: &'a [Group],
    pub field: &'a [f32],
    /// Places in a row of the field.
    pub width: usize,
    pub coefficients: &'a SingleStencil,
    pub sums: &'a mut [Lanes],
}

impl WithSimd for Stencils<'_> {
    type Output = f32;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f32 {
        let mut product = [0.0; TOGETHER];
        for (group, sums) in self.groups.iter().zip(self.sums) {
            let field = &self.field[group.place - REACH * (self.width + 1)..];
            let found = stencil(field, self.width, self.coefficients);
            let here = &self.field[group.range()];
            for k in 0..TOGETHER {
                sums[k] = if group.members[k] { found[k] } else { 0.0 };
                product[k] += sums[k] * here[k];
            }
        }
        product.iter().sum()
    }
}

/// The sums of a field times the coefficients around adjacent places; the field starts at the place of the lowest
/// offsets from the first of them.
#[inline(always)]
fn stencil(field: &[f32], width: usize, coefficients: &SingleStencil) -> Lanes {
    const AROUND: usize = TOGETHER + 2 * REACH;
    let mut sums = [0.0; TOGETHER];
    for (i, coefficients) in coefficients.iter().enumerate() {
        let row = |i: usize| -> &[f32] { &field[i * width..][..AROUND] };
        let (above, below) = (row(REACH - i), row(REACH + i));
        let mut both = [0.0; AROUND];
        for (k, both) in both.iter_mut().enumerate() {
            *both = if i == 0 {
                below[k]
            } else {
                above[k] + below[k]
            };
        }
        for (j, coefficient) in coefficients.iter().enumerate() {
            for (k, sum) in sums.iter_mut().enumerate() {
                let value = match j {
                    0 => both[REACH + k],
                    _ => both[REACH - j + k] + both[REACH + j + k],
                };
                *sum += coefficient * value;
            }
        }
    }
    sums
}
