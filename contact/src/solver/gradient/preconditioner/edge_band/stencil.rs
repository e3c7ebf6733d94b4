//! Sums of a field times the coefficients of `F` around the band's elements, in single precision and in the widest
//! instructions that the processor has.

#![expect(
    clippy::inline_always,
    reason = "vector instructions are available only in the function that dispatches"
)]

use pulp::{Simd, WithSimd};

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

/// Adjacent places, some of which belong to the band.
pub struct Group {
    /// The first of the places.
    pub place: usize,
    /// Index of the first of the band's elements.
    pub first: usize,
    /// Which of the places belong to the band.
    pub members: [bool; TOGETHER],
}

/// The sums of a field times the coefficients around the band's elements in some groups, to be written to `image`.
pub struct Stencils<'a> {
    pub groups: &'a [Group],
    pub field: &'a [f32],
    /// Places in a row of the field.
    pub width: usize,
    pub coefficients: &'a SingleStencil,
    pub image: &'a mut [f64],
}

impl WithSimd for Stencils<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (field, width) = (self.field, self.width);
        let mut image = self.image.iter_mut();
        for group in self.groups {
            let field = &field[group.place - REACH * (width + 1)..];
            let sums = stencil(field, width, self.coefficients);
            let members = sums.iter().zip(group.members).filter(|(_, member)| *member);
            for ((sum, _), y) in members.zip(&mut image) {
                *y = f64::from(*sum);
            }
        }
    }
}

/// The sums of a field times the coefficients around adjacent places; the field starts at the place of the lowest
/// offsets from the first of them.
#[inline(always)]
fn stencil(field: &[f32], width: usize, coefficients: &SingleStencil) -> [f32; TOGETHER] {
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
