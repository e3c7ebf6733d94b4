//! Cosine transforms of lines continued by their mirror image, two lines at a time as one complex line, by complex
//! fast Fourier transforms.
//!
//! A line `x_0 … x_(h−1)`, continued evenly beyond both ends or oddly beyond the far one, has the transforms
//!
//! ```text
//! X(κ) = Σ_n x_n cos(π (2n + 1) κ / 2h),    κ = 0, 1, 2 … (type II) or ½, 1½, 2½ … (type IV)
//! ```
//!
//! In the order `v = x_0, x_2, x_4 … ± x_5, ± x_3, ± x_1` (Makhoul 1980; minus for the halves) they are
//! `X(κ) = ½ (w V(κ) + w̄ V(−κ))`, with `w = exp(−πiκ/2h)` and the Fourier transform `V` of `v`, or for the halves of
//! `v_j exp(−πij/h)`. The partner of `κ` is `h − κ`: with `a = w V(κ)` and `b = w̄ V(−κ)`
//!
//! ```text
//! 2 X(κ) = a + b,  2 X(h − κ) = i (a − b);    a = X(κ) − i X(h − κ),  b = X(κ) + i X(h − κ)
//! ```

use std::cell::Cell;
use std::sync::Arc;

use pellicle_fourier::Complex;
use pellicle_fourier::Fft;

use super::Parity;
use super::lines::Real;

/// The frequencies of a transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Frequencies {
    /// κ = 0, 1, 2 …: type II and its inverse.
    Whole,
    /// κ = ½, 1½, 2½ …: type IV.
    Half,
}

/// Transforms of one length `h`, unnormalised: forward and back together multiply a line by `2h`.
pub(crate) struct CosineTransform<T: Real> {
    frequencies: Frequencies,
    forward: Arc<dyn Fft<T>>,
    inverse: Arc<dyn Fft<T>>,
    /// `w` of the first half of the frequencies.
    phases: Vec<Complex<T>>,
    /// The factor of the `n`-th number when it is put in its place; 1 at whole frequencies.
    turns: Vec<Complex<T>>,
}

impl<T: Real> CosineTransform<T> {
    pub(crate) fn new(length: usize, frequencies: Frequencies) -> Self {
        let unit = |angle: f64| {
            let turned = Complex::cis(-std::f64::consts::PI * angle);
            Complex::new(T::narrowed(turned.re), T::narrowed(turned.im))
        };
        let first = match frequencies {
            Frequencies::Whole => 0.0,
            Frequencies::Half => 0.5,
        };
        let phase = |k: usize| unit((k as f64 + first) / (2 * length) as f64);
        let turn = |n: usize| match frequencies {
            Frequencies::Whole => unit(0.0),
            // exp(−πij/h) at the place j, times −1 for odd numbers
            Frequencies::Half => unit(place(n, length) as f64 / length as f64 + (n % 2) as f64),
        };
        Self {
            frequencies,
            forward: T::forward(length),
            inverse: T::inverse(length),
            phases: (0..=length / 2).map(phase).collect(),
            turns: (0..length).map(turn).collect(),
        }
    }

    /// Length of the scratch that the transforms need.
    pub(crate) fn scratch_length(&self) -> usize {
        let forward = self.forward.get_inplace_scratch_len();
        forward.max(self.inverse.get_inplace_scratch_len())
    }

    /// Puts the numbers of a line in their places and fills the rest with zeros.
    pub(crate) fn put(&self, line: &mut [Complex<T>], numbers: impl Iterator<Item = Complex<T>>) {
        let length = line.len();
        let mut count = 0;
        for (n, (x, turn)) in numbers.zip(&self.turns).enumerate() {
            line[place(n, length)] = match self.frequencies {
                Frequencies::Whole => x,
                Frequencies::Half => turn * x,
            };
            count = n + 1;
        }
        let (first, last) = (count.div_ceil(2), length - count / 2);
        line[first..last].fill(Complex::default());
    }

    /// The factor of the `n`-th number before it is put in its [place]; its conjugate restores the number.
    pub(crate) fn turn(&self, n: usize) -> Complex<T> {
        self.turns[n]
    }

    /// Transforms the numbers in their places to `2 X`, in place.
    pub(crate) fn analyse(&self, line: &mut [Complex<T>], scratch: &mut [Complex<T>]) {
        self.forward.process_with_scratch(line, scratch);
        self.of_partners(line, |_, [low, high], phase| analysed([low, high], phase));
        if self.frequencies == Frequencies::Whole {
            line[0] = line[0] + line[0];
        }
    }

    /// Transforms `X` to the numbers in their places times `h`, in place.
    pub(crate) fn synthesise(&self, line: &mut [Complex<T>], scratch: &mut [Complex<T>]) {
        self.of_partners(line, |_, both, phase| synthesised(both, phase));
        self.inverse.process_with_scratch(line, scratch);
    }

    /// [`Self::synthesise`] for sums of cosines, or of sines with the sign `(−1)ⁿ` of the `n`-th number:
    /// `sin(π (2n + 1) κ / 2h) = (−1)ⁿ cos(π (2n + 1) (h − κ) / 2h)`.
    pub(crate) fn synthesise_with(
        &self,
        parity: Parity,
        line: &mut [Complex<T>],
        scratch: &mut [Complex<T>],
    ) {
        if parity == Parity::Odd {
            match self.frequencies {
                Frequencies::Whole => {
                    // The sine of h is the cosine of 0, and is not given: for a mirrored field it is 0.
                    line[0] = Complex::default();
                    line[1..].reverse();
                }
                Frequencies::Half => line.reverse(),
            }
        }
        self.synthesise(line, scratch);
    }

    /// [`Self::analyse`], multiplication of every `X` by the factors of its line, and [`Self::synthesise`].
    pub(crate) fn filter(
        &self,
        line: &mut [Complex<T>],
        factors: [&[T]; 2],
        scratch: &mut [Complex<T>],
    ) {
        self.forward.process_with_scratch(line, scratch);
        let factors = factors.map(|of| &of[..line.len()]);
        let times =
            |x: Complex<T>, k: usize| Complex::new(x.re * factors[0][k], x.im * factors[1][k]);
        self.of_partners(line, |[k, partner], both, phase| {
            let [x, y] = analysed(both, phase);
            synthesised([times(x, k), times(y, partner)], phase)
        });
        if self.frequencies == Frequencies::Whole {
            line[0] = times(line[0] + line[0], 0);
        }
        self.inverse.process_with_scratch(line, scratch);
    }

    /// Replaces all pairs of partners by a rule that takes their indices and phase. A number that is its own partner
    /// becomes the first of the pair.
    fn of_partners(
        &self,
        line: &mut [Complex<T>],
        rule: impl Fn([usize; 2], [Complex<T>; 2], Complex<T>) -> [Complex<T>; 2],
    ) {
        // h − κ has the index h − k for whole frequencies, and h − 1 − k for halves.
        let first = usize::from(self.frequencies == Frequencies::Whole);
        let last = line.len() - 1;
        let numbers = Cell::from_mut(&mut line[first..]).as_slice_of_cells();
        let pairs = numbers.iter().zip(numbers.iter().rev());
        let pairs = pairs.zip(&self.phases[first..]).enumerate();
        for (index, ((low, high), phase)) in pairs.take(numbers.len().div_ceil(2)) {
            let partners = [first + index, last - index];
            let [x, y] = rule(partners, [low.get(), high.get()], *phase);
            high.set(y);
            low.set(x);
        }
    }
}

/// `2 X(κ)` and `2 X(h − κ)` from `V(κ)` and `V(−κ)`.
fn analysed<T: Real>([v, partner]: [Complex<T>; 2], phase: Complex<T>) -> [Complex<T>; 2] {
    let (a, b) = (phase * v, phase.conj() * partner);
    [a + b, turned(a - b)]
}

/// `V(κ)` and `V(−κ)` from `X(κ)` and `X(h − κ)`.
fn synthesised<T: Real>([x, partner]: [Complex<T>; 2], phase: Complex<T>) -> [Complex<T>; 2] {
    let y = turned(partner);
    [phase.conj() * (x - y), phase * (x + y)]
}

/// The place of the `n`-th number of a line of `length`.
pub(crate) fn place(n: usize, length: usize) -> usize {
    if n.is_multiple_of(2) {
        n / 2
    } else {
        length - n.div_ceil(2)
    }
}

/// `i z`.
fn turned<T: Real>(z: Complex<T>) -> Complex<T> {
    Complex::new(-z.im, z.re)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use pellicle_fourier::Complex;

    use super::{CosineTransform, Frequencies, Parity, place};

    fn line(length: usize) -> Vec<Complex<f64>> {
        let number = |n: usize| Complex::new((0.7 * n as f64).sin(), (1.3 * n as f64).cos());
        (0..length).map(number).collect()
    }

    #[test]
    fn the_transforms_equal_their_cosine_sums_and_are_inverse() {
        for length in [1, 2, 3, 5, 8, 15, 16] {
            for (frequencies, first) in [(Frequencies::Whole, 0.0), (Frequencies::Half, 0.5)] {
                let x = line(length);
                let transform = CosineTransform::<f64>::new(length, frequencies);
                let mut scratch = vec![Complex::default(); transform.scratch_length()];
                let mut placed = vec![Complex::default(); length];
                transform.put(&mut placed, x.iter().copied());
                transform.analyse(&mut placed, &mut scratch);
                for (k, found) in placed.iter().enumerate() {
                    let kappa = k as f64 + first;
                    let cosine =
                        |n: usize| ((2 * n + 1) as f64 * PI * kappa / (2 * length) as f64).cos();
                    let terms = x.iter().enumerate().map(|(n, x)| x * (2.0 * cosine(n)));
                    let expected: Complex<f64> = terms.sum();
                    // Rounding of 16 terms of order 1.
                    assert!(
                        (found - expected).norm() < 1e-13,
                        "{length} {frequencies:?} {k}"
                    );
                }
                let mut of_sines = placed.clone();
                transform.synthesise_with(Parity::Odd, &mut of_sines, &mut scratch);
                for n in 0..length {
                    let sine = |k: usize| {
                        let angle = (2 * n + 1) as f64 * PI * (k as f64 + first);
                        (angle / (2 * length) as f64).sin()
                    };
                    let terms = placed.iter().enumerate().map(|(k, x)| x * (2.0 * sine(k)));
                    let expected: Complex<f64> = terms.sum();
                    let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
                    let found = transform.turn(n).conj() * of_sines[place(n, length)] * sign;
                    // Rounding of sums of order 100.
                    assert!(
                        (found - expected).norm() < 1e-11,
                        "{length} {frequencies:?} {n}"
                    );
                }
                transform.synthesise(&mut placed, &mut scratch);
                for (n, x) in x.iter().enumerate() {
                    let back = transform.turn(n).conj() * placed[place(n, length)];
                    let expected = x * (2 * length) as f64;
                    assert!((back - expected).norm() < 1e-12);
                }
            }
        }
    }
}
